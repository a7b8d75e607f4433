//! Oscillation of a tip across the scan: whether it is periodic, and the errors of its figures.

use std::collections::VecDeque;
use stickslip_tip::planar::{PlanarScenario, Step, Trajectory};
use stickslip_tip::state::{Damaged, Reader, State};
use stickslip_tip::{STAGES, Support};

/// A motion is periodic if its largest deviation changes by at most this fraction of its amplitude from period to
/// period.
const REPEATS: f64 = 1e-3;
/// Evaluations of the velocity within a step: between two of them it changes sign at most once.
const LOOKS: u32 = 8;
/// Number of bisections for the time of a turning point: to the last bit of a step.
const BISECTIONS: u32 = 50;
/// Slowest decay per period that the extrapolation of a change assumes.
const SLOWEST: f64 = 0.98;

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
    /// Change of the largest y0 from the last period but one to the last, divided by the amplitude.
    pub drift: f64,
}

/// A turning point of y0.
#[derive(Debug, Clone, Copy)]
struct Turn {
    t: f64,
    y: f64,
}

/// Collects the turning points of y0 and its largest deviations during a run; the size is bounded for runs of any
/// length.
#[derive(Debug, Clone)]
pub struct SnakingObserver {
    support: Support,
    /// Start time of the run and end of the last step; `None` before the first step.
    span: Option<(f64, f64)>,
    /// The last maxima, and the number of all.
    highest: VecDeque<Turn>,
    maxima: u64,
    lowest: Option<Turn>,
    /// Steps since the last maximum but one.
    tail: VecDeque<Step>,
    deviations: Largest,
}

/// Number of maxima that figures and errors need.
const MAXIMA: usize = 3;
/// Number of maxima below which an oscillation is not judged.
const FEWEST_MAXIMA: u64 = 5;
/// Largest number of steps kept.
const LONGEST_TAIL: usize = 1 << 15;

impl SnakingObserver {
    /// An observer before the first step.
    #[must_use]
    pub fn new(scenario: &PlanarScenario) -> Self {
        Self::of(scenario.along.support())
    }

    fn of(support: Support) -> Self {
        Self {
            support,
            span: None,
            highest: VecDeque::new(),
            maxima: 0,
            lowest: None,
            tail: VecDeque::new(),
            deviations: Largest::default(),
        }
    }

    /// Adds the next step.
    pub fn observe(&mut self, step: &Step) {
        let start = self.span.map_or(step.along.t, |(start, _)| start);
        self.span = Some((start, step.end()));
        self.deviations.add((step.along.t - start, step.end() - start), step.y_at_end().abs());
        for (turn, is_high) in turns(step) {
            if is_high {
                self.highest.push_back(turn);
                self.maxima += 1;
            } else {
                self.lowest = Some(turn);
            }
        }
        while self.highest.len() > MAXIMA {
            self.highest.pop_front();
        }
        self.tail.push_back(*step);
        let needed = self.highest.iter().rev().nth(1).or(self.highest.back());
        let needed = needed.map_or(step.along.t, |turn| turn.t);
        while self.tail.len() > LONGEST_TAIL
            || self.tail.front().is_some_and(|first| first.end() <= needed)
        {
            self.tail.pop_front();
        }
    }

    /// The periodic motion of y0 at the end of a run with this tolerance; `None` if the amplitude of y0 is not above
    /// the tolerance, y0 has oscillated less than five times, or the motion is not periodic.
    #[must_use]
    pub fn snaking(&self, tolerance: f64) -> Option<Snaking> {
        let [a, b, c] = *self.highest.iter().collect::<Vec<_>>().first_chunk::<MAXIMA>()?;
        let low = self.lowest?;
        if self.maxima < FEWEST_MAXIMA {
            return None;
        }
        let amplitude = 0.5 * (c.y - low.y);
        if amplitude <= 10.0 * tolerance {
            return None;
        }
        let drift = (c.y - b.y).abs() / amplitude;
        let periods = [b.t - a.t, c.t - b.t];
        if drift > REPEATS || (periods[1] - periods[0]).abs() > REPEATS * periods[1] {
            return None;
        }
        // Round-off of positions moves a turning point by that over the curvature there.
        let of_time = 10.0 * tolerance * periods[1] / amplitude;
        Some(Snaking {
            period: periods[1],
            period_error: left(
                [periods[1] - periods[0], (b.y - a.y) * periods[1] / amplitude],
                [c.y - b.y, b.y - a.y],
            ) + of_time,
            amplitude,
            amplitude_error: left([c.y - b.y, 0.0], [c.y - b.y, b.y - a.y]) + 4.0 * tolerance,
            amplitude_along: self.swing_along(b.t, c.t),
            drift,
        })
    }

    /// The largest |y0| at the ends of steps in about the last part of the run, given as a fraction of it.
    #[must_use]
    pub fn largest_late(&self, part: f64) -> f64 {
        self.span.map_or(0.0, |(start, end)| self.deviations.since((1.0 - part) * (end - start)))
    }

