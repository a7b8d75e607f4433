//! Time and error per time unit of the four discretisations, on the main case: triple Gaussian β = 1,
//! r = 1, α = 1.2, kick 0.05, at the paper's Δx = 0.001 and Δt ≈ 0.04, and at matched error.
//!
//! The paper's own grid is timed over a short span and quoted per time unit; say so wherever its figure
//! is repeated.

use std::time::Instant;
use stickslip_grid::{
    Footprint, Gaussian, GridError, Method, Problem, Request, Run, Start, Stepping, solve,
};

fn triple_gaussian(x: f64) -> f64 {
    let bell = |x: f64| (-0.5 * x * x).exp();
    bell(x) - 0.5 * (bell(x + 2.0) + bell(x - 2.0))
}

/// A run over `span` time units: result, and the best of `times` in seconds per time unit.
fn timed(
    method: &Method,
    stepping: &Stepping,
    span: f64,
    times: usize,
) -> Result<(Run, f64), GridError> {
    let footprint = Footprint::new(&triple_gaussian, 10.8)?;
    let start = Start::steady(1.2, 1.0, footprint, 14.0, 0.05);
    let end = [start.time + span];
    let problem = Problem::new(1.2, 1.0, footprint, start)?;
    let request = Request { times: &end, points: &[] };
    let once = || {
        let clock = Instant::now();
        let run = solve(&problem, method, stepping, &request)?;
        Ok((run, clock.elapsed().as_secs_f64() / span))
    };
    let mut best = once()?;
    for _ in 1..times {
        let (_, seconds) = once()?;
        best.1 = best.1.min(seconds);
    }
    Ok(best)
}

fn report(name: &str, (run, seconds): &(Run, f64), exact: &Run) {
    let error = (run.x0[0] - exact.x0[0]).abs();
    println!("{name:30} {seconds:9.2e} s a time unit, error {error:7.1e}, {:?}", run.work);
}

fn main() -> Result<(), GridError> {
    let term = |amplitude, center| Gaussian { amplitude, center, width: 1.0 };
    let gaussians = vec![term(1.0, 0.0), term(-0.5, 2.0), term(-0.5, -2.0)];
    let spectral = |spacing| Method::Spectral { gaussians: gaussians.clone(), spacing };
    let fine = std::f64::consts::PI / 8.7;
    let exact = |span| Ok(timed(&spectral(fine), &Stepping::absolute(1e-13), span, 1)?.0);
    let (short, long) = (exact(0.4)?, exact(40.0)?);

    let paper = Method::Uniform { spacing: 0.001, from: 0.0, to: 460.0 };
    report("uniform 0.001 on 460, 0.4 long", &timed(&paper, &Stepping::ode45(), 0.4, 2)?, &short);
    for spacing in [0.001, 0.002, 0.005, 0.02] {
        let grid = Method::Windowed { spacing };
        report(&format!("windowed {spacing}"), &timed(&grid, &Stepping::ode45(), 40.0, 1)?, &long);
    }
    for tolerance in [1e-5, 1e-7, 1e-9, 1e-11] {
        let stepping = Stepping::absolute(tolerance);
        let lattice = timed(&spectral(fine), &stepping, 40.0, 40)?;
        report(&format!("spectral, tolerance {tolerance:e}"), &lattice, &long);
    }
    // Coarser in space too, where 1e-6 is all that is asked.
    let coarse = timed(&spectral(0.55), &Stepping::absolute(1e-6), 40.0, 40)?;
    report("spectral 0.55, tolerance 1e-6", &coarse, &long);
    let sinc = Method::Sinc { spacing: 0.36, half_width: 80 };
    report("sinc 0.36, tolerance 1e-9", &timed(&sinc, &Stepping::absolute(1e-9), 40.0, 10)?, &long);
    Ok(())
}
