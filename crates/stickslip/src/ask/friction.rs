//! The question `friction`: the numbers of a measured friction loop.

use crate::documents::table::{Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, EstimateDocument, Failure, Question, Refused, digits};
use serde::{Deserialize, Serialize};
use stickslip_measurement::{FrictionLoop, LoopError, LoopNumbers};
use stickslip_tip::sorting::ends;
use stickslip_units::Unit;

/// Friction forces of a loop, with 95 % intervals, in the units given here.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFound {
    /// Unit of lengths: nm, or σ for a run without scales; null if it is unknown.
    pub length_unit: Option<String>,
    /// Unit of forces: nN, the unit of the data, or kσ for a run without scales; null if it is unknown.
    pub force_unit: Option<String>,
    /// Unit of the work: fJ or kσ². Null if lengths or forces have no SI unit: the work is then in units of force times
    /// length.
    pub work_unit: Option<String>,
    /// Kinetic friction force: half of the mean difference between trace and retrace, over positions more than twice as
    /// far from the reversals as the static peak; if there is no peak and too little of such a way, over all positions
    /// behind the rise.
    pub kinetic: EstimateDocument,
    /// Mean friction force: half of the mean difference between trace and retrace along the whole loop.
    pub mean: EstimateDocument,
    /// Static friction force: the first maximum after the reversal, minus the offset; mean of trace and retrace.
    pub static_peak: EstimateDocument,
    /// Static over kinetic friction force.
    pub peak_ratio: f64,
    /// Hysteresis: mean difference between trace and retrace along the whole loop.
    pub hysteresis: EstimateDocument,
    /// Work ∮ F dx dissipated in a loop.
    pub work: EstimateDocument,
    /// Mean of trace and retrace over the same positions as `kinetic`: zero of the instrument, and slope of the sample.
    pub offset: EstimateDocument,
    /// Distance from the reversal to the static peak; mean of trace and retrace.
    pub reversal: f64,
    /// Slope of the force after the reversal: stiffness of lever and contact in series, in units of force over length.
    pub stiffness: EstimateDocument,
    /// Standard deviation of the noise of the force from row to row.
    pub noise: f64,
    /// The loop, in `length_unit` and `force_unit`.
    pub rows: LoopColumns,
}

/// A friction loop and the question that it answers.
pub type FrictionDocument = Document<Friction>;

/// Friction force, static peak and work of a measured loop of lateral force.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Friction {
    /// Name of the data, such as that of their files.
    pub source: String,
    /// Unit of the positions: m, um, nm, …; that of the data by default.
    #[schemars(extend("x-option" = option("UNIT", "Data", 1)))]
    pub unit: Option<String>,
    /// Unit of the forces: N, nN, V, …; that of the data by default.
    #[schemars(extend("x-option" = option("UNIT", "Data", 2)))]
    pub force_unit: Option<String>,
    /// Force, in N, that corresponds to 1 in the data, if `force_unit` is no unit of force.
    pub sensitivity: Option<f64>,
    /// Forces of the trace. Documents contain the loop in the answer.
    #[serde(skip_serializing)]
    pub trace: ForceTrack,
    /// Forces of the retrace.
    #[serde(skip_serializing)]
    pub retrace: ForceTrack,
}

/// Lateral forces along a line, in rows of any order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceTrack {
    /// Positions of the support.
    pub x: Vec<f64>,
    /// Forces.
    pub force: Vec<f64>,
}

/// A loop; columns of equal length, by ascending position.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoopColumns {
    /// Positions at which trace and retrace are known.
    pub x: Vec<f64>,
    /// Forces of the trace.
    pub trace: Vec<f64>,
    /// Forces of the retrace, interpolated at the positions of the trace.
    pub retrace: Vec<f64>,
}

/// Least fraction of all positions that trace and retrace have in common in a whole loop.
const WHOLE: f64 = 0.95;
/// Number of nm in 1 m, and of nN in 1 N.
const NANO: f64 = 1e9;
/// Number of fJ in 1 nN nm.
const FEMTOJOULES: f64 = 1e-3;
/// Units of lengths and forces of the model.
pub(crate) const SIGMA: &str = "σ";
pub(crate) const K_SIGMA: &str = "kσ";

impl Question for Friction {
    const FORMAT: &'static str = "stickslip/friction";
    type Answer = FrictionFound;

    fn unit_of<'a>(&'a self, answer: &'a FrictionFound, column: &str) -> Option<&'a str> {
        let unit = if column == "x" { &answer.length_unit } else { &answer.force_unit };
        unit.as_deref().filter(|unit| ![SIGMA, K_SIGMA].contains(unit))
    }
}

impl Friction {
    /// Whether positions are in σ and forces in kσ, as those of a run without scales.
    fn is_of_model(&self) -> bool {
        self.unit.as_deref() == Some(SIGMA) && self.force_unit.as_deref() == Some(K_SIGMA)
    }

    /// The factor from the positions to nm, if their unit is known.
    fn nanometres(&self) -> Result<Option<f64>, Refused> {
        if self.is_of_model() {
            return Ok(None);
        }
        let metres = self.unit.as_deref().map(|unit| Refused::metres("unit", unit)).transpose()?;
        Ok(metres.map(|metres| NANO * metres))
    }

