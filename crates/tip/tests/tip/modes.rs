//! Is the sum of exponentials as good as it says, and its state all of the past?
//!
//! The fit is judged by f' itself on a finer grid than its own; the state by `direct`, the definition, on
//! random paths; whole runs by `direct` as well, to the tolerance, tests/science/memories_agree.rs at the root
//! holding the same for every memory.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use stickslip_tip::memory::{Fit, FitError, Groove, Policy, Retreat, Sum, accuracy_needed};
use stickslip_tip::{
    Force, Gaussian, MemoryChoice, Model, Pulse, Run, RunError, STAGES, Scenario, Stages, Start,
    TipFunction, Wider, nodes_and_weights, run,
};

fn triple() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).unwrap()
}

fn direct(tip: TipFunction) -> Policy {
    Policy::new(MemoryChoice::Direct, tip, 0.0, Retreat::Small).unwrap()
}

fn table() -> TipFunction {
    let x: Vec<f64> = (0..40).map(|i| 0.2 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.2 * x * x) * (-x * x / 2.0).exp()).collect();
    TipFunction::table(&x, &f).unwrap()
}

/// Each with the best accuracy that is asked of it here.
fn footprints() -> Vec<(&'static str, TipFunction, f64)> {
    let lobes = [(1.0, 0.0, 1.0), (0.3, 3.0, 0.7), (0.3, -3.0, 0.7)];
    let uneven = lobes.map(|(amplitude, center, width)| Gaussian { amplitude, center, width });
    vec![
        ("triple", triple(), 1e-13),
        ("triple 0.5", TipFunction::triple_gaussian(0.5, 1.0).unwrap(), 1e-13),
        ("wide triple", TipFunction::triple_gaussian(1.0, 3.0).unwrap(), 1e-12),
        ("gaussian", TipFunction::gaussian(1.0).unwrap(), 1e-12),
        ("gaussian 0.8", TipFunction::gaussian(0.8).unwrap(), 1e-12),
        ("two widths", TipFunction::gaussian_sum(uneven.to_vec()).unwrap(), 1e-10),
        ("table", table(), 1e-10),
    ]
}

/// Largest errors of slope and curvature on a grid of 1e-3 from -δ to four times the reach.
fn true_errors(tip: &TipFunction, fit: &Fit) -> (f64, f64) {
    let (from, to) = (-fit.retreat(), 4.0 * tip.reach().unwrap());
    let n = 40_000;
    (0..=n).fold((0.0, 0.0), |(slope, curvature): (f64, f64), i| {
        let xi = from + (to - from) * f64::from(i) / f64::from(n);
        let (exact, fitted) = (tip.slope_and_curvature(xi), fit.slope_and_curvature(xi));
        (slope.max((exact.0 - fitted.0).abs()), curvature.max((exact.1 - fitted.1).abs()))
    })
}

#[test]
fn the_certified_error_is_met_is_honest_and_not_far_off() {
    for (name, tip, finest) in footprints() {
        for digits in 3..=13 {
            let wanted = 10_f64.powi(-digits);
            if wanted < 0.99 * finest {
                continue;
            }
            let fit =
                Fit::new(&tip, wanted, Retreat::Small).unwrap_or_else(|e| panic!("{name}: {e}"));
            let (slope, curvature) = true_errors(&tip, &fit);
            let found = fit.certificate();
            println!("{name} {wanted:e}: {} terms, {slope:.2e}, {found:?}", fit.terms().len());
            // The sums of this test are rounded themselves.
            let round_off = 1e-15 * fit.terms().iter().map(|t| t.weight.norm()).sum::<f64>();
            assert!(found.slope <= wanted, "{name}: {found:?}");
            assert!(slope <= found.slope + round_off, "{name}: {slope:e} above {found:?}");
            assert!(curvature <= found.curvature + 10.0 * round_off, "{name}: {curvature:e}");
            assert!(found.slope <= 2.5 * slope + round_off, "{name}: {slope:e}, {found:?}");
            assert!(fit.terms().iter().all(|t| t.exponent.re < 0.0), "{name}");
        }
    }
}

#[test]
fn the_default_tips_need_few_terms() {
    let terms =
        |tip: &TipFunction, wanted| Fit::new(tip, wanted, Retreat::Small).unwrap().terms().len();
    let gaussian = TipFunction::gaussian(1.0).unwrap();
    let wanted = [1e-4, 1e-7, 1e-10, 3e-12, 1e-13];
    assert_eq!(wanted.map(|wanted| terms(&triple(), wanted)), [5, 7, 9, 11, 24]);
    assert_eq!(wanted.map(|wanted| terms(&gaussian, wanted)), [4, 6, 7, 8, 16]);
}

