//! What the tip meets beside its own groove, read and judged.

use crate::arguments::DisturbanceArguments;
use crate::failure::Failure;
use crate::files::input::{Columns, read_columns, read_profile};
use std::path::Path;
use stickslip_tip::{Force, ForceError, Noise, Pulse};

const DEFAULT_NOISE_SPACING: f64 = 0.1;
const DEFAULT_SEED: u64 = 1;

/// What came from files and repeated options.
pub(crate) struct Disturbance {
    pub(crate) noise: Option<Noise>,
    pub(crate) profile: Option<Columns>,
    pub(crate) pulses: Vec<Pulse>,
    pub(crate) table: Option<Columns>,
    /// Of pulses and table.
    pub(crate) force: Force,
}

impl Disturbance {
    pub(crate) fn of(arguments: &DisturbanceArguments) -> Result<Self, Failure> {
        let profile = arguments.initial_surface.as_deref();
        let profile = profile.map(|path| read_profile("--initial-surface", path)).transpose()?;
        let table = arguments.force_file.as_deref();
        let table = table.map(|path| read_columns("--force-file", path, "t,force")).transpose()?;
        let pulses = parse_pulses(&arguments.pulse)?;
        let force = Force::new(pulses.clone(), table.clone());
        let force = force.map_err(|error| explain(&error, arguments))?;
        let noise = arguments.noise.map(|amplitude| Noise {
            amplitude,
            spacing: arguments.noise_spacing.unwrap_or(DEFAULT_NOISE_SPACING),
            seed: arguments.seed.unwrap_or(DEFAULT_SEED),
        });
        Ok(Self { noise, profile, pulses, table, force })
    }
}

fn explain(error: &ForceError, arguments: &DisturbanceArguments) -> Failure {
    let path = arguments.force_file.as_deref().unwrap_or(Path::new(""));
    match error {
        ForceError::Table(error) => {
            Failure::input(format!("--force-file {}", path.display()), error)
        }
        error => Failure::input("--pulse", error),
    }
}

/// All that `--pulse` was given for.
pub(crate) fn parse_pulses(texts: &[String]) -> Result<Vec<Pulse>, Failure> {
    texts.iter().map(|text| parse_pulse(text)).collect()
}

/// A, T and W of `--pulse`.
fn parse_pulse(text: &str) -> Result<Pulse, Failure> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[amplitude, time, width])
            if amplitude.is_finite() && time.is_finite() && width.is_finite() && width > 0.0 =>
        {
            Ok(Pulse { amplitude, time, width })
        }
        _ => Err(Failure::input(
            format!("--pulse {text}"),
            "needs three finite numbers A,T,W: amplitude, time and width, the width above 0, such as \
             --pulse 2,30,0.5",
        )),
    }
}
