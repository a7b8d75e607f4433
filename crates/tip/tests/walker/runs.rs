//! Runs against the reference, and the free speed.

use super::reference::motion;
use stickslip_tip::walker::{WalkerError, WalkerPast, WalkerScenario, run};
use stickslip_tip::{Force, Pulse};

fn pulse(amplitude: f64, time: f64, width: f64) -> Force {
    Force::new(vec![Pulse { amplitude, time, width }], None).unwrap()
}

/// A walker that pulses set going.
pub(crate) fn pushed(alpha: f64, healing_time: f64, until: f64) -> WalkerScenario {
    let force = [pulse(1.0, 2.0, 0.5), pulse(0.6, 4.0, 0.8)];
    WalkerScenario { force, ..WalkerScenario::new(alpha, healing_time, until) }
}

#[test]
fn walkers_are_those_of_direct_sums() {
    let base = || pushed(-3.0, 1.0, 24.0);
    let cases = [
        ("free", base(), 200),
        ("long memory", pushed(-2.0, 4.0, 24.0), 300),
        ("rotation", WalkerScenario { rotation: 0.6, ..base() }, 200),
        ("trap", WalkerScenario { trap: 0.3, position: [1.5, -0.4], ..base() }, 200),
        (
            "inertia",
            WalkerScenario {
                inertia: Some(0.7),
                velocity: [0.3, -0.2],
                rotation: -0.4,
                trap: 0.2,
                ..base()
            },
            200,
        ),
    ];
    for (name, scenario, steps) in cases {
        let run = run(&scenario).unwrap();
        let mut worst = 0.0_f64;
        for (t, [x, y]) in motion(&scenario, steps) {
            let [told_x, told_y] = run.trajectory.position(t);
            worst = worst.max((told_x - x).hypot(told_y - y));
        }
        let count = run.trajectory.steps().len();
        println!("{name}: {worst:.1e}, {} directions, {count} steps", run.directions);
        assert!(worst < 5e-11, "{name}: {worst:e}");
    }
}

/// Errors follow the tolerance. The reference is the run itself at 1e-13, which the test above judges.
#[test]
fn errors_of_walkers_stay_within_ten_tolerances() {
    for scenario in
        [pushed(-3.0, 1.0, 30.0), WalkerScenario { rotation: 0.5, ..pushed(-2.0, 3.0, 30.0) }]
    {
        let exact = run(&WalkerScenario { tolerance: 1e-13, ..scenario.clone() }).unwrap();
        for digits in 4..=11 {
            let tolerance = 10.0_f64.powi(-digits);
            let run = run(&WalkerScenario { tolerance, ..scenario.clone() }).unwrap();
            let error = (0..300).map(|i| {
                let t = 0.1 * f64::from(i);
                let ([x, y], [u, v]) = (run.trajectory.position(t), exact.trajectory.position(t));
                (x - u).hypot(y - v)
            });
            let error = error.fold(0.0, f64::max);
            let count = run.trajectory.steps().len();
            println!("{tolerance:e}: {error:.1e}, {} directions, {count} steps", run.directions);
            assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
        }
    }
}

/// v = 0.8349996181 at β = 3 (PHYSICS: v² = (2β - 1 - √(1 + 4β))/2), from a walk that has always been going, and from rest
/// on a flat field after a push, in any direction.
#[test]
fn a_free_walker_has_the_speed_of_theory() {
    let theory = (0.5 * (5.0 - 13.0_f64.sqrt())).sqrt();
    assert!((theory - 0.834_999_618_1).abs() < 1e-10);
    let (sin, cos) = 0.7_f64.sin_cos();
    let past = WalkerPast::Straight([theory * cos, theory * sin]);
    let steady = WalkerScenario { past, ..WalkerScenario::new(-3.0, 1.0, 60.0) };
    for (scenario, from) in [(steady, 0.0), (pushed(-3.0, 1.0, 90.0), 60.0)] {
        let run = run(&scenario).unwrap();
        for i in 0..=30 {
            let [x, y] = run.trajectory.velocity((from + f64::from(i)).min(scenario.until));
            let speed = x.hypot(y);
            assert!((speed - theory).abs() < 1e-9, "{speed}");
        }
    }
    // Other units of time: v T is a function of αT².
    let slow = WalkerScenario::new(-3.0 / 16.0, 4.0, 1.0);
    assert!((4.0 * slow.free_speed() - theory).abs() < 1e-15);
    assert!(WalkerScenario::new(-2.0, 1.0, 1.0).free_speed().abs() < 1e-300);
}

