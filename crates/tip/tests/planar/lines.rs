//! Runs against the reference.

use super::reference::{Footprint, Motion, Problem};
use stickslip_tip::planar::{PlanarRun, PlanarScenario, run};
use stickslip_tip::{Force, Model, Pulse, Scenario, Start, SupportPath, TipFunction, Wider};

/// (48) with these side lobes times a Gaussian across of the width v.
pub(crate) fn tip(beta: f64, width: f64) -> TipFunction {
    let along = TipFunction::triple_gaussian(beta, 1.0).unwrap();
    TipFunction::of_footprint(stickslip_tip::Footprint::separable(along, width).unwrap())
}

/// A line at r = 1 until t, kicked.
pub(crate) fn line(
    (tip, wider): (TipFunction, Wider),
    alpha: f64,
    stiffness: f64,
    kicks: [f64; 2],
    until: f64,
) -> PlanarScenario {
    let model = Model::under(wider, tip, alpha, 1.0).unwrap();
    let along = Scenario { kick: kicks[0], ..Scenario::new(model, until) };
    PlanarScenario { kick_across: kicks[1], ..PlanarScenario::new(along, stiffness) }
}

/// The problem of the reference that is this scenario, with the side lobes and width of its footprint.
pub(crate) fn problem(scenario: &PlanarScenario, (beta, width): (f64, f64)) -> Problem {
    let (along, model) = (&scenario.along, &scenario.along.model);
    Problem {
        footprint: Footprint::triple(beta, width),
        alpha: model.alpha(),
        r: model.r(),
        stiffness: scenario.stiffness_across,
        inertia: model.wider().inertia,
        healing: model.wider().healing_time,
        depth_limit: model.wider().depth_limit,
        relief: |_| [0.0; 3],
        support: |problem, t| problem.r * t,
        force: |_| [0.0; 2],
        start: along.start_time(),
        position: [along.start_position - along.kick, scenario.kick_across],
        velocity: model.r(),
        steady_past: Some(along.start_position),
    }
}

/// Largest differences of x0 and y0 at the steps of the reference.
pub(crate) fn differences(run: &PlanarRun, motion: &Motion) -> [f64; 2] {
    let mut worst = [0.0; 2];
    for (t, [x, y]) in motion.t.iter().zip(&motion.position) {
        worst[0] = f64::max(worst[0], (run.trajectory.x0(*t) - x).abs());
        worst[1] = f64::max(worst[1], (run.trajectory.y0(*t) - y).abs());
    }
    worst
}

/// Runs to 1e-9, the default, within 5e-9 of the reference in so many steps; with velocities, which are those of interpolants.
pub(crate) fn holds(
    name: &str,
    scenario: &PlanarScenario,
    problem: &Problem,
    steps: usize,
) -> PlanarRun {
    let run = run(scenario).unwrap();
    let motion = problem.motion(scenario.along.until, steps);
    let [x, y] = differences(&run, &motion);
    let mut v = 0.0;
    for (t, velocity) in motion.t.iter().zip(&motion.velocity).skip(1) {
        let told = run.trajectory.velocity(*t);
        v = (0..2).map(|j| (told[j] - velocity[j]).abs()).fold(v, f64::max);
    }
    let (work, layers) = (run.work, run.layers);
    println!("{name}: {x:.1e} {y:.1e}, velocities {v:.1e}, {work:?} {layers:?}");
    assert!(x < 5e-9 && y < 5e-9 && v < 2e-7, "{name}: {x:e} {y:e} {v:e}");
    run
}

fn plain() -> Wider {
    Wider::default()
}

#[test]
fn lines_are_those_of_the_reference() {
    for (name, beta, width, alpha, stiffness, kicks) in [
        ("snaking", 1.0, 1.0, 1.2, 0.25, [0.1, 0.3]),
        ("wider across", 1.0, 1.4, 1.3, 0.5, [0.0, 0.2]),
        ("Gaussian", 0.0, 1.0, 2.2, 0.3, [0.2, 0.4]),
        ("stick-slip", 1.0, 0.8, 1.62, 1.0, [0.05, 0.1]),
    ] {
        let scenario = line((tip(beta, width), plain()), alpha, stiffness, kicks, 36.0);
        holds(name, &scenario, &problem(&scenario, (beta, width)), 300);
    }
}

#[test]
fn lines_under_the_wider_law_are_those_of_the_reference() {
    for (name, inertia, healing_time, alpha) in [
        ("inertia", Some(0.4), None, 1.3),
        ("healing", None, Some(5.0), 2.0),
        ("both", Some(2.0), Some(8.0), 1.6),
    ] {
        let wider = Wider { inertia, healing_time, ..plain() };
        let scenario = line((tip(1.0, 1.0), wider), alpha, 0.5, [0.05, 0.2], 36.0);
        holds(name, &scenario, &problem(&scenario, (1.0, 1.0)), 300);
    }
}

