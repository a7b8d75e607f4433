//! Does a run say what a run ten times as long says? Random runs near onset, near period doublings, near trapping and
//! between, over tips of one to three peaks: no period and no amplitude outside of its error, no regime that the longer
//! run contradicts. `make judge` runs them all; CASES and SEED set how many and which.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::time::Instant;
use stickslip_cycles::{Cycle, cycle};
use stickslip_outcome::{Oscillation, Outcome, Regime, judge_trajectory};
use stickslip_stability::{critical, trapping_alpha};
use stickslip_tip::{Gaussian, Model, Scenario, TipFunction, Wider, run};

/// Where a run is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Onset,
    Doubling,
    Trapping,
    Between,
}

struct Random(ChaCha8Rng);

impl Random {
    fn even(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// Evenly over the decades.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.even(low.ln(), high.ln()).exp()
    }

    fn sign(&mut self) -> f64 {
        if self.0.random_range(0..2) == 0 { -1.0 } else { 1.0 }
    }
}

/// Of one to three peaks.
fn tip(random: &mut Random) -> TipFunction {
    let kind = random.0.random_range(0..4);
    let gaussian = |amplitude, center, width| Gaussian { amplitude, center, width };
    match kind {
        0 => TipFunction::gaussian(random.decades(0.5, 2.0)).unwrap(),
        1 | 2 => {
            let beta = [0.0, 0.3, 0.5, 0.8, 1.0, 1.2][random.0.random_range(0..6)];
            TipFunction::triple_gaussian(beta, 1.0).unwrap()
        }
        _ => {
            let (a, c) = (random.even(-0.5, 1.2), random.even(1.0, 3.0));
            let w = random.even(0.4, 1.0);
            let terms = vec![gaussian(1.0, 0.0, 1.0), gaussian(a, c, w), gaussian(a, -c, w)];
            TipFunction::gaussian_sum(terms).unwrap()
        }
    }
}

/// A run near something; `None` where the tip has no such place.
fn scenario(random: &mut Random, place: Place) -> Option<Scenario> {
    let distance = random.decades(1e-5, 1e-1) * random.sign();
    let (tip, r, alpha) = match place {
        Place::Onset => {
            let (tip, r) = (tip(random), random.decades(0.2, 5.0));
            let alpha = critical(&Wider::default(), &tip, r).ok()?.alpha * (1.0 + distance);
            (tip, r, alpha)
        }
        Place::Doubling => {
            let at = [1.5045, 1.7896][random.0.random_range(0..2)];
            (TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.0, at + 0.1 * distance)
        }
        Place::Trapping => {
            let (tip, r) = (tip(random), random.decades(0.2, 5.0));
            let alpha = trapping_alpha(&tip, r).ok()? * (1.0 + distance);
            (tip, r, alpha)
        }
        Place::Between => {
            let (tip, r) = (tip(random), random.decades(0.2, 5.0));
            let (onset, trapping) =
                (critical(&Wider::default(), &tip, r).ok()?.alpha, trapping_alpha(&tip, r).ok()?);
            let alpha = onset + random.even(0.0, 1.3) * (trapping - onset).abs();
            (tip, r, alpha)
        }
    };
    let kick = if random.0.random_range(0..6) == 0 { 0.0 } else { random.decades(1e-4, 0.7) };
    let mut scenario = Scenario::new(Model::new(tip, alpha, r).ok()?, 0.0);
    scenario.kick = kick * random.sign();
    scenario.tolerance = random.decades(1e-12, 1e-2);
    scenario.until = scenario.start_time() + random.decades(30.0, 1500.0);
    Some(scenario)
}

fn outcome(scenario: &Scenario) -> (Outcome, f64) {
    let run = run(scenario).unwrap();
    let started = Instant::now();
    let outcome = judge_trajectory(scenario, &run.initial_surface, &run.trajectory);
    (outcome, started.elapsed().as_secs_f64())
}

/// How far two figures are apart, in their errors.
fn apart(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 - b.0).abs() / (a.1 + b.1)
}

/// What is wrong with an oscillation beside the cycle that is found from nothing, if that is the same one.
fn beside_cycle(found: &Oscillation, cycle: &Cycle) -> Option<String> {
    let error = cycle.error();
    let same = cycle.is_stable()
        && cycle.slips() == found.slips
        && (cycle.period() / found.period - 1.0).abs() < 0.05
        && (cycle.amplitude_x0() / found.amplitude_x0 - 1.0).abs() < 0.3;
    let period = apart((found.period, found.period_error), (cycle.period(), error));
    let amplitude =
        apart((found.amplitude_x0, found.amplitude_x0_error), (cycle.amplitude_x0(), error));
    (same && period.max(amplitude) > 1.0)
        .then(|| format!("cycle: period off {period:.2}, amplitude off {amplitude:.2} errors"))
}

