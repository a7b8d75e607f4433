//! What the tip meets beside its own groove, read and judged.

use crate::arguments::{DisturbanceArguments, ModelArguments, StartArguments, StartChoice};
use crate::failure::{Failure, Typed};
use crate::files::columns::{Columns, read_columns, read_profile};
use crate::files::distinct::Named;
use crate::message::remark;
use std::path::Path;
use stickslip::KnownScales;
use stickslip_tip::{Force, ForceError, Model, Noise, Pulse, Scenario, Start, SupportPath};

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
    /// Of columns that have units.
    scales: Option<KnownScales>,
}

impl Disturbance {
    pub(crate) fn of(
        arguments: &DisturbanceArguments,
        scales: Option<&KnownScales>,
    ) -> Result<Self, Failure> {
        let profile = arguments.initial_surface.as_deref();
        let profile =
            profile.map(|path| read_profile("--initial-surface", path, scales)).transpose()?;
        let table = arguments.force_file.as_deref();
        let table =
            table.map(|path| read_columns("--force-file", path, "t,force", scales)).transpose()?;
        let pulses = parse_pulses(&arguments.pulse)?;
        let force = Force::new(pulses.clone(), table.clone());
        let force = force.map_err(|error| explain(&error, arguments))?;
        let noise = arguments.noise.map(|amplitude| Noise {
            amplitude,
            spacing: arguments.noise_spacing.unwrap_or(DEFAULT_NOISE_SPACING),
            seed: arguments.seed.unwrap_or(DEFAULT_SEED),
        });
        Ok(Self { noise, profile, pulses, table, force, scales: scales.copied() })
    }

    /// A run that starts as asked and meets all this, at the tolerance and with the memory of `Scenario::new`.
    ///
    /// # Errors
    /// The path of the support cannot be read, or is none.
    pub(crate) fn scenario(
        &self,
        start: &StartArguments,
        model: Model,
        until: f64,
    ) -> Result<Scenario, Failure> {
        let noise = self.noise.or(default_noise(start.choice(model.wider().spring)));
        let begin = begin(start, &model);
        Ok(Scenario {
            start: begin.surface,
            start_position: begin.position,
            kick: begin.kick,
            path: start
                .support_path
                .as_deref()
                .map(|path| support_path(path, self.scales.as_ref()))
                .transpose()?,
            start_velocity: start.start_velocity,
            noise,
            profile: self.profile.clone(),
            force: self.force.clone(),
            ..Scenario::new(model, until)
        })
    }
}

/// R(t) from a file.
fn support_path(path: &Path, scales: Option<&KnownScales>) -> Result<SupportPath, Failure> {
    let (t, displacement) = read_columns("--support-path", path, "t,R", scales)?;
    let named = || format!("--support-path {}", path.display());
    SupportPath::new(t, displacement).map_err(|error| Failure::input(named(), error))
}

/// The noise of the paper's simulations, but on a grid on which its slope is small.
const PAPERS_NOISE: Noise = Noise { amplitude: 1e-4, spacing: 0.05, seed: DEFAULT_SEED };

fn default_noise(start: StartChoice) -> Option<Noise> {
    (start == StartChoice::Paper).then_some(PAPERS_NOISE)
}

struct Begin {
    surface: Start,
    position: f64,
    kick: f64,
}

/// Surface, position and kick. The paper sets its tip down at X with the spring stretched by r + α/r on the steady
/// surface, which it takes for flat where f has no volume (docs/corrections.md, 13).
fn begin(start: &StartArguments, model: &Model) -> Begin {
    let StartArguments { start_position: position, kick, .. } = *start;
    match start.choice(model.wider().spring) {
        StartChoice::Steady => Begin { surface: Start::Steady, position, kick },
        StartChoice::Flat => Begin { surface: Start::Flat, position, kick },
        // Round-off of a sum of Gaussians that cancel.
        StartChoice::Paper if model.steady_surface_behind().abs() > 1e-9 * model.alpha() => {
            Begin { surface: Start::Steady, position, kick }
        }
        StartChoice::Paper => {
            let stretched = model.r() + model.alpha() / model.r();
            let surface = Start::Flat;
            Begin { surface, position: position + stretched, kick: kick + stretched }
        }
    }
}

/// The files that such a run reads, which none may be written over.
pub(crate) fn files_read<'a>(
    model: &'a ModelArguments,
    disturbance: &'a DisturbanceArguments,
) -> [Named<'a>; 3] {
    [
        ("--tip-file", model.tip.tip_file.as_deref()),
        ("--initial-surface", disturbance.initial_surface.as_deref()),
        ("--force-file", disturbance.force_file.as_deref()),
    ]
}

/// exp(-9²/2) = 3e-18: a force of the size of the others is below round-off so many widths from its center.
const WIDTHS_FELT: f64 = 9.0;

/// Says of each force that ends before the motion begins, or begins after it has ended, that nothing feels it. No
/// refusal: the same forces may be given to runs of several lengths.
pub(crate) fn warn_of_idle(
    arguments: &DisturbanceArguments,
    disturbance: &Disturbance,
    span: (f64, f64),
) {
    warn_of_idle_pulses(&arguments.pulse, &disturbance.pulses, span);
    let ends = disturbance.table.as_ref().and_then(|(t, _)| Some((*t.first()?, *t.last()?)));
    if let (Some(path), Some(ends)) = (&arguments.force_file, ends) {
        warn(&format!("--force-file {}", path.display()), ends, ends, span);
    }
}

/// The same of pulses alone, as they were typed and as they were read.
pub(crate) fn warn_of_idle_pulses(texts: &[String], pulses: &[Pulse], span: (f64, f64)) {
    for (text, pulse) in texts.iter().zip(pulses) {
        let half = WIDTHS_FELT * pulse.width;
        let ends = (pulse.time - half, pulse.time + half);
        warn(&format!("--pulse {text}"), ends, (pulse.time, pulse.time), span);
    }
}

/// A force that is felt from one of `ends` to the other, and what is needed to reach it: a run over `core`.
fn warn(option: &str, ends: (f64, f64), core: (f64, f64), (start, until): (f64, f64)) {
    let advice = if ends.0 >= until {
        let (until, after) = (Typed(until), Typed(core.0));
        format!("it comes after the end at t = {until}: an --until above {after} would reach it")
    } else if ends.1 <= start {
        format!("it is over before the start at t = {}: a time after that would do", Typed(start))
    } else {
        return;
    };
    remark(format_args!("stickslip: {option} has no effect: {advice}"));
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
