//! Numbers of several motions, one in each SIMD lane.

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
            self.0[i] = if other.0[i] > self.0[i] { other.0[i] } else { self.0[i] };
        }
        self
    }

    #[inline(always)]
    pub(super) fn smaller(mut self, other: Self) -> Self {
        for i in 0..LANES {
            self.0[i] = if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] };
        }
        self
    }

    /// The same number in all lanes.
    #[inline(always)]
    pub(super) fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

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
