//! Oscillation of a tip across the scan: whether it is periodic, and the errors of its figures.

use num_complex::Complex;
use std::collections::VecDeque;
use stickslip_tip::Support;
use stickslip_tip::planar::{PlanarScenario, Step, Trajectory};
use stickslip_tip::roots::halved_between;
use stickslip_tip::state::{Damaged, Reader, State};

/// A motion is periodic if the changes that remain add up to at most this fraction of its amplitude, and of its period.
const REPEATS: f64 = 1e-3;
/// Number of evaluations of a velocity within a step: between two of them it changes its sign at most once.
const LOOKS: u32 = 8;
/// Changes below this many tolerances count as errors of steps.
const ERRORS: f64 = 10.0;
/// Largest factor per period by which such errors are assumed to decay.
const SLOWEST: f64 = 0.98;
/// Squared sine of the angle between changes and those before them, below which they are one geometric series.
const GEOMETRIC: f64 = 1e-12;

/// The periodic motion across the scan at the end of a run. The limiting motion lies within the errors if the changes
/// from period to period decay geometrically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snaking {
    /// Period of y0, in Γ/k; the motion along the scan has half this period.
    pub period: f64,
    /// Error of the period, in Γ/k.
    pub period_error: f64,
    /// Half the peak-to-peak value of y0, in σ.
    pub amplitude: f64,
    /// Error of the amplitude of y0, in σ.
    pub amplitude_error: f64,
    /// Half the peak-to-peak value of R - x0 over the last period, in σ.
    pub amplitude_along: f64,
    /// Error of the amplitude of R - x0, in σ.
    pub amplitude_along_error: f64,
    /// Change of the largest y0 from the last period but one to the last, divided by the amplitude.
    pub drift: f64,
}

/// A turning point of y0 or of R - x0, and its value.
#[derive(Debug, Clone, Copy)]
struct Turn {
    t: f64,
    value: f64,
    is_high: bool,
}

/// A period of y0, from one maximum to the next.
#[derive(Debug, Clone, Copy)]
struct Cycle {
    period: f64,
    /// y0 at the maximum that ends the period.
    highest: f64,
    /// y0 at the minimum within it.
    lowest: f64,
    /// Half the peak-to-peak value of R - x0.
    along: f64,
}

/// Largest number of periods that are kept.
const CYCLES: usize = 13;
/// Smallest number of periods of an oscillation that is classified.
const FEWEST_CYCLES: usize = 4;

/// The latest periods of y0.
#[derive(Debug, Clone, Default)]
struct Cycles {
    /// The periods, oldest first.
    all: VecDeque<Cycle>,
    /// The time of the last maximum of y0.
    maximum: Option<f64>,
    /// The last minimum of y0 since then.
    lowest: Option<f64>,
    /// The range of R - x0 at its turning points since then.
    lags: Option<(f64, f64)>,
}

impl Cycles {
    fn add_lag(&mut self, Turn { value: lag, .. }: Turn) {
        let (low, high) = self.lags.unwrap_or((lag, lag));
        self.lags = Some((low.min(lag), high.max(lag)));
    }

    /// Adds a turning point of y0; a maximum ends a period.
    fn add(&mut self, Turn { t, value, is_high }: Turn) {
        if !is_high {
            self.lowest = Some(value);
            return;
        }
        let along = self.lags.take().map_or(0.0, |(low, high)| 0.5 * (high - low));
        let (before, lowest) = (self.maximum.replace(t), self.lowest.take());
        if let (Some(before), Some(lowest)) = (before, lowest) {
            self.all.push_back(Cycle { period: t - before, highest: value, lowest, along });
        }
        if self.all.len() > CYCLES {
            self.all.pop_front();
        }
    }

    /// The changes of a number from period to period, the last at the end.
    fn changes(&self, number: fn(&Cycle) -> f64) -> Vec<f64> {
        let later = self.all.iter().skip(1);
        self.all.iter().zip(later).map(|(a, b)| number(b) - number(a)).collect()
    }

    fn save(&self, state: &mut State) {
        let numbers = |c: &Cycle| [c.period, c.highest, c.lowest, c.along];
        state.numbers(self.all.iter().flat_map(numbers).collect::<Vec<_>>().into_iter());
        state.numbers(self.maximum.into_iter());
        state.numbers(self.lowest.into_iter());
        state.pairs(self.lags.iter());
    }

