//! The spreading window φ: its formula, its polynomials, its transform.

mod fit;

use multiversion::multiversion;
use std::array::from_fn;
use std::sync::LazyLock;

/// Number of cells used for one source or one target.
pub(crate) const WIDTH: usize = 16;
const HALF: usize = WIDTH / 2;
/// Number of cells of the window below the position's own cell.
pub(crate) const BELOW: i64 = HALF as i64 - 1;

/// Shape parameter β = 12π, or 2.36 per cell: the main lobe of φ̂, |8κ| < β, ends at 2π − π/2, the alias of the edge of
/// the band κ = π/2. Barnett et al. use 2.30, for which φ ends in a step of 1e-16 instead of 4e-17. With β = 12π values
/// hardly differ, but derivatives are 2.5 times as accurate.
const SHAPE: f64 = 12.0 * std::f64::consts::PI;

/// Pairs of polynomial coefficients per weight. Degree 15 is at round-off, slopes included; degree 13 costs the
/// slopes a digit, and degree 19 gains nothing.
const PAIRS: usize = 8;
const COEFFICIENTS: usize = 2 * PAIRS;
/// Nodes of the transform per cell. Two are sufficient for an aliasing error (φ̂ at 4π − κ) at round-off.
const NODES_PER_CELL: usize = 2;
const NODES: usize = NODES_PER_CELL * HALF;

/// The "exponential of semicircle" window, `φ(z) = exp(β(√(1 − z²) − 1))` for |z| ≤ 1 and zero
/// beyond, with `z = m/8` at a distance of `m` cells, and β = 12π.
///
/// **Method.** Within a cell each of the sixteen weights is an analytic function of the offset; each is represented
/// by a polynomial of degree 15, its power series about the middle of the cell economised by Chebyshev polynomials.
/// As φ is even, weight `k` at offset `t` is weight `15 − k` at `1 − t`: even and odd parts of eight polynomials give
/// all sixteen, in loops of fixed length over neighbours.
///
/// **Guarantee.** Weights are within 1e-15 of the formula, whose peak is 1, and their slopes within
/// 1e-15 (from 1/100 of a cell inside the ends, where the formula's slope is infinite).
#[derive(Clone, Debug)]
pub struct Window {
    /// `even[p][k]`: coefficient of `s^{2p}` in weight `k` of the lower eight, `s = 2·offset − 1`.
    even: [[f64; HALF]; PAIRS],
    /// `odd[p][k]`: coefficient of `s^{2p+1}`.
    odd: [[f64; HALF]; PAIRS],
    /// The even coefficients, weight by weight, for [`read`](Self::read).
    even_of: [[f64; PAIRS]; HALF],
    odd_of: [[f64; PAIRS]; HALF],
    /// φ at the nodes of the transform, from the center outwards.
    nodes: [f64; NODES + 1],
}

static SHARED: LazyLock<Window> = LazyLock::new(Window::fit);

