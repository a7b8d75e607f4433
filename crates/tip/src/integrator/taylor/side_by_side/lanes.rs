//! Numbers of several motions, one in each SIMD lane.

use crate::elementary::{larger, smaller};
use std::ops::{Add, AddAssign, Mul, MulAssign, Sub};

pub(super) const LANES: usize = 8;

/// One number of each motion. Products and sums are taken lane by lane and never fused, so that a lane has the same bits
/// on every machine, whatever is in the others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    /// Applies a function to each number.
    #[inline(always)]
    pub(super) fn map(mut self, of: impl Fn(f64) -> f64) -> Self {
        // Not that of arrays, which is no loop over lanes unless it happens to be inlined.
        for lane in &mut self.0 {
            *lane = of(*lane);
        }
        self
    }

    /// The larger number in each lane.
    #[inline(always)]
    pub(super) fn larger(mut self, other: Self) -> Self {
        for i in 0..LANES {
            self.0[i] = larger(other.0[i], self.0[i]);
        }
        self
    }

    #[inline(always)]
    pub(super) fn smaller(mut self, other: Self) -> Self {
        for i in 0..LANES {
            self.0[i] = smaller(other.0[i], self.0[i]);
        }
        self
    }

    /// The same number in all lanes.
    #[inline(always)]
    pub(super) fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

// One motion alone has its logarithms from integers (`length`), which wait less. These are of operations that vectors have.

/// The binary logarithm of a normal number above 0, to 0.01, by a parabola in its mantissa.
#[inline(always)]
pub(super) fn log2(x: f64) -> f64 {
    let bits = x.to_bits();
    let mantissa = f64::from_bits(bits & MANTISSA | 1.0_f64.to_bits()) - 1.0;
    let biased = f64::from_bits(bits >> MANTISSA.count_ones() | WHOLE.to_bits()) - WHOLE;
    biased - 1023.0 + mantissa * (1.0 + BEND * (1.0 - mantissa))
}

/// 2^y, to half a per cent; y is limited to ±1000.
#[inline(always)]
pub(super) fn exp2(y: f64) -> f64 {
    let above = smaller(larger(y, -1000.0), 1000.0) + 1023.0;
    let nearest = (above + WHOLE) - WHOLE;
    let whole = if nearest > above { nearest - 1.0 } else { nearest };
    let part = above - whole;
    let power = f64::from_bits((whole + WHOLE).to_bits() << MANTISSA.count_ones());
    power * (1.0 + part * (1.0 - BEND * (1.0 - part)))
}

const MANTISSA: u64 = (1 << 52) - 1;
/// Numbers from here on are whole, and the last bits of one are those of a small integer added to it. Unlike a conversion
/// to integers, such an addition is one instruction on every processor.
const WHOLE: f64 = (MANTISSA + 1) as f64;
const BEND: f64 = 0.34;

impl Add for Lanes {
    type Output = Self;

    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        for i in 0..LANES {
            self.0[i] += other.0[i];
        }
    }
}

impl Sub for Lanes {
    type Output = Self;

    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for i in 0..LANES {
            self.0[i] -= other.0[i];
        }
        self
    }
}

impl MulAssign for Lanes {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        for i in 0..LANES {
            self.0[i] *= other.0[i];
        }
    }
}

impl Mul for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(mut self, other: Self) -> Self {
        self *= other;
        self
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(mut self, factor: f64) -> Self {
        for i in 0..LANES {
            self.0[i] *= factor;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_near_enough_to_plan_with() {
        for i in 0..2000 {
            let size = libm::exp(0.05 * f64::from(i) - 60.0);
            for k in [7, 18, 28] {
                let length = exp2((log2(1e-12) - log2(size)) / f64::from(k));
                let exact = (1e-12 / size).powf(1.0 / f64::from(k));
                assert!((length / exact - 1.0).abs() < 0.01, "{size} {k}: {length} {exact}");
            }
        }
    }
}
