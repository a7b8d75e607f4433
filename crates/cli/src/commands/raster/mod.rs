//! `stickslip raster`.

mod heights;
mod scan;

pub(in crate::commands) use heights::field;

use super::job::{Job, format};
use super::model::wide_model;
use super::run::disturbance::{parse_pulses, warn_of_idle_pulses};
use crate::arguments::{Format, ModelArguments, RasterArguments, SamplingArguments, ScanArguments};
use crate::commands::in_units::{in_metres, scales};
use crate::failure::{Failure, Typed};
use crate::files::columns::read_area;
use crate::files::distinct::distinct;
use crate::interrupt::Interrupt;
use stickslip::lines::footprint;
use stickslip::{
    KnownScales, MemoryName, ModelParameters, PathName, Physical, RasterDocument, RasterParameters,
};
use stickslip_raster::{Area, Path, Plan, RasterError};
use stickslip_tip::{Force, RunError, Scenario};

/// One sample in so much of the way of the support, by default, in widths of the tip.
const SAMPLE: f64 = 0.25;
/// Of all lines: with their columns and what is written of them, under a gigabyte.
const MOST_SAMPLES: f64 = 5e6;

pub(crate) fn raster(arguments: &RasterArguments) -> Result<(), Failure> {
    let RasterArguments { output, plot, .. } = arguments;
    let read = [
        ("--tip-file", arguments.model.tip.tip_file.as_deref()),
        ("--area", arguments.scan.area.as_deref()),
    ];
    distinct(&[("--output", Some(&**output)), ("--plot", plot.as_deref())], &read)?;
    let is_gsf = arguments.format.is_none()
        && output.extension().is_some_and(|e| e.eq_ignore_ascii_case("gsf"));
    let format = if is_gsf { Format::Json } else { format(arguments.format, output, ", .gsf")? };
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, arguments.model.r)?;
    let (plan, parameters) = plan(arguments, scales.as_ref())?;
    let times = sample_times(&arguments.sampling, &plan)?;
    let in_metres = is_gsf.then(|| in_metres(scales.as_ref())).transpose()?;
    let job = Job::of_format::<RasterDocument>(format, output, &arguments.fields, plot.as_deref())?;
    let interrupt = Interrupt::listen()?;
    let (lines, finished) = scan::scan(&plan, &parameters, job.file(), &interrupt)?;
    let document = RasterDocument::new(parameters, &plan, &lines, &times).in_units(scales.as_ref());
    if let Some(unit) = in_metres {
        let map = document.height_map().map_err(|error| Failure::Run(error.to_string()))?;
        let bytes = field(&document.parameters, &map, unit);
        job.finish_bytes(&bytes, document)?;
    } else {
        job.finish(document)?;
    }
    finished.remove();
    Ok(())
}

/// What is to be scanned, and the document's word for it.
fn plan(
    arguments: &RasterArguments,
    scales: Option<&KnownScales>,
) -> Result<(Plan, RasterParameters), Failure> {
    let accuracy = (arguments.tolerance, arguments.memory);
    plan_of(&arguments.model, (&arguments.scan, scales), &arguments.pulse, accuracy)
}

/// The same of any command that scans.
pub(super) fn plan_of(
    given: &ModelArguments,
    (scan, scales): (&ScanArguments, Option<&KnownScales>),
    pulse: &[String],
    (tolerance, memory): (f64, MemoryName),
) -> Result<(Plan, RasterParameters), Failure> {
    let model = wide_model(given)?;
    let (footprint, width_y) = footprint(scan.width_y, model.tip())?;
    let parameters = ModelParameters::of(&model, given.alpha_above);
    let mut plan = Plan::over(footprint, model, Path::from(scan.path), area(scan, scales)?);
    plan.law = Scenario { tolerance, memory: memory.into(), ..plan.law };
    let pulses = parse_pulses(pulse)?;
    plan.disturbance =
        Force::new(pulses.clone(), None).map_err(|error| Failure::input("--pulse", error))?;
    plan.validate().map_err(|error| refused(scan, error))?;
    warn_of_idle_pulses(pulse, &pulses, (0.0, plan.duration(0)));
    let parameters = RasterParameters::of(&plan, parameters, width_y);
    Ok((plan, parameters))
}

