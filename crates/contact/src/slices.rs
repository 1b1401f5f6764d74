//! Contact by axial slices: at each station the one place of the profile where two flanks are nearest.

use crate::{
    ContactRow, FlankPatch, LocalContact, Pose, ToothLayer, Vec3,
    closest_point::{row_at, support_at},
};

/// One flank as slices see it.
#[derive(Debug, Clone, Copy)]
pub struct SliceFlank<'a> {
    /// Smooth surface, and faces that carry the load.
    pub patch: &'a FlankPatch,
    /// What stands behind it.
    pub layer: &'a ToothLayer,
}

/// One slice of a contact line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slice {
    /// Height z of the station on body 1, mm.
    pub z: f64,
    /// Surface coordinates of the contact on each flank.
    pub at: [[f64; 2]; 2],
    /// Length of contact line that the slice stands for, mm.
    pub length: f64,
    /// The band at this place.
    pub local: LocalContact,
}

/// Places along the profile at which the search starts.
const SCAN: usize = 16;
/// Steps of the bisection on the slope; the bracket shrinks to round-off.
const STEPS: usize = 60;

/// Turn of the normal within the last bracket that is a kink, rad.
const KINK: f64 = 1e-7;
/// How far beyond an end face of body 2 a foot may lie, as a share of its width: feet wander by gap times sin(b_b).
const BEYOND: f64 = 1e-3;

/// Which end of the feasible part of the profile stops the search for the least gap.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// Flank against flank, at this roll angle of the searched body.
    Inside(f64),
    /// The searched body's own end (tip edge or root form circle).
    OwnEnd(f64),
    /// The other flank ends here: its edge presses on the searched body.
    OtherEnd(f64),
    /// A kink of the other flank, where a linear relief begins: it presses as an edge does.
    OtherKink(f64),
}

/// The slice at height `z` (mm, body 1's own frame) standing for `length` mm of contact line, and its gap row; `None` where the
/// flanks do not face each other.
///
/// Flank against flank: the gap's slope along the profile, n_2 . dx_1/du, is zero. Where that place lies past a tip, the
/// tip edge presses on the other flank, along that flank's normal: contact off the line of action needs no case of its own.
/// So does the kink at which a linear relief begins: a kink has no normal, the flank it presses on has.
pub fn slice(
    flanks: [SliceFlank; 2],
    poses: &[Pose; 2],
    patches: (usize, usize),
    point: usize,
    z: f64,
    length: f64,
) -> Option<(ContactRow, Slice)> {
    let [a, b] = flanks;
    let place = nearest([a.patch, b.patch], [&poses[0], &poses[1]], z)?;
    let (Place::Inside(u) | Place::OwnEnd(u) | Place::OtherEnd(u) | Place::OtherKink(u)) = place;
    let faced = b.patch.surface().locate(&carried([&poses[0], &poses[1]], a.patch, [u, z]))?.at[1];
    // Gears displaced along their axes face each other on a part of their width only.
    let [[_, low], [_, high]] = b.patch.range();
    let slack = BEYOND * (high - low);
    if faced < low - slack || faced > high + slack {
        return None;
    }
    match place {
        Place::Inside(u) | Place::OwnEnd(u) => {
            let foot = b.patch.surface().locate(&carried([&poses[0], &poses[1]], a.patch, [u, z]))?;
            let at = [[u, z], foot.at];
            let mut row = row_at([a.patch, b.patch], poses, patches, point, at, foot.distance)?;
            let off = if matches!(place, Place::Inside(_)) {
                0.0
            } else {
                off_line([a.patch, b.patch], [&poses[0], &poses[1]], at)
            };
            let local = local(flanks, at, off);
            row.gap += local.edge_opening();
            Some((row, Slice { z, at, length, local }))
        }
        Place::OtherKink(u) => {
            let foot = b.patch.surface().locate(&carried([&poses[0], &poses[1]], a.patch, [u, z]))?;
            let at = [[u, z], foot.at];
            let row = edge_row([a.patch, b.patch], poses, patches, point, at, foot.distance)?;
            Some((row, Slice { z, at, length, local: local(flanks, at, 0.0) }))
        }
        Place::OtherEnd(_) => {
            // Seen from the other body the same place is its own end.
            let u = b.patch.range()[1][0];
            let foot = a.patch.surface().locate(&carried([&poses[1], &poses[0]], b.patch, [u, faced]))?;
            let at = [foot.at, [u, faced]];
            let off = off_line([b.patch, a.patch], [&poses[1], &poses[0]], [at[1], at[0]]);
            let mut row = edge_row([a.patch, b.patch], poses, patches, point, at, foot.distance)?;
            let local = local(flanks, at, off);
            row.gap += local.edge_opening();
            Some((row, Slice { z, at, length, local }))
        }
    }
}

/// A point of a body's flank in the other body's frame.
fn carried(poses: [&Pose; 2], patch: &FlankPatch, at: [f64; 2]) -> Vec3 {
    let position = poses[0].transform_point(&patch.surface().point(at).into());
    poses[1].inverse_transform_point(&position).coords
}

