//! ParaView files of a run: displacement, contact pressure and stress on both gears, where they stand.

use std::f64::consts::PI;

use ltca::{Equilibrium, StaticModel, StaticPosition};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use reduction::ElasticGear;

use scene::{FieldName, Scene};

use super::{Encoding, Field, PvdEntry, write_pvd, write_vtu};
use crate::{ReportError, ResultFiles};

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

    /// The files of one position, if it is due.
    ///
    /// # Errors
    /// When a field does not come out, or the system refuses.
    pub fn position(
        &mut self,
        index: usize,
        position: &StaticPosition,
        model: &StaticModel,
    ) -> Result<(), ReportError> {
        let output = &self.scene.output;
        if !output.vtu || !index.is_multiple_of(output.vtu_every.max(1) as usize) {
            return Ok(());
        }
        let first = -PI / f64::from(self.scene.pinion.teeth);
        let time_s = (position.pinion_angle - first) / self.scene.pinion_speed().max(f64::MIN_POSITIVE);
        for (part, name) in ["pinion", "wheel"].into_iter().enumerate() {
            let file = format!("{name}_{index:05}.vtu");
            let mut out = self.results.create(&file)?;
            self.gear(part, position, model, &mut out)?
                .map_err(|cause| ReportError::Write { file: file.clone().into(), cause })?;
            self.entries.push(PvdEntry { time_s, part, file });
        }
        Ok(())
    }

    /// The series, when there is one.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn finish(&mut self) -> Result<(), ReportError> {
        if self.entries.is_empty() {
            return Ok(());
        }
        self.results.write("gears.pvd", write_pvd(&self.entries).as_bytes())
    }

    fn gear(
        &self,
        part: usize,
        position: &StaticPosition,
        model: &StaticModel,
        out: &mut impl std::io::Write,
    ) -> Result<std::io::Result<()>, ReportError> {
        let elastic = &model.gears()[part];
        let gear = elastic.gear();
        let mesh = gear.mesh();
        let state = GearState::new(part, position, model)?;
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

impl<'a> GearState<'a> {
    fn new(part: usize, position: &StaticPosition, model: &'a StaticModel) -> Result<Self, ReportError> {
        static PLAIN: std::sync::LazyLock<fem::ElementOptions> = std::sync::LazyLock::new(fem::ElementOptions::default);
        let elastic = &model.gears()[part];
        let count = elastic.gear().mesh().nodes.len();
        let Some(e) = model.last() else {
            // Without torque nothing is deformed, and the gears stand as the geometry says.
            let (pair, options) = (model.pair(), model.options());
            let turned =
                pair.middle_angle(options.side()) + options.contact.sense.sign() as f64 * position.pinion_angle;
            let angle = if part == 0 { turned } else { pair.wheel_angle(options.side(), turned) };
            return Ok(Self {
                displacement: vec![[0.0; 3]; count],
                pressure: vec![0.0; count],
                rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), angle),
                centre: Vector3::new(if part == 0 { 0.0 } else { model.pair().centre_distance() }, 0.0, 0.0),
                elements: &PLAIN,
            });
        };
        let boundary = &e.displacements_on(model.contact_set())[part];
        let (displacement, nodes, frame, elements) = match (elastic, model.contact_set().windows()) {
            (ElasticGear::Reduced(r), Some(windows)) => {
                let window = &windows[part];
                let field = r.expand(window, boundary)?;
                (field, r.material_nodes(window), r.frame_angle(window), r.elements())
            }
            (ElasticGear::Full(f), _) => {
                let field = f.dofs.to_nodes(boundary)?;
                (field, f.dofs.free_nodes().to_vec(), 0.0, &f.elements)
            }
            (ElasticGear::Reduced(_), None) => return Err(ReportError::NoWindow),
        };
        // The pose is that of the window's frame; the gear's own frame is turned back by the frame's angle.
        let own = e.poses[part].rotation * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -frame);
        Ok(Self {
            displacement,
            pressure: nodal_pressure(part, model, e, &nodes, count),
            rotation: own.to_rotation_matrix(),
            centre: e.poses[part].translation.vector,
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
fn nodal_pressure(part: usize, model: &StaticModel, e: &Equilibrium, nodes: &[u32], count: usize) -> Vec<f64> {
    let mut all = vec![0.0; count];
    let patches = &model.contact_set().patches()[part];
    for (node, pressure) in contact::nodal_pressures(patches, part, &e.rows, &e.solution.forces) {
        if let Some(&node) = nodes.get(node as usize) {
            all[node as usize] = pressure;
        }
    }
    all
}
