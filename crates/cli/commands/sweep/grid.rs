//! The grid, and what each of its points asks for.

use crate::arguments::{GridArguments, Range, TipArguments};
use crate::commands::model::{model_of, tip};
use crate::documents::{RangeDocument, SweepParameters, TipDocument};
use crate::failure::{Failure, Typed};
use stickslip_tip::stability::critical;
use stickslip_tip::{Model, TipFunction};

/// Some hundreds of megabytes.
const MOST_POINTS: usize = 1_000_000;

/// What is swept over, by beta, then r, then α.
pub(super) struct Grid {
    beta: Option<Range>,
    /// For each beta, and for each of these αc at each r where it is needed.
    tips: Vec<(TipFunction, Vec<Option<f64>>)>,
    r: Range,
    alpha: Range,
    /// Whether `alpha` counts from αc(r).
    above: bool,
}

/// A point of the grid.
pub(super) struct Place {
    pub(super) beta: Option<f64>,
    pub(super) r: f64,
    /// `None` where there is no αc to count from.
    pub(super) model: Option<Model>,
}

impl Grid {
    pub(super) fn asked(arguments: &GridArguments) -> Result<Self, Failure> {
        let missing = |option: &str| Failure::input(option, "missing: give LO:HI:N, or one value");
        let r = arguments.r.ok_or_else(|| missing("--r"))?;
        let (alpha, above) = match (arguments.alpha, arguments.alpha_above) {
            (Some(alpha), _) => (alpha, false),
            (None, Some(above)) => (above, true),
            (None, None) => return Err(missing("--alpha")),
        };
        let betas = arguments.beta.map_or(1, |beta| beta.points);
        let count = betas.checked_mul(r.points).and_then(|n| n.checked_mul(alpha.points));
        if count.is_none_or(|count| count > MOST_POINTS) {
            return Err(Failure::input(
                "--alpha, --r and --beta",
                format!("make more than {MOST_POINTS} points: sweep in parts"),
            ));
        }
        let mut tips = vec![];
        for i in 0..betas {
            let tip = tip(&TipArguments {
                tip: arguments.tip,
                beta: arguments.beta.map(|beta| beta.value(i)),
                width: arguments.width,
                tip_file: arguments.tip_file.clone(),
            })?;
            judge(&tip, r, if above { None } else { Some(alpha) })?;
            let critical = |j: usize| critical(&tip, r.value(j)).ok().map(|c| c.alpha);
            let criticals = (0..if above { r.points } else { 0 }).map(critical).collect();
            tips.push((tip, criticals));
        }
        Ok(Self { beta: arguments.beta, tips, r, alpha, above })
    }

    pub(super) fn len(&self) -> usize {
        self.tips.len() * self.r.points * self.alpha.points
    }

    pub(super) fn at(&self, i: usize) -> Place {
        let (rest, i_alpha) = (i / self.alpha.points, i % self.alpha.points);
        let (i_beta, i_r) = (rest / self.r.points, rest % self.r.points);
        let (tip, critical) = &self.tips[i_beta];
        let r = self.r.value(i_r);
        let from = if self.above { critical[i_r] } else { Some(0.0) };
        let alpha = from.map(|from| from + self.alpha.value(i_alpha));
        let model = alpha.and_then(|alpha| Model::new(tip.clone(), alpha, r).ok());
        Place { beta: self.beta.map(|beta| beta.value(i_beta)), r, model }
    }

    pub(super) fn parameters(&self, tolerance: f64) -> SweepParameters {
        let range = |r: Range| RangeDocument { low: r.low, high: r.high, points: r.points };
        SweepParameters {
            tip: TipDocument::from(&self.tips[0].0),
            beta: self.beta.map(range),
            r: range(self.r),
            alpha: (!self.above).then(|| range(self.alpha)),
            alpha_above: self.above.then(|| range(self.alpha)),
            tolerance,
        }
    }
}

/// Refuses values that no point can have; the ends are the extremes.
fn judge(tip: &TipFunction, r: Range, alpha: Option<Range>) -> Result<(), Failure> {
    for r in [r.low, r.high] {
        model_of(tip.clone(), r, Some(1.0), None)?;
    }
    for alpha in alpha.iter().flat_map(|alpha| [alpha.low, alpha.high]) {
        if alpha < 0.0 {
            let message = "alpha is 0 or above";
            return Err(Failure::input(format!("--alpha {}", Typed(alpha)), message));
        }
    }
    Ok(())
}
