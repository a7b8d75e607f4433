//! What a run in two coordinates has in common with one in a single coordinate, what it costs, and what is refused.

use super::lines::{line, tip};
use stickslip_tip::planar::{PlanarError, PlanarRunning, PlanarScenario, Trajectory, run};
use stickslip_tip::state::State;
use stickslip_tip::{Model, Noise, Start, SupportPath, TipFunction, Wider, Work};

fn plain() -> Wider {
    Wider::default()
}

/// Largest difference of x0 from the solver of one coordinate.
pub(crate) fn beside_one_coordinate(scenario: &PlanarScenario, planar: &Trajectory) -> f64 {
    let line = stickslip_tip::run(&scenario.along).unwrap().trajectory;
    let t = |i: i32| line.start() + (line.end() - line.start()) * f64::from(i) / 2000.0;
    (0..=2000).map(|i| (planar.x0(t(i)) - line.x0(t(i))).abs()).fold(0.0, f64::max)
}

#[test]
fn on_its_line_the_tip_moves_as_in_one_coordinate() {
    for (alpha, depth_limit, start) in [
        (1.2, None, Start::Steady),
        (1.62, None, Start::Steady),
        (1.3, None, Start::Flat),
        (1.4, Some(4.0), Start::Steady),
        (2.0, Some(2.0), Start::Flat),
    ] {
        let wider = Wider { depth_limit, ..plain() };
        let mut scenario = line((tip(1.0, 1.0), wider), alpha, 0.7, [0.05, 0.0], 50.0);
        scenario.along.start = start;
        let run = run(&scenario).unwrap();
        let error = beside_one_coordinate(&scenario, &run.trajectory);
        println!("{alpha} {depth_limit:?} {start:?}: {error:.1e}");
        assert!(error < 5e-9, "{error:e}");
        assert!((0..500).all(|i| run.trajectory.y0(0.1 * f64::from(i)).abs() < 1e-300));
    }
}

/// From a flat surface the groove that visits stand for is all that pushes the tip, beside its springs.
#[test]
fn visits_carve_the_groove_that_the_tip_is_in() {
    for (healing_time, depth_limit) in [(None, None), (Some(4.0), None), (Some(6.0), Some(3.0))] {
        let wider = Wider { healing_time, depth_limit, ..plain() };
        let mut scenario = line((tip(1.0, 1.3), wider), 1.4, 0.4, [0.0, 0.3], 40.0);
        scenario.along.start = Start::Flat;
        let trajectory = run(&scenario).unwrap().trajectory;
        let along = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        for t in [14.7, 20.0, 26.3, 33.1, 39.9] {
            let (x, y) = (trajectory.x0(t), trajectory.y0(t));
            let mut force = [t - x, -0.4 * y];
            let mut height = 0.0;
            for visit in trajectory.residence(t) {
                let (d, e) = (x - visit.x, (y - visit.y) / 1.3);
                let strength = 1.4 * visit.weight * (-0.5 * e * e).exp();
                force[0] += strength * along.slope(d);
                force[1] -= strength * along.value(d) * e / 1.3;
                height -= strength * along.value(d);
            }
            let told = trajectory.height(t);
            assert_eq!(told.is_some(), depth_limit.is_some());
            assert!((told.unwrap_or(height) - height).abs() < 5e-9, "{told:?} {height}");
            let velocity = trajectory.velocity(t);
            let miss = [0, 1].map(|j: usize| f64::abs(force[j] - velocity[j]));
            println!("{healing_time:?} {t}: {miss:?}");
            assert!(miss[0] < 5e-9 && miss[1] < 5e-9, "{miss:?}");
        }
    }
}

/// What a kick across leaves before the spring has pulled the tip back takes a time of 1/κ_y.
#[test]
fn as_the_spring_across_stiffens_the_motion_becomes_that_of_one_coordinate() {
    for depth_limit in [None, Some(4.0)] {
        let wider = Wider { depth_limit, ..plain() };
        let difference = |stiffness: f64| {
            let scenario = line((tip(1.0, 1.0), wider), 1.2, stiffness, [0.1, 0.4], 36.0);
            beside_one_coordinate(&scenario, &run(&scenario).unwrap().trajectory)
        };
        let differences = [100.0, 200.0, 400.0, 800.0, 1600.0].map(difference);
        println!("{depth_limit:?} {differences:?}");
        for (i, pair) in differences.windows(2).enumerate() {
            let order = (pair[0] / pair[1]).log2();
            println!("{order:.3}");
            assert!((order - 1.0).abs() < 0.1 / f64::from(1 << i), "{order}");
        }
    }
}

