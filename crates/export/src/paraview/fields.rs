//! ParaView files of a run: displacement, contact pressure and stress on both gears, where they stand.

use std::f64::consts::PI;

use contact::{ContactSet, Pose, nodal::ContactRow};
use dynamics::SideLoads;
use ltca::{StaticModel, StaticPosition};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use reduction::ElasticGear;

use scene::{FieldName, Scene};

use super::{Encoding, Field, PvdEntry, write_pvd, write_vtu};
use crate::ExportError;
use store::{ResultFiles, StoreError};

/// Writes the files of the positions that the scene asks for.
pub struct FieldWriter<'a> {
    scene: &'a Scene,
    results: &'a dyn ResultFiles,
    entries: Vec<PvdEntry>,
}

impl<'a> FieldWriter<'a> {
    /// No position yet.
    pub fn new(scene: &'a Scene, results: &'a dyn ResultFiles) -> Self {
        Self { scene, results, entries: Vec::new() }
    }

    /// Whether a position or row is due.
    pub fn is_due(&self, index: usize) -> bool {
        let output = &self.scene.output;
        output.vtu && index.is_multiple_of(output.vtu_every.max(1) as usize)
    }

    /// The files of one position at rest, if it is due.
    ///
    /// # Errors
    /// When a field does not come out, or the system refuses.
    pub fn position(
        &mut self,
        index: usize,
        position: &StaticPosition,
        model: &StaticModel,
    ) -> Result<(), ExportError> {
        if !self.is_due(index) {
            return Ok(());
        }
        let first = -PI / f64::from(self.scene.pinion.teeth);
        let time_s = (position.pinion_angle - first) / self.scene.pinion_speed().max(f64::MIN_POSITIVE);
        self.files(index, time_s, model.gears(), |part| GearState::at_rest(part, position, model))
    }

    /// The files of one row of a motion.
    ///
    /// # Errors
    /// When a field does not come out, or the system refuses.
    pub fn row(&mut self, index: usize, time_s: f64, sides: &[SideLoads<'_>]) -> Result<(), ExportError> {
        let Some(driving) = sides.first() else { return Ok(()) };
        self.files(index, time_s, driving.gears, |part| GearState::in_motion(part, sides))
    }

    fn files<'g>(
        &mut self,
        index: usize,
        time_s: f64,
        gears: &[ElasticGear; 2],
        state: impl Fn(usize) -> Result<GearState<'g>, ExportError>,
    ) -> Result<(), ExportError> {
        for (part, name) in ["pinion", "wheel"].into_iter().enumerate() {
            let file = format!("{name}_{index:05}.vtu");
            let mut out = self.results.create(&file)?;
            // What is held back is a part of the file, too: when it is let go nobody hears of a full disk.
            self.gear(&gears[part], &state(part)?, &mut out)?
                .and_then(|()| out.flush())
                .map_err(|cause| StoreError::Write { file: file.clone().into(), cause })?;
            self.entries.push(PvdEntry { time_s, part, file });
        }
        Ok(())
    }

    /// The series, when there is one.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn finish(&mut self) -> Result<(), ExportError> {
        if self.entries.is_empty() {
            return Ok(());
        }
        Ok(self.results.write("gears.pvd", write_pvd(&self.entries).as_bytes())?)
    }

    fn gear(
        &self,
        elastic: &ElasticGear,
        state: &GearState<'_>,
        out: &mut impl std::io::Write,
    ) -> Result<std::io::Result<()>, ExportError> {
        let mesh = elastic.gear().mesh();
        let nodes: Vec<[f64; 3]> = mesh.nodes.iter().map(|&p| state.place(p)).collect();
        let mut values: Vec<(&str, usize, Vec<f64>)> = Vec::new();
        for field in &self.scene.output.fields {
            match field {
                FieldName::Displacement => {
                    let turned = state.displacement.iter().flat_map(|&u| state.turn(u));
                    values.push(("displacement_mm", 3, turned.collect()));
                }
                FieldName::Pressure => values.push(("contact_pressure_mpa", 1, state.pressure.clone())),
                FieldName::Stress => {
                    let stress = fem::nodal_stress(mesh, elastic.material(), state.elements, &state.displacement)?;
                    values.push(("von_mises_mpa", 1, stress.iter().map(fem::von_mises).collect()));
                    values.push(("max_principal_mpa", 1, stress.iter().map(fem::max_principal).collect()));
                    values.push(("stress_mpa", 6, stress.iter().flat_map(|s| state.turn_tensor(s)).collect()));
                }
            }
        }
        let fields: Vec<Field<'_>> =
            values.iter().map(|(name, components, values)| Field { name, components: *components, values }).collect();
        Ok(write_vtu(out, &nodes, &mesh.blocks, &fields, &[], Encoding::Zlib))
    }
}

/// One gear at a solved position, in its own frame, and the turn to where it stands.
struct GearState<'a> {
    /// mm, every node.
    displacement: Vec<[f64; 3]>,
    /// MPa, every node; zero off the flanks.
    pressure: Vec<f64>,
    rotation: Rotation3<f64>,
    centre: Vector3<f64>,
    elements: &'a fem::ElementOptions,
}

