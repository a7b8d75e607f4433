//! The question `raster-stability`: the threshold for ripples that grow from line to line, and their growth; for a
//! tip that is free to move across the scan, also for bunching and snaking.

use super::lines::{footprint, left, raster, refused};
use crate::documents::table::{Column, Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, Failure, Indentation, Law, ModelParameters, PathName, Question,
    Refused, Tip,
};
use serde::{Deserialize, Serialize};
use stickslip_stability::{
    Raster, RasterCertificate, RasterCritical, RasterKind, RasterPath, StabilityError,
};
use stickslip_tip::Wider;

/// Wave numbers at which growth is computed.
const WAVE_NUMBERS: u32 = 200;
/// Largest wave number of the growth curve, as a fraction of the bandwidth of f: beyond it ripples neither grow nor
/// decay.
const SHOWN: f64 = 0.4;

/// Linear stability of many neighbouring scan lines. Lengths in σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterStabilityFound {
    /// The first wave, as α rises, that does not decay from line to line: a ripple, or with a spring across the scan a
    /// wave of any kind. Null if none grows at any α, and for a repeated line, where some ripple grows at every α.
    pub critical: Option<RasterCriticalDocument>,
    /// With a spring across the scan: the lowest threshold of each kind that has one, by rising α. The first is
    /// `critical`, and only it is certain to be the lowest of its kind: the certificates of the others have a tolerance
    /// of 1 and no cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thresholds: Option<Vec<RasterCriticalDocument>>,
    /// Whether every ripple, or with a spring across the scan every wave, decays from line to line at the α of
    /// `parameters`; null if no α was given, and for a repeated line.
    pub stable: Option<bool>,
    /// Growth of waves e^{iqx} from line to line at the α of `parameters`: of ripples, or with a spring across the scan
    /// of motions in both directions. Null if no α was given, and for a zigzag.
    pub growth: Option<RasterGrowth>,
}

/// Neighbouring scan lines: the critical α, and the growth of ripples from line to line at a given α.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RasterStability {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D of a single line. Without either, α is the critical one.
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
    #[schemars(extend("x-option" = option("V", "Raster", 32)))]
    #[serde(default)]
    pub width_y: Option<f64>,
    /// The path of the support from one line to the next.
    #[schemars(extend("x-option" = option("PATH", "Raster", 31)))]
    #[serde(default)]
    pub path: PathName,
    /// Distance of neighbouring scan lines, in σ: analyse ripples that grow from line to line, and the angle of their
    /// crests, instead of a single line.
    #[schemars(extend("x-option" = option("D", "Raster", 30)))]
    #[serde(default)]
    pub pitch: Option<f64>,
    /// X, the distance that the support moves along each line, in σ; needed for a surface that heals, and only then.
    #[schemars(extend("x-option" = option("X", "Raster", 33)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// κ_y, the spring constant across the scan over that along it, above 0, for a tip that is free to move across:
    /// also analyse bunching and snaking of the lines. Without it the tip cannot leave its lines.
    #[schemars(extend("x-option" = option("K", "Raster", 34)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// Whether α is the critical one, because no other was given.
    #[serde(default)]
    pub at_critical_point: bool,
}

/// The stability of a raster and the question that it answers.
pub type RasterStabilityDocument = Document<RasterStability>;

impl Question for RasterStability {
    const FORMAT: &'static str = "stickslip/raster-stability";
    type Answer = RasterStabilityFound;
}

/// The lowest threshold of each kind, by rising α, or the reason why there is none.
type Thresholds = Result<Vec<RasterCritical>, StabilityError>;

