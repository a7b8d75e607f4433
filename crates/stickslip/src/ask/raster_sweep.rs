//! The question `raster-sweep`: the pattern that a raster writes, over a grid of pitch and α.

use super::lines::{footprint, raster};
use super::points::{Points, all_points};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, Failure, Law, Question, RasterSweepFound, RasterSweepPoint, Refused,
    ShardDocument, Tip, Typed,
};
use serde::{Deserialize, Serialize};
use stickslip_raster::{
    Free, Line, LineRegime, Path, Plan, RasterError, Scanning, line_regime, pattern,
};
use stickslip_stability::RasterPath;
use stickslip_tip::{Model, RunError, Wider};

const MOST_POINTS: usize = 100_000;

/// A grid of pitches times α, with α varying fastest, and the common parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct RasterSweep {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    pub r: f64,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's
    /// Gaussians.
    #[schemars(extend("x-option" = option("V", "Model", 6)))]
    #[serde(default)]
    pub width_y: Option<f64>,
    /// κ_y, the spring constant across the lines over that along them; above 0. Without it the tip cannot leave its
    /// line.
    #[schemars(extend("x-option" = option("K", "Across the scan", 30)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// The path of the support from one line to the next.
    #[schemars(extend("x-option" = option("PATH", "Scan", 43)))]
    #[serde(default)]
    pub path: Path,
    /// Distances of the lines, in σ.
    #[schemars(extend("x-option" = option("RANGE", "Scan", 40)))]
    pub pitch: Vec<f64>,
    /// Dimensionless indentation rates α (13).
    #[schemars(extend("x-option" = option("RANGE", "Model", 3)))]
    pub alpha: Vec<f64>,
    /// Number of lines of each raster.
    #[schemars(extend("x-option" = option("N", "Scan", 41)))]
    pub lines: usize,
    /// X: distance that the support moves along each line, in σ.
    #[schemars(extend("x-option" = option("X", "Scan", 42)))]
    pub length: f64,
    /// Target for the error of x0 on each line, in σ; from 1e-13 to 1e-2.
    #[schemars(extend("x-option" = option("E", "Accuracy", 51)))]
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Part of the points in this document; by default all.
    #[serde(default)]
    pub shard: Option<ShardDocument>,
}

/// Sufficient for regimes.
fn default_tolerance() -> f64 {
    1e-6
}

/// A sweep of rasters and the question that it answers.
pub type RasterSweepDocument = Document<RasterSweep>;

impl Question for RasterSweep {
    const FORMAT: &'static str = "stickslip/raster-sweep";
    type Answer = RasterSweepFound;
}

impl Ask for RasterSweep {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        let (_, width_y) = footprint(self.width_y, &self.tip.0)?;
        if self.path == Path::Repeat {
            let why = "a repeated line has no pitch: take one-way or zigzag";
            return Err(Refused::word("path", "repeat", why).into());
        }
        for (name, values) in [("pitch", &self.pitch), ("alpha", &self.alpha)] {
            if values.is_empty() {
                return Err(Refused::whole(name, "needs a value, or several").into());
            }
        }
        let count = self.points();
        if count > MOST_POINTS {
            let why = format!("make {count} points; at most {MOST_POINTS} are accepted");
            return Err(Refused::whole("pitch and alpha", why).into());
        }
        // Both ends: an error of any point is one of an end.
        for index in [0, count - 1] {
            self.plan(index)?;
        }
        Ok(Self { width_y, ..self })
    }

    fn answer(&self, context: &Context) -> Result<(RasterSweepFound, Vec<String>), Failure> {
        let points = all_points(self, context)?;
        Ok((RasterSweepFound { points, arithmetic: None, crc32: None }, vec![]))
    }
}

impl Points for RasterSweep {
    type Point = RasterSweepPoint;

    fn points(&self) -> usize {
        self.pitch.len().saturating_mul(self.alpha.len())
    }

