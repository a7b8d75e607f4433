//! Does the verification of runs in two coordinates tell the truth? Judged by runs that keep their promise, by motions
//! that were changed on purpose, and by growth rates from the characteristic equation of snaking.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::ops::ControlFlow;
use stickslip_stability::Snaking;
use stickslip_tip::planar::{PlanarScenario, Step, Trajectory, run};
use stickslip_tip::{Footprint, Model, Noise, Scenario, TipFunction, Wider};
use stickslip_verify::{
    Sample, Verification, VerificationError, verify_across, verify_samples_across,
};

fn scenario(alpha: f64, stiffness: f64, wider: Wider, until: f64) -> PlanarScenario {
    let along = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let tip = TipFunction::of_footprint(Footprint::separable(along, 1.0).unwrap());
    let model = Model::under(wider, tip, alpha, 1.0).unwrap();
    let along = Scenario { kick: 0.05, ..Scenario::new(model, until) };
    PlanarScenario { kick_across: 0.1, ..PlanarScenario::new(along, stiffness) }
}

fn with_tolerance(scenario: &PlanarScenario, tolerance: f64) -> PlanarScenario {
    let along = Scenario { tolerance, ..scenario.along.clone() };
    PlanarScenario { along, ..scenario.clone() }
}

fn verified(scenario: &PlanarScenario, trajectory: &Trajectory) -> Verification {
    verify_across(scenario, trajectory, |_| ControlFlow::Continue(())).unwrap()
}

fn samples(trajectory: &Trajectory, every: f64) -> Vec<Sample> {
    let (start, end) = (trajectory.start(), trajectory.end());
    let at = |t: f64| {
        let (x0, y0) = (trajectory.x0(t), trajectory.y0(t));
        let l = trajectory.step_at(t).along.followed(trajectory.support(), t);
        Sample { t, l, x0, y0: Some(y0) }
    };
    (0..).map(|i| start + every * f64::from(i)).take_while(|t| *t <= end).map(at).collect()
}

#[test]
fn runs_in_two_coordinates_keep_their_promise() {
    let plain = Wider::default();
    let wider = Wider {
        depth_limit: Some(4.0),
        inertia: Some(0.4),
        healing_time: Some(8.0),
        ..Wider::default()
    };
    let noise = Some(Noise { amplitude: 1e-3, spacing: 0.7, seed: 7 });
    let noisy = scenario(1.0, 0.5, plain, 40.0);
    let along = Scenario { noise, ..noisy.along.clone() };
    let noisy = PlanarScenario { along, noise_spacing_across: Some(0.7), ..noisy };
    for (name, scenario) in [
        ("snaking", scenario(1.2, 0.25, plain, 60.0)),
        ("stick-slip", scenario(1.62, 1.0, plain, 60.0)),
        ("wider law", scenario(1.6, 0.3, wider, 40.0)),
        ("noise", noisy),
    ] {
        for tolerance in [1e-5, 1e-9] {
            let scenario = with_tolerance(&scenario, tolerance);
            let done = run(&scenario).unwrap();
            let found = verified(&scenario, &done.trajectory);
            let y = found.y.unwrap();
            println!(
                "{name} at {tolerance:.0e}: l {:.2}, y0 {:.2} tolerances; {:?}",
                found.l.largest / tolerance,
                y.largest / tolerance,
                found.growth
            );
            assert!(found.is_kept() && found.trusted_until.is_none(), "{name}: {found:?}");
            assert!(found.tolerance < tolerance && found.u.is_none());
            assert!(found.l.largest > 0.0 && y.largest > 0.0, "{name}: the same run twice");
        }
    }
}

/// The period of a line that snakes is known so well that y0 is right after 35 periods. With an error of the exponentials
/// as in one coordinate y0 is off by 18 and 12 tolerances.
#[test]
fn a_snaking_line_keeps_its_promise_for_long() {
    let scenario = scenario(0.9, 0.25, Wider::default(), 600.0);
    for tolerance in [1e-8, 1e-9] {
        let scenario = with_tolerance(&scenario, tolerance);
        let found = verified(&scenario, &run(&scenario).unwrap().trajectory);
        let y = found.y.unwrap();
        assert!(y.largest < tolerance, "at {tolerance:.0e}: {y:?}");
        assert!(found.is_kept() && found.growth.amplification < 10.0, "{found:?}");
    }
}

