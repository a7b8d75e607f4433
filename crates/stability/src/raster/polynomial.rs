//! Q as a polynomial in T on a cell of wave numbers and phases. A wave is marginal at a T that is a real zero of Q. This
//! module shows that a cell has no such zero, or estimates those near its centre.

use super::patch::Patch;
use crate::newton::zeros_of;
use num_complex::Complex64;

/// Largest degree: two coordinates, on trace and retrace.
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
        if degree == MOST {
            coefficients[..MOST].copy_from_slice(&of_four(x));
            return Self { coefficients, degree };
        }
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
    pub(super) fn has_no_zero(&self) -> bool {
        if !self.coefficients.iter().all(|c| c.size().is_finite()) {
            return false;
        }
        let far = self.farthest();
        let mut intervals = vec![(0.5 * far, 0.5 * far, 0)];
        while let Some((centre, half, depth)) = intervals.pop() {
            let here = self.about(centre);
            if here.is_away(half) {
                continue;
            }
            // At a smaller half-width the extent of the cell itself dominates.
            if depth > MOST_HALVINGS || half * here.slope().value.norm() < here.value().reach() {
                return false;
            }
            let half = 0.5 * half;
            intervals.extend([centre + half, centre - half].map(|at| (at, half, depth + 1)));
        }
        true
    }

    /// An estimate of the largest τ with a zero on the cell; -∞ if there seems to be none.
    pub(super) fn promise(&self) -> f64 {
        let each = self.with_spreads().map(|(tau, spread)| tau + spread);
        each.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Real parts of those zeros at the centre of the cell that may be real elsewhere on the cell.
    pub(super) fn near_axis(&self) -> Vec<f64> {
        self.with_spreads().map(|(tau, _)| tau).collect()
    }

    /// As [`Self::near_axis`], each with the distance by which the zero may move on the cell, to first order.
    fn with_spreads(&self) -> impl Iterator<Item = (f64, f64)> {
        let reach = self.value().reach();
        self.zeros().into_iter().filter_map(move |zero| {
            let spread = reach / self.derivative_at(zero).norm();
            (zero.im.abs() <= 2.0 * spread).then_some((zero.re, spread))
        })
    }

    /// Re τ of the zero at the centre of the cell for which Re τ - |Im τ| is largest.
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

    /// The polynomial with τ shifted by `tau`.
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

    /// Whether Q ≠ 0 for |τ| ≤ `half`. To first order the values of Q fill a zonotope. Q ≠ 0 if 0 lies outside one of its
    /// edges, farther away than the bound of the higher orders.
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

/// c_0, …, c_3 of four rows, from the minors of the first two and of the last two (Laplace).
fn of_four(x: &[Vec<Patch>]) -> [Patch; MOST] {
    const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let pairs = |top: usize, bottom: usize| {
        PAIRS.map(|[i, j]: [usize; 2]| x[top][i] * x[bottom][j] - x[top][j] * x[bottom][i])
    };
    let (upper, lower) = (pairs(0, 1), pairs(2, 3));
    let det = upper[0] * lower[5] - upper[1] * lower[4] + upper[2] * lower[3] + upper[3] * lower[2]
        - upper[4] * lower[1]
        + upper[5] * lower[0];
    // Rows and columns 0, 1, i, along row i; and i, 2, 3.
    let with_upper = |i: usize| {
        let [first, second] = [1, 3].map(|at: usize| upper[at + i - 2]);
        x[i][0] * second - x[i][1] * first + x[i][i] * upper[0]
    };
    let with_lower = |i: usize| {
        let [first, second] = [1, 2].map(|at: usize| lower[at + 2 * i]);
        x[i][i] * lower[5] - x[i][2] * second + x[i][3] * first
    };
    let threes = with_upper(2) + with_upper(3) + with_lower(0) + with_lower(1);
    let across = [[0, 2], [0, 3], [1, 2], [1, 3]]
        .map(|[i, j]: [usize; 2]| x[i][i] * x[j][j] - x[i][j] * x[j][i]);
    let twos = across.into_iter().fold(upper[0] + lower[5], |sum, minor| sum + minor);
    [det, threes, twos, x[0][0] + x[1][1] + x[2][2] + x[3][3]]
}

/// v with Xv = 0, up to a factor: the cofactors of the row in which they are largest.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that look like chance.
    fn matrix(rows: usize) -> Vec<Vec<Patch>> {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut entry = || Patch {
            value: Complex64::new(random(), random()),
            along: [0.1, 0.05].map(|size| Complex64::new(random(), random()) * size),
            rest: 0.0,
        };
        (0..rows).map(|_| (0..rows).map(|_| entry()).collect()).collect()
    }

    /// The matrix at a place of the cell and τ, without its rests, and its determinant.
    fn determinant(x: &[Vec<Patch>], (y, z): (f64, f64), tau: f64) -> Complex64 {
        let at = |p: &Patch| p.value + p.along[0] * y + p.along[1] * z;
        let plain: Vec<Vec<Patch>> = (0..x.len())
            .map(|i| {
                let entry = |j: usize| at(&x[i][j]) + if i == j { tau } else { 0.0 };
                (0..x.len()).map(|j| Patch::constant(entry(j))).collect()
            })
            .collect();
        let all: Vec<usize> = (0..x.len()).collect();
        minor(&plain, &all, &all).value
    }

    #[test]
    fn a_polynomial_is_the_determinant_everywhere_on_its_cell() {
        for rows in [2, 3, 4] {
            let x = matrix(rows);
            let q = Polynomial::of(&x);
            for (y, z) in [(0.0, 0.0), (1.0, -1.0), (-0.4, 0.8), (1.0, 1.0)] {
                for tau in [0.0, 0.3, 1.7, 20.0] {
                    let about = q.about(tau).value();
                    let said = about.value + about.along[0] * y + about.along[1] * z;
                    let off = (determinant(&x, (y, z), tau) - said).norm();
                    assert!(
                        off <= about.rest + 1e-12 * about.size(),
                        "{rows} {off} {}",
                        about.rest
                    );
                }
            }
        }
    }

    /// A zero anywhere on the cell at some τ ≥ 0 is never ruled out; away from all of them every cell is.
    #[test]
    fn cells_with_a_zero_are_kept_and_others_are_not() {
        let (mut kept, mut ruled_out) = (0, 0);
        for rows in [2, 3, 4] {
            let x = matrix(rows);
            for i in -60..=60 {
                for size in [1.0, 0.1, 0.01] {
                    // det(X + τ - μ) with an eigenvalue of X + μ moved to -τ0, at a corner of the cell.
                    let (tau, corner) =
                        (0.02 * f64::from(i + 30), if i % 2 == 0 { 1.0 } else { -0.7 });
                    let mut shrunk: Vec<Vec<Patch>> = x.clone();
                    shrunk.iter_mut().flatten().for_each(|p| p.along = p.along.map(|l| l * size));
                    let at_corner = |p: &Patch| p.value + (p.along[0] + p.along[1]) * corner;
                    let plain: Vec<Vec<Patch>> = shrunk
                        .iter()
                        .map(|row| row.iter().map(|p| Patch::constant(at_corner(p))).collect())
                        .collect();
                    let zero = Polynomial::of(&plain).zeros()[0];
                    let diagonal = shrunk.iter_mut().enumerate();
                    diagonal.for_each(|(k, row)| row[k].value += zero - tau);
                    let q = Polynomial::of(&shrunk);
                    if tau >= 0.0 {
                        assert!(!q.has_no_zero(), "{rows} {tau} {size}");
                        kept += 1;
                    } else if q.has_no_zero() {
                        ruled_out += 1;
                    }
                }
            }
        }
        assert!(kept > 300 && ruled_out > 50, "{kept} {ruled_out}");
    }
}
