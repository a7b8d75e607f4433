//! The order of the reference, and what it makes of a motion that is known.

use super::reference::{Footprint, Problem};
use stickslip_tip::{Model, Scenario, TipFunction, run};

/// β = 1, α = 1.2, r = 1, κ_y = 0.25, kicked along and across: sticking and snaking at once.
fn problem() -> Problem {
    Problem {
        footprint: Footprint::triple(1.0, 1.0),
        alpha: 1.2,
        r: 1.0,
        stiffness: 0.25,
        inertia: None,
        healing: None,
        depth_limit: None,
        relief: |_| [0.0; 3],
        support: |problem, t| problem.r * t,
        force: |_| [0.0; 2],
        start: 0.0,
        position: [-2.3, 0.4],
        velocity: 0.0,
        steady_past: Some(-2.2),
    }
}

/// Errors of both coordinates at t = 8, in 28, 42 and 63 steps, against 168.
fn orders(problem: &Problem) -> [[f64; 2]; 2] {
    let end = |steps: usize| problem.motion(8.0, steps).position[steps];
    let (fine, counts) = (end(168), [28, 42, 63]);
    let errors = counts.map(|n| {
        let end = end(n);
        [0, 1].map(|j| (end[j] - fine[j]).abs())
    });
    println!("{errors:?}");
    [0, 1].map(|i| [0, 1].map(|j: usize| f64::ln(errors[i][j] / errors[i + 1][j]) / 1.5_f64.ln()))
}

#[test]
fn the_reference_converges_at_order_eight() {
    let forced: fn(f64) -> [f64; 2] = |t| [0.3 * (1.3 * t).sin(), 0.2 * (0.7 * t).cos()];
    let wider = Problem {
        inertia: Some(0.4),
        healing: Some(5.0),
        force: forced,
        velocity: 0.7,
        ..problem()
    };
    let limited = Problem { depth_limit: Some(5.0), ..problem() };
    for problem in [problem(), wider, limited] {
        for orders in orders(&problem) {
            println!("{orders:.2?}");
            for order in orders {
                assert!((7.5..8.7).contains(&order), "{order}");
            }
        }
    }
}

/// A tip that is on its line stays there, and moves along it as the solver of one coordinate says, which shares nothing with
/// the reference.
#[test]
fn on_its_line_the_reference_moves_as_in_one_coordinate() {
    let model = Model::new(TipFunction::default(), 1.2, 1.0).unwrap();
    let scenario = Scenario { kick: 0.1, tolerance: 1e-12, ..Scenario::new(model, 25.0) };
    let start = scenario.start_time();
    let run = run(&scenario).unwrap();
    let problem = Problem { start, position: [13.9, 0.0], steady_past: Some(14.0), ..problem() };
    let motion = problem.motion(25.0, 160);
    for (t, [x, y]) in motion.t.iter().zip(motion.position) {
        let error = (x - run.trajectory.x0(*t)).abs();
        assert!(error < 1e-9 && y.abs() < 1e-15, "{t}: {error:e} {y:e}");
    }
}
