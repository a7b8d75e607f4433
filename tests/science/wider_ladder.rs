//! Is the tolerance honoured under the wider law too? Judged as tests/science/tolerance_ladder.rs does, by a run
//! with the `direct` memory at 1e-13; tests/science/wider_law.rs ties that to the outside.

use crate::acceptance::{Acceptance, largest_difference, observed_order};
use std::ops::ControlFlow;
use stickslip_outcome::{Drift, Regime, Remark, run_and_judge};
use stickslip_tip::memory::{Policy, Retreat};
use stickslip_tip::{
    Force, Integrator, MemoryChoice, Model, Run, Scenario, Start, Step, SupportPath, TipFunction,
    Trajectory, Wider, run, run_observed,
};

const LADDER: Acceptance = Acceptance { floor: 5e-13, slack: 10.0 };

fn wider(depth_limit: Option<f64>, healing_time: Option<f64>, inertia: Option<f64>) -> Wider {
    Wider { depth_limit, healing_time, inertia, ..Wider::default() }
}

fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).unwrap()
}

/// A run that starts beside steady motion and lasts so long.
fn case(law: Wider, (beta, alpha, r): (f64, f64, f64), duration: f64) -> Scenario {
    let model = Model::under(law, triple(beta), alpha, r).unwrap();
    let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 1e9) };
    Scenario { until: scenario.start_time() + duration, ..scenario }
}

fn cases() -> Vec<(&'static str, Scenario)> {
    let path =
        SupportPath::new(vec![0.0, 20.0, 30.0, 45.0, 60.0], vec![0.0, 24.0, 24.0, 9.0, 24.0]);
    let on_path = case(wider(None, None, None), (0.0, 1.1, 1.0), 1.0);
    let on_path = Scenario { path: Some(path.unwrap()), until: 60.0, ..on_path };
    vec![
        ("depth limit", case(wider(Some(20.0), None, None), (0.0, 2.6, 1.0), 100.0)),
        ("slow slips", case(wider(Some(10.0), None, None), (1.0, 20.0, 1.0), 160.0)),
        ("corner", case(wider(Some(5.0), None, None), (1.0, 1.3, 1.0), 100.0)),
        ("healing", case(wider(None, Some(10.0), None), (1.0, 1.5, 1.0), 100.0)),
        ("fast healing", case(wider(None, Some(1.5), None), (1.0, 4.0, 0.7), 100.0)),
        ("inertia", case(wider(None, None, Some(0.5)), (1.0, 1.2, 1.0), 70.0)),
        ("swinging back", case(wider(Some(10.0), None, Some(1.0)), (1.0, 2.0, 1.0), 40.0)),
        ("light", case(wider(None, None, Some(0.01)), (1.0, 1.2, 1.0), 100.0)),
        ("limit, healing", case(wider(Some(5.0), Some(20.0), None), (0.5, 3.0, 1.0), 100.0)),
        ("all", case(wider(Some(4.0), Some(15.0), Some(0.3)), (1.0, 2.0, 1.0), 70.0)),
        ("path", on_path),
    ]
}

/// In x0, in σ.
fn error(run: &Run, reference: &Run) -> f64 {
    let range = (run.trajectory.start(), run.trajectory.end());
    largest_difference(|t| run.trajectory.x0(t), |t| reference.trajectory.x0(t), range, 20_000)
}

/// In the height under the tip, where it is followed, relative to it where it is large.
fn error_of_height(run: &Run, reference: &Run) -> f64 {
    let height = |run: &Run, t: f64| run.trajectory.height(t).unwrap_or(0.0);
    let range = (run.trajectory.start(), run.trajectory.end());
    let scale = |t: f64| height(reference, t).abs().max(1.0);
    let relative = |run: &Run, t: f64| height(run, t) / scale(t);
    largest_difference(|t| relative(run, t), |t| relative(reference, t), range, 20_000)
}

