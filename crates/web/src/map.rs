//! The phase diagram: classes of the motions at points of the plane of r and α.

use crate::parameters::Parameters;
use crate::refusal::Refusal;
use stickslip_cycles::CycleError;
use stickslip_outcome::{Motion, Regime, motion};
use stickslip_stability::Boundary;
use stickslip_tip::Model;

/// Tolerance of cycles, as in a sweep.
const TOLERANCE: f64 = 1e-6;

/// Classes: 0 steady; 1, 2, 3 for one, two and more slips per period; 4 trapped; 5 none of these within thousands of time
/// units; 6 failed.
const STEADY: u8 = 0;
const MOST_SLIPS: u8 = 3;
const TRAPPED: u8 = 4;
const TRANSIENT: u8 = 5;
const FAILED: u8 = 6;

pub(crate) fn row(parameters: &Parameters, r: f64, alphas: &[f64]) -> Result<Vec<u8>, Refusal> {
    let (tip, wider) = (parameters.tip()?, parameters.wider());
    let model = |alpha: &f64| Model::under(wider, tip.clone(), *alpha, r);
    let models = alphas.iter().map(model).collect::<Result<Vec<_>, _>>()?;
    Ok(models.iter().map(|model| motion(model, TOLERANCE)).map(class).collect())
}

fn class(found: Result<Motion, CycleError>) -> u8 {
    let of_slips = |slips: usize| u8::try_from(slips).unwrap_or(MOST_SLIPS).clamp(1, MOST_SLIPS);
    match found {
        Ok(Motion::Steady) => STEADY,
        Ok(Motion::Cycle(cycle)) => of_slips(cycle.slips()),
        Ok(Motion::Run(outcome)) => match (outcome.regime, outcome.oscillation) {
            (Regime::Steady, _) => STEADY,
            (Regime::StickSlip, Some(motion)) => of_slips(motion.slips),
            (Regime::Trapped, _) => TRAPPED,
            _ => TRANSIENT,
        },
        Err(_) => FAILED,
    }
}

pub(crate) fn boundary(parameters: &Parameters, velocities: &[f64]) -> Result<Vec<f64>, Refusal> {
    let (tip, wider) = (parameters.tip()?, parameters.wider());
    let boundary = Boundary::new(&wider, &tip);
    Ok(velocities.iter().map(|r| boundary.at(*r).map_or(f64::NAN, |at| at.alpha)).collect())
}
