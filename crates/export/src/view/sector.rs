//! One tooth as a surface of triangles.

use std::f64::consts::PI;

use geometry::Gear;

/// Steps along the involute, along the fillet, and along the face of a helical gear.
const INVOLUTE: usize = 8;
const FILLET: usize = 6;
const FACE: usize = 8;

/// Points (mm) and the corners of triangles, counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surface {
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Tooth 0 of a gear with its share of the body, from the middle of one tooth space to that of the next: flanks,
    /// fillets, tip, root land, end faces and bore, without micro-geometry.
    pub(super) fn of_tooth(gear: &Gear) -> Self {
        let outline = outline(gear);
        let bore = 0.5 * gear.data().bore_diameter;
        let steps = if gear.twist() == 0.0 { 1 } else { FACE };
        let (n, half) = (outline.len() as u32, 0.5 * gear.face_width());
        let height = |j: usize| half * (2.0 * j as f64 / steps as f64 - 1.0);
        let ring = |z: f64, radius: Option<f64>| {
            outline.iter().map(move |&(r, angle)| {
                // The section of a ring's tooth is on the side of -x.
                let section = if gear.is_internal() { PI } else { 0.0 };
                let (sin, cos) = (section + angle + gear.twist() * z).sin_cos();
                let r = radius.unwrap_or(r);
                [r * cos, r * sin, z]
            })
        };
        let mut points: Vec<[f64; 3]> = (0..=steps).flat_map(|j| ring(height(j), None)).collect();
        points.extend([-half, half].into_iter().flat_map(|z| ring(z, Some(bore))));
        let mut triangles = Vec::new();
        // Between two rings, to the outside when the second one lies above the first.
        let mut strip = |low: u32, high: u32| {
            for i in 0..n - 1 {
                let [a, b, c, d] = [low + i, low + i + 1, high + i + 1, high + i];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        };
        let steps = steps as u32;
        (0..steps).for_each(|j| strip(j * n, (j + 1) * n));
        let inner = (steps + 1) * n;
        strip(steps * n, inner + n);
        strip(inner, 0);
        strip(inner + n, inner);
        Self { points, triangles }
    }
}

/// Radius (mm) and angle (rad) along the transverse section of tooth 0, counter-clockwise; of a ring as [`geometry::TransverseProfile`] has them, negative, and on the side of -x.
pub fn outline(gear: &Gear) -> Vec<(f64, f64)> {
    let profile = gear.profile();
    let involute = (0..=INVOLUTE).map(|i| {
        let u = profile.roll_tip() + (profile.roll_form() - profile.roll_tip()) * i as f64 / INVOLUTE as f64;
        (gear.base_radius() * u.hypot(1.0), profile.base_half_angle() - (u - u.atan()))
    });
    let fillet = (0..FILLET).rev().map(|i| profile.fillet(i as f64 / FILLET as f64));
    let mut half: Vec<(f64, f64)> = involute.chain(fillet).collect();
    half.push((gear.root_radius(), PI / gear.signed_teeth()));
    let mirrored = half.iter().rev().map(|&(r, angle)| (r, -angle));
    let middle = [(gear.tip_radius(), 0.0)];
    mirrored.chain(middle).chain(half.iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::GearData;

    /// Volume inside of all teeth together, by the divergence theorem, is that of the body: the surface is closed but
    /// for the cuts, which neighbours share, and its normals point outwards.
    #[test]
    fn teeth_close_to_a_body() {
        for helix_angle in [0.0, 0.35] {
            let gear = Gear::new(GearData { helix_angle, ..GearData::default() }).unwrap();
            let Surface { points, triangles } = Surface::of_tooth(&gear);
            let flux: f64 = triangles
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|n| geometry::Vec3::from(points[n as usize]));
                    a.dot(&b.cross(&c)) / 6.0
                })
                .sum();
            let z = f64::from(gear.teeth());
            let bore = 0.5 * gear.data().bore_diameter;
            let disc = |r: f64| PI * (r * r - bore * bore) * gear.face_width() / z;
            let (least, most) = (disc(gear.root_radius()), disc(gear.tip_radius()));
            assert!(least < flux && flux < most, "{helix_angle} rad: {flux} mm^3 not in {least} .. {most}");
        }
    }
}
