//! Tips without a spring: at rest, on a steady walk, or neither.

use super::*;
use crate::Drift;
use crate::rest::Rest;
use stickslip_stability::{Spectrum, walk, walking_speeds};
use stickslip_tip::TipFunction;

/// A tip drifts if its velocity is within this relative distance of that of a steady walk.
const DRIFTS: f64 = 1e-3;
/// Without theory a tip drifts if its velocity changes by less than this fraction in the last fifth of the run.
const UNCHANGED: f64 = 1e-4;
/// Error of a velocity in units of the tolerance: velocities are one order less accurate than positions.
const VELOCITY_ERROR: f64 = 10.0;
/// Number of times at which the velocity is evaluated.
const LOOKS: u32 = 1000;
/// Relative error of the speed of a steady walk.
const SPEED_ERROR: f64 = 1e-12;
/// Number of leading growth exponents: one is that of a shift, and two may be a pair.
const ROOTS: usize = 3;

/// Stability of the steady motions of a tip without a spring.
enum Theory {
    /// The stable steady motion whose velocity is nearest.
    Nearest(Attractor),
    /// No steady motion is stable.
    None,
    /// Their stability is not known.
    Unknown,
}

/// A stable steady motion without a spring, with the rate at which deviations from it decay.
struct Attractor {
    velocity: f64,
    rate: f64,
    error: f64,
}

impl End<'_> {
    /// A tip that nothing drags: at rest, on a walk with one velocity, or neither.
    pub(super) fn without_spring(&self) -> Outcome {
        if self.force_acts() {
            return Outcome::transient(None, None).remarked(Remark::ForceActs);
        }
        match self.attractor() {
            Theory::Nearest(attractor) => self.beside(&attractor),
            Theory::None => Outcome::transient(None, None),
            Theory::Unknown => self.unchanged(),
        }
    }

    fn beside(&self, &Attractor { velocity, rate, error }: &Attractor) -> Outcome {
        let walks = velocity.abs() > 0.0;
        let near = if walks { DRIFTS * velocity.abs() } else { self.observer.near_steady() };
        let (farthest, now) = self.off(velocity);
        if farthest <= near {
            return if walks { self.drifts(now + error) } else { Outcome::settled(Regime::Steady) };
        }
        if walks && now > BESIDE * velocity.abs() {
            return Outcome::transient(None, None);
        }
        let towards = if walks { Regime::Drifting } else { Regime::Steady };
        let share = STEADY_SHARE / (1.0 - STEADY_SHARE) * (self.last.end() - self.start());
        let time = (now / near).ln().max(0.0) / rate + share;
        Outcome::transient(Some(towards), Some(time))
    }

    /// The largest distance of the velocity from `from` in the last fifth of the run, and the distance at the end. Steps
    /// that are no longer kept are left out.
    fn off(&self, from: f64) -> (f64, f64) {
        let end = self.last.end();
        let begin = (end - STEADY_SHARE * (end - self.start())).max(self.tail.start());
        let at =
            |i: u32| self.tail.velocity(begin + (end - begin) * f64::from(i) / f64::from(LOOKS));
        let off = (0..LOOKS).map(at).map(|v| (v - from).abs()).fold(0.0, f64::max);
        let now = (self.last.velocity(end) - from).abs();
        (off.max(now), now)
    }

    /// A walk with the velocity at the end of the run, which has this error.
    fn drifts(&self, error: f64) -> Outcome {
        let velocity = self.last.velocity(self.last.end());
        let velocity_error = error + VELOCITY_ERROR * self.scenario.tolerance;
        let drifting = Some(Drift { velocity, velocity_error });
        Outcome { drifting, ..Outcome::settled(Regime::Drifting) }
    }

    /// Without theory: a walk if the velocity no longer changes.
    fn unchanged(&self) -> Outcome {
        let now = self.last.velocity(self.last.end());
        let (change, _) = self.off(now);
        if change > UNCHANGED * now.abs() || now.abs() <= self.observer.near_steady() {
            return Outcome::transient(None, None);
        }
        self.drifts(2.0 * change)
    }

    fn attractor(&self) -> Theory {
        let Scenario { model, .. } = self.scenario;
        // A past that never ends has no steady motion.
        let endless = *model.tip() == TipFunction::Cosine && model.wider().healing_time.is_none();
        if endless || stop::is_requested() {
            return Theory::Unknown;
        }
        let now = self.last.velocity(self.last.end());
        let rest = Rest::of(model).rate(self.last.end() - self.start());
        let rest = (rest < 0.0).then_some(Attractor { velocity: 0.0, rate: -rest, error: 0.0 });
        let Ok(speeds) = walking_speeds(model) else { return Theory::Unknown };
        let off = |speed: &f64| (speed - now.abs()).abs();
        let nearest = speeds.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let walking = match nearest.map(|speed| walk(model, speed, ROOTS)) {
            Some(Err(_)) => return Theory::Unknown,
            Some(Ok(walk)) => decay(&walk.spectrum).map(|rate| {
                let velocity = walk.speed.copysign(now);
                Attractor { velocity, rate, error: SPEED_ERROR * walk.speed }
            }),
            None => None,
        };
        let off = |a: &Attractor| (a.velocity - now).abs();
        let nearest = rest.into_iter().chain(walking).min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.map_or(Theory::None, Theory::Nearest)
    }
}

/// The rate at which deviations from a walk decay, except a shift along the scan; `None` if one of them grows.
fn decay(spectrum: &Spectrum) -> Option<f64> {
    let error = spectrum.certificate.largest_error;
    let shift = spectrum.roots.iter().map(|z| z.norm()).fold(f64::INFINITY, f64::min);
    let others = spectrum.roots.iter().filter(|z| z.norm() > shift);
    let slowest = others.map(|z| z.re).fold(f64::NEG_INFINITY, f64::max);
    (slowest < -error).then_some(-slowest)
}
