//! Finds flanks in a mesh without named flanks by fitting the involute helicoids of the expected gear.

use std::collections::BTreeMap;

use geometry::{Flank, Gear, Side, Vec3};

use crate::{Face, FaceTable, GroupNames, Mesh, MeshError, MeshedGear, SurfaceGroup};

/// Default tolerance for the distance of nodes from their flank, in modules: more than any micro-geometry, far less
/// than a tooth.
pub const DEFAULT_TOLERANCE_MODULES: f64 = 0.01;

/// Least cosine between the normals of face and helicoid (30 deg).
const LEAST_COSINE: f64 = 0.866;

/// Least part of a flank's area that must be found for the fit to count.
const LEAST_COVERAGE: f64 = 0.5;

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankFit {
    /// The mesh with its parts; tooth 0 is on +x.
    pub gear: MeshedGear,
    /// Angle by which the mesh was rotated, rad; the mesh has been rotated back by it. 0 if within the tolerance.
    pub phase: f64,
    /// Tolerance for the distance of a node from a flank, mm.
    pub tolerance: f64,
    /// Deviations of all flanks that were found, by tooth and side.
    pub flanks: Vec<FlankDeviation>,
}

/// Deviation of the nodes of one flank from its helicoid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankDeviation {
    /// Tooth, 0..z.
    pub tooth: u32,
    /// Side of the tooth.
    pub side: Side,
    /// Number of faces.
    pub faces: usize,
    /// Root mean square distance of the nodes, mm.
    pub rms: f64,
    /// Largest distance of a node, mm.
    pub largest: f64,
    /// Share of the flank's area between form circle and tip circle that the faces cover.
    pub coverage: f64,
}

impl MeshedGear {
    /// Finds the parts of `gear` in a mesh. If any flank is named, the names are used; otherwise the helicoids are
    /// fitted with the default tolerance, and the [`FlankFit`] is returned as well.
    ///
    /// # Errors
    /// The errors of [`MeshedGear::from_groups`] and [`FlankFit::new`].
    pub fn find(mesh: Mesh, gear: &Gear, names: &GroupNames) -> Result<(Self, Option<FlankFit>), MeshError> {
        names.check()?;
        if mesh.surfaces.iter().any(|s| names.parse(&s.name).is_some()) {
            let own = Self::from_groups(mesh, names, gear.teeth())?;
            return Ok((own.numbered(gear.is_internal()), None));
        }
        let tolerance = DEFAULT_TOLERANCE_MODULES * gear.data().normal_module;
        let fit = FlankFit::new(mesh, gear, names, tolerance)?;
        Ok((fit.gear.clone(), Some(fit)))
    }
}

impl FlankFit {
    /// Finds the flanks of `gear` in a mesh.
    ///
    /// A boundary face belongs to the flank of tooth k if all its nodes lie within `tolerance` (mm) of that helicoid,
    /// between form circle and tip circle, and if its normal agrees within 30 deg. The bore is the group of that name,
    /// otherwise the boundary faces on the bore cylinder. Cuts are found only by their groups. If the mesh is rotated
    /// about z, the angle is determined (the one at which most nodes lie on left and on right flanks) and the mesh is
    /// rotated back.
    ///
    /// # Errors
    /// [`MeshError::NoFlanks`], [`MeshError::ToothThickness`], [`MeshError::MidFace`], [`MeshError::NoBore`] if the
    /// mesh is not a mesh of this gear; errors of named groups as in [`MeshedGear::from_groups`].
    pub fn new(mut mesh: Mesh, gear: &Gear, names: &GroupNames, tolerance: f64) -> Result<Self, MeshError> {
        check_mid_face(&mesh, tolerance)?;
        let table = FaceTable::new(&mesh);
        let boundary: Vec<Face> = table.boundary().iter().map(|o| o.face(&mesh)).collect();

        let angles = [Side::Left, Side::Right].map(|side| peak(&mesh, &boundary, gear, side, tolerance));
        let [Some(left), Some(right)] = angles else {
            return Err(MeshError::NoFlanks { coverage: 0.0, tolerance_mm: tolerance });
        };
        // A turned mesh moves both sides alike, a thicker tooth apart.
        let flank = gear.flank(Side::Left);
        let arm = flank.base_radius * flank.base_helix_angle.cos();
        let apart = fold(left - right, gear.pitch_angle());
        let mut phase = fold(right + 0.5 * apart, gear.pitch_angle());
        if (arm * apart).abs() > 2.0 * tolerance {
            let turned = Self::coverage_of(&mesh, &boundary, gear, left, Side::Left, tolerance);
            if turned < LEAST_COVERAGE {
                return Err(MeshError::NoFlanks { coverage: turned, tolerance_mm: tolerance });
            }
            return Err(MeshError::ToothThickness { thicker_mm: arm * apart });
        }
        if (phase * gear.tip_radius()).abs() <= tolerance {
            phase = 0.0;
        } else {
            turn(&mut mesh, -phase);
        }

        let found = classify(&mesh, &boundary, gear, 0.0, &[Side::Left, Side::Right], tolerance);
        let coverage = mean_coverage(&found);
        if coverage < LEAST_COVERAGE {
            return Err(MeshError::NoFlanks { coverage, tolerance_mm: tolerance });
        }
        let bore = bore(&mesh, &boundary, gear, names, &table, tolerance)?;
        let cuts = MeshedGear::find_cuts(&mesh, names, &table)?;
        let flanks = found.iter().map(|(&(tooth, side), f)| f.deviation(tooth, side)).collect();
        let faces = found.into_iter().map(|(key, f)| (key, f.faces)).collect();
        let own = MeshedGear::from_parts(mesh, gear.teeth(), bore, faces, cuts).numbered(gear.is_internal());
        Ok(Self { gear: own, phase, tolerance, flanks })
    }

