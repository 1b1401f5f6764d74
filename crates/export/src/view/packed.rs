//! Numbers as text for a page: two bytes each, as base64.

use base64::{Engine, prelude::BASE64_STANDARD};
use serde::Serialize;

/// Largest whole number of a pack.
const STEPS: f64 = 32_767.0;
/// Stands for a number that is none.
const NOTHING: i16 = i16::MIN;

/// Lists of numbers on one scale: value = `unit` times a whole number of two bytes, low byte first; -32768 is no
/// number.
///
/// Off by half a unit at most, 1/65534 of the largest value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Packed {
    unit: f64,
    lists: Vec<String>,
}

impl Packed {
    /// Lists on one scale; what is not finite is no number.
    pub fn new<'a>(lists: impl IntoIterator<Item = &'a [f64]> + Clone) -> Self {
        let all = lists.clone().into_iter().flatten();
        let largest = all.filter(|v| v.is_finite()).fold(0.0, |m: f64, v| m.max(v.abs()));
        let unit = if largest > 0.0 { largest / STEPS } else { 1.0 };
        let step = |v: &f64| if v.is_finite() { (v / unit).round() as i16 } else { NOTHING };
        let text = |list: &[f64]| {
            let bytes: Vec<u8> = list.iter().flat_map(|v| step(v).to_le_bytes()).collect();
            BASE64_STANDARD.encode(bytes)
        };
        Self { unit, lists: lists.into_iter().map(text).collect() }
    }

    /// No lists at all.
    pub(super) fn empty() -> Self {
        Self::new([])
    }
}

/// Corners of triangles, two bytes each; the caller keeps their numbers below 65536.
pub(super) fn triangles(corners: &[[u32; 3]]) -> String {
    let bytes: Vec<u8> = corners.iter().flatten().flat_map(|&n| (n as u16).to_le_bytes()).collect();
    BASE64_STANDARD.encode(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_comes_back_to_half_a_unit() {
        let values = [1.0, -0.25, 0.1, f64::NAN, 0.0];
        let packed = Packed::new([&values[..]]);
        let bytes = BASE64_STANDARD.decode(&packed.lists[0]).unwrap();
        let back: Vec<i16> = bytes.chunks(2).map(|b| i16::from_le_bytes([b[0], b[1]])).collect();
        assert_eq!((back[0], back[3], back[4]), (32_767, NOTHING, 0));
        for (value, steps) in values.iter().zip(&back).filter(|(v, _)| v.is_finite()) {
            let off = (value - packed.unit * f64::from(*steps)).abs();
            assert!(off <= 0.5 * packed.unit, "{value} comes back off by {off:e}");
        }
    }
}
