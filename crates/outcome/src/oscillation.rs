//! A periodic motion with error estimates.

use crate::reference::Reference;
use stickslip_cycles::Cycle;
use stickslip_tip::motion;

/// The periodic motion at the end of a run. Lengths in σ, times in Γ/k. Each error estimates the distance from the
/// corresponding figure of the limiting motion.
#[derive(Debug, Clone)]
pub struct Oscillation {
    /// Period of l(t).
    pub period: f64,
    /// Error of the period.
    pub period_error: f64,
    /// Wavelength of the surface behind the tip: the distance that the support moves in one period.
    pub wavelength: f64,
    /// Error of the wavelength.
    pub wavelength_error: f64,
    /// Half the peak-to-peak value of l, that is, of x0 minus its steady advance.
    pub amplitude_x0: f64,
    /// Error of the amplitude.
    pub amplitude_x0_error: f64,
    /// Maxima of l in one period: 2 after a period doubling.
    pub slips: usize,
    /// Largest change of a maximum of l from one period to the next, over the amplitude.
    pub drift: f64,
    /// Time at which the last whole period begins.
    pub last_period_from: f64,
    /// The limit cycle of the motion, if it was found.
    pub cycle: Option<Box<Cycle>>,
}

impl Oscillation {
    /// Error of the amplitude of the surface far behind the tip, for an amplitude measured on the run.
    pub fn amplitude_u_error(&self, amplitude_u: f64) -> f64 {
        let relative =
            self.amplitude_x0_error / self.amplitude_x0 + self.period_error / self.period;
        let cycle = self.cycle.as_ref();
        let off = cycle.map_or(0.0, |cycle| (cycle.amplitude_u() - amplitude_u).abs());
        (off + 3.0 * relative * amplitude_u.abs()).min(f64::MAX)
    }

    /// The oscillation on a cycle, with the distance from the cycle as error.
    pub(crate) fn on(near: Reference) -> Self {
        let (error, measured) = (near.cycle.error(), near.measured);
        let round_off = 4.0 * f64::EPSILON * (measured.last_period_from.abs() + measured.period);
        let period_error = (measured.period - near.cycle.period()).abs() + 2.0 * error + round_off;
        let amplitude = near.cycle.amplitude_x0();
        let amplitude_error = (measured.amplitude_x0 - amplitude).abs() + 2.0 * error;
        let cycle = Some(Box::new(near.cycle));
        Self { cycle, ..Self::with_errors(&measured, period_error, amplitude_error) }
    }

    /// The oscillation without a cycle; `rest` bounds the distance of l from its limit.
    pub(crate) fn within(measured: &motion::Oscillation, rest: f64) -> Self {
        let period_error = 2.0 * rest / measured.amplitude_x0 * measured.period;
        Self::with_errors(measured, period_error, 2.0 * rest)
    }

    fn with_errors(measured: &motion::Oscillation, period_error: f64, amplitude: f64) -> Self {
        let r = measured.wavelength / measured.period;
        Self {
            period: measured.period,
            period_error,
            wavelength: measured.wavelength,
            wavelength_error: r * period_error,
            amplitude_x0: measured.amplitude_x0,
            amplitude_x0_error: amplitude,
            slips: measured.slips,
            drift: measured.drift,
            last_period_from: measured.last_period_from,
            cycle: None,
        }
    }
}