    fn coverage_of(mesh: &Mesh, boundary: &[Face], gear: &Gear, phase: f64, side: Side, tolerance: f64) -> f64 {
        mean_coverage(&classify(mesh, boundary, gear, phase, &[side], tolerance))
    }

    /// Largest distance of any flank node from its helicoid, mm.
    pub fn largest_deviation(&self) -> f64 {
        self.flanks.iter().map(|f| f.largest).fold(0.0, f64::max)
    }
}

/// Faces of one flank and how its nodes lie.
#[derive(Debug, Default)]
struct FlankFaces {
    faces: Vec<Face>,
    squares: f64,
    nodes: usize,
    largest: f64,
    area: f64,
    nominal_area: f64,
}

type Flanks = BTreeMap<(u32, Side), FlankFaces>;

impl FlankFaces {
    fn deviation(&self, tooth: u32, side: Side) -> FlankDeviation {
        FlankDeviation {
            tooth,
            side,
            faces: self.faces.len(),
            rms: (self.squares / self.nodes.max(1) as f64).sqrt(),
            largest: self.largest,
            coverage: self.area / self.nominal_area,
        }
    }
}

fn mean_coverage(found: &Flanks) -> f64 {
    found.values().fold(0.0, |sum, f| sum + f.area / f.nominal_area) / found.len().max(1) as f64
}

fn at(mesh: &Mesh, node: u32) -> Vec3 {
    Vec3::from(mesh.nodes[node as usize])
}

/// Angle modulo `period`, the nearest to 0.
fn fold(angle: f64, period: f64) -> f64 {
    angle - period * (angle / period).round()
}

/// The gear's mid-face is at z = 0; an offset of a helical gear would look like a turn.
fn check_mid_face(mesh: &Mesh, tolerance: f64) -> Result<(), MeshError> {
    let range = mesh.nodes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x[2]), h.max(x[2])));
    let middle = 0.5 * (range.0 + range.1);
    if middle.abs() > tolerance { Err(MeshError::MidFace { z_mm: middle }) } else { Ok(()) }
}

/// Turns a mesh about z.
fn turn(mesh: &mut Mesh, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    for x in &mut mesh.nodes {
        [x[0], x[1]] = [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]];
    }
}

/// Whether a radius belongs to the active flank.
fn is_active(p: &Vec3, gear: &Gear, tolerance: f64) -> bool {
    let r = gear.sign() * p.x.hypot(p.y);
    r >= gear.form_radius() - tolerance && r <= gear.tip_radius() + tolerance
}

/// Angle about z from tooth 0's flank to the flank of the same side through `p`; the helicoid turned by it holds `p`.
fn angle_from(flank: &Flank, p: &Vec3) -> Option<f64> {
    let arm = flank.base_radius * flank.base_helix_angle.cos();
    Some(flank.side.sign() * flank.locate(p)?.distance / arm)
}

/// The angle, within one pitch, at which most boundary nodes lie on flanks of one side.
///
/// Nodes of these flanks share one angle, those of all other surfaces scatter over the pitch.
fn peak(mesh: &Mesh, boundary: &[Face], gear: &Gear, side: Side, tolerance: f64) -> Option<f64> {
    let flank = gear.flank(side);
    let pitch = gear.pitch_angle().abs();
    let window = 2.0 * tolerance / (flank.base_radius.abs() * flank.base_helix_angle.cos());
    let mut nodes: Vec<u32> = boundary.iter().flat_map(|f| f.nodes().iter().copied()).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let mut angles: Vec<f64> = nodes
        .iter()
        .map(|&n| at(mesh, n))
        .filter(|p| is_active(p, gear, tolerance))
        .filter_map(|p| angle_from(&flank, &p))
        .map(|a| a.rem_euclid(pitch))
        .filter(|a| a.is_finite())
        .collect();
    angles.sort_unstable_by(f64::total_cmp);
    let count = angles.len();
    // Around the pitch: what lies near its end goes on at its start.
    let around: Vec<f64> = angles.iter().copied().chain(angles.iter().map(|a| a + pitch)).collect();
    let mut best = (0, 0, 0);
    let mut end = 0;
    for start in 0..count {
        while end < around.len() && end < start + count && around[end] - around[start] <= window {
            end += 1;
        }
        if end - start > best.0 {
            best = (end - start, start, end);
        }
    }
    let (crowd, start, end) = best;
    // The middle one is not moved by a few strays.
    (crowd > 0).then(|| fold(around[start + (end - start) / 2], pitch))
}