/// Gap, its slope by the roll angle of body 1, and the foot's roll angle on body 2.
fn gap(patches: [&FlankPatch; 2], poses: [&Pose; 2], at: [f64; 2]) -> Option<(f64, f64, f64)> {
    let foot = patches[1].surface().locate(&carried(poses, patches[0], at))?;
    let normal = poses[1].rotation * patches[1].surface().normal(foot.at);
    let tangent = poses[0].rotation * patches[0].surface().profile_tangent(at);
    Some((foot.distance, normal.dot(&tangent), foot.at[0]))
}

fn nearest(patches: [&FlankPatch; 2], poses: [&Pose; 2], z: f64) -> Option<Place> {
    let [[low, _], [high, _]] = patches[0].range();
    let [[other_low, _], [other_high, _]] = patches[1].range();
    let faces = |foot: f64| foot >= other_low && foot <= other_high;
    let look = |u: f64| gap(patches, poses, [u, z]);
    let facing = |u: f64| look(u).is_some_and(|(_, _, foot)| faces(foot));
    let step = (high - low) / (SCAN - 1) as f64;
    let at = |i: usize| (low + step * i as f64).min(high);
    let (_, nearest) = (0..SCAN)
        .filter_map(|i| look(at(i)).filter(|g| faces(g.2)).map(|g| (g.0, i)))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    // Bracket: the neighbours, or where the facing part of the profile ends before them.
    let end = |neighbour: f64| {
        if facing(neighbour) {
            return (neighbour, false);
        }
        let (mut inside, mut outside) = (at(nearest), neighbour);
        for _ in 0..STEPS {
            let middle = 0.5 * (inside + outside);
            if facing(middle) { inside = middle } else { outside = middle }
        }
        (inside, true)
    };
    let (mut a, cut_a) = end(at(nearest.saturating_sub(1)));
    let (mut b, cut_b) = end(at((nearest + 1).min(SCAN - 1)));
    let slope = |u: f64| look(u).map_or(0.0, |g| g.1);
    let stop = |u: f64, cut: bool| {
        // The other flank ends at its tip, or at its root form circle, which is no edge.
        let at_tip = look(u).is_some_and(|g| 2.0 * g.2 > other_low + other_high);
        if cut && at_tip { Place::OtherEnd(u) } else { Place::OwnEnd(u) }
    };
    if slope(a) >= 0.0 {
        return Some(stop(a, cut_a));
    }
    if slope(b) <= 0.0 {
        return Some(stop(b, cut_b));
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (a + b);
        if slope(middle) < 0.0 { a = middle } else { b = middle }
    }
    let normal = |u: f64| {
        let foot = patches[1].surface().locate(&carried(poses, patches[0], [u, z]))?;
        Some(patches[1].surface().normal(foot.at))
    };
    let turn = normal(b)? - normal(a)?;
    let middle = 0.5 * (a + b);
    Some(if turn.norm() > KINK { Place::OtherKink(middle) } else { Place::Inside(middle) })
}

/// How far past an edge of body 1 that presses off the line of action the smooth flanks would touch, mm of its flank's arc: by the angle at
/// which the flanks recede from each other there.
///
/// ```text
/// o = R epsilon,   epsilon = |dg/du| / (r_b u),   1/R: relative curvature
/// ```
fn off_line(patches: [&FlankPatch; 2], poses: [&Pose; 2], at: [[f64; 2]; 2]) -> f64 {
    let Some((_, slope, _)) = gap(patches, poses, at[0]) else { return 0.0 };
    let tangent = patches[0].surface().profile_tangent(at[0]).norm();
    let curvature = [0, 1].map(|i| patches[i].surface().curvature(at[i]));
    let receding = (slope / tangent).abs();
    // tangent = r_b u; the flanks' relative curvature turns arc length into receding angle.
    receding / (curvature[0] + curvature[1])
}

fn local(flanks: [SliceFlank; 2], at: [[f64; 2]; 2], off_line: f64) -> LocalContact {
    let curvature: f64 = [0, 1].map(|i| flanks[i].patch.surface().curvature(at[i])).iter().sum();
    LocalContact {
        bodies: [0, 1].map(|i| flanks[i].layer.body(at[i])),
        radius: curvature.max(f64::MIN_POSITIVE).recip(),
        off_line,
    }
}

/// Row of an edge of body 2 that presses on body 1: the force acts along body 1's normal.
fn edge_row(
    patches: [&FlankPatch; 2],
    poses: &[Pose; 2],
    numbers: (usize, usize),
    point: usize,
    at: [[f64; 2]; 2],
    gap: f64,
) -> Option<ContactRow> {
    let mut row = row_at(patches, poses, numbers, point, at, gap)?;
    let normal = -(poses[0].rotation * patches[0].surface().normal(at[0]));
    row.position = poses[1].transform_point(&patches[1].surface().point(at[1]).into()).coords;
    row.normal = normal;
    row.levers = crate::closest_point::levers(poses, &row.position, &normal);
    row.torque_levers = row.levers;
    row.traction = normal;
    row.supports = [
        support_at(patches[0], at[0], poses[0].inverse_transform_vector(&normal))?,
        support_at(patches[1], at[1], -poses[1].inverse_transform_vector(&normal))?,
    ];
    Some(row)
}
