//! The paper's statements on the oscillations, as numbers.

use super::printed::number;
use crate::onset::{Onset, solved};
use crate::parts::{Failed, line_of_best_fit};
use crate::tips::{Tip, beta_0, beta_1};
use stickslip::NumberDocument;

/// Distances α - αc small enough for the leading order.
const NEAR: [f64; 2] = [1e-3, 2e-3];

/// Exponents and limits at onset, and the mean velocity.
pub(super) fn oscillations() -> Result<Vec<NumberDocument>, Failed> {
    let mut all = vec![];
    let cases = [
        (beta_1()?, "β = 1, r = 1", "6.665", None),
        (beta_0()?, "exp(-x²), r = 1", "6.727", Some("as 2π/0.934 above")),
    ];
    for (tip, case, wavelength, rounded) in cases {
        all.extend(at_onset(&tip, case, wavelength, rounded)?);
    }
    let tip = beta_1()?;
    let cycle = solved(&tip.model(tip.critical(1.0)?.alpha + 0.01, 1.0)?)?;
    let motion = cycle.motion();
    let way = motion.x0(motion.end()) - motion.x0(motion.start());
    let mean = number("mean of ẋ0", "β = 1, r = 1, α = αc + 0.01", "V, Fig. 1", "1");
    all.push(mean.beside(way / cycle.period()));
    let case = "β = 1, α = 1";
    let critical = tip.critical_r(1.0)?;
    let near = Onset::along(&NEAR.map(|d| -d), |d| tip.model(1.0, critical.r + d))?;
    all.extend(exponents(&near, case, "V, Fig. 5"));
    Ok(all)
}

fn at_onset(
    tip: &Tip,
    case: &str,
    wavelength: &str,
    rounded: Option<&str>,
) -> Result<Vec<NumberDocument>, Failed> {
    let near = Onset::above(tip, &NEAR)?;
    let mut all = exponents(&near, case, "V, Fig. 2");
    let (limit, _) = line_of_best_fit(&near.distance, &near.wavelength);
    let printed = number("L of the ripple at α → αc", case, "Fig. 3", wavelength);
    all.push(match rounded {
        None => printed.beside(limit),
        Some(why) => printed.corrected(limit, 4, why),
    });
    Ok(all)
}

/// d ln(amplitude)/d ln(distance).
fn exponents(near: &Onset, case: &str, place: &str) -> Vec<NumberDocument> {
    let exponent = |squared: &[f64]| {
        0.5 * (squared[1] / squared[0]).ln() / (near.distance[1] / near.distance[0]).ln()
    };
    let half = |quantity| number(quantity, case, place, "1/2");
    vec![
        half("exponent of the amplitude of u").beside(exponent(&near.u_squared)),
        half("exponent of the amplitude of x0").beside(exponent(&near.x0_squared)),
    ]
}
