//! Tips as users bring them: tables of 8 to 2,000 rows, lobes from 0.05 to 3 widths, several peaks. Whatever a
//! run settles on, the cycle is found, or there is a reason; nothing panics.

use crate::tips::tips;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use stickslip_cycles::{Cycle, CycleError, DEFAULT_TOLERANCE, cycle};
use stickslip_stability::critical;
use stickslip_tip::motion::{Oscillation, latest_extrema};
use stickslip_tip::{Model, Scenario, run};

/// Of these α/αc, one each.
const ABOVE: [f64; 4] = [1.003, 1.03, 1.1, 1.4];

#[derive(Default)]
struct Count {
    tips: usize,
    cycles: usize,
    reasons: Vec<String>,
    panics: Vec<String>,
    missed: Vec<String>,
    wrong: Vec<String>,
    slowest: Duration,
}

#[test]
#[ignore = "minutes"]
fn a_cycle_is_found_wherever_a_run_settles_on_one() {
    let number = |name: &str, otherwise: usize| {
        std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(otherwise)
    };
    let (from, tips_asked) = (number("FROM", 0), number("TIPS", 400));
    let mut count = Count::default();
    for (i, (kind, tip)) in tips(from + tips_asked).into_iter().enumerate().skip(from) {
        let Ok(onset) = critical(&tip, 1.0) else {
            println!("{i:3} {kind:?}: no onset");
            continue;
        };
        count.tips += 1;
        let alpha = ABOVE[i % ABOVE.len()] * onset.alpha;
        let started = Instant::now();
        let model = Model::new(tip, alpha, 1.0).unwrap();
        let found = catch_unwind(AssertUnwindSafe(|| cycle(&model, DEFAULT_TOLERANCE)));
        let took = started.elapsed();
        count.slowest = count.slowest.max(took);
        let said = judge(&mut count, &model, found.map_err(drop));
        println!("{i:3} {kind:?} at {:.3} αc, {took:.2?}: {said}", alpha / onset.alpha);
    }
    let Count { tips, cycles, reasons, panics, missed, wrong, slowest } = count;
    println!("{tips} tips, {cycles} cycles, {} reasons, slowest {slowest:.1?}", reasons.len());
    for list in [&panics, &missed, &wrong] {
        list.iter().for_each(|line| println!("    {line}"));
    }
    assert!(panics.is_empty() && missed.is_empty() && wrong.is_empty());
}

type Found = Result<Result<Cycle, CycleError>, ()>;

fn judge(count: &mut Count, model: &Model, found: Found) -> String {
    match found {
        Err(()) => {
            count.panics.push(format!("{model:?}").chars().take(200).collect());
            "PANIC".into()
        }
        Ok(Ok(cycle)) => {
            count.cycles += 1;
            let off = cycle.multipliers().iter().map(|m| (m - 1.0).norm()).fold(1.0, f64::min);
            let said = format!(
                "T {:.6}, amplitude {:.6}, stable {}, {} slips, off one by {off:.1e}, {} steps",
                cycle.period(),
                cycle.amplitude_x0(),
                cycle.is_stable(),
                cycle.slips(),
                cycle.steps()
            );
            if off > 1e-4 || cycle.amplitude_x0() < 1e-6 {
                count.wrong.push(said.clone());
                return format!("WRONG {said}");
            }
            said
        }
        Ok(Err(error)) => {
            let mut scenario = Scenario::new(model.clone(), 6000.0);
            scenario.kick = 0.3;
            scenario.tolerance = 1e-7;
            let ended = run(&scenario);
            let repeats = |motion| Oscillation::of(motion, &latest_extrema(motion));
            let settles = ended.as_ref().ok().and_then(|run| repeats(&run.trajectory));
            let ended = ended.map_or_else(|error| error.to_string(), |_| format!("{settles:?}"));
            let said = format!("{error} [a run: {ended}]");
            let settles = settles.is_some_and(|motion| motion.drift < 1e-6);
            if settles {
                count.missed.push(said.clone());
                return format!("MISSED {said}");
            }
            count.reasons.push(said.clone());
            said
        }
    }
}