/// What the run ten times as long contradicts.
fn contradicted(short: &Outcome, long: &Outcome, further: f64) -> Option<String> {
    let said = |what: &str| {
        Some(format!("{what}: {:?} {:?} {:?}", long.regime, long.prospect, long.remarks))
    };
    match (short.regime, long.regime) {
        (Regime::StickSlip, Regime::StickSlip) => {
            let (a, b) = (short.oscillation.as_ref()?, long.oscillation.as_ref()?);
            let period = apart((a.period, a.period_error), (b.period, b.period_error));
            let amplitude = apart(
                (a.amplitude_x0, a.amplitude_x0_error),
                (b.amplitude_x0, b.amplitude_x0_error),
            );
            let off = period.max(amplitude) > 1.0 || a.slips != b.slips;
            off.then(|| {
                format!(
                    "slips {} {}, period {period:.2}, amplitude {amplitude:.2} errors apart",
                    a.slips, b.slips
                )
            })
        }
        (Regime::Transient, regime) => {
            let prospect = short.prospect?;
            let (towards, time) = (prospect.towards?, prospect.time?);
            if regime != Regime::Transient && regime != towards {
                return said("PROSPECT elsewhere");
            }
            (further > 2.0 * time + 100.0 && regime != towards)
                .then(|| said(&format!("PROSPECT {towards:?} in {time:.1e} late")))
                .flatten()
        }
        (a, b) if a == b => None,
        _ => said("regime"),
    }
}

#[test]
#[ignore = "minutes"]
fn no_run_is_contradicted_by_one_ten_times_as_long() {
    let number = |name: &str, default: u64| {
        std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    let (cases, seed) = (number("CASES", 1000), number("SEED", 1));
    let places = [Place::Onset, Place::Onset, Place::Doubling, Place::Trapping, Place::Between];
    let (mut wrong, mut late, mut slowest, mut spent) = (0, 0, 0.0_f64, 0.0);
    let mut regimes = std::collections::BTreeMap::new();
    for case in number("FROM", 0)..cases {
        let mut random = Random(ChaCha8Rng::seed_from_u64(1000 * seed + case));
        let place = places[(case % places.len() as u64) as usize];
        let Some(scenario) = scenario(&mut random, place) else { continue };
        let (short, seconds) = outcome(&scenario);
        (slowest, spent) = (slowest.max(seconds), spent + seconds);
        if std::env::var("TELL").is_ok() {
            let Scenario { model, kick, tolerance, .. } = &scenario;
            println!(
                "{case} {place:?} {:?} {:?} {:.1} ms, α = {}, r = {}, kick {kick:.1e}, tolerance {tolerance:.1e}, length {:.0} {:?} {:?}",
                short.regime,
                short.prospect.map(|p| (p.towards, p.time)),
                1e3 * seconds,
                model.alpha(),
                model.r(),
                scenario.until - scenario.start_time(),
                short.oscillation.as_ref().map(|o| (
                    o.period,
                    o.period_error,
                    o.amplitude_x0,
                    o.amplitude_x0_error,
                    o.slips
                )),
                short.remarks
            );
        }
        *regimes.entry(format!("{place:?} {:?}", short.regime)).or_insert(0) += 1;
        let length = scenario.until - scenario.start_time();
        let until = scenario.start_time() + 10.0 * length;
        let (long, _) = outcome(&Scenario { until, ..scenario.clone() });
        let by_cycle = short
            .oscillation
            .as_ref()
            .and_then(|o| beside_cycle(o, &cycle(&scenario.model, 1e-11).ok()?));
        for problem in contradicted(&short, &long, 9.0 * length).into_iter().chain(by_cycle) {
            if problem.starts_with("PROSPECT") {
                late += 1
            } else {
                wrong += 1
            }
            let Scenario { model, kick, tolerance, .. } = &scenario;
            println!(
                "case {case} {place:?}: {:?} {:?} {:?} by {problem}\n    α = {}, r = {}, kick {kick:.2e}, tolerance {tolerance:.1e}, length {length:.0}, {:?}\n    {:?}",
                short.regime,
                short.prospect,
                short.oscillation.as_ref().map(|o| (
                    o.period,
                    o.period_error,
                    o.amplitude_x0,
                    o.amplitude_x0_error,
                    o.slips
                )),
                model.alpha(),
                model.r(),
                model.tip(),
                short.remarks,
            );
        }
    }
    println!("{regimes:#?}");
    println!(
        "{cases} cases: {wrong} wrong, {late} prospects missed; judged in {:.1} ms, at most {:.1} ms",
        1e3 * spent / cases as f64,
        1e3 * slowest
    );
    assert_eq!(wrong, 0);
}
