//! The motion at one point. It depends on this point alone: points may be computed in any order.

use super::grid::{Alpha, Place};
use super::started;
use stickslip::SweepPoint;
use stickslip_outcome::motion;
use stickslip_stability::critical;
use stickslip_tip::Model;

pub(super) fn point(index: usize, place: Place, tolerance: f64) -> SweepPoint {
    let critical = critical(&place.wider, place.tip, place.r);
    let alpha = match (place.alpha, &critical) {
        (Alpha::Given(alpha), _) => Some(alpha),
        (Alpha::Above(above), Ok(critical)) => Some(critical.alpha + above),
        (Alpha::Above(_), Err(_)) => None,
    };
    let point = SweepPoint {
        critical_alpha: critical.as_ref().ok().map(|critical| critical.alpha),
        ..place.empty(index, alpha)
    };
    let Some(alpha) = alpha else {
        return SweepPoint { error: critical.err().map(|error| error.to_string()), ..point };
    };
    let model = Model::under(place.wider, place.tip.clone(), alpha, place.r);
    let model = model.map_err(|error| error.to_string());
    let found = model.and_then(|model| come_to(point.clone(), model, &place, tolerance));
    found.unwrap_or_else(|error| SweepPoint { error: Some(error), ..point })
}

/// The motion that the tip settles into, or the result of a run.
fn come_to(
    point: SweepPoint,
    model: Model,
    place: &Place,
    tolerance: f64,
) -> Result<SweepPoint, String> {
    let Some(run) = &place.run else {
        let motion = motion(&model, tolerance).map_err(|error| error.to_string())?;
        return Ok(point.settled(motion));
    };
    let scenario = started::scenario(model, run, tolerance);
    let scenario = scenario.map_err(|failure| failure.to_string())?;
    started::ended(point, &scenario).map_err(|error| error.to_string())
}
