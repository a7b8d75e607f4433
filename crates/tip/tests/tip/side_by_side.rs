//! Runs side by side: what they have to do with each other (nothing), and with runs one by one (the motion).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use stickslip_tip::{
    Force, MemoryChoice, Model, Noise, Pulse, Run, Scenario, Start, TipFunction, Wider, run,
    run_each, run_many, stop,
};

fn scenario(alpha: f64, until: f64, tolerance: f64) -> Scenario {
    let model = Model::new(TipFunction::default(), alpha, 1.0).unwrap();
    Scenario { kick: 0.05, tolerance, ..Scenario::new(model, until) }
}

/// All numbers of all steps.
fn bits(run: &Run) -> Vec<u64> {
    let numbers = run.trajectory.steps().iter().flat_map(|step| step.numbers());
    numbers.map(f64::to_bits).collect()
}

fn alone(scenario: &Scenario) -> Run {
    let [run] = run_many(std::slice::from_ref(scenario)).try_into().unwrap();
    run.unwrap()
}

/// Motions that differ in everything that may differ.
fn various() -> Vec<Scenario> {
    let mut scenarios = vec![];
    for i in 0..21 {
        let part = f64::from(i) / 20.0;
        let mut one = scenario(0.3 + 1.4 * part, 25.0 + 40.0 * (7.0 * part).sin().abs(), 1e-6);
        one.kick = 0.2 * (part - 0.5);
        one.model =
            Model::new(TipFunction::default(), one.model.alpha(), 0.8 + 0.4 * part).unwrap();
        one.start = if i % 3 == 0 { Start::Flat } else { Start::Steady };
        one.start_position = 14.0 + part;
        scenarios.push(one);
    }
    scenarios
}

#[test]
fn a_run_is_the_same_to_the_last_bit_in_any_company_and_order() {
    let scenarios = various();
    let together = run_many(&scenarios);
    let order: Vec<usize> = (0..scenarios.len()).map(|i| (8 * i + 5) % scenarios.len()).collect();
    let shuffled: Vec<_> = order.iter().map(|i| scenarios[*i].clone()).collect();
    let shuffled = run_many(&shuffled);
    let mut beside = 0;
    for (i, one) in scenarios.iter().enumerate() {
        let run = together[i].as_ref().unwrap();
        let again = shuffled[order.iter().position(|k| *k == i).unwrap()].as_ref().unwrap();
        assert!(bits(run) == bits(again) && bits(run) == bits(&alone(one)), "{i}");
        assert_eq!((run.work, again.work), (again.work, alone(one).work));
        assert_eq!(run.trajectory.start().to_bits(), one.start_time().to_bits());
        assert_eq!(run.trajectory.end().to_bits(), one.until.to_bits());
        beside += usize::from(run.side_by_side);
    }
    assert!(beside > 15, "{beside}");
}

/// Errors against runs to 1e-12, made one by one: on the whole no larger than those of runs one by one to the same
/// tolerance. Measured: 0.11 to 0.83 of them from 1e-4 to 1e-11.
#[test]
fn errors_are_no_larger_than_those_of_runs_one_by_one() {
    let alphas: Vec<f64> = (0..12).map(|i| 0.5 + 0.08 * f64::from(i)).collect();
    let until = 100.0;
    let fine: Vec<Run> = alphas.iter().map(|a| run(&scenario(*a, until, 1e-12)).unwrap()).collect();
    let off = |a: &Run, b: &Run| {
        let times = (0..=300).map(|i| a.trajectory.start() + f64::from(i) / 300.0 * 80.0);
        times.map(|t| (a.trajectory.l(t) - b.trajectory.l(t)).abs()).fold(0.0, f64::max)
    };
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let scenarios: Vec<_> = alphas.iter().map(|a| scenario(*a, until, tolerance)).collect();
        let (mut ratios, mut worst) = (0.0, 0.0_f64);
        for ((one, fine), beside) in scenarios.iter().zip(&fine).zip(run_many(&scenarios)) {
            let beside = beside.unwrap();
            assert!(beside.side_by_side && beside.work.newton_iterations == 0);
            let (error, of_one) = (off(&beside, fine), off(&run(one).unwrap(), fine));
            assert!(error < 3.0 * of_one, "{tolerance:e} α = {}: {error:e}", one.model.alpha());
            ratios += (error / of_one).ln();
            worst = worst.max(error);
        }
        let mean = (ratios / alphas.len() as f64).exp();
        println!("{tolerance:e}: {mean:.2} of the errors one by one, at most {worst:.1e}");
        assert!(mean < 1.0 && worst < 40.0 * tolerance);
    }
}

