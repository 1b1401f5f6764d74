//! A spur gear's mesh in plane strain: the coarse bulk of the slice formula.

use std::collections::HashMap;

use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Integration, Material, SymmetricMatrix};
use geometry::{Gear, Side};
use mesh::{Extent, Mesh, StructuredOptions};

/// One layer of hex20, its nodes folded onto the section: exact plane strain per mm of face width.
pub struct PlaneGear<'a> {
    gear: &'a Gear,
    mesh: Mesh,
    /// Node of the section under each mesh node.
    section: Vec<usize>,
    points: Vec<[f64; 2]>,
    stiffness: Vec<(usize, usize, f64)>,
}

/// A contact point on a left flank.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub tooth: i64,
    pub roll: f64,
}

impl<'a> PlaneGear<'a> {
    /// A sector of five teeth with `along` elements along the flank, `fillet`, `across` and `rim` elsewhere; the gear
    /// is 1 mm wide.
    pub fn new(gear: &'a Gear, material: &Material, [along, fillet, across, rim]: [u32; 4]) -> Self {
        let options = StructuredOptions {
            order: 2,
            elements_profile: along,
            elements_fillet: fillet,
            elements_thickness: across,
            elements_face: 1,
            elements_rim: rim,
            extent: Extent::Sector(5),
        };
        let mesh = mesh::generate(gear, &options).unwrap();
        let mut number = HashMap::new();
        let mut points = Vec::new();
        let section: Vec<usize> = mesh
            .nodes
            .iter()
            .map(|p| {
                let key = [0, 1].map(|k| (p[k] * 1e7).round() as i64);
                *number.entry(key).or_insert_with(|| {
                    points.push([p[0], p[1]]);
                    points.len() - 1
                })
            })
            .collect();
        let dofs = DofMap::new(mesh.nodes.len(), &[]);
        let elements = ElementOptions { integration: Integration::Full, ..ElementOptions::default() };
        let k = fem::assemble_stiffness(&mesh, material, &dofs, &elements).unwrap();
        let width = gear.face_width();
        let fold = |dof: usize| (dof % 3 < 2).then(|| 2 * section[dof / 3] + dof % 3);
        let mut stiffness = Vec::new();
        for (i, j, v) in k.entries() {
            let (Some(a), Some(b)) = (fold(i), fold(j)) else { continue };
            stiffness.push((a.max(b), a.min(b), v / width));
            if i != j && a == b {
                stiffness.push((a, a, v / width));
            }
        }
        Self { gear, mesh, section, points, stiffness }
    }

    /// Normal compliance (mm^2/N) between places when the nodes with `held` do not move.
    fn compliance(&self, places: &[Place], held: impl Fn([f64; 2]) -> bool) -> Mat<f64> {
        let mut count = 0;
        let row: Vec<Option<usize>> = self
            .points
            .iter()
            .map(|&p| {
                (!held(p)).then(|| {
                    count += 2;
                    count - 2
                })
            })
            .collect();
        let at = |dof: usize| row[dof / 2].map(|r| r + dof % 2);
        let kept: Vec<_> = self.stiffness.iter().filter_map(|&(i, j, v)| Some((at(i)?, at(j)?, v))).collect();
        let factor = BoundaryLastFactor::new(&SymmetricMatrix::from_triplets(count, &kept).unwrap(), &[]).unwrap();
        let mut loads = Mat::<f64>::zeros(count, places.len());
        for (column, place) in places.iter().enumerate() {
            for (node, force) in self.support(place) {
                if let Some(r) = row[node] {
                    loads[(r, column)] += force[0];
                    loads[(r + 1, column)] += force[1];
                }
            }
        }
        let mut answer = loads.clone();
        factor.solve(answer.as_mut()).unwrap();
        loads.transpose() * answer
    }

    /// W: bore held, cuts free.
    pub fn whole(&self, places: &[Place]) -> Mat<f64> {
        let bore = 0.5 * self.gear.data().bore_diameter + 1e-6;
        self.compliance(places, |[x, y]| x.hypot(y) < bore)
    }

    /// W_c of one place: all held but the half tooth behind it.
    pub fn half_tooth(&self, place: Place) -> f64 {
        let centre = place.tooth as f64 * self.gear.pitch_angle();
        let (root, half_pitch) = (self.gear.root_radius() + 1e-6, 0.5 * self.gear.pitch_angle());
        self.compliance(&[place], |[x, y]| {
            let angle = y.atan2(x) - centre;
            !(x.hypot(y) > root && angle > 1e-7 && angle < half_pitch)
        })[(0, 0)]
    }

    /// Shape functions of the flank's element at a place, times the direction into the material.
    fn support(&self, place: &Place) -> Vec<(usize, [f64; 2])> {
        let flank = self.gear.flank_of(Side::Left, place.tooth);
        let faces = &self.mesh.surface(&format!("flank_left_{}", place.tooth)).unwrap().faces;
        let base = self.gear.base_radius();
        let arc = |p: [f64; 2]| 0.5 * base * ((p[0].hypot(p[1]) / base).powi(2) - 1.0);
        let mut nodes: Vec<usize> = faces.iter().flat_map(|f| f.nodes()).map(|&n| self.section[n as usize]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.sort_by(|&a, &b| arc(self.points[a]).total_cmp(&arc(self.points[b])));
        let at = 0.5 * base * place.roll * place.roll;
        let e =
            (0..nodes.len() - 3).step_by(2).find(|&e| at <= arc(self.points[nodes[e + 2]])).unwrap_or(nodes.len() - 3);
        let ends = [nodes[e], nodes[e + 2]].map(|n| arc(self.points[n]));
        let xi = 2.0 * (at - ends[0]) / (ends[1] - ends[0]) - 1.0;
        let n = [0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)];
        // Left flank: the outward normal is the tangent to the base circle, counter-clockwise.
        let turn = flank.centre_angle + flank.base_half_angle - place.roll;
        let inward = [turn.sin(), -turn.cos()];
        (0..3).map(|i| (nodes[e + i], inward.map(|d| n[i] * d))).collect()
    }
}
