//! `stickslip sweep`.

pub(crate) mod divided;
pub(crate) mod merge;

use super::ask::refusal;
use super::finished::{Finished, Part, Parts};
use super::job::{Job, judge_places};
use super::progress::Progress;
use crate::arguments::{
    AnswerArguments, Length, Range, RasterSweepArguments, SweepArguments, SweepThen, TipArguments,
    WorkArguments,
};
use crate::commands::in_units::scales;
use crate::commands::model::tip;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::session::Session;
use divided::Divided;
use serde_json::{Value, json};
use std::collections::HashSet;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip::{
    Ask, Context, Document, Physical, Points, RasterSweep, RasterSweepPoint, Sweep, Tip,
    each_point, parameter,
};
use stickslip_figures::judge_sweep;

const MOST_THREADS: usize = 4096;
/// Largest number of footprints; each is prepared separately.
const MOST_TIPS: usize = 10_000;

impl Part for RasterSweepPoint {
    type All = Vec<Self>;

    fn index(&self) -> usize {
        self.index
    }

    fn text(&self) -> io::Result<String> {
        Ok(serde_json::to_string(self)?)
    }

    fn of_text(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }
}

pub(crate) fn sweep(session: &Session, arguments: &SweepArguments) -> Result<(), Failure> {
    match &arguments.then {
        Some(SweepThen::Merge(merged)) => return merge::merge(session, merged),
        Some(SweepThen::Raster(rasters)) => return raster(session, rasters),
        None => {}
    }
    let SweepArguments { work, answer, tip_file, .. } = arguments;
    let place = Place { session, work, answer };
    place.judge(&[("--tip-file", tip_file.as_deref())])?;
    let mut values = arguments.options.values(session)?;
    values.insert("tips".into(), tips(session, arguments)?);
    values.insert("width".into(), json!(arguments.width.as_ref().map(Range::values)));
    values.insert("beta".into(), json!(arguments.beta.as_ref().map(Range::values)));
    let question = parameter::question::<Sweep>(values)?;
    let grid = Sweep { shard: work.shard, ..question }.grid();
    let footprint = TipArguments { tip_file: tip_file.clone(), ..TipArguments::default() };
    let grid = grid.map_err(|failure| refusal(failure, &footprint, &[]))?;
    if answer.plot.is_some() {
        // Before hours of work.
        judge_sweep(&grid).map_err(|error| Failure::input("--plot", error))?;
    }
    place.answer(grid, tip_file.as_deref())
}

/// The pattern of a raster over pitch and α.
fn raster(session: &Session, arguments: &RasterSweepArguments) -> Result<(), Failure> {
    let RasterSweepArguments { options, work, answer } = arguments;
    let place = Place { session, work, answer };
    place.judge(&options.files())?;
    let question = parameter::question::<RasterSweep>(options.values(session)?)?;
    let question = RasterSweep { shard: work.shard, ..question };
    let grid = question
        .resolved(&Context::default())
        .map_err(|failure| refusal(failure, &options.tip, &[]))?;
    place.answer(grid, options.tip.tip_file.as_deref())
}

/// The footprints, widths times β.
fn tips(session: &Session, arguments: &SweepArguments) -> Result<Value, Failure> {
    let SweepArguments { tip: name, tip_file, retrace, beta, width, .. } = arguments;
    let count = |range: &Option<Range>| range.as_ref().map_or(1, Range::points);
    for (option, tips) in [("--beta", count(beta)), ("--width", count(width))] {
        if tips > MOST_TIPS {
            let message = format!("{tips} values; at most {MOST_TIPS} are accepted");
            return Err(Failure::input(option, message));
        }
    }
    let values = |range: &Option<Range>| match range {
        Some(range) => range.values().into_iter().map(Some).collect(),
        None => vec![None],
    };
    let (widths, betas) = (values(width), values(beta));
    let both = widths.iter().flat_map(|width| betas.iter().map(move |beta| (*width, *beta)));
    let one = |(width, beta): (Option<f64>, Option<f64>)| {
        let tip_file = tip_file.clone();
        let width = width.map(Length::Bare);
        tip(session, &TipArguments { tip: *name, beta, width, tip_file, retrace: *retrace })
            .map(Tip)
    };
    Ok(json!(both.map(one).collect::<Result<Vec<Tip>, Failure>>()?))
}

