//! Finds elements that are equal except for their tag.

/// Numbers of the elements of `connectivity` (`size` nodes each) that are the first of their
/// node set, ascending. n log n in the number of elements.
pub(super) fn first_of_equals(connectivity: &[u32], size: usize) -> Vec<usize> {
    let nodes = |i: usize| &connectivity[i * size..(i + 1) * size];
    // A sum of scrambled node numbers does not depend on their order.
    let mut keyed: Vec<(u64, usize)> = (0..connectivity.len() / size)
        .map(|i| (nodes(i).iter().fold(0_u64, |sum, &n| sum.wrapping_add(scramble(n))), i))
        .collect();
    keyed.sort_unstable();
    let mut keep = Vec::with_capacity(keyed.len());
    for run in keyed.chunk_by(|a, b| a.0 == b.0) {
        let mut sets: Vec<(Vec<u32>, usize)> = Vec::new();
        for &(_, i) in run {
            if run.len() == 1 {
                keep.push(i);
                continue;
            }
            let mut set = nodes(i).to_vec();
            set.sort_unstable();
            sets.push((set, i));
        }
        sets.sort_unstable();
        sets.dedup_by(|later, first| later.0 == first.0);
        keep.extend(sets.iter().map(|s| s.1));
    }
    keep.sort_unstable();
    keep
}

/// Steele, Lea and Flood's mixing of 64 bits (SplitMix).
fn scramble(node: u32) -> u64 {
    let mut x = u64::from(node).wrapping_add(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_in_another_order_is_left_out() {
        let all = [0, 1, 2, 3, 4, 5, 6, 7, 3, 2, 1, 0, 0, 1, 2, 4];
        assert_eq!(first_of_equals(&all, 4), [0, 1, 3]);
    }
}
