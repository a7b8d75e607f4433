//! `stickslip surface`.

use super::figure::Figure;
use super::run::document;
use crate::arguments::SurfaceArguments;
use crate::documents::{
    FORMAT_VERSION, RunDocument, RunParameters, Software, SurfaceCurve, SurfaceDocument,
    SurfaceParameters,
};
use crate::failure::{Failure, Typed};
use crate::files::input::read_run;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use crate::plot;
use stickslip_surface::Surface;
use stickslip_tip::{InitialSurface, Model, Noise, Scenario, Start, Trajectory};

const DEFAULT_SPACING: f64 = 0.05;
/// Shown on either side of the tip's way.
const MARGIN: f64 = 12.0;
const MOST_POINTS: f64 = 2e7;

pub(crate) fn surface(arguments: &SurfaceArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    let document = read_run(&arguments.run)?;
    let damaged = |message: String| {
        Failure::input(
            format!("RUN.json {}", arguments.run.display()),
            format!("damaged: {message}"),
        )
    };
    let model = document.parameters.model.model().map_err(damaged)?;
    let trajectory = document::trajectory(&document).map_err(damaged)?;
    let initial = initial_surface(&document.parameters, &model).map_err(damaged)?;
    let times = times(arguments, &trajectory)?;
    let x = positions(arguments, &trajectory, times.len())?;
    let output = Output::open("--output", &arguments.output)?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;

    let curves = curves(arguments, &Surface::new(&model, &initial, &trajectory), &times, &x)?;
    let result = assemble(arguments, &document, curves);
    if let Some(figure) = figure {
        figure.write(&draw(&result))?;
    }
    write(&result, format, output)
}

/// From the margin behind the tip's start to the margin ahead of its end.
pub(crate) fn default_range(trajectory: &Trajectory) -> (f64, f64) {
    let ends = [trajectory.x0(trajectory.start()), trajectory.x0(trajectory.end())];
    (ends[0].min(ends[1]) - MARGIN, ends[0].max(ends[1]) + MARGIN)
}

/// n points from low to high.
pub(crate) fn evenly(low: f64, high: f64, n: usize) -> Vec<f64> {
    let spacing = (high - low) / (n.max(2) - 1) as f64;
    (0..n).map(|i| low + spacing * i as f64).collect()
}

pub(crate) fn initial_surface(
    parameters: &RunParameters,
    model: &Model,
) -> Result<InitialSurface, String> {
    let scenario = Scenario {
        start: match parameters.start {
            crate::arguments::StartName::Steady => Start::Steady,
            crate::arguments::StartName::Flat => Start::Flat,
        },
        start_position: parameters.start_position,
        kick: parameters.kick,
        noise: parameters.noise.as_ref().map(|noise| Noise {
            amplitude: noise.amplitude,
            spacing: noise.spacing,
            seed: noise.seed,
        }),
        profile: parameters.initial_surface.clone().map(|profile| (profile.x, profile.u)),
        tolerance: parameters.tolerance,
        ..Scenario::new(model.clone(), parameters.until)
    };
    scenario.validate().map_err(|error| error.to_string())?;
    scenario.initial_surface().map_err(|error| error.to_string())
}

fn times(arguments: &SurfaceArguments, trajectory: &Trajectory) -> Result<Vec<f64>, Failure> {
    let (start, end) = (trajectory.start(), trajectory.end());
    let times = arguments.at.clone().unwrap_or_else(|| vec![end]);
    match times.iter().find(|t| !(start..=end).contains(*t)) {
        None => Ok(times),
        Some(t) => Err(Failure::input(
            format!("--at {}", Typed(*t)),
            format!("outside of the run, which lasts from {start} to {end}"),
        )),
    }
}

