//! Radau IIA collocation: nodes, weights and the stage polynomial that is also the dense output.
//!
//! Reference: Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.5 and IV.8.

use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// Number of stages s: order 2s - 1 at step ends, s + 1 locally in between.
pub const STAGES: usize = 6;

/// One real number per stage.
pub type Stages = [f64; STAGES];

/// The s-stage Radau IIA method on the unit step.
pub struct Collocation {
    /// Nodes 0 < `c_1` < … < `c_s` = 1.
    pub c: Stages,
    /// `a_ij` = `∫_0^{c_i}` `ℓ_j(τ)dτ` with the Lagrange polynomials `ℓ_j` of the nodes.
    pub a: [Stages; STAGES],
    /// Derivatives at the nodes of the polynomial through 0 at τ = 0 and given values at the nodes: the inverse of
    /// `a`.
    pub derivative: [Stages; STAGES],
    /// Derivative at τ = 0 of the polynomial described at `derivative`.
    pub derivative_at_start: Stages,
    /// Entry j: derivatives at τ = 0 and at the nodes for a unit value at node j. The last derivative is repeated, to
    /// fill a vector register.
    slopes: [[f64; STAGES + 2]; STAGES],
    /// `max_τ |∫_0^τ N| / |N(0)|` with N(τ) = Π(τ - `c_i`): ratio of the largest error within a step to the product of
    /// its length and the defect at its start.
    pub defect_to_error: f64,
    /// `max_τ |τ N(τ)|`, τ in [0, 1]: the error of interpolation per divided difference.
    largest_node_product: f64,
    /// `1/Π_{k≠j}(c_j - c_k)`: the constant factors of the Lagrange polynomials.
    scales: Stages,
    /// Row m: coefficient of (τ-1)^{m+1} in the polynomial that is 0 at τ = 0 and has given values at the
    /// nodes.
    about_the_end: [Stages; STAGES],
}

/// The zeros of `P_s - P_{s-1}`, P the Legendre polynomials of 2τ-1.
const NODES: Stages = [
    0.03980985705146878,
    0.19801341787360816,
    0.43797481024738616,
    0.695464273353636,
    0.9014649142011736,
    1.0,
];

/// The method, built once per program.
pub static RADAU: LazyLock<Collocation> = LazyLock::new(Collocation::radau);

