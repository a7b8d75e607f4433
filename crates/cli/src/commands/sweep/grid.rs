//! The points of a sweep: footprints times r times α times further axes, the last varying fastest.

use super::{axes, started};
use crate::arguments::{Range, SweepArguments, TipArguments, WiderArguments};
use crate::commands::model::{refuse_endless, refused_wider, tip};
use crate::failure::{Failure, Typed};
use stickslip::{SweepParameters, SweepPoint, SweepRunParameters};
use stickslip_cycles::TOLERANCES;
use stickslip_tip::{Model, TipFunction, Wider};

/// Largest number of points; the document of more would take gigabytes.
const MOST_POINTS: usize = 10_000_000;
/// Largest number of footprints; each is prepared separately.
const MOST_TIPS: usize = 10_000;

/// Largest number of runs that share SIMD lanes in turn: at the end of a group lanes are empty.
const MOST_RUNS_TOGETHER: usize = 128;

#[derive(Debug)]
pub(super) struct Grid {
    tips: Vec<TipFunction>,
    pub(super) parameters: SweepParameters,
}

/// Parameters of a point.
#[derive(Debug, Clone)]
pub(super) struct Place<'a> {
    pub(super) tip: &'a TipFunction,
    width: Option<f64>,
    beta: Option<f64>,
    pub(super) r: f64,
    pub(super) alpha: Alpha,
    /// Values on the further axes.
    at: Vec<f64>,
    pub(super) wider: Wider,
    /// Parameters of the run, if the point is a run.
    pub(super) run: Option<SweepRunParameters>,
}

/// α, or αc(r) + D.
#[derive(Debug, Clone, Copy)]
pub(super) enum Alpha {
    Given(f64),
    Above(f64),
}

impl Place<'_> {
    /// The point with its parameters and without results.
    pub(super) fn empty(&self, index: usize, alpha: Option<f64>) -> SweepPoint {
        SweepPoint {
            width: self.width,
            at: self.at.clone(),
            ..SweepPoint::at(index, self.beta, self.r, alpha)
        }
    }
}

impl Grid {
    pub(super) fn asked(arguments: &SweepArguments) -> Result<Self, Failure> {
        judge_counts(arguments)?;
        let (alpha, above) = (arguments.alpha.as_ref(), arguments.alpha_above.as_ref());
        let r = judged_r(arguments)?;
        judge_alphas(alpha, above)?;
        if !(TOLERANCES.0..=TOLERANCES.1).contains(&arguments.tolerance) {
            let option = format!("--tolerance {}", Typed(arguments.tolerance));
            let (least, most) = TOLERANCES;
            return Err(Failure::input(option, format!("must be {least:e} to {most:e}")));
        }
        let law = lowest(arguments);
        refuse_endless(&tip_arguments(arguments, None, None), &law)?;
        crate::commands::model::wider(&law).validate().map_err(|error| refused_wider(&error))?;
        let (law, run, axes) = axes::asked(arguments)?;
        let several = |range: &&Range| range.points() > 1;
        let width = arguments.width.as_ref().filter(several).map(Range::values);
        let beta = arguments.beta.as_ref().map(Range::values);
        let tips = tips(arguments)?;
        let grid = Self {
            parameters: SweepParameters {
                tips: tips.iter().map(Into::into).collect(),
                width,
                beta,
                r,
                alpha: alpha.map(Range::values),
                alpha_above: above.map(Range::values),
                tolerance: arguments.tolerance,
                shard: arguments.shard.map(Into::into),
                depth_limit: law.depth_limit,
                healing_time: law.healing_time,
                inertia: law.inertia,
                axes,
                run,
            },
            tips,
        };
        grid.judge_runs()?;
        Ok(grid)
    }

    /// Rejects invalid runs by checking the first and the last one, which include every error.
    fn judge_runs(&self) -> Result<(), Failure> {
        for index in [0, self.parameters.points().saturating_sub(1)] {
            let place = self.place(index);
            let (Some(run), Alpha::Given(alpha)) = (&place.run, place.alpha) else { continue };
            let model = Model::under(place.wider, place.tip.clone(), alpha, place.r);
            if let Ok(model) = model {
                started::scenario(model, run, self.parameters.tolerance)?;
            }
        }
        Ok(())
    }

    /// Largest number of points that are computed together: runs share SIMD lanes.
    pub(super) fn together(&self) -> usize {
        if self.parameters.run.is_some() { MOST_RUNS_TOGETHER } else { 1 }
    }

