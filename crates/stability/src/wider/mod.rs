//! Linear theory under the wider law: a depth limit (61), healing, inertia, and walking without a spring.

mod bounds;
mod characteristic;
mod corner;
mod law;
mod limits;
mod onset;
mod transforms;
mod walking;

pub(super) use characteristic::WiderCharacteristic;
pub use limits::{least_depth_limit, memory_length};
pub use onset::{OnsetKind, WiderCritical, boundary_under, critical_under};
pub(super) use transforms::{Jet, PlainTransforms};
pub use walking::{Walk, walk, walking_alpha, walking_speeds};

use super::StabilityError;
use law::Law;
use stickslip_tip::{Model, TipFunction};

/// Whether it is this that a model needs: anything but the paper's law, and cos x, which no paper's law was made for.
pub(super) fn applies(model: &Model) -> bool {
    !model.wider().is_papers() || *model.tip() == TipFunction::Cosine
}

/// That of small deviations from steady motion behind the support.
pub(super) fn characteristic(model: &Model) -> Result<WiderCharacteristic, StabilityError> {
    if !model.wider().spring {
        return Err(StabilityError::NoSupport);
    }
    let law = Law::of(model);
    if Law::has_corner(model.wider(), model.tip(), &law.steady) {
        return Err(StabilityError::Corner);
    }
    Ok(WiderCharacteristic::new(law))
}
