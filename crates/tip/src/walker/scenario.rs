//! Scenarios of walkers, and errors in them.

use crate::Force;
use thiserror::Error;

/// A walker: the parameters of its equation, its past and its start at t = 0. Lengths are in 1/k, with k the wave number
/// of the field.
#[derive(Debug, Clone)]
pub struct WalkerScenario {
    /// α, below 0 for a particle that its field drives.
    pub alpha: f64,
    /// T, the time in which the field decays.
    pub healing_time: f64,
    /// Inertia M; `None` without inertia.
    pub inertia: Option<f64>,
    /// Ω, the coefficient of the Coriolis force -Ω ẑ × x'.
    pub rotation: f64,
    /// K, the constant of the harmonic trap about the origin.
    pub trap: f64,
    /// External force along x and along y.
    pub force: [Force; 2],
    /// The motion before t = 0, which ends at `position`.
    pub past: WalkerPast,
    /// Position at the end of the past.
    pub position: [f64; 2],
    /// Displacement of the particle, but not of its field, at t = 0.
    pub kick: [f64; 2],
    /// Velocity at t = 0 of a particle with inertia.
    pub velocity: [f64; 2],
    /// Time at which the run ends.
    pub until: f64,
    /// Target for the error of the position per unit of time.
    pub tolerance: f64,
}

/// The motion before the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WalkerPast {
    /// None: the field is 0.
    Flat,
    /// Straight motion with this velocity for infinite time.
    Straight([f64; 2]),
    /// Motion on a circle about the origin with this angular frequency, for infinite time.
    Circle(f64),
}

/// Errors of a run of a walker.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WalkerError {
    /// α is not finite.
    #[error("alpha must be a finite number, not {0:?}")]
    Alpha(f64),
    /// T is not a finite number above 0.
    #[error(
        "a walker needs a healing time, the time in which its field decays, a finite number above 0, not {0:?}"
    )]
    HealingTime(f64),
    /// M is not a finite number above 0.
    #[error("the inertia must be a finite number above 0, not {0:?}")]
    Inertia(f64),
    /// Ω is not finite.
    #[error("the rotation must be a finite number, not {0:?}")]
    Rotation(f64),
    /// K is not a finite number of at least 0.
    #[error("the stiffness of the trap must be a finite number, 0 or above, not {0:?}")]
    Trap(f64),
    /// A position, a velocity or a frequency at the start is not finite.
    #[error("the start must be given by finite numbers, not {0:?}")]
    Start(f64),
    /// The end is not after the start.
    #[error("a walker starts at t = 0, and its run must end after that, not at {0:?}")]
    Until(f64),
    /// The tolerance is out of its range.
    #[error("the tolerance must be from 1e-13 to 1e-2, not {0:?}")]
    Tolerance(f64),
    /// A force that is a function of time has no series.
    #[error("a walker takes forces as pulses or tables, not as functions of time")]
    Force,
    /// The memory is too long for the available number of directions.
    #[error(
        "at t = {t} the walker moves by {range} within the memory of its field, farther than 8192 directions can resolve"
    )]
    Range {
        /// Time reached.
        t: f64,
        /// Distance VT of the motion in the healing time T.
        range: f64,
    },
    /// The step is lost in round-off.
    #[error("at t = {t} the step is lost in round-off: the motion is too stiff or not finite")]
    Step {
        /// Time reached.
        t: f64,
    },
    /// The history is longer than a run keeps.
    #[error("the history would be longer than {steps} steps at t = {t}")]
    TooLong {
        /// Time reached.
        t: f64,
        /// Largest number of steps.
        steps: usize,
    },
}

impl WalkerScenario {
    /// A free walker without inertia on a flat field at the origin, to a tolerance of 1e-9.
    pub fn new(alpha: f64, healing_time: f64, until: f64) -> Self {
        Self {
            alpha,
            healing_time,
            inertia: None,
            rotation: 0.0,
            trap: 0.0,
            force: [Force::default(), Force::default()],
            past: WalkerPast::Flat,
            position: [0.0; 2],
            kick: [0.0; 2],
            velocity: [0.0; 2],
            until,
            tolerance: 1e-9,
        }
    }

    /// The speed of a free walker in steady motion, which does not depend on its inertia: v² = (2B - 1 - √(1 +
    /// 4B))/(2T²) with B = -αT² (Oza, Rosales and Bush 2013); 0 up to B = 2.
    pub fn free_speed(&self) -> f64 {
        let b = -self.alpha * self.healing_time * self.healing_time;
        let square = if b > 2.0 { 0.5 * (2.0 * b - 1.0 - (1.0 + 4.0 * b).sqrt()) } else { 0.0 };
        square.sqrt() / self.healing_time
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn validate(&self) -> Result<(), WalkerError> {
        let above_0 = |value: f64| value.is_finite() && value > 0.0;
        if !self.alpha.is_finite() {
            return Err(WalkerError::Alpha(self.alpha));
        }
        if !above_0(self.healing_time) {
            return Err(WalkerError::HealingTime(self.healing_time));
        }
        if let Some(mass) = self.inertia.filter(|mass| !above_0(*mass)) {
            return Err(WalkerError::Inertia(mass));
        }
        if !self.rotation.is_finite() {
            return Err(WalkerError::Rotation(self.rotation));
        }
        if !(self.trap.is_finite() && self.trap >= 0.0) {
            return Err(WalkerError::Trap(self.trap));
        }
        let past = match self.past {
            WalkerPast::Flat => [0.0; 2],
            WalkerPast::Straight(velocity) => velocity,
            WalkerPast::Circle(frequency) => [frequency, 0.0],
        };
        let numbers = [self.position, self.kick, self.velocity, past];
        if let Some(number) = numbers.iter().flatten().find(|number| !number.is_finite()) {
            return Err(WalkerError::Start(*number));
        }
        if !above_0(self.until) {
            return Err(WalkerError::Until(self.until));
        }
        if !(1e-13..=1e-2).contains(&self.tolerance) {
            return Err(WalkerError::Tolerance(self.tolerance));
        }
        Ok(())
    }

    /// The largest speed known before the run: before t = 0, at t = 0, or of a free walker.
    pub(super) fn known_speed(&self) -> f64 {
        let size = |[x, y]: [f64; 2]| crate::elementary::hypot(x, y);
        let past = match self.past {
            WalkerPast::Flat => 0.0,
            WalkerPast::Straight(velocity) => size(velocity),
            WalkerPast::Circle(frequency) => frequency.abs() * size(self.position),
        };
        past.max(self.free_speed()).max(size(self.velocity))
    }
}