    /// The indices of the points in this part.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> + use<> {
        self.parameters.part().indices(self.parameters.points())
    }

    pub(super) fn place(&self, index: usize) -> Place<'_> {
        let SweepParameters { r, alpha, alpha_above, beta, width, .. } = &self.parameters;
        let at = self.parameters.at(index);
        let outer = index / self.parameters.inner();
        let columns = alpha.as_ref().or(alpha_above.as_ref()).map_or(1, Vec::len);
        let (row, column) = (outer / columns, outer % columns);
        let which = row / r.len();
        let betas = beta.as_ref().map_or(1, Vec::len);
        let given = alpha.as_ref().map(|alpha| Alpha::Given(alpha[column]));
        let above = alpha_above.as_ref().map(|above| Alpha::Above(above[column]));
        let (wider, run) = axes::at(&self.parameters, &at);
        Place {
            tip: &self.tips[which],
            width: width.as_ref().map(|width| width[which / betas]),
            beta: beta.as_ref().map(|beta| beta[which % betas]),
            r: r[row % r.len()],
            alpha: given.or(above).unwrap_or(Alpha::Given(0.0)),
            at,
            wider,
            run,
        }
    }
}

fn missing(option: &str, what: &str) -> Failure {
    Failure::input(option, format!("{what} missing: give {option} V, or {option} LO:HI:N"))
}

fn judged_r(arguments: &SweepArguments) -> Result<Vec<f64>, Failure> {
    let r = arguments.r.as_ref().ok_or_else(|| missing("--r", "the support velocities are"))?;
    let r = r.values();
    match r.iter().find(|r| **r <= 0.0) {
        Some(bad) => Err(Failure::input(format!("--r {}", Typed(*bad)), "must be above 0")),
        None => Ok(r),
    }
}

fn judge_alphas(alpha: Option<&Range>, above: Option<&Range>) -> Result<(), Failure> {
    match (alpha, above) {
        (None, None) => Err(missing("--alpha", "the indentation rates are")),
        (Some(_), Some(_)) => {
            Err(Failure::input("--alpha and --alpha-above", "give one of them, not both"))
        }
        (Some(alpha), None) if alpha.low() < 0.0 => {
            Err(Failure::input(format!("--alpha {}", Typed(alpha.low())), "must be 0 or above"))
        }
        _ => Ok(()),
    }
}

/// Rejects more points than can be kept, before they are computed.
fn judge_counts(arguments: &SweepArguments) -> Result<(), Failure> {
    let SweepArguments { r, alpha, alpha_above, beta, width, wider, run, .. } = arguments;
    let count = |range: &Option<Range>| range.as_ref().map_or(1, Range::points);
    for (option, tips) in [("--beta", count(beta)), ("--width", count(width))] {
        if tips > MOST_TIPS {
            let message = format!("{tips} values; at most {MOST_TIPS} are accepted");
            return Err(Failure::input(option, message));
        }
    }
    let further = [
        &wider.depth_limit,
        &wider.healing_time,
        &wider.inertia,
        &run.start_position,
        &run.kick,
        &run.start_velocity,
        &run.noise,
        &run.noise_spacing,
        &run.seed,
    ];
    let ranges = [r, if alpha.is_some() { alpha } else { alpha_above }, beta, width];
    let counts = ranges.into_iter().chain(further).map(count);
    match counts.fold(1, usize::saturating_mul) {
        count if count > MOST_POINTS => Err(Failure::input(
            "--alpha, --r and --beta",
            format!(
                "make {count} points in all; at most {MOST_POINTS} are accepted: take fewer, or one part of the range"
            ),
        )),
        _ => Ok(()),
    }
}

/// The law at the lowest end of each range: if it is valid, all points are.
fn lowest(arguments: &SweepArguments) -> WiderArguments {
    let law = &arguments.wider;
    let low = |range: &Option<Range>| range.as_ref().map(Range::low);
    WiderArguments {
        depth_limit: low(&law.depth_limit),
        healing_time: low(&law.healing_time),
        inertia: low(&law.inertia),
        no_spring: law.no_spring,
    }
}

/// The footprints, widths times β.
fn tips(arguments: &SweepArguments) -> Result<Vec<TipFunction>, Failure> {
    let values = |range: &Option<Range>| match range {
        Some(range) => range.values().into_iter().map(Some).collect(),
        None => vec![None],
    };
    let (widths, betas) = (values(&arguments.width), values(&arguments.beta));
    let both = widths.iter().flat_map(|width| betas.iter().map(move |beta| (*width, *beta)));
    both.map(|(width, beta)| tip(&tip_arguments(arguments, width, beta))).collect()
}

fn tip_arguments(
    arguments: &SweepArguments,
    width: Option<f64>,
    beta: Option<f64>,
) -> TipArguments {
    let SweepArguments { tip, tip_file, .. } = arguments;
    TipArguments { tip: *tip, beta, width, tip_file: tip_file.clone() }
}
