//! Assigns loads to copies of the sector, and finds copies with equal loads.

use std::collections::BTreeMap;

use super::SectorMesh;
use crate::load::Load;

/// Weights of two loads within this are the same load on two teeth.
const SAME_LOAD: f64 = 1e-10;

/// Loads as those of one sector.
pub(super) struct Placed {
    /// Copy and number of each load.
    pub coordinates: Vec<(u32, usize)>,
    /// The loads that differ, on nodes of the sector.
    pub own: Vec<Load>,
}

/// Loads on nodes of the larger mesh, each in its copy; `None` when one is on a cut or in two copies.
pub(super) fn placed(part: &SectorMesh, loads: &[Load]) -> Option<Placed> {
    let mut own: Vec<Load> = Vec::new();
    // Loads of the same nodes, to be found by them.
    let mut known: BTreeMap<Vec<u32>, Vec<usize>> = BTreeMap::new();
    let mut coordinates = Vec::with_capacity(loads.len());
    for load in loads {
        let mut copies: Vec<u32> = Vec::new();
        let mut mine: Load = Vec::with_capacity(load.len());
        for &(node, weight) in load {
            let place = part.places.get(node as usize)?;
            if part.right_of(place.node).is_some() {
                return None;
            }
            copies.push(place.copy);
            mine.push((place.node, weight));
        }
        let copy = *copies.first()?;
        if copies.iter().any(|&c| c != copy) {
            return None;
        }
        mine.sort_by_key(|&(node, _)| node);
        let key: Vec<u32> = mine.iter().filter(|(_, w)| w.abs() > SAME_LOAD).map(|&(node, _)| node).collect();
        let same = |&&i: &&usize| is_same(&mine, &own[i]);
        let numbers = known.entry(key).or_default();
        let number = match numbers.iter().find(same) {
            Some(&number) => number,
            None => {
                numbers.push(own.len());
                own.push(mine);
                own.len() - 1
            }
        };
        coordinates.push((copy, number));
    }
    Some(Placed { coordinates, own })
}

/// Whether a load is the same as another one, which may lack nodes of little weight.
fn is_same(own: &Load, other: &Load) -> bool {
    let weight = |node| other.iter().find(|p| p.0 == node).map_or(0.0, |p| p.1);
    own.iter().all(|&(n, w)| (w - weight(n)).abs() <= SAME_LOAD)
}

/// Copy of each load, and its number among those `known` of one sector; `None` where it is none of them.
pub(super) fn placed_among(part: &SectorMesh, loads: &[Load], known: &[Load]) -> Option<Vec<(u32, usize)>> {
    let Placed { coordinates, own } = placed(part, loads)?;
    let number = |load: &Load| {
        let size = |load: &Load| load.iter().filter(|(_, w)| w.abs() > SAME_LOAD).count();
        known.iter().position(|other| size(load) == size(other) && is_same(load, other))
    };
    let numbers = own.iter().map(number).collect::<Option<Vec<_>>>()?;
    Some(coordinates.into_iter().map(|(copy, load)| (copy, numbers[load])).collect())
}

/// First and number of the neighbouring copies that hold all those given: what the widest gap leaves.
pub(super) fn arc(copies: impl Iterator<Item = u32>, teeth: u32) -> (u32, u32) {
    let mut copies: Vec<u32> = copies.collect();
    copies.sort_unstable();
    copies.dedup();
    let Some(&last) = copies.last() else { return (0, 1) };
    let mut best = (copies[0], teeth - (copies[0] + teeth - last) + 1);
    for pair in copies.windows(2) {
        let count = teeth - (pair[1] - pair[0]) + 1;
        if count < best.1 {
            best = (pair[1], count);
        }
    }
    best
}
