//! A real wave number and phase may have a marginal wave at some T only where a polynomial in T has a real zero: where on a
//! cell it has none, and where about its centre they are.

use super::patch::Patch;
use crate::newton::zeros_of;
use num_complex::Complex64;

/// Largest degree: two coordinates, there and back.
const MOST: usize = 4;
/// An interval of τ is halved no more often than this.
const MOST_HALVINGS: u32 = 30;

/// Q(T + τ) = c_0 + c_1 τ + … + τⁿ on a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polynomial {
    /// c_0, c_1, …, c_n = 1
    coefficients: [Patch; MOST + 1],
    degree: usize,
}

impl Polynomial {
    /// det(X + τ), of two to four rows: c_k is the sum of the principal minors of n - k rows.
    pub(super) fn of(x: &[Vec<Patch>]) -> Self {
        let degree = x.len();
        let mut coefficients = [Patch::constant(0.0); MOST + 1];
        coefficients[degree] = Patch::constant(1.0);
        // Rows of a minor as the bits of a number.
        for rows in 1_u32..1 << degree {
            let rows: Vec<usize> = (0..degree).filter(|i| rows >> i & 1 == 1).collect();
            let k = degree - rows.len();
            coefficients[k] = coefficients[k] + minor(x, &rows, &rows);
        }
        Self { coefficients, degree }
    }

    pub(super) fn value(&self) -> Patch {
        self.coefficients[0]
    }

    pub(super) fn slope(&self) -> Patch {
        self.coefficients[1]
    }

    /// Whether Q has no zero at any τ ≥ 0, anywhere on the cell.
    pub(super) fn has_none(&self) -> bool {
        let far = self.farthest();
        let mut intervals = vec![(0.5 * far, 0.5 * far, 0)];
        while let Some((centre, half, depth)) = intervals.pop() {
            let here = self.about(centre);
            if here.is_away(half) {
                continue;
            }
            // Narrower, what is left is the cell's own extent.
            if depth > MOST_HALVINGS || half * here.slope().value.norm() < here.value().reach() {
                return false;
            }
            let half = 0.5 * half;
            intervals.extend([centre + half, centre - half].map(|at| (at, half, depth + 1)));
        }
        true
    }

    /// An estimate of the largest τ with a zero on the cell; -∞ where they seem to be none.
    pub(super) fn promise(&self) -> f64 {
        let spread = self.value().reach();
        let each = self.zeros().into_iter().map(|zero| {
            let off = spread / self.derivative_at(zero).norm();
            if zero.im.abs() <= 2.0 * off { zero.re + off } else { f64::NEG_INFINITY }
        });
        each.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The largest τ among zeros at the centre of the cell, the nearer to the real axis the sooner.
    pub(super) fn largest(&self) -> f64 {
        let each = self.zeros().into_iter();
        let best = each.max_by(|a, b| (a.re - a.im.abs()).total_cmp(&(b.re - b.im.abs())));
        best.map_or(f64::NEG_INFINITY, |zero| zero.re)
    }

    fn zeros(&self) -> Vec<Complex64> {
        let centre: Vec<Complex64> =
            self.coefficients[..self.degree].iter().rev().map(|c| c.value).collect();
        zeros_of(&centre)
    }

    fn derivative_at(&self, tau: Complex64) -> Complex64 {
        let powers = (1..=self.degree).rev();
        powers.fold(Complex64::ZERO, |sum, k| sum * tau + self.coefficients[k].value * k as f64)
    }

    /// A bound of |τ| of all zeros (Fujiwara): twice the largest |c_{n-k}|^{1/k}.
    fn farthest(&self) -> f64 {
        let each = (1..=self.degree)
            .map(|k| self.coefficients[self.degree - k].size().powf(1.0 / k as f64));
        2.0 * each.fold(0.0, f64::max)
    }

    /// The same polynomial about another τ.
    fn about(&self, tau: f64) -> Self {
        let mut shifted = *self;
        for from in 0..self.degree {
            for k in (from..self.degree).rev() {
                let more = shifted.coefficients[k + 1] * tau;
                shifted.coefficients[k] = shifted.coefficients[k] + more;
            }
        }
        shifted
    }

    /// Whether Q ≠ 0 for |τ| ≤ `half`. To first order the values of Q fill a zonotope, of which 0 is no part where it is
    /// beyond one of its edges, or, for what is not of first order, far enough away.
    fn is_away(&self, half: f64) -> bool {
        let (value, slope) = (self.value(), self.slope());
        let along = [value.along[0], value.along[1], slope.value * half];
        let mut rest = value.rest + slope.reach() * half;
        let mut power = half;
        for c in &self.coefficients[2..=self.degree] {
            power *= half;
            rest += c.size() * power;
        }
        let is_beyond = |normal: Complex64| {
            let part = |z: Complex64| (z * normal.conj()).re.abs();
            let width: f64 = along.iter().map(|l| part(*l)).sum();
            part(value.value) > width + rest * normal.norm()
        };
        is_beyond(value.value) || along.iter().any(|edge| is_beyond(edge * Complex64::I))
    }
}

/// v with Xv = 0, up to a factor: the cofactors of a row, of the one where they are largest.
pub(super) fn null_vector(x: &[Vec<Patch>]) -> Vec<Complex64> {
    let without = |i: usize| -> Vec<usize> { (0..x.len()).filter(|j| *j != i).collect() };
    let cofactors = |row: usize| -> Vec<Complex64> {
        let each = (0..x.len()).map(|i| {
            let sign = if (row + i).is_multiple_of(2) { 1.0 } else { -1.0 };
            minor(x, &without(row), &without(i)).value * sign
        });
        each.collect()
    };
    let size = |v: &Vec<Complex64>| v.iter().map(Complex64::norm_sqr).sum::<f64>();
    let all = (0..x.len()).map(cofactors);
    all.max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or_default()
}

/// The determinant of these rows and columns of X.
pub(super) fn minor(x: &[Vec<Patch>], rows: &[usize], columns: &[usize]) -> Patch {
    let [first, others @ ..] = rows else { return Patch::constant(1.0) };
    if others.is_empty() {
        return x[*first][columns[0]];
    }
    let mut sum = Patch::constant(0.0);
    for (i, column) in columns.iter().enumerate() {
        let left: Vec<usize> = columns.iter().copied().filter(|other| other != column).collect();
        let term = x[*first][*column] * minor(x, others, &left);
        sum = if i % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}
