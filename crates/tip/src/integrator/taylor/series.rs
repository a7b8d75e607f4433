//! Power series, up to an order.

pub(crate) const MOST_ORDER: usize = 28;
const LANES: usize = 4;
/// Coefficients, with room to fill the lanes.
pub(crate) const WIDTH: usize = (MOST_ORDER + 1).next_multiple_of(LANES);

/// k at index k.
const ORDERS: [f64; WIDTH] = {
    let mut orders = [0.0; WIDTH];
    let mut k = 0;
    while k < WIDTH {
        orders[k] = k as f64;
        k += 1;
    }
    orders
};

/// Coefficients of powers of time, or of the elapsed fraction of a step; 0 beyond the order.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Series {
    order: usize,
    coefficients: [f64; WIDTH],
}

impl Series {
    pub(crate) fn zero(order: usize) -> Self {
        Self { order, coefficients: [0.0; WIDTH] }
    }

    /// The coefficients, from that of the power 0 on.
    pub(crate) fn coefficients(&self) -> &[f64] {
        &self.coefficients[..=self.order]
    }

    /// The coefficients in groups of four, the last one filled up with 0.
    #[inline(always)]
    pub(crate) fn groups(&self) -> &[[f64; LANES]] {
        &self.coefficients.as_chunks().0[..(self.order + 1).div_ceil(LANES)]
    }

    /// The coefficient of the power k.
    #[inline(always)]
    pub(crate) fn at(&self, k: usize) -> f64 {
        self.coefficients[k]
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, k: usize, coefficient: f64) {
        self.coefficients[k] = coefficient;
    }

    /// The derivative at 1.
    pub(crate) fn slope_at_end(&self) -> f64 {
        let mut sums = [0.0; LANES];
        let groups = self.coefficients.as_chunks::<LANES>().0.iter();
        for (coefficients, orders) in groups.zip(ORDERS.as_chunks::<LANES>().0) {
            for i in 0..LANES {
                sums[i] += orders[i] * coefficients[i];
            }
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3])
    }

    /// The series in units of this length: coefficient k is multiplied by the k-th power of the length.
    #[inline(always)]
    pub(crate) fn over(&self, length: f64) -> Self {
        let square = length * length;
        let mut power = [1.0, length, square, square * length];
        let fourth = square * square;
        let mut over = Self::zero(self.order);
        let groups = over.coefficients.as_chunks_mut::<LANES>().0.iter_mut();
        for (over, group) in groups.zip(self.coefficients.as_chunks::<LANES>().0) {
            for i in 0..LANES {
                over[i] = group[i] * power[i];
                power[i] *= fourth;
            }
        }
        over
    }

    #[cfg(test)]
    pub(crate) fn of(coefficients: &[f64]) -> Self {
        let mut series = Self::zero(coefficients.len() - 1);
        series.coefficients[..coefficients.len()].copy_from_slice(coefficients);
        series
    }
}
