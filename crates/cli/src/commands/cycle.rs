//! `stickslip cycle`, and the cycle that `stickslip continue` begins with.

use super::ask::answer;
use super::job::judge_places;
use crate::arguments::{CycleArguments, Options, Questions};
use crate::failure::Failure;
use crate::files::input::read_document;
use crate::session::Session;
use serde_json::{Map, Value};
use std::path::Path;
use stickslip::{Cycle, CycleDocument, Unusable, parameter};

pub(crate) fn cycle(session: &Session, arguments: &CycleArguments) -> Result<(), Failure> {
    let CycleArguments { options, from, answer: place } = arguments;
    // Another cycle may take the place of the one that it came from; the same one again would be for nothing.
    let is_another = ["r", "alpha", "alpha_above"].into_iter().any(|name| options.has(name));
    let [tip_file, parameters] = options.files();
    let read = [tip_file, parameters, ("--from", from.as_deref().filter(|_| !is_another))];
    judge_places(&place.outlet, place.plot.as_deref(), &read)?;
    let start = from.as_deref().map(|path| read_cycle(session, path)).transpose()?;
    let values = values(session, options, start.as_ref())?;
    let question: Cycle = parameter::question(values)?;
    let start = start.as_ref().map(|(path, document)| again(path, document)).transpose()?;
    let question = Cycle { start: start.and_then(|again| again.start), ..question };
    answer(session, question, place, &options.tip)
}

/// An initial cycle, and its file.
pub(super) type Start<'a> = (&'a Path, CycleDocument);

pub(super) fn read_cycle<'a>(session: &Session, path: &'a Path) -> Result<Start<'a>, Failure> {
    Ok((path, read_document(session, "--from", path)?))
}

fn again(path: &Path, document: &CycleDocument) -> Result<Cycle, Failure> {
    let unusable = |error: Unusable| Failure::file("--from", path, error);
    Cycle::again(document).map_err(unusable)
}

/// The options, which replace the footprint, law, α and r of an initial cycle.
pub(super) fn values<Q: Questions>(
    session: &Session,
    options: &Options<Q>,
    start: Option<&Start>,
) -> Result<Map<String, Value>, Failure> {
    let Some((_, document)) = start else { return options.values(session) };
    if options.tip.is_given()
        && super::model::tip(session, &options.tip)? != document.parameters.tip.0
    {
        let message = "the footprint is given by the document: leave --tip and its options out";
        return Err(Failure::input("--from", message));
    }
    let Value::Object(mut base) =
        serde_json::to_value(&document.parameters).map_err(Failure::run)?
    else {
        return options.values(session);
    };
    base.retain(|name, _| !["tolerance", "points"].contains(&name.as_str()));
    options.values_instead_of(session, base)
}
