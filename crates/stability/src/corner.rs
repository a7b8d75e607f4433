//! Non-smooth onset: the height under the steady tip is 0, on the kink of |h| of a depth limit.
//!
//! w - 1 = -|h|/b is of first order in a small deviation, but not linear. The equation of small deviations is
//! nevertheless homogeneous: any positive multiple of a solution is a solution. So there is one α at which an
//! oscillation of any (small) amplitude neither grows nor decays. This oscillation contains the harmonics of |h|. With
//! p_n = inΩ + s, the deviation ξ = Σξ_n e^{inθ}, W = -|h|/b and bare(Λ) = Mr²Λ² + rΛ + 1 it satisfies
//!
//! ```text
//!     (bare(inΩ) + A(G(p_n) - G(s))) ξ_n = A φ1(p_n) W_n,    h_n = -A(φ1(s) - φ1(p_n)) ξ_n - A φ(p_n) W_n
//! ```
//!
//! These equations are solved for A, Ω and the harmonics with ξ_1 = 1, by fixed-point iteration of W. The iteration
//! diverges if b is so small that the harmonics of |h| are large: for β = 1, r = 1 below a b between 1 and 0.7.

use super::crossings::Crossing;
use super::law::Law;
use super::newton::real_steps;
use super::one_sided::{Jet, Values};
use num_complex::Complex64;
use std::f64::consts::TAU;
use stickslip_tip::roots::zero_between;

/// Number of harmonics. Harmonics of |h| decrease like n^{-2}, harmonics of h like n^{-3}. So does the truncation error
/// (measured: a factor of 8.0 from 192 to 384); a second solution with twice this number removes most of it.
const HARMONICS: usize = 128;
/// Points on a period, between which h changes its sign at most once.
const POINTS: u32 = 512;
const MOST_ROUNDS: usize = 200;
/// Change of A and Ω below which they have converged.
const SETTLED: f64 = 1e-13;

/// The A and Ω of the oscillation of constant amplitude, starting from those without a depth limit; `None` if the
/// iteration for W does not converge.
pub(super) fn onset(law: &Law, limit: f64, start: Crossing) -> Option<Crossing> {
    let few = balanced(law, limit, start, HARMONICS)?;
    let many = balanced(law, limit, few, 2 * HARMONICS)?;
    let beyond = |few: f64, many: f64| many + (many - few) / 7.0;
    Some(Crossing {
        density: beyond(few.density, many.density),
        wave_number: beyond(few.wave_number, many.wave_number),
    })
}

fn balanced(law: &Law, limit: f64, start: Crossing, harmonics: usize) -> Option<Crossing> {
    let mut pushed = vec![Complex64::ZERO; harmonics + 1];
    let mut crossing = start;
    for _ in 0..MOST_ROUNDS {
        let next = fundamental(law, pushed[1], crossing)?;
        let heights = heights(law, &pushed, next);
        let new: Vec<Complex64> = magnitude(&heights).iter().map(|h| -h / limit).collect();
        let moved = (next.density / crossing.density - 1.0).abs()
            + (next.wave_number / crossing.wave_number - 1.0).abs()
            + new.iter().zip(&pushed).map(|(a, b)| (a - b).norm()).sum::<f64>();
        (pushed, crossing) = (new, next);
        if moved < SETTLED * harmonics as f64 {
            return Some(crossing);
        }
        if !moved.is_finite() {
            return None;
        }
    }
    None
}

/// φ, φ1, G - G(s) and the first factor bare(inΩ), each with its derivative.
fn parts(law: &Law, lambda: Complex64) -> [Jet; 4] {
    let Values { height, slope, curvature } = law.footprint.plain(lambda + law.fading);
    let groove = (curvature.0 - law.steady.curvature, curvature.1);
    [height, slope, groove, law.bare(lambda)]
}

