//! From a scenario to what a document says of it, and back: a run is defined by its document.

use crate::arguments::{MemoryName, StartName};
use crate::documents::{
    ForceTable, ModelParameters, NoiseParameters, Profile, PulseParameters, RunParameters,
};
use stickslip_tip::{Force, MemoryChoice, Noise, Pulse, Scenario, Start};

/// What a document says of a scenario; the force is given as what it was made of.
pub(crate) fn of(
    scenario: &Scenario,
    alpha_above: Option<f64>,
    pulses: &[Pulse],
    force: Option<(Vec<f64>, Vec<f64>)>,
) -> RunParameters {
    let pulse =
        |p: &Pulse| PulseParameters { amplitude: p.amplitude, time: p.time, width: p.width };
    RunParameters {
        model: ModelParameters::of(&scenario.model, alpha_above),
        start: match scenario.start {
            Start::Steady => StartName::Steady,
            Start::Flat => StartName::Flat,
        },
        start_position: scenario.start_position,
        kick: scenario.kick,
        noise: scenario.noise.map(|noise| NoiseParameters {
            amplitude: noise.amplitude,
            spacing: noise.spacing,
            seed: noise.seed,
        }),
        initial_surface: scenario.profile.clone().map(|(x, u)| Profile { x, u }),
        pulses: pulses.iter().map(pulse).collect(),
        force: force.map(|(t, force)| ForceTable { t, force }),
        until: scenario.until,
        tolerance: scenario.tolerance,
        memory: match scenario.memory {
            MemoryChoice::Auto => MemoryName::Auto,
            MemoryChoice::Direct => MemoryName::Direct,
            MemoryChoice::Fft => MemoryName::Fft,
            MemoryChoice::Modes => MemoryName::Modes,
        },
    }
}

pub(crate) fn start(name: StartName) -> Start {
    match name {
        StartName::Steady => Start::Steady,
        StartName::Flat => Start::Flat,
    }
}

pub(crate) fn memory(name: MemoryName) -> MemoryChoice {
    match name {
        MemoryName::Auto => MemoryChoice::Auto,
        MemoryName::Direct => MemoryChoice::Direct,
        MemoryName::Fft => MemoryChoice::Fft,
        MemoryName::Modes => MemoryChoice::Modes,
    }
}

/// The scenario that was run.
///
/// # Errors
/// What is wrong with the document.
pub(crate) fn scenario(parameters: &RunParameters) -> Result<Scenario, String> {
    let model = parameters.model.model()?;
    let pulse =
        |p: &PulseParameters| Pulse { amplitude: p.amplitude, time: p.time, width: p.width };
    let pulses = parameters.pulses.iter().map(pulse).collect();
    let table = parameters.force.clone().map(|table| (table.t, table.force));
    let force = Force::new(pulses, table).map_err(|error| error.to_string())?;
    let scenario = Scenario {
        start: start(parameters.start),
        start_position: parameters.start_position,
        kick: parameters.kick,
        noise: parameters.noise.as_ref().map(|noise| Noise {
            amplitude: noise.amplitude,
            spacing: noise.spacing,
            seed: noise.seed,
        }),
        profile: parameters.initial_surface.clone().map(|profile| (profile.x, profile.u)),
        force,
        tolerance: parameters.tolerance,
        memory: memory(parameters.memory),
        ..Scenario::new(model, parameters.until)
    };
    scenario.validate().map_err(|error| error.to_string())?;
    Ok(scenario)
}