impl Collocation {
    fn radau() -> Self {
        let (c, rule) = (NODES, GaussLegendre::new(const { NonZeroUsize::new(STAGES).unwrap() }));
        let scales = std::array::from_fn(|j| {
            let others = (0..STAGES).filter(|&k| k != j);
            1.0 / others.map(|k| c[j] - c[k]).product::<f64>()
        });
        let lagrange = |j: usize, tau: f64| lagrange(&c, &scales, tau)[j];
        let mut a = [[0.0; STAGES]; STAGES];
        for (row, &ci) in a.iter_mut().zip(&c) {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = integral(&rule, ci, |tau| lagrange(j, tau));
            }
        }
        let mut derivative = [[0.0; STAGES]; STAGES];
        let mut derivative_at_start = [0.0; STAGES];
        for j in 0..STAGES {
            // d/dτ (τ/c_j ℓ_j) = (ℓ_j + τ ℓ_j')/c_j.
            derivative_at_start[j] = lagrange(j, 0.0) / c[j];
            for i in 0..STAGES {
                derivative[i][j] = if i == j {
                    let others = (0..STAGES).filter(|&k| k != j);
                    1.0 / c[j] + others.map(|k| 1.0 / (c[j] - c[k])).sum::<f64>()
                } else {
                    // At another node the basis function vanishes: its slope is the limit of a ratio.
                    let others = (0..STAGES).filter(|&k| k != i && k != j);
                    let ratio = |k: usize| (c[i] - c[k]) / (c[j] - c[k]);
                    c[i] / c[j] / (c[j] - c[i]) * others.map(ratio).product::<f64>()
                };
            }
        }
        let mut slopes = [[0.0; STAGES + 2]; STAGES];
        for (j, column) in slopes.iter_mut().enumerate() {
            column[0] = derivative_at_start[j];
            (0..STAGES).for_each(|i| column[i + 1] = derivative[i][j]);
            column[STAGES + 1] = column[STAGES];
        }
        let node_product = |tau: f64| c.iter().map(|c| tau - c).product::<f64>();
        let largest = |error: &dyn Fn(f64) -> f64| {
            (0..=200).map(|i| error(f64::from(i) / 200.0).abs()).fold(0.0, f64::max)
        };
        let from_defect = largest(&|tau| integral(&rule, tau, node_product));
        let defect_to_error = from_defect / node_product(0.0).abs();
        let largest_node_product = largest(&|tau| tau * node_product(tau));
        let about_the_end = coefficients_about_the_end(&c, &scales);
        Self {
            c,
            a,
            derivative,
            derivative_at_start,
            slopes,
            defect_to_error,
            largest_node_product,
            scales,
            about_the_end,
        }
    }

    /// Quadrature weights over the whole step, `b_j` = `a_sj`.
    pub fn b(&self) -> &Stages {
        &self.a[STAGES - 1]
    }

    /// Value at τ of the polynomial that is 0 at τ = 0 and `values` at the nodes.
    pub fn value(&self, values: &Stages, tau: f64) -> f64 {
        self.value_of(&lagrange(&self.c, &self.scales, tau), values, tau)
    }

    fn value_of(&self, basis: &Stages, values: &Stages, tau: f64) -> f64 {
        tau * (0..STAGES).map(|i| values[i] / self.c[i] * basis[i]).sum::<f64>()
    }

    /// Extrapolates the polynomial of [`value`](Self::value) beyond the unit step: its values at τ = 1 + `ratio` `c_i`,
    /// minus that at τ = 1.
    pub fn continued(&self, values: &Stages, ratio: f64) -> Stages {
        let beyond = self.about_the_end(values);
        self.c.map(|c| beyond(ratio * c))
    }

    /// As a function of y: the polynomial of [`value`](Self::value) at τ = 1 + y, minus its value at τ = 1.
    pub fn about_the_end(&self, values: &Stages) -> impl Fn(f64) -> f64 + use<> {
        let power = apply(&self.about_the_end, values);
        move |y| y * power.iter().rev().fold(0.0, |sum, p| sum * y + p)
    }

    /// The largest error of interpolation by the polynomial of [`value`](Self::value) on the unit step, from the
    /// `known` value at another τ. Both errors are the same divided difference times a product of node distances.
    pub fn interpolation_error(&self, values: &Stages, tau: f64, known: f64) -> f64 {
        let product: f64 = tau * self.c.iter().map(|c| tau - c).product::<f64>();
        (known - self.value(values, tau)).abs() * self.largest_node_product / product.abs()
    }

    /// The largest error of interpolation on the unit step, for a function with this divided difference of order s + 1.
    pub fn interpolation_bound(&self, difference: f64) -> f64 {
        self.largest_node_product * difference.abs()
    }

    /// Derivatives of the polynomial of [`value`](Self::value) at τ = 0 and at the nodes. The last one is repeated, to
    /// fill a vector register.
    #[inline]
    pub fn slopes(&self, values: &Stages) -> [f64; STAGES + 2] {
        let mut sums = [0.0; STAGES + 2];
        for (column, value) in self.slopes.iter().zip(values) {
            for (sum, slope) in sums.iter_mut().zip(column) {
                *sum += slope * value;
            }
        }
        sums
    }

    /// Derivative at τ of the polynomial of [`value`](Self::value).
    pub fn slope(&self, values: &Stages, tau: f64) -> f64 {
        self.value_and_slope(values, tau).1
    }

    /// [`value`](Self::value) and [`slope`](Self::slope), from one evaluation of the Lagrange polynomials.
    #[inline]
    pub fn value_and_slope(&self, values: &Stages, tau: f64) -> (f64, f64) {
        let (basis, slopes) = (lagrange(&self.c, &self.scales, tau), self.slopes(values));
        let slope = basis.iter().zip(&slopes[1..]).map(|(l, slope)| l * slope).sum();
        (self.value_of(&basis, values, tau), slope)
    }

    /// Value at τ of the polynomial of degree s - 1 through values at the nodes.
    pub fn between(&self, values: &Stages, tau: f64) -> f64 {
        lagrange(&self.c, &self.scales, tau).iter().zip(values).map(|(l, v)| l * v).sum()
    }
}

/// Nodes c and weights b of the method, both on the unit step.
pub fn nodes_and_weights() -> (Stages, Stages) {
    (RADAU.c, *RADAU.b())
}

/// Matrix times vector.
pub fn apply(matrix: &[Stages; STAGES], v: &Stages) -> Stages {
    std::array::from_fn(|i| (0..STAGES).map(|j| matrix[i][j] * v[j]).sum())
}

/// All `ℓ_j(τ)` over the nodes c: products of the differences before and after the j-th.
fn lagrange(c: &Stages, scales: &Stages, tau: f64) -> Stages {
    let mut basis = *scales;
    let (mut before, mut after) = (1.0, 1.0);
    for j in 0..STAGES {
        basis[j] *= before;
        before *= tau - c[j];
        let k = STAGES - 1 - j;
        basis[k] *= after;
        after *= tau - c[k];
    }
    basis
}