    fn shard(&self) -> Option<ShardDocument> {
        self.shard
    }

    fn index(point: &RasterSweepPoint) -> usize {
        point.index
    }

    fn has_parallel_parts(&self) -> bool {
        true
    }

    fn compute(&self, indices: &[usize], take: &mut dyn FnMut(RasterSweepPoint)) {
        indices.iter().for_each(|index| take(self.point(*index)));
    }

    fn failed(&self, index: usize, why: &str) -> RasterSweepPoint {
        let point = RasterSweepPoint::at(index, self.place(index), None);
        RasterSweepPoint { error: Some(why.into()), ..point }
    }
}

impl RasterSweep {
    /// Pitch and α of a point.
    fn place(&self, index: usize) -> (f64, f64) {
        (self.pitch[index / self.alpha.len()], self.alpha[index % self.alpha.len()])
    }

    fn plan(&self, index: usize) -> Result<Plan, Refused> {
        let (pitch, alpha) = self.place(index);
        if self.law.no_spring {
            return Err(Refused::whole("no_spring", RasterError::NoSpring));
        }
        let model = Model::under(self.law.into(), self.tip.0.clone(), alpha, self.r)?;
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        let mut plan = Plan::new(footprint, model, self.path, pitch, self.lines, self.length);
        plan.free = self.stiffness_across.map(Free::new);
        plan.law.tolerance = self.tolerance;
        plan.validate().map_err(|error| match (&error, self.stiffness_across) {
            (RasterError::Free { .. }, Some(stiffness)) => {
                Refused::number("stiffness_across", stiffness, error)
            }
            (RasterError::Pitch { pitch, .. }, _) => Refused::number("pitch", *pitch, &error),
            (RasterError::Length { length, .. }, _) => Refused::number("length", *length, &error),
            (RasterError::Lines(lines) | RasterError::Memory { lines, .. }, _) => {
                Refused::number("lines", *lines as f64, &error)
            }
            (RasterError::Line { error: tolerance @ RunError::Tolerance(_), .. }, _) => {
                Refused::number("tolerance", self.tolerance, tolerance)
            }
            _ => {
                let values = [pitch, alpha, self.r].map(|v| Typed(v).to_string());
                Refused::word("pitch and alpha and r", values.join(" and "), error)
            }
        })?;
        Ok(plan)
    }

    /// The point with its results, which depend on its own parameters alone.
    fn point(&self, index: usize) -> RasterSweepPoint {
        let (pitch, alpha) = self.place(index);
        let point = RasterSweepPoint::at(index, (pitch, alpha), self.threshold(pitch));
        let scanned = || -> Result<(Plan, Vec<Line>), String> {
            let plan = self.plan(index).map_err(|refused| refused.to_string())?;
            let mut scanning = Scanning::new(&plan).map_err(|error| error.to_string())?;
            while scanning.next_line().map_err(|error| error.to_string())?.is_some() {}
            let lines = scanning.into_lines();
            Ok((plan, lines))
        };
        match scanned() {
            Err(error) => RasterSweepPoint { error: Some(error), ..point },
            Ok((plan, lines)) => {
                let is_stuck =
                    |line: &&Line| line_regime(&plan, line) == LineRegime::StuckAtTheEdge;
                let stuck = lines.iter().filter(is_stuck).count();
                point.written(&pattern(&plan, &lines), stuck)
            }
        }
    }

    /// αc for growth from line to line, if linear theory has one.
    fn threshold(&self, pitch: f64) -> Option<f64> {
        let path = if self.path == Path::Zigzag { RasterPath::Zigzag } else { RasterPath::OneWay };
        let law: Wider = self.law.into();
        let left = law.left_after(self.length / self.r);
        let (footprint, _) = footprint(self.width_y, &self.tip.0).ok()?;
        let across = (left, self.stiffness_across);
        let raster = raster(&footprint, law, (self.r, pitch), across).ok()?;
        Some(raster.critical(path).ok()?.alpha)
    }
}
