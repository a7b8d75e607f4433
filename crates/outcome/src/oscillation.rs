//! A periodic motion with the errors of its figures.

use stickslip_cycles::Cycle;

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
        let off =
            self.cycle.as_ref().map_or(0.0, |cycle| (cycle.amplitude_u() - amplitude_u).abs());
        off + 3.0 * relative * amplitude_u.abs()
    }
}