/// A depth limit with h on both sides of its kink, in series and in collocation, with all else in the extended model.
#[test]
fn lines_with_a_depth_limit_are_those_of_the_reference() {
    for (name, beta, alpha, limit, (inertia, healing_time), crosses) in [
        ("snaking", 1.0, 1.2, 5.0, (None, None), true),
        ("shallow", 1.0, 1.8, 1.5, (None, None), false),
        ("Gaussian", 0.0, 6.0, 3.0, (None, None), false),
        ("inertia and healing", 1.0, 1.6, 2.0, (Some(0.4), Some(8.0)), false),
    ] {
        let wider = Wider { depth_limit: Some(limit), inertia, healing_time, ..plain() };
        let scenario = line((tip(beta, 1.0), wider), alpha, 0.3, [0.05, 0.2], 36.0);
        let run = holds(name, &scenario, &problem(&scenario, (beta, 1.0)), 300);
        // Each step is on one side of the kink, except for round-off.
        let mut above = 0;
        for step in run.trajectory.steps() {
            let heights = step.along.height.unwrap();
            let all = heights.nodes.iter().chain([&heights.start]);
            let (low, high) = all.fold((0.0, 0.0), |(a, b): (f64, f64), h| (a.min(*h), b.max(*h)));
            assert!(low.abs().min(high) < 1e-9, "{name}: {heights:?}");
            above += usize::from(high > 1e-3);
        }
        println!("{name}: {above} of {} steps above", run.trajectory.steps().len());
        assert_eq!(above > 2, crosses, "{name}");
    }
}

/// Pulses along and across; the latter carry the tip off its line by several widths, to both sides.
#[test]
fn a_tip_that_wanders_is_followed() {
    let pulse = |amplitude, time, width| Pulse { amplitude, time, width };
    let force = |pulses| Force::new(pulses, None).unwrap();
    let mut scenario = line((tip(1.0, 0.8), plain()), 1.1, 0.6, [0.0, 0.0], 44.0);
    scenario.along.force = force(vec![pulse(0.4, 28.0, 1.1)]);
    scenario.force_across =
        force(vec![pulse(2.4, 23.0, 1.2), pulse(-3.2, 31.0, 1.5), pulse(1.6, 38.0, 0.9)]);
    let problem = Problem {
        force: |t| {
            let pulse = |a: f64, time: f64, w: f64| a * (-0.5 * ((t - time) / w).powi(2)).exp();
            let across = pulse(2.4, 23.0, 1.2) + pulse(-3.2, 31.0, 1.5) + pulse(1.6, 38.0, 0.9);
            [pulse(0.4, 28.0, 1.1), across]
        },
        ..problem(&scenario, (1.0, 0.8))
    };
    let run = holds("wandering", &scenario, &problem, 450);
    let y: Vec<f64> = (170..440).map(|i| run.trajectory.y0(0.1 * f64::from(i))).collect();
    let (low, high) = y.iter().fold((0.0, 0.0), |(a, b): (f64, f64), y| (a.min(*y), b.max(*y)));
    println!("from {low:.2} to {high:.2}");
    assert!(low < -2.0 && high > 1.5 && run.layers.changes >= 6, "{low} {high}");
    assert!(run.layers.error < 1e-9, "{:?}", run.layers);
}

/// A support on a path through these knots, from where steady motion has it.
pub(crate) fn on_a_path(path: &[(f64, f64)], wider: Wider) -> PlanarScenario {
    let (t, displacement): (Vec<f64>, _) = path.iter().copied().unzip();
    let mut scenario = line((tip(1.0, 1.0), wider), 1.2, 0.25, [0.1, 0.2], t[t.len() - 1]);
    scenario.along.path = Some(SupportPath::new(t, displacement).unwrap());
    scenario
}

/// R(t) of the reference likewise: X and the steady lag r + α f(0)/r, and the displacement.
pub(crate) fn support_on(path: &[(f64, f64)], problem: &Problem, t: f64) -> f64 {
    let last = path[path.len() - 2].0;
    let piece = path.windows(2).find(|ends| t <= ends[1].0 || ends[0].0 >= last).unwrap();
    let [from, to] = [piece[0], piece[1]];
    let part = (t - from.0) / (to.0 - from.0);
    // The triple Gaussian leaves the height 0 under a tip in steady motion, whatever b is.
    let lag = problem.r + problem.alpha * (1.0 - (-2.0_f64).exp()) / problem.r;
    14.0 + lag + from.1 + part * (to.1 - from.1)
}

