//! The limit cycle on or close to a motion: the reference solution for its classification.

use stickslip_cycles::{Cycle, CycleError, ROUGHEST_RESIDUAL, cycle_near, cycle_within};
use stickslip_tip::motion::{Extremum, Oscillation, last_period, latest_extrema};
use stickslip_tip::{Model, Trajectory};

/// Residual of a reference cycle.
const RESIDUAL: f64 = 1e-9;
/// Residual of the finer reference cycle for a run of small tolerance.
const FINE_RESIDUAL: f64 = 1e-11;
/// Largest tolerance of a run that needs the finer cycle.
const FINE_RUN: f64 = 1e-10;

/// A limit cycle close to a motion.
pub(crate) struct Reference {
    pub(crate) cycle: Cycle,
    /// The motion, measured over the same number of slips.
    pub(crate) measured: Oscillation,
    /// Largest difference between an extremum of l in the last period of the motion and that of the cycle.
    pub(crate) off: f64,
    /// Largest modulus of the multipliers except that of a shift in time.
    pub(crate) multiplier: f64,
}

impl Reference {
    /// The cycle that Newton's method finds from the last period of a motion, of this number of slips, or else from one of
    /// the `tries` - 1 periods before.
    pub(crate) fn of(
        model: &Model,
        tolerance: f64,
        tail: &Trajectory,
        extrema: &[Extremum],
        slips: usize,
        tries: usize,
    ) -> Option<Self> {
        // Where a step of the run ends decides whether Newton's method likes its mesh: one period or another.
        let spans =
            (0..tries).map_while(|back| last_period(extrema.get(2 * slips * back..)?, slips));
        let near = spans.into_iter().find_map(|span| closed(model, tail, span));
        let near = Self::beside(near?, tail, extrema)?;
        if tolerance > FINE_RUN || near.off > FINE_RESIDUAL.sqrt() {
            return Some(near);
        }
        let (period, fine) = (near.cycle.motion(), FINE_RESIDUAL);
        let finer = cycle_near(model, period, fine).ok();
        finer.and_then(|finer| Self::beside(finer, tail, extrema)).or(Some(near))
    }

    /// The comparison of a cycle with a motion close to it; `None` if the motion has too few extrema.
    pub(crate) fn beside(cycle: Cycle, tail: &Trajectory, extrema: &[Extremum]) -> Option<Self> {
        let measured = Oscillation::with_slips(tail, extrema, cycle.slips())?;
        let off = difference(&cycle, extrema)?;
        let multiplier = cycle.leading_multiplier();
        Some(Self { cycle, measured, off, multiplier })
    }

    /// Fraction by which a deviation decreases in a period.
    pub(crate) fn gap(&self) -> f64 {
        1.0 - self.multiplier
    }

    /// Distance of the motion from the cycle, relative to amplitude and period.
    pub(crate) fn distance(&self) -> f64 {
        let off_period = (self.measured.period / self.cycle.period() - 1.0).abs();
        (self.off / self.cycle.amplitude_x0()).max(off_period)
    }

    /// Number of periods until the distance is at most `near`. Close to onset the square of the amplitude approaches
    /// its limit along a logistic curve, from any amplitude.
    pub(crate) fn periods_until(&self, near: f64) -> f64 {
        let ratio = self.cycle.amplitude_x0() / self.measured.amplitude_x0;
        let away = (ratio * ratio - 1.0).abs().max(2.0 * self.distance());
        ((0.5 * away / near).ln() / -self.multiplier.ln()).max(0.0)
    }
}

/// The cycle close to a period of a motion, to the smallest residual available: in long periods round-off raises it.
fn closed(model: &Model, tail: &Trajectory, span: (f64, f64)) -> Option<Cycle> {
    match cycle_within(model, tail, span, RESIDUAL) {
        Err(CycleError::Rough { reached, .. }) if reached <= ROUGHEST_RESIDUAL => {
            cycle_within(model, tail, span, reached).ok()
        }
        found => found.ok(),
    }
}

/// A maximum closer than this fraction of a period to the seam, the start and end of the period, counts as lying on it.
const AT_THE_SEAM: f64 = 1e-6;

/// Largest difference between the extrema of the last period of a motion and those of the cycle, in the order that
/// fits best.
fn difference(cycle: &Cycle, extrema: &[Extremum]) -> Option<f64> {
    let motion = cycle.motion();
    let (start, end) = (motion.start(), motion.end());
    let seam = AT_THE_SEAM * (end - start);
    let mut of_cycle = latest_extrema(motion);
    of_cycle.retain(|e| !e.is_maximum || (e.t - start > seam && end - e.t > seam));
    // The maximum at the seam, as the latest.
    of_cycle.insert(0, Extremum { t: end, l: motion.l(start), is_maximum: true });
    let latest_maximum = extrema.iter().position(|e| e.is_maximum)?;
    let of_motion = extrema.get(latest_maximum..latest_maximum + of_cycle.len())?;
    let count = of_cycle.len();
    let off = |shift: usize| {
        let shifted = (0..count).map(|i| of_cycle[(i + shift) % count].l);
        of_motion.iter().zip(shifted).map(|(a, b)| (a.l - b).abs()).fold(0.0, f64::max)
    };
    (0..count).step_by(2).map(off).min_by(f64::total_cmp)
}
