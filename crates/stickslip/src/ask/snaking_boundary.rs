//! The question `snaking-boundary`: the threshold above which a single line snakes, against the stiffness across the
//! scan or the velocity, and for comparison the onset of stick-slip.

use super::boundary::{judge_range, refused_range};
use super::lines::footprint;
use crate::documents::table::{Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, Failure, Law, Question, Refused, SpacingName, Tip};
use serde::{Deserialize, Serialize};
use stickslip_stability::{self as stability, Snaking, StabilityError};
use stickslip_tip::{Footprint, Wider};

/// The critical α of snaking over a range of κ_y or of r.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct SnakingBoundary {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// First and last κ_y, the spring constant across the scan over that along it, above 0, and the number of values:
    /// for each, the α above which a single line snakes.
    #[schemars(extend("x-option" = option("LO:HI:N", "Across the scan", 40)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_range: Option<[f64; 2]>,
    /// First and last r, above 0, and the number of values, both ends included.
    #[schemars(extend("x-option" = option("LO:HI:N", "Boundary", 20)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub r_range: Option<[f64; 2]>,
    /// Dimensionless support velocity r (12), above 0, for a range of κ_y.
    #[schemars(extend("x-option" = option("R", "Raster", 31)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub r: Option<f64>,
    /// κ_y, above 0, for a range of r.
    #[schemars(extend("x-option" = option("K", "Raster", 34)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's
    /// Gaussians.
    #[schemars(extend("x-option" = option("V", "Raster", 32)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_y: Option<f64>,
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
}

/// A boundary of snaking and the question that it answers.
pub type SnakingBoundaryDocument = Document<SnakingBoundary>;

/// Threshold of snaking against κ_y or r. The columns have equal lengths; values at which a line never snakes are left
/// out.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SnakingBoundaryFound {
    /// κ_y, in units of the spring along the scan.
    pub stiffness: Vec<f64>,
    /// r, dimensionless.
    pub r: Vec<f64>,
    /// α_y, above which the line snakes. A search over all wave numbers certifies that no wave grows below α_y.
    pub alpha: Vec<f64>,
    /// Angular frequency at the threshold, in k/Γ.
    pub omega: Vec<f64>,
    /// Wavelength at the threshold, in σ.
    pub wavelength: Vec<f64>,
    /// αc(r), above which the line sticks and slips; null if it does not at any α.
    pub alpha_stick_slip: Vec<Option<f64>>,
    /// Points within the range at which both thresholds are equal.
    pub crossings: Vec<SnakingCrossing>,
}

/// A point at which a line begins to snake and to stick and slip at the same α.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SnakingCrossing {
    /// κ_y, in units of the spring along the scan.
    pub stiffness: f64,
    /// r, dimensionless.
    pub r: f64,
    /// α, dimensionless.
    pub alpha: f64,
}

impl Question for SnakingBoundary {
    const FORMAT: &'static str = "stickslip/snaking-boundary";
    type Answer = SnakingBoundaryFound;
}

/// Both thresholds at one point.
struct Place {
    stiffness: f64,
    r: f64,
    snaking: Option<stability::SnakingCritical>,
    stick_slip: Option<f64>,
}

impl Place {
    /// α_y - αc
    fn difference(&self) -> Option<f64> {
        Some(self.snaking?.alpha - self.stick_slip?)
    }
}

/// The values over which the boundary is computed.
#[derive(Clone, Copy)]
struct Line {
    /// Name of the range.
    name: &'static str,
    ends: [f64; 2],
    /// Whether κ_y varies; otherwise r does.
    over_stiffness: bool,
    /// The value of r or κ_y that is fixed.
    fixed: f64,
}

impl Line {
    /// (κ_y, r) at a value of the range.
    fn at(self, value: f64) -> (f64, f64) {
        if self.over_stiffness { (value, self.fixed) } else { (self.fixed, value) }
    }
}

/// Steps of the bisection for a crossing, to the last bits of κ_y or r.
const BISECTIONS: u32 = 48;

impl SnakingBoundary {
    /// The range and the fixed value.
    fn range(&self) -> Result<Line, Refused> {
        let (name, ends) = match (self.stiffness_range, self.r_range) {
            (Some(ends), None) => ("stiffness_range", ends),
            (None, Some(ends)) => ("r_range", ends),
            (None, None) => {
                let why = "is needed, or {r_range}: a range of one of the two";
                return Err(Refused::whole("stiffness_range", why));
            }
            (Some(_), Some(_)) => {
                let why = "and {r_range} are both ranges: leave one of them out";
                return Err(Refused::whole("stiffness_range", why));
            }
        };
        let (r, stiffness) = (("r", self.r), ("stiffness_across", self.stiffness_across));
        let over_stiffness = name == "stiffness_range";
        let (fixed, varied) = if over_stiffness { (r, stiffness) } else { (stiffness, r) };
        if let (varied, Some(value)) = varied {
            let why = format!("varies over {{{name}}}: leave one of them out");
            return Err(Refused::number(varied, value, why));
        }
        let (parameter, value) = fixed;
        let fixed = value.ok_or_else(|| Refused::whole(parameter, "is needed: its fixed value"))?;
        let fixed = Refused::positive(parameter, fixed)?;
        Ok(Line { name, ends, over_stiffness, fixed })
    }

