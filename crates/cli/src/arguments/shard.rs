//! How the points of a sweep are computed: which of them, and how many at a time.

use clap::Args;
use stickslip::ShardDocument;

/// How the points of a grid are computed.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Work")]
pub(crate) struct WorkArguments {
    /// Number of points computed in parallel [default: the number of cores].
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,

    /// Compute only part I of N of the points; `stickslip sweep merge` combines the parts. `slurm`: the part of this
    /// task of an array job whose numbers begin at 1, by SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT; slurm/N if
    /// the array contains only some of N parts.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(crate) shard: Option<ShardDocument>,

    /// Do nothing if --output already contains this sweep, complete and of this version; otherwise replace it.
    #[arg(long, conflicts_with = "plot")]
    pub(crate) if_needed: bool,
}

/// Part I of N of the points.
fn shard(text: &str) -> Result<ShardDocument, String> {
    if let Some(of) = text.strip_prefix("slurm") {
        return of_task(of, |name| std::env::var(name).ok());
    }
    let parts = text.split_once('/').and_then(|(i, n)| i.parse().ok().zip(n.parse().ok()));
    parts
        .filter(|(index, of)| (1..=*of).contains(index))
        .map(|(index, of)| ShardDocument { index, of })
        .ok_or_else(|| "I/N with I from 1 to N, such as 2/8, or slurm, or slurm/N".into())
}

/// The part of a task of an array job, from its environment; `of` is empty, or `/N`.
fn of_task(of: &str, variable: impl Fn(&str) -> Option<String>) -> Result<ShardDocument, String> {
    let number = |name: &str| {
        let set = variable(name).and_then(|text| text.parse::<usize>().ok());
        set.ok_or_else(|| {
            format!("{name} is not set to a number: slurm is for the tasks of sbatch --array=1-N")
        })
    };
    let index = number(TASK)?;
    let of = match of.strip_prefix('/').map(str::parse) {
        None if of.is_empty() => number(COUNT)?,
        Some(Ok(of)) => of,
        _ => return Err("slurm, or slurm/N with the number of all parts".into()),
    };
    if (1..=of).contains(&index) {
        return Ok(ShardDocument { index, of });
    }
    Err(format!(
        "task {index} of an array of {of}: number the tasks from 1, as --array=1-{of}, or where they are some of N \
         parts give slurm/N"
    ))
}

const TASK: &str = "SLURM_ARRAY_TASK_ID";
const COUNT: &str = "SLURM_ARRAY_TASK_COUNT";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_count_from_one() {
        assert_eq!(shard("2/8"), Ok(ShardDocument { index: 2, of: 8 }));
        for bad in ["0/8", "9/8", "1", "1/0", "-1/2", "1/2/3"] {
            assert!(shard(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_task_of_an_array_job_has_its_shard_from_its_environment() {
        let of = |typed: &str, set: &[(&str, &str)]| {
            let variable = |name: &str| set.iter().find(|s| s.0 == name).map(|s| s.1.to_owned());
            of_task(typed, variable)
        };
        assert_eq!(of("", &[(TASK, "3"), (COUNT, "8")]), Ok(ShardDocument { index: 3, of: 8 }));
        // Tasks 3 and 7 of 8 again: Slurm counts two.
        let again = [(TASK, "7"), (COUNT, "2")];
        assert_eq!(of("/8", &again), Ok(ShardDocument { index: 7, of: 8 }));
        assert!(of("", &again).unwrap_err().contains("slurm/N"));
        for bad in [&[][..], &[(TASK, "3")], &[(TASK, "0"), (COUNT, "8")], &[(TASK, "x")]] {
            assert!(of("", bad).is_err(), "{bad:?}");
        }
        assert!(of("/x", &again).is_err() && of("8", &again).is_err());
    }
}
