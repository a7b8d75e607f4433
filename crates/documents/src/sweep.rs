//! The document of `stickslip sweep`.

mod axis;
mod ensemble;
mod shard;
mod start;

pub use axis::{AxisDocument, AxisName};
pub use ensemble::{EnsembleDocument, RegimeCounts, StatisticsDocument};
pub use shard::ShardDocument;
pub use start::{SweepRunParameters, SweepStartName};

use crate::table::{Column, Named, Tabular};
use crate::{InUnits, RegimeName, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_cycles::Cycle;
use stickslip_outcome::{Motion, Outcome};
use stickslip_tip::Wider;

/// What the tip settles into, over a grid of parameters.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepDocument {
    /// "stickslip/sweep"
    pub format: String,
    /// Version of the format.
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// The grid.
    pub parameters: SweepParameters,
    /// The points, by rising index.
    pub points: Vec<SweepPoint>,
    /// Points that differ in the seed of their noise alone, taken together, in the order of the points; where seeds vary and
    /// all parts are here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ensembles: Option<Vec<EnsembleDocument>>,
    /// How the machine that computed the points rounds, such as "x86_64+sse4.1+avx+fma-1c291ca3": one that rounds otherwise
    /// gives other last digits. Null where parts came from machines that do not agree.
    #[serde(default)]
    pub arithmetic: Option<String>,
    /// CRC-32 (IEEE) of the JSON `[parameters,points,arithmetic]`, without spaces and with the shortest digits: tells `merge`
    /// whether anything was changed.
    #[serde(default)]
    pub crc32: Option<u32>,
    /// Numbers of it in nm, s and nN, where it was asked for these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl SweepDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/sweep";
}

/// The grid: footprints times r times α times further axes, the last varying fastest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepParameters {
    /// Footprints f: widths times β, where they vary.
    pub tips: Vec<TipDocument>,
    /// Widths of the footprints, where several were given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<Vec<f64>>,
    /// Side lobes of the footprints, where they were given.
    pub beta: Option<Vec<f64>>,
    /// Dimensionless support velocities r (12).
    pub r: Vec<f64>,
    /// Dimensionless indentation rates α (13), where they were given as such.
    pub alpha: Option<Vec<f64>>,
    /// D, where they were given as αc(r) + D.
    pub alpha_above: Option<Vec<f64>>,
    /// Largest residual of (18) on a cycle, kσ/Γ.
    pub tolerance: f64,
    /// Part of the points that is here, all without.
    pub shard: Option<ShardDocument>,
    /// b of (61), in kσ²/a, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_limit: Option<f64>,
    /// T, in Γ/k, where the surface heals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub healing_time: Option<f64>,
    /// M, in Γ²/k, where the tip has inertia.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// What else varies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub axes: Vec<AxisDocument>,
    /// The run that each point is, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<SweepRunParameters>,
}

/// How a point was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SourceName {
    /// Steady motion is stable, or as good as: α is below αc.
    Stability,
    /// The stable periodic solution of (18).
    Cycle,
    /// The end of a run, from a disturbed steady state unless the sweep says otherwise.
    Run,
}

impl std::fmt::Display for SourceName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Stability => "stability",
            Self::Cycle => "cycle",
            Self::Run => "run",
        })
    }
}

