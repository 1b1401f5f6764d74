//! Shafts with a rigid motion that nothing holds. They are reported by name before the solution of a singular matrix
//! fails.

use nalgebra::{DMatrix, DVector, Matrix5, Matrix6, SymmetricEigen, Vector6};

use crate::{
    GearMesh, GearboxError, Structure, Train,
    even_mesh::{guessed_lever, guessed_stiffness, turn},
    shafts_in_shafts::rigid,
};

/// Share of a scaled stiffness that is round-off.
const NOTHING: f64 = 1e-13;
/// Share of a tilt in a motion from which on it is called one.
const TILTS: f64 = 0.1;
/// Rigid motions of a shaft beside its turn.
const MOTIONS: [&str; 5] = ["along x", "along y", "along z", "tilting about x", "tilting about y"];

/// Whether bearings and meshes hold every shaft against every rigid motion; those of `held` need nothing beside their
/// turn.
///
/// ```text
/// K = sum T_b' K_b T_b + sum k_m l l',   u = T (x, y, z, theta_x, theta_y, theta_z)      from the middle of each shaft
/// ```
/// T_b: of both shafts where a bearing is between two. l: what rigid motions compress a mesh by. A loaded mesh holds one
/// motion of its two shafts: beside their turn two meshes
/// of opposite hands hold a shaft along its axis. Most shafts are held by their own bearings; only where one is not are all
/// looked at together. Rolling bearings count with all their elements pressed, whatever their clearance. Housings are in
/// series with the bearings: what these do not hold, no housing does. The turn of the `input` disc is given.
///
/// # Errors
/// [`GearboxError::Loose`].
pub(crate) fn check_held(
    structure: &Structure,
    held: &[bool],
    (meshes, train): (&[GearMesh], &Train),
    input: usize,
) -> Result<(), GearboxError> {
    let whole_by_bearings: Vec<Matrix6<f64>> = (0..structure.shafts.len()).map(|i| of_bearings(structure, i)).collect();
    let by_bearings: Vec<Matrix5<f64>> =
        whole_by_bearings.iter().map(|own| own.fixed_view::<5, 5>(0, 0).into_owned()).collect();
    let is_loose = |i: &usize| !held[*i] && free(&by_bearings[*i]).is_some();
    let loose: Vec<usize> = (0..by_bearings.len()).filter(is_loose).collect();
    // Beside a fixed shaft meshes hold the turn of what stands.
    if loose.is_empty() && structure.fixed.is_none() {
        return Ok(());
    }
    // Coordinates: six a shaft, of which those stay that nothing prescribes.
    let n = 6 * by_bearings.len();
    let mut whole = DMatrix::zeros(n, n);
    for (i, own) in by_bearings.iter().enumerate() {
        whole.view_mut((6 * i, 6 * i), (5, 5)).copy_from(own);
        if structure.can_hold_turn(i) {
            whole.view_mut((6 * i, 6 * i), (6, 6)).copy_from(&whole_by_bearings[i]);
        }
    }
    for bearing in &structure.bearings {
        let (Some(outer), Some([x, y, z])) = (bearing.outer, structure.seat(bearing)) else { continue };
        let moves = rigid([0.0, 0.0, bearing.position - half(structure, bearing.shaft)]);
        let seat = -rigid([x, y, z - half(structure, outer)]);
        let ends = [(6 * bearing.shaft, moves), (6 * outer, seat)];
        for ((a, left), (b, right)) in ends.iter().flat_map(|x| ends.iter().map(move |y| (x, y))) {
            let mut block = whole.view_mut((*a, *b), (6, 6));
            block += left.transpose() * bearing.rough_stiffness(1.0) * right;
        }
    }
    for (mesh, meshing) in meshes.iter().zip(train.meshing()) {
        let lever = turn(meshing.direction) * guessed_lever(mesh, meshing)?;
        let mut all = DVector::zeros(n);
        for (k, &disc) in mesh.discs.iter().enumerate() {
            let disc = &structure.discs[disc];
            let moves = rigid([0.0, 0.0, disc.position - half(structure, disc.shaft)]);
            let own: Vector6<f64> = lever.fixed_rows::<6>(6 * k).into_owned();
            let mut at = all.rows_mut(6 * disc.shaft, 6);
            at += moves.transpose() * own;
        }
        whole.ger(guessed_stiffness(&mesh.pair), &all, &all, 1.0);
    }
    let given = structure.discs[input].shaft;
    let is_free = |c: &usize| {
        let (shaft, axis) = (c / 6, c % 6);
        if axis == 5 { shaft != given && whole[(*c, *c)] > 0.0 } else { !held[shaft] }
    };
    let left: Vec<usize> = (0..n).filter(is_free).collect();
    let named = |shaft: usize| {
        let motion = free(&by_bearings[shaft]).unwrap_or(0);
        Err(GearboxError::Loose { shaft: structure.shafts[shaft].name.clone(), motion: MOTIONS[motion] })
    };
    if let Some(c) = left.iter().find(|c| whole[(**c, **c)].is_nan() || whole[(**c, **c)] <= 0.0) {
        return named(c / 6);
    }
    let scale: Vec<f64> = left.iter().map(|&c| whole[(c, c)].sqrt()).collect();
    let scaled = DMatrix::from_fn(left.len(), left.len(), |i, j| whole[(left[i], left[j])] / (scale[i] * scale[j]));
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(scaled);
    let (least, value) = eigenvalues.argmin();
    if value >= NOTHING {
        return Ok(());
    }
    let moved = eigenvectors.column(least);
    // A shaft that stands and turns off, whatever it takes along: nothing holds its turn.
    let (furthest, _) = moved.abs().argmax();
    if let (shaft, 5) = (left[furthest] / 6, left[furthest] % 6)
        && (structure.can_hold_turn(shaft) || loose.is_empty())
    {
        return Err(GearboxError::Loose { shaft: structure.shafts[shaft].name.clone(), motion: "about its own axis" });
    }
    // Of all shafts that move, the one that its bearings leave free and that moves most.
    let most = |shaft: usize| {
        let own = left.iter().zip(moved.iter()).filter(|(c, _)| **c / 6 == shaft && **c % 6 < 5);
        own.map(|(_, share)| share.abs()).fold(0.0, f64::max)
    };
    let worst = loose.iter().copied().reduce(|a, b| if most(b) > most(a) { b } else { a });
    named(worst.unwrap_or(left[furthest] / 6))
}

