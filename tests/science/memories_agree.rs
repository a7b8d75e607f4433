//! Do the memories give the same motion? `fft` and `modes` judged by `direct`, which is the definition.

use crate::acceptance::{Acceptance, largest_difference};
use stickslip_tip::{
    Force, MemoryChoice, Model, Noise, Pulse, Run, RunError, Scenario, Start, TipFunction, run,
};

/// Both runs are within the tolerance of the truth; steps may differ by a rounding.
const AGREE: Acceptance = Acceptance { floor: 1e-12, slack: 1.0 };

/// What `modes` refuses: a footprint that never fades, and a coarse table at a tolerance below the
/// error of its own interpolation.
const REFUSED: [(&str, f64); 4] =
    [("bessel", 1e-6), ("bessel", 1e-9), ("bessel", 1e-11), ("table", 1e-11)];

fn triple(alpha: f64, r: f64) -> Model {
    Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), alpha, r).unwrap()
}

fn judge(name: &str, scenario: Scenario) {
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let with = |memory| run(&Scenario { memory, tolerance, ..scenario.clone() });
        let direct = with(MemoryChoice::Direct).unwrap();
        let range = (direct.trajectory.start(), direct.trajectory.end());
        for (memory, called) in [(MemoryChoice::Fft, "fft"), (MemoryChoice::Modes, "modes")] {
            let other = match with(memory) {
                // Where f' cannot be fitted well enough, that is said instead.
                Err(RunError::Modes(why)) if called == "modes" => {
                    println!("{name}, {tolerance:e}: {why}");
                    assert!(REFUSED.contains(&(name, tolerance)), "{why}");
                    continue;
                }
                other => other.unwrap(),
            };
            assert_eq!((direct.memory, other.memory), ("direct", called));
            let (a, b) = (&direct.trajectory, &other.trajectory);
            let difference = largest_difference(|t| a.l(t), |t| b.l(t), range, 5000);
            AGREE.judge(&format!("{name}, {called}, {tolerance:e}"), difference, tolerance);
        }
    }
}

#[test]
fn on_stick_slip() {
    judge("stick-slip", Scenario { kick: 0.05, ..Scenario::new(triple(1.2, 1.0), 76.0) });
}

#[test]
fn on_a_flat_start() {
    let flat = Scenario { start: Start::Flat, ..Scenario::new(triple(0.75, 0.6), 90.0) };
    judge("flat start", flat);
}

#[test]
fn on_pulses_that_push_the_tip_backwards() {
    let pulse = |time| Pulse { amplitude: -8.0, time, width: 0.5 };
    let force = Force::new(vec![pulse(25.0), pulse(33.0)], None).unwrap();
    let scenario = Scenario { force, ..Scenario::new(triple(0.9, 1.0), 60.0) };
    let trajectory = run(&scenario).unwrap().trajectory;
    let furthest_back = (0..400).map(|i| trajectory.velocity(24.0 + 0.05 * f64::from(i)));
    assert!(furthest_back.fold(0.0, f64::min) < -2.0, "the pulses do push it backwards");
    judge("pulses", scenario);
}

#[test]
fn on_an_initial_bump() {
    let x: Vec<f64> = (0..=80).map(|i| 18.0 + 0.1 * f64::from(i)).collect();
    let u = x.iter().map(|x| 0.6 * (-(x - 22.0_f64).powi(2)).exp()).collect();
    judge("bump", Scenario { profile: Some((x, u)), ..Scenario::new(triple(0.9, 1.0), 60.0) });
}

/// At ends with a slope, u0 would have a hollow corner at x = 20, and this tip would never leave it.
#[test]
fn on_a_profile_that_falls_to_its_end_under_a_tip_held_back() {
    let profile = (vec![16.0, 17.0, 18.0, 19.0, 20.0], vec![0.0, 0.2, -0.1, 0.3, 0.0]);
    let held_back = (vec![18.0, 20.0, 22.0, 25.0], vec![0.0, 0.9, -0.3, 0.0]);
    let scenario = Scenario {
        start: Start::Flat,
        kick: 0.05,
        profile: Some(profile),
        force: Force::new(vec![], Some(held_back)).unwrap(),
        ..Scenario::new(triple(1.2, 1.0), 36.0)
    };
    let steps = run(&scenario).unwrap().work.steps;
    assert!(steps < 500, "{steps}");
    judge("level ends", scenario);
}