/// Boundary faces by flank, for a mesh turned by `phase`.
fn classify(mesh: &Mesh, boundary: &[Face], gear: &Gear, phase: f64, sides: &[Side], tolerance: f64) -> Flanks {
    let pitch = gear.pitch_angle();
    let teeth = i64::from(gear.teeth());
    let mut found = Flanks::new();
    for &side in sides {
        let flank = gear.flank(side);
        let cos_b = flank.base_helix_angle.cos();
        let arm = flank.base_radius * cos_b;
        // |dP/du x dP/dz| = r_b u / cos(b_b)
        let nominal_area =
            0.5 * flank.base_radius / cos_b * (flank.roll_tip.powi(2) - flank.roll_form.powi(2)) * gear.face_width();
        for face in boundary {
            let points = face.nodes().iter().map(|&n| at(mesh, n));
            let mut tooth = None;
            let (mut squares, mut largest) = (0.0, 0.0_f64);
            let on_flank = points.into_iter().all(|p| {
                if !is_active(&p, gear, tolerance) || p.z.abs() > flank.half_width + tolerance {
                    return false;
                }
                let Some(angle) = angle_from(&flank, &p) else { return false };
                let number = ((angle - phase) / pitch).round();
                let distance = arm * (angle - phase - number * pitch);
                let number = (number as i64).rem_euclid(teeth) as u32;
                squares += distance * distance;
                largest = largest.max(distance.abs());
                distance.abs() <= tolerance && *tooth.get_or_insert(number) == number
            });
            let (true, Some(tooth)) = (on_flank, tooth) else { continue };
            let (centre, area) = centre_and_area(mesh, face);
            let own = gear.flank_of(side, i64::from(tooth));
            let back = nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), -phase);
            let agrees = own
                .locate(&(back * centre))
                .is_some_and(|foot| (back * area).dot(&own.normal(foot.roll, foot.z)) >= LEAST_COSINE * area.norm());
            if agrees {
                let entry = found.entry((tooth, side)).or_default();
                entry.faces.push(*face);
                entry.squares += squares;
                entry.nodes += face.nodes().len();
                entry.largest = entry.largest.max(largest);
                entry.area += area.norm();
                entry.nominal_area = nominal_area;
            }
        }
    }
    found
}

/// Centre of the corners and vector area of a face, mm and mm^2.
pub(crate) fn centre_and_area(mesh: &Mesh, face: &Face) -> (Vec3, Vec3) {
    let corners = face.corners();
    let centre = corners.iter().map(|&n| at(mesh, n)).sum::<Vec3>() / corners.len() as f64;
    let around = corners.iter().zip(corners.iter().cycle().skip(1));
    let area = around.map(|(&a, &b)| 0.5 * (at(mesh, a) - centre).cross(&(at(mesh, b) - centre))).sum();
    (centre, area)
}

/// The bore by its group, or by its radius.
fn bore(
    mesh: &Mesh,
    boundary: &[Face],
    gear: &Gear,
    names: &GroupNames,
    table: &FaceTable,
    tolerance: f64,
) -> Result<SurfaceGroup, MeshError> {
    if mesh.surface(&names.bore).is_some() {
        return MeshedGear::find_group(mesh, &names.bore, table);
    }
    let wanted = 0.5 * gear.data().bore_diameter.abs();
    let radius = |n: u32| at(mesh, n).xy().norm();
    let on_bore = |f: &&Face| f.nodes().iter().all(|&n| (radius(n) - wanted).abs() <= tolerance);
    let faces: Vec<Face> = boundary.iter().filter(on_bore).copied().collect();
    if faces.is_empty() {
        let radii = (0..mesh.nodes.len() as u32).map(radius);
        let found = if gear.is_internal() { radii.fold(0.0, f64::max) } else { radii.fold(f64::INFINITY, f64::min) };
        return Err(MeshError::NoBore { wanted_mm: wanted, found_mm: found });
    }
    Ok(SurfaceGroup { name: names.bore.clone(), faces })
}
