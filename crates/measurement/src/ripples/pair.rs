//! Trace and retrace of one area. Both show the same surface, each with offsets, slopes and noise of its own. Slack of the scanner, a twisted
//! lever and a slow feedback move one along the lines, so that the ripples of the retrace are those of the trace by a shift.

use super::RippleError;
use super::wave::{HARMONICS, UNKNOWNS, Wave};
use crate::image::{Image, ImageError};
use nalgebra::{Complex, DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};
use std::f64::consts::PI;

/// Images of the way there and, perhaps, of the way back.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) trace: Image,
    pub(super) retrace: Option<Image>,
    /// Distance by which the ripples of the retrace are further along the lines.
    pub(super) shift: f64,
    /// Weights of the pixels of trace and retrace, with a mean of 1.
    pub(super) weights: [f64; 2],
}

/// The retrace beside the trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Retrace {
    /// Distance by which its ripples are further along the lines, by less than half a wavelength.
    pub shift: f64,
    /// Amplitude of its first harmonic over that of the trace.
    pub ratio: f64,
    /// Probability of an equally large difference of the two by noise.
    pub agreement: f64,
}

/// Degrees of freedom of the errors, those of the blocks of both images, and of a difference that is no shift.
const BLOCK_FREEDOM: f64 = 30.0;
const FREEDOM: f64 = (UNKNOWNS - 1) as f64;

impl Pair {
    pub(super) fn of(
        trace: &Image,
        retrace: Option<&Image>,
    ) -> Result<(Self, Option<Retrace>), RippleError> {
        let alone = |image: &Image| Self {
            trace: image.clone(),
            retrace: None,
            shift: 0.0,
            weights: [1.0; 2],
        };
        let Some(retrace) = retrace else { return Ok((alone(trace), None)) };
        if !trace.is_alike(retrace) {
            return Err(RippleError::Retrace("has other positions than the image"));
        }
        let [there, back] = [Wave::of(&alone(trace))?, Wave::of(&alone(retrace))?];
        let length = |at: &[f64]| at[at.len() - 1] - at[0];
        let turns = [
            (back.q() - there.q()) * length(trace.x()),
            (back.kappa() - there.kappa()) * length(trace.y()),
        ];
        if turns.iter().any(|turn| turn.abs() > PI) {
            let why = "shows other ripples than the image: both must be of one area and lie in the same way";
            return Err(RippleError::Retrace(why));
        }
        let (shift, agreement) = compared(&there, &back).ok_or(RippleError::Nothing)?;
        let squares = [there.residual, back.residual].map(|r| (r * r).max(f64::MIN_POSITIVE));
        let weights = squares.map(|square| 2.0 / square / (1.0 / squares[0] + 1.0 / squares[1]));
        let ratio = back.harmonic(1).norm() / there.harmonic(1).norm();
        let pair = Self { retrace: Some(retrace.clone()), shift, weights, ..alone(trace) };
        Ok((pair, Some(Retrace { shift, ratio, agreement })))
    }

    /// Both images, made smaller in the same way.
    pub(super) fn each(
        &self,
        smaller: impl Fn(&Image) -> Result<Image, ImageError>,
    ) -> Result<Self, ImageError> {
        let retrace = self.retrace.as_ref().map(&smaller).transpose()?;
        Ok(Self { trace: smaller(&self.trace)?, retrace, ..*self })
    }
}

/// The shift between two waves, and the probability of an equally large difference beyond it by noise. Irregular ripples are in both images,
/// but count as noise in the errors of each: the test errs towards agreement.
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
    let weights =
        (&there.covariance + &turning * &back.covariance * turning.transpose()).try_inverse()?;
    let product = |a: &DVector<f64>, b: &DVector<f64>| a.dot(&(&weights * b));
    // The shift that brings all harmonics closest.
    let square = product(&off, &off) - product(&along, &off).powi(2) / product(&along, &along);
    let law = FisherSnedecor::new(FREEDOM, BLOCK_FREEDOM).ok()?;
    Some((shift, law.sf(square.max(0.0) / FREEDOM)))
}
