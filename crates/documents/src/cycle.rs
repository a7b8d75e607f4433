//! `stickslip/cycle`.

use crate::table::{Column, Named, Tabular};
use crate::{ComplexDocument, FORMAT_VERSION, History, InUnits, ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_cycles::Cycle;
use stickslip_tip::Step;

/// Intervals of the profile in a step of the mesh, at least: the largest velocity is then seen to 0.3 %, with one
/// to 1.4 % (α from 1.2 to 2, the loosest tolerance).
const FEWEST_PARTS: usize = 2;

/// A periodic motion, l(t + T) = l(t). Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleDocument {
    /// "stickslip/cycle"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// What was asked for.
    pub parameters: CycleParameters,
    /// T, in Γ/k.
    pub period: f64,
    /// Error of `period`, in Γ/k.
    #[serde(default)]
    pub period_error: Option<f64>,
    /// rT, that of the surface left behind, in σ.
    pub wavelength: f64,
    /// Error of `wavelength`, in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Half peak-to-peak of l, that is of x0 less its steady advance, in σ.
    pub amplitude_x0: f64,
    /// Error of `amplitude_x0`, in σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a; 0 where it heals.
    pub amplitude_u: f64,
    /// Error of `amplitude_u`, in kσ²/a.
    #[serde(default)]
    pub amplitude_u_error: Option<f64>,
    /// Maxima of l in one period.
    pub slips: usize,
    /// One period from where l is largest, sampled at uneven times: densely where the motion is fast.
    pub profile: CycleProfile,
    /// Floquet multipliers by falling modulus, down to 1e-6 (0.01 for footprints with much detail), the one above the
    /// real axis first of each pair: a small deviation is multiplied by them in each period. One is 1, that of a shift
    /// in time. In error by up to 5e-8 above 0.01, by up to 1e-6 below.
    pub floquet: Vec<ComplexDocument>,
    /// How far the multiplier that should be 1 is from it.
    pub floquet_error: f64,
    /// Whether every small deviation but a shift in time dies out.
    pub stable: bool,
    /// Estimate of the largest residual of (18) at any time, in kσ/Γ.
    pub residual: f64,
    /// One period, as it was solved for.
    pub history: History,
    /// What it took.
    pub work: CycleWork,
    /// Numbers of it in nm, s and nN, where it was asked for these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl CycleDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/cycle";

    /// A cycle with about `points` intervals of its profile, and what it took to find it.
    pub fn of(cycle: &Cycle, parameters: CycleParameters, points: usize, seconds: f64) -> Self {
        let multipliers = cycle.multipliers();
        let distances = multipliers.iter().map(|m| (m - 1.0).norm());
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            physical: None,
            parameters,
            period: cycle.period(),
            period_error: Some(cycle.error()),
            wavelength: cycle.wavelength(),
            wavelength_error: Some(cycle.model().r() * cycle.error()),
            amplitude_x0: cycle.amplitude_x0(),
            amplitude_x0_error: Some(cycle.error()),
            amplitude_u: cycle.amplitude_u(),
            amplitude_u_error: Some(cycle.amplitude_u_error()),
            slips: cycle.slips(),
            profile: CycleProfile::of(cycle, points),
            floquet: multipliers.iter().map(|m| ComplexDocument { re: m.re, im: m.im }).collect(),
            floquet_error: distances.fold(1.0, f64::min),
            stable: cycle.is_stable(),
            residual: cycle.residual(),
            history: cycle.motion().into(),
            work: CycleWork {
                steps: cycle.steps(),
                newton_iterations: cycle.iterations(),
                seconds,
            },
        }
    }
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct CycleParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Largest residual of (18) asked for, in kσ/Γ.
    pub tolerance: f64,
}

/// Columns of equal length, at times that are uneven: each step of the cycle's mesh, short where the motion is fast,
/// is divided evenly. The largest velocity is seen to a per cent.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleProfile {
    /// From 0, where l is largest, to T, in Γ/k; ascending, at uneven distances.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ.
    pub l: Vec<f64>,
    /// x0', in kσ/Γ.
    pub velocity: Vec<f64>,
    /// The height of the surface under the tip, in kσ²/a, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<f64>>,
}

impl CycleProfile {
    /// About `points` intervals. The steps are short where the motion is fast: times even over the period would pass
    /// over its slips.
    pub fn of(cycle: &Cycle, points: usize) -> Self {
        let motion = cycle.motion();
        let steps = motion.steps();
        let parts = points.div_ceil(steps.len()).max(FEWEST_PARTS);
        let within = |step: &Step| {
            let (t, part) = (step.t, step.h / parts as f64);
            (0..parts).map(move |i| t + part * i as f64)
        };
        let t: Vec<f64> = steps.iter().flat_map(within).chain([cycle.period()]).collect();
        Self {
            l: t.iter().map(|t| motion.l(*t)).collect(),
            velocity: t.iter().map(|t| motion.velocity(*t)).collect(),
            height: t.iter().map(|t| motion.height(*t)).collect(),
            t,
        }
    }
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleWork {
    /// Steps of the mesh over one period.
    pub steps: usize,
    /// Newton iterations, on all meshes.
    pub newton_iterations: usize,
    /// Time that it took, in seconds: the one field that differs from run to run.
    pub seconds: f64,
}

impl Tabular for CycleDocument {
    /// The profile.
    fn columns(&self) -> Vec<Named<'_>> {
        let CycleProfile { t, l, velocity, height } = &self.profile;
        let height = height.iter().map(|height| ("height", Column::of(height)));
        let columns =
            [("t", Column::of(t)), ("l", Column::of(l)), ("velocity", Column::of(velocity))];
        columns.into_iter().chain(height).collect()
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
