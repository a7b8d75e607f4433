//! The question `sweep`: the motion that the tip settles into, or the end of a run, over a grid of parameters.

mod grid;
mod started;

use super::points::{Points, all_points};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, AxisDocument, AxisName, Context, EnsembleDocument, Failure, Law, Refused, ShardDocument,
    StartName, SweepFound, SweepParameters, SweepPoint, SweepRunParameters, Tip,
};
use serde::{Deserialize, Serialize};
use stickslip_cycles::TOLERANCES;
use stickslip_outcome::motion;
use stickslip_tip::{Scenario, Wider};

/// Largest number of points; the document of more would take gigabytes.
const MOST_POINTS: usize = 10_000_000;
/// Largest number of footprints; each is prepared separately.
const MOST_TIPS: usize = 10_000;
/// Largest number of runs that share SIMD lanes in turn: at the end of a group some lanes are empty.
const MOST_RUNS_TOGETHER: usize = 128;
/// Largest integer seed that f64 represents exactly.
const LARGEST_SEED: f64 = 9_007_199_254_740_992.0;
/// Default start position of a run, in σ.
const START_POSITION: f64 = 14.0;

/// A grid of parameters, each with one value or several. [`Sweep::grid`] makes the question, with its axes in order.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// Footprints f: each width with each β, if they vary.
    pub tips: Vec<Tip>,
    /// Widths of the footprints, in σ, if they vary.
    #[serde(default)]
    pub width: Option<Vec<f64>>,
    /// Side-lobe weights β of the footprints, if given.
    #[serde(default)]
    pub beta: Option<Vec<f64>>,
    /// Dimensionless support velocities r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("RANGE", "Model", 2)))]
    #[serde(default)]
    pub r: Vec<f64>,
    /// Dimensionless indentation rates α = Γ N a/(σ² k²), (13); 0 or above.
    #[schemars(extend("x-option" = option("RANGE", "Model", 3)))]
    #[serde(default)]
    pub alpha: Option<Vec<f64>>,
    /// Indentation rates as αc(r) + D.
    #[schemars(extend("x-option" = option("RANGE", "Model", 4)))]
    #[serde(default)]
    pub alpha_above: Option<Vec<f64>>,
    /// Depth limit b of (61), in kσ²/a; above 0.
    #[schemars(extend("x-option" = option("RANGE", "Extended model", 10)))]
    #[serde(default)]
    pub depth_limit: Vec<f64>,
    /// Healing time T of the surface, in Γ/k; above 0.
    #[schemars(extend("x-option" = option("RANGE", "Extended model", 11)))]
    #[serde(default)]
    pub healing_time: Vec<f64>,
    /// Inertia M of the tip, in Γ²/k; above 0.
    #[schemars(extend("x-option" = option("RANGE", "Extended model", 12)))]
    #[serde(default)]
    pub inertia: Vec<f64>,
    /// Not available in a sweep: without a spring nothing drags the tip.
    #[schemars(extend("x-option" = option("", "Extended model", 13)))]
    #[serde(default)]
    pub no_spring: bool,
    /// Compute at each point a run to this time, in Γ/k, as "stickslip run" does, instead of the motion that the tip
    /// settles into.
    #[schemars(extend("x-option" = option("T", "Runs", 40)))]
    #[serde(default)]
    pub until: Option<f64>,
    /// Initial condition of the runs; steady by default.
    #[schemars(extend("x-option" = option("START", "Runs", 41)))]
    #[serde(default)]
    pub start: Option<StartName>,
    /// Initial position X of the tip, in σ; 14 by default.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 42)))]
    #[serde(default)]
    pub start_position: Vec<f64>,
    /// Displacement D: the tip starts at X - D, in σ; 0 by default.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 43)))]
    #[serde(default)]
    pub kick: Vec<f64>,
    /// Initial velocity of a tip with inertia, in kσ/Γ; r with a steady start, else 0, by default.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 44)))]
    #[serde(default)]
    pub start_velocity: Vec<f64>,
    /// Noise on the initial surface, in kσ²/a: heights uniform in [-A, A] on a grid, interpolated by a cubic spline;
    /// by default none, or 1e-4 with the start of the paper.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 45)))]
    #[serde(default)]
    pub noise: Vec<f64>,
    /// Spacing of the noise grid, in σ; 0.1 by default.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 46)))]
    #[serde(default)]
    pub noise_spacing: Vec<f64>,
    /// Seeds of the noise, whole numbers: 1:100:100 makes an ensemble of a hundred; 1 by default.
    #[schemars(extend("x-option" = option("RANGE", "Runs", 47)))]
    #[serde(default)]
    pub seed: Vec<f64>,
    /// Largest residual of the equation of motion (18) on a cycle, in kσ/Γ, or target for the error of a run, in σ;
    /// from 1e-11 to 1e-4.
    #[schemars(extend("x-option" = option("E", "Accuracy", 50)))]
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Part of the points to compute; by default all.
    #[serde(default)]
    pub shard: Option<ShardDocument>,
}

