//! Everything that defines a raster.

use crate::{MemoryName, ModelParameters, Unusable};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Path, Plan};
use stickslip_tip::{Footprint, Scenario};

/// How the support goes from one line to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PathName {
    /// Every line from x = 0 in the same direction, with the spring relaxed.
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
    /// Distance of the lines, in σ; null where all are the same.
    pub pitch: Option<f64>,
    /// How many were asked for.
    pub lines: usize,
    /// X, how far the support goes along each, in σ.
    pub length: f64,
    /// Error of x0 on each line asked for, in σ.
    pub tolerance: f64,
    /// Memory asked for.
    pub memory: MemoryName,
}

impl RasterParameters {
    /// Those of a plan.
    #[must_use]
    pub fn of(plan: &Plan, model: ModelParameters, width_y: Option<f64>) -> Self {
        Self {
            model,
            width_y,
            path: plan.path.into(),
            pitch: (plan.path != Path::Repeat).then_some(plan.pitch),
            lines: plan.lines,
            length: plan.length,
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
        if (path == Path::Repeat) == self.pitch.is_some() {
            return Err(Unusable::new("pitch: needed where lines differ, and only there"));
        }
        let pitch = self.pitch.unwrap_or(0.0);
        let mut plan = Plan::new(footprint, model, path, pitch, self.lines, self.length);
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