/// One point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepPoint {
    /// Its place in the grid.
    pub index: usize,
    /// Width of the footprint, in σ, where it varies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Side lobes, where they were given.
    pub beta: Option<f64>,
    /// r, dimensionless.
    pub r: f64,
    /// α, dimensionless; null where αc(r) + D could not be found.
    pub alpha: Option<f64>,
    /// Values of the further axes, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// αc(r), if there is one.
    pub critical_alpha: Option<f64>,
    /// What the tip settles into; "transient" where a run of thousands of time units did not settle. Null
    /// where `error` says why.
    pub regime: Option<RegimeName>,
    /// How that was found.
    pub source: Option<SourceName>,
    /// Period of l(t), Γ/k.
    pub period: Option<f64>,
    /// Error of `period`, Γ/k.
    #[serde(default)]
    pub period_error: Option<f64>,
    /// Wavelength of the surface left behind, σ.
    pub wavelength: Option<f64>,
    /// Error of `wavelength`, σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Half peak-to-peak of l, σ.
    pub amplitude_x0: Option<f64>,
    /// Error of `amplitude_x0`, σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Half peak-to-peak of the surface left behind, kσ²/a; of cycles, and of runs that were asked for.
    pub amplitude_u: Option<f64>,
    /// Error of `amplitude_u`, kσ²/a.
    #[serde(default)]
    pub amplitude_u_error: Option<f64>,
    /// Mean of l at 2,001 times evenly from the middle of the run to its end, σ; of runs that were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_l: Option<f64>,
    /// Standard deviation of l at these times, σ: how far the tip swings, be it in stick-slip or on noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deviation_l: Option<f64>,
    /// Maxima of l in one period.
    pub slips: Option<usize>,
    /// Largest modulus of the Floquet multipliers but that of a shift in time, in error by up to 5e-8 above 0.01, by
    /// up to 1e-6 below; of cycles only.
    pub multiplier: Option<f64>,
    /// Why nothing was found.
    pub error: Option<String>,
}

impl SweepParameters {
    /// What a wider law adds.
    #[must_use]
    pub fn wider(&self) -> Wider {
        let Self { depth_limit, healing_time, inertia, .. } = *self;
        Wider { depth_limit, healing_time, inertia, spring: true }
    }

    /// The one r of all points, if there is one.
    pub fn velocity(&self) -> Option<f64> {
        if let [r] = self.r.as_slice() { Some(*r) } else { None }
    }

    /// The part that is here, be it the whole.
    pub fn part(&self) -> ShardDocument {
        self.shard.unwrap_or(ShardDocument::WHOLE)
    }

    /// Whether the point of this index is one of this part.
    pub fn has(&self, index: usize) -> bool {
        index < self.points() && self.part().has(index)
    }

    /// Points of the whole grid.
    pub fn points(&self) -> usize {
        let alphas = self.alpha.as_ref().or(self.alpha_above.as_ref()).map_or(0, Vec::len);
        let points = self.tips.len().saturating_mul(self.r.len()).saturating_mul(alphas);
        points.saturating_mul(self.inner())
    }

    /// Points of one footprint, r and α.
    pub fn inner(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
    }

    /// Values of the further axes at a point, by its index.
    pub fn at(&self, index: usize) -> Vec<f64> {
        let mut rest = index;
        let last_first = self.axes.iter().rev().map(|axis| {
            let count = axis.values.len().max(1);
            let at = rest % count;
            rest /= count;
            axis.values.get(at).copied().unwrap_or(f64::NAN)
        });
        let mut values: Vec<f64> = last_first.collect();
        values.reverse();
        values
    }
}

impl SweepPoint {
    /// A point of which nothing is known yet but where it is: its index, β, r and α.
    pub fn at(index: usize, beta: Option<f64>, r: f64, alpha: Option<f64>) -> Self {
        Self {
            index,
            width: None,
            beta,
            r,
            alpha,
            at: vec![],
            critical_alpha: None,
            regime: None,
            source: None,
            period: None,
            period_error: None,
            wavelength: None,
            wavelength_error: None,
            amplitude_x0: None,
            amplitude_x0_error: None,
            amplitude_u: None,
            amplitude_u_error: None,
            mean_l: None,
            deviation_l: None,
            slips: None,
            multiplier: None,
            error: None,
        }
    }