fn positions(
    arguments: &SurfaceArguments,
    trajectory: &Trajectory,
    times: usize,
) -> Result<Vec<f64>, Failure> {
    if let Some(x) = &arguments.x {
        return match x.iter().find(|x| !x.is_finite()) {
            None => Ok(x.clone()),
            Some(x) => Err(Failure::input(format!("--x {}", Typed(*x)), "must be finite numbers")),
        };
    }
    let (low, high) = match arguments.range.as_deref() {
        None => default_range(trajectory),
        Some(&[low, high]) if low.is_finite() && high.is_finite() && low < high => (low, high),
        Some(range) => {
            let typed: Vec<String> = range.iter().map(|x| Typed(*x).to_string()).collect();
            let advice = "needs two finite numbers LO,HI with LO below HI";
            return Err(Failure::input(format!("--range {}", typed.join(",")), advice));
        }
    };
    let spacing = arguments.spacing.unwrap_or(DEFAULT_SPACING);
    let named = format!("--spacing {}", Typed(spacing));
    if !(spacing.is_finite() && spacing > 0.0) {
        return Err(Failure::input(named, "must be a finite number above 0"));
    }
    let points = (high - low) / spacing * times as f64;
    if points > MOST_POINTS {
        let least = (high - low) / MOST_POINTS * times as f64;
        return Err(Failure::input(
            named,
            format!(
                "would make {points:.1e} points, more than fit in memory; {least:.3e} or above will do"
            ),
        ));
    }
    let intervals = ((high - low) / spacing + 1e-9).floor() as usize;
    Ok((0..=intervals).map(|i| low + spacing * i as f64).collect())
}

fn curves(
    arguments: &SurfaceArguments,
    surface: &Surface,
    times: &[f64],
    x: &[f64],
) -> Result<Vec<SurfaceCurve>, Failure> {
    let at = |t: &f64| {
        let u =
            if arguments.far_behind { surface.far_behind(*t, x) } else { surface.heights(*t, x) };
        let u = u.map_err(|error| Failure::Run(error.to_string()))?.to_vec();
        Ok(SurfaceCurve { t: *t, x: x.to_vec(), u })
    };
    times.iter().map(at).collect()
}

fn assemble(
    arguments: &SurfaceArguments,
    run: &RunDocument,
    surfaces: Vec<SurfaceCurve>,
) -> SurfaceDocument {
    SurfaceDocument {
        format: SurfaceDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: SurfaceParameters {
            model: run.parameters.model.clone(),
            far_behind: arguments.far_behind,
        },
        surfaces,
    }
}

fn write(document: &SurfaceDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    let surfaces = &document.surfaces;
    match format {
        OutputFormat::Json => output.write_json(document),
        OutputFormat::Csv => {
            let t: Vec<f64> = surfaces.iter().flat_map(|s| s.x.iter().map(|_| s.t)).collect();
            let x: Vec<f64> = surfaces.iter().flat_map(|s| s.x.iter().copied()).collect();
            let u: Vec<f64> = surfaces.iter().flat_map(|s| s.u.iter().copied()).collect();
            output.write_csv("t,x,u", &[&t, &x, &u])
        }
        OutputFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("t", &surfaces.iter().map(|s| s.t).collect::<Vec<_>>())?;
            npz.vector("x", surfaces.first().map_or(&[], |s| s.x.as_slice()))?;
            npz.matrix("u", &surfaces.iter().map(|s| s.u.clone()).collect::<Vec<_>>())?;
            output.write_bytes(&npz.bytes()?)
        }
    }
}

fn draw(document: &SurfaceDocument) -> String {
    let model = &document.parameters.model;
    let title = format!("α = {:.6}, r = {}", model.alpha, model.r);
    let label = |s: &SurfaceCurve| format!("t = {}", (s.t * 1e6).round() / 1e6);
    let curves: Vec<(String, &[f64], &[f64])> =
        document.surfaces.iter().map(|s| (label(s), s.x.as_slice(), s.u.as_slice())).collect();
    plot::surface(&plot::SurfaceFigure { title: &title, curves: &curves })
}