/// What presses on the flanks of a window.
struct FlankLoads<'a> {
    gears: &'a [ElasticGear; 2],
    set: &'a ContactSet,
    poses: &'a [Pose; 2],
    rows: &'a [ContactRow],
    forces: &'a [f64],
}

impl<'a> GearState<'a> {
    fn at_rest(part: usize, position: &StaticPosition, model: &'a StaticModel) -> Result<Self, ExportError> {
        static PLAIN: std::sync::LazyLock<fem::ElementOptions> = std::sync::LazyLock::new(fem::ElementOptions::default);
        let (gears, set) = (model.gears(), model.contact_set());
        if let Some(e) = model.last() {
            let (poses, rows, forces) = (&e.poses, &e.rows[..], &e.solution.forces[..]);
            let loads = FlankLoads { gears, set, poses, rows, forces };
            return Self::loaded(part, &loads, &e.displacements_on(set)[part]);
        }
        // Without torque nothing is deformed, and the gears stand as the geometry says.
        let count = gears[part].gear().mesh().nodes.len();
        let (pair, options) = (model.pair(), model.options());
        let turned = pair.middle_angle(options.side()) + options.contact.sense.sign() as f64 * position.pinion_angle;
        let angle = if part == 0 { turned } else { pair.wheel_angle(options.side(), turned) };
        Ok(Self {
            displacement: vec![[0.0; 3]; count],
            pressure: vec![0.0; count],
            rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), angle),
            centre: if part == 0 {
                Vector3::zeros()
            } else {
                Vector3::new(pair.centre_distance(), 0.0, pair.mid_face_offset())
            },
            elements: &PLAIN,
        })
    }

    /// Under the loads of all sides together: what they do to a gear adds up.
    fn in_motion(part: usize, sides: &'a [SideLoads<'a>]) -> Result<Self, ExportError> {
        let mut all: Option<Self> = None;
        for SideLoads { gears, set, poses, rows, forces } in sides {
            let boundary = set.displacements_under(rows, forces).ok_or(ExportError::NoWindow)?;
            let loads = FlankLoads { gears, set, poses, rows, forces };
            let own = Self::loaded(part, &loads, &boundary[part])?;
            match &mut all {
                None => all = Some(own),
                Some(all) => {
                    let both = all.displacement.iter_mut().zip(&own.displacement);
                    both.for_each(|(u, v)| (0..3).for_each(|k| u[k] += v[k]));
                    all.pressure.iter_mut().zip(&own.pressure).for_each(|(p, q)| *p += q);
                }
            }
        }
        all.ok_or(ExportError::NoWindow)
    }

    /// Under the loads of a window that displace its boundary by `boundary` (mm).
    fn loaded(part: usize, loads: &FlankLoads<'a>, boundary: &[f64]) -> Result<Self, ExportError> {
        let elastic = &loads.gears[part];
        let (displacement, nodes, frame, elements) = match (elastic, loads.set.windows()) {
            (ElasticGear::Reduced(r), Some(windows)) => {
                let window = &windows[part];
                let field = r.expand(window, boundary)?;
                (field, r.material_nodes(window), r.frame_angle(window), r.elements())
            }
            (ElasticGear::Full(f), _) => {
                let field = f.dofs.to_nodes(boundary)?;
                (field, f.dofs.free_nodes().to_vec(), 0.0, &f.elements)
            }
            (ElasticGear::Reduced(_), None) => return Err(ExportError::NoWindow),
        };
        // The pose is that of the window's frame; the gear's own frame is turned back by the frame's angle.
        let own = loads.poses[part].rotation * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -frame);
        Ok(Self {
            displacement,
            pressure: nodal_pressure(part, loads, &nodes, elastic.gear().mesh().nodes.len()),
            rotation: own.to_rotation_matrix(),
            centre: loads.poses[part].translation.vector,
            elements,
        })
    }

    fn place(&self, point: [f64; 3]) -> [f64; 3] {
        (self.rotation * Vector3::from(point) + self.centre).into()
    }

    fn turn(&self, vector: [f64; 3]) -> [f64; 3] {
        (self.rotation * Vector3::from(vector)).into()
    }

    /// R s R'; from xx, yy, zz, xy, yz, zx to ParaView's XX, YY, ZZ, XY, YZ, XZ (the same order).
    fn turn_tensor(&self, s: &[f64; 6]) -> [f64; 6] {
        let full = nalgebra::Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
        let t = self.rotation.matrix() * full * self.rotation.matrix().transpose();
        [t[(0, 0)], t[(1, 1)], t[(2, 2)], t[(0, 1)], t[(1, 2)], t[(0, 2)]]
    }
}

/// Contact pressure at every node of the mesh; zero off the flanks.
fn nodal_pressure(part: usize, loads: &FlankLoads<'_>, nodes: &[u32], count: usize) -> Vec<f64> {
    let mut all = vec![0.0; count];
    let patches = &loads.set.patches()[part];
    for (node, pressure) in contact::line::nodal_pressures(patches, part, loads.rows, loads.forces) {
        if let Some(&node) = nodes.get(node as usize) {
            all[node as usize] = pressure;
        }
    }
    all
}
