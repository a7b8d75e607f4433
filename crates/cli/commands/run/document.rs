//! From a finished run to its document, and back.

use super::journey::Travelled;
use super::limits::FARTHEST;
use crate::documents::{
    FORMAT_VERSION, History, Order, OscillationDocument, RunDocument, RunEnd, SampleLine, Samples,
    Software, SteadyState, WorkDocument,
};
use crate::failure::Failure;
use stickslip_surface::{Ripple, Surface, ripple_behind};
use stickslip_tip::motion::Oscillation;
use stickslip_tip::{InitialSurface, Model, Scenario, Step, Trajectory, nodes_and_weights};

/// What became of the run.
pub(super) fn end(
    scenario: &Scenario,
    initial: &InitialSurface,
    travelled: &Travelled,
) -> Result<RunEnd, Failure> {
    let Travelled { running, seconds, signal, .. } = travelled;
    let tail = running.tail().ok_or_else(|| Failure::Run("the run has no steps".into()))?;
    let (outcome, work) = (running.outcome(), running.work());
    Ok(RunEnd {
        end: running.t(),
        regime: outcome.regime.into(),
        oscillation: outcome.oscillation.map(|o| {
            let surface = Surface::new(&scenario.model, initial, &tail);
            oscillation(&o, ripple_behind(&surface, &tail, &o))
        }),
        interrupted: signal.is_some(),
        work: WorkDocument {
            memory: running.memory().into(),
            memory_reason: running.memory_reason(),
            steps: work.steps,
            rejected: work.rejected,
            newton_iterations: work.newton_iterations,
            seconds: *seconds,
        },
    })
}

/// The whole document.
pub(super) fn of(
    order: &Order,
    scenario: &Scenario,
    end: RunEnd,
    samples: &[SampleLine],
    trajectory: Option<&Trajectory>,
) -> RunDocument {
    let column = |value: fn(&SampleLine) -> f64| samples.iter().map(value).collect();
    RunDocument {
        format: RunDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: order.parameters.clone(),
        steady_state: SteadyState::of(&scenario.model),
        samples: Samples {
            t: column(|s| s.t),
            l: column(|s| s.l),
            x0: column(|s| s.x0),
            velocity: column(|s| s.velocity),
        },
        history: trajectory.filter(|_| order.history).map(history),
        regime: end.regime,
        oscillation: end.oscillation,
        interrupted: end.interrupted,
        verification: None,
        work: end.work,
    }
}

impl SteadyState {
    pub(super) fn of(model: &Model) -> Self {
        let behind = model.steady_surface_behind();
        Self {
            l: model.steady_l(),
            lag: model.steady_lag(),
            surface_behind: behind.is_finite().then_some(behind),
        }
    }
}

pub(crate) fn history(trajectory: &Trajectory) -> History {
    let steps = trajectory.steps();
    let (nodes, weights) = nodes_and_weights();
    History {
        nodes: nodes.to_vec(),
        weights: weights.to_vec(),
        t: steps.iter().map(|s| s.t).chain([trajectory.end()]).collect(),
        extension: steps.iter().map(|s| s.extension).collect(),
        displacement: steps.iter().map(|s| s.displacement.to_vec()).collect(),
    }
}

fn oscillation(o: &Oscillation, ripple: Option<Ripple>) -> OscillationDocument {
    OscillationDocument {
        period: o.period,
        wavelength: o.wavelength,
        amplitude_x0: o.amplitude_x0,
        amplitude_u: ripple.map(|ripple| ripple.amplitude),
        slips: o.slips,
        drift: o.drift,
    }
}

/// The trajectory that a document holds.
pub(crate) fn trajectory(document: &RunDocument) -> Result<Trajectory, String> {
    let history = document.history.as_ref();
    let history = history.ok_or("history: it was left out; run it again with --history all")?;
    trajectory_of(history, document.parameters.model.r)
}

/// The trajectory that a history under support velocity r tells.
pub(crate) fn trajectory_of(history: &History, r: f64) -> Result<Trajectory, String> {
    let History { nodes, weights, t, extension, displacement } = history;
    let same = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    };
    let ours = nodes_and_weights();
    if !(same(nodes, &ours.0) && same(weights, &ours.1)) {
        return Err("history: nodes and weights are not those of this program".into());
    }
    let steps = extension.len();
    if steps == 0 || t.len() != steps + 1 || displacement.len() != steps {
        return Err("history: t, extension and displacement do not have matching lengths".into());
    }
    if t.windows(2).any(|t| t[1] <= t[0]) {
        return Err("history: t does not increase".into());
    }
    let step = |i: usize| -> Result<Step, String> {
        let displacement = displacement[i].as_slice().try_into();
        let displacement = displacement.map_err(|_| {
            let (found, needed) = (history.displacement[i].len(), nodes.len());
            format!("history: displacement {i} has {found} entries, {needed} are needed")
        })?;
        Ok(Step { t: t[i], h: t[i + 1] - t[i], extension: extension[i], displacement })
    };
    let steps: Vec<Step> = (0..steps).map(step).collect::<Result<_, _>>()?;
    let far = |step: &Step| {
        let sizes = [r * step.t, r * step.end(), step.extension];
        !sizes.iter().chain(&step.displacement).all(|size| size.abs() <= FARTHEST)
    };
    if let Some(i) = steps.iter().position(far) {
        return Err(format!("history: step {i} has numbers beyond {FARTHEST:e}"));
    }
    // As written, each step begins where the last one ended, to the last digit.
    let breaks = |pair: &[Step]| {
        let (end, next) = (pair[0].extension_at_end(r), pair[1].extension);
        (end - next).abs() > 1e-9 * end.abs().max(1.0)
    };
    if let Some(i) = steps.windows(2).position(breaks) {
        return Err(format!("history: step {} does not begin where step {i} ends", i + 1));
    }
    Ok(Trajectory::new(r, steps))
}
