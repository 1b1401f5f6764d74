//! What ISO 6336-1 leaves out of narrow helical gears: the axial force bends their bodies. Theory (24a), (24b).

use std::f64::consts::PI;

use geometry::{Gear, GearPair};
use nalgebra::{Matrix4, Vector4};

/// Shear correction of a plate.
const SHEAR: f64 = 5.0 / 6.0;
/// Harmonics around the gear: bending falls with their third power, shear with their first, cut off by the width of the
/// load.
const BENDING_ORDERS: u32 = 60;
const SHEAR_ORDERS: u32 = 2000;

/// Compliances that pinion and wheel add to the mesh on the transverse line of action, mm/N.
///
/// ```text
/// c_i = tan^2(b_b) w_i / F_a,   te = F_bt [1/(b c_gamma_alpha) + c_1 + c_2]
/// ```
/// F_a = F_bt tan b_b lifts the rim where the teeth mesh by w, and a tooth that deflects by w along the axis deflects
/// by w tan b_b along the line of action. The body is a plate of the face width b (`axial_compliance`), held rigidly
/// at the bore and loaded over the arc that the path of contact and half a pitch take of the working circle. Zero for
/// spur gears.
///
/// This is no part of ISO 6336-1, whose single stiffness is that of teeth on bodies which do not bend out of their
/// plane. `young` E (MPa), `poisson` nu.
pub fn body_compliance(pair: &GearPair, young: [f64; 2], poisson: [f64; 2]) -> [f64; 2] {
    let path = pair.transverse_contact_ratio() * pair.transverse_base_pitch();
    let tan = pair.base_helix_angle().tan();
    if tan == 0.0 {
        return [0.0; 2];
    }
    let gears = [&pair.pinion, &pair.wheel];
    [0, 1].map(|i| {
        let (gear, radius) = (gears[i], pair.working_radii()[i].abs());
        let half_arc = (path + 0.5 * PI * gear.transverse_module()) / (2.0 * radius);
        tan * tan * axial_compliance(gear, radius, half_arc, young[i], poisson[i])
    })
}

/// Axial deflection (mm/N) of a gear's body at `radius` (mm) under an axial force there, spread evenly over `half_arc`
/// (rad) to either side; its mean over that arc.
///
/// ```text
/// D lap lap w_b = 0,  kappa G b lap w_s = 0,   D = E b^3 / [12 (1 - nu^2)],   kappa = 5/6
/// at the bore:        w_b = dw_b/dr = w_s = 0
/// at the root circle: V_r = q,  M_r = -q (radius - r_f),  kappa G b dw_s/dr = q
/// q = F_a / (pi r_f) [1/2 + sum_n sin(n phi)/(n phi) cos(n theta)]
/// ```
/// Bending by Kirchhoff's plate and shear are added, order by order; the solutions are powers of r (and logarithms for
/// n = 0, 1). The body of a ring is clamped outside and loaded inside, where outwards is the other way: q and the lever
/// change their signs. Teeth do not stiffen the plate. `young` E (MPa), `poisson` nu. Source: S. Timoshenko, S.
/// Woinowsky-Krieger, Theory of Plates and Shells, 1959, articles 62 and 64 (general solution and edge conditions).
pub(crate) fn axial_compliance(gear: &Gear, radius: f64, half_arc: f64, young: f64, poisson: f64) -> f64 {
    let (edge, width) = (gear.root_radius().abs(), gear.face_width());
    let rigidity = young * width.powi(3) / (12.0 * (1.0 - poisson * poisson));
    let shear = SHEAR * young * width / (2.0 * (1.0 + poisson));
    let plate = Plate { clamp: 0.5 * gear.data().bore_diameter.abs() / edge, poisson };
    let lever = radius / edge - 1.0;
    let share = |n: u32, spread: f64| if n == 0 { 0.5 / PI } else { spread / PI };
    let (mut bending, mut sheared) = (0.0, 0.0);
    let mut orders = Orders::new(half_arc, plate.narrow());
    for n in 0..=SHEAR_ORDERS {
        let (spread, stiffened) = orders.next();
        if n <= BENDING_ORDERS {
            bending += share(n, spread) * plate.deflection(n, lever);
        }
        sheared += share(n, spread) * plate.sheared(n, stiffened);
    }
    bending * edge * edge / rigidity + sheared / shear
}

