//! The question `raster`: neighbouring scan lines, and the pattern that they write.

use super::lines::footprint;
use crate::documents::table::Array;
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, Failure, HeightMap, Indentation, Law, ModelParameters, Question,
    RasterFound, Refused, Sampling, Tip, Typed, Unusable,
};
use serde::{Deserialize, Serialize};
use stickslip_raster::{Area, AreaLine, Free, Line, Path, Plan, RasterError, Scanning};
use stickslip_tip::planar::PlanarError;
use stickslip_tip::{Force, MemoryChoice, Pulse, RunError, Scenario};

/// Default distance that the support moves between samples, in widths of the tip.
const SAMPLE: f64 = 0.25;
/// Largest number of samples of all lines together: their columns then take less than a gigabyte.
const MOST_SAMPLES: f64 = 5e6;

/// Everything that defines a raster.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Raster {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D of a single line.
    #[serde(flatten)]
    pub indentation: Indentation,
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
    /// The path of the support from one line to the next.
    #[schemars(extend("x-option" = option("PATH", "Scan", 43)))]
    #[serde(default)]
    pub path: Path,
    /// Distance of the lines, in σ; null if all lines coincide or are unevenly spaced.
    #[schemars(extend("x-option" = option("D", "Scan", 40)))]
    #[serde(default)]
    pub pitch: Option<f64>,
    /// Number of lines.
    #[schemars(extend("x-option" = option("N", "Scan", 41)), transform = crate::parameter::without_default)]
    #[serde(default)]
    pub lines: usize,
    /// X: distance that the support moves along each line, in σ (along the longest line of an area); a line lasts
    /// X/r.
    #[schemars(extend("x-option" = option("X", "Scan", 42)), transform = crate::parameter::without_default)]
    #[serde(default)]
    pub length: f64,
    /// The lines of an area that is not a rectangle, instead of pitch, number and length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<AreaDocument>,
    /// Gaussian pulses of external force on the first line; their times count from its start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pulses: Vec<Pulse>,
    /// Target for the error of x0 on each line, in σ; from 1e-13 to 1e-2.
    #[schemars(extend("x-option" = option("E", "Accuracy", 51)))]
    #[serde(default = "super::run::default_tolerance")]
    pub tolerance: f64,
    /// Memory: the algorithm for the history of a line. All memories give the same motion within the tolerance.
    #[schemars(extend("x-option" = option("MEMORY", "Accuracy", 50)))]
    #[serde(default)]
    pub memory: MemoryChoice,
    /// κ_y, the spring constant across the lines over that along them; above 0. Without it the tip cannot leave its
    /// line.
    #[schemars(extend("x-option" = option("K", "Across the scan", 30)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// Initial distance of the tip from the first line, in σ, if it is free to move across the lines; 0 by default.
    #[schemars(extend("x-option" = option("D", "Across the scan", 31)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kick_across: Option<f64>,
    /// Times of the samples of each line, from its start.
    #[serde(flatten)]
    pub sampling: Sampling,
}

/// A raster and the question that it answers. `remarks` are warnings: a part of the pattern is unknown, or may differ
/// after more lines.
pub type RasterDocument = Document<Raster>;

impl Question for Raster {
    const FORMAT: &'static str = "stickslip/raster";
    type Answer = RasterFound;

    /// The height map `u`, with a row for each of `u_y` and a column for each of `u_x`.
    fn more_arrays(&self, answer: &RasterFound) -> Vec<(&'static str, Array<'static>)> {
        let Ok(plan) = self.plan() else { return vec![] };
        let Ok(lines) = answer.history.lines(&plan) else { return vec![] };
        let map = HeightMap::of(&plan, &lines);
        let u = Array { shape: vec![map.y.len(), map.x.len()], values: map.u.concat().into() };
        vec![("u_x", Array::vector(map.x)), ("u_y", Array::vector(map.y)), ("u", u)]
    }
}

/// Lines in the order in which they are scanned. Lengths in σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaDocument {
    /// y of each line.
    pub y: Vec<f64>,
    /// Smallest x of each line.
    pub start: Vec<f64>,
    /// Distance that the support moves along each line.
    pub length: Vec<f64>,
}

impl AreaDocument {
    /// The document of these lines.
    pub fn of(lines: &[AreaLine]) -> Self {
        let column = |of: fn(&AreaLine) -> f64| lines.iter().map(of).collect();
        Self {
            y: column(|line| line.y),
            start: column(|line| line.start),
            length: column(|line| line.length),
        }
    }