#[test]
fn on_noise_whose_knots_lie_closer_than_steps() {
    let noise = |spacing| Some(Noise { amplitude: 1e-4, spacing, seed: 7 });
    judge("noise", Scenario { noise: noise(0.1), ..Scenario::new(triple(1.1, 1.0), 32.0) });
    // Each knot costs a step or two, whatever its distance to the next.
    let fine =
        run(&Scenario { noise: noise(0.005), ..Scenario::new(triple(1.1, 1.0), 32.0) }).unwrap();
    let knots = (fine.trajectory.end() - fine.trajectory.start()) / 0.005;
    println!("{knots} knots, {:?}", fine.work);
    assert!((fine.work.steps as f64) < 3.0 * knots);
}

#[test]
fn on_a_narrower_gaussian() {
    let model = Model::new(TipFunction::gaussian(0.8).unwrap(), 1.6, 1.0).unwrap();
    judge("gaussian 0.8", Scenario { kick: 0.05, ..Scenario::new(model, 76.0) });
}

#[test]
fn on_a_footprint_that_never_fades() {
    let model = Model::new(TipFunction::Bessel, 1.1, 1.0).unwrap();
    judge("bessel", Scenario { kick: 0.05, ..Scenario::new(model, 116.0) });
}

#[test]
fn on_a_tip_from_a_table() {
    let x: Vec<f64> = (0..40).map(|i| 0.2 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.2 * x * x) * (-x * x / 2.0).exp()).collect();
    let model = Model::new(TipFunction::table(&x, &f).unwrap(), 1.0, 0.8).unwrap();
    judge("table", Scenario { kick: 0.05, ..Scenario::new(model, 50.0) });
}

#[test]
fn auto_begins_with_direct_and_goes_over_to_modes_without_a_trace() {
    let scenario =
        Scenario { kick: 0.05, tolerance: 1e-11, ..Scenario::new(triple(1.2, 1.0), 76.0) };
    auto_becomes("modes", &scenario);
    assert_eq!(run(&Scenario { until: 16.5, ..scenario }).unwrap().memory, "direct");
}

#[test]
fn auto_goes_over_to_modes_while_the_tip_is_behind_where_it_has_been() {
    // The pulse that drives it back falls into the steps that are summed directly.
    let back = Pulse { amplitude: -60.0, time: 16.3, width: 0.1 };
    let force = Force::new(vec![back], None).unwrap();
    let scenario = Scenario { force, tolerance: 1e-9, ..Scenario::new(triple(0.9, 1.0), 40.0) };
    let run = auto_becomes("modes", &scenario);
    assert!(run.memory_reason.contains("retreated"), "{}", run.memory_reason);
}

#[test]
fn auto_goes_over_to_fft_where_modes_do_not_fit() {
    let bessel = Model::new(TipFunction::Bessel, 1.1, 1.0).unwrap();
    auto_becomes("fft", &Scenario { kick: 0.05, ..Scenario::new(bessel, 76.0) });
}

fn auto_becomes(name: &str, scenario: &Scenario) -> Run {
    let auto = run(scenario).unwrap();
    println!("{}: {}", auto.memory, auto.memory_reason);
    assert_eq!(auto.memory, name);
    let direct = run(&Scenario { memory: MemoryChoice::Direct, ..scenario.clone() }).unwrap();
    let range = (auto.trajectory.start(), auto.trajectory.end());
    let difference =
        largest_difference(|t| direct.trajectory.l(t), |t| auto.trajectory.l(t), range, 5000);
    AGREE.judge(&format!("auto, {name}"), difference, scenario.tolerance);
    auto
}
