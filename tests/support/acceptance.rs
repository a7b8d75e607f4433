//! What every test judges by: one acceptance rule, and the observed order of convergence.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

/// An error is accepted below max(floor, slack × tolerance): the floor is round-off, the slack what
/// the promise leaves open. The clearance is printed also when it passes, so that drift is seen.
#[derive(Debug, Clone, Copy)]
pub struct Acceptance {
    /// What round-off alone amounts to.
    pub floor: f64,
    /// Multiple of the tolerance that is allowed.
    pub slack: f64,
}

impl Acceptance {
    /// # Panics
    /// If the error is not accepted.
    pub fn judge(&self, name: &str, error: f64, tolerance: f64) {
        let limit = self.floor.max(self.slack * tolerance);
        println!("{name}: error {error:.2e}, limit {limit:.2e}, clearance {:.2}", limit / error);
        // A NaN is not accepted.
        assert!(error <= limit, "{name}: error {error:e} above {limit:e}");
    }
}

/// max |a(t) - b(t)| at `n` + 1 times from `start` to `end`.
pub fn largest_difference(
    a: impl Fn(f64) -> f64,
    b: impl Fn(f64) -> f64,
    (start, end): (f64, f64),
    n: u32,
) -> f64 {
    let t = |i: u32| start + (end - start) * f64::from(i) / f64::from(n);
    (0..=n).map(|i| (a(t(i)) - b(t(i))).abs()).fold(0.0, f64::max)
}

/// The slope of log(error) against log(h) by least squares, over at least four refinements.
///
/// # Panics
/// With fewer than five points.
pub fn observed_order(points: &[(f64, f64)]) -> f64 {
    assert!(points.len() >= 5, "an order is asserted over at least four refinements");
    let n = points.len() as f64;
    let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|(h, e)| (h.ln(), e.ln())).unzip();
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let covariance: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    covariance / x.iter().map(|x| (x - mx).powi(2)).sum::<f64>()
}
