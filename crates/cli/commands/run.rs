//! `stickslip run`.

pub(crate) mod document;
pub(crate) mod limits;
pub(crate) mod samples;

use super::figure::Figure;
use super::model::model;
use super::progress::Progress;
use crate::arguments::{MemoryName, RunArguments, StartName};
use crate::documents::RunDocument;
use crate::failure::{Failure, Typed};
use crate::files::input::read_columns;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use crate::interrupt::Interrupt;
use crate::plot;
use document::Inputs;
use limits::within_range;
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip_surface::{Surface, SurfaceError};
use stickslip_tip::{
    Force, MemoryChoice, Noise, Pulse, Run, RunError, Scenario, Start, run_observed,
};

const DEFAULT_NOISE_SPACING: f64 = 0.1;
const DEFAULT_SEED: u64 = 1;

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    let inputs = read_inputs(arguments)?;
    let scenario = scenario(arguments, &inputs)?;
    within_range(&arguments.model, &scenario)?;
    scenario.validate().map_err(|error| explain(&error, arguments))?;
    let span = (scenario.start_time(), scenario.until);
    let times = samples::times(&arguments.sampling, span, "the run")?;
    let output = Output::open("--output", &arguments.output)?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;

    let (finished, seconds, signal) = integrate(arguments, &scenario)?;
    let document = document::of(arguments, &scenario, &inputs, &finished, &times, seconds);
    write(&document, format, output)?;
    if arguments.output != std::path::Path::new("-") {
        eprintln!("{}", summary(&document));
    }
    if let Some(figure) = figure {
        figure.write(&draw(&document, &scenario, &finished)?)?;
    }
    signal.map_or(Ok(()), |signal| Err(Failure::Interrupted(signal)))
}

fn read_inputs(arguments: &RunArguments) -> Result<Inputs, Failure> {
    let read = |option, path: &Option<std::path::PathBuf>, heading| {
        path.as_deref().map(|path| read_columns(option, path, heading)).transpose()
    };
    Ok(Inputs {
        profile: read("--initial-surface", &arguments.initial_surface, "x,u")?,
        force: read("--force-file", &arguments.force_file, "t,force")?,
        pulses: arguments.pulse.iter().map(|text| parse_pulse(text)).collect::<Result<_, _>>()?,
    })
}