    /// The last step.
    #[must_use]
    pub fn last(&self) -> Option<&Step> {
        self.tail.back()
    }

    /// Half the peak-to-peak value of R - x0 between two times.
    fn swing_along(&self, from: f64, to: f64) -> f64 {
        const SAMPLES: u32 = 2000;
        let lag = |i: u32| {
            let t = from + (to - from) * f64::from(i) / f64::from(SAMPLES);
            let after = self.tail.partition_point(|step| step.along.t <= t);
            self.tail[after.max(1) - 1].along.lag(&self.support, t)
        };
        let (low, high) = (0..=SAMPLES)
            .map(lag)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), l| (low.min(l), high.max(l)));
        0.5 * (high - low)
    }

    /// Writes all data except the scenario.
    pub(crate) fn save(&self, state: &mut State) {
        let turns = |turns: &mut dyn Iterator<Item = &Turn>| {
            turns.map(|turn| (turn.t, turn.y)).collect::<Vec<_>>()
        };
        state.pairs(self.span.iter());
        state.pairs(turns(&mut self.highest.iter()).iter());
        state.count(self.maxima);
        state.pairs(turns(&mut self.lowest.iter()).iter());
        state.count(self.tail.len() as u64);
        for step in &self.tail {
            state.step(&step.along);
            state.number(step.y);
            step.across.iter().for_each(|across| state.number(*across));
        }
        state.number(self.deviations.width);
        state.numbers(self.deviations.bins.iter().copied());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let turn = |(t, y): (f64, f64)| Turn { t, y };
        self.span = state.pairs()?.pop();
        self.highest = state.pairs()?.into_iter().map(turn).collect();
        self.maxima = state.count()?.min(u64::MAX / 2);
        self.lowest = state.pairs()?.pop().map(turn);
        let step = |state: &mut Reader| {
            let (along, y, mut across) = (state.step()?, state.finite()?, [0.0; STAGES]);
            for across in &mut across {
                *across = state.finite()?;
            }
            Ok(Step { along, y, across })
        };
        self.tail = (0..state.length(1)?).map(|_| step(state)).collect::<Result<_, _>>()?;
        self.deviations = Largest { width: state.finite()?, bins: state.numbers()? };
        let ends = self.tail.back().map(|step| step.end().to_bits());
        let is_sound =
            self.deviations.is_sound() && ends == self.span.map(|(_, end)| end.to_bits());
        if is_sound { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}

/// The periodic motion of y0 at the end of a trajectory; see [`SnakingObserver::snaking`].
#[must_use]
pub fn snaking(trajectory: &Trajectory, tolerance: f64) -> Option<Snaking> {
    let mut observer = SnakingObserver::of(trajectory.support().clone());
    trajectory.steps().iter().for_each(|step| observer.observe(step));
    observer.snaking(tolerance)
}

/// The largest of values in bins of time since the start, of equal width; the width doubles as time goes on.
#[derive(Debug, Clone, Default)]
struct Largest {
    width: f64,
    bins: Vec<f64>,
}

/// Largest number of bins.
const BINS: usize = 512;

impl Largest {
    /// Adds the value at the end of a step.
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

    /// The largest since a time, or since shortly before it.
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

/// Sum of a geometric series that begins with the larger of these sizes and decays as two changes did, the last of
/// which comes first.
fn left(sizes: [f64; 2], [last, before]: [f64; 2]) -> f64 {
    let fading = (last / before).abs();
    let fading = if fading.is_finite() { fading.min(SLOWEST) } else { SLOWEST };
    let size = sizes.into_iter().fold(0.0, |most: f64, size| most.max(size.abs()));
    size / (1.0 - fading)
}

/// Turning points of y0 within a step, and whether each is a maximum.
fn turns(step: &Step) -> impl Iterator<Item = (Turn, bool)> {
    let velocity = step.velocity_across();
    let time = |i: u32| step.along.t + step.along.h * f64::from(i) / f64::from(LOOKS);
    let mut from = (time(0), velocity(time(0)));
    (1..=LOOKS).filter_map(move |i| {
        let before = std::mem::replace(&mut from, (time(i), velocity(time(i))));
        let turned = before.1 * from.1 < 0.0;
        turned.then(|| (turn(step, &velocity, (before.0, from.0)), before.1 > 0.0))
    })
}

fn turn(step: &Step, velocity: impl Fn(f64) -> f64, (mut low, mut high): (f64, f64)) -> Turn {
    let rises = velocity(low) > 0.0;
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if (velocity(middle) > 0.0) == rises { low = middle } else { high = middle }
    }
    let t = f64::midpoint(low, high);
    Turn { t, y: step.y0(t) }
}

#[cfg(test)]
mod tests {
    use super::*;

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
