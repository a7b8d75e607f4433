//! One point of a sweep.

use super::grid::Place;
use crate::commands::run::document::regime;
use crate::documents::{MethodName, RegimeName, SweepPoint};
use stickslip_tip::cycle::{Motion, motion};

/// What the motion comes to there. Depends on the point alone, so that a sweep may be done in any order.
pub(super) fn of(place: &Place, tolerance: f64) -> SweepPoint {
    let alpha = place.model.as_ref().map(stickslip_tip::Model::alpha);
    let mut point = SweepPoint {
        beta: place.beta,
        r: place.r,
        alpha,
        regime: None,
        method: None,
        period: None,
        amplitude_x0: None,
        amplitude_u: None,
        slips: None,
        multiplier: None,
        remark: None,
    };
    let Some(model) = &place.model else {
        point.remark = Some("no critical alpha to count from, or alpha below 0".into());
        return point;
    };
    match motion(model, tolerance) {
        Ok(Motion::Steady) => {
            (point.regime, point.method) = (Some(RegimeName::Steady), Some(MethodName::Stability));
        }
        Ok(Motion::Cycle(cycle)) => {
            (point.regime, point.method) = (Some(RegimeName::StickSlip), Some(MethodName::Cycle));
            point.period = Some(cycle.period());
            point.amplitude_x0 = Some(cycle.amplitude_x0());
            point.amplitude_u = Some(cycle.amplitude_u());
            point.slips = Some(cycle.slips());
            point.multiplier =
                Some(cycle.nontrivial_multipliers().next().map_or(0.0, |m| m.norm()));
        }
        Ok(Motion::Run(outcome)) => {
            (point.regime, point.method) = (Some(regime(outcome.regime)), Some(MethodName::Run));
            if let Some(oscillation) = outcome.oscillation {
                point.period = Some(oscillation.period);
                point.amplitude_x0 = Some(oscillation.amplitude_x0);
                point.slips = Some(oscillation.slips);
            }
        }
        Err(error) => point.remark = Some(error.to_string()),
    }
    point
}