fn default_tolerance() -> f64 {
    1e-9
}

/// Parameters that vary, in the order of the grid; a parameter with a single value is a constant.
#[derive(Default)]
struct Axes(Vec<AxisDocument>);

impl Axes {
    fn number(&mut self, name: AxisName, values: &[f64]) -> Option<f64> {
        if let [_, _, ..] = values {
            self.0.push(AxisDocument { name, values: values.to_vec() });
            return None;
        }
        values.first().copied()
    }
}

impl Sweep {
    /// The law with the value that `one` returns for each parameter.
    fn law(&self, mut one: impl FnMut(AxisName, &[f64]) -> Option<f64>) -> Law {
        let mut law = Law { no_spring: self.no_spring, ..Law::default() };
        law.depth_limit = one(AxisName::DepthLimit, &self.depth_limit);
        law.healing_time = one(AxisName::HealingTime, &self.healing_time);
        law.inertia = one(AxisName::Inertia, &self.inertia);
        law
    }

    /// The grid of these parameters, the seeds varying fastest.
    ///
    /// # Errors
    /// A parameter is missing or invalid, or there are too many points.
    pub fn grid(self) -> Result<SweepParameters, Failure> {
        self.judge()?;
        let mut axes = Axes::default();
        let law = self.law(|name, values| axes.number(name, values));
        let run = self.run(&mut axes);
        let several = |values: &Vec<f64>| values.len() > 1;
        let grid = SweepParameters {
            tips: self.tips,
            width: self.width.filter(several),
            beta: self.beta,
            r: self.r,
            alpha: self.alpha,
            alpha_above: self.alpha_above,
            tolerance: self.tolerance,
            shard: self.shard,
            law,
            axes: axes.0,
            run,
        };
        grid.judge_runs()?;
        Ok(grid)
    }

    fn run(&self, axes: &mut Axes) -> Option<SweepRunParameters> {
        let until = self.until?;
        let start_position = axes.number(AxisName::StartPosition, &self.start_position);
        let kick = axes.number(AxisName::Kick, &self.kick);
        Some(SweepRunParameters {
            until,
            start: self.start.unwrap_or(StartName::Steady),
            start_position: start_position.unwrap_or(START_POSITION),
            kick: kick.unwrap_or(0.0),
            start_velocity: axes.number(AxisName::StartVelocity, &self.start_velocity),
            noise: axes.number(AxisName::Noise, &self.noise),
            noise_spacing: axes.number(AxisName::NoiseSpacing, &self.noise_spacing),
            seed: axes.number(AxisName::Seed, &self.seed),
        })
    }

    fn judge(&self) -> Result<(), Failure> {
        self.judge_counts()?;
        self.judge_rates()?;
        if !(TOLERANCES.0..=TOLERANCES.1).contains(&self.tolerance) {
            let why = format!("must be {:e} to {:e}", TOLERANCES.0, TOLERANCES.1);
            return Err(Refused::number("tolerance", self.tolerance, why).into());
        }
        // At the lowest end of each range: if it is valid, all points are.
        let law = self.law(|_, values| lowest(values));
        for tip in &self.tips {
            law.dragged(&tip.0)?;
        }
        Wider::from(law).validate().map_err(Refused::from)?;
        self.judge_initial_conditions()
    }

    /// Rejects more points than can be kept, before they are computed.
    fn judge_counts(&self) -> Result<(), Refused> {
        if self.tips.is_empty() || self.tips.len() > MOST_TIPS {
            let why = format!("{} footprints; 1 to {MOST_TIPS} are accepted", self.tips.len());
            return Err(Refused::whole("tips", why));
        }
        let rates = self.alpha.as_ref().or(self.alpha_above.as_ref());
        let lists = self.lists().map(|(_, values)| values.len().max(1));
        let counts = lists.into_iter().chain([self.tips.len(), rates.map_or(1, Vec::len)]);
        match counts.fold(1, usize::saturating_mul) {
            count if count > MOST_POINTS => {
                let why = format!(
                    "make {count} points in all; at most {MOST_POINTS} are accepted: take fewer, or one part of the \
                     range"
                );
                Err(Refused::whole("alpha and r and beta", why))
            }
            _ => Ok(()),
        }
    }