/// Negative control: each term carries weight.
#[test]
fn without_one_term_the_sum_is_far_off() {
    let fit = Fit::new(&triple(), 1e-9, Retreat::Small).unwrap();
    for term in fit.terms() {
        let largest = |xi: f64| (term.weight * (term.exponent * xi).exp()).re.abs();
        let miss = (0..200).map(|i| largest(0.01 * f64::from(i) - 0.5)).fold(0.0, f64::max);
        assert!(miss > 1e-7, "{term:?} carries {miss:e}");
    }
}

/// A random path: mostly forward, by up to a step's length, at times back.
fn random_path(seed: u64, back: f64, steps: usize) -> Vec<([f64; STAGES], [f64; STAGES])> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (c, b) = nodes_and_weights();
    let step = |_| {
        let size = 10_f64.powf(rng.random_range(-3.0..0.3));
        let length = if rng.random_bool(0.2) { -back * size } else { size };
        let h: f64 = rng.random_range(0.01..1.0);
        (c.map(|c| length * c * (0.7 + 0.3 * c)), b.map(|b| b * h))
    };
    (0..steps).map(step).collect()
}

fn modes_of(tip: TipFunction, accuracy: f64) -> Result<Policy, FitError> {
    Policy::new(MemoryChoice::Modes, tip, accuracy, Retreat::Small)
}

/// What a memory tells about some points.
#[derive(Default)]
struct Told {
    height: Stages,
    slope: Stages,
    curvature: Stages,
}

fn told(memory: &mut Policy, at: &Stages) -> Told {
    let mut told = Told::default();
    let groove = Groove::new(&mut told.slope, &mut told.curvature);
    memory.groove(at, &mut groove.with_height(&mut told.height));
    told
}

/// Largest differences of what two memories tell.
#[derive(Debug, Default)]
struct Difference {
    height: f64,
    slope: f64,
    curvature: f64,
}

/// That of two memories along a path.
fn difference(a: &mut Policy, b: &mut Policy, path: &[(Stages, Stages)]) -> Difference {
    let mut largest = Difference::default();
    let mut looks = ChaCha8Rng::seed_from_u64(9);
    for (position, weight) in path {
        a.remember(position, weight);
        b.remember(position, weight);
        let spread = looks.random_range(0.0..2.0);
        let at = std::array::from_fn(|i| spread * (i as f64 / 5.0 - 0.1));
        let (a, b) = (told(a, &at), told(b, &at));
        let grow = |largest: &mut f64, a: &Stages, b: &Stages| {
            *largest = a.iter().zip(b).fold(*largest, |m, (a, b)| m.max((a - b).abs()));
        };
        grow(&mut largest.height, &a.height, &b.height);
        grow(&mut largest.slope, &a.slope, &b.slope);
        grow(&mut largest.curvature, &a.curvature, &b.curvature);
    }
    largest
}

#[test]
fn the_state_is_the_direct_sum_on_random_paths() {
    for (name, tip, _) in footprints() {
        for wanted in [1e-5, 1e-7, 1e-10] {
            let mut modes = modes_of(tip.clone(), wanted).unwrap();
            let mut direct = direct(tip.clone());
            let path = random_path(1, 0.02, 400);
            let total = 40.0;
            let error = difference(&mut modes, &mut direct, &path);
            let Sum::Modes { certificate, .. } = modes.report().sum else { panic!("not modes") };
            println!("{name} {wanted:e}: {error:?}, {certificate:?}");
            assert!(error.slope < wanted * total + 1e-12, "{name} {wanted:e}: {error:?}");
            let allowed = certificate.curvature * total + 1e-11;
            assert!(error.curvature < allowed, "{name} {wanted:e}: {error:?}");
            // f is the integral of f' from far ahead; the certificate holds for all of the time.
            let time: f64 = path.iter().flat_map(|(_, weight)| weight).sum();
            assert!(error.height < certificate.area * time + 1e-11, "{name} {wanted:e}: {error:?}");
        }
    }
}

