//! Initial surfaces u0(x,y): tables and noise.

use super::limits::beside_one_coordinate;
use super::lines::{differences, holds, line, problem, tip};
use super::reference::Problem;
use stickslip_tip::planar::{HeightTable, PlanarRunning, PlanarScenario, Texture, run};
use stickslip_tip::state::State;
use stickslip_tip::{Noise, TipFunction, Wider};

fn plain() -> Wider {
    Wider::default()
}

/// 3ξ² - 2ξ³ and its slope: a cubic with level ends, which a spline with level ends repeats.
fn rise(from: f64, to: f64, x: f64) -> [f64; 2] {
    let xi = (x - from) / (to - from);
    [xi * xi * (3.0 - 2.0 * xi), 6.0 * xi * (1.0 - xi) / (to - from)]
}

const ENDS: [(f64, f64); 2] = [(8.0, 41.0), (-3.0, 4.5)];

/// The product of a rise along and one across, and its slopes.
fn hill([x, y]: [f64; 2]) -> [f64; 3] {
    let [[a, da], [b, db]] = [rise(ENDS[0].0, ENDS[0].1, x), rise(ENDS[1].0, ENDS[1].1, y)];
    let height = 9.0;
    [height * a * b, height * da * b, height * a * db]
}

fn table() -> HeightTable {
    let axis = |(from, to): (f64, f64), n: i32| -> Vec<f64> {
        // Unevenly spaced.
        let part = |i: i32| f64::from(i) / f64::from(n);
        (0..=n).map(|i| from + (to - from) * (part(i) + 0.1 * part(i) * (1.0 - part(i)))).collect()
    };
    let (x, y) = (axis(ENDS[0], 47), axis(ENDS[1], 9));
    let u = y.iter().flat_map(|y| x.iter().map(|x| hill([*x, *y])[0])).collect();
    HeightTable::new(x, y, u).unwrap()
}

fn on_the_hill(wider: Wider, alpha: f64) -> PlanarScenario {
    let scenario = line((tip(1.0, 1.0), wider), alpha, 0.6, [0.05, 0.2], 36.0);
    PlanarScenario { profile_across: Some(table()), ..scenario }
}

/// A hill that is steep enough to push the tip off its line by its width, with each term of the extended model.
#[test]
fn lines_over_a_table_are_those_of_the_reference() {
    let limited = Wider { depth_limit: Some(4.0), ..plain() };
    let healing = Wider { healing_time: Some(9.0), inertia: Some(0.4), ..plain() };
    for (name, wider, alpha) in
        [("plain", plain(), 1.2), ("limited", limited, 1.5), ("healing", healing, 1.5)]
    {
        let scenario = on_the_hill(wider, alpha);
        let problem = Problem { relief: hill, ..problem(&scenario, (1.0, 1.0)) };
        let run = holds(name, &scenario, &problem, 320);
        let lowest = (150..360).map(|i| run.trajectory.y0(0.1 * f64::from(i)));
        let lowest = lowest.fold(0.0, f64::min);
        println!("{name}: y0 down to {lowest:.2}");
        assert!(lowest < -0.5, "{lowest}");
    }
}

/// By series, and for a stiff spring by collocation.
#[test]
fn errors_over_a_table_stay_within_ten_tolerances_from_1e_4_to_1e_10() {
    let limited = Wider { depth_limit: Some(4.0), ..plain() };
    for (stiffness, until, steps) in [(0.6, 36.0, 360), (25.0, 24.0, 360)] {
        let mut scenario = on_the_hill(limited, 1.5);
        (scenario.stiffness_across, scenario.along.until) = (stiffness, until);
        let problem = Problem { relief: hill, ..problem(&scenario, (1.0, 1.0)) };
        let motion = problem.motion(until, steps);
        for digits in 4..=10 {
            let tolerance = 10.0_f64.powi(-digits);
            scenario.along.tolerance = tolerance;
            let run = run(&scenario).unwrap();
            let [x, y] = differences(&run, &motion);
            println!("{stiffness} {tolerance:e}: {x:.1e} {y:.1e} {:?}", run.work);
            assert!(x < 10.0 * tolerance && y < 10.0 * tolerance, "{tolerance:e}");
        }
    }
}

const NOISE: Noise = Noise { amplitude: 0.03, spacing: 0.4, seed: 5 };

fn noisy(spacing_across: Option<f64>) -> PlanarScenario {
    let mut scenario = line((tip(1.0, 1.0), plain()), 1.2, 0.4, [0.05, 0.1], 40.0);
    scenario.along.noise = Some(NOISE);
    PlanarScenario { noise_spacing_across: spacing_across, ..scenario }
}