#[test]
fn every_extension_keeps_the_tolerance_from_1e_4_to_1e_11() {
    for (name, scenario) in cases() {
        let with = |tolerance: f64, memory| {
            run(&Scenario { tolerance, memory, ..scenario.clone() }).unwrap()
        };
        // Heights of 60 are not known better.
        let finest = if name == "slow slips" { 1e-12 } else { 1e-13 };
        let reference = with(finest, MemoryChoice::Direct);
        for memory in [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes] {
            // Exponentials do not fit better where α is large.
            let most = if (name, memory) == ("slow slips", MemoryChoice::Modes) { 9 } else { 11 };
            for digits in [4, 6, 8, 9, 11].into_iter().filter(|digits| *digits <= most) {
                let tolerance = 10.0_f64.powi(-digits);
                let found = with(tolerance, memory);
                let label =
                    format!("{name}, {memory:?}, {tolerance:e}, {} steps", found.work.steps);
                LADDER.judge(&label, error(&found, &reference), tolerance);
                let label = format!("{label}, height");
                LADDER.judge(&label, error_of_height(&found, &reference), tolerance);
            }
        }
    }
}

/// Errors of x0 at step ends with steps of one length, over five lengths.
fn errors(scenario: &Scenario, lengths: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let (surface, model) = (scenario.initial_surface().unwrap(), &scenario.model);
    let to = scenario.until;
    let scenario = Scenario { tolerance: 1e-13, ..scenario.clone() };
    let reference = run(&scenario).unwrap();
    let error = |h: f64| {
        let memory =
            Policy::new(MemoryChoice::Direct, model.tip().clone(), 0.0, Retreat::Small).unwrap();
        let mut integrator = Integrator::new(&scenario, &surface, memory).with_fixed_step(h);
        let mut steps: Vec<Step> = vec![];
        while integrator.t() < to {
            integrator.step().unwrap();
            steps.extend(integrator.last());
        }
        let found = Trajectory::under(*model.wider(), scenario.support(), steps);
        found.steps().iter().fold(0.0, |most: f64, step| {
            let t = step.end().min(to);
            most.max((found.x0(t) - reference.trajectory.x0(t)).abs())
        })
    };
    lengths.map(|h| (h, error(h))).collect()
}

/// 11 at step ends, as without. (A step that ends at the corner is shorter, and the next one as long as asked.)
#[test]
fn orders_of_convergence_survive_every_extension_and_the_corner() {
    let cases = [
        ("depth limit", wider(Some(3.0), None, None), (0.0, 3.0)),
        ("healing", wider(None, Some(2.0), None), (1.0, 1.5)),
        ("inertia", wider(None, None, Some(0.5)), (1.0, 1.2)),
        ("corner", wider(Some(5.0), None, None), (1.0, 1.3)),
        ("all", wider(Some(4.0), Some(15.0), Some(0.3)), (1.0, 2.0)),
    ];
    for (name, law, (beta, alpha)) in cases {
        let scenario = Scenario {
            kick: 0.5,
            memory: MemoryChoice::Direct,
            ..case(law, (beta, alpha, 1.0), 12.0)
        };
        let found = errors(&scenario, (0..5).map(|i| 0.6 * 0.5_f64.powf(0.25 * f64::from(i))));
        let order = observed_order(&found);
        println!("{name}: order {order:.2} {found:?}");
        assert!(order > 9.0, "{name}: {order}");
    }
}

