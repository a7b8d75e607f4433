//! The same equation as those see it who know its embedding: with the past as a sum of exponentials it is a system of
//! ordinary differential equations, z' = 1 + s x0' z, which any solver of such takes.
//!
//! Two motions, set off by a kick from steady motion, and an ensemble of the second over α.

use crate::{case, timed};
use serde_json::{Value, json};
use stickslip_tip::memory::{Fit, Retreat, accuracy_needed};
use stickslip_tip::{
    MemoryChoice, Model, Scenario, Step, TipFunction, Trajectory, collect_each, run,
};

/// (name, α, kick)
const MOTIONS: [(&str, f64, f64); 2] = [("onset", case::ALPHA, 0.01), ("stick-slip", 1.2, 0.05)];
/// The ensemble: number of values of α, and the first and the last.
const ENSEMBLE: (usize, f64, f64) = (256, 1.1, 1.3);
/// Fits of the modes are those of runs to these tolerances, in digits.
const FITS: std::ops::RangeInclusive<i32> = 5..=11;

fn scenario((_, alpha, kick): (&str, f64, f64), memory: MemoryChoice, tolerance: f64) -> Scenario {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let model = Model::new(tip, alpha, case::R).expect("a valid model");
    Scenario { kick, memory, tolerance, ..Scenario::new(model, case::UNTIL) }
}

/// l at times about a half apart.
fn sampled(trajectory: &Trajectory) -> Vec<(f64, f64)> {
    let (start, end) = (trajectory.start(), trajectory.end());
    let count = (2.0 * (end - start)) as u32;
    let at = |i: u32| (start + (end - start) * f64::from(i) / f64::from(count)).min(end);
    (0..=count).map(|i| (at(i), trajectory.l(at(i)))).collect()
}

/// For solvers in other languages: motions with their references, and the exponentials.
pub(crate) fn document() -> Value {
    let motion = |motion: (&'static str, f64, f64)| {
        let reference = |memory| {
            sampled(&run(&scenario(motion, memory, 1e-13)).expect("a run that ends").trajectory)
        };
        let [points, others] = [MemoryChoice::Direct, MemoryChoice::Fft].map(reference);
        let differences = points.iter().zip(&others).map(|(a, b)| (a.1 - b.1).abs());
        let scenario = scenario(motion, MemoryChoice::Modes, 1e-9);
        let (t, l): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        json!({
            "name": motion.0, "alpha": motion.1, "kick": motion.2, "r": case::R,
            "start": t[0], "until": case::UNTIL, "l0": scenario.model.steady_l(),
            "checked_to": differences.fold(0.0, f64::max), "t": t, "l": l,
        })
    };
    let fit = |digits: i32| {
        let model = scenario(MOTIONS[1], MemoryChoice::Modes, 1e-9).model;
        let accuracy = accuracy_needed(&model, 10.0_f64.powi(-digits));
        let fit =
            Fit::cached(model.tip(), accuracy, Retreat::Small).expect("a footprint that modes fit");
        let term = |t: &stickslip_tip::memory::Term| {
            [t.exponent.re, t.exponent.im, t.weight.re, t.weight.im]
        };
        let terms: Vec<_> = fit.terms().iter().map(term).collect();
        json!({"digits": digits, "error": fit.certificate().slope, "terms": terms})
    };
    let (count, from, to) = ENSEMBLE;
    json!({
        "motions": MOTIONS.map(motion), "fits": FITS.map(fit).collect::<Vec<_>>(),
        "ensemble": {
            "motion": MOTIONS[1].0, "count": count, "from": from, "to": to,
            "l_at_end": ends(&ensemble(MemoryChoice::Fft, 1e-13)),
        },
    })
}

/// The motions of the ensemble.
fn ensemble(memory: MemoryChoice, tolerance: f64) -> Vec<Scenario> {
    let (count, from, to) = ENSEMBLE;
    let alpha = |i: usize| from + (to - from) * i as f64 / (count - 1) as f64;
    (0..count)
        .map(|i| scenario((MOTIONS[1].0, alpha(i), MOTIONS[1].2), memory, tolerance))
        .collect()
}

/// l where each ends.
fn ends(motions: &[Scenario]) -> Vec<f64> {
    let end = |motion: &Scenario| {
        let trajectory = run(motion).expect("a run that ends").trajectory;
        trajectory.l(trajectory.end())
    };
    motions.iter().map(end).collect()
}

/// l where each of several motions ends.
type Ends = fn(&[Scenario]) -> Vec<f64>;

/// The last step of a motion.
#[derive(Default)]
struct Last(Option<Step>);

impl Extend<Step> for Last {
    fn extend<I: IntoIterator<Item = Step>>(&mut self, steps: I) {
        self.0 = steps.into_iter().last().or(self.0);
    }
}

/// The same, of motions integrated side by side in the lanes of the machine.
fn ends_side_by_side(motions: &[Scenario]) -> Vec<f64> {
    let mut ends = vec![f64::NAN; motions.len()];
    collect_each(
        motions,
        |_| Last::default(),
        |i, motion| {
            let motion = motion.expect("a run that ends");
            assert!(motion.side_by_side, "motion {i} went alone");
            let last = motion.trajectory.0.expect("a run has steps");
            ends[i] = last.l(case::R, last.end());
        },
    );
    ends
}

/// Time and error of ours: each motion to a ladder of tolerances, and the ensemble, one after the other and side by
/// side, judged where each motion ends.
pub(crate) fn rows() -> Vec<Value> {
    let mut rows = vec![];
    for motion in MOTIONS {
        let reference = run(&scenario(motion, MemoryChoice::Direct, 1e-13)).expect("a run");
        let points = sampled(&reference.trajectory);
        for i in 0..=30 {
            let digits = 4.0 + 0.25 * f64::from(i);
            let scenario = scenario(motion, MemoryChoice::Modes, 10.0_f64.powf(-digits));
            let (found, seconds) = timed(|| run(&scenario).expect("a run that ends"));
            let misses = points.iter().map(|(t, l)| (found.trajectory.l(*t) - l).abs());
            let error = misses.fold(0.0, f64::max);
            eprintln!("{}, 1e-{digits}: {seconds:.3e} s, error {error:.1e}", motion.0);
            rows.push(json!({
                "contestant": "stickslip", "motion": motion.0, "setting": format!("tolerance 1e-{digits}"),
                "seconds": seconds, "error": error,
            }));
        }
    }
    let reference = ends(&ensemble(MemoryChoice::Fft, 1e-13));
    let ways: [(&str, Ends); 2] = [("one by one", ends), ("side by side", ends_side_by_side)];
    for (way, ends) in ways {
        for quarters in 20..=44 {
            let digits = 0.25 * f64::from(quarters);
            let all = ensemble(MemoryChoice::Modes, 10.0_f64.powf(-digits));
            let (found, seconds) = timed(|| ends(&all));
            let misses = found.iter().zip(&reference).map(|(l, right)| (l - right).abs());
            let error = misses.fold(0.0, f64::max);
            eprintln!("ensemble, {way}, 1e-{digits}: {seconds:.3e} s, error {error:.1e}");
            rows.push(json!({
                "contestant": "stickslip", "motion": format!("ensemble, {way}"),
                "setting": format!("tolerance 1e-{digits}"), "seconds": seconds, "error": error,
            }));
        }
    }
    rows
}