    /// With what the tip settles into there.
    #[must_use]
    pub fn settled(mut self, motion: Motion) -> Self {
        match motion {
            Motion::Steady => {
                self.regime = Some(RegimeName::Steady);
                self.source = Some(SourceName::Stability);
            }
            Motion::Cycle(cycle) => self.is_periodic(&cycle),
            Motion::Run(outcome) => self.ended(&outcome),
        }
        self
    }

    fn is_periodic(&mut self, cycle: &Cycle) {
        (self.regime, self.source) = (Some(RegimeName::StickSlip), Some(SourceName::Cycle));
        (self.period, self.wavelength) = (Some(cycle.period()), Some(cycle.wavelength()));
        self.amplitude_x0 = Some(cycle.amplitude_x0());
        self.amplitude_u = Some(cycle.amplitude_u());
        let error = cycle.error();
        (self.period_error, self.wavelength_error) = (Some(error), Some(self.r * error));
        self.amplitude_x0_error = Some(error);
        self.amplitude_u_error = Some(cycle.amplitude_u_error());
        self.slips = Some(cycle.slips());
        let moduli = cycle.nontrivial_multipliers().map(|m| m.norm());
        self.multiplier = moduli.max_by(f64::total_cmp);
    }

    fn ended(&mut self, outcome: &Outcome) {
        (self.regime, self.source) = (Some(outcome.regime.into()), Some(SourceName::Run));
        if let Some(motion) = &outcome.oscillation {
            (self.period, self.wavelength) = (Some(motion.period), Some(motion.wavelength));
            self.period_error = Some(motion.period_error);
            self.wavelength_error = Some(motion.wavelength_error);
            self.amplitude_x0 = Some(motion.amplitude_x0);
            self.amplitude_x0_error = Some(motion.amplitude_x0_error);
            self.slips = Some(motion.slips);
        }
    }
}

impl Tabular for SweepDocument {
    /// A row for each point. The regime in an array: 0 steady, 1 stick-slip, 2 trapped, 3 transient.
    fn columns(&self) -> Vec<Named<'_>> {
        let number = |of: fn(&SweepPoint) -> Option<f64>| -> Column {
            self.points.iter().map(of).collect::<Vec<_>>().into()
        };
        let words = |of: fn(&SweepPoint) -> Option<String>| -> Vec<String> {
            self.points.iter().map(|point| of(point).unwrap_or_default()).collect()
        };
        let regimes = self.points.iter().map(|p| p.regime.map_or(f64::NAN, |r| f64::from(r as u8)));
        let regimes = Column::Words(
            words(|p| p.regime.map(|regime| regime.to_string())),
            Some(regimes.collect()),
        );
        let widths = self.parameters.width.as_ref().map(|_| ("width", number(|p| p.width)));
        let place = vec![
            ("beta", number(|p| p.beta)),
            ("r", number(|p| Some(p.r))),
            ("alpha", number(|p| p.alpha)),
        ];
        let axis = |(i, axis): (usize, &AxisDocument)| {
            let values = self.points.iter().map(|point| point.at.get(i).copied());
            (axis.name.column(), values.collect::<Vec<_>>().into())
        };
        let axes = self.parameters.axes.iter().enumerate().map(axis);
        let found = vec![
            ("critical_alpha", number(|p| p.critical_alpha)),
            ("period", number(|p| p.period)),
            ("wavelength", number(|p| p.wavelength)),
            ("amplitude_x0", number(|p| p.amplitude_x0)),
            ("amplitude_u", number(|p| p.amplitude_u)),
            ("slips", number(|p| p.slips.map(|slips| slips as f64))),
            ("multiplier", number(|p| p.multiplier)),
            ("regime", regimes),
            ("source", Column::Words(words(|p| p.source.map(|source| source.to_string())), None)),
        ];
        let of_runs = self.parameters.run.iter().flat_map(|_| {
            [("mean_l", number(|p| p.mean_l)), ("deviation_l", number(|p| p.deviation_l))]
        });
        widths.into_iter().chain(place).chain(axes).chain(found).chain(of_runs).collect()
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
