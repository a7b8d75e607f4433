//! Linear theory under the wider law against runs that know nothing of it: growth exponents and the response to
//! a pulse. Runs from kicks or pulses of either sign have a half difference free of even orders.

use crate::stability_against_runs::{fitted_exponent, triple};
use stickslip_stability::{critical, leading_roots, response};
use stickslip_tip::{Force, Model, Pulse, Scenario, TipFunction, Trajectory, Wider, run};

/// Each extension by itself and all of them, with the tip and r.
fn cases() -> Vec<(Wider, TipFunction, f64)> {
    let none = Wider::default();
    vec![
        (Wider { depth_limit: Some(5.0), ..none }, triple(0.0), 1.0),
        (Wider { healing_time: Some(10.0), ..none }, triple(1.0), 1.0),
        (Wider { inertia: Some(0.5), ..none }, triple(1.0), 1.0),
        (Wider { depth_limit: Some(8.0), healing_time: Some(6.0), ..none }, triple(0.4), 0.7),
        (
            Wider {
                depth_limit: Some(10.0),
                healing_time: Some(12.0),
                inertia: Some(0.3),
                spring: true,
            },
            triple(0.0),
            1.0,
        ),
    ]
}

fn moved(model: &Model, kick: f64, force: Force, span: f64) -> Trajectory {
    let base = Scenario::new(model.clone(), 0.0);
    let until = base.start_time() + span;
    let scenario = Scenario { kick, force, until, tolerance: 1e-12, ..base };
    run(&scenario).expect("a run").trajectory
}

#[test]
fn leading_roots_are_the_exponents_fitted_to_runs_on_both_sides_of_onset() {
    const KICK: f64 = 3e-5;
    let mut worst = 0.0_f64;
    for (wider, tip, r) in cases() {
        let onset = critical(&wider, &tip, r).unwrap();
        for part in [0.97, 1.03] {
            let model = Model::under(wider, tip.clone(), part * onset.alpha, r).unwrap();
            let spectrum = leading_roots(&model, 4).unwrap();
            let root = spectrum.roots[0];
            let next = spectrum.roots[2].re;
            // Until further modes have faded to 1e-9, and a few periods of the leading one.
            let from = 21.0 / (root.re - next);
            let (dt, samples) = (0.09 * onset.period, 80);
            let span = from + dt * f64::from(samples) + 1.0;
            let none = || Force::new(vec![], None).unwrap();
            let up = moved(&model, KICK, none(), span);
            let down = moved(&model, -KICK, none(), span);
            let y: Vec<f64> = (0..samples)
                .map(|i| up.start() + from + dt * f64::from(i))
                .map(|t| 0.5 * (up.l(t) - down.l(t)))
                .collect();
            let fitted = fitted_exponent(&y, dt);
            let off = (fitted.0 - root.re).hypot(fitted.1 - root.im);
            println!("{wider:?} {part}: root {root:.10}, off {off:.1e}, from {from:.0}");
            assert!(root.re * (part - 1.0) > 1e-5, "the sides differ: {root}");
            worst = worst.max(off);
            // Negative control: the critical frequency is not the one fitted.
            assert!((fitted.1 - onset.omega).abs() > 1e-5, "{fitted:?}");
        }
    }
    println!("worst {worst:.1e} of 1e-7");
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn the_response_is_what_a_weak_pulse_does_to_runs() {
    const STRENGTH: f64 = 1e-4;
    for (wider, tip, r) in cases() {
        let alpha = 0.8 * critical(&wider, &tip, r).unwrap().alpha;
        let model = Model::under(wider, tip, alpha, r).unwrap();
        let width = 0.5;
        let center = Scenario::new(model.clone(), 0.0).start_time() + 12.0 * width;
        let pushed = |amplitude: f64| {
            let pulse = Pulse { amplitude, time: center, width };
            moved(&model, 0.0, Force::new(vec![pulse], None).unwrap(), 12.0 * width + 20.0)
        };
        let (up, down) = (pushed(STRENGTH), pushed(-STRENGTH));
        let pulse = Pulse { amplitude: 1.0, time: 0.0, width };
        let modes = response(&model, &[pulse], 12).unwrap();
        let early = modes.while_pulses_last(&model, 20.0).unwrap();
        let (mut after, mut during, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for i in 0..=400 {
            let t = -1.5 + 19.0 * f64::from(i) / 400.0;
            let exact = 0.5 * (up.l(center + t) - down.l(center + t)) / STRENGTH;
            largest = largest.max(exact.abs());
            during = during.max((early.at(t) - exact).abs());
            if t > 8.0 {
                after = after.max((modes.at(t) - exact).abs());
            }
        }
        println!("{wider:?}: {:.1e} in all, {:.1e} by modes", during / largest, after / largest);
        assert!(during < 2e-7 * largest && after < 2e-7 * largest);
    }
}

/// Half the difference of neighbouring extremes of l, one a period.
fn amplitudes(motion: &Trajectory, from: f64, period: f64, steady: f64) -> Vec<f64> {
    let count = ((motion.end() - from) / period).floor();
    let swing = |n: f64| {
        let at = |i: i32| motion.l(from + period * (n + f64::from(i) / 400.0)) - steady;
        let values = (0..400).map(at);
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(a, b), v| (v.min(a), v.max(b)));
        0.5 * (high - low)
    };
    #[expect(clippy::cast_possible_truncation, reason = "a count")]
    (0..count as i32).map(|n| swing(f64::from(n))).collect()
}

/// On the corner of |h| an oscillation of any small amplitude grows above the α that the balance of harmonics gives
/// and fades below, and that is not the paper's.
#[test]
fn small_oscillations_on_the_corner_keep_their_size_where_the_harmonics_balance() {
    let (tip, r) = (triple(1.0), 1.0);
    for b in [5.0, 2.0] {
        let wider = Wider { depth_limit: Some(b), ..Wider::default() };
        let onset = critical(&wider, &tip, r).unwrap();
        let growth = |kick: f64, part: f64| {
            let model = Model::under(wider, tip.clone(), part * onset.alpha, r).unwrap();
            let span = 140.0 + 12.0 * onset.period;
            let base = Scenario::new(model.clone(), 0.0);
            let until = base.start_time() + span;
            let run = run(&Scenario { kick, until, tolerance: 1e-11, ..base }).unwrap().trajectory;
            let from = run.start() + 140.0;
            let swings = amplitudes(&run, from, onset.period, model.steady_l());
            let last = swings.len() - 1;
            (swings[last] / swings[0]).ln() / (last as f64 * onset.period)
        };
        let zero = |kick: f64| {
            let (below, above) = (growth(kick, 0.999), growth(kick, 1.001));
            assert!(below < 0.0 && above > 0.0);
            0.999 + 0.002 * below / (below - above)
        };
        // A finite amplitude moves it, in proportion.
        let (small, twice) = (zero(1e-4), zero(2e-4));
        let none = 2.0 * small - twice;
        let paper = critical(&Wider::default(), &tip, r).unwrap().alpha / onset.alpha;
        println!("b {b}: {small:.8} {twice:.8}, {none:.8} at none; the paper's {paper:.5}");
        assert!((none - 1.0).abs() < 3e-6, "{none}");
        assert!((paper - 1.0).abs() > 1e-3, "negative control");
    }
}
