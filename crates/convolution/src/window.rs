//! The spreading window φ: its formula, its polynomials, its transform.

use std::array::from_fn;
use std::sync::LazyLock;

/// Cells touched by one source or one target.
pub(crate) const WIDTH: usize = 16;
const HALF: usize = WIDTH / 2;
/// Cells of the window at or below the position's own cell, besides that cell.
pub(crate) const BELOW: i64 = HALF as i64 - 1;

/// Shape parameter β = 12π, or 2.36 per cell: the main lobe of φ̂, |8κ| < β, ends where the edge of
/// the band, κ = π/2, is folded to, 2π − π/2. Barnett et al. take 2.30, which leaves φ ending in a
/// step of 1e-16 instead of 4e-17; values hardly tell, but derivatives read 2.5 times better so.
const SHAPE: f64 = 12.0 * std::f64::consts::PI;

/// Pairs of polynomial coefficients per cell: degree 19 brings the fit to round-off, slopes too.
const PAIRS: usize = 9;
const COEFFICIENTS: usize = 2 * PAIRS;
/// Terms of the power series that the polynomials are cut from: the slowest, of the outermost cell
/// whose end is the branch point of the square root, is below 1e-17 from here on.
const TERMS: usize = 40;

/// Nodes of the transform per cell. Two already put the folded part of φ̂ (at 4π − κ) at round-off.
const NODES_PER_CELL: usize = 2;
const NODES: usize = NODES_PER_CELL * HALF;

/// The "exponential of semicircle" window, `φ(z) = exp(β(√(1 − z²) − 1))` for |z| ≤ 1 and zero
/// beyond, with `z = m/8` at a distance of `m` cells, and β = 12π.
///
/// **Method.** Within a cell each of the sixteen weights is an analytic function of the offset;
/// each is held as a
/// polynomial of degree 19, its power series about the middle cut down by Chebyshev polynomials. As φ is even, weight
/// `k` at offset `t` is weight `15 − k` at `1 − t`: even and odd parts of eight polynomials give
/// all sixteen, in loops of fixed length over neighbouring numbers.
///
/// **Guarantee.** Weights are within 1e-15 of the formula (whose peak is 1), and slopes within
/// 2e-14 of theirs (whose peak is 0.5).
#[derive(Clone, Debug)]
pub struct Window {
    /// `even[p][k]`: coefficient of `s^{2p}` in weight `k` of the lower eight, `s = 2·offset − 1`.
    even: [[f64; HALF]; PAIRS],
    /// `odd[p][k]`: coefficient of `s^{2p+1}`.
    odd: [[f64; HALF]; PAIRS],
    /// The same, weight by weight, for [`read`](Self::read).
    even_of: [[f64; PAIRS]; HALF],
    odd_of: [[f64; PAIRS]; HALF],
    /// φ at the nodes of the transform, from the centre outwards.
    nodes: [f64; NODES + 1],
}

static SHARED: LazyLock<Window> = LazyLock::new(Window::fit);