/// What each order n = 0, 1, .. has of the one before it: sines by addition of angles, powers by products. Round-off
/// grows as n, the series falls as n^3.
struct Orders {
    /// n.
    order: f64,
    half_arc: f64,
    /// Sine and cosine of the half arc, and of n times it.
    step: [f64; 2],
    at: [f64; 2],
    /// Inner radius squared, and its power n.
    square: f64,
    power: f64,
}

impl Orders {
    fn new(half_arc: f64, inner: f64) -> Self {
        let (sin, cos) = half_arc.sin_cos();
        Self { order: 0.0, half_arc, step: [sin, cos], at: [0.0, 1.0], square: inner * inner, power: 1.0 }
    }

    /// Of the next order, from 0 on: load over the load of a point, squared, for the arc spreads the force and averages
    /// the deflection; and n times the deflection at the edge by shear alone, under a line load of amplitude 1 and a
    /// shear stiffness of 1, of no meaning for n = 0.
    ///
    /// ```text
    /// [sin(n phi) / (n phi)]^2,   (1 - a^2n) / (1 + a^2n)
    /// ```
    fn next(&mut self) -> (f64, f64) {
        let ([s, c], [sin, cos]) = (self.at, self.step);
        let x = self.order * self.half_arc;
        let spread = if x == 0.0 { 1.0 } else { (s / x) * (s / x) };
        let stiffened = (1.0 - self.power) / (1.0 + self.power);
        self.order += 1.0;
        self.at = [s * cos + c * sin, c * cos - s * sin];
        self.power *= self.square;
        (spread, stiffened)
    }
}

/// Ring-shaped plate, clamped at radius `clamp`, inside or outside, and free at radius 1; rigidity 1.
struct Plate {
    clamp: f64,
    poisson: f64,
}

/// A solution of order n with what belongs to it, each over cos(n theta).
#[derive(Clone, Copy)]
struct Edge {
    deflection: f64,
    slope: f64,
    /// Radial bending moment M_r.
    moment: f64,
    /// Effective shear V_r.
    force: f64,
}

impl Plate {
    /// Deflection at radius 1 + `lever` under a line load of amplitude 1 there, handed on to the edge at radius 1 as
    /// force and moment.
    fn deflection(&self, n: u32, lever: f64) -> f64 {
        let outwards = if self.clamp < 1.0 { 1.0 } else { -1.0 };
        let [w, slope] = self.edge(n, outwards, -outwards * lever);
        w + slope * lever
    }

    /// Radius of the inner edge over that of the outer one.
    fn narrow(&self) -> f64 {
        self.clamp.min(self.clamp.recip())
    }

    /// Deflection and slope at the edge under the effective shear `force` and the moment `moment` there.
    fn edge(&self, n: u32, force: f64, moment: f64) -> [f64; 2] {
        let clamped = self.solutions(n, self.clamp);
        let free = self.solutions(n, 1.0);
        let conditions = Matrix4::from_fn(|row, k| match row {
            0 => clamped[k].deflection,
            1 => clamped[k].slope,
            2 => free[k].moment,
            _ => free[k].force,
        });
        // A plate without width has no answer: no number, which no check lets pass.
        let none = || Vector4::repeat(f64::NAN);
        let found = conditions.lu().solve(&Vector4::new(0.0, 0.0, moment, force)).unwrap_or_else(none);
        let sum = |of: fn(&Edge) -> f64| found.iter().zip(&free).map(|(x, e)| x * of(e)).sum();
        [sum(|e| e.deflection), sum(|e| e.slope)]
    }