#[test]
fn a_retreat_goes_over_to_fft_and_comes_back_without_a_trace() {
    for back in [0.3, 0.8, 2.0] {
        let mut modes = modes_of(triple(), 1e-10).unwrap();
        let mut direct = direct(triple());
        let error = difference(&mut modes, &mut direct, &random_path(2, back, 600));
        let note = modes.report().reason();
        println!("{back}: {error:?}, {note}");
        assert!(note.contains("fft took over"), "{note}");
        assert!(error.slope < 5e-9, "{back}: {error:?}");
        assert!(error.curvature < 5e-8, "{back}: {error:?}");
        assert!(error.height < 2e-8, "{back}: {error:?}");
        assert_eq!(modes.forgotten(), None);
    }
}

/// The same path is too much for modes that expect a small retreat.
#[test]
fn modes_for_a_tip_that_swings_back_need_no_fft() {
    let path = random_path(2, 0.3, 600);
    for (back, stays) in [(Retreat::Small, false), (Retreat::Swing, true)] {
        let mut modes = Policy::new(MemoryChoice::Modes, triple(), 1e-10, back).unwrap();
        let error = difference(&mut modes, &mut direct(triple()), &path);
        let note = modes.report().reason();
        assert_eq!(stays, !note.contains("fft took over"), "{note}");
        assert!(error.slope < 5e-9, "{back:?}: {error:?}");
        assert!(error.height < 2e-8, "{back:?}: {error:?}");
    }
}

/// More nodes than are kept as they are, then a retreat over all of them.
#[test]
fn a_long_past_is_there_when_the_tip_comes_back() {
    let (c, b) = nodes_and_weights();
    let mut modes = modes_of(triple(), 1e-10).unwrap();
    let mut direct = direct(triple());
    let forward = random_path(3, 0.02, 6000).into_iter().map(|(x, w)| (x.map(|x| 0.1 * x), w));
    for (position, weight) in forward {
        modes.remember(&position, &weight);
        direct.remember(&position, &weight);
    }
    let back = (c.map(|c| -1.5 * c), b.map(|b| 0.1 * b));
    let error = difference(&mut modes, &mut direct, &vec![back; 80]);
    println!("{error:?}, {}", modes.report().reason());
    assert!(error.slope < 1e-9, "{error:?}");
    assert!(error.curvature < 1e-9, "{error:?}");
    assert!(error.height < 1e-9, "{error:?}");
    assert_eq!(modes.forgotten(), None);
}

#[test]
fn what_is_no_longer_kept_is_missed_aloud() {
    let (c, b) = nodes_and_weights();
    let mut modes = modes_of(triple(), 1e-4).unwrap();
    for _ in 0..8_000 {
        modes.remember(&c.map(|c| 1.5 * c), &b);
    }
    for _ in 0..4000 {
        assert_eq!(modes.forgotten(), None);
        modes.remember(&c.map(|c| -1.5 * c), &b);
        if modes.forgotten().is_some() {
            break;
        }
    }
    assert!(modes.forgotten().is_some_and(|kept| kept > 1000.0));
}

fn scenario(tip: TipFunction, alpha: f64, r: f64, until: f64) -> Scenario {
    Scenario { kick: 0.05, ..Scenario::new(Model::new(tip, alpha, r).unwrap(), until) }
}

fn largest_difference(a: &Run, b: &Run) -> f64 {
    let (start, end) = (a.trajectory.start(), a.trajectory.end());
    let t = |i: u32| start + (end - start) * f64::from(i) / 5000.0;
    let differences = (0..=5000).map(|i| (a.trajectory.l(t(i)) - b.trajectory.l(t(i))).abs());
    differences.fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most })
}

