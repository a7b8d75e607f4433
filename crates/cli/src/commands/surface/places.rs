//! Times and positions of a surface.

use crate::arguments::{Interval, SurfaceArguments};
use crate::failure::Failure;
use stickslip_tip::Trajectory;

const DEFAULT_SPACING: f64 = 0.05;
/// Default margin on either side of the tip's path, in σ.
const MARGIN: f64 = 12.0;
/// Largest number of points, in curves and in images: 200 MB with their text.
const MOST_POINTS: f64 = 3e6;
pub(super) const MOST_PIXELS: f64 = 1e7;
/// Largest number of points of a .gsf file, which is written row by row: 4 GB.
pub(super) const MOST_PIXELS_OF_GSF: f64 = 1e9;

/// Advice for those who want more points than a document may have.
pub(super) const OR_GSF: &str = ", or write an image to a .gsf file, of up to 1e9 points";

/// Times and positions.
#[derive(Debug)]
pub(super) struct Places {
    pub(super) t: Vec<f64>,
    pub(super) x: Vec<f64>,
    /// Spacing of x, if it is even.
    pub(super) spacing: Option<f64>,
    /// Positions across the path; empty for curves.
    pub(super) y: Vec<f64>,
    pub(super) spacing_y: f64,
}

/// An evenly spaced range.
struct Range {
    low: f64,
    high: f64,
    spacing: f64,
    /// The option with the number of values, if that sets the spacing.
    counted_by: Option<&'static str>,
}

impl Places {
    /// Whether an image with these rows is larger than a document may be.
    pub(super) fn is_large(&self, y: &[f64]) -> bool {
        self.x.len() as f64 * y.len() as f64 > MOST_PIXELS
    }

    pub(super) fn requested(
        arguments: &SurfaceArguments,
        trajectory: &Trajectory,
        most: f64,
    ) -> Result<Self, Failure> {
        Self::over(arguments, times(arguments, trajectory)?, default_range(trajectory), most)
    }

    /// The given times; positions by default over this range, at most this number in an image.
    pub(super) fn over(
        arguments: &SurfaceArguments,
        t: Vec<f64>,
        (low, high): (f64, f64),
        most_pixels: f64,
    ) -> Result<Self, Failure> {
        let spacing = arguments.spacing.unwrap_or(DEFAULT_SPACING);
        let spacing = Failure::unless_positive("--spacing", spacing)?;
        let spacing_y = arguments.spacing_y.unwrap_or(spacing);
        let spacing_y = Failure::unless_positive("--spacing-y", spacing_y)?;
        let across = match &arguments.y_range {
            None => None,
            Some(typed) => {
                Some(range(["--y-range", "--spacing-y"], typed, arguments.spacing_y, spacing_y)?)
            }
        };
        let spacing_y = across.as_ref().map_or(spacing_y, |across| across.spacing);
        let each = t.len() as f64 * across.as_ref().map_or(1.0, Range::points);
        if let Some(x) = &arguments.x {
            if let Some(x) = x.iter().find(|x| !x.is_finite()) {
                return Err(Failure::number("--x", *x, "must be finite numbers"));
            }
            let y = across.map_or(Ok(vec![]), |across| {
                let each = each / across.points() * x.len() as f64;
                across.positions("--spacing-y", each, most_pixels)
            })?;
            return Ok(Self { t, x: x.clone(), spacing: None, y, spacing_y });
        }
        let along = match &arguments.range {
            None => Range { low, high, spacing, counted_by: None },
            Some(typed) => range(["--range", "--spacing"], typed, arguments.spacing, spacing)?,
        };
        let spacing = along.spacing;
        let most = if across.is_some() { most_pixels } else { MOST_POINTS };
        let x = along.positions("--spacing", each, most)?;
        let y = across.map_or(Ok(vec![]), |across| across.positions("--spacing-y", 1.0, most))?;
        Ok(Self { t, x, spacing: Some(spacing), y, spacing_y })
    }
}

/// From the margin behind the tip's start to the margin ahead of its end.
pub(crate) fn default_range(trajectory: &Trajectory) -> (f64, f64) {
    let ends = [trajectory.x0(trajectory.start()), trajectory.x0(trajectory.end())];
    (ends[0].min(ends[1]) - MARGIN, ends[0].max(ends[1]) + MARGIN)
}

/// n points from low to high.
pub(crate) fn evenly(low: f64, high: f64, n: usize) -> Vec<f64> {
    let spacing = (high - low) / (n.max(2) - 1) as f64;
    (0..n).map(|i| low + spacing * i as f64).collect()
}

fn times(arguments: &SurfaceArguments, trajectory: &Trajectory) -> Result<Vec<f64>, Failure> {
    let (start, end) = (trajectory.start(), trajectory.end());
    let times = arguments.at.clone().unwrap_or_else(|| vec![end]);
    match times.iter().find(|t| !(start..=end).contains(*t)) {
        None => Ok(times),
        Some(t) => Err(Failure::number(
            "--at",
            *t,
            format!("outside of the run, which lasts from {start} to {end}"),
        )),
    }
}

/// A range, with its spacing from its number of values, from the option `other`, or the default `spacing`.
fn range(
    [option, other]: [&'static str; 2],
    typed: &Interval,
    given: Option<f64>,
    spacing: f64,
) -> Result<Range, Failure> {
    let (low, high) = typed.ends(option)?;
    let points = typed.points(option, given.map(|_| other))?;
    let spacing = points.map_or(spacing, |points| (high - low) / (points - 1) as f64);
    Ok(Range { low, high, spacing, counted_by: points.map(|_| option) })
}

impl Range {
    fn points(&self) -> f64 {
        ((self.high - self.low) / self.spacing).max(1.0)
    }

    /// The points; an error if their number times `each` exceeds `most`.
    fn positions(&self, option: &str, each: f64, most: f64) -> Result<Vec<f64>, Failure> {
        let Self { low, high, spacing, counted_by } = *self;
        let points = self.points() * each;
        if points > most {
            let least = spacing * points / most;
            let message = format!(
                "would make {points:.1e} points, more than fit in memory; take {} or more{}",
                counted_by.map_or(format!("{least:.3e}"), |_| format!("a spacing of {least:.3e}")),
                if most < MOST_PIXELS_OF_GSF { OR_GSF } else { "" }
            );
            return Err(match counted_by {
                Some(range) => Failure::input(range, message),
                None => Failure::number(option, spacing, message),
            });
        }
        let intervals = ((high - low) / spacing + 1e-9).floor() as usize;
        Ok((0..=intervals).map(|i| low + spacing * i as f64).collect())
    }
}
