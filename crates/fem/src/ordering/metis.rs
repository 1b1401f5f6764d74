//! The only call into the METIS library.
#![allow(unsafe_code)] // a C function; the lengths it relies on are checked right here

use std::{collections::HashSet, ptr, sync::Mutex};

use super::{Dissection, SEPARATOR, graph::Graph};
use crate::FemError;

/// METIS draws from the C library's global random numbers: two calls at a time would make either's result
/// depend on the other's timing.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// What METIS takes for an entry of the graph and for a node, bytes, with all coarser graphs and its work space.
const BYTES: [usize; 2] = [24, 160];

/// Nodes that METIS takes for one have the same neighbours, themselves included; where more than a third of the nodes go
/// so, the common entry looks for two separators and takes the better one.
const LOOKS: i32 = 2;

/// Number of classes of nodes with the same neighbours, themselves included.
fn classes(graph: &Graph) -> usize {
    // A sum of well mixed numbers does not depend on the order in which neighbours are listed.
    let mixed = |node: i32, salt: u64| {
        let z = (node as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ salt;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let key = |node: usize| {
        let around = &graph.neighbours[graph.starts[node] as usize..graph.starts[node + 1] as usize];
        let all = around.iter().copied().chain([node as i32]);
        all.fold([0u64; 2], |sum, k| [sum[0].wrapping_add(mixed(k, 0)), sum[1].wrapping_add(mixed(k, 0x5bd1_e995))])
    };
    (0..graph.group_count()).map(key).collect::<HashSet<_>>().len()
}

/// Fill-reducing order of the graph's groups, and the `pieces` (a power of 2) that its first cuts leave: no two of them
/// have a common edge. The order does not depend on their number as long as each has more than the 120 groups below which
/// METIS looks for no cut of its own.
///
/// `METIS_NodeNDP` makes the order of `METIS_NodeND`, the entry that most programs take. That one catches
/// SIGTERM and SIGABRT for the whole process while it works, and its handler jumps into the stack of whatever thread
/// the system hands the signal to.
///
/// # Errors
/// [`FemError::OutOfMemory`] where there is no room for it: without its handlers METIS ends the process then.
/// [`FemError::Ordering`] when METIS reports a failure.
pub(super) fn nested_dissection(graph: &Graph, pieces: usize) -> Result<Dissection, FemError> {
    let nodes = graph.group_count();
    if nodes < 2 || graph.neighbours.is_empty() {
        return Ok(Dissection { order: (0..nodes).collect(), piece: vec![0; nodes] });
    }
    let (mut starts, mut neighbours) = (graph.starts.clone(), graph.neighbours.clone());
    let mut weights = graph.weights.clone();
    let uniform = weights.iter().all(|&w| w == weights[0]);
    let weights = if uniform { ptr::null_mut() } else { weights.as_mut_ptr() };
    let (mut order, mut inverse, mut sizes) = (vec![0i32; nodes], vec![0i32; nodes], vec![0i32; 2 * pieces - 1]);
    let mut options = [0i32; metis_sys::METIS_NOPTIONS as usize];
    let guard = ONE_AT_A_TIME.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let bytes = BYTES[0].saturating_mul(neighbours.len()).saturating_add(BYTES[1].saturating_mul(nodes));
    let mut room: Vec<u8> = Vec::new();
    room.try_reserve_exact(bytes).map_err(|_| FemError::OutOfMemory { bytes })?;
    drop(room);
    // SAFETY: `starts` has `nodes + 1` entries, ascending from 0 to the length of `neighbours`, whose entries
    // are below `nodes` (the graph has been checked to fit); `order` and `inverse` have `nodes`; `sizes` has one entry
    // less than twice the pieces; `options` has the length METIS declares; all outlive the call.
    let status = unsafe {
        metis_sys::METIS_SetDefaultOptions(options.as_mut_ptr());
        if 2 * nodes > 3 * classes(graph) {
            options[metis_sys::moptions_et_METIS_OPTION_NSEPS as usize] = LOOKS;
        }
        metis_sys::METIS_NodeNDP(
            nodes as i32,
            starts.as_mut_ptr(),
            neighbours.as_mut_ptr(),
            weights,
            pieces as i32,
            options.as_mut_ptr(),
            order.as_mut_ptr(),
            inverse.as_mut_ptr(),
            sizes.as_mut_ptr(),
        )
    };
    drop(guard);
    if status != metis_sys::rstatus_et_METIS_OK {
        return Err(FemError::Ordering { nodes, status });
    }
    let order: Vec<usize> = order.into_iter().map(|group| group as usize).collect();
    // Sizes are told of cuts alone.
    let mut piece = vec![if pieces == 1 { 0 } else { SEPARATOR }; nodes];
    let weight = |group: &usize| if uniform { 1 } else { i64::from(graph.weights[*group]) };
    let mut next = order.iter().copied().peekable();
    for (own, size) in spans(&sizes) {
        let mut left = i64::from(size);
        while let Some(group) = next.next_if(|group| left >= weight(group)) {
            left -= weight(&group);
            piece[group] = own;
        }
    }
    Ok(Dissection { order, piece })
}

/// Pieces and separators as they follow each other in the order, with their weights: below each cut its two sides, then
/// its separator. `sizes`: of the pieces, then of the cuts, the first one last.
fn spans(sizes: &[i32]) -> Vec<(u32, i32)> {
    let pieces = sizes.len().div_ceil(2);
    let (mut spans, mut stack) = (Vec::new(), vec![(0, false)]);
    while let Some((cut, is_open)) = stack.pop() {
        let at = sizes.len() - 1 - cut;
        if cut + 1 >= pieces {
            spans.push((at as u32, sizes[at]));
        } else if is_open {
            spans.push((SEPARATOR, sizes[at]));
        } else {
            stack.extend([(cut, true), (2 * cut + 1, false), (2 * cut + 2, false)]);
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SymmetricMatrix;

    /// A block of so many nodes, each coupled with all around it; `numbers` degrees of freedom a node.
    fn block([a, b, c]: [usize; 3], numbers: usize) -> Graph {
        let at = |i: usize, j: usize, k: usize| i + a * (j + b * k);
        let mut triplets = Vec::new();
        for (i, j, k) in (0..a).flat_map(|i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k)))) {
            for (p, q, r) in (0..2).flat_map(|p| (0..3).flat_map(move |q| (0..3).map(move |r| (p, q, r)))) {
                let (x, y, z) = (i + p, j + q, k + r);
                if x < a && (1..=b).contains(&y) && (1..=c).contains(&z) {
                    let (first, second) = (numbers * at(i, j, k), numbers * at(x, y - 1, z - 1));
                    for (m, n) in (0..numbers).flat_map(|m| (0..numbers).map(move |n| (m, n))) {
                        let (row, column) = ((first + m).max(second + n), (first + m).min(second + n));
                        triplets.push((row, column, 1.0));
                    }
                }
            }
        }
        let n = numbers * a * b * c;
        Graph::new(&SymmetricMatrix::from_triplets(n, &triplets).unwrap(), &vec![false; n]).unwrap()
    }

    /// No two pieces touch, each has its share of the graph, and separators are few.
    fn are_apart(graph: &Graph, dissection: &Dissection, pieces: usize) {
        let (nodes, of) = (graph.group_count(), |group: usize| dissection.piece[group]);
        for group in 0..nodes {
            let around = &graph.neighbours[graph.starts[group] as usize..graph.starts[group + 1] as usize];
            let apart = |&other: &i32| {
                let both = [of(group), of(other as usize)];
                both.contains(&SEPARATOR) || both[0] == both[1]
            };
            assert!(around.iter().all(apart), "{pieces} pieces");
        }
        let count = |piece: u32| (0..nodes).filter(|&group| of(group) == piece).count();
        let inside: usize = (0..pieces as u32).map(count).sum();
        assert_eq!(inside + count(SEPARATOR), nodes);
        assert!(pieces > 1 || inside == nodes);
        if nodes > 1000 {
            assert!((0..pieces as u32).all(|piece| 2 * pieces * count(piece) > inside), "{pieces} pieces");
            assert!(5 * count(SEPARATOR) < 2 * nodes, "{pieces} pieces, {} of {nodes} between", count(SEPARATOR));
        }
    }

    /// Ordering by the entry that catches signals.
    fn by_the_common_entry(graph: &Graph) -> Vec<usize> {
        let nodes = graph.group_count();
        let (mut starts, mut neighbours) = (graph.starts.clone(), graph.neighbours.clone());
        let (mut order, mut inverse) = (vec![0i32; nodes], vec![0i32; nodes]);
        let mut options = [0i32; metis_sys::METIS_NOPTIONS as usize];
        let _guard = ONE_AT_A_TIME.lock().unwrap();
        // SAFETY: as in `nested_dissection`; the blocks have equal weights.
        unsafe {
            metis_sys::METIS_SetDefaultOptions(options.as_mut_ptr());
            metis_sys::METIS_NodeND(
                &mut (nodes as i32),
                starts.as_mut_ptr(),
                neighbours.as_mut_ptr(),
                ptr::null_mut(),
                options.as_mut_ptr(),
                order.as_mut_ptr(),
                inverse.as_mut_ptr(),
            );
        }
        order.into_iter().map(|group| group as usize).collect()
    }

    /// Signals that the process caught at some time while a graph was ordered; bit 0 is signal 1.
    #[cfg(target_os = "linux")]
    fn caught_while(order: impl FnOnce() + Send) -> u64 {
        use std::{
            fs,
            sync::atomic::{AtomicBool, Ordering},
            thread,
        };
        let done = AtomicBool::new(false);
        let look = || {
            let status = fs::read_to_string("/proc/self/status").unwrap();
            let word = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
            u64::from_str_radix(word.trim(), 16).unwrap()
        };
        thread::scope(|scope| {
            scope.spawn(|| {
                order();
                done.store(true, Ordering::SeqCst);
            });
            let mut all = 0;
            while !done.load(Ordering::SeqCst) {
                all |= look();
            }
            all
        })
    }

    /// One test, since what a process catches is seen by all of its threads.
    #[test]
    fn the_order_is_that_of_the_common_entry_and_no_signal_is_caught() {
        for (size, numbers) in [([4, 5, 6], 3), ([12, 14, 17], 3), ([30, 9, 21], 1), ([40, 33, 2], 2)] {
            let graph = block(size, numbers);
            let common = by_the_common_entry(&graph);
            for pieces in [1, 2, 8] {
                let own = nested_dissection(&graph, pieces).unwrap();
                let are_small = pieces > 1 && graph.group_count() < 240 * pieces;
                assert!(are_small || own.order == common, "{size:?}, {pieces} pieces");
                are_apart(&graph, &own, pieces);
            }
        }
        #[cfg(target_os = "linux")]
        {
            // SIGABRT is 6, SIGTERM 15.
            let (graph, both) = (block([40, 40, 30], 1), 1 << 5 | 1 << 14);
            assert_eq!(caught_while(|| drop(nested_dissection(&graph, 1).unwrap())) & both, 0);
            assert_eq!(caught_while(|| drop(by_the_common_entry(&graph))) & both, both, "nobody looked in time");
        }
    }
}
