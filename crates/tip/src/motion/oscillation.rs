//! Period and amplitude of a periodic motion.

use super::extrema::Extremum;
use crate::Trajectory;
use crate::roots::zero_between;
use crate::sorting::ends;

/// The periodic motion at the end of a run. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillation {
    /// Period of l(t).
    pub period: f64,
    /// Wavelength of the surface behind the tip: the path of the support in one period.
    pub wavelength: f64,
    /// Half the peak-to-peak value of l, that is, of x0 minus its steady advance.
    pub amplitude_x0: f64,
    /// Number of maxima of l in one period: 2 after a period doubling.
    pub slips: usize,
    /// Largest change of a maximum of l from one period to the next, in units of the amplitude: the deviation from a
    /// periodic motion.
    pub drift: f64,
    /// Start time of the last whole period.
    pub last_period_from: f64,
}

/// Largest change between cycles, in units of the amplitude, of a motion that counts as periodic.
const REPEATS_WITHIN: f64 = 1e-3;
const MOST_SLIPS: usize = 8;
/// Number of cycles that must agree.
const CYCLES: usize = 3;

impl Oscillation {
    /// The cycle with the fewest maxima that is repeated at the end of the trajectory, if there is one.
    pub fn of(trajectory: &Trajectory, latest_first: &[Extremum]) -> Option<Self> {
        (1..=MOST_SLIPS).find_map(|slips| {
            let compared = maxima(latest_first).get(..CYCLES * slips + 1)?.to_vec();
            let found = Self::with_slips(trajectory, latest_first, slips)?;
            let rough = compared[0].t - compared[slips].t;
            let pairs = compared.iter().zip(&compared[slips..]);
            let uneven = pairs.map(|(a, b)| (a.t - b.t - rough).abs()).fold(0.0, f64::max);
            let repeats = found.drift <= REPEATS_WITHIN && uneven <= REPEATS_WITHIN * rough;
            repeats.then_some(found)
        })
    }

    /// The last interval of `slips` maxima as if it were a period, whether or not the motion is periodic.
    pub fn with_slips(
        trajectory: &Trajectory,
        latest_first: &[Extremum],
        slips: usize,
    ) -> Option<Self> {
        let maxima = maxima(latest_first);
        let compared = &maxima[..maxima.len().min(CYCLES * slips + 1)];
        let (last, before) = (compared.first()?, compared.get(slips)?);
        let cycle = latest_first.iter().filter(|e| e.t > before.t && e.t <= last.t);
        let (low, high) = ends(cycle.map(|e| e.l));
        let amplitude_x0 = 0.5 * (high - low);
        let pairs = compared.iter().zip(&compared[slips..]);
        let drift = pairs.map(|(a, b)| (a.l - b.l).abs()).fold(0.0, f64::max) / amplitude_x0;
        // A crossing of the mean level is better defined than the time of a flat maximum.
        let middle = 0.5 * (high + low);
        let crossing = |e: &Extremum| last_rise_through(trajectory, latest_first, middle, e.t);
        let (end, start) = (crossing(last)?, crossing(before)?);
        let period = end - start;
        let wavelength = trajectory.r() * period;
        Some(Self { period, wavelength, amplitude_x0, slips, drift, last_period_from: start })
    }
}

/// Times of two maxima a period of `slips` maxima apart: the second is the highest of the last period.
pub fn last_period(latest_first: &[Extremum], slips: usize) -> Option<(f64, f64)> {
    let maxima = maxima(latest_first);
    let (i, end) = maxima.iter().take(slips).enumerate().max_by(|a, b| a.1.l.total_cmp(&b.1.l))?;
    let start = maxima.get(i + slips)?;
    Some((start.t, end.t))
}

fn maxima(latest_first: &[Extremum]) -> Vec<Extremum> {
    latest_first.iter().filter(|e| e.is_maximum).copied().collect()
}

/// The last time before t at which l crosses a level upwards.
fn last_rise_through(
    trajectory: &Trajectory,
    latest_first: &[Extremum],
    level: f64,
    t: f64,
) -> Option<f64> {
    let earlier: Vec<_> = latest_first.iter().filter(|e| e.t <= t).collect();
    let rise = earlier.windows(2).find(|e| e[0].l > level && e[1].l <= level)?;
    Some(zero_between(|t| trajectory.l(t) - level, rise[1].t, rise[0].t))
}