/// Without its field a trapped walker with inertia is a damped oscillator in a magnetic field: e^{λt} with Mλ² + (1 + iΩ)λ +
/// K = 0 for x + iy.
#[test]
fn without_its_field_a_walker_obeys_a_linear_equation() {
    let scenario = WalkerScenario {
        inertia: Some(1.3),
        rotation: 0.9,
        trap: 0.7,
        position: [1.0, 0.0],
        velocity: [0.0, 0.4],
        ..WalkerScenario::new(0.0, 1.0, 12.0)
    };
    let run = run(&scenario).unwrap();
    let (mass, damping) = (1.3, num_complex::Complex64::new(1.0, 0.9));
    let root = (damping * damping - 4.0 * mass * 0.7).sqrt();
    let [a, b] = [(-damping + root) / (2.0 * mass), (-damping - root) / (2.0 * mass)];
    let velocity = num_complex::Complex64::new(0.0, 0.4);
    let weight = (velocity - b) / (a - b);
    for i in 0..=120 {
        let t = 0.1 * f64::from(i);
        let exact = weight * (a * t).exp() + (1.0 - weight) * (b * t).exp();
        let [x, y] = run.trajectory.position(t);
        assert!((exact - num_complex::Complex64::new(x, y)).norm() < 1e-9, "{t}: {x} {y} {exact}");
    }
}

/// A particle that becomes faster than its directions allow is run again with more of them.
#[test]
fn a_fast_walker_gets_more_directions() {
    let calm = run(&pushed(-3.0, 1.0, 6.0)).unwrap();
    let force = [pulse(30.0, 2.0, 0.5), Force::default()];
    let scenario = WalkerScenario { force, ..pushed(-3.0, 1.0, 6.0) };
    let fast = run(&scenario).unwrap();
    assert!(fast.directions > 4 * calm.directions, "{} {}", fast.directions, calm.directions);
    let worst = motion(&scenario, 250).into_iter().map(|(t, [x, y])| {
        let [told_x, told_y] = fast.trajectory.position(t);
        (told_x - x).hypot(told_y - y)
    });
    let worst = worst.fold(0.0, f64::max);
    println!("{worst:e}, {} directions", fast.directions);
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn walkers_refuse_what_makes_no_sense() {
    let base = || WalkerScenario::new(-3.0, 1.0, 10.0);
    let refused = |scenario: WalkerScenario| run(&scenario).err();
    assert_eq!(
        refused(WalkerScenario { healing_time: 0.0, ..base() }),
        Some(WalkerError::HealingTime(0.0))
    );
    assert_eq!(refused(WalkerScenario { trap: -1.0, ..base() }), Some(WalkerError::Trap(-1.0)));
    assert_eq!(refused(WalkerScenario { until: 0.0, ..base() }), Some(WalkerError::Until(0.0)));
    assert_eq!(
        refused(WalkerScenario { tolerance: 1e-15, ..base() }),
        Some(WalkerError::Tolerance(1e-15))
    );
    assert_eq!(
        refused(WalkerScenario { inertia: Some(0.0), ..base() }),
        Some(WalkerError::Inertia(0.0))
    );
    let far = WalkerPast::Straight([1e4, 0.0]);
    let range = refused(WalkerScenario { past: far, ..base() });
    assert!(matches!(range, Some(WalkerError::Range { .. })), "{range:?}");
    let function = [Force::from_fn(|t| t), Force::default()];
    assert_eq!(refused(WalkerScenario { force: function, ..base() }), Some(WalkerError::Force));
}