/// A, T and W of `--pulse`.
pub(crate) fn parse_pulse(text: &str) -> Result<Pulse, Failure> {
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

fn scenario(arguments: &RunArguments, inputs: &Inputs) -> Result<Scenario, Failure> {
    let model = model(&arguments.model)?;
    let force = Force::new(inputs.pulses.clone(), inputs.force.clone()).map_err(|error| {
        use stickslip_tip::ForceError as E;
        let path = arguments.force_file.as_deref().unwrap_or(std::path::Path::new(""));
        match error {
            E::Table(error) => Failure::input(format!("--force-file {}", path.display()), error),
            error => Failure::input("--pulse", error),
        }
    })?;
    let noise = arguments.noise.map(|amplitude| Noise {
        amplitude,
        spacing: arguments.noise_spacing.unwrap_or(DEFAULT_NOISE_SPACING),
        seed: arguments.seed.unwrap_or(DEFAULT_SEED),
    });
    Ok(Scenario {
        start: arguments.start.into(),
        start_position: arguments.start_position,
        kick: arguments.kick,
        noise,
        profile: inputs.profile.clone(),
        force,
        tolerance: arguments.tolerance,
        memory: arguments.memory.into(),
        ..Scenario::new(model, arguments.until)
    })
}

/// Names the option that an error of the library is about.
fn explain(error: &RunError, arguments: &RunArguments) -> Failure {
    let option = match error {
        RunError::TooFar { .. } if arguments.start_position.abs() > 1e3 => {
            format!("--start-position {}", arguments.start_position)
        }
        RunError::Profile(_) => {
            let path = arguments.initial_surface.as_deref().unwrap_or(std::path::Path::new(""));
            format!("--initial-surface {}", path.display())
        }
        _ => match option_at_fault(error) {
            Some(option) => option,
            None => return Failure::Run(error.to_string()),
        },
    };
    Failure::input(option, error)
}

/// The option that an error is about, as far as the error itself tells; `None` for a failure at run time.
pub(crate) fn option_at_fault(error: &RunError) -> Option<String> {
    Some(match error {
        RunError::StartPosition(x) => format!("--start-position {}", Typed(*x)),
        RunError::Kick(kick) => format!("--kick {}", Typed(*kick)),
        RunError::Until { until, .. } => format!("--until {}", Typed(*until)),
        RunError::Tolerance(tolerance) | RunError::TooFar { tolerance, .. } => {
            format!("--tolerance {}", Typed(*tolerance))
        }
        RunError::Noise { noise, .. } => {
            format!("--noise {} --noise-spacing {}", Typed(noise.amplitude), Typed(noise.spacing))
        }
        RunError::Modes(_) => "--memory modes".into(),
        RunError::Profile(_) => "--initial-surface".into(),
        RunError::Integration(_) => return None,
    })
}

impl From<StartName> for Start {
    fn from(name: StartName) -> Self {
        match name {
            StartName::Steady => Self::Steady,
            StartName::Flat => Self::Flat,
        }
    }
}

impl From<MemoryName> for MemoryChoice {
    fn from(name: MemoryName) -> Self {
        match name {
            MemoryName::Auto => Self::Auto,
            MemoryName::Direct => Self::Direct,
            MemoryName::Fft => Self::Fft,
            MemoryName::Modes => Self::Modes,
        }
    }
}

/// The run, the seconds that it took, and the signal that stopped it.
fn integrate(
    arguments: &RunArguments,
    scenario: &Scenario,
) -> Result<(Run, f64, Option<u8>), Failure> {
    let interrupt = Interrupt::listen()
        .map_err(|error| Failure::Run(format!("cannot listen for signals: {error}")))?;
    let mut progress = Progress::new(scenario.start_time(), scenario.until);
    let started = Instant::now();
    let run = run_observed(scenario, |step| {
        progress.reached(step.end());
        if interrupt.signal().is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let seconds = started.elapsed().as_secs_f64();
    let run = run.map_err(|error| explain(&error, arguments))?;
    let signal = interrupt.signal().filter(|_| run.interrupted);
    Ok((run, seconds, signal))
}

fn write(document: &RunDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    let samples = &document.samples;
    match format {
        OutputFormat::Json => output.write_json(document),
        OutputFormat::Csv => output.write_csv(
            "t,l,x0,velocity",
            &[&samples.t, &samples.l, &samples.x0, &samples.velocity],
        ),
        OutputFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("t", &samples.t)?;
            npz.vector("l", &samples.l)?;
            npz.vector("x0", &samples.x0)?;
            npz.vector("velocity", &samples.velocity)?;
            npz.vector("history_nodes", &document.history.nodes)?;
            npz.vector("history_weights", &document.history.weights)?;
            npz.vector("history_t", &document.history.t)?;
            npz.vector("history_extension", &document.history.extension)?;
            npz.matrix("history_displacement", &document.history.displacement)?;
            output.write_bytes(&npz.bytes()?)
        }
    }
}

/// Points of the drawn surface.
const DRAWN_POINTS: usize = 4000;

fn draw(document: &RunDocument, scenario: &Scenario, run: &Run) -> Result<String, Failure> {
    let failed = |error: SurfaceError| Failure::Run(format!("cannot draw: {error}"));
    let (end, start) = (run.trajectory.end(), run.trajectory.start());
    let (low, high) = super::surface::default_range(&run.trajectory);
    let x = super::surface::evenly(low, high, DRAWN_POINTS);
    let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
    let u = surface.heights(end, &x).map_err(failed)?.to_vec();
    let before = surface.heights(start, &x).map_err(failed)?.to_vec();
    let title = title(document);
    Ok(plot::run(&plot::RunFigure {
        title: &title,
        t: &document.samples.t,
        l: &document.samples.l,
        velocity: &document.samples.velocity,
        steady_l: document.steady_state.l,
        r: scenario.model.r(),
        x: &x,
        u: &u,
        u_initial: Some(&before),
        t_of_surface: end,
    }))
}

fn title(document: &RunDocument) -> String {
    let model = &document.parameters.model;
    format!("α = {:.6}, r = {}: {}", model.alpha, model.r, document.regime)
}

/// One line for a person who sent the document to a file.
fn summary(document: &RunDocument) -> String {
    let work = &document.work;
    let motion = document.oscillation.as_ref().map_or(String::new(), |o| {
        let (period, amplitude) = (o.period, o.amplitude_x0);
        format!(", period {period:.9}, amplitude of x0 {amplitude:.9}")
    });
    format!(
        "{}{motion}: t = {} reached in {} steps with {}, {:.1} ms",
        document.regime,
        document.history.t.last().copied().unwrap_or_default(),
        work.steps,
        work.memory,
        1e3 * work.seconds
    )
}