    /// Rejects an invalid range, or too few or too many points.
    fn judged(&self) -> Result<(), Refused> {
        let Line { name, ends, .. } = self.range()?;
        judge_range(name, ends, self.points)
    }
}

/// Both thresholds at (κ_y, r).
fn place(
    footprint: &Footprint,
    law: Wider,
    (stiffness, r): (f64, f64),
) -> Result<Place, StabilityError> {
    let snaking = Snaking::new(footprint, law, (r, stiffness))?.critical()?;
    let stick_slip = match stability::Boundary::new(&law, footprint.path()).at(r) {
        Ok(found) => Some(found.alpha),
        Err(StabilityError::Stopped) => return Err(StabilityError::Stopped),
        Err(StabilityError::Wider(error)) => return Err(error.into()),
        Err(_) => None,
    };
    Ok(Place { stiffness, r, snaking, stick_slip })
}

/// The point between two values at which both thresholds are equal; `None` if one of them does not exist.
fn crossing(
    [mut low, mut high]: [f64; 2],
    at: impl Fn(f64) -> Result<Place, StabilityError>,
) -> Result<Option<SnakingCrossing>, StabilityError> {
    let is_first = |place: &Place| place.difference().map(|difference| difference < 0.0);
    let Some(first) = is_first(&at(low)?) else { return Ok(None) };
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        match is_first(&at(middle)?) {
            Some(here) if here == first => low = middle,
            Some(_) => high = middle,
            None => return Ok(None),
        }
        if high - low <= 4.0 * f64::EPSILON * high {
            break;
        }
    }
    let found = at(f64::midpoint(low, high))?;
    let crossing = |alpha| SnakingCrossing { stiffness: found.stiffness, r: found.r, alpha };
    Ok(found.stick_slip.map(crossing))
}

impl Ask for SnakingBoundary {
    fn support_velocity(&self) -> Option<f64> {
        self.r
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.judged()?;
        self.law.dragged(&self.tip.0)?;
        let (_, width_y) = footprint(self.width_y, &self.tip.0)?;
        Ok(Self { width_y, ..self })
    }

    fn answer(&self, context: &Context) -> Result<(SnakingBoundaryFound, Vec<String>), Failure> {
        let law = self.law.dragged(&self.tip.0)?;
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        let line = self.range()?;
        let Line { name, ends, .. } = line;
        let failed = |error: StabilityError| match error {
            StabilityError::Stopped => Failure::Cancelled,
            error => refused_range(name, ends, self.points, error).into(),
        };
        let at = |value: f64| place(&footprint, law, line.at(value));
        let (mut found, mut left_out) = (SnakingBoundaryFound::default(), vec![]);
        let mut before: Option<(f64, f64)> = None;
        for (n, value) in self.spacing.values(ends, self.points).into_iter().enumerate() {
            let place = at(value).map_err(failed)?;
            let difference = place.difference();
            if let (Some((last, sign)), Some(here)) = (before, difference)
                && sign * here < 0.0
            {
                found.crossings.extend(crossing([last, value], at).map_err(failed)?);
            }
            before = difference.map(|difference| (value, difference));
            match place.snaking {
                Some(critical) => found.push(&critical, place.stick_slip),
                None => left_out.push(value),
            }
            context.counted(n + 1, self.points, "steps")?;
        }
        Ok((found, remark(&left_out).into_iter().collect()))
    }
}

fn remark(left_out: &[f64]) -> Option<String> {
    let (first, last) = (left_out.first()?, left_out.last()?);
    Some(format!(
        "{} values from {first} to {last} are left out: a line does not snake there, however large alpha",
        left_out.len()
    ))
}

impl SnakingBoundaryFound {
    fn push(&mut self, critical: &stability::SnakingCritical, stick_slip: Option<f64>) {
        self.stiffness.push(critical.stiffness);
        self.r.push(critical.r);
        self.alpha.push(critical.alpha);
        self.omega.push(critical.omega);
        self.wavelength.push(critical.wavelength);
        self.alpha_stick_slip.push(stick_slip);
    }
}

impl Tabular for SnakingBoundaryFound {
    fn columns(&self) -> Vec<Named<'_>> {
        let Self { stiffness, r, alpha, omega, wavelength, alpha_stick_slip, .. } = self;
        columns!(stiffness, r, alpha, omega, wavelength, alpha_stick_slip)
    }
}
