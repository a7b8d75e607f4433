//! A point that is a run: the result of `stickslip run` with the same options.

use crate::failure::Failure;
use stickslip::{
    Ask, Context, Indentation, NoiseParameters, OscillationDocument, Run, SweepPoint,
    SweepRunParameters, Tip,
};
use stickslip_outcome::{Motion, Watched};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{Model, RunError, Scenario, Step};

/// The run of this model.
///
/// # Errors
/// As for `stickslip run`.
pub(super) fn scenario(
    model: Model,
    run: &SweepRunParameters,
    tolerance: f64,
) -> Result<Scenario, Failure> {
    let noise = run.noise.map(|amplitude| NoiseParameters {
        amplitude,
        spacing: run.noise_spacing.unwrap_or(NoiseParameters::SPACING),
        // Judged to be whole.
        seed: run.seed.map_or(NoiseParameters::SEED, |seed| seed as u64),
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
    Ok(question.resolved(&Context::default())?.prepared()?)
}

/// Number of samples of l in the second half of a run.
const SAMPLES: usize = 2001;

/// Statistics of l in the second half of a run, accumulated during the run.
struct Swing {
    r: f64,
    times: Vec<f64>,
    l: Vec<f64>,
}

impl Swing {
    fn new(scenario: &Scenario) -> Self {
        let (start, end) = (scenario.start_time(), scenario.until);
        let middle = f64::midpoint(start, end);
        let time = |i: usize| middle + (end - middle) * (i as f64 / (SAMPLES - 1) as f64);
        let times = (0..SAMPLES).map(time).collect();
        Self { r: scenario.model.r(), times, l: Vec::with_capacity(SAMPLES) }
    }

    fn take(&mut self, step: &Step, is_due: impl Fn(f64) -> bool) {
        while let Some(t) = self.times.get(self.l.len()).filter(|t| is_due(**t)) {
            self.l.push(step.l(self.r, *t));
        }
    }

    /// Mean and standard deviation.
    fn found(&self) -> (Option<f64>, Option<f64>) {
        let count = self.l.len() as f64;
        let mean = self.l.iter().sum::<f64>() / count;
        let squares: f64 = self.l.iter().map(|l| (l - mean).powi(2)).sum();
        let there = |value: f64| Some(value).filter(|_| self.l.len() == SAMPLES);
        (there(mean), there((squares / count).sqrt()))
    }
}

/// The point with the result of the run.
///
/// # Errors
/// The tolerance cannot be met.
pub(super) fn ended(point: SweepPoint, scenario: &Scenario) -> Result<SweepPoint, RunError> {
    let initial = scenario.initial_surface()?;
    let mut running = Watched::new(scenario, &initial)?;
    let mut swing = Swing::new(scenario);
    while let Some(step) = running.step()? {
        swing.take(&step, |t| t < step.end());
    }
    running.last().iter().for_each(|last| swing.take(last, |t| t <= last.end()));
    let (mean_l, deviation_l) = swing.found();
    let point = SweepPoint { mean_l, deviation_l, ..point };
    let outcome = running.outcome();
    let ripple = outcome.oscillation.as_ref().zip(running.tail()).map(|(found, tail)| {
        let surface = Surface::new(&scenario.model, &initial, &tail);
        OscillationDocument::of(found, ripple_behind(&surface, &tail, found.wavelength))
    });
    let point = point.settled(Motion::Run(Box::new(outcome)));
    Ok(match ripple {
        Some(OscillationDocument { amplitude_u, amplitude_u_error, .. }) => {
            SweepPoint { amplitude_u, amplitude_u_error, ..point }
        }
        None => point,
    })
}