impl Window {
    /// The only window of this crate, fitted on first use.
    pub fn shared() -> &'static Self {
        &SHARED
    }

    /// The formula `φ(z)`, its exponent written `−βz²/(1 + √(1 − z²))`: the difference
    /// `√(1 − z²) − 1`, rounded and multiplied by β, would cost 38 roundings at the peak.
    pub fn formula(z: f64) -> f64 {
        let square = 1.0 - z * z;
        if square < 0.0 { 0.0 } else { (-SHAPE * z * z / (1.0 + square.sqrt())).exp() }
    }

    fn fit() -> Self {
        let power = fit::lower_weights();
        let even_of = from_fn(|cell| from_fn(|p| power[cell][2 * p]));
        let odd_of = from_fn(|cell| from_fn(|p| power[cell][2 * p + 1]));
        Self {
            even: from_fn(|p| from_fn(|cell| power[cell][2 * p])),
            odd: from_fn(|p| from_fn(|cell| power[cell][2 * p + 1])),
            even_of,
            odd_of,
            nodes: from_fn(|node| Self::formula(node as f64 / NODES as f64)),
        }
    }

    /// The sixteen weights `φ((k − 7 − offset)/8)`, `k = 0..16`, of the cells around a position. The position is
    /// `offset` spacings above the cell of weight 7; `offset` is in [0, 1].
    #[inline(always)]
    pub fn weights(&self, offset: f64) -> [f64; WIDTH] {
        let s = 2.0 * offset - 1.0;
        let square = s * s;
        let (mut even, mut odd) = (self.even[PAIRS - 1], self.odd[PAIRS - 1]);
        for p in (0..PAIRS - 1).rev() {
            for k in 0..HALF {
                even[k] = even[k] * square + self.even[p][k];
                odd[k] = odd[k] * square + self.odd[p][k];
            }
        }
        unfold(even, odd.map(|o| o * s))
    }

    /// The sixteen weights, and their derivatives with respect to the offset.
    pub fn weights_and_slopes(&self, offset: f64) -> ([f64; WIDTH], [f64; WIDTH]) {
        let s = 2.0 * offset - 1.0;
        let parts: [_; HALF] = from_fn(|k| {
            let (even, even_slope) = horner(&self.even_of[k], s * s);
            let (odd, odd_slope) = horner(&self.odd_of[k], s * s);
            // Slopes of e(s²) and of s·o(s²); the offset runs twice as slowly as s.
            [even, s * odd, 4.0 * s * even_slope, 2.0 * odd + 4.0 * s * s * odd_slope]
        });
        let of = |i: usize| parts.map(|part| part[i]);
        (unfold(of(0), of(1)), unfold(of(2), of(3)))
    }

    /// `Σ_k weight_k cells_k` and its derivative with respect to the offset.
    ///
    /// Cells are contracted with the coefficients first, which gives one polynomial in the offset; its derivative is
    /// then cheap.
    #[inline]
    pub fn read(&self, cells: &[f64; WIDTH], offset: f64) -> (f64, f64) {
        let (even, odd) = contracted(&self.even_of, &self.odd_of, cells);
        let s = 2.0 * offset - 1.0;
        let (e, e_slope) = horner(&even, s * s);
        let (o, o_slope) = horner(&odd, s * s);
        // Value e(s²) + s·o(s²); the offset runs twice as slowly as s.
        (e + s * o, 2.0 * (2.0 * s * e_slope + o + 2.0 * s * s * o_slope))
    }

    /// The transform `φ̂(κ) = ∫ φ(m/8) cos(κm) dm` over distances in cells, for `κ = k·spacing`
    /// with |κ| ≤ π.
    ///
    /// It is computed by the trapezoidal rule. The error is φ̂ at 4π − κ: round-off, like φ at its ends.
    pub fn transform(&self, kappa: f64) -> f64 {
        let step = kappa / NODES_PER_CELL as f64;
        let off_center: f64 =
            (1..=NODES).rev().map(|node| self.nodes[node] * (node as f64 * step).cos()).sum();
        (self.nodes[0] + 2.0 * off_center) / NODES_PER_CELL as f64
    }
}

/// Weight `k` is even + odd, weight `15 − k` is even − odd.
#[inline(always)]
fn unfold(even: [f64; HALF], odd: [f64; HALF]) -> [f64; WIDTH] {
    let mut all = [0.0; WIDTH];
    for k in 0..HALF {
        all[k] = even[k] + odd[k];
        all[WIDTH - 1 - k] = even[k] - odd[k];
    }
    all
}

/// Coefficients of the polynomial `Σ_k weight_k cells_k` in `s`: those of the even and of the odd powers.
///
/// Also compiled for wider vectors, because the powers are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
fn contracted(
    even_of: &[[f64; PAIRS]; HALF],
    odd_of: &[[f64; PAIRS]; HALF],
    cells: &[f64; WIDTH],
) -> ([f64; PAIRS], [f64; PAIRS]) {
    let (mut even, mut odd) = ([0.0; PAIRS], [0.0; PAIRS]);
    for k in 0..HALF {
        let (sum, difference) = (cells[k] + cells[WIDTH - 1 - k], cells[k] - cells[WIDTH - 1 - k]);
        for p in 0..PAIRS {
            even[p] += even_of[k][p] * sum;
            odd[p] += odd_of[k][p] * difference;
        }
    }
    (even, odd)
}

/// A polynomial and its derivative.
#[inline]
fn horner(coefficients: &[f64; PAIRS], x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (coefficients[PAIRS - 1], 0.0);
    for &c in coefficients[..PAIRS - 1].iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    (value, slope)
}
