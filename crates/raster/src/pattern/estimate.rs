//! Estimates with errors, from the scatter among quarters of the evaluated area.

/// A value and half of its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// Student's t for three degrees of freedom at 97.5 %, over √3: half of the 95 % interval of the mean of four values,
/// in units of their standard deviation (with divisor 4).
const OF_FOUR: f64 = 3.182_446_305_284_263 / 1.732_050_807_568_877_2;

impl Estimate {
    /// The value of the whole, with the error of the weighted mean of its quarters.
    pub(super) fn of_quarters(value: f64, quarters: &[(f64, f64); 4]) -> Self {
        let weight: f64 = quarters.iter().map(|(_, weight)| weight).sum();
        let apart = |(quarter, weight): &(f64, f64)| weight * (quarter - value).powi(2);
        let square: f64 = quarters.iter().map(apart).sum();
        let error = if weight > 0.0 { OF_FOUR * (square / weight).sqrt() } else { f64::INFINITY };
        Self { value, error }
    }

    /// Adds a further error linearly, because the two may be correlated.
    pub(super) fn and(self, error: f64) -> Self {
        Self { error: self.error + error, ..self }
    }

    pub(super) fn enclosing(self, other: f64) -> Self {
        Self { error: self.error.max((other - self.value).abs()), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of four normal random values lies within its error in 95 of 100 cases.
    #[test]
    fn an_interval_holds_as_often_as_it_says() {
        let mut state = 5_u64;
        let mut even = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
        };
        let mut normal = || (-2.0 * even().ln()).sqrt() * (std::f64::consts::TAU * even()).cos();
        let mut held = 0;
        for _ in 0..4000 {
            let four = [0; 4].map(|_| (3.0 + normal(), 1.0));
            let mean = four.iter().map(|(v, _)| v).sum::<f64>() / 4.0;
            held += usize::from((mean - 3.0).abs() < Estimate::of_quarters(mean, &four).error);
        }
        assert!((3740..3860).contains(&held), "{held}");
    }
}
