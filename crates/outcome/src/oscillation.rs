//! A periodic motion with the errors of its figures.

use crate::reference::Reference;
use stickslip_cycles::Cycle;
use stickslip_tip::motion;

/// The periodic motion at the end of a run. Lengths in σ, times in Γ/k. An error is the distance to the figure of
/// the motion that the run goes to, so that this lies within it.
#[derive(Debug, Clone)]
pub struct Oscillation {
    /// Period of l(t).
    pub period: f64,
    /// Its error.
    pub period_error: f64,
    /// Wavelength of the surface behind the tip: the way of the support in one period.
    pub wavelength: f64,
    /// Its error.
    pub wavelength_error: f64,
    /// Half peak-to-peak of l, that is of x0 less its steady advance.
    pub amplitude_x0: f64,
    /// Its error.
    pub amplitude_x0_error: f64,
    /// Maxima of l in one period: 2 after a period doubling.
    pub slips: usize,
    /// Largest change of a maximum of l from one period to the next, over the amplitude.
    pub drift: f64,
    /// Time at which the last whole period begins.
    pub last_period_from: f64,
    /// The cycle that the motion is on, where it could be solved for.
    pub cycle: Option<Box<Cycle>>,
}

impl Oscillation {
    /// The error of an amplitude of the surface left behind, measured on the run.
    #[must_use]
    pub fn amplitude_u_error(&self, amplitude_u: f64) -> f64 {
        let relative =
            self.amplitude_x0_error / self.amplitude_x0 + self.period_error / self.period;
        let cycle = self.cycle.as_ref();
        let off = cycle.map_or(0.0, |cycle| (cycle.amplitude_u() - amplitude_u).abs());
        (off + 3.0 * relative * amplitude_u.abs()).min(f64::MAX)
    }
}

impl Oscillation {
    /// On a cycle, as far off it as the motion is.
    pub(crate) fn on(near: Reference) -> Self {
        let (error, measured) = (near.cycle.error(), near.measured);
        let round_off = 4.0 * f64::EPSILON * (measured.last_period_from.abs() + measured.period);
        let period_error = (measured.period - near.cycle.period()).abs() + 2.0 * error + round_off;
        let amplitude = near.cycle.amplitude_x0();
        let amplitude_error = (measured.amplitude_x0 - amplitude).abs() + 2.0 * error;
        let cycle = Some(Box::new(near.cycle));
        Self { cycle, ..Self::with_errors(&measured, period_error, amplitude_error) }
    }

    /// At most `rest`, in l, off where it goes.
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
