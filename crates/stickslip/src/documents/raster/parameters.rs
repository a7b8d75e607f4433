//! Everything that defines a raster.

use crate::{MemoryName, ModelParameters, PulseParameters, Unusable};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Area, AreaLine, Path, Plan};
use stickslip_tip::{Footprint, Force, Pulse, Scenario};

/// How the support goes from one line to the next.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PathName {
    /// Every line from x = 0 in the same direction, with the spring relaxed.
    #[default]
    OneWay,
    /// The support turns back at the end of a line and goes one pitch further; the tip starts where it was.
    Zigzag,
    /// The same line again, from x = 0, with the spring relaxed.
    Repeat,
}

/// Everything that defines a raster.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RasterParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ; null where the tip has its own f(x,y).
    pub width_y: Option<f64>,
    /// How the support goes from one line to the next.
    pub path: PathName,
    /// Distance of the lines, in σ; null where all are the same, or they are unevenly spaced.
    pub pitch: Option<f64>,
    /// How many were asked for.
    pub lines: usize,
    /// X, how far the support goes along each, in σ; along the longest of an area.
    pub length: f64,
    /// The lines of an area that is no rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<AreaDocument>,
    /// Gaussian pulses of external force on the first line, by the time since its start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pulses: Vec<PulseParameters>,
    /// Error of x0 on each line asked for, in σ.
    pub tolerance: f64,
    /// Memory asked for.
    pub memory: MemoryName,
}

/// Lines in the order in which they are scanned. Lengths in σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaDocument {
    /// Where each lies.
    pub y: Vec<f64>,
    /// Its smallest x.
    pub start: Vec<f64>,
    /// How far the support goes along it.
    pub length: Vec<f64>,
}

impl AreaDocument {
    fn of(lines: &[AreaLine]) -> Self {
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

impl RasterParameters {
    /// Those of a plan.
    #[must_use]
    pub fn of(plan: &Plan, model: ModelParameters, width_y: Option<f64>) -> Self {
        Self {
            model,
            width_y,
            path: plan.path.into(),
            pitch: plan.area.pitch(plan.path),
            lines: plan.lines(),
            length: plan.area.longest(),
            area: match &plan.area {
                Area::Lines(lines) => Some(AreaDocument::of(lines)),
                Area::Rectangle { .. } => None,
            },
            pulses: plan.disturbance.pulses().iter().copied().map(Into::into).collect(),
            tolerance: plan.law.tolerance,
            memory: plan.law.memory.into(),
        }
    }

    /// The plan again.
    ///
    /// # Errors
    /// No raster can be that of these parameters.
    pub fn plan(&self) -> Result<Plan, Unusable> {
        let model = self.model.model()?;
        let footprint = match (model.tip().footprint(), self.width_y) {
            (Some(own), None) => own.clone(),
            (None, Some(width)) => {
                Footprint::separable(model.tip().clone(), width).map_err(Unusable::new)?
            }
            _ => {
                return Err(Unusable::new(
                    "width_y: needed where the tip has no f(x,y), and only there",
                ));
            }
        };
        let path = Path::from(self.path);
        let area = match &self.area {
            Some(area) => area.area()?,
            None if (path == Path::Repeat) == self.pitch.is_some() => {
                return Err(Unusable::new("pitch: needed where lines differ, and only there"));
            }
            None => {
                let (lines, length) = (self.lines, self.length);
                Area::Rectangle { pitch: self.pitch.unwrap_or(0.0), lines, length }
            }
        };
        let mut plan = Plan::over(footprint, model, path, area);
        let pulses: Vec<Pulse> = self.pulses.iter().map(Into::into).collect();
        plan.disturbance = Force::new(pulses, None).map_err(Unusable::new)?;
        plan.law = Scenario { tolerance: self.tolerance, memory: self.memory.into(), ..plan.law };
        plan.validate().map_err(Unusable::new)?;
        Ok(plan)
    }
}

impl From<Path> for PathName {
    fn from(path: Path) -> Self {
        match path {
            Path::OneWay => Self::OneWay,
            Path::Zigzag => Self::Zigzag,
            Path::Repeat => Self::Repeat,
        }
    }
}

impl From<PathName> for Path {
    fn from(name: PathName) -> Self {
        match name {
            PathName::OneWay => Self::OneWay,
            PathName::Zigzag => Self::Zigzag,
            PathName::Repeat => Self::Repeat,
        }
    }
}
