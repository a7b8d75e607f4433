//! Are cycles what they claim to be? Judged by
//!
//! - values of 30 digits (data/reference_values.json: Fourier collocation of (18), by data/reference_values.py),
//! - the equation itself: the residual of (18) with the memory integral by Gauss quadrature over the past
//!   periods, on a finer mesh than the one solved on, sharing with the solver neither sums of exponentials nor
//!   states,
//! - runs of the integrator, with its own memory, until the motion has settled,
//! - the leading order of the bifurcation (stability/onset.rs), and the surface of a run (crates/surface).

use crate::acceptance::{Acceptance, largest_difference};
use gauss_quad::legendre::GaussLegendre;
use stickslip_cycles::{Cycle, CycleError, DEFAULT_TOLERANCE, cycle, cycle_near};
use stickslip_outcome::run_and_judge;
use stickslip_stability::{critical, onset};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{Gaussian, Model, Run, Scenario, TipFunction, Trajectory, Wider, run};

fn tip(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).unwrap()
}

fn model(beta: f64, alpha: f64, r: f64) -> Model {
    Model::new(tip(beta), alpha, r).unwrap()
}

/// (β, α, r): sinusoidal, stick-slip, sharp, relaxing with slips at 29 r, period-doubled, small r.
const CASES: [(f64, f64, f64); 7] = [
    (1.0, 1.12, 1.0),
    (1.0, 1.4, 1.0),
    (1.0, 1.9, 1.0),
    (0.0, 2.6, 1.0),
    (1.0, 1.62, 1.0),
    (0.5, 10.0, 3.0),
    (0.9, 0.065, 0.1),
];

fn found((beta, alpha, r): (f64, f64, f64)) -> Cycle {
    cycle(&model(beta, alpha, r), DEFAULT_TOLERANCE).unwrap()
}

fn reference(name: &str) -> f64 {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference_values.json");
    let text = std::fs::read_to_string(path).unwrap();
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    document["values"][name]["value"].as_str().unwrap().parse().unwrap()
}

#[test]
fn the_cycle_just_above_onset_is_the_one_known_to_30_digits() {
    let at = critical(&Wider::default(), &tip(1.0), 1.0).unwrap();
    let cycle = found((1.0, at.alpha + 0.01, 1.0));
    let judge = Acceptance { floor: 1e-11, slack: 0.0 };
    let of =
        |what| reference(&format!("cycle.triple_gaussian.r_1.alpha_critical_plus_0.01.{what}"));
    judge.judge("period", (cycle.period() - of("period")).abs(), 0.0);
    judge.judge("amplitude of x0", (cycle.amplitude_x0() - of("amplitude_x0")).abs(), 0.0);
    judge.judge("amplitude of u", (cycle.amplitude_u() - of("amplitude_u")).abs(), 0.0);
}

/// Newton's method may turn a small guess over, into a cycle that begins where l is smallest: that minimum was counted at
/// either end of the period.
#[test]
fn a_cycle_that_begins_with_a_minimum_has_no_slip_more() {
    let small =
        found((1.0, critical(&Wider::default(), &tip(1.0), 1.0).unwrap().alpha + 0.01, 1.0));
    let turned = cycle_near(&model(1.0, 1.1, 1.0), small.motion(), DEFAULT_TOLERANCE).unwrap();
    let (lowest, highest) = turned.extremes();
    assert!(turned.motion().l(0.0) < lowest + 1e-9 && highest > lowest + 0.6);
    assert_eq!(turned.slips(), 1);
}

