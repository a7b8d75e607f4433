//! `stickslip friction`.

use super::ask::{context, option as parameter_option, refusal};
use super::job::{Job, judge_places};
use crate::arguments::FrictionArguments;
use crate::failure::Failure;
use crate::files::input::run_in;
use crate::files::measured::{Common, ratio, read_measured};
use crate::session::Session;
use serde_json::Value;
use std::path::Path;
use stickslip::{Ask, ForceTrack, Friction, FrictionDocument, Refused, RunForces, parameter};
use stickslip_tables::Sheet;
use stickslip_units::Unit;

const TRACE: &str = "TRACE.csv";
const RETRACE: &str = "RETRACE.csv";

pub(crate) fn friction(session: &Session, arguments: &FrictionArguments) -> Result<(), Failure> {
    let FrictionArguments { trace, retrace, options, outlet, plot, .. } = arguments;
    let [_, parameters] = options.files();
    let read = [(TRACE, Some(&**trace)), (RETRACE, retrace.as_deref()), parameters];
    judge_places(outlet, plot.as_deref(), &read)?;
    let question = question(session, arguments)?;
    let job = Job::open(session, FrictionDocument::FORMAT, outlet, plot.as_deref())?;
    let source = question.source.clone();
    let refused = |failure| match failure {
        stickslip::Failure::Refused(refused) if refused.parameter == "trace and retrace" => {
            Failure::input(source, refused.why)
        }
        other => refusal(other, &options.tip, &[]),
    };
    job.finish(question.ask(&context(session)).map_err(refused)?)
}

/// The question of the options, with the data of the files.
fn question(session: &Session, arguments: &FrictionArguments) -> Result<Friction, Failure> {
    let values = arguments.options.values(session)?;
    let mut data = Data::new(session, values.get("unit").and_then(Value::as_str))?;
    let [trace, retrace] = data.read(&arguments.trace, arguments.retrace.as_deref())?;
    let question: Friction = parameter::question(values)?;
    let written = data.force.and_then(|(_, unit)| unit);
    let force_unit = match (&question.force_unit, written) {
        (Some(given), Some(written)) if *given != written => {
            let message = format!("the headings have {written}: leave it out, or correct them");
            return Err(Failure::input(format!("--force-unit {given}"), message));
        }
        (given, written) => given.clone().or(written),
    };
    let sensitivity = sensitivity(arguments, force_unit.as_deref())?.or(question.sensitivity);
    let unit = data.lengths.unit().map(str::to_owned);
    Ok(Friction { source: data.source, unit, force_unit, sensitivity, trace, retrace })
}

/// The tables; positions and forces are converted to the units of the first.
struct Data<'a> {
    session: &'a Session,
    source: String,
    lengths: Common,
    /// The first forces: name of their column, and their unit.
    force: Option<(String, Option<String>)>,
}

impl<'a> Data<'a> {
    fn new(session: &'a Session, unit: Option<&str>) -> Result<Self, Failure> {
        let lengths = Common::lengths(unit)?;
        Ok(Self { session, source: String::new(), lengths, force: None })
    }

    /// Trace and retrace: of two files, of one with three columns, or of the last closed loop of a run.
    fn read(&mut self, trace: &Path, retrace: Option<&Path>) -> Result<[ForceTrack; 2], Failure> {
        if let Some(run) = self.run(TRACE, trace)? {
            let Some(path) = retrace else {
                return run.last_loop().map_err(|error| refused(TRACE, trace, error));
            };
            let back = self.run(RETRACE, path)?.ok_or_else(|| {
                let message = "is no run, but the trace is one: give two runs, or two tables";
                Failure::file(RETRACE, path, message)
            })?;
            return Ok([run.way(), back.way()]);
        }
        let Some(retrace) = retrace else {
            let (x, [trace, retrace]) = self.table(TRACE, trace, &[3])?;
            return Ok([
                ForceTrack { x: x.clone(), force: trace },
                ForceTrack { x, force: retrace },
            ]);
        };
        let (x, [force]) = self.table(TRACE, trace, &[2])?;
        let trace = ForceTrack { x, force };
        let (x, [force]) = self.table(RETRACE, retrace, &[2])?;
        Ok([trace, ForceTrack { x, force }])
    }

