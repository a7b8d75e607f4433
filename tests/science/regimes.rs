//! Does a run end where it must, and does it say so? Judged by figures that were computed by other means
//! and are kept with their origin in data/: the limit cycle by 30-digit collocation and, independently,
//! harmonic balance; the long stick-slip by an integration of another method.

use stickslip_outcome::{Regime, run_and_judge};
use stickslip_stability::critical;
use stickslip_tip::{Model, Scenario, TipFunction};

fn triple(beta: f64, alpha: f64) -> Model {
    Model::new(TipFunction::triple_gaussian(beta, 1.0).unwrap(), alpha, 1.0).unwrap()
}

fn critical_alpha() -> f64 {
    critical(&TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.0).unwrap().alpha
}

#[test]
fn just_above_onset_the_limit_cycle_has_its_known_period_and_amplitude() {
    let scenario =
        Scenario { kick: 0.1, ..Scenario::new(triple(1.0, critical_alpha() + 0.01), 4000.0) };
    let outcome = run_and_judge(&scenario).unwrap().1;
    assert_eq!(outcome.regime, Regime::StickSlip);
    let cycle = outcome.oscillation.unwrap();
    println!("period {:.10}, amplitude {:.10}", cycle.period, cycle.amplitude_x0);
    assert!((cycle.period - 6.693_688_892_159).abs() < 1e-9);
    assert!((cycle.amplitude_x0 - 0.196_381_798_100).abs() < 1e-9);
    assert_eq!(cycle.slips, 1);
}

#[test]
fn a_groove_is_remembered_however_old_it_is() {
    // A memory cut at 16 time units gives a period of 26.9 here.
    let scenario = Scenario { kick: 0.01, ..Scenario::new(triple(0.0, 2.6), 1000.0) };
    let (run, outcome) = run_and_judge(&scenario).unwrap();
    let cycle = outcome.oscillation.unwrap();
    let (start, end) = (run.trajectory.start(), run.trajectory.end());
    let at = |i: u32| start + (end - start) * f64::from(i) / 400_000.0;
    let largest = (0..=400_000).map(|i| run.trajectory.l(at(i))).fold(0.0, f64::max);
    println!("period {:.6}, largest l {largest:.6}", cycle.period);
    assert!((cycle.period - 47.614_16).abs() < 1e-4);
    assert!((largest - 39.5047).abs() < 0.005);
}

#[test]
fn a_tip_above_the_trapping_threshold_is_reported_as_trapped() {
    for (beta, alpha) in [(0.0, 3.0), (1.0, 2.2), (1.0, 4.0), (1.0, 20.0)] {
        let (run, outcome) =
            run_and_judge(&Scenario { kick: 0.01, ..Scenario::new(triple(beta, alpha), 400.0) })
                .unwrap();
        assert_eq!(outcome.regime, Regime::Trapped, "β = {beta}, α = {alpha}");
        assert!(run.work.steps < 300, "a stiff groove costs no steps: {:?}", run.work);
    }
}

#[test]
fn long_periods_just_below_the_threshold_are_not_taken_for_trapping() {
    let scenario = Scenario { kick: 0.1, ..Scenario::new(triple(1.0, 2.0), 2000.0) };
    let outcome = run_and_judge(&scenario).unwrap().1;
    assert_eq!(outcome.regime, Regime::StickSlip);
    assert!(outcome.oscillation.unwrap().period > 100.0);
    // Cut in the middle of a stick, nothing can be said yet.
    let short = run_and_judge(&Scenario { until: 150.0, ..scenario }).unwrap().1;
    assert_eq!(short.regime, Regime::Transient);
}

#[test]
fn after_a_period_doubling_two_slips_make_a_period() {
    let scenario = Scenario { kick: 0.1, ..Scenario::new(triple(1.0, 1.62), 2000.0) };
    let cycle = run_and_judge(&scenario).unwrap().1.oscillation.unwrap();
    assert_eq!(cycle.slips, 2);
    assert!(cycle.drift < 1e-6);
}

#[test]
fn a_decaying_and_a_growing_oscillation_are_transients() {
    for above in [-0.01, 0.01] {
        let model = triple(1.0, critical_alpha() + above);
        let (_, outcome) =
            run_and_judge(&Scenario { kick: 1e-3, ..Scenario::new(model, 150.0) }).unwrap();
        assert_eq!(outcome.regime, Regime::Transient, "α - αc = {above}");
    }
    let below = triple(1.0, critical_alpha() - 0.1);
    let (_, outcome) =
        run_and_judge(&Scenario { kick: 1e-3, ..Scenario::new(below, 1000.0) }).unwrap();
    assert_eq!(outcome.regime, Regime::Steady);
}
