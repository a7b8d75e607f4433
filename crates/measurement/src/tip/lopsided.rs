//! Asymmetry of a profile that an even footprint leaves in the residuals.

use super::shape::bell;
use super::{MeasuredTip, correlation, effective};
use crate::least_squares::squares;
use crate::projection::project;

/// Ratio of the asymmetry to its standard error above which it is no noise. By chance it is reached once in 16,000
/// profiles.
const SIGNIFICANT: f64 = 4.0;

/// Value and slope of the footprint at a distance from its centre, both in σ.
fn footprint(tip: &MeasuredTip, distance: f64) -> (f64, f64) {
    tip.gaussians.iter().fold((0.0, 0.0), |(value, slope), gaussian| {
        let away = (distance - gaussian.center) / gaussian.width;
        let height = bell(gaussian, distance);
        (value + height, slope - height * away / gaussian.width)
    })
}

/// Relative difference of the widths of both sides, the side at larger positions minus the other, if it is no noise.
///
/// To first order a footprint with the widths 1 ± e/2 on either side has the height f(ξ) - (e/2) |ξ| f'(ξ). Least squares
/// determine e from the residuals of the even fit, together with changes of the height, the centre, the width and the background.
/// The standard error takes account of the correlation of neighbouring rows in the remaining residuals.
pub(super) fn asymmetry(tip: &MeasuredTip) -> Option<f64> {
    let rows = &tip.fitted;
    let residuals: Vec<f64> = rows.f.iter().zip(&rows.fit).map(|(f, fit)| f - fit).collect();
    // A curved background has absorbed a part of the difference.
    let curved = tip.ground.len().saturating_sub(2);
    let mut columns = vec![vec![]; 5 + curved];
    let mut odd = vec![];
    for x in &rows.x {
        let distance = (x - tip.centre) / tip.sigma.value;
        let (value, slope) = footprint(tip, distance);
        let even = [1.0, distance, value, slope, distance * slope];
        let powers = (2..).map(|power| distance.powi(power));
        columns
            .iter_mut()
            .zip(even.into_iter().chain(powers))
            .for_each(|(column, value)| column.push(value));
        odd.push(-0.5 * tip.apex * distance.abs() * slope);
    }
    // What the other columns leave of |ξ| f' alone determines e.
    let own = project(&columns, &odd)?.residuals;
    columns.push(odd);
    let fit = project(&columns, &residuals)?;
    let effective = effective(residuals.len(), correlation(&fit.residuals));
    let asymmetry = *fit.coefficients.last()?;
    // Both sums are over all rows, of which `effective` are independent.
    let error = (squares(&fit.residuals) / (squares(&own) * effective)).sqrt();
    (asymmetry.abs() > SIGNIFICANT * error).then_some(asymmetry)
}
