//! `stickslip raster`.

mod scan;

use super::ask::{context, refusal};
use super::job::{Job, format};
use super::run::disturbance::{parse_pulses, warn_of_pulses_outside};
use super::sweep::threads;
use crate::arguments::{AreaArguments, Format, Options, Questions, RasterArguments};
use crate::commands::in_units::in_metres;
use crate::failure::Failure;
use crate::files::columns::read_area;
use crate::files::distinct::{Named, distinct};
use crate::interrupt::Interrupt;
use crate::session::Session;
use serde_json::{Map, Value};
use stickslip::{
    AreaDocument, Ask, HeightMap, KnownScales, Physical, Raster, RasterDocument, on_threads,
    parameter,
};
use stickslip_raster::Plan;
use stickslip_tables::{Frame, gsf};
use stickslip_tip::threads::count;

pub(crate) fn raster(session: &Session, arguments: &RasterArguments) -> Result<(), Failure> {
    let RasterArguments { options, area, pulse, output, plot, .. } = arguments;
    let threads = count(threads(arguments.threads)?);
    let read = files_read(options, area);
    distinct(&[("--output", Some(&**output)), ("--plot", plot.as_deref())], &read)?;
    let is_gsf = arguments.format.is_none()
        && output.extension().is_some_and(|e| e.eq_ignore_ascii_case("gsf"));
    let format =
        if is_gsf { Format::Json } else { format(session, arguments.format, output, ", .gsf")? };
    let values = options.values(session)?;
    let scales = options.scales(session, &arguments.in_units, &values)?;
    let (question, plan) = question(session, options, values, (area, pulse), scales.as_ref())?;
    let times = question.times(&plan)?;
    let in_metres = is_gsf.then(|| in_metres(scales.as_ref())).transpose()?;
    let job = Job::of_format(
        session,
        RasterDocument::FORMAT,
        format,
        output,
        &arguments.fields,
        plot.as_deref(),
    )?
    .on_threads(threads);
    let interrupt = Interrupt::listen(session)?;
    // All of it on one of these threads: a thread that sleeps meanwhile may wake on the processor of another.
    on_threads(threads, || {
        let (lines, finished) =
            scan::scan(session, &plan, &question, job.file(), &interrupt, threads)?;
        let document = question.document(&plan, &lines, &times).in_units(scales.as_ref());
        if let Some(unit) = in_metres {
            let map = document.height_map().map_err(Failure::run)?;
            let bytes = field(&document.parameters, &map, unit);
            job.finish_bytes(&bytes, document)?;
        } else {
            job.finish(document)?;
        }
        finished.remove();
        Ok(())
    })?
}

/// The input files of a raster.
pub(super) fn files_read<'a, Q: Questions>(
    options: &'a Options<Q>,
    area: &'a AreaArguments,
) -> [Named<'a>; 3] {
    let [tip_file, parameters] = options.files();
    [tip_file, parameters, ("--area", area.area.as_deref())]
}

/// The resolved question and its plan.
pub(super) fn question<Q: Questions>(
    session: &Session,
    options: &Options<Q>,
    values: Map<String, Value>,
    (area, pulse): (&AreaArguments, &[String]),
    scales: Option<&KnownScales>,
) -> Result<(Raster, Plan), Failure> {
    let files = files_read(options, area);
    let mut question: Raster = parameter::question(values)?;
    if let Some(file) = &area.area {
        question.area = Some(AreaDocument::of(&read_area(session, "--area", file, scales)?));
    }
    if !pulse.is_empty() {
        question.pulses = parse_pulses(pulse)?;
    }
    let refused = |failure| refusal(failure, &options.tip, &files);
    let question = question.resolved(&context(session)).map_err(refused)?;
    let plan = question.plan().map_err(refused)?;
    warn_of_pulses_outside(session, pulse, &question.pulses, (0.0, plan.duration(0)));
    Ok((question, plan))
}

/// An evenly spaced map, in σ and kσ²/a times these factors.
pub(in crate::commands) fn field(
    parameters: &Raster,
    map: &HeightMap,
    (length, height, unit): (f64, f64, &str),
) -> Vec<u8> {
    let spacing = |v: &[f64]| match v {
        [first, .., last] => length * (last - first) / (v.len() - 1) as f64,
        _ => length,
    };
    let first = |v: &[f64]| length * v.first().copied().unwrap_or(0.0);
    let model = parameters.model_parameters();
    let frame = Frame {
        title: &format!("u(x,y) of a raster, alpha {}, r {}", model.alpha, model.r),
        counts: [map.x.len(), map.y.len()],
        first: [first(&map.x), first(&map.y)],
        spacing: [spacing(&map.x), spacing(&map.y)],
        unit,
    };
    gsf(&frame, &map.u, height)
}
