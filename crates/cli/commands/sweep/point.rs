//! What the tip settles into at one point. Depends on the point alone: a sweep may be done in any order.

use super::grid::{Alpha, Place};
use crate::documents::{RegimeName, SourceName, SweepPoint};
use stickslip_cycles::{Cycle, Motion, motion};
use stickslip_outcome::Outcome;
use stickslip_stability::critical;
use stickslip_tip::Model;

pub(super) fn point(index: usize, place: Place, tolerance: f64) -> SweepPoint {
    let critical = critical(place.tip, place.r);
    let alpha = match (place.alpha, &critical) {
        (Alpha::Given(alpha), _) => Some(alpha),
        (Alpha::Above(above), Ok(critical)) => Some(critical.alpha + above),
        (Alpha::Above(_), Err(_)) => None,
    };
    let mut point = SweepPoint {
        index,
        beta: place.beta,
        r: place.r,
        alpha,
        critical_alpha: critical.as_ref().ok().map(|critical| critical.alpha),
        regime: None,
        source: None,
        period: None,
        wavelength: None,
        amplitude_x0: None,
        amplitude_u: None,
        slips: None,
        multiplier: None,
        error: None,
    };
    let Some(alpha) = alpha else {
        point.error = critical.err().map(|error| error.to_string());
        return point;
    };
    let model = Model::new(place.tip.clone(), alpha, place.r).map_err(|error| error.to_string());
    match model.and_then(|model| motion(&model, tolerance).map_err(|error| error.to_string())) {
        Ok(Motion::Steady) => {
            (point.regime, point.source) = (Some(RegimeName::Steady), Some(SourceName::Stability));
        }
        Ok(Motion::Cycle(cycle)) => point.is_periodic(&cycle),
        Ok(Motion::Run(outcome)) => point.ended(outcome),
        Err(error) => point.error = Some(error),
    }
    point
}

impl SweepPoint {
    fn is_periodic(&mut self, cycle: &Cycle) {
        (self.regime, self.source) = (Some(RegimeName::StickSlip), Some(SourceName::Cycle));
        (self.period, self.wavelength) = (Some(cycle.period()), Some(cycle.wavelength()));
        self.amplitude_x0 = Some(cycle.amplitude_x0());
        self.amplitude_u = Some(cycle.amplitude_u());
        self.slips = Some(cycle.slips());
        let moduli = cycle.nontrivial_multipliers().map(|m| m.norm());
        self.multiplier = moduli.max_by(f64::total_cmp);
    }

    fn ended(&mut self, outcome: Outcome) {
        (self.regime, self.source) = (Some(outcome.regime.into()), Some(SourceName::Run));
        if let Some(motion) = outcome.oscillation {
            (self.period, self.wavelength) = (Some(motion.period), Some(motion.wavelength));
            self.amplitude_x0 = Some(motion.amplitude_x0);
            self.slips = Some(motion.slips);
        }
    }
}
