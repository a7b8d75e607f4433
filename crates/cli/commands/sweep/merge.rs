//! `stickslip sweep merge`: the parts of a sweep as one.

use super::{diagram, document, format, write};
use crate::arguments::MergeArguments;
use crate::commands::figure::Figure;
use crate::documents::{SweepDocument, SweepPoint};
use crate::failure::Failure;
use crate::files::input::read_document;
use crate::files::output::Output;
use std::path::Path;

pub(super) fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    let format = format(&arguments.output)?;
    let parts = read(arguments)?;
    let whole = document(parts[0].parameters.clone(), None, interleaved(parts));
    if arguments.plot.is_some() {
        diagram::judge(&whole.parameters)?;
    }
    let output = Output::open("--output", &arguments.output)?;
    if let Some(figure) = Figure::asked("--plot", arguments.plot.as_deref())? {
        figure.write(&diagram::draw(&whole))?;
    }
    write(&whole, format, output)
}

/// The parts by number, all of one sweep and none missing.
fn read(arguments: &MergeArguments) -> Result<Vec<SweepDocument>, Failure> {
    let refused = |path: &Path, message: String| {
        Failure::input(format!("PART.json {}", path.display()), message)
    };
    let mut parts: Vec<Option<SweepDocument>> = vec![];
    for path in &arguments.parts {
        let part: SweepDocument = read_document("PART.json", path, SweepDocument::FORMAT)?;
        let shard = part.shard.ok_or_else(|| refused(path, "is a whole sweep, no part".into()))?;
        if !(1..=shard.of).contains(&shard.index) || shard.of > arguments.parts.len() {
            let (of, given) = (shard.of, arguments.parts.len());
            return Err(refused(path, format!("is one of {of} parts, of which {given} are given")));
        }
        parts.resize_with(parts.len().max(shard.of), || None);
        if let Some(other) = parts.iter().flatten().next() {
            let same = other.parameters == part.parameters
                && other.shard.is_some_and(|o| o.of == shard.of);
            if !same {
                return Err(refused(path, "is part of another sweep".into()));
            }
        }
        let expected = share(&part, shard.index, shard.of);
        if part.points.len() != expected {
            let found = part.points.len();
            return Err(refused(path, format!("has {found} points, {expected} are needed")));
        }
        if parts[shard.index - 1].replace(part).is_some() {
            return Err(refused(path, format!("is part {} a second time", shard.index)));
        }
    }
    let missing = parts.iter().position(Option::is_none);
    if let Some(i) = missing {
        return Err(Failure::input("PART.json", format!("part {} is missing", i + 1)));
    }
    Ok(parts.into_iter().flatten().collect())
}

/// How many points a part has.
fn share(part: &SweepDocument, index: usize, of: usize) -> usize {
    let parameters = &part.parameters;
    let alpha = parameters.alpha.or(parameters.alpha_above).map_or(0, |alpha| alpha.points);
    let betas = parameters.beta.map_or(1, |beta| beta.points);
    let all = betas.saturating_mul(parameters.r.points).saturating_mul(alpha);
    (all + of - index) / of
}

fn interleaved(parts: Vec<SweepDocument>) -> Vec<SweepPoint> {
    let count = parts.iter().map(|part| part.points.len()).sum();
    let of = parts.len();
    let mut points: Vec<_> = parts.into_iter().map(|part| part.points.into_iter()).collect();
    (0..count).filter_map(|i| points[i % of].next()).collect()
}
