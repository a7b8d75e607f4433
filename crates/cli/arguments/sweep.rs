//! `stickslip sweep`.

use super::TipName;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use std::str::FromStr;

/// Values LO:HI:N, or one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Range {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) points: usize,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| match part.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("{part:?} is no finite number: LO:HI:N or one number will do")),
        };
        match text.split(':').collect::<Vec<_>>()[..] {
            [value] => number(value).map(|value| Self { low: value, high: value, points: 1 }),
            [low, high, points] => {
                let (low, high) = (number(low)?, number(high)?);
                if high <= low {
                    return Err(format!("{high} is not above {low}"));
                }
                match points.trim().parse() {
                    Ok(points) if points >= 2 => Ok(Self { low, high, points }),
                    _ => Err(format!("{points:?} is no number of values, 2 or above")),
                }
            }
            _ => Err("LO:HI:N, both ends included, or one number will do".into()),
        }
    }
}

impl Range {
    /// The value of this number, counted from 0.
    pub(crate) fn value(&self, i: usize) -> f64 {
        if self.points == 1 {
            return self.low;
        }
        self.low + (self.high - self.low) * i as f64 / (self.points - 1) as f64
    }
}

/// Part I of N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    /// From 1.
    pub(crate) index: usize,
    pub(crate) of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').map(|(i, n)| (i.trim().parse(), n.trim().parse()));
        match parts {
            Some((Ok(index), Ok(of))) if (1..=of).contains(&index) => Ok(Self { index, of }),
            _ => Err("I/N, I from 1 to N, will do".into()),
        }
    }
}

/// What the motion comes to over a grid of α, r and beta: steady, cycles of how many slips, trapped.
///
/// Above onset the cycle is solved for; where none is found stable, a run says what becomes of the tip. Points are
/// kept as they are finished in a file beside the output, so that the same command, killed and given again, goes
/// on where it was.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
pub(crate) struct SweepArguments {
    #[command(subcommand)]
    pub(crate) command: Option<SweepCommand>,

    #[command(flatten)]
    pub(crate) grid: GridArguments,

    /// Largest residual that the equation of motion (18) may have on a cycle; from 1e-11 to 1e-4.
    #[arg(
        long,
        value_name = "E",
        default_value_t = stickslip_tip::cycle::DEFAULT_TOLERANCE,
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,

    /// Do part I of N only, for `sweep merge` to join.
    #[arg(long, value_name = "I/N", help_heading = "Work")]
    pub(crate) shard: Option<Shard>,

    /// Threads [default: one for each core]. The result does not depend on them.
    #[arg(long, value_name = "N", help_heading = "Work")]
    pub(crate) threads: Option<usize>,

    /// File to write: .json for all, .csv for a table; `-` is JSON on standard output, and cannot go on.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// Draw the phase diagram, of two ranges of which one is that of α, to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

/// What is swept over.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Grid")]
pub(crate) struct GridArguments {
    /// Dimensionless indentation rate α, (13): LO:HI:N, or one value.
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true)]
    pub(crate) alpha: Option<Range>,

    /// The same, given as αc(r) + D.
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true, conflicts_with = "alpha")]
    pub(crate) alpha_above: Option<Range>,

    /// Dimensionless support velocity r, (12): LO:HI:N, or one value.
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true)]
    pub(crate) r: Option<Range>,

    /// Side lobes of the triple Gaussian: LO:HI:N, or one value [default: 1].
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true)]
    pub(crate) beta: Option<Range>,

    /// Footprint f(x) of the tip [default: triple-gaussian].
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) tip: Option<TipName>,

    /// Width of either Gaussian: f(x/W) [default: 1].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    pub(crate) width: Option<f64>,

    /// Footprint from a file, as elsewhere.
    #[arg(long, value_name = "FILE")]
    pub(crate) tip_file: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SweepCommand {
    Merge(MergeArguments),
}

/// Join the parts that `sweep --shard I/N` wrote into the document that one sweep would have written.
#[derive(Debug, Args)]
pub(crate) struct MergeArguments {
    /// All N parts, in any order.
    #[arg(value_name = "PART.json", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    /// File to write: .json for all, .csv for a table; `-` is JSON on standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// Draw the phase diagram to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  The phase diagram of r and α:
    stickslip sweep --r 0.3:2:60 --alpha 0.05:4:60 -o map.json --plot map.png
  Amplitude and period above onset, as a table:
    stickslip sweep --r 1 --alpha-above 0.001:0.1:50 -o onset.csv
  In two parts, on two machines, and joined:
    stickslip sweep --r 0.3:2:60 --alpha 0.05:4:60 --shard 1/2 -o part1.json
    stickslip sweep --r 0.3:2:60 --alpha 0.05:4:60 --shard 2/2 -o part2.json
    stickslip sweep merge part1.json part2.json -o map.json";