/// A surface that heals within a small part of a width of the way: with steps of many healing times what is left of a
/// step at its end is no polynomial. Judged as the other ladders are.
#[test]
fn short_memories_keep_the_tolerance_too() {
    let pulse = stickslip_tip::Pulse { amplitude: 0.5, time: 4.0, width: 0.3 };
    let r = 0.5;
    for length in [0.01, 0.03, 0.07, 0.15, 0.3, 1.0] {
        let law = wider(None, Some(length / r), None);
        let model = Model::under(law, triple(0.0), 0.6, r).unwrap();
        let with = |tolerance: f64, memory| {
            let scenario = Scenario {
                start: Start::Flat,
                start_position: 0.0,
                force: Force::new(vec![pulse], None).unwrap(),
                tolerance,
                memory,
                ..Scenario::new(model.clone(), 8.0)
            };
            run(&scenario).unwrap()
        };
        let reference = with(1e-13, MemoryChoice::Direct);
        for memory in [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes] {
            for tolerance in [1e-6, 1e-9, 1e-12] {
                let found = with(tolerance, memory);
                let label = format!("rT = {length}, {memory:?}, {tolerance:e}");
                LADDER.judge(&label, error(&found, &reference), tolerance);
            }
        }
    }
}

/// Nothing pushes the tip, and what it leaves is even about it: x0 is its start, to the last bit, however unstable that is.
#[test]
fn a_tip_at_rest_by_symmetry_stays_there_in_every_memory() {
    for law in [
        wider(None, None, None),
        wider(None, Some(1.0), None),
        wider(None, Some(2.0), Some(0.5)),
        wider(Some(2.0), None, None),
    ] {
        let law = Wider { spring: false, ..law };
        for tip in [triple(0.0), triple(1.0), TipFunction::Bessel] {
            let model = Model::under(law, tip, -3.0, 0.0).unwrap();
            for memory in [MemoryChoice::Auto, MemoryChoice::Direct, MemoryChoice::Fft] {
                let resting =
                    Scenario { start: Start::Flat, memory, ..Scenario::new(model.clone(), 200.0) };
                let (found, outcome) = run_and_judge(&resting).unwrap();
                let moved = found.trajectory.steps().iter().flat_map(|step| step.displacement);
                assert!(
                    moved.fold(0.0, |most: f64, d| most.max(d.abs())) <= 0.0,
                    "{law:?} {memory:?}"
                );
                let unstable = |remark: &Remark| matches!(remark, Remark::RestsBySymmetry { .. });
                assert!(outcome.remarks.iter().any(unstable), "{law:?}: {outcome:?}");
            }
        }
    }
    // It stays until a pulse begins, and errors that grow after that are remarked where they decide.
    let pulsed = |time: f64| {
        let law = Wider { spring: false, ..wider(None, None, None) };
        let pulse = stickslip_tip::Pulse { amplitude: 1.0, time, width: 0.5 };
        let model = Model::under(law, triple(0.0), -0.5, 0.0).unwrap();
        let force = Force::new(vec![pulse], None).unwrap();
        let scenario = Scenario { start: Start::Flat, force, ..Scenario::new(model, time + 20.0) };
        run_and_judge(&scenario).unwrap()
    };
    let grows = |remark: &Remark| matches!(remark, Remark::ErrorsGrowAtRest { .. });
    let (late, outcome) = pulsed(40.0);
    assert!((late.trajectory.x0(34.9) - 14.0).abs() <= 0.0);
    assert!(outcome.remarks.iter().any(grows), "{outcome:?}");
    assert!(!pulsed(2.0).1.remarks.iter().any(grows));
}

/// f = cos, no spring: the Lorenz system with σ = T/M, ρ = -αT², b = 1.
#[test]
fn a_cosine_without_a_spring_is_the_lorenz_system() {
    let (mass, alpha, velocity) = (0.1, -28.0, 1.0);
    let law =
        Wider { healing_time: Some(1.0), inertia: Some(mass), spring: false, ..Wider::default() };
    let model = Model::under(law, TipFunction::Cosine, alpha, 0.0).unwrap();
    let times: Vec<f64> = (1..=8).map(f64::from).collect();
    let lorenz = lorenz((mass, alpha, velocity), &times);
    for memory in [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes] {
        let scenario = Scenario {
            start: Start::Flat,
            start_position: 0.0,
            start_velocity: Some(velocity),
            memory,
            tolerance: 1e-12,
            ..Scenario::new(model.clone(), 8.0)
        };
        let found = run(&scenario).unwrap();
        for (t, x) in times.iter().zip(&lorenz) {
            let miss = (found.trajectory.velocity(*t) - x).abs();
            println!("{memory:?} {t} {x:.10} {miss:.1e}");
            assert!(miss < 1e-8, "{memory:?} {t}: {miss:e}");
        }
    }
}