/// Coefficients of powers of y = τ - 1, m = 1 … s, from the values at the nodes: those of
/// `τ/c_j ℓ_j` are multiplied out.
fn coefficients_about_the_end(c: &Stages, scales: &Stages) -> [Stages; STAGES] {
    let mut rows = [[0.0; STAGES]; STAGES];
    for j in 0..STAGES {
        // (y + 1) Π_{k≠j} (y + 1 - c_k), lowest power first
        let mut power = [0.0; STAGES + 1];
        power[0] = scales[j] / c[j];
        let zeros = [0.0].into_iter().chain((0..STAGES).filter(|&k| k != j).map(|k| c[k]));
        for zero in zeros {
            for m in (0..=STAGES).rev() {
                let lower = if m > 0 { power[m - 1] } else { 0.0 };
                power[m] = power[m] * (1.0 - zero) + lower;
            }
        }
        rows.iter_mut().zip(&power[1..]).for_each(|(row, p)| row[j] = *p);
    }
    rows
}

/// The Legendre polynomials P_{n-1} and P_n.
pub(crate) fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut last, mut here) = (1.0, x);
    for k in 1..n {
        let k = k as f64;
        (last, here) = (here, ((2.0 * k + 1.0) * x * here - k * last) / (k + 1.0));
    }
    (last, here)
}

/// ∫_0^{end} of a polynomial of degree below 2s, by Gauss's rule of s nodes.
fn integral(rule: &GaussLegendre, end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let term = |(x, w): &(f64, f64)| 0.5 * end * w * f(0.5 * end * (1.0 + x));
    rule.as_node_weight_pairs().iter().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::roots::halved_between;
    use crate::sorting::sort_numbers;

    /// By bisection between the zeros of P_s, where the difference changes sign: every number that the program writes
    /// hangs on the last bits of these nodes. (The Jacobi rule of gauss-quad 0.3.2 sets the middle node of odd degrees to 0.)
    #[test]
    fn the_nodes_are_zeros_of_the_polynomials() {
        let difference = |x: f64| {
            let (last, here) = legendre(STAGES, x);
            here - last
        };
        let rule = GaussLegendre::new(NonZeroUsize::new(STAGES).unwrap());
        let mut brackets: Vec<f64> = rule.as_node_weight_pairs().iter().map(|(x, _)| *x).collect();
        sort_numbers(&mut brackets);
        let zeros = brackets.windows(2).map(|pair| halved_between(difference, pair[0], pair[1]));
        let nodes = zeros.map(|zero| 0.5 * (1.0 + zero)).chain([1.0]);
        assert!(nodes.map(f64::to_bits).eq(NODES.map(f64::to_bits)));
    }

    #[test]
    fn the_weights_integrate_polynomials_up_to_degree_2s_minus_2_and_no_further() {
        let miss = |degree: i32| {
            let sum: f64 = RADAU.b().iter().zip(&RADAU.c).map(|(b, c)| b * c.powi(degree)).sum();
            (sum - 1.0 / f64::from(degree + 1)).abs()
        };
        let exact = i32::try_from(2 * STAGES - 2).unwrap();
        for degree in 0..=exact {
            assert!(miss(degree) < 3e-16, "degree {degree}: {}", miss(degree));
        }
        assert!(miss(exact + 1) > 1e-8);
    }

    #[test]
    fn the_derivative_matrix_is_the_inverse_of_a() {
        for i in 0..STAGES {
            let unit = std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
            let back = apply(&RADAU.derivative, &apply(&RADAU.a, &unit));
            for (j, value) in back.iter().enumerate() {
                assert!((value - unit[j]).abs() < 1e-13, "{i} {j} {value}");
            }
        }
    }

    #[test]
    fn the_stage_polynomial_reproduces_a_polynomial_of_degree_s() {
        let p = |t: f64| t * (1.0 - 0.3 * t + 0.7 * t.powi(3) - 0.2 * t.powi(5));
        let slope = |t: f64| 1.0 - 0.6 * t + 2.8 * t.powi(3) - 1.2 * t.powi(5);
        let values = RADAU.c.map(p);
        for t in [0.0, 0.21, 0.5, 0.98, 1.0, 1.7] {
            assert!((RADAU.value(&values, t) - p(t)).abs() < 1e-12, "{t}");
            assert!((RADAU.slope(&values, t) - slope(t)).abs() < 1e-11, "{t}");
        }
        for (c, value) in RADAU.c.iter().zip(RADAU.continued(&values, 0.7)) {
            assert!((value - (p(1.0 + 0.7 * c) - p(1.0))).abs() < 1e-12, "{c}");
        }
        let start: f64 = (0..STAGES).map(|j| RADAU.derivative_at_start[j] * values[j]).sum();
        assert!((start - 1.0).abs() < 1e-13);
    }
}