/// How points are computed, and where they go.
struct Place<'a> {
    session: &'a Session,
    work: &'a WorkArguments,
    answer: &'a AnswerArguments,
}

impl Place<'_> {
    fn judge(&self, read: &[(&'static str, Option<&Path>)]) -> Result<(), Failure> {
        threads(self.work.threads)?;
        judge_places(&self.answer.outlet, self.answer.plot.as_deref(), read)
    }

    /// Computes the points that are not saved yet, each saved when it is complete, and writes the document.
    fn answer<Q: Ask + Points>(&self, grid: Q, tip_file: Option<&Path>) -> Result<(), Failure>
    where
        Document<Q>: Divided<Point = Q::Point, Parameters = Q>,
        Q::Point: Part,
    {
        let AnswerArguments { in_units, outlet, plot } = self.answer;
        let scales = scales(self.session, in_units, tip_file, grid.support_velocity())?;
        let job = Job::open(self.session, Q::FORMAT, outlet, plot.as_deref())?;
        let indices = grid.indices();
        let is_done = |file| merge::is_done::<Document<Q>>(self.session, file, &grid, &indices);
        if self.work.if_needed && job.file().is_some_and(is_done) {
            return Ok(());
        }
        let has = |index| indices.binary_search(&index).is_ok();
        let finished = Finished::beside(self.session, job.file(), &grid, has)?;
        let threads = self.work.threads.unwrap_or(0);
        let mut finished = compute(self.session, &grid, indices, finished, threads)?;
        let points = finished.take_in_order();
        let document = <Document<Q> as Divided>::of(grid, points);
        job.finish(document.sealed()?.in_units(scales.as_ref()))?;
        finished.remove();
        Ok(())
    }
}

/// Computes those of the `missing` points that are not finished yet.
fn compute<Q: Points>(
    session: &Session,
    grid: &Q,
    mut missing: Vec<usize>,
    mut finished: Finished<Q::Point>,
    threads: usize,
) -> Result<Finished<Q::Point>, Failure>
where
    Q::Point: Part,
{
    let (done, count) = (finished.parts().count(), missing.len());
    if done > 0 {
        let there: HashSet<usize> = finished.parts().indices().collect();
        missing.retain(|index| !there.contains(index));
    }
    finished.announce(session, done, count);
    let interrupt = Interrupt::listen(session)?;
    let so_far = Arc::new(AtomicUsize::new(done));
    finished.need_not_end(&interrupt, &so_far, count);
    let mut progress = Progress::new(session, done as f64, count as f64).at_every_call();
    let mut kept: io::Result<()> = Ok(());
    let context = Context::cancelled_by(Arc::clone(interrupt.flag()));
    let computed = each_point(grid, &missing, threads, &context, |point| {
        kept = finished.add(point);
        let done = so_far.fetch_add(1, Ordering::Relaxed) + 1;
        progress.counted(done as f64, || format!("{done} of {count} points"));
        kept.is_ok()
    });
    kept.map_err(|error| finished.unkept(error))?;
    if let Some(signal) = interrupt.signal() {
        return Err(finished.unfinished(finished.parts().count(), count, signal));
    }
    computed?;
    Ok(finished)
}

/// The number of threads; 0 for one per core.
pub(super) fn threads(asked: Option<usize>) -> Result<usize, Failure> {
    match asked.filter(|n| !(1..=MOST_THREADS).contains(n)) {
        None => Ok(asked.unwrap_or(0)),
        Some(n) => {
            let message = format!("must be 1 to {MOST_THREADS}");
            Err(Failure::input(format!("--threads {n}"), message))
        }
    }
}