    fn area(&self) -> Result<Area, Unusable> {
        let Self { y, start, length } = self;
        if y.len() != start.len() || y.len() != length.len() {
            return Err(Unusable::new("area: columns of different lengths"));
        }
        let columns = y.iter().zip(start).zip(length);
        let line = |((y, start), length): ((&f64, &f64), &f64)| AreaLine {
            y: *y,
            start: *start,
            length: *length,
        };
        Ok(Area::Lines(columns.map(line).collect()))
    }
}

impl Raster {
    /// Footprint, law, α and r in the form of other documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(&self.tip, self.indentation, self.r, self.law)
    }

    /// The area: a rectangle, or other lines.
    fn area(&self) -> Result<Area, Refused> {
        if let Some(area) = &self.area {
            return area.area().map_err(|error| Refused::whole("area", error));
        }
        let pitch = match (self.path, self.pitch) {
            (Path::Repeat, None) => 0.0,
            (Path::Repeat, Some(pitch)) => {
                let why = "has no meaning with {path} repeat, whose lines are all the same: leave one of them out";
                return Err(Refused::number("pitch", pitch, why));
            }
            (_, Some(pitch)) => pitch,
            (_, None) => {
                return Err(Refused::whole("pitch", "is needed: the distance of the lines"));
            }
        };
        Ok(Area::Rectangle { pitch, lines: self.lines, length: self.length })
    }

    /// The plan of a resolved question.
    ///
    /// # Errors
    /// A parameter is out of its range, or contradicts another.
    pub fn plan(&self) -> Result<Plan, Failure> {
        let model = self.indentation.model(&self.tip.0, self.law.into(), self.r)?;
        // A saved question contains the resolved values.
        let (footprint, _) = footprint(self.width_y, model.tip())?;
        let mut plan = Plan::over(footprint, model, self.path, self.area()?);
        let force = Force::new(self.pulses.clone(), None);
        plan.disturbance = force.map_err(|error| Refused::whole("pulses", error))?;
        plan.free = self.free()?;
        plan.law = Scenario { tolerance: self.tolerance, memory: self.memory, ..plan.law };
        plan.validate().map_err(|error| self.refused(&error))?;
        Ok(plan)
    }

    /// Motion across the lines; `None` if the tip is held on them.
    fn free(&self) -> Result<Option<Free>, Refused> {
        match (self.stiffness_across, self.kick_across) {
            (Some(stiffness), kick) => {
                Ok(Some(Free { kick: kick.unwrap_or_default(), ..Free::new(stiffness) }))
            }
            (None, None) => Ok(None),
            (None, Some(kick)) => {
                let why = "is of a tip that is free to move across the lines: give {stiffness_across} too";
                Err(Refused::number("kick_across", kick, why))
            }
        }
    }

    /// The rejection of the parameter that caused this error.
    fn refused(&self, error: &RasterError) -> Refused {
        let of_area = |name: &'static str, value: f64| match self.area {
            Some(_) => Refused::whole("area", error),
            None => Refused::number(name, value, error),
        };
        match error {
            RasterError::Pitch { pitch, .. } => Refused::number("pitch", *pitch, error),
            RasterError::Length { length, .. } => Refused::number("length", *length, error),
            RasterError::Lines(lines) | RasterError::Memory { lines, .. } => {
                of_area("lines", *lines as f64)
            }
            RasterError::AreaLine { .. }
            | RasterError::Extent { .. }
            | RasterError::Crowded { .. } => Refused::whole("area", error),
            RasterError::RepeatedArea => Refused::word("path", "repeat", error),
            RasterError::NoSpring => Refused::whole("no_spring", error),
            RasterError::NeverFades | RasterError::Section => Refused::whole("tip", error),
            RasterError::Line { error: RunError::Tolerance(tolerance), .. } => {
                Refused::number("tolerance", *tolerance, RunError::Tolerance(*tolerance))
            }
            RasterError::Line { error: RunError::Modes(error), .. }
            | RasterError::Free { error: PlanarError::Fit(error), .. } => {
                Refused::word("memory", "modes", error)
            }
            RasterError::Line { .. } => of_area("length", self.length),
            RasterError::Free { error: PlanarError::Kick(kick), .. } => {
                Refused::number("kick_across", *kick, error)
            }
            RasterError::Free {
                error: PlanarError::Products(_) | PlanarError::TwoSides, ..
            } => Refused::whole("tip", error),
            RasterError::Free { .. } => {
                let stiffness = self.stiffness_across.unwrap_or_default();
                Refused::number("stiffness_across", stiffness, error)
            }
        }
    }

    /// Times at which each line is sampled, from its start; they extend over the longest line.
    ///
    /// # Errors
    /// A time is out of range, or there would be more samples than allowed.
    pub fn times(&self, plan: &Plan) -> Result<Vec<f64>, Refused> {
        let duration = plan.duration_of(plan.area.longest());
        let lines = plan.lines() as f64;
        if self.sampling != Sampling::default() {
            let times = self.sampling.times((0.0, duration), "each line", true)?.all();
            return match times.len() as f64 * lines <= MOST_SAMPLES {
                true => Ok(times),
                false => Err(self.too_many((times.len() as f64, lines), duration)),
            };
        }
        let width = 8.7 / plan.footprint.path().band();
        let most = (MOST_SAMPLES / lines - 1.0).clamp(2.0, 2000.0);
        let count = (plan.area.longest() / (SAMPLE * width)).ceil().clamp(2.0, most);
        Ok((0..=count as usize).map(|i| duration * i as f64 / count).collect())
    }

    /// Rejects more samples than fit in memory, and names values that would fit.
    fn too_many(&self, (each, lines): (f64, f64), duration: f64) -> Refused {
        let (count, most) = (each * lines, (MOST_SAMPLES / lines).floor());
        let why = format!(
            "would make {count:.1e} samples on {lines} lines, more than are kept in memory"
        );
        match self.sampling.sample_every {
            Some(every) => {
                let least = duration / (most - 1.0).max(1.0);
                Refused::number("sample_every", every, format!("{why}; take {least:.3e} or more"))
            }
            None => {
                let value = format!("with {} times", Typed(each));
                Refused::word("sample_at", value, format!("{why}; take at most {most}"))
            }
        }
    }

    /// The document of these lines of `plan`. Each line is sampled at `times`, counted from its start, up to its end.
    #[must_use]
    pub fn document(self, plan: &Plan, lines: &[Line], times: &[f64]) -> RasterDocument {
        let (found, remarks) = RasterFound::of(plan, lines, times);
        Document::new(self, found, remarks)
    }
}

