//! The spectral grids: in spacing, in tolerance, and against each other.

use crate::common::{FINE, distance, main_case, spectral, terms};
use stickslip_grid::{Footprint, GridError, Method, Problem, Request, Run, Start, Stepping, solve};

#[test]
fn the_error_falls_with_the_spacing_to_round_off() -> Result<(), GridError> {
    let case = main_case(20.0);
    let tight = Stepping::absolute(1e-13);
    let exact = case.run(&spectral(0.3), &tight)?;
    // 2 exp(-π²/2h²) at each spacing, with room for amplification: 10 times that or 1e-12.
    for spacing in [0.6_f64, 0.5, 0.43, 0.36] {
        let predicted = 2.0 * (-0.5 * (std::f64::consts::PI / spacing).powi(2)).exp();
        let run = case.run(&spectral(spacing), &tight)?;
        let error = distance(&run.x0, &exact.x0).max(distance(&run.u, &exact.u));
        println!("spacing {spacing}: {error:.1e}, predicted {predicted:.1e}");
        assert!(error < (10.0 * predicted).max(1e-12), "{error:e} at {spacing}");
    }
    // Negative control: the wide spacing is not exact, so the ladder had rungs.
    let wide = distance(&case.run(&spectral(0.8), &tight)?.x0, &exact.x0);
    assert!(wide > 1e-6, "{wide:e}");
    Ok(())
}

#[test]
fn the_error_follows_the_tolerance_down_to_round_off() -> Result<(), GridError> {
    let case = main_case(60.0);
    let exact = case.run(&spectral(FINE), &Stepping::absolute(1e-14))?;
    for k in 4..=13 {
        let tolerance = 10.0_f64.powi(-k);
        let run = case.run(&spectral(FINE), &Stepping::absolute(tolerance))?;
        let error = distance(&run.x0, &exact.x0).max(distance(&run.u, &exact.u));
        println!("tolerance {tolerance:e}: {error:.1e}, {:?}", run.work);
        // The kick grows about tenfold, and a slip turns an error of time into one of position.
        assert!(error < (50.0 * tolerance).max(1e-12), "{error:e} at {tolerance:e}");
    }
    Ok(())
}

#[test]
fn samples_and_gaussians_are_two_ways_to_the_same_motion() -> Result<(), GridError> {
    let case = main_case(60.0);
    let tight = Stepping::absolute(1e-13);
    let exact = case.run(&spectral(FINE), &tight)?;
    let sinc = |spacing, half_width| case.run(&Method::Sinc { spacing, half_width }, &tight);
    let fine = sinc(0.36, 80)?;
    assert!(distance(&fine.x0, &exact.x0) < 1e-10 && distance(&fine.u, &exact.u) < 1e-10);
    // Negative control: an interpolation that does not reach far enough.
    let short = distance(&sinc(0.36, 12)?.x0, &exact.x0);
    assert!(short > 1e-7, "{short:e}");
    Ok(())
}

/// A lopsided tip of three widths: every term is written with its own Gaussian, read with one.
#[test]
fn gaussians_of_different_widths_share_a_lattice() -> Result<(), GridError> {
    let parts = [(1.0, 0.0, 0.8), (-0.3, 1.5, 1.3), (-0.2, -2.0, 1.0)];
    let f = |x: f64| {
        parts.iter().map(|(a, c, w)| a * (-0.5 * ((x - c) / w).powi(2)).exp()).sum::<f64>()
    };
    let footprint = Footprint::new(&f, 13.0)?;
    let run = |method: Method| -> Result<Run, GridError> {
        let start = Start::flat(1.0, 5.0);
        let times: Vec<f64> = (1..=15).map(|k| start.time + f64::from(k)).collect();
        let problem = Problem::new(1.4, 1.0, footprint, start)?;
        let request = Request { times: &times, points: &[4.0, 8.0, 18.0] };
        solve(&problem, &method, &Stepping::absolute(1e-12), &request)
    };
    let lattice = run(Method::Spectral { gaussians: terms(&parts), spacing: FINE })?;
    let sampled = run(Method::Sinc { spacing: 0.28, half_width: 90 })?;
    assert!(distance(&lattice.x0, &sampled.x0) < 1e-10, "{lattice:?} {sampled:?}");
    assert!(distance(&lattice.u, &sampled.u) < 1e-10);
    Ok(())
}