    /// The factor from the forces to nN, if it is known.
    fn nanonewtons(&self) -> Result<Option<f64>, Refused> {
        let of_unit = self.force_unit.as_deref().and_then(|unit| Unit::Force.one(unit));
        let positive = |value| Refused::positive("sensitivity", value);
        match (self.sensitivity.map(positive).transpose()?, of_unit) {
            (Some(sensitivity), Some(_)) => Err(Refused::number(
                "sensitivity",
                sensitivity,
                "the forces have a unit of force already: leave it out",
            )),
            (one, of_unit) => Ok(one.or(of_unit).map(|one| NANO * one)),
        }
    }

    /// The loop, in nm and nN where these are known.
    fn measured(&self) -> Result<FrictionLoop, Refused> {
        let along = self.nanometres()?.unwrap_or(1.0);
        let force = self.nanonewtons()?.unwrap_or(1.0);
        let times = |values: &[f64], factor: f64| values.iter().map(|v| v * factor).collect();
        let of = |track: &ForceTrack| (times(&track.x, along), times(&track.force, force));
        let refused = |error: LoopError| Refused::whole("trace and retrace", error);
        FrictionLoop::of_tracks(of(&self.trace), of(&self.retrace)).map_err(refused)
    }

    /// A warning if trace and retrace have only a part of their positions in common.
    fn partial(&self, measured: &FrictionLoop) -> Option<String> {
        let (low, high) = ends(self.trace.x.iter().chain(&self.retrace.x).copied());
        let along = self.nanometres().ok()?.unwrap_or(1.0);
        let [x, ..] = measured.rows();
        let (first, last) = (x[0], x[x.len() - 1]);
        (last - first < WHOLE * along * (high - low)).then(|| {
            format!(
                "trace and retrace have only the positions from {} to {} in common: all numbers are those of this part; static \
                 peak, stiffness and work need both reversals",
                digits(first, 6),
                digits(last, 6)
            )
        })
    }
}

impl Ask for Friction {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.measured()?;
        Ok(self)
    }

    fn answer(&self, _: &Context) -> Result<(FrictionFound, Vec<String>), Failure> {
        let measured = self.measured()?;
        let refused = |error: LoopError| Refused::whole("trace and retrace", error);
        let found = measured.numbers().map_err(refused)?;
        let has_force = self.nanonewtons()?.is_some();
        let is_of_model = self.is_of_model();
        let length_unit =
            self.unit.as_ref().map(|_| if is_of_model { SIGMA } else { "nm" }.to_owned());
        let force_unit = if has_force { Some("nN".into()) } else { self.force_unit.clone() };
        let work_unit = match (is_of_model, &length_unit) {
            (true, _) => Some("kσ²"),
            (false, Some(_)) if has_force => Some("fJ"),
            _ => None,
        };
        let remarks = work_unit.is_none().then(|| UNKNOWN.into());
        let remarks = remarks.into_iter().chain(self.partial(&measured)).collect();
        let units = (length_unit, force_unit, work_unit.map(str::to_owned));
        Ok((FrictionFound::of(&measured, &found, units), remarks))
    }
}

/// A warning about units.
const UNKNOWN: &str = "the work is not in fJ: the unit of positions or forces is unknown; headings such as x_nm,force_nN, --unit and \
                       --force-unit give it, and --stiffness or --sensitivity the force of a deflection or a voltage";

impl FrictionFound {
    fn of(
        measured: &FrictionLoop,
        found: &LoopNumbers,
        (length_unit, force_unit, work_unit): (Option<String>, Option<String>, Option<String>),
    ) -> Self {
        let work = if work_unit.as_deref() == Some("fJ") { FEMTOJOULES } else { 1.0 };
        let [x, trace, retrace] = measured.rows().map(<[f64]>::to_vec);
        Self {
            length_unit,
            force_unit,
            work_unit,
            kinetic: found.friction.into(),
            mean: found.mean.into(),
            static_peak: found.static_peak.into(),
            peak_ratio: found.peak_ratio,
            hysteresis: found.mean.times(2.0).into(),
            work: found.work.times(work).into(),
            offset: found.offset.into(),
            reversal: found.reversal,
            stiffness: found.stiffness.into(),
            noise: found.noise,
            rows: LoopColumns { x, trace, retrace },
        }
    }

    /// The estimates, with their names and units.
    pub fn estimates(&self) -> [(&'static str, &EstimateDocument, String); 7] {
        let force = self.force_unit.clone().unwrap_or_default();
        let slope = match (self.force_unit.as_deref(), self.length_unit.as_deref()) {
            (Some("nN"), Some(_)) => "N/m".into(),
            (Some(K_SIGMA), Some(SIGMA)) => "k".into(),
            (Some(force), Some(length)) => format!("{force}/{length}"),
            _ => String::new(),
        };
        [
            ("kinetic friction", &self.kinetic, force.clone()),
            ("mean friction", &self.mean, force.clone()),
            ("static peak", &self.static_peak, force.clone()),
            ("hysteresis", &self.hysteresis, force.clone()),
            ("work", &self.work, self.work_unit.clone().unwrap_or_default()),
            ("offset", &self.offset, force),
            ("stiffness", &self.stiffness, slope),
        ]
    }
}

impl Tabular for FrictionFound {
    /// The loop.
    fn columns(&self) -> Vec<Named<'_>> {
        let LoopColumns { x, trace, retrace } = &self.rows;
        columns!(x, trace, retrace)
    }
}