impl Ask for Raster {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        let indentation = self.indentation.resolved(&self.tip.0, self.law.into(), self.r)?;
        let (_, width_y) = footprint(self.width_y, &self.tip.0)?;
        let question = Self { indentation, width_y, ..self };
        let plan = question.plan()?;
        let (pitch, lines, length) =
            (plan.area.pitch(plan.path), plan.lines(), plan.area.longest());
        let question = Self { pitch, lines, length, ..question };
        question.times(&plan)?;
        Ok(question)
    }

    fn answer(&self, context: &Context) -> Result<(RasterFound, Vec<String>), Failure> {
        let plan = self.plan()?;
        let times = self.times(&plan)?;
        let failed = |error: RasterError| Failure::Failed(error.to_string());
        let mut scanning = Scanning::new(&plan).map_err(failed)?;
        let (mut done, mut counted) = (0, Ok(()));
        let take = |_: &Line| {
            done += 1;
            counted = context.counted(done, plan.lines(), "lines");
            counted.is_ok()
        };
        scanning.scan(0, take).map_err(failed)?;
        counted?;
        Ok(RasterFound::of(&plan, scanning.lines(), &times))
    }
}

impl Document<Raster> {
    /// The plan, and the lines as reconstructed from their dense history.
    ///
    /// # Errors
    /// The document is damaged.
    pub fn scanned(&self) -> Result<(Plan, Vec<Line>), Unusable> {
        let plan = self.parameters.plan()?;
        let lines = self.history.lines(&plan)?;
        Ok((plan, lines))
    }

    /// u at every y (rows) and every x (columns).
    ///
    /// # Errors
    /// The document is damaged.
    pub fn heights(&self, x: Vec<f64>, y: Vec<f64>) -> Result<HeightMap, Unusable> {
        let (plan, lines) = self.scanned()?;
        Ok(HeightMap::at(&plan, &lines, x, y))
    }

    /// u on every line, at even distances from the smallest x to the largest. Unevenly spaced lines are interpolated
    /// on evenly spaced rows; around a repeated line, rows on either side are added.
    ///
    /// # Errors
    /// The document is damaged.
    pub fn height_map(&self) -> Result<HeightMap, Unusable> {
        let (plan, lines) = self.scanned()?;
        Ok(HeightMap::of(&plan, &lines))
    }
}