/// A rectangle, or the lines of a file.
fn area(arguments: &ScanArguments, scales: Option<&KnownScales>) -> Result<Area, Failure> {
    if let Some(file) = &arguments.area {
        return Ok(Area::Lines(read_area("--area", file, scales)?));
    }
    let pitch = match (arguments.path, arguments.pitch) {
        (PathName::Repeat, None) => 0.0,
        (PathName::Repeat, Some(pitch)) => {
            let message = "has no meaning with --path repeat, whose lines are all the same: leave one of them out";
            return Err(Failure::input(format!("--pitch {}", Typed(pitch)), message));
        }
        (_, Some(pitch)) => pitch,
        (_, None) => {
            return Err(Failure::input("--pitch", "give the distance of the lines, --pitch D"));
        }
    };
    let (lines, length) =
        (arguments.lines.unwrap_or_default(), arguments.length.unwrap_or_default());
    Ok(Area::Rectangle { pitch, lines, length })
}

fn refused(arguments: &ScanArguments, error: RasterError) -> Failure {
    let in_file = arguments.area.as_ref().map(|file| format!("--area {}", file.display()));
    let length = || format!("--length {}", Typed(arguments.length.unwrap_or_default()));
    let option = match &error {
        RasterError::Pitch { pitch, .. } => format!("--pitch {}", Typed(*pitch)),
        RasterError::Length { length, .. } => format!("--length {}", Typed(*length)),
        RasterError::Lines(lines) | RasterError::Memory { lines, .. } => {
            in_file.unwrap_or(format!("--lines {lines}"))
        }
        RasterError::AreaLine { .. } | RasterError::Extent { .. } | RasterError::Crowded { .. } => {
            in_file.unwrap_or_default()
        }
        RasterError::RepeatedArea => "--path repeat".into(),
        RasterError::NoSpring => "--no-spring".into(),
        RasterError::NeverFades | RasterError::Section => "--tip".into(),
        RasterError::Line { error: RunError::Tolerance(tolerance), .. } => {
            return Failure::input(
                format!("--tolerance {}", Typed(*tolerance)),
                RunError::Tolerance(*tolerance),
            );
        }
        RasterError::Line { error: RunError::Modes(error), .. } => {
            return Failure::input("--memory modes", error);
        }
        RasterError::Line { .. } => in_file.unwrap_or_else(length),
    };
    Failure::input(option, error)
}

/// Times since the start of each line.
pub(super) fn sample_times(sampling: &SamplingArguments, plan: &Plan) -> Result<Vec<f64>, Failure> {
    let duration = plan.duration_of(plan.area.longest());
    // As many as the longest line has.
    let lines = plan.lines() as f64;
    if sampling.sample_at.is_some() || sampling.sample_every.is_some() {
        let times = sampling.sampling().times((0.0, duration), "each line", true)?.all();
        return if times.len() as f64 * lines <= MOST_SAMPLES {
            Ok(times)
        } else {
            Err(too_many(sampling, (times.len() as f64, lines), duration))
        };
    }
    let width = 8.7 / plan.footprint.path().band();
    let most = (MOST_SAMPLES / lines - 1.0).clamp(2.0, 2000.0);
    let count = (plan.area.longest() / (SAMPLE * width)).ceil().clamp(2.0, most);
    Ok((0..=count as usize).map(|i| duration * i as f64 / count).collect())
}

/// Refuses samples that memory does not hold, with what it would.
fn too_many(sampling: &SamplingArguments, (each, lines): (f64, f64), duration: f64) -> Failure {
    let (count, most) = (each * lines, (MOST_SAMPLES / lines).floor());
    let message =
        format!("would make {count:.1e} samples on {lines} lines, more than are kept in memory");
    match sampling.sample_every {
        Some(every) => {
            let named = format!("--sample-every {}", Typed(every));
            let least = duration / (most - 1.0).max(1.0);
            Failure::input(named, format!("{message}; {least:.3e} or above will do"))
        }
        None => {
            let named = format!("--sample-at with {each} times");
            Failure::input(named, format!("{message}; {most} times will do"))
        }
    }
}