/// l' - ∫_0^∞ F(rτ + l(t-τ) - l(t))dτ + l at time t, F = -α f', l continued periodically.
fn residual(cycle: &Cycle, t: f64) -> f64 {
    let (motion, period) = (cycle.motion(), cycle.period());
    let (tip, r) = (cycle.model().tip(), cycle.model().r());
    let rule = GaussLegendre::new(8.try_into().unwrap());
    let (here, reach) = (motion.l(t), tip.reach().unwrap());
    let mut memory = 0.0;
    for n in 0.. {
        // x0(t) - x0(t') for t' in this period, n periods before.
        let shift = period * f64::from(n);
        let mut seen = false;
        for step in motion.steps() {
            let end = step.end().min(t + shift);
            if end <= step.t {
                continue;
            }
            let parts = 4;
            for part in 0..parts {
                let width = (end - step.t) / f64::from(parts);
                let from = step.t + width * f64::from(part);
                for (node, weight) in rule.as_node_weight_pairs() {
                    let earlier = from + 0.5 * width * (1.0 + node);
                    let distance = r * (t + shift - earlier) + motion.l(earlier) - here;
                    seen |= distance < reach;
                    memory -= 0.5 * width * weight * cycle.model().alpha() * tip.slope(distance);
                }
            }
        }
        if !seen && n > 0 {
            break;
        }
    }
    (r - motion.velocity(t)) - memory + here
}

#[test]
fn the_equation_holds_between_the_nodes_too() {
    // At the last one sums over the nodes of the longest steps missed more than they were thought to: 1.8e-9, told as 6.6e-10.
    for case in CASES.into_iter().chain([(1.0, 1.6184, 1.0)]) {
        let cycle = found(case);
        let steps = cycle.motion().steps();
        let at = |i: usize| steps.iter().step_by(3).map(move |s| s.t + s.h * i as f64 / 9.0);
        let residuals = (0..=8).flat_map(at).map(|t| residual(&cycle, t).abs());
        let largest = residuals.fold(0.0, f64::max);
        Acceptance { floor: 1e-9, slack: 0.0 }.judge(&format!("{case:?}"), largest, 0.0);
        // What it says of itself is no fiction.
        assert!(cycle.residual() <= DEFAULT_TOLERANCE && largest > 1e-2 * cycle.residual());
        assert!(largest < 1.3 * cycle.residual(), "{case:?}: {largest:e}, {:e}", cycle.residual());
    }
    // Control: with a tolerance a thousand times larger, the residual is seen to be larger.
    let coarse = cycle(&model(1.0, 1.4, 1.0), 1e-6).unwrap();
    let at = |i: u32| residual(&coarse, coarse.period() * f64::from(i) / 300.0).abs();
    assert!((0..300).map(at).fold(0.0, f64::max) > 1e-8);
}

/// Long slips amplify what steps and sums err by: before that was counted the error at 1e-8 was told five times too small.
#[test]
fn errors_of_long_slips_are_told() {
    let [coarse, fine] =
        [1e-8, 2e-10].map(|tolerance| cycle(&model(1.0, 2.0, 1.0), tolerance).unwrap());
    let (off, told) = ((coarse.period() - fine.period()).abs(), coarse.error() + fine.error());
    println!("period off by {off:.1e}, told {told:.1e}; amplitude {:.1}", fine.amplitude_x0());
    assert!(off < told && off > 0.02 * told);
    assert!((coarse.amplitude_x0() - fine.amplitude_x0()).abs() < told);
    // Control: what is told of a cycle without long slips does not cover it.
    let short = cycle(&model(1.0, 1.4, 1.0), 1e-8).unwrap();
    assert!(short.error() < off);
}

/// Where the motion last rises through a level before t.
fn rises_through(motion: impl Fn(f64) -> f64, level: f64, t: f64, window: f64) -> f64 {
    let n = 4000;
    let at = |i: i32| t - window * f64::from(i) / f64::from(n);
    let i = (0..n).find(|&i| motion(at(i)) > level && motion(at(i + 1)) <= level).unwrap();
    let (mut low, mut high) = (at(i + 1), at(i));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if motion(middle) > level { &mut high } else { &mut low }) = middle;
    }
    low
}

fn settled(model: &Model, until: f64, kick: f64, tolerance: f64) -> Run {
    run(&Scenario { kick, tolerance, ..Scenario::new(model.clone(), until) }).unwrap()
}

