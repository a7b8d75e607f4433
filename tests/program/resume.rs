//! Does a run that was saved and cannot be used again go on as if nothing had happened? Judged by the same run
//! in one go, to the last bit: nothing is allowed to differ, so nothing is compared by a tolerance.

use stickslip_outcome::{Classified, Watched};
use stickslip_tip::state::{Damaged, State};
use stickslip_tip::{
    Force, MemoryChoice, Model, Noise, Pulse, RunError, STEP_NUMBERS, Scenario, Start, Step,
    SupportPath, TipFunction, Wider,
};

fn triple(alpha: f64) -> Model {
    Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), alpha, 1.0).unwrap()
}

/// Motions that bring every part of a state into play: slips, a groove that deepens, knots of noise and
/// profile, forces that jump, retreats beyond what the modes hold, a window that grows.
fn cases() -> Vec<(&'static str, Scenario)> {
    let pulse = |amplitude, time| Pulse { amplitude, time, width: 0.5 };
    let table = (vec![20.0, 26.0, 33.0, 40.0], vec![0.3, 0.1, 0.4, 0.2]);
    let force = Force::new(vec![pulse(-8.0, 25.0), pulse(3.0, 33.0)], Some(table)).unwrap();
    let x: Vec<f64> = (0..=40).map(|i| 18.0 + 0.2 * f64::from(i)).collect();
    let u = x.iter().map(|x| 0.3 * (-(x - 22.0_f64).powi(2)).exp()).collect();
    let noise = Some(Noise { amplitude: 1e-3, spacing: 0.2, seed: 5 });
    let bessel = Model::new(TipFunction::Bessel, 1.1, 1.0).unwrap();
    let wider =
        |b, time, mass| Wider { depth_limit: b, healing_time: time, inertia: mass, spring: true };
    let under = |law, alpha| {
        Model::under(law, TipFunction::triple_gaussian(1.0, 1.0).unwrap(), alpha, 1.0).unwrap()
    };
    let path = SupportPath::new(vec![0.0, 20.0, 30.0, 60.0], vec![0.0, 24.0, 24.0, -3.0]).unwrap();
    let run = Scenario::new;
    vec![
        (
            "depth limit",
            Scenario { kick: 0.05, ..run(under(wider(Some(5.0), None, None), 1.3), 200.0) },
        ),
        ("healing", Scenario { kick: 0.05, ..run(under(wider(None, Some(0.2), None), 9.0), 90.0) }),
        (
            "path",
            Scenario {
                path: Some(path),
                ..run(under(wider(Some(3.0), Some(9.0), Some(0.2)), 2.0), 60.0)
            },
        ),
        ("stick-slip", Scenario { kick: 0.05, ..run(triple(1.2), 900.0) }),
        ("flat start", Scenario { start: Start::Flat, ..run(triple(0.8), 80.0) }),
        ("trapped", Scenario { kick: 0.01, ..run(triple(4.0), 3000.0) }),
        ("noise and profile", Scenario { noise, profile: Some((x, u)), ..run(triple(1.1), 50.0) }),
        ("forces", Scenario { force, ..run(triple(0.9), 60.0) }),
        ("bessel", Scenario { kick: 0.05, ..run(bessel, 90.0) }),
    ]
}

const MEMORIES: [MemoryChoice; 4] =
    [MemoryChoice::Auto, MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes];

/// All that a run gives: its steps, counts, what became of it and why its memory.
#[derive(Debug, PartialEq)]
struct Told(Vec<[u64; STEP_NUMBERS]>, String);

fn bits(step: &Step) -> [u64; STEP_NUMBERS] {
    step.numbers().map(f64::to_bits)
}

fn finish(mut running: Watched, mut steps: Vec<[u64; STEP_NUMBERS]>) -> Told {
    while let Some(step) = running.step().unwrap() {
        steps.push(bits(&step));
    }
    let (outcome, made) = (running.outcome(), running.running());
    let (work, memory, why) = (made.work(), made.memory(), made.memory_reason());
    Told(steps, format!("{outcome:?} {work:?} {memory} {why}"))
}

/// The run, saved after so many steps and cannot be used by another that knows only the words.
fn broken_at(scenario: &Scenario, at: &[usize]) -> Told {
    let surface = scenario.initial_surface().unwrap();
    let mut running = Watched::new(scenario, &surface).unwrap();
    let mut steps = vec![];
    for &at in at {
        while steps.len() < at {
            steps.push(bits(&running.step().unwrap().unwrap()));
        }
        let words = running.save().words().to_vec();
        drop(running);
        running = Watched::resumed(scenario, &surface, &State::from_words(words)).unwrap();
    }
    finish(running, steps)
}

