//! What the tip settles into at one point: by stability, by its cycle, or by a run.

use super::grid::{Alpha, Place};
use crate::documents::{RegimeName, SourceName, SweepPoint};
use stickslip_tip::cycle::{Cycle, CycleError, cycle};
use stickslip_tip::stability::critical;
use stickslip_tip::{Model, Outcome, Regime, RunError, Running, Scenario};

/// What disturbs the steady state, in σ, and how long a run may take to settle, in Γ/k.
const KICK: f64 = 0.3;
const SETTLING: f64 = 3000.0;
const TOLERANCE_OF_A_RUN: f64 = 1e-6;

pub(super) fn point(index: usize, place: Place, tolerance: f64) -> SweepPoint {
    let critical = critical(place.tip, place.r);
    let alpha = match (place.alpha, &critical) {
        (Alpha::Given(alpha), _) => Some(alpha),
        (Alpha::Above(above), Ok(critical)) => Some(critical.alpha + above),
        (Alpha::Above(_), Err(_)) => None,
    };
    let point = SweepPoint {
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
    let (Some(alpha), Ok(critical)) = (alpha, critical.as_ref()) else {
        return SweepPoint { error: critical.err().map(|error| error.to_string()), ..point };
    };
    match Model::new(place.tip.clone(), alpha, place.r) {
        Err(error) => SweepPoint { error: Some(error.to_string()), ..point },
        Ok(_) if alpha <= critical.alpha => SweepPoint {
            regime: Some(RegimeName::Steady),
            source: Some(SourceName::Stability),
            ..point
        },
        Ok(model) => unstable(point, &model, tolerance),
    }
}

/// Above αc.
fn unstable(point: SweepPoint, model: &Model, tolerance: f64) -> SweepPoint {
    match cycle(model, tolerance) {
        Ok(cycle) if cycle.is_stable() => periodic(point, &cycle),
        // A run said so already, unless what it repeats could not be refined into a cycle.
        Err(CycleError::NoCycleReached { regime, .. }) if regime != Regime::StickSlip => {
            SweepPoint { regime: Some(regime.into()), source: Some(SourceName::Run), ..point }
        }
        _ => match settled(model) {
            Ok(outcome) => ended(point, outcome),
            Err(error) => SweepPoint { error: Some(error.to_string()), ..point },
        },
    }
}

fn periodic(point: SweepPoint, cycle: &Cycle) -> SweepPoint {
    SweepPoint {
        regime: Some(RegimeName::StickSlip),
        source: Some(SourceName::Cycle),
        period: Some(cycle.period()),
        wavelength: Some(cycle.wavelength()),
        amplitude_x0: Some(cycle.amplitude_x0()),
        amplitude_u: Some(cycle.amplitude_u()),
        slips: Some(cycle.slips()),
        multiplier: cycle.nontrivial_multipliers().map(|m| m.norm()).max_by(f64::total_cmp),
        ..point
    }
}

fn ended(point: SweepPoint, outcome: Outcome) -> SweepPoint {
    let motion = outcome.oscillation;
    SweepPoint {
        regime: Some(outcome.regime.into()),
        source: Some(SourceName::Run),
        period: motion.map(|o| o.period),
        wavelength: motion.map(|o| o.wavelength),
        amplitude_x0: motion.map(|o| o.amplitude_x0),
        slips: motion.map(|o| o.slips),
        ..point
    }
}

/// The outcome of a long run from the steady state, disturbed.
fn settled(model: &Model) -> Result<Outcome, RunError> {
    let mut scenario = Scenario::new(model.clone(), 0.0);
    (scenario.kick, scenario.tolerance) = (KICK, TOLERANCE_OF_A_RUN);
    scenario.until = scenario.start_time() + SETTLING;
    let surface = scenario.initial_surface()?;
    let mut running = Running::new(&scenario, &surface)?;
    while running.step()?.is_some() {}
    Ok(running.outcome())
}
