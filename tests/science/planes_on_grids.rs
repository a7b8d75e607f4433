//! Lines of a tip that is free across the scan (`stickslip_tip::planar`) against the full equations on cells of a plane
//! (`stickslip_grid::solve_plane`), which shares no code with them; that grid's own tests are in its crate.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use stickslip_grid::{
    Gaussian, Path, PlaneMethod, PlaneProblem, PlaneRequest, PlaneStart, Product, Stepping,
    solve_plane,
};
use stickslip_tip::planar::{PlanarScenario, run};
use stickslip_tip::{Footprint, Force, Model, Pulse, Scenario, SupportPath, TipFunction, Wider};

/// Spacing at which the lattice of Gaussians is exact to round-off.
const EXACT: PlaneMethod = PlaneMethod::Spectral { spacing: PI / 8.7 };

struct Case {
    name: &'static str,
    beta: f64,
    width_y: f64,
    alpha: f64,
    stiffness_across: f64,
    wider: Wider,
    path: Option<(Vec<f64>, Vec<f64>)>,
}

/// A pulse on the tip, across its line.
const PUSH: Pulse = Pulse { amplitude: 1.2, time: 21.0, width: 1.1 };
/// Displacements of the tip at the start.
const KICKS: [f64; 2] = [0.05, 0.2];
const UNTIL: f64 = 32.0;

fn scenario(case: &Case) -> PlanarScenario {
    let along = TipFunction::triple_gaussian(case.beta, 1.0).unwrap();
    let tip = TipFunction::of_footprint(Footprint::separable(along, case.width_y).unwrap());
    let model = Model::under(case.wider, tip, case.alpha, 1.0).unwrap();
    let path = case.path.clone().map(|(t, r)| SupportPath::new(t, r).unwrap());
    let until = path.as_ref().map_or(UNTIL, |_| 16.0);
    let along = Scenario { kick: KICKS[0], tolerance: 1e-11, path, ..Scenario::new(model, until) };
    PlanarScenario {
        kick_across: KICKS[1],
        force_across: Force::new(vec![PUSH], None).unwrap(),
        ..PlanarScenario::new(along, case.stiffness_across)
    }
}

/// Positions on the grid at these times.
fn on_cells(
    case: &Case,
    scenario: &PlanarScenario,
    (method, stepping): (&PlaneMethod, &Stepping),
    times: &[f64],
) -> Vec<[f64; 2]> {
    let bell = |amplitude, center, width| Gaussian { amplitude, center, width };
    let lobe = |center| bell(-0.5 * case.beta, center, 1.0);
    let along = vec![bell(1.0, 0.0, 1.0), lobe(2.0), lobe(-2.0)];
    let products = [Product { along, across: vec![bell(1.0, 0.0, case.width_y)] }];
    let support = scenario.along.support();
    let position = |t: f64| support.position(t);
    let knots = case.path.as_ref().map_or(&[][..], |(t, _)| t);
    let path = case.path.is_some().then_some(Path { position: &position, knots });
    let Wider { healing_time, inertia, .. } = case.wider;
    let inertia = inertia.map(|mass| (mass, 1.0));
    let wider = stickslip_grid::Wider { healing_time, inertia, path, ..Default::default() };
    let start = PlaneStart::steady(&wider, (case.alpha, 1.0), &products, 14.0)
        .displaced([-KICKS[0], KICKS[1]]);
    let push = |t: f64| PUSH.amplitude * (-0.5 * ((t - PUSH.time) / PUSH.width).powi(2)).exp();
    let problem = PlaneProblem {
        model: (case.alpha, 1.0),
        stiffness_across: case.stiffness_across,
        line: 0.0,
        products: &products,
        wider,
        force: &|t| [0.0, push(t)],
        start,
    };
    let request = PlaneRequest { times, points: &[] };
    let go_on = &mut |_: f64, _: [f64; 2]| ControlFlow::Continue(());
    solve_plane(&problem, method, stepping, &request, go_on).unwrap().position
}

/// Largest distance of the grid's positions from those of the run, along and across.
fn distances(case: &Case, method: &PlaneMethod, stepping: &Stepping) -> [f64; 2] {
    let scenario = scenario(case);
    let (start, until) = (scenario.along.start_time(), scenario.along.until);
    let times: Vec<f64> = (1..=60).map(|k| start + (until - start) * f64::from(k) / 60.0).collect();
    let run = run(&scenario).unwrap();
    let grid = on_cells(case, &scenario, (method, stepping), &times);
    let mut worst = [0.0; 2];
    for (t, [x, y]) in times.iter().zip(grid) {
        worst[0] = f64::max(worst[0], (run.trajectory.x0(*t) - x).abs());
        worst[1] = f64::max(worst[1], (run.trajectory.y0(*t) - y).abs());
    }
    worst
}

fn cases() -> Vec<Case> {
    let plain = Wider::default();
    let case = |name, beta, width_y, alpha, stiffness_across, wider| Case {
        name,
        beta,
        width_y,
        alpha,
        stiffness_across,
        wider,
        path: None,
    };
    let heavy = Wider { healing_time: Some(8.0), inertia: Some(0.5), ..plain };
    let back = (vec![0.0, 5.0, 11.0, 16.0], vec![0.0, 5.0, -1.0, 4.0]);
    vec![
        case("snaking", 1.0, 1.0, 1.2, 0.25, plain),
        case("Gaussian, wider across", 0.0, 1.4, 1.5, 0.5, plain),
        case("inertia and healing", 1.0, 0.8, 1.6, 0.4, heavy),
        Case { path: Some(back), ..case("there and back", 1.0, 1.0, 1.2, 0.3, plain) },
    ]
}

/// To 2e-11 with cells that are exact to round-off; 5e-13 to 1.2e-12 was measured.
#[test]
fn lines_are_those_of_the_full_equations_in_the_plane() {
    for case in cases() {
        let [x, y] = distances(&case, &EXACT, &Stepping::absolute(1e-12));
        println!("{}: {x:.1e} {y:.1e}", case.name);
        assert!(x < 2e-11 && y < 2e-11, "{}: {x:e} {y:e}", case.name);
    }
}

/// Cells of heights come to the closed equations at their order, which is 2.
#[test]
fn cells_of_heights_come_to_the_closed_equations() {
    let case = &cases()[1];
    let errors = [0.2, 0.1, 0.05].map(|spacing| {
        let method = PlaneMethod::ThreePoint { spacing: [spacing; 2] };
        let [x, y] = distances(case, &method, &Stepping::fixed(0.05));
        x.max(y)
    });
    let orders = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
    println!("{errors:?}, orders {orders:?}");
    assert!(orders.iter().all(|p| (1.8..2.2).contains(p)), "{orders:?}, {errors:?}");
}
