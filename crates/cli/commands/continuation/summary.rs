//! What became of the branches, for a person who sent them to a file.

use crate::commands::number::seven_digits;
use stickslip_documents::{ContinueDocument, CycleBranch, EndName, OverName};

/// A line for each branch.
pub(super) fn summary(document: &ContinueDocument) -> String {
    let over = document.parameters.over;
    let branches = document.branches.iter().enumerate();
    branches.map(|(i, branch)| format!("branch {i}: {}\n", line(branch, over))).collect()
}

fn line(branch: &CycleBranch, over: OverName) -> String {
    let (name, values) = match over {
        OverName::Alpha => ("alpha", &branch.alpha),
        OverName::R => ("r", &branch.r),
    };
    let end = |value: Option<&f64>| value.map_or(String::new(), |value| seven_digits(*value));
    let (first, last) = (end(values.first()), end(values.last()));
    format!("{} cycles, {name} from {first} to {last}, {}", values.len(), why(branch.end))
}

fn why(end: EndName) -> &'static str {
    match end {
        EndName::Reached => "the value of --to",
        EndName::LongPeriod => "where the period exceeds --longest-period",
        EndName::Steady => "where the cycle has shrunk to steady motion",
        EndName::Halved => "where it joins the branch of half the period",
        EndName::ManyPoints => "with --most-points",
        EndName::Lost => "where no further cycle was found",
        EndName::Interrupted => "where a signal ended it",
    }
}