#[test]
fn runs_with_modes_are_those_with_direct_to_the_tolerance() {
    let x: Vec<f64> = (0..=80).map(|i| 18.0 + 0.1 * f64::from(i)).collect();
    let u = x.iter().map(|x| 0.6 * (-(x - 22.0_f64).powi(2)).exp()).collect();
    let pulse = |time| Pulse { amplitude: -8.0, time, width: 0.5 };
    let force = Force::new(vec![pulse(25.0), pulse(33.0)], None).unwrap();
    let gaussian = || TipFunction::gaussian(1.0).unwrap();
    let wider = Wider { depth_limit: Some(3.0), ..Wider::default() };
    let limited = Model::under(wider, gaussian(), 0.5, 1.0).unwrap();
    let cases = [
        ("stick-slip", scenario(triple(), 1.2, 1.0, 76.0)),
        ("flat", Scenario { start: Start::Flat, kick: 0.0, ..scenario(triple(), 0.75, 0.6, 90.0) }),
        ("bump", Scenario { profile: Some((x, u)), ..scenario(triple(), 0.9, 1.0, 60.0) }),
        ("pulses", Scenario { force, ..scenario(triple(), 0.9, 1.0, 60.0) }),
        ("gaussian 0.8", scenario(TipFunction::gaussian(0.8).unwrap(), 1.6, 1.0, 76.0)),
        ("table", scenario(table(), 1.0, 0.8, 50.0)),
        // From where the exponentials of the steady groove ahead have grown beyond all numbers, or the kink of |h|.
        ("kicked", Scenario { kick: 30.0, ..scenario(gaussian(), 0.5, 1.0, 40.0) }),
        (
            "kicked, limited",
            Scenario { kick: 4.0, model: limited, ..scenario(gaussian(), 0.5, 1.0, 40.0) },
        ),
    ];
    for (name, scenario) in cases {
        for tolerance in [1e-5, 1e-7, 1e-9, 1e-10] {
            if name == "table" && tolerance < 1e-9 {
                continue;
            }
            let with = |memory| run(&Scenario { memory, tolerance, ..scenario.clone() }).unwrap();
            let (modes, direct) = (with(MemoryChoice::Modes), with(MemoryChoice::Direct));
            let error = largest_difference(&modes, &direct);
            println!("{name} {tolerance:e}: {error:.1e}, {}", modes.memory_reason);
            assert_eq!(modes.memory, "modes");
            assert!(error < tolerance, "{name} {tolerance:e}: {error:e}");
            let retreats = modes.memory_reason.contains("fft took over");
            assert_eq!(retreats, name == "pulses", "{name}: {}", modes.memory_reason);
        }
    }
}

#[test]
fn errors_stay_within_ten_tolerances_from_1e_4_to_1e_11() {
    let at = |tolerance, memory| {
        run(&Scenario { tolerance, memory, ..scenario(triple(), 1.2, 1.0, 76.0) }).unwrap()
    };
    let reference = at(1e-13, MemoryChoice::Direct);
    for digits in 4..=11 {
        let tolerance = 10_f64.powi(-digits);
        let error = largest_difference(&at(tolerance, MemoryChoice::Modes), &reference);
        println!("{tolerance:e}: {error:.2e}");
        assert!(error < (10.0 * tolerance).max(5e-13), "{tolerance:e}: {error:e}");
    }
}

#[test]
fn a_footprint_that_never_fades_is_refused_in_favour_of_fft() {
    let refused = modes_of(TipFunction::Bessel, 1e-6).err().unwrap();
    assert_eq!(refused, FitError::NeverFades);
    assert!(refused.to_string().contains("fft"));
    let bessel = scenario(TipFunction::Bessel, 1.1, 1.0, 60.0);
    let asked = Scenario { memory: MemoryChoice::Modes, ..bessel.clone() };
    assert_eq!(run(&asked).unwrap_err(), RunError::Modes(FitError::NeverFades));
    assert_eq!(run(&bessel).unwrap().memory, "fft");
}

#[test]
fn an_accuracy_out_of_reach_is_refused_with_what_can_be_had() {
    let tight = Scenario { tolerance: 1e-13, ..scenario(triple(), 1.2, 1.0, 30.0) };
    let refused = run(&Scenario { memory: MemoryChoice::Modes, ..tight.clone() }).unwrap_err();
    let wanted = accuracy_needed(&tight.model, 1e-13);
    let RunError::Modes(FitError::NotMet { wanted: w, reached }) = refused else {
        panic!("{refused}")
    };
    assert!((w / wanted - 1.0).abs() < 1e-12 && reached > wanted && reached < 1e-12);
    assert_eq!(run(&tight).unwrap().memory, "fft");
}

/// Where f' is 1e12, 10 is an accuracy, and a lattice that is not damped is no fit: it never faded, and its certificate
/// was looked for without end.
#[test]
fn a_tip_of_any_width_is_fitted_or_refused() {
    for width in [1e-15, 1e-12, 1e-6, 1.0, 1e6, 1e12] {
        let tip = TipFunction::triple_gaussian(1.0, width).unwrap();
        for relative in [1e-3, 1e-8, 1e-11, 1e-20] {
            let wanted = relative / width;
            match Fit::new(&tip, wanted, Retreat::Small) {
                Ok(fit) => assert!(fit.certificate().slope <= wanted, "{width} {relative}"),
                Err(FitError::NotMet { reached, .. }) => {
                    assert!(reached > wanted || relative < 1e-8)
                }
                Err(error) => panic!("{width} {relative}: {error}"),
            }
        }
    }
}
