//! Four numbers at once, as processors compute them. The bits are the same on every machine, because each operation
//! rounds once, [`Four::mul_add`] included.
//!
//! Processor instructions are not inlined into closures that are not themselves inlined. Therefore lists of [`Four`]
//! are made in loops and not by `map`.

use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::{Simd, WithSimd};

/// Numbers side by side.
pub(crate) const LANES: usize = 4;

/// Runs an operation in the instructions that the processor has; it is compiled for each set of them.
#[inline]
pub(crate) fn run<Op: WithSimd>(arch: pulp::Arch, op: Op) -> Op::Output {
    match arch {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        pulp::Arch::V3(simd) => Simd::vectorize(simd, op),
        _ => Simd::vectorize(pulp::Scalar256b, op),
    }
}

/// Four numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Four<S: Simd>(S, S::f64s);

impl<S: Simd> Four<S> {
    /// Takes the numbers of an array.
    #[inline(always)]
    pub fn new(simd: S, all: &[f64; LANES]) -> Self {
        Self(simd, pulp::bytemuck::cast(*all))
    }

    /// The same number four times.
    #[inline(always)]
    pub fn splat(simd: S, x: f64) -> Self {
        Self(simd, simd.splat_f64s(x))
    }

    /// The four numbers as an array.
    #[inline(always)]
    pub fn array(self) -> [f64; LANES] {
        pulp::bytemuck::cast(self.1)
    }

    /// self * factor + term, rounded once. Processors without such an instruction compute the same result more slowly.
    #[inline(always)]
    pub fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0, self.0.mul_add_f64s(self.1, factor.1, term.1))
    }

    /// self - a * b, rounded once.
    #[inline(always)]
    pub fn less_product(self, a: Self, b: Self) -> Self {
        Self(self.0, self.0.negate_mul_add_f64s(a.1, b.1, self.1))
    }

    /// Square root of each number.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    /// The larger number of each pair.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self(self.0, self.0.max_f64s(self.1, other.1))
    }

    /// The smaller number of each pair.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(self.0, self.0.min_f64s(self.1, other.1))
    }

    /// `yes` where the number is below `than`, 0 elsewhere.
    #[inline(always)]
    pub fn below(self, than: Self, yes: Self, no: Self) -> Self {
        let simd = self.0;
        let (is_below, bits) = (simd.less_than_f64s(self.1, than.1), |x: S::f64s| pulp::bytemuck::cast(x));
        Self(simd, pulp::bytemuck::cast(simd.select_u64s(is_below, bits(yes.1), bits(no.1))))
    }

    /// Whether any number is below `than`.
    #[inline(always)]
    pub fn any_below(self, than: Self) -> bool {
        self.0.first_true_m64s(self.0.less_than_f64s(self.1, than.1)) < LANES
    }

    /// The numbers of other bits.
    #[inline(always)]
    fn of_bits(self, of: impl Fn(u64) -> u64) -> Self {
        let mut bits: [u64; LANES] = pulp::bytemuck::cast(self.1);
        for bits in &mut bits {
            *bits = of(*bits);
        }
        Self(self.0, pulp::bytemuck::cast(bits))
    }

    /// Value of a polynomial at each number; the coefficient of the highest power comes first.
    #[inline(always)]
    pub fn polynomial<const N: usize>(self, coefficients: [f64; N]) -> Self {
        let mut sum = Self::splat(self.0, coefficients[0]);
        for c in &coefficients[1..] {
            sum = sum.mul_add(self, Self::splat(self.0, *c));
        }
        sum
    }

    /// Natural logarithm of positive normal numbers, to an ulp.
    ///
    /// ```text
    /// x = 2^k m,  sqrt(1/2) <= m < sqrt(2),  f = m - 1,  s = f / (2 + f)
    /// ln x = k ln 2 + f - f^2/2 + s (f^2/2 + R(s^2)),  R(s^2) = 2/3 s^2 + 2/5 s^4 + ..
    /// ```
    /// R: the polynomial of FreeBSD's `e_log.c`.
    #[inline(always)]
    pub fn ln(self) -> Self {
        const ROOT_HALF: u64 = 0x3fe6_a09e_0000_0000;
        const ONE: u64 = 0x3ff0_0000_0000_0000;
        const TWO_TO_52: u64 = 0x4330_0000_0000_0000;
        let of = |x: f64| Self::splat(self.0, x);
        let shifted = self.of_bits(|x| x.wrapping_add(ONE - ROOT_HALF));
        let exponent = shifted.of_bits(|x| (x >> 52) | TWO_TO_52) - of(4_503_599_627_370_496.0 + 1023.0);
        let f = shifted.of_bits(|x| (x & 0x000f_ffff_ffff_ffff) + ROOT_HALF) - of(1.0);
        let s = f / (of(2.0) + f);
        let z = s * s;
        let w = z * z;
        let even = w * w.polynomial([1.531_383_769_920_937_3e-1, 2.222_219_843_214_978_4e-1, 3.999_999_999_940_942e-1]);
        let odd = z * w.polynomial([
            1.479_819_860_511_658_6e-1,
            1.818_357_216_161_805e-1,
            2.857_142_874_366_239e-1,
            6.666_666_666_666_735e-1,
        ]);
        let half = of(0.5) * f * f;
        let low = exponent * of(1.908_214_929_270_587_7e-10) - half;
        s * (half + (even + odd)) + low + f + exponent * of(6.931_471_803_691_238e-1)
    }

    /// e^x and e^x - 1 for -700 < x < 700, to two ulp.
    #[inline(always)]
    pub fn exp(self) -> [Self; 2] {
        const TO_WHOLE: f64 = 6_755_399_441_055_744.0;
        let of = |x: f64| Self::splat(self.0, x);
        let whole = self * of(std::f64::consts::LOG2_E) + of(TO_WHOLE);
        let k = whole - of(TO_WHOLE);
        let r = self - k * of(6.931_471_803_691_238e-1) - k * of(1.908_214_929_270_587_7e-10);
        // 1/n!, from n = 13 on down.
        let rest = r.polynomial([
            1.605_904_383_682_161_5e-10,
            2.087_675_698_786_81e-9,
            2.505_210_838_544_172e-8,
            2.755_731_922_398_589e-7,
            2.755_731_922_398_589_3e-6,
            2.480_158_730_158_73e-5,
            1.984_126_984_126_984e-4,
            1.388_888_888_888_889e-3,
            8.333_333_333_333_333e-3,
            4.166_666_666_666_666_4e-2,
            1.666_666_666_666_666_6e-1,
            0.5,
        ]);
        let grown = r + r * r * rest;
        let scale = whole.of_bits(|x| x.wrapping_add(1023) << 52);
        [scale * grown + scale, scale * grown + (scale - of(1.0))]
    }

    /// Sum of the four numbers.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let [a, b, c, d] = self.array();
        (a + b) + (c + d)
    }
}