/// One step of the motion across, or along, is off by 100 tolerances; and a run of another spring.
#[test]
fn a_changed_motion_is_found_where_it_was_changed() {
    let scenario = with_tolerance(&scenario(1.2, 0.5, Wider::default(), 40.0), 1e-7);
    let trajectory = run(&scenario).unwrap().trajectory;
    let steps = trajectory.steps();
    let changed = |change: fn(&mut Step)| {
        let mut steps = steps.to_vec();
        change(&mut steps[20]);
        let (wider, support) = (*scenario.along.model.wider(), scenario.along.support());
        verified(&scenario, &Trajectory::under(wider, support, steps))
    };
    let (from, to) = (steps[20].along.t, steps[20].end());
    let across = changed(|step| step.y += 1e-5);
    let y = across.y.unwrap();
    assert!(!across.is_kept() && across.l.is_allowed() && !y.is_allowed(), "{across:?}");
    assert!((0.9e-5..1.1e-5).contains(&y.largest) && (from..=to).contains(&y.at), "{y:?}");
    assert_eq!(across.trusted_until, Some(from));
    let along = changed(|step| step.along.extension += 1e-5);
    assert!(!along.l.is_allowed() && along.y.unwrap().is_allowed(), "{along:?}");
    assert!((from..=to).contains(&along.l.at));

    let softer = PlanarScenario { stiffness_across: 0.500_1, ..scenario.clone() };
    let found = verified(&softer, &trajectory);
    assert!(!found.is_kept() && !found.y.unwrap().is_allowed(), "{found:?}");
}

#[test]
fn samples_are_compared_in_both_coordinates() {
    let scenario = with_tolerance(&scenario(1.2, 0.5, Wider::default(), 40.0), 1e-7);
    let right = samples(&run(&scenario).unwrap().trajectory, 0.5);
    let judged = |samples: &[Sample]| {
        let until = samples[samples.len() - 1].t;
        let each = || samples.iter().copied();
        verify_samples_across(&scenario, each, until, |_| ControlFlow::Continue(())).unwrap()
    };
    let found = judged(&right[..40]);
    let compared = found.samples.unwrap();
    assert!(found.is_kept() && found.y.unwrap().largest > 0.0, "{found:?}");
    assert_eq!((compared.number, compared.wrong), (40, 0));
    let changes: [fn(&mut Sample); 3] = [
        |sample| sample.y0 = sample.y0.map(|y| y + 1e-5),
        |sample| sample.x0 += 1e-5,
        |sample| sample.y0 = None,
    ];
    for change in changes {
        let mut wrong = right[..40].to_vec();
        change(&mut wrong[17]);
        let found = judged(&wrong);
        let compared = found.samples.unwrap();
        assert!(!found.is_kept(), "{found:?}");
        assert_eq!((compared.wrong, compared.first_wrong, compared.worst), (1, Some(17), 17));
        assert_eq!(found.trusted_until, Some(wrong[17].t));
    }
}

/// Of a tip that starts on its line, by the leading root of snaking below its threshold, α = 0.8305, and above it.
#[test]
fn growth_across_is_that_of_the_leading_root() {
    for alpha in [0.75, 0.95, 1.0] {
        let straight = scenario(alpha, 0.25, Wider::default(), 150.0);
        let straight = PlanarScenario { kick_across: 0.0, ..with_tolerance(&straight, 1e-8) };
        let model = &straight.along.model;
        let footprint = model.tip().footprint().unwrap();
        let theory = Snaking::new(footprint, *model.wider(), (model.r(), 0.25)).unwrap();
        let expected = theory.leading_roots(alpha, 2).unwrap().roots[0].re;
        let trajectory = run(&straight).unwrap().trajectory;
        let found = verified(&straight, &trajectory);
        let exponent = found.growth.exponent.unwrap();
        println!("{alpha}: {exponent:.5}, leading root {expected:.5}");
        assert!(found.is_kept() && (exponent / expected - 1.0).abs() < 0.1, "{found:?}");
    }
}

#[test]
fn a_verification_is_stopped_by_its_observer() {
    let stopped = scenario(1.0, 0.5, Wider::default(), 40.0);
    let trajectory = run(&stopped).unwrap().trajectory;
    let found = verify_across(&stopped, &trajectory, |_| ControlFlow::Break(()));
    assert_eq!(found, Err(VerificationError::Interrupted));
}
