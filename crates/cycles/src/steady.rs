//! Linear stability of steady motion, and its limit.

use stickslip_stability::{Critical, StabilityError, critical, unstable_count};
use stickslip_tip::{Model, TipFunction};

/// Linear stability at the parameters of a model.
pub(super) struct SteadyMotion {
    /// αc(r); `None` if it does not exist or cannot be found.
    pub(super) critical: Option<Critical>,
    /// Whether small deviations from steady motion decay.
    pub(super) is_stable: bool,
}

impl SteadyMotion {
    /// # Errors
    /// r out of range; in the extended model, roots that cannot be counted.
    pub(super) fn of(model: &Model) -> Result<Self, StabilityError> {
        let (wider, tip, r) = (model.wider(), model.tip(), model.r());
        let critical = match critical(wider, tip, r) {
            Ok(found) => Some(found),
            Err(StabilityError::NoCrossing { .. } | StabilityError::Unsettled { .. }) => None,
            Err(error) => return Err(error),
        };
        // Under the basic law α alone tells: no roots need be counted.
        if wider.is_papers() && *tip != TipFunction::Cosine {
            let is_stable = critical.is_none_or(|at| model.alpha() <= at.alpha);
            return Ok(Self { critical, is_stable });
        }
        let is_stable = match unstable_count(model) {
            Ok(count) => count == 0,
            // On the corner of |h| there are no roots to count: small deviations grow from αc on.
            Err(StabilityError::Corner) => critical.is_some_and(|at| model.alpha() <= at.alpha),
            Err(error) => return Err(error),
        };
        Ok(Self { critical, is_stable })
    }
}
