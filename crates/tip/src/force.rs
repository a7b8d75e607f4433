//! The external force Fext(t) of (9), (10), in units of kσ.

use crate::elementary::exp;
use crate::series::checked;
use crate::spline::{CubicSpline, Ends, next_knot};
use std::fmt;
use std::sync::Arc;
use thiserror::Error;

/// A pulse, amplitude · exp(-(t-time)²/(2 width²)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "PulseParameters"))]
pub struct Pulse {
    /// Largest force, in kσ.
    pub amplitude: f64,
    /// Time of the largest force, in Γ/k.
    pub time: f64,
    /// Standard deviation in time, in Γ/k.
    pub width: f64,
}

/// Errors in a force.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ForceError {
    /// A pulse contains a number that is not finite.
    #[error("the pulse {0:?} has an entry that is not a finite number")]
    PulseNotFinite(Pulse),
    /// The width of a pulse is not positive.
    #[error("the pulse {0:?} needs a width above 0")]
    PulseWidth(Pulse),
    /// The table is not a function of time.
    #[error("the force table: {0}")]
    Table(#[from] crate::series::SeriesError),
}

/// An external force: the sum of pulses, a table and, for tests and manufactured solutions, a function.
#[derive(Clone, Default)]
pub struct Force {
    pulses: Vec<Pulse>,
    table: Option<CubicSpline>,
    function: Option<Arc<dyn Fn(f64) -> f64 + Send + Sync>>,
}

impl fmt::Debug for Force {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Force")
            .field("pulses", &self.pulses)
            .field("table", &self.table)
            .field("function", &self.function.is_some())
            .finish()
    }
}

/// Cut-off of a pulse, in widths: exp(-10²/2) = 2e-22.
const WIDTHS_OF_PULSE: f64 = 10.0;
/// Longest step within a pulse, in widths of the pulse, so that no step skips it.
const WIDTHS_PER_STEP: f64 = 1.5;

impl Pulse {
    /// Whether the pulse acts immediately after t.
    fn acts_after(&self, t: f64) -> bool {
        self.begins() <= t && t < self.ends()
    }

    /// The time before which the pulse is 0.
    fn begins(&self) -> f64 {
        self.time - WIDTHS_OF_PULSE * self.width
    }

    /// The time after which the pulse is 0.
    fn ends(&self) -> f64 {
        self.time + WIDTHS_OF_PULSE * self.width
    }

    /// Adds the Taylor coefficients of the pulse F about t, from `W² F' = -(t - T) F`.
    fn add_series(&self, t: f64, coefficients: &mut [f64]) {
        let z = (t - self.time) / self.width;
        let (mut before, mut here) = (0.0, self.amplitude * libm::exp(-0.5 * z * z));
        let slowness = 1.0 / (self.width * self.width);
        for (k, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient += here;
            let next = -slowness * ((t - self.time) * here + before) / (k + 1) as f64;
            (before, here) = (here, next);
        }
    }
}

impl Force {
    /// A sum of Gaussian pulses and, if given, the cubic spline through a table (t, force), 0 outside.
    ///
    /// # Errors
    /// An entry is not finite, a width is not positive, or the table is too short or not sorted by time.
    pub fn new(
        pulses: Vec<Pulse>,
        table: Option<(Vec<f64>, Vec<f64>)>,
    ) -> Result<Self, ForceError> {
        for pulse in &pulses {
            if ![pulse.amplitude, pulse.time, pulse.width].iter().all(|v| v.is_finite()) {
                return Err(ForceError::PulseNotFinite(*pulse));
            }
            if pulse.width <= 0.0 {
                return Err(ForceError::PulseWidth(*pulse));
            }
        }
        let table = table.map(|(t, force)| checked(t, force)).transpose()?;
        let table = table.map(|(t, force)| CubicSpline::through(t, force, Ends::Straight));
        Ok(Self { pulses, table, function: None })
    }

    /// A force given by a smooth function of time that does not vary over times much shorter than 1 (Γ/k).
    pub fn from_fn(function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self { function: Some(Arc::new(function)), ..Self::default() }
    }

    /// Adds a pulse.
    #[must_use]
    pub fn with_pulse(mut self, pulse: Pulse) -> Self {
        self.pulses.push(pulse);
        self
    }

    /// The pulses.
    pub fn pulses(&self) -> &[Pulse] {
        &self.pulses
    }

