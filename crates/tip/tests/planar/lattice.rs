//! Runs on the lattice alone, the second opinion on runs by exponentials and series.

use super::lines::{differences, line, problem, tip};
use stickslip_tip::Wider;
use stickslip_tip::planar::{PlanarRun, PlanarRunning, PlanarScenario, Trajectory, run};

fn on_lattice(scenario: &PlanarScenario) -> PlanarRun {
    let mut running = PlanarRunning::on_lattice(scenario).unwrap();
    let steps = std::iter::from_fn(|| running.step().unwrap()).collect();
    let (work, layers) = (running.work(), running.layers());
    let along = &scenario.along;
    let trajectory = Trajectory::new(*along.model.wider(), along.support(), steps);
    PlanarRun { trajectory, work, layers, interrupted: false }
}

/// The oracle sums over all visits, without lattice, layers, exponentials or series. A run by exponentials is as near,
/// but with other errors.
#[test]
fn runs_on_the_lattice_are_those_of_the_reference() {
    for (name, beta, alpha, stiffness, wider) in [
        ("snaking", 1.0, 1.2, 0.25, Wider::default()),
        ("Gaussian", 0.0, 2.2, 0.3, Wider::default()),
        (
            "depth limit, inertia and healing",
            1.0,
            1.6,
            0.3,
            Wider {
                depth_limit: Some(2.0),
                inertia: Some(0.4),
                healing_time: Some(8.0),
                ..Wider::default()
            },
        ),
    ] {
        let scenario = line((tip(beta, 1.0), wider), alpha, stiffness, [0.05, 0.2], 36.0);
        let motion = problem(&scenario, (beta, 1.0)).motion(36.0, 300);
        let [by_modes, by_lattice] = [run(&scenario).unwrap(), on_lattice(&scenario)];
        let [x, y] = differences(&by_lattice, &motion);
        println!("{name}: {x:.1e} {y:.1e}, {:?}, by modes {:?}", by_lattice.work, by_modes.work);
        assert!(x < 5e-9 && y < 5e-9, "{name}: {x:e} {y:e}");
        assert!(by_modes.work.series > 0 && by_lattice.work.series == 0, "{name}");
        assert!(by_lattice.trajectory != by_modes.trajectory, "{name}");
    }
}
