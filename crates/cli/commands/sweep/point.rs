//! What the tip settles into at one point. Depends on the point alone: a sweep may be done in any order.

use super::grid::{Alpha, Place};
use stickslip_documents::SweepPoint;
use stickslip_outcome::motion;
use stickslip_stability::critical;
use stickslip_tip::Model;

pub(super) fn point(index: usize, place: Place, tolerance: f64) -> SweepPoint {
    let critical = critical(place.tip, place.r);
    let alpha = match (place.alpha, &critical) {
        (Alpha::Given(alpha), _) => Some(alpha),
        (Alpha::Above(above), Ok(critical)) => Some(critical.alpha + above),
        (Alpha::Above(_), Err(_)) => None,
    };
    let point = SweepPoint {
        critical_alpha: critical.as_ref().ok().map(|critical| critical.alpha),
        ..SweepPoint::at(index, place.beta, place.r, alpha)
    };
    let Some(alpha) = alpha else {
        return SweepPoint { error: critical.err().map(|error| error.to_string()), ..point };
    };
    let model = Model::new(place.tip.clone(), alpha, place.r).map_err(|error| error.to_string());
    match model.and_then(|model| motion(&model, tolerance).map_err(|error| error.to_string())) {
        Ok(motion) => point.settled(motion),
        Err(error) => SweepPoint { error: Some(error), ..point },
    }
}