/// A and Ω at which the fundamental balances for a given W_1, by Newton's method.
fn fundamental(law: &Law, pushed: Complex64, start: Crossing) -> Option<Crossing> {
    let Crossing { mut density, mut wave_number } = start;
    for _ in 0..30 {
        let [_, slope, groove, bare] = parts(law, Complex64::new(0.0, wave_number));
        let along_a = groove.0 - slope.0 * pushed;
        let value = bare.0 + along_a * density;
        let along_q = (bare.1 + (groove.1 - slope.1 * pushed) * density) * Complex64::I;
        let [step_a, step_q] = real_steps(value, [along_a, along_q]);
        density -= step_a;
        wave_number -= step_q;
        if !(density > 0.0 && wave_number > 0.0) {
            return None;
        }
        if step_a.abs() <= 1e-15 * density && step_q.abs() <= 1e-15 * wave_number {
            break;
        }
    }
    Some(Crossing { density, wave_number })
}

/// h_n for n ≥ 0.
fn heights(law: &Law, pushed: &[Complex64], at: Crossing) -> Vec<Complex64> {
    let a = at.density;
    let height = |(n, w): (usize, &Complex64)| {
        let [height, slope, groove, bare] =
            parts(law, Complex64::new(0.0, at.wave_number * n as f64));
        let moved = if n == 1 { Complex64::ONE } else { slope.0 * w * a / (bare.0 + groove.0 * a) };
        (slope.0 - law.steady.slope) * moved * a - height.0 * w * a
    };
    pushed.iter().enumerate().map(height).collect()
}

/// The harmonics of |h|: h times its sign, whose harmonics follow from the zeros of h.
fn magnitude(heights: &[Complex64]) -> Vec<Complex64> {
    let grid: Vec<f64> = (0..=POINTS).map(|i| TAU * f64::from(i) / f64::from(POINTS)).collect();
    let values = series(heights, &grid);
    let value = |angle: f64| series(heights, &[angle])[0];
    let changes: Vec<f64> = (1..grid.len())
        .filter(|i| values[i - 1] * values[*i] < 0.0)
        .map(|i| zero_between(value, grid[i - 1], grid[i]))
        .collect();
    let signs = harmonics_of_sign(values[0].signum(), &changes, 2 * heights.len());
    // Of the product: the sum over m of h_m s_{n - m}, for m from the most negative on.
    let (heights, signs) = (both_sides(heights), both_sides(&signs));
    let middle = signs.len() / 2;
    let most = heights.len() / 2;
    (0..=most)
        .map(|n| {
            let signs = &signs[..=middle + n + most];
            heights.iter().zip(signs.iter().rev()).map(|(h, s)| h * s).sum()
        })
        .collect()
}

/// The real function with harmonics f_n, n ≥ 0, at these angles.
fn series(harmonics: &[Complex64], angles: &[f64]) -> Vec<f64> {
    let turns: Vec<Complex64> = angles.iter().map(|a| Complex64::from_polar(1.0, *a)).collect();
    let mut sums = vec![Complex64::ZERO; angles.len()];
    for f in harmonics.iter().skip(1).rev() {
        for (sum, turn) in sums.iter_mut().zip(&turns) {
            *sum = (*sum + f) * turn;
        }
    }
    sums.iter().map(|sum| harmonics[0].re + 2.0 * sum.re).collect()
}

/// Harmonics f_n of a real function for all n, ascending, from those for n ≥ 0.
fn both_sides(harmonics: &[Complex64]) -> Vec<Complex64> {
    let negative = harmonics.iter().skip(1).rev().map(Complex64::conj);
    negative.chain(harmonics.iter().copied()).collect()
}

/// Harmonics of a function that is `first` = ±1 at 0 and changes its sign at `changes`.
fn harmonics_of_sign(first: f64, changes: &[f64], count: usize) -> Vec<Complex64> {
    let mut mean = first;
    let mut sums = vec![Complex64::ZERO; count];
    let mut sign = first;
    for angle in changes {
        // From here on -sign: a step of -2 sign.
        mean -= 2.0 * sign * (1.0 - angle / TAU);
        let turn = Complex64::from_polar(1.0, -angle);
        let mut power = Complex64::ONE;
        for (n, sum) in sums.iter_mut().enumerate().skip(1) {
            power *= turn;
            *sum -= power * (2.0 * sign / (TAU * n as f64)) * -Complex64::I;
        }
        sign = -sign;
    }
    sums[0] = mean.into();
    sums
}
