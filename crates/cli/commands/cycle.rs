//! `stickslip cycle`.

pub(super) mod start;

use super::figure::Figure;
use crate::arguments::CycleArguments;
use crate::failure::Failure;
use crate::files::apart::apart;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use crate::message::remark;
use crate::plot;
use start::Start;
use std::path::Path;
use std::time::Instant;
use stickslip_cycles::Cycle;
use stickslip_documents::{CycleDocument, CycleParameters, CycleProfile, ModelParameters};
use stickslip_tip::Step;

/// More do not fit in a picture, nor are they needed in a table.
const MOST_POINTS: usize = 1_000_000;
/// Points of the drawn surface.
const DRAWN_POINTS: usize = 1000;
/// Wavelengths of it.
const DRAWN_WAVELENGTHS: f64 = 2.0;

pub(crate) fn cycle(arguments: &CycleArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    apart(
        &[("--output", Some(&*arguments.output))],
        &[("--tip-file", arguments.start.model.tip.tip_file.as_deref())],
    )?;
    let start = Start::asked(&arguments.start)?;
    if !(1..=MOST_POINTS).contains(&arguments.points) {
        let option = format!("--points {}", arguments.points);
        return Err(Failure::input(option, format!("1 to {MOST_POINTS} will do")));
    }
    let output = Output::open("--output", &arguments.output)?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;

    let started = Instant::now();
    let cycle = start.solve()?;
    let parameters = CycleParameters {
        model: ModelParameters::of(cycle.model(), arguments.start.model.alpha_above),
        tolerance: arguments.start.tolerance,
    };
    let seconds = started.elapsed().as_secs_f64();
    let document = CycleDocument::of(&cycle, parameters, arguments.points, seconds);
    if let Some(figure) = figure {
        figure.write(&draw(&document, &cycle))?;
    }
    write(&document, format, output)?;
    if arguments.output != Path::new("-") {
        remark(summary(&document));
    }
    Ok(())
}

/// One line for a person who sent the cycle to a file.
fn summary(document: &CycleDocument) -> String {
    let stable = if document.stable { "stable" } else { "unstable" };
    let slips = match document.slips {
        1 => "one slip".into(),
        n => format!("{n} slips"),
    };
    let (period, amplitude) = (document.period, document.amplitude_x0);
    format!("{stable} cycle of {slips}, period {period:.9}, amplitude of x0 {amplitude:.9}")
}

fn write(document: &CycleDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    let CycleProfile { t, l, velocity } = &document.profile;
    match format {
        OutputFormat::Json => output.write_json(document),
        OutputFormat::Csv => output.write_csv("t,l,velocity", &[t, l, velocity]),
        OutputFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("t", t)?;
            npz.vector("l", l)?;
            npz.vector("velocity", velocity)?;
            output.write_bytes(&npz.bytes()?)
        }
    }
}

fn draw(document: &CycleDocument, cycle: &Cycle) -> String {
    let model = cycle.model();
    let stable = if document.stable { "stable" } else { "unstable" };
    let [alpha, r, period] = [model.alpha(), model.r(), document.period].map(plot::seven_digits);
    let title = format!("α = {alpha}, r = {r}: {stable} cycle, T = {period}");
    let length = DRAWN_WAVELENGTHS * document.wavelength;
    let x: Vec<f64> = (0..=DRAWN_POINTS).map(|i| length * i as f64 / DRAWN_POINTS as f64).collect();
    // The steps are short where the motion is fast.
    let nodes = &document.history.nodes;
    let motion = cycle.motion();
    let at = |step: &Step| [0.0].iter().chain(nodes).map(|c| step.t + step.h * c).collect();
    let t: Vec<f64> = motion.steps().iter().flat_map::<Vec<f64>, _>(at).collect();
    plot::cycle(&plot::CycleFigure {
        title: &title,
        l: &t.iter().map(|t| motion.l(*t)).collect::<Vec<_>>(),
        velocity: &t.iter().map(|t| motion.velocity(*t)).collect::<Vec<_>>(),
        t: &t,
        steady_l: model.steady_l(),
        r: model.r(),
        u: &cycle.surface_behind(&x),
        x: &x,
    })
}
