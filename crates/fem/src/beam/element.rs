//! Stiffness and mass of one straight beam with two nodes.

use nalgebra::{SMatrix, Vector4};

use super::BeamSection;

/// Whether cross-sections can rotate relative to the beam's axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamTheory {
    /// With shear deformation and rotary inertia, for short and thick beams.
    Timoshenko,
    /// Without shear deformation and rotary inertia: the limit of slender beams.
    Euler,
}

/// Coordinates of an element: those of both nodes.
const SIZE: usize = 12;
/// Bending in the plane of x: displacements, and turns that are slopes. In that of y turns are slopes with the sign
/// turned.
const IN_X: [(usize, f64); 4] = [(0, 1.0), (4, 1.0), (6, 1.0), (10, 1.0)];
const IN_Y: [(usize, f64); 4] = [(1, 1.0), (3, -1.0), (7, 1.0), (9, -1.0)];
/// Four Gauss points on 0 .. 1 and their weights: exact for the products of cubics.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Phi = 12 E I / (kappa G A l^2): shear against bending.
fn shear_ratio(section: &BeamSection, length: f64, theory: BeamTheory) -> f64 {
    match theory {
        BeamTheory::Euler => 0.0,
        BeamTheory::Timoshenko => 12.0 * section.bending_stiffness() / (section.shear_stiffness() * length * length),
    }
}

/// Stiffness of a beam of `length` > 0 mm, N/mm, N, N mm.
///
/// ```text
/// bending   E I / ((1 + Phi) l^3)
///           [12, 6l, -12, 6l; ., (4 + Phi) l^2, -6l, (2 - Phi) l^2; ., ., 12, -6l; ., ., ., (4 + Phi) l^2]
/// axial     E A / l [1, -1; -1, 1],   torsion   G I_p / l [1, -1; -1, 1]
/// ```
/// Exact for loads at the nodes. Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, section 5.6.
pub(crate) fn beam_stiffness(section: &BeamSection, length: f64, theory: BeamTheory) -> SMatrix<f64, SIZE, SIZE> {
    let (l, phi) = (length, shear_ratio(section, length, theory));
    let scale = section.bending_stiffness() / ((1.0 + phi) * l.powi(3));
    let (a, b) = ((4.0 + phi) * l * l, (2.0 - phi) * l * l);
    let bending = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, a, -6.0 * l, b],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, b, -6.0 * l, a],
    ];
    let mut k = SMatrix::zeros();
    for plane in [IN_X, IN_Y] {
        for (i, (row, s)) in plane.iter().enumerate() {
            for (j, (column, t)) in plane.iter().enumerate() {
                k[(*row, *column)] += scale * s * t * bending[i][j];
            }
        }
    }
    for (at, stiffness) in [(2, section.axial_stiffness() / l), (5, section.torsional_stiffness() / l)] {
        for (i, j, sign) in [(at, at, 1.0), (at, at + 6, -1.0), (at + 6, at, -1.0), (at + 6, at + 6, 1.0)] {
            k[(i, j)] += sign * stiffness;
        }
    }
    k
}

/// Consistent mass of a beam of `length` > 0 mm, t, t mm, t mm^2, with the shapes that the stiffness belongs to.
///
/// ```text
/// M = integral of [rho A N_w' N_w + rho I N_theta' N_theta] dz   (rotary inertia with Timoshenko only)
/// axial and torsion: rho A l / 6, rho I_p l / 6 times [2, 1; 1, 2]
/// ```
/// Source: Z. Friedman, J. B. Kosmatka, Comput. Struct. 47 (1993) 473.
pub(crate) fn beam_mass(section: &BeamSection, length: f64, theory: BeamTheory) -> SMatrix<f64, SIZE, SIZE> {
    let (l, phi) = (length, shear_ratio(section, length, theory));
    let rotary = match theory {
        BeamTheory::Timoshenko => section.inertia_per_length(),
        BeamTheory::Euler => 0.0,
    };
    let mut m = SMatrix::zeros();
    for (xi, weight) in GAUSS {
        let (shift, turn) = shapes(xi, l, phi);
        let part =
            weight * l * (section.mass_per_length() * shift * shift.transpose() + rotary * turn * turn.transpose());
        for plane in [IN_X, IN_Y] {
            for (i, (row, s)) in plane.iter().enumerate() {
                for (j, (column, t)) in plane.iter().enumerate() {
                    m[(*row, *column)] += s * t * part[(i, j)];
                }
            }
        }
    }
    for (at, inertia) in [(2, section.mass_per_length() * l), (5, 2.0 * section.inertia_per_length() * l)] {
        for (i, j, share) in [(at, at, 2.0), (at, at + 6, 1.0), (at + 6, at, 1.0), (at + 6, at + 6, 2.0)] {
            m[(i, j)] += share * inertia / 6.0;
        }
    }
    m
}

/// Gyroscopic matrix of a beam of `length` > 0 mm that spins about its own axis with 1 rad/s about +z, t mm^2 for turns.
/// Theory (78).
///
/// ```text
/// M q'' + Omega G q' + K q = f,   G = integral of 2 rho I [N_x' N_y - N_y' N_x] dz     (N_x, N_y: turns about x and y)
/// of one section, per length:   rho I theta_x'' + 2 rho I Omega theta_y',   rho I theta_y'' - 2 rho I Omega theta_x'
/// ```
/// Skew-symmetric: it does no work. Small turns. None without rotary inertia ([`BeamTheory::Euler`]). Source: H. D.
/// Nelson, J. Mech. Des. 102 (1980) 793.
pub(crate) fn beam_gyroscopic(section: &BeamSection, length: f64, theory: BeamTheory) -> SMatrix<f64, SIZE, SIZE> {
    let mut g = SMatrix::zeros();
    if theory == BeamTheory::Euler {
        return g;
    }
    let phi = shear_ratio(section, length, theory);
    for (xi, weight) in GAUSS {
        let (_, turn) = shapes(xi, length, phi);
        let part = 2.0 * section.inertia_per_length() * weight * length * turn * turn.transpose();
        // A slope u_y' is a turn by -theta_x.
        for (i, (about_x, s)) in IN_Y.iter().enumerate() {
            for (j, (about_y, t)) in IN_X.iter().enumerate() {
                let coupled = -s * t * part[(i, j)];
                g[(*about_x, *about_y)] += coupled;
                g[(*about_y, *about_x)] -= coupled;
            }
        }
    }
    g
}

/// Displacement and turn of the section at xi = z/l for unit displacement and slope of either node.
fn shapes(xi: f64, l: f64, phi: f64) -> (Vector4<f64>, Vector4<f64>) {
    let (x, x2, x3) = (xi, xi * xi, xi * xi * xi);
    let shift = Vector4::new(
        2.0 * x3 - 3.0 * x2 - phi * x + 1.0 + phi,
        l * (x3 - (2.0 + 0.5 * phi) * x2 + (1.0 + 0.5 * phi) * x),
        -2.0 * x3 + 3.0 * x2 + phi * x,
        l * (x3 - (1.0 - 0.5 * phi) * x2 - 0.5 * phi * x),
    );
    let turn = Vector4::new(
        6.0 * (x2 - x) / l,
        3.0 * x2 - (4.0 + phi) * x + 1.0 + phi,
        -6.0 * (x2 - x) / l,
        3.0 * x2 - (2.0 - phi) * x,
    );
    (shift / (1.0 + phi), turn / (1.0 + phi))
}
