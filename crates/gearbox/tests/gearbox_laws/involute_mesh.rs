//! A mesh as one spring between involute flanks wherever their gears stand: its energy knows no direction.

use gearbox::{GearMesh, GearboxError, MeshElement, MeshForces, Meshing, Vector12};
use nalgebra::{Rotation2, Vector2};

use crate::pairs::spring;

/// Flanks that overlap by theta_2 - theta_w of the displaced axes; axial shifts and tilts as those of a spring, whose levers
/// turn with the line of centres.
///
/// ```text
/// theta_w = psi + (s/r_2) [T - r_1 (s (theta_1 - psi) + a) - r_2 a] + constant,   cos a = (r_1 + r_2)/d,   T = d sin a
/// d theta_w/d psi = (r_1 + r_2)/r_2,   d theta_w/d d = s sin(a)/r_2        d: distance of the axes, psi: direction of their line
/// ```
struct InvoluteMesh {
    levers: [[f64; 6]; 2],
    stiffness: f64,
    radii: [f64; 2],
    /// Signed centre distance, mm.
    distance: f64,
    side: f64,
}

/// Such a mesh of each pair.
pub fn involutes(_: usize, mesh: &GearMesh, meshing: &Meshing) -> Result<Box<dyn MeshElement>, GearboxError> {
    let linear = spring(mesh, meshing);
    let pair = &mesh.pair;
    let levers = linear.levers.map(|own| std::array::from_fn(|k| own[k]));
    let radii = [&pair.pinion, &pair.wheel].map(|gear| gear.base_radius());
    let (distance, side) = (pair.centre_distance(), meshing.side().sign());
    Ok(Box::new(InvoluteMesh { levers, stiffness: linear.stiffness, radii, distance, side }))
}

impl InvoluteMesh {
    /// Wheel angle but for a constant, its slopes over the wheel's place, and the direction of the line of centres.
    fn wheel_angle(&self, pinion: f64, apart: Vector2<f64>) -> (f64, Vector2<f64>, f64) {
        let [r1, r2] = self.radii;
        let (s, sign) = (self.side, self.distance.signum());
        let place = sign * apart;
        let (size, psi) = (place.norm(), place.y.atan2(place.x));
        let a = ((r1 + r2) / (sign * size)).acos();
        let angle = psi + s / r2 * (sign * size * a.sin() - r1 * (s * (pinion - psi) + a) - r2 * a);
        let across = Vector2::new(-apart.y, apart.x) / (size * size);
        (angle, (r1 + r2) / r2 * across + s * a.sin() / r2 * sign * apart / size, psi)
    }
}

impl MeshElement for InvoluteMesh {
    fn go_to(&mut self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    fn evaluate(&mut self, d: &Vector12) -> Result<MeshForces, GearboxError> {
        let apart = Vector2::new(self.distance + d[6] - d[0], d[7] - d[1]);
        let (angle, slopes, psi) = self.wheel_angle(d[5], apart);
        let (nominal, ..) = self.wheel_angle(0.0, Vector2::new(self.distance, 0.0));
        let per_angle = self.levers[1][5];
        let mut overlap = per_angle * (d[11] - (angle - nominal));
        let mut at_wheel = -per_angle * slopes;
        let mut slope = Vector12::from_fn(|k, _| self.levers[k / 6][k % 6]);
        let turn = Rotation2::new(psi);
        for g in [0, 6] {
            let lever = turn * slope.fixed_rows::<2>(g + 3);
            slope.fixed_rows_mut::<2>(g + 3).copy_from(&lever);
            let tilt = d.fixed_rows::<2>(g + 3);
            overlap += slope[g + 2] * d[g + 2] + lever.dot(&tilt);
            let turned = lever.x * tilt[1] - lever.y * tilt[0];
            at_wheel += turned * Vector2::new(-apart.y, apart.x) / apart.norm_squared();
        }
        slope.fixed_rows_mut::<2>(6).copy_from(&at_wheel);
        slope.fixed_rows_mut::<2>(0).copy_from(&-at_wheel);
        let stiffness = if overlap > 0.0 { self.stiffness } else { 0.0 };
        let normal_force = if overlap > 0.0 { self.stiffness * overlap } else { 0.0 };
        Ok(MeshForces { force: -normal_force * slope, tangent: -stiffness * slope * slope.transpose(), normal_force })
    }
}