macro_rules! operation {
    ($name:ident, $call:ident, $of:ident) => {
        impl<S: Simd> $name for Four<S> {
            type Output = Self;
            #[inline(always)]
            fn $call(self, other: Self) -> Self {
                Self(self.0, self.0.$of(self.1, other.1))
            }
        }
    };
}
operation!(Add, add, add_f64s);
operation!(Sub, sub, sub_f64s);
operation!(Mul, mul, mul_f64s);
operation!(Div, div, div_f64s);

impl<S: Simd> Neg for Four<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::splat(self.0, -0.0) - self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(x: [f64; LANES]) -> Four<pulp::Scalar256b> {
        Four::new(pulp::Scalar256b, &x)
    }

    /// Distance in units of the last place.
    fn ulps(found: f64, wanted: f64) -> u64 {
        found.to_bits().abs_diff(wanted.to_bits())
    }

    /// Over five hundred decades, and densely about 1, where the logarithm vanishes.
    #[test]
    fn logarithm_is_exact_to_an_ulp() {
        for i in -30_000..30_000 {
            let x = [1e-3, 7e-5, 1e-7, 2e-2].map(|step| (f64::from(i) * step).exp());
            for (found, x) in of(x).ln().array().into_iter().zip(x) {
                assert!(ulps(found, x.ln()) <= 1, "ln {x:e}: {found:e}, not {:e}", x.ln());
            }
        }
    }

    #[test]
    fn exponential_is_exact_to_two_ulp() {
        for i in -30_000..30_000 {
            let x = [1e-3, 7e-5, 1e-7, 2e-2].map(|step| f64::from(i) * step);
            let [exp, less] = of(x).exp().map(Four::array);
            for (k, x) in x.into_iter().enumerate() {
                assert!(ulps(exp[k], x.exp()) <= 2, "exp {x:e}: {:e}, not {:e}", exp[k], x.exp());
                let (off, wanted) = ((less[k] - x.exp_m1()).abs(), x.exp_m1());
                assert!(off <= 3.0 * f64::EPSILON * wanted.abs(), "exp_m1 {x:e}: {:e}, not {wanted:e}", less[k]);
            }
        }
    }

    /// What the processor's own instructions make of numbers is what plain ones do.
    #[test]
    fn every_machine_has_the_same_bits() {
        struct All([f64; LANES]);
        impl WithSimd for All {
            type Output = [[f64; LANES]; 5];
            #[inline(always)]
            fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
                let x = Four::new(simd, &self.0);
                let [exp, less] = (-x).exp();
                let fused = x.mul_add(less, exp).less_product(x, less);
                [x.ln().array(), exp.array(), less.array(), (x.sqrt() / (x + exp) - fused).array(), [x.sum(); LANES]]
            }
        }
        for i in 1..5000 {
            let x = [1e-3, 7e-5, 1e-7, 3e-2].map(|step| f64::from(i) * step);
            let plain = Simd::vectorize(pulp::Scalar256b, All(x));
            assert_eq!(run(pulp::Arch::new(), All(x)).map(|f| f.map(f64::to_bits)), plain.map(|f| f.map(f64::to_bits)));
        }
    }
}
