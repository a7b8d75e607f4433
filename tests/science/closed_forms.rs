//! Does a run give what is known in closed form? Judged by formulas: α = 0, and the steady state.

use crate::acceptance::{Acceptance, largest_difference};
use stickslip_outcome::{Regime, run_and_judge};
use stickslip_tip::{MemoryChoice, Model, Scenario, Start, TipFunction, run};

/// A tolerance is an error, and here nothing amplifies it.
const AS_ASKED: Acceptance = Acceptance { floor: 2e-14, slack: 1.0 };
/// What a thousand time units of steps may add up to.
const KEPT: Acceptance = Acceptance { floor: 1e-12, slack: 10.0 };

#[test]
fn without_indentation_l_decays_exponentially() {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 0.0, 0.7).unwrap();
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let scenario = Scenario { kick: 1.5, tolerance, ..Scenario::new(model.clone(), 60.0) };
        let (run, outcome) = run_and_judge(&scenario).unwrap();
        let (start, end) = (run.trajectory.start(), run.trajectory.end());
        let exact = |t: f64| 1.5 * (start - t).exp();
        let error = largest_difference(|t| run.trajectory.l(t), exact, (start, end), 4000);
        AS_ASKED.judge(&format!("α = 0, {tolerance:e}"), error, tolerance);
        assert_eq!(outcome.regime, Regime::Steady);
    }
}

#[test]
fn the_steady_state_is_kept_for_a_thousand_time_units() {
    let tips = [
        TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
        TipFunction::gaussian(0.5).unwrap(),
        TipFunction::Bessel,
    ];
    for (tip, alpha, tolerance) in
        [(0, 1.0, 1e-6), (0, 1.0, 1e-9), (0, 1.0, 1e-12), (1, 0.4, 1e-9), (2, 0.5, 1e-9)]
    {
        let model = Model::new(tips[tip].clone(), alpha, 1.0).unwrap();
        // l0 = α f(0)/r, written out: f(0) is 1 - exp(-2) for the triple Gaussian, not 1.
        let l0 = [1.0 - (-2.0_f64).exp(), 0.4, 0.5][tip];
        let scenario = Scenario { tolerance, ..Scenario::new(model, 1015.0) };
        let (run, outcome) = run_and_judge(&scenario).unwrap();
        let range = (run.trajectory.start(), run.trajectory.end());
        let error = largest_difference(|t| run.trajectory.l(t), |_| l0, range, 10_000);
        KEPT.judge(&format!("steady, tip {tip}, {tolerance:e}"), error, tolerance);
        assert_eq!(outcome.regime, Regime::Steady);
    }
}

#[test]
fn without_the_groove_of_the_start_the_steady_state_is_not_kept() {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.0, 1.0).unwrap();
    let l0 = model.steady_l();
    let scenario =
        Scenario { start: Start::Flat, kick: model.steady_lag(), ..Scenario::new(model, 40.0) };
    let (run, _) = run_and_judge(&scenario).unwrap();
    let range = (run.trajectory.start(), run.trajectory.end());
    assert!(largest_difference(|t| run.trajectory.l(t), |_| l0, range, 1000) > 0.1);
}

#[test]
fn counts_of_work_are_what_they_were() {
    // Pinned: a change here is a change of the integrator's cost, to be meant.
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 1.0).unwrap();
    let scenario =
        Scenario { kick: 0.05, memory: MemoryChoice::Direct, ..Scenario::new(model, 76.0) };
    let work = run(&scenario).unwrap().work;
    assert_eq!((work.steps, work.rejected, work.newton_iterations), (197, 29, 454));
}
