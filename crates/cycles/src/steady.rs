//! Whether steady motion is stable, and where it ceases to be.

use stickslip_stability::{Critical, StabilityError, critical, critical_under, unstable_count};
use stickslip_tip::{Model, TipFunction};

/// Of a model.
pub(super) struct SteadyMotion {
    /// αc(r); `None` where there is none, or it cannot be found.
    pub(super) critical: Option<Critical>,
    /// Whether small deviations from steady motion die out.
    pub(super) is_stable: bool,
}

impl SteadyMotion {
    /// # Errors
    /// r out of range; under a wider law, roots that cannot be counted.
    pub(super) fn of(model: &Model) -> Result<Self, StabilityError> {
        let (wider, tip, r) = (model.wider(), model.tip(), model.r());
        if wider.is_papers() && *tip != TipFunction::Cosine {
            return match critical(tip, r) {
                Ok(at) => Ok(Self { critical: Some(at), is_stable: model.alpha() <= at.alpha }),
                Err(StabilityError::NoCrossing { .. }) => {
                    Ok(Self { critical: None, is_stable: true })
                }
                Err(error) => Err(error),
            };
        }
        let critical = match critical_under(wider, tip, r) {
            Ok(found) => Some(found.critical),
            Err(StabilityError::NoCrossing { .. } | StabilityError::Unsettled { .. }) => None,
            Err(error) => return Err(error),
        };
        let is_stable = match unstable_count(model) {
            Ok(count) => count == 0,
            // On the corner of |h| there are no roots to count: small deviations grow from αc on.
            Err(StabilityError::Corner) => critical.is_some_and(|at| model.alpha() <= at.alpha),
            Err(error) => return Err(error),
        };
        Ok(Self { critical, is_stable })
    }
}