/// Footprints that ask for sums of their own.
#[test]
fn other_footprints_and_starts_move_as_they_do_one_by_one() {
    let tips = [
        TipFunction::gaussian(0.8).unwrap(),
        TipFunction::triple_gaussian(0.5, 1.2).unwrap(),
        TipFunction::default(),
    ];
    let mut scenarios = vec![];
    for (i, tip) in tips.iter().cycle().take(9).enumerate() {
        let model = Model::new(tip.clone(), 0.6 + 0.1 * i as f64, 1.1).unwrap();
        let start = if i < 5 { Start::Flat } else { Start::Steady };
        let memory = if i < 3 { MemoryChoice::Modes } else { MemoryChoice::Auto };
        scenarios.push(Scenario { start, memory, tolerance: 1e-8, ..Scenario::new(model, 60.0) });
    }
    for (one, beside) in scenarios.iter().zip(run_many(&scenarios)) {
        let (single, beside) = (run(one).unwrap(), beside.unwrap());
        assert!(beside.side_by_side && beside.memory == "modes");
        assert!(beside.memory_reason.starts_with("side by side"), "{}", beside.memory_reason);
        for i in 0..=200 {
            let t = one.start_time() + f64::from(i) / 200.0 * (60.0 - one.start_time());
            let off = (single.trajectory.l(t) - beside.trajectory.l(t)).abs();
            assert!(off < 1e-6, "{:?} at {t}: {off:e}", one.start);
        }
    }
}

/// What is not made side by side is what `run` makes, to the last bit; what is refused is refused alike.
#[test]
fn whatever_does_not_go_side_by_side_is_made_one_by_one() {
    let plain = || scenario(1.2, 40.0, 1e-6);
    let under = |wider| Model::under(wider, TipFunction::default(), 1.2, 1.0).unwrap();
    let limited = Wider { depth_limit: Some(5.0), ..Wider::default() };
    let noise = Noise { amplitude: 1e-3, spacing: 0.5, seed: 1 };
    let pulse = Pulse { amplitude: 0.1, time: 20.0, width: 1.0 };
    let others = [
        // Stuck for ever, with a groove too stiff for series.
        scenario(4.0, 3000.0, 1e-6),
        // Beyond what the exponentials hold behind the farthest point.
        Scenario { kick: 3.0, ..plain() },
        Scenario { memory: MemoryChoice::Fft, ..plain() },
        Scenario { memory: MemoryChoice::Direct, ..plain() },
        Scenario { noise: Some(noise), ..plain() },
        Scenario { force: Force::default().with_pulse(pulse), ..plain() },
        Scenario { model: under(limited), ..plain() },
        Scenario::new(Model::new(TipFunction::Bessel, 0.5, 1.0).unwrap(), 40.0),
    ];
    let refused = [Scenario { until: -5.0, ..plain() }, Scenario { tolerance: 1.0, ..plain() }];
    let mut scenarios: Vec<_> = others.iter().chain(&refused).cloned().collect();
    scenarios.insert(4, plain());
    let runs = run_many(&scenarios);
    for (i, (one, many)) in scenarios.iter().zip(runs).enumerate() {
        match (run(one), many) {
            (Ok(single), Ok(many)) if i == 4 => {
                assert!(many.side_by_side && !single.side_by_side);
            }
            (Ok(single), Ok(many)) => {
                assert_eq!(single.work, many.work, "{i}");
                assert!(!many.side_by_side, "{i}");
                assert!(bits(&single) == bits(&many), "{i}");
            }
            (single, many) => {
                assert_eq!(single.err().map(|e| e.to_string()), many.err().map(|e| e.to_string()));
            }
        }
    }
}

#[test]
fn once_nobody_waits_each_run_ends_at_its_first_step() {
    let scenarios: Vec<_> =
        (0..10).map(|i| scenario(1.0 + 0.02 * f64::from(i), 1e4, 1e-6)).collect();
    let flag = Arc::new(AtomicBool::new(true));
    let mut told = 0;
    stop::with_flag(&flag, || {
        run_each(&scenarios, |_, run| {
            let run = run.unwrap();
            assert!(run.interrupted && run.trajectory.steps().len() == 1);
            told += 1;
        });
    });
    assert_eq!(told, scenarios.len());
}

/// The bits of a run side by side, made with AVX-512, with AVX2 and with SSE3.
#[test]
fn the_bits_are_those_of_every_machine() {
    let run = alone(&scenario(1.3, 60.0, 1e-9));
    // FNV-1a
    let fingerprint = bits(&run)
        .into_iter()
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
            (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    assert_eq!(format!("{fingerprint:#x}"), format!("{FINGERPRINT:#x}"));
}

const FINGERPRINT: u64 = 0xc324_9f4d_e746_8d9b;