impl Window {
    /// The one window of this crate, fitted on first use.
    pub fn shared() -> &'static Self {
        &SHARED
    }

    /// The formula `φ(z)`, its exponent written `−βz²/(1 + √(1 − z²))`: the difference `√(1 − z²) − 1`
    /// would cost 36 roundings at the peak.
    pub fn formula(z: f64) -> f64 {
        let square = 1.0 - z * z;
        if square < 0.0 { 0.0 } else { (-SHAPE * z * z / (1.0 + square.sqrt())).exp() }
    }

    fn fit() -> Self {
        let chebyshev = chebyshev();
        let step = -0.5 / HALF as f64;
        let power: [[f64; TERMS]; HALF] = from_fn(|cell| {
            let centre = (cell as f64 - BELOW as f64 - 0.5) / HALF as f64;
            economised(series(centre, step), &chebyshev)
        });
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

    /// The sixteen weights `φ((k − 7 − offset)/8)`, `k = 0..16`, of the cells from seven below to
    /// eight above the one at or below a position, for an offset in [0, 1] spacings above it.
    #[inline]
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

    /// The weights, and their derivatives with respect to the offset.
    #[inline]
    pub fn weights_and_slopes(&self, offset: f64) -> ([f64; WIDTH], [f64; WIDTH]) {
        let s = 2.0 * offset - 1.0;
        let square = s * s;
        let mut odd_slope = [0.0; HALF];
        let mut even_slope = [0.0; HALF];
        for p in (0..PAIRS).rev() {
            for k in 0..HALF {
                // The offset runs half as far as s: 2 d/ds of s^{2p+1} and of s^{2p}.
                odd_slope[k] = odd_slope[k] * square + (4 * p + 2) as f64 * self.odd[p][k];
                even_slope[k] = if p == 0 {
                    even_slope[k]
                } else {
                    even_slope[k] * square + (4 * p) as f64 * self.even[p][k]
                };
            }
        }
        (self.weights(offset), unfold(even_slope.map(|o| o * s), odd_slope))
    }

    /// `Σ_k weight_k cells_k` and its derivative with respect to the offset.
    ///
    /// Cells are contracted with the coefficients first, which leaves one polynomial in the offset:
    /// its derivative then costs next to nothing.
    #[inline]
    pub(crate) fn read(&self, cells: &[f64; WIDTH], offset: f64) -> (f64, f64) {
        let mut even = [0.0; PAIRS];
        let mut odd = [0.0; PAIRS];
        for k in 0..HALF {
            let sum = cells[k] + cells[WIDTH - 1 - k];
            let difference = cells[k] - cells[WIDTH - 1 - k];
            for p in 0..PAIRS {
                even[p] += self.even_of[k][p] * sum;
                odd[p] += self.odd_of[k][p] * difference;
            }
        }
        let s = 2.0 * offset - 1.0;
        let (e, e_slope) = horner(&even, s * s);
        let (o, o_slope) = horner(&odd, s * s);
        // Value e(s²) + s·o(s²); the offset runs twice as slowly as s.
        (e + s * o, 2.0 * (2.0 * s * e_slope + o + 2.0 * s * s * o_slope))
    }

    /// The transform `φ̂(κ) = ∫ φ(m/8) cos(κm) dm` over distances in cells, for `κ = k·spacing`
    /// with |κ| ≤ π.
    ///
    /// By the trapezoidal rule, whose error is φ̂ at 4π − κ: round-off, like φ at its ends.
    pub fn transform(&self, kappa: f64) -> f64 {
        let step = kappa / NODES_PER_CELL as f64;
        let off_centre: f64 =
            (1..=NODES).rev().map(|node| self.nodes[node] * (node as f64 * step).cos()).sum();
        (self.nodes[0] + 2.0 * off_centre) / NODES_PER_CELL as f64
    }
}

/// Weight `k` is even + odd, weight `15 − k` is even − odd.
#[inline]
fn unfold(even: [f64; HALF], odd: [f64; HALF]) -> [f64; WIDTH] {
    let mut all = [0.0; WIDTH];
    for k in 0..HALF {
        all[k] = even[k] + odd[k];
        all[WIDTH - 1 - k] = even[k] - odd[k];
    }
    all
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

/// The power series in `s` of `φ(centre + step·s)`, by the recurrences of the square root and of
/// the exponential. Unlike an interpolant of rounded samples, it has high coefficients as accurate
/// as they are small, which the slopes need.
fn series(centre: f64, step: f64) -> [f64; TERMS] {
    // r² = 1 − z², and then φ' = β r' φ.
    let square = [1.0 - centre * centre, -2.0 * centre * step, -step * step];
    let mut root = [0.0; TERMS];
    let mut phi = [0.0; TERMS];
    root[0] = square[0].sqrt();
    phi[0] = Window::formula(centre);
    for n in 1..TERMS {
        let cross: f64 = (1..n).map(|i| root[i] * root[n - i]).sum();
        root[n] = (square.get(n).unwrap_or(&0.0) - cross) / (2.0 * root[0]);
        let sum: f64 = (1..=n).map(|i| i as f64 * root[i] * phi[n - i]).sum();
        phi[n] = SHAPE * sum / n as f64;
    }
    phi
}

/// Lowers the degree on [−1, 1], each power from the top giving way to the multiple of a Chebyshev
/// polynomial that it leads (Lanczos).
fn economised(mut powers: [f64; TERMS], chebyshev: &[[f64; TERMS]; TERMS]) -> [f64; TERMS] {
    for n in (COEFFICIENTS..TERMS).rev() {
        let factor = powers[n] / chebyshev[n][n];
        for (power, t) in powers.iter_mut().zip(&chebyshev[n]) {
            *power -= factor * t;
        }
    }
    powers
}

/// Coefficients of the Chebyshev polynomials, integers exact up to 2⁵³: `T_n = 2s T_{n−1} − T_{n−2}`.
fn chebyshev() -> [[f64; TERMS]; TERMS] {
    let mut all = [[0.0; TERMS]; TERMS];
    (all[0][0], all[1][1]) = (1.0, 1.0);
    for n in 2..TERMS {
        for d in 0..=n {
            let shifted = if d == 0 { 0.0 } else { all[n - 1][d - 1] };
            all[n][d] = 2.0 * shifted - all[n - 2][d];
        }
    }
    all
}