/// With X = x0' and the two sums of a cosine over the past, Y = ∫ sin and Z = ∫ cos of x0(t) - x0(t') with weight
/// e^{-(t-t')/T}: M X' = -X - α Y, Y' = X Z - Y/T, Z' = 1 - X Y - Z/T, by the classical fourth-order method with
/// Richardson's extrapolation.
fn lorenz((mass, alpha, velocity): (f64, f64, f64), times: &[f64]) -> Vec<f64> {
    let rate = |[x, y, z]: [f64; 3]| [(-x - alpha * y) / mass, x * z - y, 1.0 - x * y - z];
    let step = |u: [f64; 3], h: f64| {
        let along = |k: [f64; 3], by: f64| std::array::from_fn(|i| u[i] + by * k[i]);
        let k1 = rate(u);
        let k2 = rate(along(k1, 0.5 * h));
        let k3 = rate(along(k2, 0.5 * h));
        let k4 = rate(along(k3, h));
        std::array::from_fn(|i| u[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    };
    let with = |n: u32| {
        let h = 1.0 / f64::from(n);
        let mut u = [velocity, 0.0, 0.0];
        let mut states = vec![];
        for _ in times {
            (0..n).for_each(|_| u = step(u, h));
            states.push(u[0]);
        }
        states
    };
    let (coarse, fine) = (with(20_000), with(40_000));
    coarse.iter().zip(&fine).map(|(a, b)| b + (b - a) / 15.0).collect()
}

/// Oza, Rosales & Bush, J. Fluid Mech. 737, 552 (2013), in one dimension without inertia: f = J0, T = 1, B = 3 walk
/// at v² = (2B - 1 - √(1 + 4B))/2.
#[test]
fn a_walker_on_j0_goes_at_the_speed_of_theory() {
    let law = Wider { healing_time: Some(1.0), spring: false, ..Wider::default() };
    let model = Model::under(law, TipFunction::Bessel, -3.0, 0.0).unwrap();
    let exact = ((6.0 - 1.0 - 13.0_f64.sqrt()) / 2.0).sqrt();
    assert!((exact - 0.834_999_6).abs() < 1e-7);
    let pulse = stickslip_tip::Pulse { amplitude: 1.0, time: 2.0, width: 0.5 };
    for memory in [MemoryChoice::Direct, MemoryChoice::Fft] {
        let scenario = Scenario {
            start: Start::Flat,
            force: Force::new(vec![pulse], None).unwrap(),
            memory,
            ..Scenario::new(model.clone(), 60.0)
        };
        let speed = run(&scenario).unwrap().trajectory.velocity(60.0);
        println!("{memory:?} {speed:.10}");
        assert!((speed - exact).abs() < 1e-8, "{memory:?}: {speed}");
    }
}

/// Judged by the closed form of the speed; a walk that has not settled is on the way there, and Lorenz's chaos nowhere.
#[test]
fn a_walk_at_one_velocity_is_drifting() {
    let outcome = |tip: TipFunction, alpha: f64, mass: Option<f64>, until: f64, amplitude: f64| {
        let law = Wider { spring: false, ..wider(None, Some(1.0), mass) };
        let model = Model::under(law, tip, alpha, 0.0).unwrap();
        let pulse = stickslip_tip::Pulse { amplitude, time: 2.0, width: 0.5 };
        let force = Force::new(vec![pulse], None).unwrap();
        let scenario = Scenario { start: Start::Flat, force, ..Scenario::new(model, until) };
        run_and_judge(&scenario).unwrap().1
    };
    for (b, sign, until) in
        [(3.0, 1.0, 60.0), (3.0, -1.0, 300.0), (2.2, 1.0, 120.0), (10.0, 1.0, 60.0)]
    {
        let found = outcome(TipFunction::Bessel, -b, None, until, sign);
        assert_eq!(found.regime, Regime::Drifting, "{b} {until}: {found:?}");
        let exact = sign * ((2.0 * b - 1.0 - (1.0 + 4.0 * b).sqrt()) / 2.0_f64).sqrt();
        let Drift { velocity, velocity_error } = found.drifting.unwrap();
        assert!(
            (velocity - exact).abs() <= velocity_error,
            "{velocity} {exact} {velocity_error:e}"
        );
        assert!(velocity_error < 1e-5 * exact.abs(), "{velocity_error:e}");
    }
    let early = outcome(TipFunction::Bessel, -2.2, None, 12.0, 1.0);
    assert_eq!(early.prospect.unwrap().towards, Some(Regime::Drifting), "{early:?}");
    let chaos = outcome(TipFunction::Cosine, -28.0, Some(0.1), 40.0, 1.0);
    assert_eq!(chaos.regime, Regime::Transient, "{chaos:?}");
    let rests = outcome(triple(0.0), -0.5, None, 100.0, 1.0);
    assert_eq!(rests.regime, Regime::Steady, "{rests:?}");
}

/// Without limit in the limit: x0 differs by 1/b, 1/T and M, to first order.
#[test]
fn each_extension_vanishes_to_first_order() {
    let plain = run(&case(Wider::default(), (0.0, 1.5, 1.0), 20.0)).unwrap();
    let miss = |law: Wider| {
        let found = run(&case(law, (0.0, 1.5, 1.0), 20.0)).unwrap();
        let start = found.trajectory.start() - plain.trajectory.start();
        let lag = |t: f64| found.trajectory.lag(t + start);
        let range = (plain.trajectory.start(), plain.trajectory.end() - 1e-6);
        largest_difference(lag, |t| plain.trajectory.lag(t), range, 500)
    };
    let laws: [fn(f64) -> Wider; 3] = [
        |e| wider(Some(1.0 / e), None, None),
        |e| wider(None, Some(1.0 / e), None),
        |e| wider(None, None, Some(e)),
    ];
    for law in laws {
        let found: Vec<(f64, f64)> =
            [1e-2, 3e-3, 1e-3, 3e-4, 1e-4].map(|e| (e, miss(law(e)))).to_vec();
        let order = observed_order(&found);
        println!("order {order:.3} {found:?}");
        assert!((order - 1.0).abs() < 0.1, "{order} {found:?}");
    }
}

/// In steady motion on the corner the height is what round-off and the sum that stands for f make of 0. Where that was
/// just what counts as 0, steps were 3e-5 long: four million of them to t = 301 (α = 0.8, b = 2, 1e-9). Measured: up to 903
/// and 1,103.
#[test]
fn steady_motion_on_the_corner_is_no_run_along_it() {
    for (alpha, limit, most) in [(0.8, 2.0, 2_000), (1.0, 5.0, 2_000)] {
        let wider = Wider { depth_limit: Some(limit), ..Wider::default() };
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::under(wider, tip, alpha, 1.0).unwrap();
        for tolerance in [1e-6, 1e-9, 1e-11] {
            let mut scenario = Scenario::new(model.clone(), 600.0);
            (scenario.kick, scenario.tolerance) = (0.1, tolerance);
            let mut steps = 0;
            let found = run_observed(&scenario, |_| {
                steps += 1;
                if steps > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let found = found.unwrap();
            println!("{alpha} {limit} {tolerance:e}: {steps} steps");
            assert!(!found.interrupted, "{alpha} {limit} {tolerance:e}");
            let end = found.trajectory.end();
            assert!((found.trajectory.l(end) - model.steady_l()).abs() < 1e-4);
        }
    }
}
