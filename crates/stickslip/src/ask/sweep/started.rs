//! A point that is a run: the result of `stickslip run` with the same options.

use crate::{
    Ask, Context, Failure, Indentation, Noise, OscillationDocument, Run, SweepPoint,
    SweepRunParameters, Tip,
};
use std::collections::VecDeque;
use stickslip_outcome::{Motion, Observer, Regime, judge};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::motion::{Extremum, extrema_within};
use stickslip_tip::{Model, Scenario, Step, collect_each};

/// The scenario of a point: a run of this model.
pub(super) fn scenario(
    model: Model,
    run: &SweepRunParameters,
    tolerance: f64,
) -> Result<Scenario, Failure> {
    let noise = run.noise.map(|amplitude| Noise {
        amplitude,
        spacing: run.noise_spacing.unwrap_or(Noise::SPACING),
        // Judged to be whole.
        seed: run.seed.map_or(Noise::SEED, |seed| seed as u64),
    });
    let question = Run {
        law: (*model.wider()).into(),
        start: Some(run.start),
        start_position: run.start_position,
        kick: run.kick,
        start_velocity: run.start_velocity,
        noise,
        tolerance,
        ..Run::new(
            Tip(model.tip().clone()),
            Indentation::given(model.alpha()),
            model.r(),
            run.until,
        )
    };
    question.resolved(&Context::default())?.scenario()
}

/// Number of samples of l in the second half of a run.
const SAMPLES: usize = 2001;
/// Largest number of extrema of l kept, the last ones.
const MOST_EXTREMA: usize = 8192;
/// Least number of slips from which a mean distance is computed.
const FEWEST_SLIPS: usize = 3;

/// Statistics of l in the second half of a run, accumulated during the run.
struct Swing {
    r: f64,
    times: Vec<f64>,
    l: Vec<f64>,
    /// Extrema of l since `times[0]`.
    extrema: VecDeque<Extremum>,
}

impl Swing {
    fn new(scenario: &Scenario) -> Self {
        let (start, end) = (scenario.start_time(), scenario.until);
        let middle = f64::midpoint(start, end);
        let time = |i: usize| middle + (end - middle) * (i as f64 / (SAMPLES - 1) as f64);
        let times = (0..SAMPLES).map(time).collect();
        Self {
            r: scenario.model.r(),
            times,
            l: Vec::with_capacity(SAMPLES),
            extrema: VecDeque::new(),
        }
    }

    /// Adds the extrema within a step.
    fn turn(&mut self, step: &Step) {
        if step.t < self.times[0] {
            return;
        }
        extrema_within(step, self.r, |extremum| self.extrema.push_back(extremum));
        while self.extrema.len() > MOST_EXTREMA {
            self.extrema.pop_front();
        }
    }

    fn take(&mut self, step: &Step, is_due: impl Fn(f64) -> bool) {
        while let Some(t) = self.times.get(self.l.len()).filter(|t| is_due(**t)) {
            self.l.push(step.l(self.r, *t));
        }
    }

    /// Mean and standard deviation of l; `None` if some of the samples are missing.
    fn found(&self) -> (Option<f64>, Option<f64>) {
        let count = self.l.len() as f64;
        let mean = self.l.iter().sum::<f64>() / count;
        let squares: f64 = self.l.iter().map(|l| (l - mean).powi(2)).sum();
        let there = |value: f64| Some(value).filter(|_| self.l.len() == SAMPLES);
        (there(mean), there((squares / count).sqrt()))
    }

    /// Mean distance of the tip between slips, and its standard error; slips are falls of l by more than `least`.
    fn slip_distance(&self, least: f64) -> Option<(f64, f64)> {
        let slips: Vec<f64> = slips(&self.extrema, least).map(|e| self.r * e.t - e.l).collect();
        let count = slips.len().checked_sub(1).filter(|_| slips.len() >= FEWEST_SLIPS)? as f64;
        let mean = (slips.last()? - slips.first()?) / count;
        let squares: f64 = slips.windows(2).map(|pair| (pair[1] - pair[0] - mean).powi(2)).sum();
        Some((mean, (squares / (count - 1.0) / count).sqrt()))
    }
}

/// The maxima of l that exceed the minima before and after by more than `least`.
fn slips(extrema: &VecDeque<Extremum>, least: f64) -> impl Iterator<Item = Extremum> {
    let (mut top, mut bottom): (Option<Extremum>, f64) = (None, f64::INFINITY);
    extrema.iter().filter_map(move |extremum| {
        bottom = bottom.min(extremum.l);
        if extremum.l > top.map_or(bottom + least, |top| top.l) {
            top = Some(*extremum);
        }
        let fallen = top.filter(|top| top.l - extremum.l > least)?;
        (top, bottom) = (None, extremum.l);
        Some(fallen)
    })
}

/// Observer and statistics of a run.
struct Followed {
    observer: Observer,
    swing: Swing,
}

impl Extend<Step> for Followed {
    fn extend<I: IntoIterator<Item = Step>>(&mut self, steps: I) {
        for step in steps {
            self.observer.observe(&step);
            self.swing.take(&step, |t| t < step.end());
            self.swing.turn(&step);
        }
    }
}

/// Runs the scenarios of these points, in SIMD lanes as far as possible, and passes each point with its result to
/// `take`. A result does not depend on the other scenarios.
pub(super) fn each(
    points: &[SweepPoint],
    scenarios: &[Scenario],
    take: &mut dyn FnMut(SweepPoint),
) {
    let begin = |number: usize| {
        let scenario: &Scenario = &scenarios[number];
        Followed { observer: Observer::new(scenario), swing: Swing::new(scenario) }
    };
    collect_each(scenarios, begin, |number, run| {
        let point = || points[number].clone();
        take(match run {
            Ok(run) => ended(point(), &scenarios[number], run),
            Err(error) => SweepPoint { error: Some(error.to_string()), ..point() },
        });
    });
}

/// The point with the result of the run.
fn ended(point: SweepPoint, scenario: &Scenario, run: stickslip_tip::Run<Followed>) -> SweepPoint {
    let stickslip_tip::Run {
        initial_surface, trajectory: Followed { observer, mut swing }, ..
    } = run;
    observer.last().iter().for_each(|last| swing.take(last, |t| t <= last.end()));
    let (mean_l, deviation_l) = swing.found();
    let outcome = judge(scenario, &initial_surface, &observer);
    let oscillates = matches!(outcome.regime, Regime::StickSlip | Regime::Transient);
    let distance = deviation_l.filter(|_| oscillates).and_then(|least| swing.slip_distance(least));
    let (slip_distance, slip_distance_error) = distance.unzip();
    let point = SweepPoint { mean_l, deviation_l, slip_distance, slip_distance_error, ..point };
    let ripple = outcome.oscillation.as_ref().zip(observer.tail()).map(|(found, tail)| {
        let surface = Surface::new(&scenario.model, &initial_surface, &tail);
        OscillationDocument::of(found, ripple_behind(&surface, found.wavelength))
    });
    let point = point.settled(Motion::Run(Box::new(outcome)));
    match ripple {
        Some(OscillationDocument { amplitude_u, amplitude_u_error, .. }) => {
            SweepPoint { amplitude_u, amplitude_u_error, ..point }
        }
        None => point,
    }
}