    /// The forces of a run, if the file is its document; their units are those of the run.
    fn run(&mut self, option: &str, path: &Path) -> Result<Option<RunForces>, Failure> {
        let Some(document) = run_in(self.session, option, path)? else { return Ok(None) };
        let forces = RunForces::of(&document).map_err(|error| refused(option, path, error))?;
        let named = format!("{option} {}", path.display());
        self.lengths.of_run(&named, forces.unit)?;
        self.force_factor(&named, "lateral force", Some(forces.force_unit))?;
        self.name(path);
        Ok(Some(forces))
    }

    /// Adds a file to the source of the data.
    fn name(&mut self, path: &Path) {
        let gap = if self.source.is_empty() { "" } else { ", " };
        self.source += &format!("{gap}{}", path.display());
    }

    /// Positions and forces of a table.
    fn table<const N: usize>(
        &mut self,
        option: &str,
        path: &Path,
        columns: &[usize],
    ) -> Result<(Vec<f64>, [Vec<f64>; N]), Failure> {
        let named = format!("{option} {}", path.display());
        let Sheet { headings, mut columns, .. } =
            read_measured(self.session, option, path, columns)?;
        let factor = self.lengths.factor(&named, &headings[0])?;
        let mut forces = columns.split_off(1);
        let x = columns.remove(0).into_iter().map(|x| x * factor).collect();
        for (heading, forces) in headings[1..].iter().zip(&mut forces) {
            let factor = self.force_factor(&named, heading.text(), heading.written_unit())?;
            forces.iter_mut().for_each(|force| *force *= factor);
        }
        self.name(path);
        let count = forces.len();
        let forces = forces.try_into().map_err(|_| {
            Failure::input(named, format!("{} columns; {} are needed", count + 1, N + 1))
        })?;
        Ok((x, forces))
    }

    /// The factor from the unit of these forces to that of the first.
    fn force_factor(
        &mut self,
        named: &str,
        column: &str,
        unit: Option<&str>,
    ) -> Result<f64, Failure> {
        let (first, known) =
            self.force.get_or_insert_with(|| (column.to_owned(), unit.map(str::to_owned)));
        ratio(unit, known.as_deref()).ok_or_else(|| {
            let of = |unit: Option<&str>| unit.map_or("has no unit".into(), |u| format!("is in {u}"));
            let (unit, known) = (of(unit), of(known.as_deref()));
            let message = format!(
                "`{column}` {unit}, and `{first}` {known}: both need a unit of the same quantity, such as nN and pN"
            );
            Failure::input(named, message)
        })
    }
}

fn refused(option: &str, path: &Path, error: Refused) -> Failure {
    Failure::file(option, path, error.reason(parameter_option))
}

/// Force in N of one unit of the data, by --stiffness or --sensitivity.
fn sensitivity(arguments: &FrictionArguments, unit: Option<&str>) -> Result<Option<f64>, Failure> {
    let needs = |option: &str, message: String| Err(Failure::input(option, message));
    if let Some(text) = &arguments.stiffness {
        let named = format!("--stiffness {text}");
        let stiffness =
            Unit::Stiffness.parse(text).map_err(|error| Failure::input(&named, error))?;
        return match unit.map(|unit| (unit, Unit::Length.one(unit))) {
            Some((_, Some(metres))) => Ok(Some(stiffness * metres)),
            Some((unit, None)) => needs(
                &named,
                format!(
                    "applies to deflections in a unit of length; the data are in {unit}: leave it out"
                ),
            ),
            None => needs(
                &named,
                "the unit of the deflections is not known: give it by --force-unit".into(),
            ),
        };
    }
    let Some(text) = &arguments.sensitivity else { return Ok(None) };
    let named = format!("--sensitivity {text}");
    let parts = text
        .split_once('/')
        .and_then(|(force, per)| Some((Unit::Force.parse(force).ok()?, per.trim())));
    match (parts, unit) {
        (Some((force, per)), Some(unit)) => match ratio(Some(unit), Some(per)) {
            Some(factor) => Ok(Some(force * factor)),
            None => needs(&named, format!("the data are in {unit}, not in {per}")),
        },
        (Some((force, _)), None) => Ok(Some(force)),
        (None, _) => {
            needs(&named, "must be a force over the unit of the data, such as 25nN/V".into())
        }
    }
}