/// Order 2s - 1 = 11 at the ends of steps of s stages.
#[test]
fn collocation_converges_at_its_order() {
    let scenario = line((tip(1.0, 1.0), plain()), 1.2, 0.5, [0.1, 0.3], 24.0);
    let start = scenario.along.start_time();
    let end = |steps: u32| {
        let h = (24.0 - start) / f64::from(steps);
        let mut running = PlanarRunning::new(&scenario).unwrap().with_fixed_step(h);
        let last = std::iter::from_fn(|| running.step().unwrap()).last().unwrap();
        let t = last.end();
        [last.along.position(&scenario.along.support(), t), last.y0(t)]
    };
    let fine = end(40);
    let error = |steps: u32| {
        let [x, y] = end(steps);
        (x - fine[0]).hypot(y - fine[1])
    };
    for steps in [5, 6] {
        let errors = [error(steps), error(2 * steps)];
        let order = (errors[0] / errors[1]).log2();
        println!("{errors:?}: {order:.2}");
        assert!((10.0..12.5).contains(&order), "{order}");
    }
}

/// Bits are the same everywhere, and so are counts.
#[test]
fn work_is_what_it_was() {
    for (alpha, stiffness, tolerance, until, work, layers) in [
        (1.2, 0.25, 1e-7, 60.0, [57, 0, 0, 54, 0], (24, 2)),
        (1.62, 1.0, 1e-9, 60.0, [202, 0, 0, 97, 0], (16, 0)),
        (4.0, 0.5, 1e-9, 200.0, [67, 0, 54, 23, 1], (32, 4)),
    ] {
        let mut scenario = line((tip(1.0, 1.0), plain()), alpha, stiffness, [0.05, 0.1], until);
        scenario.along.tolerance = tolerance;
        let run = run(&scenario).unwrap();
        let [steps, rejected, newton_iterations, series, switches] = work;
        assert_eq!(run.work, Work { steps, rejected, newton_iterations, series, switches });
        assert_eq!((run.layers.most, run.layers.changes), layers);
    }
}

/// The run by which a step across is compared with one of a tip held on its line (`benches/runs.rs`).
#[test]
fn eight_layers_are_1_6_times_the_series_of_a_tip_on_its_line() {
    let mut scenario = line((tip(1.0, 1.0), plain()), 1.2, 1.0, [0.05, 0.01], 500.0);
    scenario.along.tolerance = 1e-7;
    let free = run(&scenario).unwrap();
    let held = stickslip_tip::run(&scenario.along).unwrap();
    assert_eq!((free.layers.most, free.layers.changes), (8, 0));
    assert_eq!([free.work.steps, free.work.series], [1243, 1082]);
    assert_eq!([held.work.steps, held.work.series], [1403, 670]);
}

/// Snaking and stick-slip for 20,000 units of time: what is kept is the same as after 100.
#[test]
fn memory_is_flat() {
    let mut scenario = line((tip(1.0, 1.0), plain()), 1.4, 0.25, [0.05, 0.1], 20_000.0);
    scenario.along.tolerance = 1e-5;
    let mut running = PlanarRunning::new(&scenario).unwrap();
    let (mut early, mut late) = (0, 0);
    while let Some(step) = running.step().unwrap() {
        let most = if step.end() < 200.0 { &mut early } else { &mut late };
        *most = running.memory_size().max(*most);
    }
    println!("{early} {late} {:?} {:?}", running.work(), running.layers());
    assert!(late <= early + early / 4 && late < 4000, "{early} {late}");
}

/// Runs a scenario, interrupts it after these numbers of steps, and compares the steps that follow with those of the whole.
pub(crate) fn resumes_with_the_same_bits(scenario: &PlanarScenario, interruptions: &[usize]) {
    let whole = run(scenario).unwrap().trajectory;
    for interrupted in interruptions.iter().copied() {
        let mut running = PlanarRunning::new(scenario).unwrap();
        for _ in 0..interrupted {
            running.step().unwrap();
        }
        let mut state = State::default();
        running.save(&mut state);
        let mut reader = state.reader();
        let mut resumed = PlanarRunning::resumed(scenario, &mut reader).unwrap();
        reader.finish().unwrap();
        assert_eq!(resumed.work(), running.work());
        let rest: Vec<_> = std::iter::from_fn(|| resumed.step().unwrap()).collect();
        let memory = scenario.along.memory;
        assert_eq!(rest, whole.steps()[interrupted..], "{memory:?} {interrupted}");
    }
}

