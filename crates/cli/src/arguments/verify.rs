//! `stickslip verify`.

use super::OutletArguments;
use super::examples::examples;
use clap::Args;
use std::path::PathBuf;

/// Repeat a saved run in another way and tighter: does it keep its promise?
///
/// It is repeated with another memory and a hundredth of its tolerance.
///
/// A run written as lines (.jsonl) is read line by line, twice: first all of it, for what is damaged or cut off,
/// then beside its repetition. Neither the lines nor the repetition are held: 15 MB will do however long the run,
/// but where f' cannot be fitted by exponentials (--tip bessel, some tables) and fft made the run: then it is
/// repeated with direct, which holds all of its past. Of a document (.json), all of it is held, and of one with
/// its history, all steps of the repetition. Lines from a pipe are put into a temporary file.
///
/// On a cycle errors of the period add up: a run of thousands of periods is right to ten tolerances only until some
/// time, which is said. The repetition takes some twenty times as long as the run.
///
/// All else that the run contains, derived columns of samples, regime, oscillation, steady state, numbers in other units,
/// is computed once more; `differences` lists what does not follow.
///
/// Exit status 1 if l, x0 or the surface differ by more than the run's tolerance allows, or a value does not follow; 3 if all that there is of
/// a run is right, but it has no end: it was killed, or is not over.
#[derive(Debug, Args)]
#[command(after_help = examples(EXAMPLES))]
pub(crate) struct VerifyArguments {
    /// What `stickslip run` wrote: a document (.json), lines (.jsonl), or what there is of them
    /// (.jsonl.part); `-` is standard input.
    #[arg(value_name = "RUN")]
    pub(crate) run: PathBuf,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,
}

const EXAMPLES: &str = "Examples:
  stickslip run --alpha 1.2 --r 1 --kick 0.05 --until 200 -o run.json
  stickslip verify run.json
  A run that was killed, and the same when it is finished:
    stickslip verify long.jsonl.part
    stickslip run --resume long.checkpoint
    stickslip verify long.jsonl";