    fn restored(state: &mut Reader) -> Result<Self, Damaged> {
        let cycle = |numbers: &[f64; 4]| {
            let [period, highest, lowest, along] = *numbers;
            Cycle { period, highest, lowest, along }
        };
        let all: VecDeque<Cycle> = state.numbers()?.as_chunks().0.iter().map(cycle).collect();
        let (maximum, lowest) = (state.numbers()?.pop(), state.numbers()?.pop());
        let restored = Self { all, maximum, lowest, lags: state.pairs()?.pop() };
        if restored.all.len() <= CYCLES { Ok(restored) } else { Err(Damaged::OutOfRange) }
    }
}

/// Collects the turning points of y0 and of R - x0, and the largest deviations, during a run; the size is bounded for
/// runs of any length.
#[derive(Debug, Clone)]
pub struct SnakingObserver {
    support: Support,
    /// Start time of the run and end of the last step; `None` before the first step.
    span: Option<(f64, f64)>,
    last: Option<Step>,
    cycles: Cycles,
    deviations: Largest,
}

impl SnakingObserver {
    /// An observer before the first step.
    pub fn new(scenario: &PlanarScenario) -> Self {
        Self::of(scenario.along.support())
    }

    fn of(support: Support) -> Self {
        let (cycles, deviations) = (Cycles::default(), Largest::default());
        Self { support, span: None, last: None, cycles, deviations }
    }

    /// Adds the next step.
    pub fn observe(&mut self, step: &Step) {
        let start = self.span.map_or(step.along.t, |(start, _)| start);
        self.span = Some((start, step.end()));
        self.last = Some(*step);
        self.deviations.add((step.along.t - start, step.end() - start), step.y_at_end().abs());
        let (support, cycles) = (&self.support, &mut self.cycles);
        let (along, across) = (step.velocity_along(), step.velocity_across());
        let stretch = |t: f64| support.velocity(t) - along(t);
        let mut lags = turns(step, stretch, |t| step.along.lag(support, t)).peekable();
        for turn in turns(step, across, |t| step.y0(t)) {
            while let Some(lag) = lags.next_if(|lag| lag.t <= turn.t) {
                cycles.add_lag(lag);
            }
            cycles.add(turn);
        }
        lags.for_each(|lag| cycles.add_lag(lag));
    }

    /// The periodic motion of y0 at the end of a run with this tolerance; `None` if the amplitude of y0 is not above
    /// ten tolerances, y0 had fewer than five maxima, or the motion is not periodic.
    pub fn snaking(&self, tolerance: f64) -> Option<Snaking> {
        let cycles = &self.cycles;
        let last = *cycles.all.back().filter(|_| cycles.all.len() >= FEWEST_CYCLES)?;
        let amplitude = 0.5 * (last.highest - last.lowest);
        if amplitude <= 10.0 * tolerance {
            return None;
        }
        let period = cycles.changes(|cycle| cycle.period);
        let highest = cycles.changes(|cycle| cycle.highest);
        let lowest = cycles.changes(|cycle| cycle.lowest);
        let along = cycles.changes(|cycle| cycle.along);
        let of_time = last.period / amplitude;
        let in_space: Vec<f64> = period.iter().map(|change| change / of_time).collect();
        let all = [in_space.as_slice(), &highest, &lowest, &along];
        let remains = Remains::of(&all, ERRORS * tolerance)?;
        let left = |changes: &[f64]| remains.after(changes);
        // Round-off of positions moves a turning point by that over the curvature there.
        let period_error = left(&period) + 10.0 * tolerance * of_time;
        let amplitude_error = 0.5 * (left(&highest) + left(&lowest)) + 4.0 * tolerance;
        let is_periodic =
            amplitude_error <= REPEATS * amplitude && period_error <= REPEATS * last.period;
        is_periodic.then_some(Snaking {
            period: last.period,
            period_error,
            amplitude,
            amplitude_error,
            amplitude_along: last.along,
            amplitude_along_error: left(&along) + 4.0 * tolerance,
            drift: highest.last()?.abs() / amplitude,
        })
    }

    /// The largest |y0| at the ends of steps in about the last fraction `part` of the run.
    pub fn largest_late(&self, part: f64) -> f64 {
        self.span.map_or(0.0, |(start, end)| self.deviations.since((1.0 - part) * (end - start)))
    }