    /// The four solutions of order n at radius r, each of size 1 at one of the edges.
    fn solutions(&self, n: u32, r: f64) -> [Edge; 4] {
        let ln = r.ln();
        let power = |p: i32, at: f64| {
            let (w, p) = ((r / at).powi(p), f64::from(p));
            [w, p * w / r, p * (p - 1.0) * w / (r * r), p * (p - 1.0) * (p - 2.0) * w / r.powi(3)]
        };
        let a = self.clamp;
        let order = n as i32;
        // w and its first three derivatives.
        let all = match n {
            0 => [
                [1.0, 0.0, 0.0, 0.0],
                [ln, 1.0 / r, -1.0 / (r * r), 2.0 / r.powi(3)],
                [r * r, 2.0 * r, 2.0, 0.0],
                [r * r * ln, 2.0 * r * ln + r, 2.0 * ln + 3.0, 2.0 / r],
            ],
            1 => [power(1, 1.0), power(-1, a), power(3, 1.0), [r * ln, ln + 1.0, 1.0 / r, -1.0 / (r * r)]],
            _ => [power(order, 1.0), power(-order, a), power(order + 2, 1.0), power(2 - order, a)],
        };
        let n2 = f64::from(n) * f64::from(n);
        all.map(|[w, w1, w2, w3]| {
            let turned = w1 / (r * r) - w / r.powi(3);
            let laplacian_slope = w3 + w2 / r - w1 / (r * r) - n2 * (w1 / (r * r) - 2.0 * w / r.powi(3));
            Edge {
                deflection: w,
                slope: w1,
                moment: -(w2 + self.poisson * (w1 / r - n2 * w / (r * r))),
                force: (1.0 - self.poisson) * n2 * turned - laplacian_slope,
            }
        })
    }
    /// Deflection of order n at the edge by shear alone, under a line load of amplitude 1 and a shear stiffness of 1;
    /// `stiffened` is n times it, of no meaning for n = 0.
    fn sheared(&self, n: u32, stiffened: f64) -> f64 {
        if n == 0 { -self.narrow().ln() } else { stiffened / f64::from(n) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deflection by a moment is slope by a force, order by order, also where the rim is thin: Betti.
    #[test]
    fn force_and_moment_are_reciprocal() {
        for inner in [0.1, 0.55, 0.9, 1.1, 1.5] {
            let plate = Plate { clamp: inner, poisson: 0.3 };
            for n in [0, 1, 2, 3, 7, 20, 60] {
                // M_r works on the slope with the other sign.
                let [_, slope] = plate.edge(n, 1.0, 0.0);
                let [w, _] = plate.edge(n, 0.0, -1.0);
                assert!((w / slope - 1.0).abs() < 1e-6, "{inner}, order {n}: {w}, not {slope}");
            }
        }
    }

    /// A narrow ring under an even load is a cantilever strip: w = q l^3 / 3, and with a lever as a longer one.
    #[test]
    fn narrow_rings_are_cantilevers() {
        let l = 1e-3;
        for outwards in [1.0, -1.0] {
            let plate = Plate { clamp: 1.0 - outwards * l, poisson: 0.3 };
            assert!((plate.deflection(0, 0.0) / (l.powi(3) / 3.0) - 1.0).abs() < 2e-3);
            let e = 0.5 * l;
            let strip = l.powi(3) / 3.0 + l * l * e + l * e * e;
            assert!((plate.deflection(0, outwards * e) / strip - 1.0).abs() < 3e-3);
            assert!((plate.sheared(0, 0.0) / l - 1.0).abs() < 1e-3);
        }
    }

    /// Sines and powers that follow from each other are those of each order by itself, to the last of them.
    #[test]
    fn orders_follow_from_each_other() {
        let (arc, inner) = (0.37, 0.99f64);
        let mut orders = Orders::new(arc, inner);
        orders.next();
        for n in 1..=SHEAR_ORDERS {
            let ((spread, stiffened), x) = (orders.next(), f64::from(n) * arc);
            // Of what a point would give, which is 1.
            assert!((spread - (x.sin() / x).powi(2)).abs() < 1e-15, "order {n}: {spread}");
            let power = inner.powf(2.0 * f64::from(n));
            let exact = (1.0 - power) / (1.0 + power);
            assert!((stiffened / exact - 1.0).abs() < 1e-12, "order {n}: {stiffened}, not {exact}");
        }
    }

    /// Order 1 under its own load with a clamp at a point would be a tilt: for a small bore it grows without bound,
    /// slower than the tilt's logarithm.
    #[test]
    fn small_bores_soften_and_orders_stiffen() {
        let at = |clamp: f64, n: u32| Plate { clamp, poisson: 0.3 }.deflection(n, 0.05);
        assert!(at(0.1, 1) > at(0.3, 1) && at(0.3, 1) > at(0.55, 1) && at(0.55, 1) > at(0.8, 1));
        for n in 2..20 {
            assert!(at(0.55, n) > at(0.55, n + 1) && at(0.55, n + 1) > 0.0, "order {n}");
        }
    }
}
