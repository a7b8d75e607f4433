//! From a finished run to its document, and back.

use super::limits::FARTHEST;
use crate::arguments::RunArguments;
use crate::documents::{
    FORMAT_VERSION, ForceTable, History, ModelParameters, NoiseParameters, OscillationDocument,
    Profile, PulseParameters, RegimeName, RunDocument, RunParameters, Samples, Software,
    SteadyState, WorkDocument,
};
use crate::files::input::Columns;
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{Pulse, Regime, Run, Scenario, Step, Trajectory, nodes_and_weights};

/// What came from files and repeated options.
#[derive(Debug)]
pub(super) struct Inputs {
    pub(super) profile: Option<Columns>,
    pub(super) force: Option<Columns>,
    pub(super) pulses: Vec<Pulse>,
}

pub(super) fn of(
    arguments: &RunArguments,
    scenario: &Scenario,
    inputs: &Inputs,
    run: &Run,
    times: &[f64],
    seconds: f64,
) -> RunDocument {
    let model = &scenario.model;
    let behind = model.steady_surface_behind();
    RunDocument {
        format: RunDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: parameters(arguments, scenario, inputs),
        steady_state: SteadyState {
            l: model.steady_l(),
            lag: model.steady_lag(),
            surface_behind: behind.is_finite().then_some(behind),
        },
        samples: samples(&run.trajectory, times),
        history: history(&run.trajectory),
        regime: regime(run.outcome.regime),
        oscillation: oscillation(scenario, run),
        interrupted: run.interrupted,
        work: WorkDocument {
            memory: run.memory.into(),
            memory_reason: run.memory_reason.clone(),
            steps: run.work.steps,
            rejected: run.work.rejected,
            newton_iterations: run.work.newton_iterations,
            seconds,
        },
    }
}

/// Its name.
pub(crate) fn regime(regime: Regime) -> RegimeName {
    match regime {
        Regime::Steady => RegimeName::Steady,
        Regime::StickSlip => RegimeName::StickSlip,
        Regime::Trapped => RegimeName::Trapped,
        Regime::Transient => RegimeName::Transient,
    }
}

fn parameters(arguments: &RunArguments, scenario: &Scenario, inputs: &Inputs) -> RunParameters {
    let pulse =
        |p: &Pulse| PulseParameters { amplitude: p.amplitude, time: p.time, width: p.width };
    RunParameters {
        model: ModelParameters::of(&scenario.model, arguments.model.alpha_above),
        start: arguments.start,
        start_position: scenario.start_position,
        kick: scenario.kick,
        noise: scenario.noise.map(|noise| NoiseParameters {
            amplitude: noise.amplitude,
            spacing: noise.spacing,
            seed: noise.seed,
        }),
        initial_surface: inputs.profile.clone().map(|(x, u)| Profile { x, u }),
        pulses: inputs.pulses.iter().map(pulse).collect(),
        force: inputs.force.clone().map(|(t, force)| ForceTable { t, force }),
        until: scenario.until,
        tolerance: scenario.tolerance,
        memory: arguments.memory,
    }
}

fn samples(trajectory: &Trajectory, times: &[f64]) -> Samples {
    let t: Vec<f64> = times.iter().copied().filter(|t| *t <= trajectory.end()).collect();
    let column = |f: &dyn Fn(f64) -> f64| t.iter().map(|t| f(*t)).collect();
    Samples {
        l: column(&|t| trajectory.l(t)),
        x0: column(&|t| trajectory.x0(t)),
        velocity: column(&|t| trajectory.velocity(t)),
        t,
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

fn oscillation(scenario: &Scenario, run: &Run) -> Option<OscillationDocument> {
    let o = run.outcome.oscillation?;
    let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
    let ripple = ripple_behind(&surface, &run.trajectory, &o);
    Some(OscillationDocument {
        period: o.period,
        wavelength: o.wavelength,
        amplitude_x0: o.amplitude_x0,
        amplitude_u: ripple.map(|ripple| ripple.amplitude),
        slips: o.slips,
        drift: o.drift,
    })
}

/// The trajectory that a document holds.
pub(crate) fn trajectory(document: &RunDocument) -> Result<Trajectory, String> {
    trajectory_of(&document.history, document.parameters.model.r)
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
