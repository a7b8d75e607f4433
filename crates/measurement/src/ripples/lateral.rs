//! Lateral forces on the lines that made the ripples, beside the ripples.
//!
//! The lag of the tip behind its support, as a function of the position R of the support, is a wave with the wave vector of the
//! ripples. Its amplitude, in σ, determines how far α is above the threshold; in the heights alone only the shape of a ripple
//! depends on that. If the stiffness k of the lever is unknown, the amplitude determines k instead. The phase of the lag against
//! the crests is that of the model if both images have the same positions.

use super::RippleError;
use super::wave::{Pair, Wave};
use crate::image::Image;
use crate::interval::Estimate;
use std::f64::consts::{PI, TAU};

/// Lateral forces or deflections of the lever at the positions of an image of heights, against the position of the support.
#[derive(Debug, Clone)]
pub struct Lateral {
    /// Positive where the lever is bent back against the motion towards larger x.
    pub image: Image,
    /// The unit of deflections, over that of the lengths; `None` for forces of an unknown stiffness.
    pub length: Option<f64>,
}

/// The wave of the lag of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lag {
    /// Size of the complex amplitude L of its first harmonic 2 Re L e^{iqR}, in σ.
    pub size: Estimate,
    /// Phase of the lag minus that of the heights, in rad.
    pub ahead: f64,
}

/// Comparison of the lateral image with the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LateralFound {
    /// Half of the peak-to-peak of the first harmonic, in the unit of the image.
    pub amplitude: Estimate,
    /// Half of the peak-to-peak of the first harmonic of the lag in the model, in the unit of the lengths.
    pub lag: Estimate,
    /// Stiffness of the lever: force over deflection, in the units of the image and of the lengths; `None` for deflections.
    pub stiffness: Option<Estimate>,
    /// Phase of the lateral wave minus that of the heights, in degrees: in the image, and in the model.
    pub phase: [f64; 2],
    /// Distance along the lines by which the lateral wave is ahead of that of the model, in the unit of the lengths.
    pub shift: f64,
    /// Standard deviation of the shift.
    pub shift_error: f64,
}

/// The wave in the lateral image.
pub(super) struct Seen {
    wave: Wave,
    length: Option<f64>,
    /// Standard deviation of the logarithm of its amplitude, and of its phase in rad.
    errors: [f64; 2],
    /// Phase minus that of the heights, in rad.
    ahead: f64,
}

/// Normal quantile of 95 % intervals.
const QUANTILE: f64 = 1.96;

impl Seen {
    /// The lateral wave in the part of the image from which the wave of the heights was determined.
    pub(super) fn of(
        lateral: &Lateral,
        (heights, ends): (&Image, [[f64; 2]; 2]),
        wave: &Wave,
    ) -> Result<Self, RippleError> {
        if !lateral.image.is_alike(heights) {
            return Err(RippleError::Lateral("has other positions than the image"));
        }
        let within = |at: &[f64], [first, last]: [f64; 2]| {
            at.partition_point(|v| *v < first)..at.partition_point(|v| *v <= last)
        };
        let image = &lateral.image;
        let part = image.part(within(image.x(), ends[0]), within(image.y(), ends[1]))?;
        let seen = Wave::of(&Pair::alone(&part))?;
        let turns = |a: f64, b: f64, [first, last]: [f64; 2]| ((a - b) * (last - first)).abs();
        let is_other = turns(seen.q(), wave.q(), ends[0]) > PI
            || turns(seen.kappa(), wave.kappa(), ends[1]) > PI;
        if is_other {
            let why = "shows another wave than the image: it must be of the lines that made these ripples, and lie as the image does";
            return Err(RippleError::Lateral(why));
        }
        let [own, other] = [&seen, wave].map(|wave| {
            let (b, c) = (wave.harmonic(1), &wave.covariance);
            let size = b.norm_sqr();
            let square = |[u, v]: [f64; 2]| {
                (u * u * c[(2, 2)] + 2.0 * u * v * c[(2, 3)] + v * v * c[(3, 3)]) / (size * size)
            };
            [square([b.re, b.im]), square([-b.im, b.re])]
        });
        let errors = [own[0].sqrt(), (own[1] + other[1]).sqrt()];
        let ahead = (seen.harmonic(1) / wave.harmonic(1)).arg();
        Ok(Self { wave: seen, length: lateral.length, errors, ahead })
    }

    /// ln |L| of a deflection in σ, and its error.
    pub(super) fn in_widths(&self, sigma: f64) -> Option<[f64; 2]> {
        let length = self.length?;
        Some([(self.wave.harmonic(1).norm() * length / sigma).ln(), self.errors[0]])
    }

    /// Comparison with the lag of a model on lines in the given direction; `sigma` is σ in the unit of the lengths.
    pub(super) fn beside(&self, model: &Lag, forward: bool, sigma: f64) -> LateralFound {
        let size = 2.0 * self.wave.harmonic(1).norm();
        let error = (QUANTILE * self.errors[0]).exp();
        let amplitude = Estimate { value: size, low: size / error, high: size * error };
        let lag = model.size.times(2.0 * sigma);
        let stiffness = self.length.is_none().then(|| {
            // Both errors are independent.
            let end = |model: f64| f64::hypot((model / lag.value).ln(), error.ln()).exp();
            let value = size / lag.value;
            Estimate { value, low: value / end(lag.high), high: value * end(lag.low) }
        });
        let wrapped = |phase: f64| (phase + PI).rem_euclid(TAU) - PI;
        // The force is negative where the tip moves to smaller x.
        let expected = wrapped(model.ahead + if forward { 0.0 } else { PI });
        let off = wrapped(self.ahead - expected);
        LateralFound {
            amplitude,
            lag,
            stiffness,
            phase: [self.ahead.to_degrees(), expected.to_degrees()],
            shift: -off / self.wave.q(),
            shift_error: self.errors[1] / self.wave.q(),
        }
    }
}
