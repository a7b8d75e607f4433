//! `stickslip boundary`.

mod raster;

use super::asking::context;
use super::figure::{Figure, undrawn};
use super::in_units::scales;
use super::job::Job;
use super::model::{law, tip};
use crate::arguments::{BoundaryArguments, Interval};
use crate::failure::Failure;
use crate::files::distinct::distinct;
use stickslip::{Ask, Boundary, BoundaryDocument, Physical, SpacingName, Tip};
use stickslip_figures::{Size, View};

pub(crate) fn boundary(arguments: &BoundaryArguments) -> Result<(), Failure> {
    let read = [("--tip-file", arguments.tip.tip_file.as_deref())];
    let written = [
        ("--output", Some(&*arguments.outlet.output)),
        ("--plot", arguments.plot.as_deref()),
        ("--plot-onset", arguments.plot_onset.as_deref()),
    ];
    distinct(&written, &read)?;
    let tip = tip(&arguments.tip)?;
    if let Some(pitches) = &arguments.pitch_range {
        return raster::boundary(arguments, pitches, tip);
    }
    let scales = scales(&arguments.in_units, arguments.tip.tip_file.as_deref(), arguments.r)?;
    let missing = || Failure::input(OPTION, "give the range of r, LO:HI:N");
    let typed = arguments.r_range.as_ref().ok_or_else(missing)?;
    let (r_range, points) = range(OPTION, typed, arguments.points)?;
    let (spacing, law) = (spacing(arguments), law(&arguments.wider));
    let job = Job::open::<BoundaryDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let plot_onset = Figure::asked("--plot-onset", arguments.plot_onset.as_deref())?;
    let question = Boundary { tip: Tip(tip), r_range, points, spacing, law };
    let document = question.ask(&context())?.in_units(scales.as_ref());
    if let Some(figure) = plot_onset {
        let onset = stickslip_figures::onset_of(&document, &View::default())
            .map_err(|error| undrawn(&error))?;
        figure.write(&onset, &Size::default())?;
    }
    job.finish(document)
}

const OPTION: &str = "--r-range";

fn spacing(arguments: &BoundaryArguments) -> SpacingName {
    if arguments.logarithmic { SpacingName::Logarithmic } else { SpacingName::Linear }
}

/// First and last, and how many.
fn range(
    named: &str,
    range: &Interval,
    points: Option<usize>,
) -> Result<([f64; 2], usize), Failure> {
    let (low, high) = range.ends(named)?;
    if low <= 0.0 {
        return Err(range.refused(named, "needs numbers above 0, such as 0.05:3"));
    }
    let (option, points) = match (range.points(named)?, points) {
        (Some(_), Some(_)) => {
            let message = "says how many values there are, and --points too: leave one out";
            return Err(range.refused(named, message));
        }
        (Some(points), None) => (named, points),
        (None, points) => ("--points", points.unwrap_or(Boundary::DEFAULT_POINTS)),
    };
    if !(2..=Boundary::MOST_POINTS).contains(&points) {
        let message = format!("2 to {} will do", Boundary::MOST_POINTS);
        return Err(Failure::input(format!("{option} {points}"), message));
    }
    Ok(([low, high], points))
}
