//! Runs against the reference.

use super::reference::{Footprint, Problem};
use stickslip_tip::planar::{PlanarRun, PlanarScenario, run};
use stickslip_tip::{Model, Scenario, TipFunction, Wider};

/// (48) with these side lobes times a Gaussian across of the width v.
pub(crate) fn tip(beta: f64, width: f64) -> TipFunction {
    let along = TipFunction::triple_gaussian(beta, 1.0).unwrap();
    TipFunction::of_footprint(stickslip_tip::Footprint::separable(along, width).unwrap())
}

/// A line at r = 1 until t, kicked.
pub(crate) fn line(
    (tip, wider): (TipFunction, Wider),
    alpha: f64,
    stiffness: f64,
    kicks: [f64; 2],
    until: f64,
) -> PlanarScenario {
    let model = Model::under(wider, tip, alpha, 1.0).unwrap();
    let along = Scenario { kick: kicks[0], ..Scenario::new(model, until) };
    PlanarScenario { kick_across: kicks[1], ..PlanarScenario::new(along, stiffness) }
}

/// The problem of the reference that is this scenario, with the side lobes and width of its footprint.
pub(crate) fn problem(scenario: &PlanarScenario, (beta, width): (f64, f64)) -> Problem {
    let (along, model) = (&scenario.along, &scenario.along.model);
    Problem {
        footprint: Footprint::triple(beta, width),
        alpha: model.alpha(),
        r: model.r(),
        stiffness: scenario.stiffness_across,
        inertia: model.wider().inertia,
        healing: model.wider().healing_time,
        support: |problem, t| problem.r * t,
        force: |_| [0.0; 2],
        start: along.start_time(),
        position: [along.start_position - along.kick, scenario.kick_across],
        velocity: model.r(),
        steady_past: Some(along.start_position),
    }
}

/// Largest differences of x0 and y0 at the steps of the reference.
pub(crate) fn differences(run: &PlanarRun, problem: &Problem, steps: usize) -> [f64; 2] {
    let motion = problem.motion(run.trajectory.end(), steps);
    let mut worst = [0.0; 2];
    for (t, [x, y]) in motion.t.iter().zip(motion.position) {
        worst[0] = f64::max(worst[0], (run.trajectory.x0(*t) - x).abs());
        worst[1] = f64::max(worst[1], (run.trajectory.y0(*t) - y).abs());
    }
    worst
}

#[test]
fn lines_are_those_of_the_reference() {
    for (beta, width, alpha, stiffness, kicks, until) in [
        (1.0, 1.0, 1.2, 0.25, [0.1, 0.3], 45.0),
        (1.0, 1.4, 1.3, 0.5, [0.0, 0.2], 45.0),
        (0.0, 1.0, 2.2, 0.3, [0.2, 0.4], 45.0),
    ] {
        let scenario = line((tip(beta, width), Wider::default()), alpha, stiffness, kicks, until);
        let run = run(&scenario).unwrap();
        let [x, y] = differences(&run, &problem(&scenario, (beta, width)), 300);
        println!(
            "{beta} {width} {alpha} {stiffness}: {x:.1e} {y:.1e} {:?} {:?}",
            run.work, run.layers
        );
        assert!(x < 5e-9 && y < 5e-9, "{x:e} {y:e}");
    }
}
