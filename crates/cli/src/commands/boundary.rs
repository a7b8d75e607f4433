//! `stickslip boundary`.

use super::ask::{answer_values, answered, option};
use super::figure::{Figure, drawing_failure};
use super::job::Job;
use crate::arguments::BoundaryArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::measured::read_measured;
use crate::session::Session;
use serde_json::{Value, json};
use std::path::Path;
use stickslip::{Boundary, BoundaryDocument, LoadMap, RasterBoundary, SnakingBoundary, parameter};
use stickslip_figures::{Size, View};
use stickslip_tables::Sheet;
use stickslip_tip::sorting::sort_by_number;
use stickslip_units::Unit;

const LOAD_WIDTHS: &str = "--load-widths";
const NANO: f64 = 1e9;

/// The table of widths over loads, in nN if a heading does not say otherwise.
fn widths(session: &Session, path: &Path) -> Result<Value, Failure> {
    let refused = |why: String| Failure::file(LOAD_WIDTHS, path, why);
    let Sheet { headings, columns, .. } = read_measured(session, LOAD_WIDTHS, path, &[2])?;
    let load = headings[0].unit(Unit::Force).map_err(refused)?;
    headings[1].unit(Unit::Length).map_err(refused)?;
    let factor = load.map_or(1.0, |(_, newtons)| NANO * newtons);
    let mut rows: Vec<[f64; 2]> =
        columns[0].iter().zip(&columns[1]).map(|(load, width)| [factor * load, *width]).collect();
    sort_by_number(&mut rows, |item| item[0]);
    let column = |i: usize| rows.iter().map(|row| row[i]).collect::<Vec<f64>>();
    Ok(json!({ "load_nN": column(0), "width": column(1) }))
}

pub(crate) fn boundary(session: &Session, arguments: &BoundaryArguments) -> Result<(), Failure> {
    let BoundaryArguments { options, load_widths, answer, plot_onset } = arguments;
    let written = [
        ("--output", Some(&*answer.outlet.output)),
        ("--plot", answer.plot.as_deref()),
        ("--plot-onset", plot_onset.as_deref()),
    ];
    let [tip_file, parameters] = options.files();
    distinct(&written, &[tip_file, parameters, (LOAD_WIDTHS, load_widths.as_deref())])?;
    let mut values = options.values(session)?;
    if let Some(path) = load_widths {
        values.insert("load_widths".into(), widths(session, path)?);
    }
    if values.contains_key("pitch_range") {
        let chosen_by = "--pitch-range";
        return answer_values::<RasterBoundary, _>(session, options, values, answer, chosen_by);
    }
    let is_given = |name: &str| values.contains_key(name);
    if is_given("load_range") || is_given("load") || is_given("load_widths") {
        let found = answer_values::<LoadMap, _>(session, options, values, answer, "--load-range");
        return found.map_err(|failure| match (failure, load_widths) {
            (Failure::Input { option, message }, Some(path)) if option == LOAD_WIDTHS => {
                Failure::file(LOAD_WIDTHS, path, message)
            }
            (failure, _) => failure,
        });
    }
    let is_over_r = is_given("r_range") && is_given("stiffness_across");
    let snaking = is_given("stiffness_range").then_some("--stiffness-range");
    if let Some(chosen_by) = snaking.or(is_over_r.then_some("--stiffness-across")) {
        return answer_values::<SnakingBoundary, _>(session, options, values, answer, chosen_by);
    }
    if let Some(name) = parameter::unknown_parameter::<Boundary>(&values) {
        let message = "applies to neighbouring scan lines: give --pitch-range too, or leave it out";
        return Err(Failure::input(option(name), message));
    }
    let question: Boundary = parameter::question(values)?;
    let job = Job::open(session, BoundaryDocument::FORMAT, &answer.outlet, answer.plot.as_deref())?;
    let plot_onset = Figure::of_option("--plot-onset", plot_onset.as_deref())?;
    let document = answered(session, question, answer, &options.tip)?;
    if let Some(figure) = plot_onset {
        let onset = stickslip_figures::onset_of(&document, &View::default())
            .map_err(|error| drawing_failure(&error))?;
        figure.write(&onset, &Size::default())?;
    }
    job.finish(document)
}
