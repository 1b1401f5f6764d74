//! Tooth friction loss of a load that is spread evenly over the contact lines.

use crate::{GearPair, Side};

/// Places and weights of Gauss and Legendre over -1 .. 1, the positive half.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];

impl GearPair {
    /// Tooth loss factor H_V: power loss over power for a coefficient of friction of 1, with the load spread evenly
    /// over all contact lines.
    ///
    /// ```text
    /// H_V = mean over a mesh cycle of [sum_k l_k v_k / L] / (r_b1 cos b_b),   L = sum_k l_k
    /// ```
    /// l_k are the lengths of the contact lines, v_k their mean sliding per radian of the pinion
    /// ([`GearPair::mean_sliding`]). The integrand is smooth between the angles at which an end of a line passes a
    /// corner of the plane of action or the pitch point; there the quadrature is exact to round-off. For a spur pair
    /// with eps_alpha 1 .. 2 the result equals H. Ohlendorf's closed form (ISO/TR 14179-2),
    ///
    /// ```text
    /// H_V = pi (1/z_1 + 1/z_2) / cos b_b (1 - eps_alpha + eps_1^2 + eps_2^2)
    /// ```
    /// This closed form is often used for helical pairs as well. There it is wrong by some tens of per cent, because it
    /// lets whole teeth enter and leave contact at once.
    pub fn even_loss_factor(&self) -> f64 {
        let (side, base) = (Side::Left, self.pinion.base_radius());
        let pitch = self.pinion.pitch_angle();
        let [start, end] = self.path_of_contact();
        let pitch_point = base * self.working_pressure_angle().tan();
        let corners = self.common_face().map(|z| self.path_coordinate(side, 0.0, 0, z));
        let passes = |xi: f64| corners.map(|corner| ((xi - corner) / base).rem_euclid(pitch));
        let mut breaks: Vec<f64> = [start, pitch_point, end].into_iter().flat_map(passes).collect();
        breaks.extend([0.0, pitch]);
        breaks.sort_unstable_by(f64::total_cmp);
        let loss = |angle: f64| {
            let lines = self.contact_lines(side, angle);
            let length: f64 = lines.iter().map(|line| line.length).sum();
            let slid: f64 = lines.iter().map(|line| line.length * self.mean_sliding(side, angle, line)).sum();
            // A mesh cycle has angles without contact at single points at the most.
            if length > 0.0 { slid / length } else { 0.0 }
        };
        let between = |w: &[f64]| {
            let (middle, half) = (0.5 * (w[0] + w[1]), 0.5 * (w[1] - w[0]));
            let pair = |[x, weight]: [f64; 2]| weight * (loss(middle - half * x) + loss(middle + half * x));
            half * GAUSS.into_iter().map(pair).sum::<f64>()
        };
        breaks.windows(2).map(between).sum::<f64>() / (pitch * base * self.base_helix_angle().cos())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use crate::{Gear, GearData, GearPair, Side};

    fn pair(teeth: [u32; 2], helix_deg: f64, face_width: f64) -> GearPair {
        let (helix_angle, bore_diameter) = (helix_deg.to_radians(), 10.0);
        let data = GearData { teeth: teeth[0], helix_angle, face_width, bore_diameter, ..GearData::default() };
        let wheel = GearData { teeth: teeth[1], helix_angle: -data.helix_angle, ..data.clone() };
        GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap()
    }

    /// eps_1^2 + eps_2^2 of approach and recess, and pi (1/z_1 + 1/z_2) / cos b_b.
    fn parts(pair: &GearPair) -> [f64; 2] {
        let sheet = pair.sheet();
        let squares =
            [sheet.approach_path_mm, sheet.recess_path_mm].map(|g| (g / sheet.transverse_base_pitch_mm).powi(2));
        let turns = 1.0 / f64::from(pair.pinion.teeth()) + 1.0 / f64::from(pair.wheel.teeth());
        [squares.iter().sum(), PI * turns / pair.base_helix_angle().cos()]
    }

    /// A spur pair with one or two pairs in mesh loses what Ohlendorf's closed form says.
    #[test]
    fn spur_pairs_have_the_closed_form() {
        for teeth in [[17, 17], [20, 61], [33, 25]] {
            let pair = pair(teeth, 0.0, 20.0);
            let [squares, turns] = parts(&pair);
            let wanted = turns * (1.0 - pair.transverse_contact_ratio() + squares);
            let found = pair.even_loss_factor();
            assert!((found / wanted - 1.0).abs() < 1e-13, "{teeth:?}: {found}, not {wanted}");
        }
    }

    /// A helical pair of a whole overlap ratio has lines of one length, whose load lies evenly on the path of contact:
    /// H_V = pi (1/z_1 + 1/z_2) (eps_1^2 + eps_2^2) / (eps_alpha cos b_b). Ohlendorf's form is 15 % and more off there.
    #[test]
    fn whole_overlaps_lie_evenly_on_the_path() {
        for overlap in [1.0, 2.0] {
            let unit = pair([25, 41], 20.0, 20.0);
            let pair = pair([25, 41], 20.0, 20.0 * overlap / unit.overlap_ratio());
            let [squares, turns] = parts(&pair);
            let wanted = turns * squares / pair.transverse_contact_ratio();
            let found = pair.even_loss_factor();
            assert!((found / wanted - 1.0).abs() < 1e-12, "overlap {overlap}: {found}, not {wanted}");
            let ohlendorf = turns * (1.0 - pair.transverse_contact_ratio() + squares);
            assert!(ohlendorf / found - 1.0 < -0.1, "{ohlendorf} beside {found}");
        }
    }

    /// The quadrature has what a fine sum over angles has, for any overlap; names of the gears change nothing.
    #[test]
    fn narrow_helical_pairs_have_the_mean_over_angles() {
        for (teeth, helix, width) in [([18, 31], 14.0, 15.0), ([40, 23], -28.0, 9.0), ([30, 30], 5.0, 60.0)] {
            let pair = pair(teeth, helix, width);
            let steps = 40_000;
            let pitch = pair.pinion.pitch_angle();
            let at = |i: i32| {
                let angle = (f64::from(i) + 0.5) / f64::from(steps) * pitch;
                let lines = pair.contact_lines(Side::Left, angle);
                let slid: f64 = lines.iter().map(|l| l.length * pair.mean_sliding(Side::Left, angle, l)).sum();
                slid / lines.iter().map(|l| l.length).sum::<f64>()
            };
            let mean = (0..steps).map(at).sum::<f64>() / f64::from(steps);
            let wanted = mean / (pair.pinion.base_radius() * pair.base_helix_angle().cos());
            let found = pair.even_loss_factor();
            assert!((found / wanted - 1.0).abs() < 1e-5, "{teeth:?}: {found}, not {wanted}");
            let swapped = self::pair([teeth[1], teeth[0]], -helix, width).even_loss_factor();
            assert!((found / swapped - 1.0).abs() < 1e-12, "{teeth:?}: {found}, with other names {swapped}");
        }
    }
}
