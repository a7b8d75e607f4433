//! The points of a sweep: footprints times r times α times further axes, the last varying fastest.

use super::started;
use crate::{AxisName, Failure, Points, SweepParameters, SweepPoint, SweepRunParameters};
use stickslip_stability::critical;
use stickslip_tip::{Model, Wider};

impl SweepParameters {
    /// A point without its motion, its model, and the parameters of its run, if the points are runs.
    pub(super) fn placed(
        &self,
        index: usize,
    ) -> (SweepPoint, Result<Model, String>, Option<SweepRunParameters>) {
        let Self { r, alpha, alpha_above, beta, width, tips, .. } = self;
        let outer = index / self.inner();
        let rates = alpha.as_ref().or(alpha_above.as_ref());
        let columns = rates.map_or(1, Vec::len);
        let (row, column) = (outer / columns, outer % columns);
        let (r, which) = (r[row % r.len()], row / r.len());
        let betas = beta.as_ref().map_or(1, Vec::len);
        let at = self.at(index);
        let (law, run) = self.with(&at);
        let placed = |alpha| SweepPoint {
            width: width.as_ref().map(|width| width[which / betas]),
            at,
            ..SweepPoint::at(index, beta.as_ref().map(|beta| beta[which % betas]), r, alpha)
        };
        let tip = &tips[which].0;
        let critical = critical(&law, tip, r);
        let above = |above: f64| critical.as_ref().map(|critical| critical.alpha + above);
        let found = match (alpha, alpha_above) {
            (_, Some(all)) => above(all[column]).map_err(ToString::to_string),
            (alpha, None) => Ok(alpha.as_ref().map_or(0.0, |alpha| alpha[column])),
        };
        let point = SweepPoint {
            critical_alpha: critical.as_ref().ok().map(|critical| critical.alpha),
            ..placed(found.as_ref().ok().copied())
        };
        let model = found.and_then(|alpha| {
            Model::under(law, tip.clone(), alpha, r).map_err(|error| error.to_string())
        });
        (point, model, run)
    }

    /// Law and initial condition with these values on the further axes.
    fn with(&self, values: &[f64]) -> (Wider, Option<SweepRunParameters>) {
        let (mut law, mut run) = (self.wider(), self.run.clone());
        for (axis, value) in self.axes.iter().zip(values) {
            match (axis.name, &mut run) {
                (AxisName::DepthLimit, _) => law.depth_limit = Some(*value),
                (AxisName::HealingTime, _) => law.healing_time = Some(*value),
                (AxisName::Inertia, _) => law.inertia = Some(*value),
                (AxisName::StartPosition, Some(run)) => run.start_position = *value,
                (AxisName::Kick, Some(run)) => run.kick = *value,
                (AxisName::StartVelocity, Some(run)) => run.start_velocity = Some(*value),
                (AxisName::Noise, Some(run)) => run.noise = Some(*value),
                (AxisName::NoiseSpacing, Some(run)) => run.noise_spacing = Some(*value),
                (AxisName::Seed, Some(run)) => run.seed = Some(*value),
                (_, None) => {}
            }
        }
        (law, run)
    }

    /// Rejects invalid runs. If any is invalid, so is the first or the last: only these are checked.
    pub(super) fn judge_runs(&self) -> Result<(), Failure> {
        if self.alpha.is_none() || self.run.is_none() {
            return Ok(());
        }
        for index in [0, self.points().saturating_sub(1)] {
            if let (_, Ok(model), Some(run)) = self.placed(index) {
                started::scenario(model, &run, self.tolerance)?;
            }
        }
        Ok(())
    }
}