/// Slopes of u0 by differences of heights of order 6.
fn slopes(texture: &Texture, [x, y]: [f64; 2]) -> [f64; 2] {
    let h = 2e-4;
    let difference = |u: &dyn Fn(f64) -> f64| {
        let pair = |n: f64| u(n * h) - u(-n * h);
        (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
    };
    [difference(&|d| texture.height(x + d, y)), difference(&|d| texture.height(x, y + d))]
}

/// The groove of the visits, the springs and the slopes of u0 are all that acts on a tip from a flat start.
#[test]
fn noise_pushes_the_tip_along_and_across() {
    for spacing in [0.3, 0.9] {
        let mut scenario = noisy(Some(spacing));
        scenario.along.start = stickslip_tip::Start::Flat;
        let texture = scenario.texture().unwrap();
        let trajectory = run(&scenario).unwrap().trajectory;
        let along = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let mut largest: f64 = 0.0;
        for t in [14.7, 20.0, 26.3, 33.1, 39.9] {
            let (x, y) = (trajectory.x0(t), trajectory.y0(t));
            let relief = slopes(&texture, [x, y]);
            let mut force = [t - x - relief[0], -0.4 * y - relief[1]];
            for visit in trajectory.residence(t) {
                let (d, e) = (x - visit.x, y - visit.y);
                let strength = 1.2 * visit.weight * (-0.5 * e * e).exp();
                force[0] += strength * along.slope(d);
                force[1] -= strength * along.value(d) * e;
            }
            let velocity = trajectory.velocity(t);
            let miss = [0, 1].map(|j: usize| f64::abs(force[j] - velocity[j]));
            println!("{spacing} {t}: {miss:?} {relief:?}");
            assert!(miss[0] < 2e-8 && miss[1] < 2e-8, "{miss:?}");
            largest = largest.max(relief[1].abs());
        }
        assert!(largest > 0.01, "{largest}");
    }
}

/// Without a distance of rows noise and profile are those of one coordinate, and on the line so they are with one.
#[test]
fn on_the_line_noise_is_that_of_one_coordinate() {
    let scenario = noisy(Some(0.7));
    let (texture, line) = (scenario.texture().unwrap(), scenario.along.initial_surface().unwrap());
    for i in 0..400 {
        let x = 10.0 + 0.0731 * f64::from(i);
        assert!((texture.height(x, 0.0) - line.texture(x)).abs() < 1e-16, "{x}");
    }
    let mut scenario = noisy(None);
    let x: Vec<f64> = (0..30).map(|i| 13.0 + f64::from(i)).collect();
    let u = x.iter().map(|x| 0.2 * (0.7 * x).sin()).collect();
    scenario.along.profile = Some((x, u));
    scenario.kick_across = 0.0;
    let run = run(&scenario).unwrap();
    let error = beside_one_coordinate(&scenario, &run.trajectory);
    println!("{error:.1e}");
    assert!(error < 5e-9 && run.trajectory.y0(40.0).abs() < 1e-300, "{error:e}");
}

/// Rows that are independent have no correlation one spacing apart, and are the same near each other.
#[test]
fn noise_is_correlated_across_over_its_spacing() {
    let correlation = |distance: f64| {
        let texture = noisy(Some(0.8)).texture().unwrap();
        let (mut product, mut square) = (0.0, 0.0);
        for i in 0..40 {
            for j in -10..10 {
                let (x, y) = (0.4 * f64::from(i), 0.8 * f64::from(j));
                let (here, there) = (texture.height(x, y), texture.height(x, y + distance));
                product += here * there;
                square += here * here;
            }
        }
        product / square
    };
    let found = [0.1, 0.4, 0.8, 1.6].map(correlation);
    println!("{found:.3?}");
    assert!(found[0] > 0.95 && (0.4..0.8).contains(&found[1]));
    assert!(found[2].abs() < 0.1 && found[3].abs() < 0.1);
}

#[test]
fn over_noise_the_motion_becomes_that_of_one_coordinate_as_the_spring_across_stiffens() {
    let difference = |stiffness: f64| {
        let mut scenario = noisy(Some(0.7));
        scenario.stiffness_across = stiffness;
        beside_one_coordinate(&scenario, &run(&scenario).unwrap().trajectory)
    };
    let differences = [200.0, 400.0, 800.0, 1600.0].map(difference);
    for pair in differences.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        println!("{differences:?} {order:.3}");
        assert!((order - 1.0).abs() < 0.06, "{order}");
    }
}

#[test]
fn a_run_over_noise_taken_up_again_is_the_same() {
    let scenario = noisy(Some(0.7));
    let whole = run(&scenario).unwrap().trajectory;
    for interrupted in [0, 1, 17, 60, 100] {
        let mut running = PlanarRunning::new(&scenario).unwrap();
        for _ in 0..interrupted {
            running.step().unwrap();
        }
        let mut state = State::default();
        running.save(&mut state);
        let mut resumed = PlanarRunning::resumed(&scenario, &mut state.reader()).unwrap();
        let rest: Vec<_> = std::iter::from_fn(|| resumed.step().unwrap()).collect();
        assert_eq!(rest, whole.steps()[interrupted..], "{interrupted}");
    }
}

#[test]
fn tables_that_are_none_are_refused() {
    let axis = |n: usize| (0..n).map(|i| i as f64).collect::<Vec<_>>();
    let wrong = [
        HeightTable::new(axis(2), axis(4), vec![0.0; 8]),
        HeightTable::new(axis(4), axis(2), vec![0.0; 8]),
        HeightTable::new(axis(3), axis(3), vec![0.0; 8]),
        HeightTable::new(vec![0.0, 0.0, 1.0], axis(3), vec![0.0; 9]),
        HeightTable::new(axis(3), axis(3), vec![f64::NAN; 9]),
    ];
    assert!(wrong.iter().all(Result::is_err), "{wrong:?}");
}
