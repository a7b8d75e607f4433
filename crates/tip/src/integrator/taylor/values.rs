//! Values of a series at fixed fractions of a step, by a table of powers. The sums run in SIMD lanes, whereas Horner's
//! rule would wait for each product.

use super::series::{MOST_ORDER, Series, WIDTH};
use crate::collocation::STAGES;
use crate::elementary::larger;
use multiversion::multiversion;
use std::sync::LazyLock;

/// Number of points in the SIMD lanes.
pub(crate) const BLOCK: usize = 8;
pub(crate) type Block = [f64; BLOCK];

/// Factors of the coefficients of a series in several sums, `BLOCK` sums in the SIMD lanes.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    sums: usize,
    blocks: Vec<[Block; WIDTH]>,
}

impl Table {
    /// A table in which the factor of the k-th coefficient in sum n is `of(n, k)`.
    pub(crate) fn new(sums: usize, of: impl Fn(usize, usize) -> f64) -> Self {
        let entry = |n: usize, k: usize| if n < sums && k <= MOST_ORDER { of(n, k) } else { 0.0 };
        let row = |b: usize, k: usize| std::array::from_fn(|i| entry(b * BLOCK + i, k));
        let block = |b: usize| std::array::from_fn(|k| row(b, k));
        Self { sums, blocks: (0..sums.div_ceil(BLOCK)).map(block).collect() }
    }

    /// A table for the values of a series at these fractions of the step.
    pub(crate) fn of_parts(parts: &[f64]) -> Self {
        let powers: Vec<_> = parts.iter().map(|part| powers(*part)).collect();
        Self::new(parts.len(), |n, k| powers[n][k])
    }

    /// The sums for a series, stored in `room`.
    pub(crate) fn sums<'a>(&self, series: &Series, room: &'a mut [Block]) -> &'a mut [f64] {
        sums(&self.blocks, series, room);
        &mut room.as_flattened_mut()[..self.sums]
    }
}

/// x^k, each from the power without the highest binary digit of k: the products of `powi`.
fn powers(x: f64) -> [f64; MOST_ORDER + 1] {
    let (mut powers, mut square) = ([1.0; MOST_ORDER + 1], x);
    let mut highest = 1;
    while highest <= MOST_ORDER {
        for k in highest..(2 * highest).min(MOST_ORDER + 1) {
            powers[k] = powers[k - highest] * square;
        }
        (highest, square) = (2 * highest, square * square);
    }
    powers
}

/// Every fourth row goes to the same sum: a sum waits for each of its terms. The order is the same on every machine.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn sums(blocks: &[[Block; WIDTH]], series: &Series, room: &mut [Block]) {
    for (block, sums) in blocks.iter().zip(room) {
        let (mut a, mut b, mut c, mut d) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for (rows, factors) in block.as_chunks::<4>().0.iter().zip(series.groups()) {
            for i in 0..BLOCK {
                a[i] += factors[0] * rows[0][i];
                b[i] += factors[1] * rows[1][i];
                c[i] += factors[2] * rows[2][i];
                d[i] += factors[3] * rows[3][i];
            }
        }
        *sums = std::array::from_fn(|i| (a[i] + b[i]) + (c[i] + d[i]));
    }
}

/// Properties of a series that decide the step made from it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outlook {
    /// Displacement over the whole step.
    pub(crate) moved: f64,
    /// Largest speed, in displacement per step: at the start, in the middle, or at the end.
    pub(crate) fastest: f64,
    /// The largest divided difference of order s + 1 at four points, s stages: it determines the interpolation error.
    pub(crate) steepest: f64,
}

impl Outlook {
    /// The properties of a series over a step of this length.
    pub(crate) fn over(series: &Series, length: f64) -> Self {
        Self::of(&series.over(length))
    }

    pub(crate) fn of(series: &Series) -> Self {
        let mut room = [[0.0; BLOCK]];
        let sums = OUTLOOK.sums(series, &mut room);
        let largest = |sums: &[f64]| sums.iter().fold(0.0, |most, sum| larger(sum.abs(), most));
        let (fastest, steepest) = (largest(&sums[1..4]), largest(&sums[4..]));
        Self { moved: sums[0], fastest, steepest }
    }
}

/// Factors of the coefficients in an [`Outlook`]: displacement, speeds at three points, divided differences at four.
static OUTLOOK: LazyLock<Table> = LazyLock::new(|| {
    Table::new(BLOCK, |n, k| match n {
        0 => 1.0,
        1..=3 => slope(0.5 * (3 - n) as f64, k),
        _ => difference((n - 4) as f64 / 3.0, k),
    })
});

/// The derivative of τ^k.
fn slope(tau: f64, k: usize) -> f64 {
    if k == 0 { 0.0 } else { k as f64 * tau.powi(k as i32 - 1) }
}

/// The derivative of τ^k of order s + 1, divided by (s + 1)!.
fn difference(tau: f64, k: usize) -> f64 {
    let n = STAGES + 1;
    let binomial = |k: usize| (1..=n).fold(1.0, |b, i| b * (k - n + i) as f64 / i as f64);
    if k < n { 0.0 } else { binomial(k) * tau.powi((k - n) as i32) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1/(1 + t) - 1, and its derivatives, in closed form.
    fn series() -> Series {
        let minus_one = |k: usize| if k == 0 { 0.0 } else { (-1.0_f64).powi(k as i32) };
        Series::of(&std::array::from_fn::<_, { MOST_ORDER + 1 }, _>(minus_one))
    }

    #[test]
    fn sums_are_values_of_the_polynomial() {
        let parts: Vec<f64> = (1..=11).map(|i| f64::from(i) / 11.0).collect();
        let (table, length) = (Table::of_parts(&parts), 0.2);
        let mut room = [[0.0; BLOCK]; 2];
        let sums = table.sums(&series().over(0.1).over(2.0), &mut room);
        assert_eq!(sums.len(), parts.len());
        for (part, sum) in parts.iter().zip(sums) {
            let exact = 1.0 / (1.0 + part * length) - 1.0;
            assert!((*sum - exact).abs() < 1e-14, "{part}: {sum} {exact}");
        }
    }

    #[test]
    fn powers_are_those_of_single_powers() {
        for x in [0.37_f64, 0.925, 1.0] {
            for (k, power) in powers(x).into_iter().enumerate() {
                assert_eq!(power.to_bits(), x.powi(k as i32).to_bits(), "{x}^{k}");
            }
        }
    }

    #[test]
    fn an_outlook_is_that_of_the_function() {
        let length: f64 = 0.2;
        let series = series().over(length);
        let Outlook { moved, fastest, steepest } = Outlook::of(&series);
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
        close(moved, 1.0 / (1.0 + length) - 1.0);
        close(series.slope_at_end(), -length / (1.0 + length).powi(2));
        close(fastest, length);
        // Derivatives of 1/(1 + t), at the start the largest.
        close(steepest, length.powi(7));
    }
}
