//! (24): steady motion is a solution, and below αc a stable one.

use crate::common::{FINE, Kicked, REACH, distance, spectral, triple_gaussian};
use stickslip_grid::{Footprint, GridError, Method, Problem, Request, Run, Start, Stepping, solve};

const SPAN: f64 = 12.0;
const POINTS: [f64; 6] = [5.0, 13.3, 24.0, 26.0, 27.1, 29.0];

/// α = 0.9, r = 1.3, no kick.
fn run(method: &Method) -> Result<(Run, f64, Vec<f64>), GridError> {
    let (alpha, r) = (0.9, 1.3);
    let footprint = Footprint::new(&triple_gaussian, REACH)?;
    let start = Start::steady(alpha, r, footprint, 14.0, 0.0);
    let end = start.time + SPAN;
    let x0 = 14.0 + r * SPAN;
    let surface = POINTS.map(|x| start.height(x - r * SPAN)).to_vec();
    let problem = Problem::new(alpha, r, footprint, start)?;
    let request = Request { times: &[end], points: &POINTS };
    Ok((solve(&problem, method, &Stepping::absolute(1e-12), &request)?, x0, surface))
}

#[test]
fn the_spectral_grids_keep_it_to_round_off() -> Result<(), GridError> {
    for method in [spectral(FINE), Method::Sinc { spacing: 0.36, half_width: 80 }] {
        let (run, x0, surface) = run(&method)?;
        assert!((run.x0[0] - x0).abs() < 1e-10, "{method:?}: {}", run.x0[0] - x0);
        assert!(distance(&run.u, &surface) < 1e-10, "{method:?}");
    }
    Ok(())
}

/// With f''(0) = -0.594 and f'''' of order 3, an error of the slope of h²/6 u''' is below h².
#[test]
fn the_second_order_grids_keep_it_to_the_square_of_the_spacing() -> Result<(), GridError> {
    let spacing: f64 = 0.04;
    let uniform = Method::Uniform { spacing, from: 2.0, to: 42.0 };
    for method in [uniform, Method::Windowed { spacing }] {
        let (run, x0, surface) = run(&method)?;
        assert!((run.x0[0] - x0).abs() < spacing.powi(2), "{method:?}: {}", run.x0[0] - x0);
        assert!(distance(&run.u, &surface) < spacing.powi(2), "{method:?}");
    }
    Ok(())
}

/// Negative control: above αc a kick grows, so the tests above do see an unsteady motion.
#[test]
fn above_the_critical_rate_a_kick_takes_the_motion_away() -> Result<(), GridError> {
    let case = Kicked { alpha: 1.2, kick: 0.01, span: 60.0, samples: 60 };
    let run = case.run(&spectral(FINE), &Stepping::absolute(1e-9))?;
    let steady: Vec<f64> = (1..=60).map(|k| 14.0 + f64::from(k)).collect();
    let distance = distance(&run.x0, &steady);
    assert!(distance > 0.1, "ten times the kick and more: {distance}");
    Ok(())
}
