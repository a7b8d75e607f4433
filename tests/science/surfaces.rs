//! Is the surface that of the run? Judged by brute-force quadrature of (14) in this file, by the volume
//! law and by (37).

use crate::acceptance::Acceptance;
use gauss_quad::legendre::GaussLegendre;
use std::f64::consts::PI;
use std::num::NonZeroUsize;
use stickslip_outcome::judge_trajectory;
use stickslip_stability::critical;
use stickslip_surface::{Method, Surface, carved_by, ripple_behind};
use stickslip_tip::{
    InitialSurface, Model, Run, Scenario, Start, TipFunction, Trajectory, Wider, run,
};

/// Heights are of order one.
const HEIGHT: Acceptance = Acceptance { floor: 5e-13, slack: 1.0 };

fn triple(beta: f64, alpha: f64, r: f64) -> Model {
    Model::new(TipFunction::triple_gaussian(beta, 1.0).unwrap(), alpha, r).unwrap()
}

fn finished(scenario: &Scenario) -> (Run, InitialSurface) {
    (run(scenario).unwrap(), scenario.initial_surface().unwrap())
}

/// (14), with panels of a hundredth of a step.
fn brute_force(
    model: &Model,
    initial: &InitialSurface,
    trajectory: &Trajectory,
    t: f64,
    x: f64,
) -> f64 {
    let rule = GaussLegendre::new(NonZeroUsize::new(5).unwrap());
    let (start, panels) = (trajectory.start(), 40_000);
    let width = (t - start) / f64::from(panels);
    let mut sum = 0.0;
    for panel in 0..panels {
        for (node, weight) in rule.as_node_weight_pairs() {
            let then = start + width * (f64::from(panel) + 0.5 * (1.0 + node));
            sum += 0.5 * width * weight * model.tip().value(x - trajectory.x0(then));
        }
    }
    initial.height(x) - model.alpha() * sum
}

#[test]
fn heights_are_the_integral_14_at_any_time() {
    let cases = [
        Scenario { kick: 0.05, tolerance: 1e-11, ..Scenario::new(triple(1.0, 1.3, 1.0), 60.0) },
        Scenario {
            start: Start::Flat,
            tolerance: 1e-11,
            ..Scenario::new(triple(0.3, 0.6, 0.5), 60.0)
        },
        Scenario {
            tolerance: 1e-11,
            ..Scenario::new(Model::new(TipFunction::Bessel, 0.9, 1.0).unwrap(), 40.0)
        },
    ];
    for scenario in &cases {
        let (run, initial) = finished(scenario);
        let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
        let end = run.trajectory.end();
        for t in [run.trajectory.start(), 31.7, end] {
            let x = [-3.0, 12.2, 14.0, 20.0, 25.5, 31.0, 44.0, 60.0];
            let u = surface.heights(t, &x).unwrap();
            for (u, x) in u.iter().zip(x) {
                let exact = brute_force(&scenario.model, &initial, &run.trajectory, t, x);
                HEIGHT.judge(&format!("u({x}, {t})"), (u - exact).abs(), 1e-11);
            }
        }
    }
}

#[test]
fn fft_and_direct_sums_give_the_same_surface() {
    let scenario = Scenario { kick: 0.01, ..Scenario::new(triple(1.0, 1.079, 1.0), 457.0) };
    let (run, _) = finished(&scenario);
    let (positions, weights) = run.trajectory.residence(457.0);
    let x: Vec<f64> = (0..5000).map(|i| -20.0 + 0.1 * f64::from(i)).collect();
    let tip = scenario.model.tip();
    let direct = carved_by(Method::Direct, tip, &positions, &weights, &x);
    let fft = carved_by(Method::Fft, tip, &positions, &weights, &x);
    let difference = (&direct - &fft).iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    Acceptance { floor: 1e-12, slack: 0.0 }.judge("surface by fft", difference, 0.0);
    assert_eq!(Method::cheaper(tip, &positions, &x), Method::Fft);
    assert_eq!(Method::cheaper(tip, &positions, &x[..1]), Method::Direct);
}

#[test]
fn steady_motion_leaves_the_steady_profile() {
    let scenario = Scenario::new(triple(0.4, 0.8, 1.0), 80.0);
    let (run, initial) = finished(&scenario);
    let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
    let x: Vec<f64> = (0..900).map(|i| 0.1 * f64::from(i)).collect();
    let u = surface.heights(80.0, &x).unwrap();
    // (24)
    let steady = |x: f64| -0.8 * scenario.model.tip().tail(x - run.trajectory.x0(80.0));
    let difference = u.iter().zip(&x).fold(0.0, |m: f64, (u, x)| m.max((u - steady(*x)).abs()));
    Acceptance { floor: 0.0, slack: 10.0 }.judge("steady profile", difference, 1e-9);
    let behind = scenario.model.steady_surface_behind();
    assert!((u[0] - behind).abs() < 1e-8 && (behind + 0.8 * 0.6 * (2.0 * PI).sqrt()).abs() < 1e-12);
}

/// d/dt ∫u dx = -α (1-β) √(2π); the paper's (49) lacks the root.
#[test]
fn the_volume_falls_at_the_rate_that_the_footprint_demands() {
    for beta in [0.0, 0.3, 1.0] {
        let scenario = Scenario { kick: 0.05, ..Scenario::new(triple(beta, 1.1, 0.8), 60.0) };
        let (run, initial) = finished(&scenario);
        let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
        // The trapezoidal rule is exact to round-off for what vanishes smoothly at both ends.
        let x: Vec<f64> = (0..2000).map(|i| -40.0 + 0.1 * f64::from(i)).collect();
        let volume = |t: f64| 0.1 * (surface.heights(t, &x).unwrap()).sum();
        let rate = (volume(57.0) - volume(27.0)) / 30.0;
        let exact = -1.1 * (1.0 - beta) * (2.0 * PI).sqrt();
        HEIGHT.judge(&format!("volume, β = {beta}"), (rate - exact).abs(), 1e-11);
    }
}

/// (37): |A_u|/|A_x0| → (αc/r) q |f̂(q)| at onset, q = ω/r.
#[test]
fn ripple_and_tip_amplitudes_are_tied_at_onset() {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    for r in [1.0, 0.6] {
        let c = critical(&Wider::default(), &tip, r).unwrap();
        let q = c.omega / r;
        let exact = c.alpha / r * q * tip.fourier(q).abs();
        let ratio = |above: f64, until: f64| {
            let model = Model::new(tip.clone(), c.alpha + above, r).unwrap();
            let scenario = Scenario { kick: 0.05, tolerance: 1e-10, ..Scenario::new(model, until) };
            let (run, initial) = finished(&scenario);
            let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
            let outcome = judge_trajectory(&scenario, &run.initial_surface, &run.trajectory);
            let oscillation = outcome.oscillation.unwrap();
            let ripple = ripple_behind(&surface, oscillation.wavelength).unwrap();
            ripple.amplitude / oscillation.amplitude_x0
        };
        let found = ratio(3e-4, 30_000.0);
        println!("r = {r}: {found:.6}, (37) gives {exact:.6}");
        assert!((found / exact - 1.0).abs() < 1e-3);
    }
}
