//! Motions that can be written down: without indentation (11) is idle and (10) is linear.

use crate::common::{FINE, REACH, distance, spectral, triple_gaussian};
use stickslip_grid::{Footprint, GridError, Method, Problem, Request, Start, Stepping, solve};

fn every_method() -> [Method; 4] {
    [
        Method::Uniform { spacing: 0.1, from: -20.0, to: 40.0 },
        Method::Windowed { spacing: 0.1 },
        spectral(FINE),
        Method::Sinc { spacing: 0.36, half_width: 80 },
    ]
}

#[test]
fn without_indentation_the_lag_decays_exponentially() -> Result<(), GridError> {
    let footprint = Footprint::new(&triple_gaussian, REACH)?;
    let (r, t1, x1) = (0.7, 3.0, 1.0);
    let times = [3.0, 4.0, 7.5, 13.0];
    let l1 = r * t1 - r - x1;
    let exact = times.map(|t: f64| r * t - r - l1 * (t1 - t).exp());
    for method in every_method() {
        let problem = Problem::new(0.0, r, footprint, Start::new(t1, x1, |_| 0.0, |_| 0.0))?;
        let request = Request { times: &times, points: &[] };
        let run = solve(&problem, &method, &Stepping::absolute(1e-12), &request)?;
        assert!(distance(&run.x0, &exact) < 1e-10, "{method:?}: {run:?} for {exact:?}");
    }
    Ok(())
}

/// On a slope of constant u' = s, with a force sin t: x0' + x0 = rt - s + sin t.
#[test]
fn without_indentation_slope_and_force_add_up() -> Result<(), GridError> {
    let footprint = Footprint::new(&triple_gaussian, REACH)?;
    let force = |t: f64| t.sin();
    let (r, s) = (1.0, 0.3);
    let particular = |t: f64| r * (t - 1.0) - s + 0.5 * (t.sin() - t.cos());
    let times = [2.0, 9.0];
    let exact = times.map(|t: f64| particular(t) + (2.0 - particular(0.0)) * (-t).exp());
    for method in every_method() {
        let start = Start::flat(r, 0.0).on_top_of(|x| s * x, |_| s);
        let start = Start::new(0.0, 2.0, move |x| start.height(x), |_| s);
        let problem = Problem::new(0.0, r, footprint, start)?.with_force(&force);
        let request = Request { times: &times, points: &[5.05] };
        let run = solve(&problem, &method, &Stepping::absolute(1e-12), &request)?;
        assert!(distance(&run.x0, &exact) < 1e-10, "{method:?}: {run:?} for {exact:?}");
        assert!((run.u[0] - s * 5.05).abs() < 1e-12, "{method:?}: {run:?}");
    }
    Ok(())
}