impl RasterStability {
    /// Footprint, law, α and r in the form of documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(&self.tip, self.indentation, self.r, self.law)
    }

    fn raster(&self, law: Wider) -> Result<Raster, Failure> {
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        if let (PathName::Repeat, Some(stiffness)) = (self.path, self.stiffness_across) {
            let why = "linear theory of a repeated line covers only a tip that is held on it: leave the option out, \
            or give {pitch} instead of {path} repeat";
            return Err(Refused::number("stiffness_across", stiffness, why).into());
        }
        let pitch = match (self.path, self.pitch) {
            (PathName::Repeat, Some(pitch)) => {
                let why = "has no meaning with {path} repeat: leave one of them out";
                return Err(Refused::number("pitch", pitch, why).into());
            }
            (PathName::Repeat, None) if !law.is_basic() => {
                let why = "linear theory of a repeated line covers the basic model only: leave out {depth_limit}, \
                           {healing_time} and {inertia}";
                return Err(Refused::word("path", "repeat", why).into());
            }
            // That of no other line.
            (PathName::Repeat, None) => 1e6,
            (_, Some(pitch)) => pitch,
            (_, None) => {
                return Err(Refused::whole("pitch", "is needed: the distance of the lines").into());
            }
        };
        let left = left(self.length, &law, self.r)?;
        let raster = raster(&footprint, law, (self.r, pitch), (left, self.stiffness_across));
        Ok(raster.map_err(|error| self.refused(&error))?)
    }

    fn refused(&self, error: &StabilityError) -> Refused {
        let pitch = || Refused::number("pitch", self.pitch.unwrap_or_default(), "");
        refused(error, self.r, pitch)
    }

    /// The thresholds; `None` for a repeated line. A raster without growth is an answer if α is given.
    fn thresholds(&self, raster: &Raster) -> Result<Option<Thresholds>, Refused> {
        let path = match self.path {
            PathName::OneWay => RasterPath::OneWay,
            PathName::Zigzag => RasterPath::Zigzag,
            PathName::Repeat => return Ok(None),
        };
        let is_given = self.indentation != Indentation::default();
        match raster.thresholds(path) {
            Err(error) if !(is_given && matches!(error, StabilityError::NoCrossing { .. })) => {
                Err(self.refused(&error))
            }
            thresholds => Ok(Some(thresholds)),
        }
    }
}

impl Ask for RasterStability {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        let law = self.law.dragged(&self.tip.0)?;
        let (_, width_y) = footprint(self.width_y, &self.tip.0)?;
        let raster = self.raster(law)?;
        let question = Self { width_y, ..self };
        if question.indentation != Indentation::default() {
            let indentation = question.indentation.resolved(&question.tip.0, law, question.r)?;
            indentation.model(&question.tip.0, law, question.r)?;
            return Ok(Self { indentation, ..question });
        }
        let why = "a repeated line has no critical α: give {alpha} for the growth there";
        let thresholds = question.thresholds(&raster)?;
        let thresholds = thresholds.ok_or_else(|| Refused::whole("alpha", why))?;
        let thresholds = thresholds.map_err(|error| question.refused(&error))?;
        let critical = thresholds.first().map(|critical| critical.alpha);
        let indentation = Indentation { alpha: critical, ..Indentation::default() };
        Ok(Self { indentation, at_critical_point: true, ..question })
    }

    fn answer(&self, _: &Context) -> Result<(RasterStabilityFound, Vec<String>), Failure> {
        let law = self.law.dragged(&self.tip.0)?;
        let raster = self.raster(law)?;
        let model = self.indentation.model(&self.tip.0, law, self.r)?;
        let (alpha, is_given) = (model.alpha(), !self.at_critical_point);
        let thresholds = self.thresholds(&raster)?;
        let mut remarks = vec![];
        if let Some(Err(none)) = &thresholds {
            remarks.push(format!("critical: {none}"));
        }
        if self.path == PathName::Zigzag && is_given {
            remarks.push("growth: on a zigzag only the threshold is known".into());
        }
        if self.path == PathName::Repeat {
            remarks
                .push("critical: another pass deepens some ripple of the groove at every α".into());
        }
        let thresholds = thresholds.map(Result::unwrap_or_default);
        let is_below = |all: &Vec<RasterCritical>| all.first().is_none_or(|at| alpha < at.alpha);
        let stable = thresholds.as_ref().filter(|_| is_given).map(is_below);
        let has_growth = is_given && self.path != PathName::Zigzag;
        let growth = has_growth.then(|| RasterGrowth::of(&raster, self, alpha));
        let is_plane = self.stiffness_across.is_some();
        let thresholds = thresholds.unwrap_or_default();
        let thresholds: Vec<RasterCriticalDocument> =
            thresholds.iter().map(|at| RasterCriticalDocument::of(at, is_plane)).collect();
        let critical = thresholds.first().cloned();
        let thresholds = is_plane.then_some(thresholds);
        Ok((RasterStabilityFound { critical, thresholds, stable, growth }, remarks))
    }
}