#[test]
fn runs_settle_into_the_cycles() {
    for (case, until) in CASES.into_iter().zip([800.0, 500.0, 400.0, 800.0, 400.0, 1000.0, 20000.0])
    {
        let cycle = found(case);
        assert!(cycle.is_stable(), "{case:?}");
        let run = settled(cycle.model(), until, 0.1, 1e-11);
        let (motion, end) = (&run.trajectory, run.trajectory.end());
        let period = cycle.period();
        let around = |t: f64| cycle.motion().l(t.rem_euclid(period));
        // A level that a period rises through but once: just below the largest l.
        let (low, high) = cycle.extremes();
        let level = high - 0.02 * (high - low);
        let ours = rises_through(around, level, period, period);
        let theirs = rises_through(|t| motion.l(t), level, end - period, 1.01 * period);
        let difference =
            largest_difference(|t| motion.l(theirs + t), |t| around(ours + t), (0.0, period), 5000);
        let fastest = motion.steps().iter().map(|s| motion.velocity(s.end())).fold(0.0, f64::max);
        println!("{case:?}: slips at {:.1} r", fastest / cycle.model().r());
        Acceptance { floor: 1e-8, slack: 0.0 }.judge(&format!("{case:?}"), difference, 0.0);
        assert!(case.1 < 2.0 || case.0 > 0.0 || fastest > 5.0 * cycle.model().r());
    }
}

/// Maxima of l over the run.
fn maxima(motion: &Trajectory) -> Vec<f64> {
    let r = motion.r();
    let mut found = vec![];
    for step in motion.steps() {
        let rising = |t: f64| motion.velocity(t) < r;
        let (start, end) = (step.t + 1e-9 * step.h, step.end() - 1e-9 * step.h);
        if rising(start) && !rising(end) {
            let (mut low, mut high) = (start, end);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                *(if rising(middle) { &mut low } else { &mut high }) = middle;
            }
            found.push(motion.l(low));
        }
    }
    found
}

#[test]
fn a_disturbed_run_returns_by_the_leading_multiplier() {
    for (alpha, until) in [(1.12, 500.0), (1.2, 250.0), (1.4, 300.0), (1.46, 800.0)] {
        let cycle = found((1.0, alpha, 1.0));
        let leading = cycle.nontrivial_multipliers().next().unwrap();
        let run = settled(cycle.model(), until, 0.1, 1e-12);
        let highest = cycle.extremes().1;
        let away: Vec<f64> = maxima(&run.trajectory).iter().map(|l| l - highest).collect();
        // Small enough to be linear, large against the errors of the run.
        let pair = away.windows(2).find(|pair| pair[0].abs() < 2e-6).unwrap();
        let ratio = pair[1] / pair[0];
        println!("α = {alpha}: multiplier {:.7}, ratio {ratio:.7}", leading.re);
        assert!(leading.im.abs() < 1e-12);
        Acceptance { floor: 1e-4, slack: 0.0 }.judge("ratio", (ratio - leading.re).abs(), 0.0);
    }
}

#[test]
fn multipliers_do_not_depend_on_the_resolution() {
    for case in CASES {
        let cycles = [1e-6, 1e-9, 1e-10]
            .map(|tolerance| cycle(&model(case.0, case.1, case.2), tolerance).unwrap());
        let of = |cycle: &Cycle| cycle.nontrivial_multipliers().next().map_or(0.0, |m| m.re);
        assert!(cycles[0].steps() < cycles[1].steps() && cycles[1].steps() < cycles[2].steps());
        for (coarse, bound) in [(&cycles[0], 1e-6), (&cycles[1], 1e-8)] {
            let difference = (of(coarse) - of(&cycles[2])).abs();
            Acceptance { floor: bound, slack: 0.0 }.judge(&format!("{case:?}"), difference, 0.0);
        }
        for cycle in &cycles {
            let trivial = cycle.multipliers().iter().map(|m| (m - 1.0).norm());
            assert!(trivial.fold(f64::INFINITY, f64::min) < 1e-5);
        }
    }
}

#[test]
fn at_onset_the_cycle_is_that_of_the_leading_order() {
    let born = onset(&tip(1.0), 1.0).unwrap();
    for above in [1e-6, 1e-5, 1e-4] {
        let cycle = found((1.0, born.critical.alpha + above, 1.0));
        let square = cycle.amplitude_x0().powi(2) / (born.amplitude_squared_slope * above);
        let period = (cycle.period() - born.critical.period) / (born.period_slope * above);
        println!("{above:e}: {:.2e}, {:.2e}", square - 1.0, period - 1.0);
        assert!((square - 1.0).abs() < 10.0 * above + 2e-6);
        assert!((period - 1.0).abs() < 10.0 * above + 2e-5);
        // A small deviation of the amplitude decays twice as fast as that of steady motion grows.
        let decay = -2.0 * born.growth_slope * above * cycle.period();
        let multiplier = cycle.nontrivial_multipliers().next().unwrap().re;
        assert!(((multiplier - 1.0) / decay - 1.0).abs() < 10.0 * above + 1e-4);
    }
}

