//! The points of a sweep: footprints times r times α, the last varying fastest.

use crate::arguments::{Range, SweepArguments, TipArguments, WiderArguments};
use crate::commands::model::{refuse_endless, refused_wider, tip, wider};
use crate::failure::{Failure, Typed};
use stickslip_cycles::TOLERANCES;
use stickslip_documents::{ShardDocument, SweepParameters};
use stickslip_tip::{TipFunction, Wider};

/// More than a cluster does in a year; their document would take gigabytes.
const MOST_POINTS: usize = 10_000_000;
/// Each of them is a footprint of its own.
const MOST_TIPS: usize = 10_000;

#[derive(Debug)]
pub(super) struct Grid {
    tips: Vec<TipFunction>,
    pub(super) parameters: SweepParameters,
}

/// Where a point is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) tip: &'a TipFunction,
    pub(super) beta: Option<f64>,
    pub(super) r: f64,
    pub(super) alpha: Alpha,
    pub(super) wider: Wider,
}

/// α, or αc(r) + D.
#[derive(Debug, Clone, Copy)]
pub(super) enum Alpha {
    Given(f64),
    Above(f64),
}

impl Grid {
    pub(super) fn asked(arguments: &SweepArguments) -> Result<Self, Failure> {
        judge_counts(arguments)?;
        let missing = |option: &str, what: &str| {
            Failure::input(option, format!("{what} missing: give {option} V, or {option} LO:HI:N"))
        };
        let r = arguments.r.ok_or_else(|| missing("--r", "the support velocities are"))?.values();
        if let Some(bad) = r.iter().find(|r| **r <= 0.0) {
            return Err(Failure::input(format!("--r {}", Typed(*bad)), "must be above 0"));
        }
        let (alpha, above) = (arguments.alpha, arguments.alpha_above);
        match (alpha, above) {
            (None, None) => return Err(missing("--alpha", "the indentation rates are")),
            (Some(_), Some(_)) => {
                return Err(Failure::input(
                    "--alpha and --alpha-above",
                    "give one of them, not both",
                ));
            }
            _ => {}
        }
        if let Some(low) = alpha.map(|range| range.low).filter(|low| *low < 0.0) {
            return Err(Failure::input(format!("--alpha {}", Typed(low)), "must be 0 or above"));
        }
        if !(TOLERANCES.0..=TOLERANCES.1).contains(&arguments.tolerance) {
            let option = format!("--tolerance {}", Typed(arguments.tolerance));
            let (least, most) = TOLERANCES;
            return Err(Failure::input(option, format!("{least:e} to {most:e} will do")));
        }
        refuse_endless(&tip_arguments(arguments, None), &arguments.wider)?;
        let WiderArguments { depth_limit, healing_time, inertia, .. } = arguments.wider;
        wider(&arguments.wider).validate().map_err(|error| refused_wider(&error))?;
        let beta = arguments.beta.map(Range::values);
        let tips = tips(arguments, beta.as_deref())?;
        let grid = Self {
            parameters: SweepParameters {
                tips: tips.iter().map(Into::into).collect(),
                beta,
                r,
                alpha: alpha.map(Range::values),
                alpha_above: above.map(Range::values),
                tolerance: arguments.tolerance,
                shard: arguments.shard.map(|s| ShardDocument { index: s.index, of: s.of }),
                depth_limit,
                healing_time,
                inertia,
            },
            tips,
        };
        Ok(grid)
    }

    /// The indices of this part of the points.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> + use<> {
        let shard = self.parameters.part();
        (shard.index - 1..self.parameters.points()).step_by(shard.of)
    }

    pub(super) fn place(&self, index: usize) -> Place<'_> {
        let SweepParameters { r, alpha, alpha_above, beta, .. } = &self.parameters;
        let columns = alpha.as_ref().or(alpha_above.as_ref()).map_or(1, Vec::len);
        let (row, column) = (index / columns, index % columns);
        let (which, at) = (row / r.len(), row % r.len());
        let given = alpha.as_ref().map(|alpha| Alpha::Given(alpha[column]));
        let above = alpha_above.as_ref().map(|above| Alpha::Above(above[column]));
        Place {
            tip: &self.tips[which],
            beta: beta.as_ref().map(|beta| beta[which]),
            r: r[at],
            alpha: given.or(above).unwrap_or(Alpha::Given(0.0)),
            wider: self.parameters.wider(),
        }
    }
}

/// Refuses more points than can be kept, before there is any of them.
fn judge_counts(arguments: &SweepArguments) -> Result<(), Failure> {
    let SweepArguments { r, alpha, alpha_above, beta, .. } = arguments;
    let counts = [*r, alpha.or(*alpha_above), *beta].map(|range| range.map_or(1, |r| r.points));
    if counts[2] > MOST_TIPS {
        let message = format!("{} values; at most {MOST_TIPS} will do", counts[2]);
        return Err(Failure::input("--beta", message));
    }
    match counts.into_iter().fold(1, usize::saturating_mul) {
        count if count > MOST_POINTS => Err(Failure::input(
            "--alpha, --r and --beta",
            format!(
                "make {count} points; at most {MOST_POINTS} will do: fewer, or one part of the range"
            ),
        )),
        _ => Ok(()),
    }
}

fn tips(arguments: &SweepArguments, beta: Option<&[f64]>) -> Result<Vec<TipFunction>, Failure> {
    let one = |beta: Option<f64>| tip(&tip_arguments(arguments, beta));
    match beta {
        None => Ok(vec![one(None)?]),
        Some(values) => values.iter().map(|beta| one(Some(*beta))).collect(),
    }
}

fn tip_arguments(arguments: &SweepArguments, beta: Option<f64>) -> TipArguments {
    let SweepArguments { tip, width, tip_file, .. } = arguments;
    TipArguments { tip: *tip, beta, width: *width, tip_file: tip_file.clone() }
}
