//! Is the tolerance asked for honoured, and not paid for twice? Judged by a run of the same integrator
//! at 1e-13 with the `direct` memory; tests/science/convergence.rs and tests/science/regimes.rs tie that to the outside.

use crate::acceptance::{Acceptance, largest_difference};
use stickslip_tip::{MemoryChoice, Model, Run, Scenario, TipFunction, run};

/// Errors add up and are amplified by the slips; 5e-13 is what round-off makes of the reference itself,
/// whose l is as large as 1000 where the tip is trapped.
const LADDER: Acceptance = Acceptance { floor: 5e-13, slack: 10.0 };

/// (name, β, α, kick, duration): onset, stick-slip, a doubled period, two trapped tips.
const CASES: [(&str, f64, f64, f64, f64); 5] = [
    ("onset", 1.0, 1.079_036_174_947, 0.01, 442.0),
    ("stick-slip", 1.0, 1.2, 0.05, 60.0),
    ("period-doubled", 1.0, 1.62, 0.05, 60.0),
    ("trapped", 0.0, 3.0, 0.01, 1000.0),
    ("trapped fast", 1.0, 4.0, 0.01, 1000.0),
];

fn case(name: &str, tolerance: f64, memory: MemoryChoice) -> Run {
    let (_, beta, alpha, kick, duration) = CASES.into_iter().find(|case| case.0 == name).unwrap();
    let model = Model::new(TipFunction::triple_gaussian(beta, 1.0).unwrap(), alpha, 1.0).unwrap();
    let start = 14.0 + model.steady_lag();
    let scenario = Scenario { kick, tolerance, memory, ..Scenario::new(model, start + duration) };
    run(&scenario).unwrap()
}

fn stick_slip(tolerance: f64, memory: MemoryChoice) -> Run {
    case("stick-slip", tolerance, memory)
}

/// In σ: l of a trapped tip grows like t, and its last digits are those of x0 + rt.
fn error(run: &Run, reference: &Run) -> f64 {
    let range = (run.trajectory.start(), run.trajectory.end());
    largest_difference(|t| run.trajectory.l(t), |t| reference.trajectory.l(t), range, 30_000)
}

#[test]
fn errors_stay_within_ten_tolerances_from_1e_4_to_1e_12() {
    for (name, ..) in CASES {
        let reference = case(name, 1e-13, MemoryChoice::Direct);
        let memories =
            [(MemoryChoice::Direct, 12), (MemoryChoice::Fft, 12), (MemoryChoice::Modes, 11)];
        for (memory, finest) in memories {
            for digits in 4..=finest {
                let tolerance = 10.0_f64.powi(-digits);
                let run = case(name, tolerance, memory);
                let label =
                    format!("{name}, {}, {tolerance:e}, {} steps", run.memory, run.work.steps);
                LADDER.judge(&label, error(&run, &reference), tolerance);
            }
        }
    }
}

/// A run at tolerance e that errs by less than e could have been asked for less. The steps that a run
/// with an error as large as e needs are found on a fine ladder of looser tolerances.
#[test]
fn at_most_twice_the_steps_that_the_error_needs() {
    let reference = stick_slip(1e-13, MemoryChoice::Fft);
    let ladder: Vec<(u64, f64)> = (0..=48)
        .map(|i| {
            let run = stick_slip(10.0_f64.powf(-2.0 - 0.21 * f64::from(i)), MemoryChoice::Fft);
            (run.work.steps, error(&run, &reference))
        })
        .collect();
    for digits in 4..=12 {
        let tolerance = 10.0_f64.powi(-digits);
        let asked = stick_slip(tolerance, MemoryChoice::Fft).work.steps;
        let enough =
            ladder.iter().filter(|(_, error)| *error <= tolerance).map(|(steps, _)| *steps);
        let needed = enough.min().unwrap();
        println!(
            "{tolerance:e}: {asked} steps, {needed} would do, ratio {:.2}",
            asked as f64 / needed as f64
        );
        assert!(asked <= 2 * needed, "{tolerance:e}: {asked} steps where {needed} do");
    }
}
