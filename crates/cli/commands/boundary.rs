//! `stickslip boundary`.

mod raster;
mod wider;

use super::figure::{Figure, undrawn};
use super::in_units::scales;
use super::job::Job;
use super::model::{refuse_endless, tip, wider};
use super::progress::Progress;
use crate::arguments::{BoundaryArguments, Interval};
use crate::failure::Failure;
use crate::files::distinct::distinct;
use stickslip_documents::{
    BoundaryDocument, BoundaryParameters, OnsetColumns, Physical, SpacingName,
};
use stickslip_figures::{Size, View};
use stickslip_stability::{Boundary, Critical, StabilityError};
use stickslip_tip::{TipFunction, Wider};

const DEFAULT_POINTS: usize = 200;
const MOST_POINTS: usize = 100_000;

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
    let range = range(OPTION, typed, arguments.points)?;
    refuse_endless(&arguments.tip, &arguments.wider)?;
    let law = wider(&arguments.wider);
    let papers = law.is_papers() && tip != TipFunction::Cosine;
    let job = Job::open::<BoundaryDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let plot_onset = Figure::asked("--plot-onset", arguments.plot_onset.as_deref())?;

    let spacing =
        if arguments.logarithmic { SpacingName::Logarithmic } else { SpacingName::Linear };
    let (ends, points) = range;
    let asked = Asked { ends, values: abscissas(ends, points, spacing), spacing };
    let document = if papers {
        document(&asked, &tip, typed)?
    } else {
        wider::document(&asked, (&law, &tip), typed)?
    };
    let document = document.in_units(scales.as_ref());
    if let Some(figure) = plot_onset {
        let onset = stickslip_figures::onset_of(&document, &View::default())
            .map_err(|error| undrawn(&error))?;
        figure.write(&onset, &Size::default())?;
    }
    job.finish(document)
}

const OPTION: &str = "--r-range";

/// The r asked for.
struct Asked {
    ends: [f64; 2],
    values: Vec<f64>,
    spacing: SpacingName,
}

impl Asked {
    fn parameters(&self, law: &Wider, tip: &TipFunction) -> BoundaryParameters {
        BoundaryParameters::new((tip, law), self.ends, (self.values.len(), self.spacing))
    }
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
        (None, points) => ("--points", points.unwrap_or(DEFAULT_POINTS)),
    };
    if !(2..=MOST_POINTS).contains(&points) {
        let message = format!("2 to {MOST_POINTS} will do");
        return Err(Failure::input(format!("{option} {points}"), message));
    }
    Ok(([low, high], points))
}

/// The values asked for, both ends exactly.
fn abscissas([low, high]: [f64; 2], points: usize, spacing: SpacingName) -> Vec<f64> {
    let last = points - 1;
    let between = |i: usize| {
        let part = i as f64 / last as f64;
        match spacing {
            SpacingName::Linear => low + part * (high - low),
            SpacingName::Logarithmic => low * (high / low).powf(part),
        }
    };
    (0..points).map(|i| if i == last { high } else { between(i) }).collect()
}

fn document(
    asked: &Asked,
    tip: &TipFunction,
    typed: &Interval,
) -> Result<BoundaryDocument, Failure> {
    let refused = |error: StabilityError| typed.refused(OPTION, error);
    let boundary = Boundary::new(tip);
    let points = asked.values.len();
    let mut progress = Progress::new(0.0, 2.0 * points as f64).at_every_call();
    let mut done = 0.0;
    let mut found = Vec::with_capacity(points);
    for r in &asked.values {
        found.push(boundary.at(*r));
        done += 1.0;
        progress.counted(done, || format!("{done} of {} steps", 2 * points));
    }
    let first_error = found.iter().find_map(|at| at.err());
    let along: Vec<Critical> = found.into_iter().filter_map(Result::ok).collect();
    if let (true, Some(error)) = (along.is_empty(), first_error) {
        return Err(refused(error));
    }
    let left_out = points - along.len();
    let [low, high] = asked.ends;
    let branches = boundary.branches(low, high, points).map_err(refused)?;
    let mut onset = OnsetColumns::default();
    for at in &along {
        onset.push(tip, at);
        done += 1.0;
        progress.counted(done, || format!("{done} of {} steps", 2 * points));
    }
    let remark = first_error.map(|error| format!("{left_out} values of r are left out: {error}"));
    let parameters = asked.parameters(&Wider::default(), tip);
    Ok(BoundaryDocument {
        branches: branches.into_iter().map(Into::into).collect(),
        remarks: remark.into_iter().collect(),
        ..BoundaryDocument::new(parameters, along.iter(), onset)
    })
}