#[test]
fn below_onset_there_is_no_small_cycle() {
    let at = critical(&Wider::default(), &tip(1.0), 1.0).unwrap();
    for below in [1e-6, 0.1] {
        let refused = cycle(&model(1.0, at.alpha - below, 1.0), DEFAULT_TOLERANCE).unwrap_err();
        assert!(matches!(refused, CycleError::NoSmallCycle { .. }), "{refused}");
        assert!(refused.to_string().contains("no small cycle"));
    }
}

#[test]
fn what_has_no_cycle_is_refused() {
    let trapped = cycle(&model(1.0, 2.2, 1.0), DEFAULT_TOLERANCE).unwrap_err();
    assert!(trapped.to_string().contains("trapped"), "{trapped}");
    let bessel = Model::new(TipFunction::Bessel, 1.2, 1.0).unwrap();
    assert!(matches!(cycle(&bessel, DEFAULT_TOLERANCE), Err(CycleError::NeverFades)));
    for tolerance in [0.0, 1.0, f64::NAN] {
        let refused = cycle(&model(1.0, 1.2, 1.0), tolerance).unwrap_err();
        assert!(matches!(refused, CycleError::Tolerance(_)));
    }
}

/// A tip whose sides differ, the one ahead or the other: runs settle into its cycle, and near onset the leading order has
/// its amplitude, with an error that falls with α - αc.
#[test]
fn the_cycle_of_a_tip_with_two_sides_is_that_of_runs_and_of_the_leading_order() {
    let slope = |c: f64| c * (-0.5 * c * c).exp();
    let lobes = [(1.0, 0.0), (-0.4, 2.0), (-0.4 * slope(2.0) / slope(1.5), -1.5)];
    let term = |(amplitude, center)| Gaussian { amplitude, center, width: 1.0 };
    let sides = TipFunction::asymmetric_sum(lobes.map(term).to_vec()).unwrap();
    for tip in [sides.clone(), sides.mirrored()] {
        let at = critical(&Wider::default(), &tip, 1.0).unwrap().alpha;
        let found = |above: f64| {
            let model = Model::new(tip.clone(), at + above, 1.0).unwrap();
            cycle(&model, DEFAULT_TOLERANCE).unwrap()
        };
        let leading = onset(&tip, 1.0).unwrap().amplitude_squared_slope;
        let off =
            [1e-2, 1e-3].map(|above| found(above).amplitude_x0().powi(2) / above / leading - 1.0);
        println!("{off:?}");
        assert!(off[0].abs() < 0.1 && (off[0] / off[1]).log10() > 0.9, "{off:?}");
        let cycle = found(0.2);
        let scenario =
            Scenario { kick: 0.1, tolerance: 1e-11, ..Scenario::new(cycle.model().clone(), 800.0) };
        let (run, outcome) = run_and_judge(&scenario).unwrap();
        let oscillation = outcome.oscillation.unwrap();
        let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
        let ripple = ripple_behind(&surface, oscillation.wavelength).unwrap();
        let period = (oscillation.period - cycle.period()).abs();
        let amplitude = (ripple.amplitude - cycle.amplitude_u()).abs();
        println!("period {period:.1e}, ripple {amplitude:.1e} of {}", ripple.amplitude);
        assert!(period < 1e-8 && amplitude < 1e-8, "{period:e} {amplitude:e}");
    }
}

