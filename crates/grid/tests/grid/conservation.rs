//! d/dt ∫ u dx = -α ∫ f, (49). On cells at any spacing used here the sum Σ f(x_j - x0) Δx does not
//! depend on x0 to round-off, so Σ u Δx obeys it too.

use crate::common::{FINE, REACH, terms};
use stickslip_grid::{Footprint, GridError, Method, Problem, Request, Start, Stepping, solve};

const ALPHA: f64 = 1.5;
const BETA: f64 = 0.4;

fn footprint(x: f64) -> f64 {
    let bell = |x: f64| (-0.5 * x * x).exp();
    bell(x) - 0.5 * BETA * (bell(x + 2.0) + bell(x - 2.0))
}

/// The sum of u - u0 over points `spacing` apart, from a start on a flat surface, after 7 time units.
fn carved(method: &Method, spacing: f64) -> Result<f64, GridError> {
    let footprint = Footprint::new(&footprint, REACH)?;
    let start = Start::flat(1.0, 0.0);
    let end = start.time + 7.0;
    let points: Vec<f64> =
        (0..).map(|j| -20.0 + f64::from(j) * spacing).take_while(|x| *x < 25.0).collect();
    let problem = Problem::new(ALPHA, 1.0, footprint, start)?;
    let request = Request { times: &[end], points: &points };
    let run = solve(&problem, method, &Stepping::absolute(1e-10), &request)?;
    Ok(run.u.iter().sum::<f64>() * spacing)
}

#[test]
fn every_grid_removes_as_much_as_the_tip_indents() -> Result<(), GridError> {
    let exact = -ALPHA * 7.0 * std::f64::consts::TAU.sqrt() * (1.0 - BETA);
    let gaussians = terms(&[(1.0, 0.0, 1.0), (-0.5 * BETA, 2.0, 1.0), (-0.5 * BETA, -2.0, 1.0)]);
    let cases = [
        (Method::Uniform { spacing: 0.125, from: -20.0, to: 25.0 }, 0.125),
        (Method::Windowed { spacing: 0.125 }, 0.125),
        (Method::Spectral { gaussians, spacing: FINE }, 0.3),
        (Method::Sinc { spacing: 0.36, half_width: 80 }, 0.3),
    ];
    for (method, spacing) in cases {
        let sum = carved(&method, spacing)?;
        assert!((sum - exact).abs() < 1e-11, "{method:?}: {sum} for {exact}");
    }
    Ok(())
}

/// Negative control: a grid that ends within reach of the tip misses what is carved beyond it.
#[test]
fn a_grid_that_is_too_short_loses_some() -> Result<(), GridError> {
    let exact = -ALPHA * 7.0 * std::f64::consts::TAU.sqrt() * (1.0 - BETA);
    let sum = carved(&Method::Uniform { spacing: 0.125, from: -1.0, to: 25.0 }, 0.125)?;
    assert!((sum - exact).abs() > 0.1, "{sum} for {exact}");
    Ok(())
}
