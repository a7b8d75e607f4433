//! `stickslip boundary`.

use super::ask::{answered, asked, option};
use super::figure::{Figure, undrawn};
use super::job::Job;
use crate::arguments::BoundaryArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::session::Session;
use stickslip::{Boundary, BoundaryDocument, LoadMap, RasterBoundary, SnakingBoundary, parameter};
use stickslip_figures::{Size, View};

pub(crate) fn boundary(session: &Session, arguments: &BoundaryArguments) -> Result<(), Failure> {
    let BoundaryArguments { options, answer, plot_onset } = arguments;
    let written = [
        ("--output", Some(&*answer.outlet.output)),
        ("--plot", answer.plot.as_deref()),
        ("--plot-onset", plot_onset.as_deref()),
    ];
    distinct(&written, &options.files())?;
    let values = options.values(session)?;
    if values.contains_key("pitch_range") {
        return asked::<RasterBoundary, _>(session, options, values, answer, "--pitch-range");
    }
    let is_given = |name: &str| values.contains_key(name);
    if is_given("load_range") || is_given("load") {
        return asked::<LoadMap, _>(session, options, values, answer, "--load-range");
    }
    if is_given("stiffness_range") {
        return asked::<SnakingBoundary, _>(session, options, values, answer, "--stiffness-range");
    }
    if is_given("r_range") && is_given("stiffness_across") {
        return asked::<SnakingBoundary, _>(session, options, values, answer, "--stiffness-across");
    }
    if let Some(name) = parameter::stranger::<Boundary>(&values) {
        let message = "applies to neighbouring scan lines: give --pitch-range too, or leave it out";
        return Err(Failure::input(option(name), message));
    }
    let question: Boundary = parameter::question(values)?;
    let job = Job::open::<BoundaryDocument>(session, &answer.outlet, answer.plot.as_deref())?;
    let plot_onset = Figure::asked("--plot-onset", plot_onset.as_deref())?;
    let document = answered(session, question, answer, options.tip.tip_file.as_deref())?;
    if let Some(figure) = plot_onset {
        let onset = stickslip_figures::onset_of(&document, &View::default())
            .map_err(|error| undrawn(&error))?;
        figure.write(&onset, &Size::default())?;
    }
    job.finish(document)
}