#[test]
fn the_ripple_is_that_of_a_run() {
    for case in [(1.0, 1.4, 1.0), (0.0, 2.6, 1.0), (0.5, 10.0, 3.0)] {
        let cycle = found(case);
        let scenario =
            Scenario { kick: 0.1, tolerance: 1e-11, ..Scenario::new(cycle.model().clone(), 800.0) };
        let (run, outcome) = run_and_judge(&scenario).unwrap();
        let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
        let ripple = ripple_behind(&surface, outcome.oscillation.unwrap().wavelength).unwrap();
        let difference = (ripple.amplitude - cycle.amplitude_u()).abs();
        Acceptance { floor: 1e-8, slack: 0.0 }.judge(&format!("{case:?}"), difference, 0.0);
    }
}

/// Where the surface heals, u(x, t) e^{(rt - x)/(rT)} behind the tip depends on x alone: judged by u itself at two times, on
/// runs that end anywhere within a period.
#[test]
fn the_ripple_of_a_surface_that_heals_is_that_of_a_run() {
    let cases = [
        (TipFunction::gaussian(1.0), 0.803_822, 0.428_268, 26.8123),
        (TipFunction::triple_gaussian(1.0, 1.0), 1.6, 1.0, 10.0),
    ];
    for (tip, alpha, r, time) in cases {
        let wider = Wider { healing_time: Some(time), ..Wider::default() };
        let model = Model::under(wider, tip.unwrap(), alpha, r).unwrap();
        let cycle = cycle(&model, DEFAULT_TOLERANCE).unwrap();
        for until in [448.0, 450.0, 455.0] {
            let scenario = Scenario { kick: 0.1, ..Scenario::new(model.clone(), until) };
            let (run, outcome) = run_and_judge(&scenario).unwrap();
            let found = outcome.oscillation.unwrap();
            let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
            let ripple = ripple_behind(&surface, found.wavelength).unwrap();
            let error = found.amplitude_u_error(ripple.amplitude);
            let off = (ripple.amplitude - cycle.amplitude_u()).abs();
            assert!(
                off <= error + cycle.amplitude_u_error(),
                "{until}: {ripple:?} {error:e}, off {off:e}"
            );
            assert!(error < 1e-4 * ripple.amplitude, "{until}: {error:e}");
            let high = run.trajectory.x0(until - 1.0) - model.tip().reach().unwrap();
            let x: Vec<f64> =
                (0..2000).map(|i| high - found.wavelength * f64::from(i) / 2000.0).collect();
            for t in [until - 1.0, until] {
                let u = surface.heights(t, &x).unwrap();
                let unfaded = u.iter().zip(&x).map(|(u, x)| u * ((r * t - x) / (r * time)).exp());
                let (low, top) = unfaded
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), u| (a.min(u), b.max(u)));
                let miss = (0.5 * (top - low) / ripple.amplitude - 1.0).abs();
                assert!(miss < 1e-4, "{until}, t = {t}: {miss:e}");
            }
        }
    }
}

/// A footprint with a narrow trough, and one in relaxation: to loose tolerances the sum that stands for f errs by
/// more than the mesh, or the mesh by more than at its ends.
#[test]
fn errors_hold_whatever_tolerance_is_asked() {
    let lobe = |amplitude: f64, center: f64, width: f64| {
        [center, -center].map(|center| Gaussian { amplitude, center, width })
    };
    let mut terms = vec![Gaussian { amplitude: 1.0, center: 0.0, width: 1.0 }];
    terms.extend([lobe(0.3, 2.3, 0.5), lobe(-0.5, 2.5, 0.2)].into_iter().flatten());
    let troughs = TipFunction::gaussian_sum(terms).unwrap();
    let onset = critical(&Wider::default(), &troughs, 1.0).unwrap().alpha;
    let cases = [
        Model::new(troughs, 1.05 * onset, 1.0).unwrap(),
        Model::new(TipFunction::gaussian(1.0).unwrap(), 2.6, 1.0).unwrap(),
    ];
    for model in cases {
        let best = cycle(&model, 1e-10).unwrap();
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-8] {
            let found = cycle(&model, tolerance).unwrap();
            let most = found.error() + best.error();
            let off = [found.period() - best.period(), found.amplitude_x0() - best.amplitude_x0()];
            assert!(off.iter().all(|off| off.abs() <= most), "{tolerance}: {off:?}, {most}");
            assert!(most < 30.0 * tolerance, "{tolerance}: {most}");
        }
    }
}
