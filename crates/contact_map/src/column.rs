//! Samples of the contact at one phase and tilt, under increasing forces.

use crate::{ContactSample, LoadedSlice, MapError, PhaseContact, load_axis::LoadAxis};

/// What a map holds of one phase, tilt and force.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Node {
    /// Approach, mm.
    pub approach: f64,
    /// L_0, L_1, L_2. Theory (74).
    pub lengths: [f64; 3],
    /// e at evenly spaced sigma, 0 to 1.
    pub shares: Vec<f64>,
    /// Pairs of teeth that carry, and their parts of the force.
    pub parts: Vec<(i64, f64)>,
    /// Friction of each of these pairs, and moment of its normal forces along the tilt, over the force of all.
    pub rubs: Vec<[f64; 4]>,
}

/// Forces this near to the one that is wanted (relative) are made into it by the tangent: what that leaves is the
/// square of it times the change of the tangent.
const NEAR: f64 = 3e-3;
/// Contacts for one force of the map at most.
const MOST_TRIES: usize = 40;
/// Mesh stiffness per width of face to begin with, N/(mm um), after ISO 6336-1.
const FIRST_GUESS: f64 = 14.0;

/// Way by which an approach without contact is deepened at the least, over the first guess of the largest approach.
const CLOSEST: f64 = 1e-7;

/// The nodes of a column, from no force to the largest, and how many contacts were solved.
pub(crate) fn column<C: PhaseContact>(
    contact: &mut C,
    (phase, tilt): (f64, f64),
    (axis, shares): (LoadAxis, usize),
    width: f64,
) -> Result<(Vec<Node>, usize), MapError<C::Error>> {
    let intervals = axis.axis().cells();
    let touch = first_touch(contact, tilt);
    let mut nodes = vec![Node::default(); intervals + 1];
    let mut solved = 0;
    let top = axis.force(intervals as f64);
    let guess = 1e-3 * top / (FIRST_GUESS * width);
    let mut from = (touch + guess, f64::NAN, f64::NAN);
    for i in (1..=intervals).rev() {
        let wanted = axis.force(i as f64);
        let (approach, sample) =
            under(contact, (phase, tilt), wanted, [touch, CLOSEST * guess], (&mut from, &mut solved))?;
        nodes[i] = node(approach, &sample.slices, shares);
    }
    // Lengths at no load at all are those of the least load; they multiply a force that is not there.
    nodes[0] = Node { approach: touch, ..nodes[1].clone() };
    for (i, pair) in nodes.windows(2).enumerate() {
        if pair[1].approach.partial_cmp(&pair[0].approach) != Some(std::cmp::Ordering::Greater) {
            return Err(MapError::NotMonotonic { phase, force_n: axis.force(i as f64) });
        }
    }
    Ok((nodes, solved))
}

/// Approach at which undeformed flanks touch first, mm: overlap grows with the approach, nearly one to one.
fn first_touch<C: PhaseContact>(contact: &mut C, tilt: f64) -> f64 {
    let mut approach = 0.0;
    for _ in 0..4 {
        approach -= contact.overlap(approach, tilt);
    }
    approach
}

/// Approach under a force, with the sample it was taken from; `closest` (mm): what an approach without contact is
/// deepened by at the least; `from`: approach, force and stiffness of the last one.
fn under<C: PhaseContact>(
    contact: &mut C,
    (phase, tilt): (f64, f64),
    wanted: f64,
    [touch, closest]: [f64; 2],
    (from, solved): (&mut (f64, f64, f64), &mut usize),
) -> Result<(f64, ContactSample), MapError<C::Error>> {
    let mut force_n = 0.0;
    for _ in 0..MOST_TRIES {
        let (approach, force, stiffness) = *from;
        let next = if force.is_nan() { approach } else { approach + (wanted - force) / stiffness };
        // A force that stiffens is overshot from below and undershot from above, where it may end.
        let next = if next > touch { next } else { 0.5 * (approach + touch) };
        *solved += 1;
        let sample = contact.sample(next, tilt).map_err(|source| MapError::Contact {
            phase,
            approach_um: 1e3 * next,
            source,
        })?;
        force_n = sample.force;
        if sample.force > 0.0 && sample.stiffness > 0.0 {
            *from = (next, sample.force, sample.stiffness);
        } else {
            // Apart yet: deeper by as much as it went beyond first touch.
            *from = (next + 2.0 * (next - touch).abs().max(closest), f64::NAN, f64::NAN);
            continue;
        }
        if (sample.force - wanted).abs() <= NEAR * wanted {
            return Ok((next + (wanted - sample.force) / sample.stiffness, sample));
        }
    }
    Err(MapError::NoApproach { phase, force_n: wanted, found_n: force_n })
}

fn node(approach: f64, slices: &[LoadedSlice], shares: usize) -> Node {
    let lengths = [0, 1, 2].map(|k| slices.iter().map(|s| s.length * s.lever.powi(k)).sum::<f64>());
    let force = slices.iter().map(|s| s.force).sum::<f64>();
    let share = |i: usize| {
        let sigma = i as f64 / shares as f64;
        if i == 0 || i == shares {
            return 1.0;
        }
        let w = sigma / (1.0 - sigma) * force / lengths[0];
        slices.iter().map(|s| (w * s.length).min(s.force)).sum::<f64>() / (force * sigma)
    };
    let mut parts: Vec<(i64, f64)> = Vec::new();
    let mut rubs: Vec<[f64; 4]> = Vec::new();
    for slice in slices {
        let at = parts.iter().position(|own| own.0 == slice.pair).unwrap_or_else(|| {
            parts.push((slice.pair, 0.0));
            rubs.push([0.0; 4]);
            parts.len() - 1
        });
        parts[at].1 += slice.force / force;
        rubs[at].iter_mut().zip(rubbing(slice)).for_each(|(sum, own)| *sum += own / force);
    }
    Node { approach, lengths, shares: (0..=shares).map(share).collect(), parts, rubs }
}

/// Friction of a slice, and the moment of its normal force along the tilt.
pub(crate) fn rubbing(slice: &LoadedSlice) -> [f64; 4] {
    let [force, along, over] = slice.friction;
    [force, along, over, slice.force * slice.lever]
}