    /// Fext(t).
    pub fn value(&self, t: f64) -> f64 {
        let pulses = self.pulses.iter().map(|p| {
            let z = (t - p.time) / p.width;
            p.amplitude * exp(-0.5 * z * z)
        });
        let table = self.table.as_ref().filter(|s| (s.first()..=s.last()).contains(&t));
        pulses.sum::<f64>()
            + table.map_or(0.0, |s| s.value(t))
            + self.function.as_ref().map_or(0.0, |f| f(t))
    }

    /// Taylor coefficients of the force about t, valid up to the next break. The result is false if they are unknown,
    /// for a function of time.
    pub(crate) fn series(&self, t: f64, coefficients: &mut [f64]) -> bool {
        coefficients.fill(0.0);
        for pulse in self.pulses.iter().filter(|pulse| pulse.acts_after(t)) {
            pulse.add_series(t, coefficients);
        }
        if let Some(table) = self.table.as_ref().filter(|s| s.first() <= t && t < s.last()) {
            let piece = table.piece_of(t);
            let (value, slope, curvature) = table.jet_on(piece, t);
            let jet = [value, slope, 0.5 * curvature, table.third_on(piece) / 6.0];
            coefficients.iter_mut().zip(jet).for_each(|(c, term)| *c += term);
        }
        self.function.is_none()
    }

    /// The time after which the force is 0: -∞ without any force, infinite for a function of time.
    pub fn ends(&self) -> f64 {
        let pulses = self.pulses.iter().map(Pulse::ends);
        let table = self.table.iter().map(CubicSpline::last);
        let function = self.function.iter().map(|_| f64::INFINITY);
        pulses.chain(table).chain(function).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The time before which the force is 0: infinite without any force, -∞ for a function of time.
    pub fn begins(&self) -> f64 {
        let acting = self.pulses.iter().filter(|pulse| pulse.amplitude.abs() > 0.0);
        let pulses = acting.map(Pulse::begins);
        let table = self.table.iter().map(CubicSpline::first);
        let function = self.function.iter().map(|_| f64::NEG_INFINITY);
        pulses.chain(table).chain(function).fold(f64::INFINITY, f64::min)
    }

    /// The next time after t at which a step must end, so that the force is smooth within every step: the start or
    /// end of a pulse, or a knot of the table.
    pub(crate) fn next_break(&self, t: f64) -> f64 {
        let edges = self.pulses.iter().flat_map(|p| [p.begins(), p.ends()]);
        let knot = self.table.as_ref().map_or(f64::INFINITY, |table| next_knot(table.knots(), t));
        edges.filter(|edge| *edge > t).fold(knot, f64::min)
    }

    /// Longest step allowed at t.
    pub(crate) fn longest_step(&self, t: f64) -> f64 {
        self.pulses
            .iter()
            .filter(|p| p.begins() <= t && t <= p.ends())
            .map(|p| WIDTHS_PER_STEP * p.width)
            .fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_and_longest_steps_surround_a_pulse() {
        let force =
            Force::new(vec![Pulse { amplitude: 2.0, time: 30.0, width: 0.1 }], None).unwrap();
        assert!((force.next_break(0.0) - 29.0).abs() < 1e-12);
        assert!(force.longest_step(28.5).is_infinite());
        assert!((force.longest_step(30.2) - 0.15).abs() < 1e-12);
        assert!(force.next_break(31.5).is_infinite());
        assert!((force.value(30.0) - 2.0).abs() < 1e-15);
        assert!((force.begins() - 29.0).abs() < 1e-12);
        assert!(Force::default().begins() == f64::INFINITY);
        assert!(Force::from_fn(|_| 0.0).begins() == f64::NEG_INFINITY);
    }

    /// A step ends where a pulse begins, and the next one must not lead over it, however that time is rounded.
    #[test]
    fn a_pulse_that_begins_here_is_seen() {
        for i in 0..1000 {
            let (time, width) = (19.0 + 0.01 * f64::from(i), 0.2 + 1e-4 * f64::from(i));
            let force = Force::new(vec![Pulse { amplitude: 1.0, time, width }], None).unwrap();
            let begins = force.next_break(0.0);
            assert!(force.longest_step(begins) < 2.0 * width, "{time} {width}");
            assert!(force.longest_step(force.next_break(begins).next_up()).is_infinite());
        }
    }

    #[test]
    fn a_table_is_followed_and_is_zero_outside() {
        let t: Vec<f64> = (0..=50).map(|i| 0.1 * f64::from(i)).collect();
        let force = Force::new(vec![], Some((t.clone(), t.iter().map(|t| t.sin()).collect())));
        let force = force.unwrap();
        assert!((force.value(2.22) - 2.22_f64.sin()).abs() < 1e-6);
        assert!(force.value(5.1).abs() < 1e-300);
    }
}