#[test]
fn every_memory_goes_on_to_the_last_bit() {
    for (name, scenario) in cases() {
        for memory in MEMORIES {
            let scenario = Scenario { memory, ..scenario.clone() };
            let surface = scenario.initial_surface().unwrap();
            let running = match Watched::new(&scenario, &surface) {
                Err(RunError::Modes(_)) => continue,
                other => other.unwrap(),
            };
            let whole = finish(running, vec![]);
            let n = whole.0.len();
            println!("{name}, {memory:?}: {n} steps, {}", whole.1);
            let places = [vec![0, 1, n / 7, n / 3, n / 2, n - 1, n], vec![n / 5]];
            for at in places {
                assert!(broken_at(&scenario, &at) == whole, "{name}, {memory:?}, broken at {at:?}");
            }
        }
    }
}

/// What a run keeps, in words of its state, is bounded: on slips, on a tip that creeps indefinitely, and on one
/// that does nothing at all. (crates/tip/tests/tip/fft_bounded.rs has the same of the density of `fft`.)
#[test]
fn what_a_run_keeps_does_not_grow() {
    for (alpha, kick) in [(1.2, 0.05), (4.0, 0.01), (0.8, 0.0)] {
        let memory = MemoryChoice::Modes;
        let scenario = Scenario { kick, memory, ..Scenario::new(triple(alpha), 12_000.0) };
        let surface = scenario.initial_surface().unwrap();
        let mut running = Watched::new(&scenario, &surface).unwrap();
        // By then the record of the modes has its full length.
        let (mut early, mut late) = (0, 0);
        let mut steps: u32 = 0;
        while running.step().unwrap().is_some() {
            steps += 1;
            if steps.is_multiple_of(100) || steps < 100 {
                let largest = if running.t() < 9000.0 { &mut early } else { &mut late };
                *largest = running.save().words().len().max(*largest);
            }
        }
        println!("α = {alpha}: {early} words, then {late}, after {steps} steps");
        // A trapped tip makes a few steps more in each decade of time.
        assert!(late as f64 <= 1.02 * early as f64 + 1000.0, "α = {alpha}");
    }
}

/// Negative control: whatever word of a state is changed, either it is refused or the run differs; but for
/// what no longer matters, such as cells far behind the tip.
#[test]
fn a_state_that_is_not_the_same_is_noticed() {
    let scenario = Scenario { kick: 0.05, ..Scenario::new(triple(1.2), 40.0) };
    let surface = scenario.initial_surface().unwrap();
    for memory in MEMORIES {
        let scenario = Scenario { memory, ..scenario.clone() };
        let whole = finish(Watched::new(&scenario, &surface).unwrap(), vec![]);
        let mut running = Watched::new(&scenario, &surface).unwrap();
        let steps: Vec<_> = (0..20).map(|_| bits(&running.step().unwrap().unwrap())).collect();
        let words = running.save().words().to_vec();
        let noticed = |i: &usize| {
            let mut words = words.clone();
            words[*i] ^= 1 << 45;
            match Watched::resumed(&scenario, &surface, &State::from_words(words)) {
                Err(RunError::State(_)) => true,
                Ok(other) => finish(other, steps.clone()) != whole,
                Err(other) => panic!("{other}"),
            }
        };
        // t and extension; and velocity, which steps by series work out anew.
        let carried = if running.running().work().series > 0 { 2 } else { 3 };
        assert!((0..carried).all(|i| noticed(&i)), "{memory:?}");
        let tried = || (0..words.len().min(400)).step_by(3);
        let seen = tried().filter(noticed).count();
        println!("{memory:?}: {seen} of {} words matter", tried().count());
        assert!(seen > 20);
    }
}

#[test]
fn a_state_of_something_else_is_refused() {
    let scenario = Scenario { kick: 0.05, ..Scenario::new(triple(1.2), 40.0) };
    let surface = scenario.initial_surface().unwrap();
    let with = |memory, tolerance| Scenario { memory, tolerance, ..scenario.clone() };
    let saved = |scenario: &Scenario| {
        let mut running = Watched::new(scenario, &surface).unwrap();
        assert!((0..30).all(|_| running.step().unwrap().is_some()));
        running.save().words().to_vec()
    };
    let refused = |scenario: &Scenario, words: &[u64]| {
        let state = State::from_words(words.to_vec());
        match Watched::resumed(scenario, &surface, &state) {
            Err(RunError::State(why)) => why,
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("cannot be used"),
        }
    };
    let modes = with(MemoryChoice::Modes, 1e-9);
    let words = saved(&modes);
    let why = refused(&with(MemoryChoice::Modes, 1e-6), &words);
    assert_eq!(why, Damaged::Other("fit of f' by exponentials"));
    refused(&with(MemoryChoice::Direct, 1e-9), &words);
    refused(&with(MemoryChoice::Fft, 1e-9), &words);
    for length in 0..words.len() {
        assert_eq!(refused(&modes, &words[..length]), Damaged::Short, "{length} words");
    }
    let longer = [&words[..], &[0]].concat();
    assert_eq!(refused(&modes, &longer), Damaged::Long(1));
    // A length that would take all of the machine's memory.
    let mut huge = words.clone();
    huge[6] = u64::MAX;
    assert_eq!(refused(&modes, &huge), Damaged::Short);
}
