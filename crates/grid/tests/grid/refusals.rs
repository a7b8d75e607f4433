//! Unusable input and runs that cannot go on are told apart by type.

use crate::common::{FINE, main_case, spectral, triple_gaussian};
use std::ops::ControlFlow;
use stickslip_grid::{
    Footprint, GridError, Method, Problem, Request, Start, Stepping, solve, solve_observed,
};

#[test]
fn a_tip_that_leaves_the_grid_is_reported_with_time_and_place() {
    let method = Method::Uniform { spacing: 0.1, from: 3.0, to: 20.0 };
    let left = main_case(20.0).run(&method, &Stepping::ode45());
    let Err(GridError::LeftGrid { time, x0 }) = left else { panic!("{left:?}") };
    assert!((19.7..20.5).contains(&x0) && time > 20.0, "{time} {x0}");
}

#[test]
fn a_footprint_that_is_not_a_number_stops_the_run() -> Result<(), GridError> {
    let broken = |x: f64| if x < -1.0 { f64::NAN } else { (-x * x).exp() };
    let footprint = Footprint::new(&broken, 6.0)?;
    for method in
        [Method::Windowed { spacing: 0.1 }, Method::Uniform { spacing: 0.1, from: -9.0, to: 20.0 }]
    {
        let problem = Problem::new(1.0, 1.0, footprint, Start::flat(1.0, 0.0))?;
        let request = Request { times: &[1.0], points: &[] };
        let run = solve(&problem, &method, &Stepping::ode45(), &request);
        assert!(run.is_err(), "{run:?}");
    }
    Ok(())
}

#[test]
fn unusable_input_is_refused() -> Result<(), GridError> {
    assert_eq!(Footprint::new(&triple_gaussian, 0.0).err(), Some(GridError::Reach(0.0)));
    let footprint = Footprint::new(&triple_gaussian, 10.8)?;
    let problem = |alpha, r| Problem::new(alpha, r, footprint, Start::flat(1.0, 14.0));
    assert_eq!(problem(-1.0, 1.0).err(), Some(GridError::Alpha(-1.0)));
    assert_eq!(problem(1.0, 0.0).err(), Some(GridError::R(0.0)));

    let problem = problem(1.0, 1.0)?;
    let attempt = |method: Method, stepping: Stepping, times: &[f64]| {
        solve(&problem, &method, &stepping, &Request { times, points: &[] }).err()
    };
    let fine = || spectral(FINE);
    let tolerance = Stepping::absolute(1e-6);
    assert_eq!(attempt(fine(), tolerance, &[13.0]), Some(GridError::Time(13.0)));
    assert_eq!(attempt(fine(), tolerance, &[16.0, 15.0]), Some(GridError::Time(15.0)));
    assert_eq!(attempt(fine(), Stepping::absolute(0.0), &[15.0]), Some(GridError::Stepping));
    assert_eq!(attempt(spectral(-1.0), tolerance, &[15.0]), Some(GridError::Spacing(-1.0)));
    let none = Method::Spectral { gaussians: Vec::new(), spacing: FINE };
    assert_eq!(attempt(none, tolerance, &[15.0]), Some(GridError::Gaussians));
    let short = Method::Uniform { spacing: 0.1, from: 1.0, to: 0.0 };
    assert_eq!(attempt(short, tolerance, &[15.0]), Some(GridError::Domain { from: 1.0, to: 0.0 }));
    Ok(())
}

/// An observer sees every step, ascending, and may break off; both steppers obey.
#[test]
fn an_observer_stops_a_run() -> Result<(), GridError> {
    let footprint = Footprint::new(&triple_gaussian, 10.8)?;
    let problem = Problem::new(1.0, 1.0, footprint, Start::flat(1.0, 14.0))?;
    let request = Request { times: &[16.0, 24.0], points: &[] };
    for method in [Method::Uniform { spacing: 0.1, from: 3.0, to: 40.0 }, spectral(FINE)] {
        let mut seen = vec![14.0];
        let stopped =
            solve_observed(&problem, &method, &Stepping::fixed(0.1), &request, &mut |t, x0| {
                assert!(t > seen[seen.len() - 1] && (13.0..25.0).contains(&x0));
                seen.push(t);
                if t > 20.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
        let Err(GridError::Stopped { time }) = stopped else { panic!("{stopped:?}") };
        let steps = seen.len() - 1;
        assert!((20.0..20.2).contains(&time) && (60..=62).contains(&steps), "{time} {steps}");
    }
    Ok(())
}
