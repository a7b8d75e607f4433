//! Coefficients of the explicit Runge–Kutta pairs.

use differential_equations::tableau::ButcherTableau;

/// One pair: x_i = x + h Σ_l a_il k_l, x(t+h) = x + h Σ b_l k_l, with one or two estimates of the error, h Σ e_l k_l.
pub(crate) struct Tableau {
    pub(crate) c: Vec<f64>,
    pub(crate) a: Vec<Vec<f64>>,
    pub(crate) b: Vec<f64>,
    pub(crate) error: Vec<f64>,
    /// Dormand and Prince's second estimate, of order 3; empty for a 5(4) pair.
    pub(crate) error3: Vec<f64>,
    pub(crate) order: i32,
    /// Whether the last stage is the first of the next step.
    pub(crate) first_same_as_last: bool,
}

impl Tableau {
    /// Order 5(4), 7 stages, 6 per step: J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19. The pair
    /// of ode45.
    pub(crate) fn dopri5() -> Self {
        let t = ButcherTableau::<f64, 7>::dopri5();
        Self::from_parts(&t.c, &t.a, &t.b, t.er.unwrap_or_default(), None, 5, true)
    }

    /// Order 8(5,3), 12 stages: E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential
    /// Equations I, section II.5.
    pub(crate) fn dop853() -> Self {
        let t = ButcherTableau::<f64, 12, 16>::dop853();
        Self::from_parts(&t.c, &t.a, &t.b, t.er.unwrap_or_default(), t.bh, 8, false)
    }

    fn from_parts<const S: usize, const I: usize>(
        c: &[f64; I],
        a: &[[f64; I]; I],
        b: &[f64; S],
        error: [f64; S],
        lower: Option<[f64; S]>,
        order: i32,
        first_same_as_last: bool,
    ) -> Self {
        let difference = |lower: [f64; S]| b.iter().zip(lower).map(|(b, l)| b - l).collect();
        Self {
            c: c[..S].to_vec(),
            a: a[..S].iter().map(|row| row[..S].to_vec()).collect(),
            b: b.to_vec(),
            error: error.to_vec(),
            error3: lower.map(difference).unwrap_or_default(),
            order,
            first_same_as_last,
        }
    }

    pub(crate) fn stages(&self) -> usize {
        self.b.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ b c^{k-1} = 1/k up to the order (quadrature conditions), row sums equal c, and error weights sum to 0: these
    /// detect a mistyped digit.
    #[test]
    fn the_coefficients_meet_their_quadrature_conditions() {
        for tableau in [Tableau::dopri5(), Tableau::dop853()] {
            for k in 1..=tableau.order {
                let sum: f64 =
                    tableau.b.iter().zip(&tableau.c).map(|(b, c)| b * c.powi(k - 1)).sum();
                assert!((sum - 1.0 / f64::from(k)).abs() < 1e-14, "order {k}: {sum}");
            }
            for (row, c) in tableau.a.iter().zip(&tableau.c) {
                assert!((row.iter().sum::<f64>() - c).abs() < 1e-14);
            }
            for weights in [&tableau.error, &tableau.error3] {
                assert!(weights.iter().sum::<f64>().abs() < 1e-14);
            }
            let last = &tableau.a[tableau.stages() - 1];
            let same = last.iter().zip(&tableau.b).all(|(a, b)| (a - b).abs() < 1e-16);
            assert_eq!(same, tableau.first_same_as_last);
        }
    }
}
