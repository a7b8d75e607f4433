//! Each memory against the reference: the definition, convolution by FFT, exponentials.

use super::footprints::{gaussians, star};
use super::limits::resumes_with_the_same_bits;
use super::lines::{differences, line, on_a_path, problem, support_on, tip};
use super::reference::Problem;
use stickslip_tip::planar::{PlanarRun, PlanarRunning, PlanarScenario, run};
use stickslip_tip::state::State;
use stickslip_tip::{MemoryChoice, Start, Wider};

const MEMORIES: [MemoryChoice; 3] = [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes];

fn plain() -> Wider {
    Wider::default()
}

fn with(scenario: &PlanarScenario, memory: MemoryChoice) -> PlanarScenario {
    let mut scenario = scenario.clone();
    scenario.along.memory = memory;
    scenario
}

/// (name, β, α, extended model, κ_y, end, steps of the reference)
type Rung = (&'static str, f64, f64, Wider, f64, f64, usize);

fn ladder() -> [Rung; 4] {
    let all =
        Wider { depth_limit: Some(3.0), inertia: Some(0.4), healing_time: Some(8.0), ..plain() };
    [
        ("snaking", 1.0, 1.2, plain(), 0.25, 36.0, 360),
        ("stuck", 0.0, 3.0, plain(), 0.5, 38.0, 360),
        ("all of the extended model", 1.0, 1.6, all, 0.3, 36.0, 360),
        ("stiff spring", 1.0, 1.2, plain(), 30.0, 24.0, 400),
    ]
}

/// Likewise as in one coordinate: errors of steps add up, and the motion amplifies them.
const SLACK: f64 = 10.0;

#[test]
fn errors_of_each_memory_stay_within_ten_tolerances_from_1e_4_to_1e_10() {
    for (name, beta, alpha, wider, stiffness, until, steps) in ladder() {
        let mut scenario = line((tip(beta, 1.0), wider), alpha, stiffness, [0.05, 0.1], until);
        let motion = problem(&scenario, (beta, 1.0)).motion(until, steps);
        for memory in MEMORIES {
            for digits in 4..=10 {
                let tolerance = 10.0_f64.powi(-digits);
                scenario.along.tolerance = tolerance;
                let run = run(&with(&scenario, memory)).unwrap();
                let [x, y] = differences(&run, &motion);
                println!("{name} {memory:?} {tolerance:e}: {x:.1e} {y:.1e} {:?}", run.layers);
                assert!(x < SLACK * tolerance && y < SLACK * tolerance, "{name} {memory:?}");
                assert!(run.layers.error < 0.05 * tolerance, "{name} {memory:?}");
                assert_eq!(run.layers.most == 0, memory == MemoryChoice::Direct);
            }
        }
    }
}

/// The center of the layers changes several times while the tip is drawn back over its groove, in a footprint of several
/// products.
#[test]
fn each_memory_follows_a_tip_that_is_drawn_back() {
    const PATH: [(f64, f64); 4] = [(0.0, 0.0), (6.0, 6.0), (16.0, -4.0), (24.0, 5.0)];
    for depth_limit in [None, Some(2.0)] {
        let scenario = on_a_path(&PATH, Wider { depth_limit, ..plain() });
        let support = |problem: &Problem, t| support_on(&PATH, problem, t);
        let problem = Problem { support, ..problem(&scenario, (1.0, 1.0)) };
        let motion = problem.motion(24.0, 480);
        for memory in MEMORIES {
            let run = run(&with(&scenario, memory)).unwrap();
            let [x, y] = differences(&run, &motion);
            println!("{depth_limit:?} {memory:?}: {x:.1e} {y:.1e} {:?} {:?}", run.work, run.layers);
            assert!(x < 5e-9 && y < 5e-9, "{memory:?}: {x:e} {y:e}");
            assert_eq!(run.work.series > 0, memory == MemoryChoice::Modes);
        }
    }
}

/// Healing for so long that weights are scaled anew, from a flat surface, with several products.
#[test]
fn memories_agree_over_a_surface_that_heals_at_once() {
    let wider = Wider { healing_time: Some(0.3), ..plain() };
    let (star, _) = gaussians(&star());
    let mut scenario = line((star, wider), 6.0, 0.3, [0.05, 0.4], 120.0);
    scenario.along.start = Start::Flat;
    let [direct, fft, modes] = MEMORIES.map(|memory| run(&with(&scenario, memory)).unwrap());
    for i in 0..1000 {
        let t = 20.0 + 0.1 * f64::from(i);
        for other in [&fft, &modes] {
            let x = (direct.trajectory.x0(t) - other.trajectory.x0(t)).abs();
            let y = (direct.trajectory.y0(t) - other.trajectory.y0(t)).abs();
            assert!(x < 3e-9 && y < 3e-9, "{t}: {x:e} {y:e}");
        }
    }
}

/// Behind the front of a steady groove exponentials grow: there the height under the tip, too, is that of another memory.
#[test]
fn memories_agree_on_starts_far_behind_a_steady_groove() {
    let wider = Wider { depth_limit: Some(3.0), ..plain() };
    for kick in [2.0, 5.0, 12.0, 30.0] {
        let scenario = line((tip(0.0, 1.0), wider), 0.5, 1.0, [kick, 0.1], 30.0);
        let [direct, fft, modes] = MEMORIES.map(|memory| run(&with(&scenario, memory)).unwrap());
        let start = direct.trajectory.start();
        for i in 0..=100 {
            let t = start + (30.0 - start) * f64::from(i) / 100.0;
            let at = |run: &PlanarRun| [run.trajectory.x0(t), run.trajectory.height(t).unwrap()];
            for other in [&fft, &modes] {
                let [x, height] = [0, 1].map(|j| (at(&direct)[j] - at(other)[j]).abs());
                assert!(x < 1e-8 && height < 1e-7, "{kick}, {t}: {x:e} {height:e}");
            }
        }
    }
}

#[test]
fn a_run_of_each_memory_taken_up_again_is_the_same() {
    let wider = Wider { healing_time: Some(5.0), depth_limit: Some(3.0), ..plain() };
    for memory in MEMORIES {
        let scenario = line((tip(1.0, 1.0), wider), 1.4, 0.25, [0.1, 0.6], 30.0);
        let scenario = with(&scenario, memory);
        resumes_with_the_same_bits(&scenario, &[0, 1, 7, 20, 30]);
        // A state that is cut short is an error.
        let mut running = PlanarRunning::new(&scenario).unwrap();
        (0..5).for_each(|_| assert!(running.step().unwrap().is_some()));
        let mut state = State::default();
        running.save(&mut state);
        for n in (0..state.words().len()).step_by(17) {
            let short = State::from_words(state.words()[..n].to_vec());
            let resumed = PlanarRunning::resumed(&scenario, &mut short.reader());
            assert!(resumed.is_err(), "{memory:?} {n}");
        }
    }
}

/// No few exponentials fit edges so sharp: a convolution takes their place.
#[test]
fn a_footprint_without_exponentials_is_followed() {
    let edge = |x: f64| [-0.4, x, 0.1, 0.0, 1.0];
    let terms = [[1.0, 0.0, 1.0, 0.0, 1.0], edge(-0.9), edge(0.9)];
    let (tip, footprint) = gaussians(&terms);
    let scenario = line((tip, plain()), 1.2, 0.3, [0.05, 0.2], 24.0);
    let problem = Problem { footprint, ..problem(&scenario, (1.0, 1.0)) };
    let motion = problem.motion(24.0, 600);
    let (name, why) = PlanarRunning::new(&scenario).unwrap().memory();
    assert!(name == "fft" && why.starts_with("modes do not fit"), "{name}: {why}");
    for memory in [MemoryChoice::Auto, MemoryChoice::Direct] {
        let [x, y] = differences(&run(&with(&scenario, memory)).unwrap(), &motion);
        println!("{memory:?}: {x:.1e} {y:.1e}");
        assert!(x < 5e-9 && y < 5e-9, "{memory:?}: {x:e} {y:e}");
    }
    let refused = run(&with(&scenario, MemoryChoice::Modes)).unwrap_err();
    assert!(refused.to_string().contains("use the memory fft"), "{refused}");
}
