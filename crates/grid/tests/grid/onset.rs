//! Linear theory knows the frequency at αc; the grid has never heard of it.

use crate::common::{
    CRITICAL_ALPHA, CRITICAL_OMEGA, FINE, REACH, spectral, terms, triple_gaussian,
};
use stickslip_grid::{Footprint, GridError, Method, Problem, Request, Start, Stepping, solve};

/// l - l0 at the given times after the start, for a kick of 1e-4.
fn ripple(method: &Method, after: &[f64]) -> Result<Vec<f64>, GridError> {
    let footprint = Footprint::new(&triple_gaussian, REACH)?;
    let start = Start::steady(CRITICAL_ALPHA, 1.0, footprint, 14.0, 1e-4);
    let t1 = start.time;
    let times: Vec<f64> = after.iter().map(|t| t1 + t).collect();
    let problem = Problem::new(CRITICAL_ALPHA, 1.0, footprint, start)?;
    let request = Request { times: &times, points: &[] };
    let run = solve(&problem, method, &Stepping::absolute(1e-13), &request)?;
    Ok(after.iter().zip(&run.x0).map(|(t, x0)| 14.0 + t - x0).collect())
}

/// The other roots have decayed by t = 40; what remains neither grows nor falls out of step.
#[test]
fn at_the_critical_rate_a_ripple_returns_after_its_period() -> Result<(), GridError> {
    let period = std::f64::consts::TAU / CRITICAL_OMEGA;
    let phases: Vec<f64> = (0..8).map(|k| 40.0 + period * f64::from(k) / 8.0).collect();
    let later = |periods: f64| phases.iter().map(|t| t + periods * period).collect::<Vec<_>>();
    let method = spectral(FINE);
    let first = ripple(&method, &phases)?;
    let amplitude = first.iter().fold(0.0_f64, |a, l| a.max(l.abs()));
    let change = |other: Vec<f64>| crate::common::distance(&first, &other) / amplitude;
    let returned = change(ripple(&method, &later(10.0))?);
    // Nonlinear change is of the order of the amplitude squared, 1e-8.
    assert!(returned < 1e-6, "changed by {returned:e} of {amplitude:e}");
    // Negative control: 0.1 % off in frequency would show.
    let detuned = change(ripple(&method, &later(10.01))?);
    assert!(detuned > 0.01, "{detuned}");
    Ok(())
}

#[test]
fn terms_of_one_tip_function_are_refused_for_another() {
    let method = Method::Spectral { gaussians: terms(&[(1.0, 0.0, 1.0)]), spacing: FINE };
    assert!(matches!(ripple(&method, &[1.0]), Err(GridError::Defect { defect }) if defect > 0.1));
}
