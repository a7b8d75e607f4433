//! From a finished run to its document, and back.

use crate::arguments::RunArguments;
use crate::documents::{
    FORMAT_VERSION, ForceTable, History, ModelParameters, NoiseParameters, OscillationDocument,
    Profile, PulseParameters, RegimeName, RunDocument, RunParameters, Samples, Software,
    SteadyState, WorkDocument,
};
use crate::failure::Failure;
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
) -> Result<RunDocument, Failure> {
    let model = &scenario.model;
    let behind = model.steady_surface_behind();
    Ok(RunDocument {
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
        regime: match run.outcome.regime {
            Regime::Steady => RegimeName::Steady,
            Regime::StickSlip => RegimeName::StickSlip,
            Regime::Trapped => RegimeName::Trapped,
            Regime::Transient => RegimeName::Transient,
        },
        oscillation: oscillation(scenario, run)?,
        interrupted: run.interrupted,
        work: WorkDocument {
            memory: run.memory.into(),
            memory_reason: run.memory_reason.clone(),
            steps: run.work.steps,
            rejected: run.work.rejected,
            newton_iterations: run.work.newton_iterations,
            seconds,
        },
    })
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

fn history(trajectory: &Trajectory) -> History {
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

fn oscillation(scenario: &Scenario, run: &Run) -> Result<Option<OscillationDocument>, Failure> {
    let Some(o) = run.outcome.oscillation else { return Ok(None) };
    let initial = scenario.initial_surface().map_err(|error| Failure::Run(error.to_string()))?;
    let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
    let ripple = ripple_behind(&surface, &run.trajectory, &o);
    Ok(Some(OscillationDocument {
        period: o.period,
        wavelength: o.wavelength,
        amplitude_x0: o.amplitude_x0,
        amplitude_u: ripple.map(|ripple| ripple.amplitude),
        slips: o.slips,
        drift: o.drift,
    }))
}

/// The trajectory that a document holds.
pub(crate) fn trajectory(document: &RunDocument) -> Result<Trajectory, String> {
    let History { t, extension, displacement, .. } = &document.history;
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
            format!("history: displacement {i} has {} entries", displacement_len(document, i))
        })?;
        Ok(Step { t: t[i], h: t[i + 1] - t[i], extension: extension[i], displacement })
    };
    let steps: Vec<Step> = (0..steps).map(step).collect::<Result<_, _>>()?;
    Ok(Trajectory::new(document.parameters.model.r, steps))
}

fn displacement_len(document: &RunDocument, i: usize) -> usize {
    document.history.displacement[i].len()
}