impl Structure {
    /// Checks that bearings and meshes hold every shaft against every rigid motion, except those of `held`, which are
    /// rigid in rigid bearings. Springs linearised about a load do not count if their rolling elements carry nothing.
    /// `input` is the disc whose rotation is given.
    ///
    /// # Errors
    /// [`GearboxError::Loose`].
    pub fn check_held(&self, held: &[usize], meshes: (&[GearMesh], &Train), input: usize) -> Result<(), GearboxError> {
        let flags: Vec<bool> = (0..self.shafts.len()).map(|shaft| held.contains(&shaft)).collect();
        check_held(self, &flags, meshes, input)
    }
}

/// Height of the middle of a shaft, mm.
fn half(structure: &Structure, shaft: usize) -> f64 {
    0.5 * structure.shafts[shaft].pieces.iter().map(|p| p.length).sum::<f64>()
}

/// Stiffness by which a shaft's own bearings in housing or ground hold it.
fn of_bearings(structure: &Structure, shaft: usize) -> Matrix6<f64> {
    let half = half(structure, shaft);
    let mut stiffness = Matrix6::zeros();
    for bearing in structure.bearings.iter().filter(|b| b.shaft == shaft && b.outer.is_none()) {
        let moves = rigid([0.0, 0.0, bearing.position - half]);
        stiffness += moves.transpose() * bearing.rough_stiffness(1.0) * moves;
    }
    0.5 * (stiffness + stiffness.transpose())
}

/// The motion that a stiffness does not hold; about a point off the middle a shaft tilts and shifts at once.
fn free(stiffness: &Matrix5<f64>) -> Option<usize> {
    let diagonal = stiffness.diagonal();
    if let Some(nothing) = (0..5).find(|&i| diagonal[i].is_nan() || diagonal[i] <= 0.0) {
        return Some(nothing);
    }
    let scaled = Matrix5::from_fn(|i, j| stiffness[(i, j)] / (diagonal[i] * diagonal[j]).sqrt());
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(scaled);
    let (least, value) = eigenvalues.argmin();
    let free = eigenvectors.column(least);
    let tilt = 3 + free.rows(3, 2).iamax();
    (value < NOTHING).then(|| if free[tilt].abs() > TILTS { tilt } else { free.iamax() })
}