/// Of a line forth and back, by exponentials and by the lattice: wherever it is interrupted, the rest has the same bits.
#[test]
fn a_run_taken_up_again_is_the_same() {
    let star = || super::footprints::gaussians(&super::footprints::star()).0;
    for (depth_limit, tip) in [(None, tip(1.0, 1.0)), (Some(3.0), tip(1.0, 1.0)), (None, star())] {
        let wider = Wider { depth_limit, ..plain() };
        let mut scenario = line((tip, wider), 1.2, 0.25, [0.1, 0.2], 24.0);
        let (t, displacement) = (vec![0.0, 6.0, 16.0, 24.0], vec![0.0, 6.0, -4.0, 5.0]);
        scenario.along.path = Some(SupportPath::new(t, displacement).unwrap());
        resumes_with_the_same_bits(&scenario, &[0, 1, 7, 20, 40, 60]);
    }
}

/// Words that are missing, and words that are no state, are errors or another motion, and never a panic.
#[test]
fn a_damaged_state_is_refused() {
    let wider = Wider { depth_limit: Some(3.0), ..plain() };
    let scenario = line((tip(1.0, 1.0), wider), 1.2, 0.25, [0.1, 0.2], 30.0);
    let mut running = PlanarRunning::new(&scenario).unwrap();
    for _ in 0..9 {
        running.step().unwrap();
    }
    let mut state = State::default();
    running.save(&mut state);
    for n in 0..state.words().len() {
        let short = State::from_words(state.words()[..n].to_vec());
        assert!(PlanarRunning::resumed(&scenario, &mut short.reader()).is_err(), "{n}");
        for word in [u64::MAX, 1 << 40, 0, f64::NAN.to_bits()] {
            let mut words = state.words().to_vec();
            words[n] = word;
            let state = State::from_words(words);
            if let Ok(mut resumed) = PlanarRunning::resumed(&scenario, &mut state.reader()) {
                // It may not get anywhere.
                let _ = (0..3).try_for_each(|_| resumed.step().map(|_| ()));
            }
        }
    }
}

fn refused(change: impl Fn(&mut PlanarScenario)) -> PlanarError {
    let mut scenario = line((tip(1.0, 1.0), plain()), 1.2, 0.5, [0.05, 0.1], 40.0);
    change(&mut scenario);
    run(&scenario).unwrap_err()
}

/// The scenario with this footprint instead.
fn with_tip(scenario: &mut PlanarScenario, tip: TipFunction) {
    let model = &scenario.along.model;
    scenario.along.model = Model::under(*model.wider(), tip, model.alpha(), model.r()).unwrap();
}

fn with_law(scenario: &mut PlanarScenario, wider: Wider, r: f64) {
    let tip = scenario.along.model.tip().clone();
    scenario.along.model = Model::under(wider, tip, 1.2, r).unwrap();
    scenario.along.start = Start::Flat;
}

#[test]
fn what_is_not_there_is_refused_by_name() {
    for stiffness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(|scenario| scenario.stiffness_across = stiffness);
        assert!(matches!(error, PlanarError::Stiffness(_)), "{error}");
    }
    let error = refused(|scenario| scenario.kick_across = f64::NAN);
    assert!(matches!(error, PlanarError::Kick(_)), "{error}");
    let error = refused(|scenario| with_tip(scenario, TipFunction::default()));
    assert_eq!(error, PlanarError::NoFootprint);
    let error = refused(|scenario| {
        scenario.along.start = Start::Flat;
        with_tip(scenario, TipFunction::Bessel);
    });
    assert_eq!(error, PlanarError::NeverFades);
    let error = refused(|s| with_law(s, Wider { spring: false, ..plain() }, 0.0));
    assert_eq!(error, PlanarError::Unavailable("a tip without a spring"));
    assert!(error.to_string().starts_with("a tip without a spring"), "{error}");
    for spacing in [0.0, -1.0, f64::NAN, 1e-9] {
        let error = refused(|scenario| scenario.noise_spacing_across = Some(spacing));
        assert!(matches!(error, PlanarError::NoiseSpacing(_)), "{error}");
    }
    let many = refused(|scenario| {
        scenario.along.noise = Some(Noise { amplitude: 0.1, spacing: 1e-3, seed: 1 });
        scenario.noise_spacing_across = Some(0.1);
    });
    assert!(matches!(many, PlanarError::InitialSurface(_)), "{many}");
    let retreat = refused(|scenario| scenario.along.kick = 300.0);
    assert!(matches!(retreat, PlanarError::Retreat { behind, .. } if behind > 299.0), "{retreat}");
    let late = refused(|scenario| scenario.along.until = 1.0);
    assert!(matches!(late, PlanarError::Along(_)), "{late}");
}
