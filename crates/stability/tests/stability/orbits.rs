//! Circular orbits of walkers: by quadrature of the equation of motion, by runs, and in the limit of long memory.

use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use stickslip_stability::orbits;
use stickslip_tip::walker::{WalkerPast, WalkerScenario, run};

/// ∫ J1(2ρ sin(ωτ/2)) (cos, sin)(ωτ/2) e^{-τ/T}dτ, and what is missing in the balance of forces along the orbit and towards
/// its center.
fn imbalance(scenario: &WalkerScenario, radius: f64, frequency: f64) -> [f64; 2] {
    let rule = GaussLegendre::new(const { NonZeroUsize::MIN.saturating_add(19) });
    let time = scenario.healing_time;
    let length = (0.5 / (radius * frequency.abs())).min(time);
    let mut field = [0.0; 2];
    let panels = (40.0 * time / length) as usize;
    for panel in 0..panels {
        for (node, weight) in rule.as_node_weight_pairs() {
            let tau = length * (panel as f64 + 0.5 * (1.0 + node));
            let (sin, cos) = (0.5 * frequency * tau).sin_cos();
            let part = 0.5 * length * weight * libm::j1(2.0 * radius * sin) * (-tau / time).exp();
            field[0] -= scenario.alpha * part * cos;
            field[1] -= scenario.alpha * part * sin;
        }
    }
    let speed = radius * frequency;
    let inertia = scenario.inertia.unwrap_or(0.0) * speed * frequency;
    [field[0] - speed, inertia + field[1] + scenario.rotation * speed - scenario.trap * radius]
}

fn walker(alpha: f64, healing_time: f64, rotation: f64, trap: f64) -> WalkerScenario {
    WalkerScenario { rotation, trap, ..WalkerScenario::new(alpha, healing_time, 1.0) }
}

fn cases() -> Vec<WalkerScenario> {
    vec![
        walker(-3.0, 1.0, 0.2, 0.0),
        walker(-3.0, 1.0, 0.0, 0.15),
        walker(-0.5, 6.0, -0.12, 0.0),
        WalkerScenario { inertia: Some(0.8), ..walker(-2.5, 1.5, 0.3, 0.1) },
    ]
}

#[test]
fn forces_on_orbits_balance() {
    for scenario in cases() {
        let found = orbits(&scenario, 14.0);
        assert!(!found.is_empty());
        for orbit in found {
            let [along, inward] = imbalance(&scenario, orbit.radius, orbit.frequency);
            println!("{:.6} {:.6}: {along:.1e} {inward:.1e}", orbit.radius, orbit.frequency);
            assert!(along.abs() < 1e-11 && inward.abs() < 1e-11, "{along:e} {inward:e}");
        }
    }
}

/// A run that starts on an orbit, displaced by 1e-6, leaves it at the rate of the leading exponent if it is unstable, and
/// comes back to a circle of its radius if it is stable.
#[test]
fn runs_grow_as_their_exponents() {
    let (mut stable, mut unstable) = (0, 0);
    for scenario in cases() {
        for orbit in orbits(&scenario, 9.0) {
            let until = 30.0 * scenario.healing_time;
            let run = run(&WalkerScenario {
                past: WalkerPast::Circle(orbit.frequency),
                position: [orbit.radius, 0.0],
                kick: [1e-6, 0.0],
                velocity: [0.0, orbit.radius * orbit.frequency],
                until,
                tolerance: 1e-13,
                ..scenario.clone()
            })
            .unwrap();
            // The deviation in the frame that turns with the orbit, without the neutral shifts.
            let deviation = |t: f64| {
                let [x, y] = run.trajectory.position(t);
                let [u, v] = run.trajectory.velocity(t);
                x.hypot(y).max(1e-300) - orbit.radius + (u.hypot(v) - orbit.speed())
            };
            let size = |from: f64| {
                let times = (0..400).map(|i| from + 0.025 * scenario.healing_time * f64::from(i));
                times.map(|t| deviation(t).abs()).fold(0.0, f64::max)
            };
            let grown = size(until - 10.0 * scenario.healing_time);
            match orbit.unstable_count(&scenario).unwrap() {
                0 => {
                    stable += 1;
                    assert!(grown < 1e-5, "{} {grown:e}", orbit.radius);
                }
                _ => {
                    let rate = orbit.exponents.as_ref().unwrap()[0].re;
                    if rate * until > 9.0 {
                        unstable += 1;
                        assert!(grown > 1e-4, "{} {rate} {grown:e}", orbit.radius);
                    }
                }
            }
        }
    }
    println!("{stable} stable, {unstable} unstable");
    assert!(stable >= 4 && unstable >= 1, "{stable} {unstable}");
}

/// With a long memory the orbits in a weak trap lie at the zeros of J0 and J1.
#[test]
fn orbits_of_a_long_memory_are_quantised() {
    // Zeros of J0 and of J1 (Abramowitz and Stegun, table 9.5).
    let zeros = [2.404_826, 3.831_706, 5.520_078, 7.015_587, 8.653_728, 10.173_468];
    let far = |time: f64| {
        let found = orbits(&walker(-4.0 / time, time, 0.0, 1e-4), 11.0);
        assert_eq!(found.len(), zeros.len(), "{found:?}");
        let away = found.iter().zip(zeros).map(|(orbit, zero)| (orbit.radius - zero).abs());
        away.fold(0.0, f64::max)
    };
    let away = [far(30.0), far(60.0), far(120.0)];
    println!("{away:?}");
    assert!(away[2] < 0.05 && away[2] < away[1] && away[1] < away[0], "{away:?}");
}

/// Large orbits in a slow rotation are those of a particle with a mass that its field lends it: ρ → v M/Ω with v its free
/// speed and M = -αT³/(2 (1 + v²T²)^{3/2}).
#[test]
fn large_orbits_are_those_of_a_particle_with_a_mass() {
    let mut errors = vec![];
    for rotation in [0.02, 0.01, 0.005] {
        let scenario = walker(-3.0, 1.0, rotation, 0.0);
        let speed = scenario.free_speed();
        let mass = 1.5 / (1.0 + speed * speed).powf(1.5);
        let radius = speed * mass / rotation;
        let found = orbits(&scenario, 2.0 * radius);
        let nearest = found.iter().map(|o| (o.radius - radius).abs()).fold(f64::INFINITY, f64::min);
        errors.push(nearest / radius);
    }
    println!("{errors:?}");
    assert!(errors[2] < 2e-3 && errors[2] < 0.5 * errors[1], "{errors:?}");
}

#[test]
fn a_particle_that_does_not_walk_has_no_orbits() {
    assert!(orbits(&walker(-1.9, 1.0, 0.3, 0.0), 9.0).is_empty());
}
