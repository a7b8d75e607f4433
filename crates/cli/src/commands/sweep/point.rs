//! The motion at some points. Each depends on its own parameters alone: points may be computed in any order and company.

use super::grid::{Alpha, Grid, Place};
use super::started;
use stickslip::SweepPoint;
use stickslip_outcome::motion;
use stickslip_stability::critical;
use stickslip_tip::{Model, Scenario};

/// Computes these points, and passes each to `take` as soon as it is complete.
pub(super) fn points(indices: &[usize], grid: &Grid, take: &mut dyn FnMut(SweepPoint)) {
    let mut begun: Vec<(SweepPoint, Scenario)> = vec![];
    for index in indices {
        let place = grid.place(*index);
        let (point, model) = placed(*index, &place);
        let failed = |error: String| SweepPoint { error: Some(error), ..point.clone() };
        let tolerance = grid.parameters.tolerance;
        match (model, &place.run) {
            (Err(error), _) => take(failed(error)),
            (Ok(model), None) => take(match motion(&model, tolerance) {
                Ok(motion) => point.settled(motion),
                Err(error) => failed(error.to_string()),
            }),
            (Ok(model), Some(run)) => match started::scenario(model, run, tolerance) {
                Ok(scenario) => begun.push((point, scenario)),
                Err(failure) => take(failed(failure.to_string())),
            },
        }
    }
    let (points, scenarios): (Vec<_>, Vec<_>) = begun.into_iter().unzip();
    started::each(&points, &scenarios, take);
}

/// A point without its motion, and its model.
fn placed(index: usize, place: &Place) -> (SweepPoint, Result<Model, String>) {
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
    let model = match (alpha, critical) {
        (Some(alpha), _) => Model::under(place.wider, place.tip.clone(), alpha, place.r)
            .map_err(|error| error.to_string()),
        (None, critical) => Err(critical.err().map(|e| e.to_string()).unwrap_or_default()),
    };
    (point, model)
}