/// A support that goes faster, waits, and goes on.
#[test]
fn a_support_on_a_path_is_followed() {
    const PATH: [(f64, f64); 4] = [(0.0, 0.0), (6.0, 9.0), (10.0, 9.5), (18.0, 18.0)];
    let scenario = on_a_path(&PATH, plain());
    let support = |problem: &Problem, t| support_on(&PATH, problem, t);
    holds("path", &scenario, &Problem { support, ..problem(&scenario, (1.0, 1.0)) }, 360);
}

/// A line forth, back over its own groove, and forth again.
#[test]
fn a_tip_that_is_drawn_back_is_followed() {
    const PATH: [(f64, f64); 4] = [(0.0, 0.0), (6.0, 6.0), (16.0, -4.0), (24.0, 5.0)];
    for (inertia, depth_limit) in [(None, None), (Some(0.5), None), (None, Some(2.0))] {
        let scenario = on_a_path(&PATH, Wider { inertia, depth_limit, ..plain() });
        let support = |problem: &Problem, t| support_on(&PATH, problem, t);
        let problem = Problem { support, ..problem(&scenario, (1.0, 1.0)) };
        let run = holds("trace and retrace", &scenario, &problem, 480);
        assert!(run.work.switches > 0, "{:?}", run.work);
    }
}

/// A heavy tip swings back after each slip, farther than exponentials hold, and a kick may put it there at once.
#[test]
fn a_tip_that_swings_back_is_followed() {
    let heavy = Wider { inertia: Some(2.0), ..plain() };
    let mut scenario = line((tip(1.0, 1.0), heavy), 1.6, 1.0, [0.1, 0.2], 54.0);
    scenario.along.start = Start::Flat;
    let of_flat = Problem { velocity: 0.0, steady_past: None, ..problem(&scenario, (1.0, 1.0)) };
    let run = holds("swing", &scenario, &of_flat, 950);
    let x = |i: i32| run.trajectory.x0(14.0 + 0.01 * f64::from(i));
    let farthest_back = (0..4000)
        .scan(f64::NEG_INFINITY, |farthest, i| {
            *farthest = f64::max(*farthest, x(i));
            Some(*farthest - x(i))
        })
        .fold(0.0, f64::max);
    println!("{farthest_back}");
    assert!(farthest_back > 1.0, "{farthest_back}");
    let scenario = line((tip(1.0, 1.0), plain()), 1.1, 0.3, [3.0, 0.2], 36.0);
    holds("kicked far back", &scenario, &problem(&scenario, (1.0, 1.0)), 300);
}

/// (name, β, α, b, κ_y, end, steps of the reference): snaking, stick-slip, tips that are stuck, a stiff spring across.
type Rung = (&'static str, f64, f64, Option<f64>, f64, f64, usize);

const LADDER: [Rung; 8] = [
    ("snaking", 1.0, 1.2, None, 0.25, 36.0, 360),
    ("stick-slip", 1.0, 1.62, None, 1.0, 36.0, 420),
    ("stuck", 0.0, 3.0, None, 0.5, 38.0, 360),
    ("stuck fast", 1.0, 4.0, None, 0.5, 31.0, 360),
    ("stiff spring", 1.0, 1.2, None, 30.0, 24.0, 400),
    ("stick-slip, b = 10", 1.0, 1.8, Some(10.0), 0.5, 36.0, 420),
    ("snaking, b = 3", 1.0, 1.5, Some(3.0), 0.2, 36.0, 360),
    ("stiff spring, b = 3", 1.0, 1.2, Some(3.0), 30.0, 24.0, 400),
];

/// The errors of steps add up, and the motions amplify them: the same slack as in one coordinate.
const SLACK: f64 = 10.0;

#[test]
fn errors_stay_within_ten_tolerances_from_1e_4_to_1e_10() {
    for (name, beta, alpha, depth_limit, stiffness, until, steps) in LADDER {
        let wider = Wider { depth_limit, ..plain() };
        let mut scenario = line((tip(beta, 1.0), wider), alpha, stiffness, [0.05, 0.1], until);
        let motion = problem(&scenario, (beta, 1.0)).motion(until, steps);
        for digits in 4..=10 {
            let tolerance = 10.0_f64.powi(-digits);
            scenario.along.tolerance = tolerance;
            let run = run(&scenario).unwrap();
            let [x, y] = differences(&run, &motion);
            println!("{name} {tolerance:e}: {x:.1e} {y:.1e} {:?} {:?}", run.work, run.layers);
            assert!(x < SLACK * tolerance && y < SLACK * tolerance, "{name} {tolerance:e}");
            assert!(run.layers.error < 0.02 * tolerance, "{name} {tolerance:e}");
        }
    }
}
