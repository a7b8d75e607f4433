//! The question `raster-boundary`: the threshold for ripples that grow from line to line, against the pitch; for a
//! tip that is free to move across the scan, also the thresholds of bunching and snaking.

use super::boundary::{judge_range, refused_range};
use super::lines::{footprint, left, raster, refused};
use crate::documents::table::{Column, Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, Failure, Law, Question, Refused, SpacingName, Tip};
use serde::{Deserialize, Serialize};
use stickslip_stability::{RasterCritical, RasterKind, RasterPath, StabilityError};
use stickslip_tip::{Footprint, Wider};

/// The critical α of rasters over a range of pitches.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RasterBoundary {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// Dimensionless support velocity r (12) of the lines; above 0.
    #[schemars(extend("x-option" = option("R", "Raster", 31)))]
    pub r: f64,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's
    /// Gaussians.
    #[schemars(extend("x-option" = option("V", "Raster", 32)))]
    #[serde(default)]
    pub width_y: Option<f64>,
    /// First and last distance of neighbouring scan lines, in σ, and the number of values: for each, the α at which
    /// ripples begin to grow from line to line, and the angle of their crests.
    #[schemars(extend("x-option" = option("LO:HI:N", "Raster", 30)))]
    pub pitch_range: [f64; 2],
    /// Number of values, if the range does not contain it; from 2 to 100,000.
    #[schemars(extend("x-option" = option("N", "Boundary", 21)))]
    #[serde(default = "super::boundary::default_points")]
    pub points: usize,
    /// Spacing of the values of the range.
    #[schemars(extend("x-option" = option("NAME", "Boundary", 22)))]
    #[serde(default)]
    pub spacing: SpacingName,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// X, the distance that the support moves along each line, in σ; needed for a surface that heals, and only then.
    #[schemars(extend("x-option" = option("X", "Raster", 33)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// κ_y, the spring constant across the scan over that along it, above 0, for a tip that is free to move across:
    /// also analyse bunching and snaking of the lines. Without it the tip cannot leave its lines.
    #[schemars(extend("x-option" = option("K", "Raster", 34)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
}

/// A boundary of rasters and the question that it answers.
pub type RasterBoundaryDocument = Document<RasterBoundary>;

impl Question for RasterBoundary {
    const FORMAT: &'static str = "stickslip/raster-boundary";
    type Answer = RasterBoundaryFound;
}

impl RasterBoundary {
    /// A rejection of the range, with its value as typed.
    fn pitches(&self) -> Refused {
        refused_range("pitch_range", self.pitch_range, self.points, "")
    }
}

impl Ask for RasterBoundary {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        judge_range("pitch_range", self.pitch_range, self.points)?;
        let (_, width_y) = footprint(self.width_y, &self.tip.0)?;
        left(self.length, &self.law.into(), self.r)?;
        Ok(Self { width_y, ..self })
    }

    fn answer(&self, context: &Context) -> Result<(RasterBoundaryFound, Vec<String>), Failure> {
        let law: Wider = self.law.into();
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        let left = left(self.length, &law, self.r)?;
        let across = (left, self.stiffness_across);
        let (mut found, mut left_out) = (RasterBoundaryFound::default(), vec![]);
        found.thresholds = self.stiffness_across.map(|_| ThresholdColumns::default());
        let pitches = self.spacing.values(self.pitch_range, self.points);
        for (n, pitch) in pitches.into_iter().enumerate() {
            match thresholds(&footprint, law, (self.r, pitch), across) {
                Ok((one_way, zigzag)) => found.push(pitch, &one_way, zigzag),
                // That nothing grows is an answer of the wider law.
                Err(StabilityError::NoCrossing { .. }) if !law.is_basic() => left_out.push(pitch),
                Err(StabilityError::Stopped) => return Err(Failure::Cancelled),
                Err(error) => return Err(refused(&error, self.r, || self.pitches()).into()),
            }
            context.counted(n + 1, self.points, "pitches")?;
        }
        Ok((found, remark(&left_out).into_iter().collect()))
    }
}

