//! The contribution of a step to the groove of a surface that heals meanwhile.

use super::linear_system::Factors;
use super::own::{Matrix, carving};
use crate::collocation::{RADAU, STAGES};

/// Weights of each stage in the groove at each stage, for a step of length h and a decay as e^{-t/T}: y' = g - y/T
/// from y = 0 is y = (1 + hA/T)⁻¹hA g.
pub fn healing(h: f64, time: f64) -> Matrix {
    let factors = implicit(h / time);
    columns(|k| factors.solve(&std::array::from_fn(|i| h * RADAU.a[i][k])))
}

/// The derivative of the matrix of [`healing`](fn@healing) by the length of the step: NAN with N = (1 + hA/T)⁻¹.
pub fn healing_rate(h: f64, time: f64) -> Matrix {
    let factors = implicit(h / time);
    // A and N are functions of each other, and so NAN = NNA.
    columns(|k| factors.solve(&factors.solve(&std::array::from_fn(|i| RADAU.a[i][k]))))
}

/// The factors of 1 + `share` A, which is regular for every share ≥ 0: the eigenvalues of A lie right of 0.
pub(super) fn implicit(share: f64) -> Factors {
    let mut matrix = carving(share);
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] += 1.0;
    }
    Factors::of(matrix).unwrap_or_else(|| unreachable!("A is stable"))
}

pub(super) fn columns(column: impl Fn(usize) -> [f64; STAGES]) -> Matrix {
    let columns: Matrix = std::array::from_fn(column);
    std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::apply;

    /// y' = cos t - y/T has a closed solution.
    #[test]
    fn what_fades_while_it_is_left_is_that_of_the_differential_equation() {
        for (h, time) in [(0.5, 0.7), (0.1, 30.0), (1e-3, 1e9)] {
            let left = apply(&healing(h, time), &RADAU.c.map(|c| (h * c).cos()));
            for (c, y) in RADAU.c.iter().zip(left) {
                let (t, s) = (h * c, 1.0 / time);
                let exact = (s * t.cos() + t.sin() - s * (-s * t).exp()) / (1.0 + s * s);
                assert!((y - exact).abs() < 1e-7 * h.powi(7) * 128.0 + 1e-16, "{h} {time} {c}");
            }
        }
    }

    #[test]
    fn the_rate_is_the_derivative_by_the_length() {
        for (h, time) in [(0.5, 0.7), (0.1, 30.0), (1e-3, 1e9), (2.0, 0.01)] {
            let (by, rate) = (1e-4 * h, healing_rate(h, time));
            let at = |n: f64| healing(n.mul_add(by, h), time);
            let (near, far) = ([at(1.0), at(-1.0)], [at(2.0), at(-2.0)]);
            for i in 0..STAGES {
                for k in 0..STAGES {
                    let near = 8.0 * (near[0][i][k] - near[1][i][k]);
                    let difference = (near - (far[0][i][k] - far[1][i][k])) / (12.0 * by);
                    assert!((rate[i][k] - difference).abs() < 1e-10, "{h} {time} {i} {k}");
                }
            }
        }
    }

    #[test]
    fn a_step_much_longer_than_the_healing_leaves_what_is_left_just_now() {
        let left = apply(&healing(1.0, 1e-9), &RADAU.c);
        for (c, y) in RADAU.c.iter().zip(left) {
            assert!((y - 1e-9 * c).abs() < 1e-16, "{c} {y}");
        }
    }
}
