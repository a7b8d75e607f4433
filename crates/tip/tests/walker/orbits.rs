//! Circular orbits: radius and frequency by quadrature of the equation of motion on a circle,
//!
//! ```text
//!     tangential:  rω = -α ∫ J1(2r sin(ωτ/2)) cos(ωτ/2) e^{-τ/T}dτ
//!     radial:      -M rω² = -α ∫ J1(2r sin(ωτ/2)) sin(ωτ/2) e^{-τ/T}dτ + Ω rω - K r
//! ```

use crate::gauss::rule;
use stickslip_tip::walker::{WalkerPast, WalkerScenario, run};

/// Tangential and radial force of the field on a circle.
fn forces(scenario: &WalkerScenario, radius: f64, frequency: f64) -> [f64; 2] {
    let (rule, healing) = (rule(20), scenario.healing_time);
    // Panels so short that the phase changes by less than 1 within each.
    let length = (0.5 / (radius * frequency)).min(healing);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let panels = (40.0 * healing / length) as usize;
    let mut sums = [0.0; 2];
    for panel in 0..panels {
        for (x, w) in &rule {
            let tau = length * (panel as f64 + x);
            let (sin, cos) = (0.5 * frequency * tau).sin_cos();
            let part = length * w * libm::j1(2.0 * radius * sin) * (-tau / healing).exp();
            sums[0] -= scenario.alpha * part * cos;
            sums[1] -= scenario.alpha * part * sin;
        }
    }
    sums
}

/// The frequency at which the tangential forces on a circle balance.
fn frequency(scenario: &WalkerScenario, radius: f64) -> f64 {
    let (mut low, mut high) = (1e-3 / radius, 4.0 * scenario.alpha.abs().sqrt() / radius);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let drives = forces(scenario, radius, middle)[0] > radius * middle;
        *(if drives { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// A walker on the orbit of this radius, with the rotation or the trap that it needs; the number of turns.
fn on_orbit(
    base: &WalkerScenario,
    radius: f64,
    is_trapped: bool,
    turns: f64,
) -> (WalkerScenario, f64) {
    let omega = frequency(base, radius);
    let inward = forces(base, radius, omega)[1]
        + base.inertia.map_or(0.0, |mass| mass * radius * omega * omega);
    let (rotation, trap, frequency) = if is_trapped {
        (0.0, inward / radius, omega)
    } else {
        (inward / (radius * omega), 0.0, -omega)
    };
    let until = turns * std::f64::consts::TAU / omega;
    let scenario = WalkerScenario {
        rotation,
        trap,
        past: WalkerPast::Circle(frequency),
        position: [radius, 0.0],
        velocity: [0.0, radius * frequency],
        until,
        tolerance: 1e-11,
        ..base.clone()
    };
    (scenario, frequency)
}

/// Orbits stay on the circle of theory, at the phase of theory, over 100 turns.
#[test]
fn orbits_stay_on_the_circle_of_theory() {
    let base = WalkerScenario::new(-3.0, 1.0, 1.0);
    let heavy = WalkerScenario { inertia: Some(0.5), ..base.clone() };
    let remembers = WalkerScenario::new(-1.2, 2.5, 1.0);
    for (name, base, radius, is_trapped) in [
        ("rotation", &base, 2.0, false),
        ("rotation, wide", &base, 5.0, false),
        ("trap", &base, 1.2, true),
        ("heavy, rotation", &heavy, 1.5, false),
        ("heavy, trap", &heavy, 2.5, true),
        ("long memory, trap", &remembers, 1.0, true),
    ] {
        let (scenario, frequency) = on_orbit(base, radius, is_trapped, 100.0);
        let run = run(&scenario).unwrap();
        let (mut off, mut behind) = (0.0_f64, 0.0_f64);
        for i in 0..=2000 {
            let t = scenario.until * f64::from(i) / 2000.0;
            let [x, y] = run.trajectory.position(t);
            let (sin, cos) = (frequency * t).sin_cos();
            off = off.max((x.hypot(y) - radius).abs());
            behind = behind.max((x * sin - y * cos).abs());
        }
        let steps = run.trajectory.steps().len();
        println!(
            "{name}: Ω {:.6} K {:.6}, radius {off:.1e}, phase {behind:.1e}, {steps} steps, {} directions",
            scenario.rotation, scenario.trap, run.directions
        );
        assert!(off < 1e-11 && behind < 1e-9, "{name}: {off:e} {behind:e}");
    }
}