/// The lowest threshold of each kind for one-way lines, by rising α, and the critical α of a zigzag. The latter is
/// `None` if nothing grows, on a healing surface, and under a depth limit for a tip whose sides differ.
fn thresholds(
    footprint: &Footprint,
    law: Wider,
    (r, pitch): (f64, f64),
    across: (f64, Option<f64>),
) -> Result<(Vec<RasterCritical>, Option<f64>), StabilityError> {
    let raster = raster(footprint, law, (r, pitch), across)?;
    let one_way = raster.thresholds(RasterPath::OneWay)?;
    match raster.critical(RasterPath::Zigzag) {
        Ok(zigzag) => Ok((one_way, Some(zigzag.alpha))),
        Err(
            StabilityError::HealingZigzag
            | StabilityError::EvenOnly(_)
            | StabilityError::NoCrossing { .. },
        ) => Ok((one_way, None)),
        Err(error) => Err(error),
    }
}

fn remark(left_out: &[f64]) -> Option<String> {
    let (first, last) = (left_out.first()?, left_out.last()?);
    Some(format!(
        "{} pitches from {first} to {last} are left out: no ripple grows there at any alpha",
        left_out.len()
    ))
}

/// Threshold for ripples that grow from line to line, against the pitch. Lengths in σ.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterBoundaryFound {
    /// Pitches, in σ, without those at which no ripple grows at any α.
    pub pitch: Vec<f64>,
    /// Critical α of one-way lines; with a spring across the scan the lowest of all kinds.
    pub alpha: Vec<f64>,
    /// Wave number of the critical ripple along the lines, in 1/σ.
    pub q: Vec<f64>,
    /// Wave number of the critical ripple across the lines, in 1/σ.
    pub kappa: Vec<f64>,
    /// Angle between crests and scan axis, in degrees.
    pub crest_angle: Vec<f64>,
    /// Critical α of a zigzag. Null if nothing grows, on a healing surface, where zigzags have no threshold, and under
    /// a depth limit for a tip whose sides differ.
    pub alpha_zigzag: Vec<Option<f64>>,
    /// With a spring across the scan: the kind of wave that grows at `alpha`, and the threshold of each kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thresholds: Option<ThresholdColumns>,
}

/// Thresholds of one-way lines by kind, for each pitch: minima of the critical α over wave vectors. If a band of waves
/// merges with one of lower α, the threshold of its kind is that of a further band, or null. Only the lowest of all
/// thresholds is certain.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThresholdColumns {
    /// Kind of the lowest threshold.
    pub kind: Vec<RasterKind>,
    /// Critical α of ripples.
    pub ripples: Vec<Option<f64>>,
    /// Critical α of bunching lines.
    pub bunching: Vec<Option<f64>>,
    /// Critical α of snaking lines.
    pub snaking: Vec<Option<f64>>,
}

impl RasterBoundaryFound {
    fn push(&mut self, pitch: f64, one_way: &[RasterCritical], zigzag: Option<f64>) {
        let Some(first) = one_way.first() else { return };
        self.pitch.push(pitch);
        self.alpha.push(first.alpha);
        self.q.push(first.q);
        self.kappa.push(first.kappa.unwrap_or_default());
        self.crest_angle.push(first.crest_angle.unwrap_or(90.0));
        self.alpha_zigzag.push(zigzag);
        if let Some(thresholds) = &mut self.thresholds {
            thresholds.push(first.kind, one_way);
        }
    }
}

impl ThresholdColumns {
    fn push(&mut self, first: RasterKind, all: &[RasterCritical]) {
        let of = |kind: RasterKind| {
            let at = all.iter().find(|at| at.kind == kind);
            at.map(|at| at.alpha)
        };
        self.kind.push(first);
        self.ripples.push(of(RasterKind::Ripples));
        self.bunching.push(of(RasterKind::Bunching));
        self.snaking.push(of(RasterKind::Snaking));
    }
}

impl Tabular for RasterBoundaryFound {
    fn columns(&self) -> Vec<Named<'_>> {
        let Self { pitch, alpha, q, kappa, crest_angle, alpha_zigzag, .. } = self;
        let mut columns = columns!(pitch, alpha, q, kappa, crest_angle, alpha_zigzag);
        if let Some(ThresholdColumns { kind, ripples, bunching, snaking }) = &self.thresholds {
            let kinds = kind.iter().map(|kind| kind.as_str().into());
            columns.extend([
                ("kind", Column::words(kinds)),
                ("alpha_ripples", ripples.into()),
                ("alpha_bunching", bunching.into()),
                ("alpha_snaking", snaking.into()),
            ]);
        }
        columns
    }
}
