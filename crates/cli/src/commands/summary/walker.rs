//! The summary of a walker.

use super::{Summary, again, digits};
use crate::commands::job::Product;
use stickslip::{CircleDocument, OrbitDocument, WalkerDocument, WalkerRegime};

/// Number of significant digits of a speed or radius.
const DIGITS: usize = 10;
/// Largest number of orbits in a summary.
const ORBITS: usize = 12;

impl Product for WalkerDocument {
    fn summary(&self) -> Summary {
        let motion = match (self.regime, &self.circle) {
            (WalkerRegime::Circling, Some(circle)) => {
                format!("circling, radius {}", digits(circle.radius, DIGITS))
            }
            (WalkerRegime::Resting, _) => "resting".into(),
            (WalkerRegime::Straight, _) => {
                format!("walking straight on, speed {}", digits(self.speed, DIGITS))
            }
            _ => "irregular".into(),
        };
        let end = self.samples.t.last().copied().unwrap_or_default();
        let work = &self.work;
        let headline = format!(
            "{motion}: t = {} reached in {} steps with {} directions, {:.1} ms",
            digits(end, DIGITS),
            work.steps,
            work.directions,
            1e3 * work.seconds
        );
        let speed = |speed: f64| format!("{} kσ/Γ", digits(speed, DIGITS));
        let circle = self.circle.as_ref();
        let omega = |circle: &CircleDocument| format!("{} k/Γ", digits(circle.omega, DIGITS));
        let summary = Summary::new(headline)
            .row("speed of a free walker", speed(self.free_speed))
            .row("speed", speed(self.speed))
            .maybe("angular frequency", circle.map(omega))
            .maybe("distance from the circle", circle.map(|c| format!("{:.1e} σ", c.deviation)));
        let orbits = self.orbits.iter().flatten().take(ORBITS);
        orbits
            .fold(summary, tell)
            .remarks(&self.remarks)
            .next(again("-o walker.json --plot walker.svg"))
    }
}

fn tell(summary: Summary, orbit: &OrbitDocument) -> Summary {
    let state = match orbit.stable {
        Some(true) => ", stable",
        Some(false) => ", unstable",
        None => "",
    };
    let radius = digits(orbit.radius, DIGITS);
    summary.row(
        "circular orbit",
        format!("radius {radius} σ, ω = {} k/Γ{state}", digits(orbit.omega, DIGITS)),
    )
}
