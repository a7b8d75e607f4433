//! Comparison of the retrace with the trace. Slack of the scanner, a twisted lever and slow feedback shift the ripples of one
//! along the lines relative to those of the other.

use super::RippleError;
use super::wave::{HARMONICS, Pair, UNKNOWNS, Wave};
use crate::image::Image;
use nalgebra::{Complex, DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};
use std::f64::consts::PI;

/// Comparison of the retrace with the trace.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "RetraceDocument"))]
pub struct Retrace {
    /// Shift of the retrace along the lines relative to the trace, in the unit of the image; the fit removes it.
    pub shift: f64,
    /// Amplitude of the first harmonic of the retrace over that of the trace.
    pub ratio: f64,
    /// Probability that noise alone makes an equally large difference, beyond the shift.
    pub agreement: f64,
}

/// Degrees of freedom of the errors: those of the blocks of both images.
const BLOCK_FREEDOM: f64 = 30.0;
/// Degrees of freedom of a difference between two waves besides a shift.
const FREEDOM: f64 = (UNKNOWNS - 1) as f64;

/// Both images with the shift between them, and their comparison.
pub(super) fn pair(
    trace: &Image,
    retrace: Option<&Image>,
) -> Result<(Pair, Option<Retrace>), RippleError> {
    let Some(retrace) = retrace else { return Ok((Pair::alone(trace), None)) };
    if !trace.is_alike(retrace) {
        return Err(RippleError::Retrace("has other positions than the image"));
    }
    let [there, back] = [Wave::of(&Pair::alone(trace))?, Wave::of(&Pair::alone(retrace))?];
    let length = |at: &[f64]| at[at.len() - 1] - at[0];
    let turns = [
        (back.q() - there.q()) * length(trace.x()),
        (back.kappa() - there.kappa()) * length(trace.y()),
    ];
    if turns.iter().any(|turn| turn.abs() > PI) {
        let why =
            "shows other ripples than the image: both must be of one area and lie in the same way";
        return Err(RippleError::Retrace(why));
    }
    let (shift, agreement) = compared(&there, &back).ok_or(RippleError::Nothing)?;
    let squares = [there.residual, back.residual].map(|r| (r * r).max(f64::MIN_POSITIVE));
    let weights = squares.map(|square| 2.0 / square / (1.0 / squares[0] + 1.0 / squares[1]));
    let ratio = back.harmonic(1).norm() / there.harmonic(1).norm();
    let pair = Pair { retrace: Some(retrace.clone()), shift, weights, ..Pair::alone(trace) };
    Ok((pair, Some(Retrace { shift, ratio, agreement })))
}

/// The shift between two waves, and the probability that noise makes the rest of their difference as large. Irregularities of the
/// ripples are the same in both images, but count as noise in the errors of each: the test errs towards agreement.
fn compared(there: &Wave, back: &Wave) -> Option<(f64, f64)> {
    let q = 0.5 * (there.q() + back.q());
    let shift = -(back.harmonic(1) / there.harmonic(1)).arg() / q;
    // Numbers of the retrace, moved back by the shift: a rotation of each harmonic.
    let mut turning = DMatrix::identity(UNKNOWNS, UNKNOWNS);
    let mut along = DVector::zeros(UNKNOWNS);
    for k in 1..=HARMONICS {
        let turn = Complex::from_polar(1.0, k as f64 * q * shift);
        let block = [[turn.re, -turn.im], [turn.im, turn.re]];
        for (i, row) in block.iter().enumerate() {
            row.iter().enumerate().for_each(|(j, v)| turning[(2 * k + i, 2 * k + j)] = *v);
        }
        let slope = back.harmonic(k) * turn * Complex::new(0.0, k as f64);
        (along[2 * k], along[2 * k + 1]) = (slope.re, slope.im);
    }
    let off = &turning * DVector::from_column_slice(&back.values)
        - DVector::from_column_slice(&there.values);
    let weights = (&there.covariance + &turning * &back.covariance * turning.transpose())
        .lu()
        .try_inverse()?;
    let product = |a: &DVector<f64>, b: &DVector<f64>| a.dot(&(&weights * b));
    // The shift that brings all harmonics closest.
    let square = product(&off, &off) - product(&along, &off).powi(2) / product(&along, &along);
    let law = FisherSnedecor::new(FREEDOM, BLOCK_FREEDOM).ok()?;
    Some((shift, law.sf(square.max(0.0) / FREEDOM)))
}
