//! `stickslip verify`.

use super::OutletArguments;
use clap::Args;
use std::path::PathBuf;

/// Check a saved run: repeat it with another memory at a hundredth of its tolerance
///
/// A run written as lines (.jsonl) is read line by line, twice: first to find damaged or missing lines, then in
/// parallel with its repetition. Neither the lines nor the repetition are kept in memory: 15 MB are sufficient for a
/// run of any length, unless f' cannot be fitted by exponentials (--tip bessel, some tables) and the run used fft:
/// then the repetition uses direct, which stores its whole history. A document (.json) is kept in memory as a whole and,
/// if it contains a history, so are all steps of the repetition. Lines from a pipe are copied to a temporary file.
///
/// On a cycle errors of the period accumulate: a run of thousands of periods is correct to ten tolerances only up to
/// some time, which is reported. The repetition takes about twenty times as long as the run.
///
/// All other contents of the run, derived columns of samples, regime, oscillation, steady state, numbers in other
/// units, are recomputed; `differences` lists the values that differ.
///
/// Exit status 1 if l, x0 or the surface differ by more than the run's tolerance allows, or another value differs; 3
/// if the run is correct but incomplete, because it was killed or is still running.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct VerifyArguments {
    /// Output of `stickslip run`: a document (.json), lines (.jsonl), or incomplete lines (.jsonl.part); `-` is
    /// standard input.
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