    /// The last step.
    pub fn last(&self) -> Option<&Step> {
        self.last.as_ref()
    }

    /// Writes all data except the scenario.
    pub(crate) fn save(&self, state: &mut State) {
        state.pairs(self.span.iter());
        state.count(u64::from(self.last.is_some()));
        if let Some(step) = &self.last {
            step.save(state);
        }
        self.cycles.save(state);
        state.number(self.deviations.width);
        state.numbers(self.deviations.bins.iter().copied());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.span = state.pairs()?.pop();
        self.last = match state.length(1)? {
            0 => None,
            _ => Some(Step::restored(state)?),
        };
        self.cycles = Cycles::restored(state)?;
        self.deviations = Largest { width: state.finite()?, bins: state.numbers()? };
        let ends = self.last.map(|step| step.end().to_bits());
        let is_sound =
            self.deviations.is_sound() && ends == self.span.map(|(_, end)| end.to_bits());
        if is_sound { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}

/// The periodic motion of y0 at the end of a trajectory; see [`SnakingObserver::snaking`].
pub fn snaking(trajectory: &Trajectory, tolerance: f64) -> Option<Snaking> {
    let mut observer = SnakingObserver::of(trajectory.support().clone());
    trajectory.steps().iter().for_each(|step| observer.observe(step));
    observer.snaking(tolerance)
}

/// The largest value in each of many equal bins of the time since the start; their width doubles as time goes on.
#[derive(Debug, Clone, Default)]
struct Largest {
    width: f64,
    bins: Vec<f64>,
}

const BINS: usize = 512;

impl Largest {
    fn add(&mut self, (from, to): (f64, f64), value: f64) {
        if self.bins.is_empty() {
            self.width = to - from;
        }
        while to >= BINS as f64 * self.width {
            self.width *= 2.0;
            self.bins =
                self.bins.chunks(2).map(|pair| pair.iter().copied().fold(0.0, f64::max)).collect();
        }
        let bin = self.bin(to);
        if bin >= self.bins.len() {
            self.bins.resize(bin + 1, 0.0);
        }
        self.bins[bin] = self.bins[bin].max(value);
    }

    /// The largest value since a time, or since shortly before it.
    fn since(&self, time: f64) -> f64 {
        let late = self.bins.iter().skip(self.bin(time));
        late.copied().fold(0.0, f64::max)
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    fn bin(&self, time: f64) -> usize {
        (time / self.width).max(0.0) as usize
    }

    fn is_sound(&self) -> bool {
        self.bins.len() <= BINS && (self.width > 0.0 || self.bins.is_empty())
    }
}

/// Extrapolation of the changes of several numbers from period to period.
#[derive(Debug, Clone, Copy)]
struct Remains {
    /// The factor by which they decay per period.
    fading: f64,
    /// The complex multiplier of changes that oscillate as they decay; `None` if they do not oscillate.
    ringing: Option<Complex<f64>>,
}

impl Remains {
    /// `None` if changes do not decay and are not below `errors`. The last change of each number is at the end.
    fn of(changes: &[&[f64]], errors: f64) -> Option<Self> {
        let largest = |part: std::ops::Range<usize>| {
            let sizes = changes.iter().flat_map(|changes| &changes[part.clone()]);
            sizes.map(|change| change.abs()).fold(0.0, f64::max)
        };
        // From the largest of the earlier half to that of the later one: a single change may pass 0.
        let count = changes.first()?.len();
        let (earlier, later) = (largest(0..count / 2), largest(count / 2..count));
        let fading = (later / earlier).powf(2.0 / count as f64);
        if later <= errors {
            return Some(Self { fading: fading.min(SLOWEST), ringing: None });
        }
        let ringing = multiplier(changes);
        let decays = fading < 1.0 && ringing.is_none_or(|multiplier| multiplier.norm() < 1.0);
        decays.then_some(Self { fading, ringing })
    }

    /// Twice the sum that all later changes may have: that of the largest geometric series through one of the later half
    /// of `changes`, or of the oscillation through the last two.
    fn after(&self, changes: &[f64]) -> f64 {
        let later = changes[changes.len() / 2..].iter().rev();
        let faded = later.scan(1.0, |factor, change| {
            let size = *factor * change.abs();
            *factor *= self.fading;
            Some(size)
        });
        let steady = faded.fold(0.0, f64::max) / (1.0 - self.fading);
        let ringing = match (self.ringing, changes) {
            (Some(multiplier), [.., before, last]) => {
                // The changes are Re(bμⁿ), n = 0 and -1 for the last two.
                let (re, im) = (multiplier.re, multiplier.im);
                let b = Complex::new(*last, (multiplier.norm_sqr() * before - re * last) / im);
                (b * multiplier / (1.0 - multiplier)).norm()
            }
            _ => 0.0,
        };
        2.0 * steady.max(ringing)
    }
}

/// The complex multiplier of changes that obey `c_n = p c_{n-1} + q c_{n-2}`, by least squares over all numbers; `None`
/// if they do not oscillate.
fn multiplier(changes: &[&[f64]]) -> Option<Complex<f64>> {
    let mut sums = [0.0; 5];
    for triple in changes.iter().flat_map(|changes| changes.windows(3)) {
        let &[c, b, a] = triple else { continue };
        for (sum, product) in sums.iter_mut().zip([b * b, b * c, c * c, a * b, a * c]) {
            *sum += product;
        }
    }
    let [bb, bc, cc, ab, ac] = sums;
    let determinant = bb * cc - bc * bc;
    if determinant <= GEOMETRIC * bb * cc {
        return None;
    }
    let p = (ab * cc - ac * bc) / determinant;
    let q = (ac * bb - ab * bc) / determinant;
    let im = (-q - 0.25 * p * p).sqrt();
    (im > 0.0).then(|| Complex::new(0.5 * p, im))
}

/// Turning points within a step of a quantity, given its rate and its value as functions of t.
fn turns(
    step: &Step,
    rate: impl Fn(f64) -> f64,
    value: impl Fn(f64) -> f64,
) -> impl Iterator<Item = Turn> {
    let (start, part) = (step.along.t, step.along.h / f64::from(LOOKS));
    let time = move |i: u32| start + part * f64::from(i);
    let mut from = (time(0), rate(time(0)));
    (1..=LOOKS).filter_map(move |i| {
        let before = std::mem::replace(&mut from, (time(i), rate(time(i))));
        (before.1 * from.1 < 0.0).then(|| {
            let is_high = before.1 > 0.0;
            let t = halved_between(&rate, before.0, from.0);
            Turn { t, value: value(t), is_high }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that approach 0 as Re(e^{iφ} (ϱe^{iω})ⁿ), for all phases φ, also where the last change is nearly 0:
    /// within 0.74 of the error.
    #[test]
    fn a_number_that_rings_is_within_its_error_of_its_limit() {
        let mut largest = 0.0_f64;
        for (decay, length) in [(0.3_f64, 5), (0.6, 8), (0.8, 13), (0.9, 13)] {
            for turn in (1..60).map(|i| 0.05 * f64::from(i)).chain([0.0, 0.01]) {
                for phase in (0..100).map(|i| 0.0628 * f64::from(i)) {
                    let number = |n: i32| decay.powi(n) * (phase + turn * f64::from(n)).cos();
                    let changes: Vec<f64> =
                        (1..length).map(|n| number(n) - number(n - 1)).collect();
                    let Some(remains) = Remains::of(&[&changes], 0.0) else { continue };
                    let off = number(length - 1).abs() / remains.after(&changes);
                    largest = largest.max(off);
                }
            }
        }
        println!("{largest}");
        assert!(largest < 1.0, "{largest}");
    }

    /// The largest of a list, however coarse the bins have become.
    #[test]
    fn the_largest_late_value_is_that_of_the_list() {
        let value = |i: u32| 1.0 + (0.37 * f64::from(i)).sin() - 1e-4 * f64::from(i);
        let mut largest = Largest::default();
        for i in 1..20_000_u32 {
            let t = 0.3 * f64::from(i);
            largest.add((t - 0.3, t), value(i));
            if i.is_multiple_of(977) {
                let late = 0.75 * t;
                let among = |from: f64| {
                    (1..=i).filter(|i| 0.3 * f64::from(*i) >= from).map(value).fold(0.0, f64::max)
                };
                let (found, width) = (largest.since(late), largest.width);
                assert!(found >= among(late) && found <= among(late - width), "{i}");
                assert!(largest.bins.len() <= BINS && width <= t.max(1.0) / 200.0 || i < 2000);
            }
        }
    }
}