impl RasterGrowth {
    /// |z| and arg z as functions of the wave number.
    fn of(raster: &Raster, question: &RasterStability, alpha: f64) -> Self {
        let band = question.tip.0.band();
        let number = |i: u32| SHOWN * band * f64::from(i) / f64::from(WAVE_NUMBERS);
        let q: Vec<f64> = (1..=WAVE_NUMBERS).map(number).collect();
        let growth = |q: &f64| match question.path {
            PathName::Repeat => raster.repeat_gain(alpha, *q).to_polar(),
            _ => raster.growth(alpha, *q).to_polar(),
        };
        let (factor, phase) = q.iter().map(growth).unzip();
        Self { factor, phase, q }
    }
}

/// The critical ripple: at a slightly larger α it grows.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterCriticalDocument {
    /// With a spring across the scan: the kind of wave that grows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<RasterKind>,
    /// The critical α.
    pub alpha: f64,
    /// r, dimensionless.
    pub r: f64,
    /// Wave number of the critical wave along the lines, in 1/σ.
    pub q: f64,
    /// κ, the phase from line to line over the pitch, in 1/σ; null for a zigzag, where the phase alternates.
    pub kappa: Option<f64>,
    /// Angle between crests and scan axis, atan(q/|κ|), in degrees; null for a zigzag.
    pub crest_angle: Option<f64>,
    /// 2π/q, in σ; null if the lines stay straight, q = 0, as for lines that bunch in pairs.
    pub wavelength_x: Option<f64>,
    /// Phase from one line to the next, in rad, from -π to π; for a zigzag, from a trace to the next retrace.
    pub phase_per_line: f64,
    /// Evidence for the threshold; missing in documents of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<RasterCertificate>,
}

/// Growth of ripples against their wave number along the lines.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterGrowth {
    /// Wave numbers, in 1/σ.
    pub q: Vec<f64>,
    /// |z|: for one-way lines the factor from line to line after many lines; for a repeated line the factor of its
    /// groove from the first pass to the second.
    pub factor: Vec<f64>,
    /// arg z, the phase from line to line, in rad.
    pub phase: Vec<f64>,
}

impl RasterCriticalDocument {
    /// A threshold, with its kind if there are several kinds.
    pub fn of(critical: &RasterCritical, has_kind: bool) -> Self {
        let RasterCritical { alpha, r, q, phase_per_line, kappa, crest_angle, .. } = *critical;
        let kind = has_kind.then_some(critical.kind);
        let wavelength_x = Some(critical.wavelength_x).filter(|length| length.is_finite());
        let certificate = Some(critical.certificate);
        Self { kind, alpha, r, q, kappa, crest_angle, wavelength_x, phase_per_line, certificate }
    }
}

impl Tabular for RasterStabilityFound {
    /// The growth as a table over wave numbers; without α the critical ripple, or the thresholds of all kinds.
    fn columns(&self) -> Vec<Named<'_>> {
        if let Some(RasterGrowth { q, factor, phase }) = &self.growth {
            return columns!(q, factor, phase);
        }
        let critical = self.critical.as_slice();
        let rows = self.thresholds.as_deref().unwrap_or(critical);
        let column = |of: fn(&RasterCriticalDocument) -> Option<f64>| rows.iter().map(of).collect();
        let mut columns = vec![
            ("alpha", column(|at| Some(at.alpha))),
            ("q", column(|at| Some(at.q))),
            ("kappa", column(|at| at.kappa)),
            ("crest_angle", column(|at| at.crest_angle)),
            ("wavelength_x", column(|at| at.wavelength_x)),
            ("phase_per_line", column(|at| Some(at.phase_per_line))),
        ];
        if self.thresholds.is_some() {
            let kinds = rows.iter().filter_map(|at| at.kind).map(RasterKind::as_str);
            columns.push(("kind", Column::words(kinds.map(Into::into))));
        }
        columns
    }
}
