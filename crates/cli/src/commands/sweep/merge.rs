//! `stickslip sweep merge`.

use super::divided::Divided;
use crate::arguments::{AnswerArguments, MergeArguments};
use crate::commands::finished::Parts;
use crate::commands::in_units::scales;
use crate::commands::job::{Job, judge_places};
use crate::failure::Failure;
use crate::files::distinct::Named;
use crate::files::input::{format_of, read_document};
use crate::session::Session;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use stickslip::{Ask, Points, RasterSweepDocument, ShardDocument, Software, SweepDocument};

const PART: &str = "PART.json";

/// Combines the parts; the first one determines the kind of document.
pub(super) fn merge(session: &Session, arguments: &MergeArguments) -> Result<(), Failure> {
    let named: Vec<Named> = arguments.parts.iter().map(|part| (PART, Some(&**part))).collect();
    judge_places(&arguments.answer.outlet, arguments.answer.plot.as_deref(), &named)?;
    let first = arguments.parts.iter().find(|part| *part != Path::new("-"));
    let format =
        first.map_or(Ok(None), |path| format_of(session, PART, path, SweepDocument::FORMAT))?;
    match format.as_deref() {
        Some(RasterSweepDocument::FORMAT) => merged::<RasterSweepDocument>(session, arguments),
        _ => merged::<SweepDocument>(session, arguments),
    }
}

/// Combines the parts, which must cover the grid exactly once.
fn merged<D: Divided>(session: &Session, arguments: &MergeArguments) -> Result<(), Failure> {
    let read = |path: &PathBuf| read::<D>(session, path).map(|part| (path.clone(), part));
    let mut parts = arguments.parts.iter().map(read);
    let (_, mut whole) = parts
        .next()
        .transpose()?
        .ok_or_else(|| Failure::input(PART, "no part is given: name the documents of all parts"))?;
    let mut shards: Vec<ShardDocument> = whole.held().shard.take().into_iter().collect();
    for part in parts {
        let (path, mut part) = part?;
        shards.extend(part.held().shard.take());
        if !part.is_of(&whole) {
            let message = "belongs to another sweep, or another version, than the first one";
            return Err(Failure::file(PART, &path, message));
        }
        let (part, all) = (part.held(), whole.held());
        if part.arithmetic != all.arithmetic && all.arithmetic.take().is_some() {
            let path = path.display();
            session.say(format_args!(
                "stickslip: {path} was computed by a machine with different rounding: the last digits may differ from \
                 those of one machine"
            ));
        }
        all.points.extend(part.points.each());
    }
    whole.held().points.order();
    judge_parts(&shards)?;
    complete(&whole)?;
    let AnswerArguments { in_units, outlet, plot } = &arguments.answer;
    if plot.is_some() {
        whole.judge_picture().map_err(|error| Failure::input("--plot", error))?;
    }
    let scales = scales(session, in_units, None, whole.parameters().support_velocity())?;
    let job = Job::open(session, D::FORMAT, outlet, plot.as_deref())?;
    job.finish(whole.sealed()?.in_units(scales.as_ref()))
}

/// Names the missing parts, in the syntax of Slurm array jobs.
fn judge_parts(shards: &[ShardDocument]) -> Result<(), Failure> {
    let Some(of) = shards.first().map(|shard| shard.of) else { return Ok(()) };
    let there: HashSet<usize> = shards.iter().map(|shard| shard.index).collect();
    // Points that occur twice, or in another division, are reported one by one.
    let is_odd = there.len() < shards.len() || shards.iter().any(|shard| shard.of != of);
    if is_odd || there.len() >= of {
        return Ok(());
    }
    let missing: Vec<usize> = (1..=of).filter(|index| !there.contains(index)).collect();
    let array = runs(&missing);
    let message = format!(
        "of {of} parts {} are missing: --shard {}/{of} and so on, or an array job with --array={array} and --shard slurm/{of}, computes \
         them; then name the documents of all parts",
        missing.len(),
        missing[0]
    );
    Err(Failure::input(PART, message))
}

/// Rising numbers as `1,4-6`.
fn runs(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        run => run.iter().map(usize::to_string).collect(),
    });
    runs.collect::<Vec<_>>().join(",")
}

/// Whether a file is a complete document of the requested sweep, whose points have these `indices`. A message
/// describes any other file.
pub(super) fn is_done<D: Divided>(
    session: &Session,
    path: &Path,
    asked: &D::Parameters,
    indices: &[usize],
) -> bool {
    if !path.exists() {
        return false;
    }
    let is_requested = |found: &D| {
        found.parameters() == asked
            && *found.software() == Software::this()
            && found.points().indices().eq(indices.iter().copied())
    };
    let name = path.display();
    match read::<D>(session, path) {
        Ok(found) if is_requested(&found) => return true,
        Ok(_) => session.remark(format_args!(
            "stickslip: {name} belongs to another sweep: it is computed again"
        )),
        Err(error) => session.remark(format_args!("stickslip: {error}: computed anew")),
    }
    false
}

fn read<D: Divided>(session: &Session, path: &Path) -> Result<D, Failure> {
    let mut part: D = read_document(session, PART, path)?;
    let refused = |message| Err(Failure::file(PART, path, message));
    let kept = *part.held().crc32;
    match kept {
        Some(sum) if sum == part.checksum()? => Ok(part),
        Some(_) => refused("was changed since it was written: its checksum does not match"),
        None => {
            refused("has no checksum `crc32`: it was not written by this version; compute it again")
        }
    }
}

/// Checks that every point of the grid occurs exactly once.
pub(crate) fn complete(whole: &impl Divided) -> Result<(), Failure> {
    let refused = |message: String| Err(Failure::input(PART, message));
    let points = whole.points();
    let mut pairs = points.indices().zip(points.indices().skip(1));
    if let Some((twice, _)) = pairs.find(|(one, next)| one == next) {
        return refused(format!("point {twice} is in more than one part"));
    }
    let (found, count) = (points.count(), whole.parameters().points());
    let off = (0..count).zip(points.indices()).find(|(wanted, index)| wanted != index);
    if let Some(missing) = off.map(|(wanted, _)| wanted).or((found < count).then_some(found)) {
        let advice = "name the documents of all parts";
        return refused(format!(
            "point {missing} is missing ({found} of {count} are there): {advice}"
        ));
    }
    if found > count {
        return refused(format!("there are {found} points, the grid has {count}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_parts_are_named_as_an_array_job_takes_them() {
        let refused = |there: &[usize], of| {
            let shards: Vec<_> = there.iter().map(|i| ShardDocument { index: *i, of }).collect();
            judge_parts(&shards).err().map(|failure| failure.to_string()).unwrap_or_default()
        };
        assert!(
            refused(&[1, 3, 8], 8).contains("--array=2,4-7 and --shard slurm/8,"),
            "{}",
            refused(&[1, 3, 8], 8)
        );
        assert!(refused(&[1, 2], 3).contains("of 3 parts 1 are missing: --shard 3/3"));
        assert_eq!(refused(&[3, 1, 2], 3), "");
        assert_eq!(refused(&[], 3), "");
        assert_eq!(runs(&[1, 2, 3, 7, 9, 10]), "1-3,7,9-10");
    }
}