    /// All lists of values with their names, except footprints and α.
    fn lists(&self) -> [(&'static str, &[f64]); 10] {
        [
            ("r", &self.r),
            ("depth_limit", &self.depth_limit),
            ("healing_time", &self.healing_time),
            ("inertia", &self.inertia),
            ("start_position", &self.start_position),
            ("kick", &self.kick),
            ("start_velocity", &self.start_velocity),
            ("noise", &self.noise),
            ("noise_spacing", &self.noise_spacing),
            ("seed", &self.seed),
        ]
    }

    fn judge_rates(&self) -> Result<(), Refused> {
        let missing = |name: &'static str, what: &str| {
            Refused::whole(
                name,
                format!("{what} are missing: give {{{name}}} V, or {{{name}}} LO:HI:N"),
            )
        };
        if self.r.is_empty() {
            return Err(missing("r", "the support velocities"));
        }
        if let Some(bad) = self.r.iter().find(|r| **r <= 0.0) {
            return Err(Refused::number("r", *bad, "must be above 0"));
        }
        match (&self.alpha, &self.alpha_above) {
            (None, None) => Err(missing("alpha", "the indentation rates")),
            (Some(_), Some(_)) => {
                Err(Refused::whole("alpha and alpha_above", "give one of them, not both"))
            }
            (Some(alpha), None) => match lowest(alpha) {
                Some(low) if low < 0.0 => Err(Refused::number("alpha", low, "must be 0 or above")),
                _ => Ok(()),
            },
            _ => Ok(()),
        }
    }

    /// Rejects initial conditions without a run, details of a noise that is absent, and seeds that are no whole
    /// numbers.
    fn judge_initial_conditions(&self) -> Result<(), Failure> {
        let given = self.lists().into_iter().skip(4).find(|(_, values)| !values.is_empty());
        let start = self.start.map(|_| "start");
        if let (None, Some(name)) = (self.until, given.map(|(name, _)| name).or(start)) {
            let why = "belongs to runs: give {until} too";
            return Err(Refused::whole(name, why).into());
        }
        let of_noise = [("noise_spacing", &self.noise_spacing), ("seed", &self.seed)];
        let strange = of_noise.into_iter().find(|(_, values)| !values.is_empty());
        if let (true, Some((name, _))) = (self.noise.is_empty(), strange) {
            return Err(Refused::whole(name, "belongs to a noise: give {noise} too").into());
        }
        let is_seed =
            |seed: &f64| (0.0..=LARGEST_SEED).contains(seed) && seed.fract().abs() < f64::EPSILON;
        match self.seed.iter().find(|seed| !is_seed(seed)) {
            None => Ok(()),
            Some(seed) => {
                let why = "must be a whole number, 0 or above: 1:100:100 has a hundred";
                Err(Refused::number("seed", *seed, why).into())
            }
        }
    }
}

fn lowest(values: &[f64]) -> Option<f64> {
    values.iter().copied().min_by(f64::total_cmp)
}

impl Ask for SweepParameters {
    /// The value of r, if all points have the same.
    fn support_velocity(&self) -> Option<f64> {
        if let [r] = self.r.as_slice() { Some(*r) } else { None }
    }

    fn answer(&self, context: &Context) -> Result<(SweepFound, Vec<String>), Failure> {
        let points = all_points(self, context)?.into_iter().collect();
        let ensembles = EnsembleDocument::all(self, &points);
        Ok((SweepFound { points, ensembles, arithmetic: None, crc32: None }, vec![]))
    }
}

impl Points for SweepParameters {
    type Point = SweepPoint;

    fn points(&self) -> usize {
        let alphas = self.alpha.as_ref().or(self.alpha_above.as_ref()).map_or(0, Vec::len);
        let points = self.tips.len().saturating_mul(self.r.len()).saturating_mul(alphas);
        points.saturating_mul(self.inner())
    }

    fn shard(&self) -> Option<ShardDocument> {
        self.shard
    }

    fn index(point: &SweepPoint) -> usize {
        point.index
    }

    /// Runs share SIMD lanes.
    fn together(&self) -> usize {
        if self.run.is_some() { MOST_RUNS_TOGETHER } else { 1 }
    }

    fn compute(&self, indices: &[usize], take: &mut dyn FnMut(SweepPoint)) {
        let mut begun: Vec<(SweepPoint, Scenario)> = vec![];
        for index in indices {
            let (point, model, run) = self.placed(*index);
            let failed = |error: String| SweepPoint { error: Some(error), ..point.clone() };
            match (model, run) {
                (Err(error), _) => take(failed(error)),
                (Ok(model), None) => take(match motion(&model, self.tolerance) {
                    Ok(motion) => point.settled(motion),
                    Err(error) => failed(error.to_string()),
                }),
                (Ok(model), Some(run)) => match started::scenario(model, &run, self.tolerance) {
                    Ok(scenario) => begun.push((point, scenario)),
                    Err(failure) => take(failed(failure.to_string())),
                },
            }
        }
        let (points, scenarios): (Vec<_>, Vec<_>) = begun.into_iter().unzip();
        started::each(&points, &scenarios, take);
    }

    fn failed(&self, index: usize, why: &str) -> SweepPoint {
        SweepPoint { error: Some(why.into()), ..self.placed(index).0 }
    }
}
