//! `stickslip sweep merge`.

use super::{checksum, job, sealed};
use crate::arguments::MergeArguments;
use crate::commands::in_units::scales;
use crate::commands::job::judge_places;
use crate::failure::Failure;
use crate::files::distinct::Named;
use crate::files::input::read_document;
use crate::message::say;
use std::collections::HashSet;
use std::path::Path;
use stickslip_documents::{Physical, ShardDocument, SweepDocument, SweepParameters, SweepPoint};

/// The whole from its parts, which must be all of it, once.
pub(super) fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    let named: Vec<Named> =
        arguments.parts.iter().map(|part| ("PART.json", Some(&**part))).collect();
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &named)?;
    let mut parts = arguments.parts.iter().map(|path| read(path).map(|part| (path, part)));
    let (_, mut whole) = parts.next().transpose()?.ok_or_else(|| {
        Failure::input("PART.json", "no part was given: name the documents of all of them")
    })?;
    let mut shards: Vec<ShardDocument> = whole.parameters.shard.take().into_iter().collect();
    for part in parts {
        let (path, mut part) = part?;
        shards.extend(part.parameters.shard.take());
        if part.parameters != whole.parameters || part.software != whole.software {
            return Err(Failure::input(
                format!("PART.json {}", path.display()),
                "is of another sweep, or another version, than the first one",
            ));
        }
        if part.arithmetic != whole.arithmetic && whole.arithmetic.take().is_some() {
            let path = path.display();
            say(format_args!(
                "stickslip: {path} was computed by a machine that rounds otherwise: one machine alone would give other \
                 last digits"
            ));
        }
        whole.points.append(&mut part.points);
    }
    whole.points.sort_by_key(|point| point.index);
    judge_parts(&shards)?;
    complete(&whole.parameters, &whole.points)?;
    let r = Some(&*whole.parameters.r).filter(|r| r.len() == 1).map(|r| r[0]);
    let scales = scales(&arguments.in_units, None, r)?;
    let whole = sealed(whole.parameters, whole.points, whole.arithmetic)?;
    let job = job(&arguments.outlet, arguments.plot.as_deref(), &whole.parameters)?;
    job.finish(whole.in_units(scales.as_ref()))
}

/// Names the parts that are missing, as an array job of Slurm takes them.
fn judge_parts(shards: &[ShardDocument]) -> Result<(), Failure> {
    let Some(of) = shards.first().map(|shard| shard.of) else { return Ok(()) };
    let there: HashSet<usize> = shards.iter().map(|shard| shard.index).collect();
    // What is there twice, or of another division, is told point by point.
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
    Err(Failure::input("PART.json", message))
}

/// Rising numbers as `1,4-6`.
fn runs(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        run => run.iter().map(usize::to_string).collect(),
    });
    runs.collect::<Vec<_>>().join(",")
}

fn read(path: &Path) -> Result<SweepDocument, Failure> {
    let part: SweepDocument = read_document("PART.json", path, SweepDocument::FORMAT)?;
    let refused = |message| Err(Failure::input(format!("PART.json {}", path.display()), message));
    match part.crc32 {
        Some(sum) if sum == checksum(&part)? => Ok(part),
        Some(_) => refused("was changed since it was written: its checksum does not match"),
        None => {
            refused("has no checksum `crc32`: it is not as this version writes it, sweep it again")
        }
    }
}

/// Every point of the grid, once.
pub(crate) fn complete(parameters: &SweepParameters, points: &[SweepPoint]) -> Result<(), Failure> {
    let refused = |message: String| Err(Failure::input("PART.json", message));
    if let Some(pair) = points.windows(2).find(|pair| pair[0].index == pair[1].index) {
        return refused(format!("point {} is in more than one part", pair[0].index));
    }
    let count = parameters.points();
    if let Some(missing) = (0..count).find(|i| points.get(*i).map(|p| p.index) != Some(*i)) {
        let (found, advice) = (points.len(), "name the documents of all parts");
        return refused(format!(
            "point {missing} is missing ({found} of {count} are there): {advice}"
        ));
    }
    if points.len() > count {
        return refused(format!("there are {} points, the grid has {count}", points.len()));
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
