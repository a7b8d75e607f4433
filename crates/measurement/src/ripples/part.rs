//! The largest part of an image in which the ripples have settled.
//!
//! Ripples grow along the scan and from line to line, as in a wake. Where the lines begin, and on the first lines, they are still
//! growing; beyond the wake the edge of the area determines them. Between these regions is the pattern of the model.

use super::wave::{Pair, Wave, coarse_image};
use super::{RippleError, Ripples};
use crate::image::Image;
use std::f64::consts::TAU;
use std::ops::Range;

/// A part of an image, and its wave.
pub(super) struct Part {
    pub(super) wave: Wave,
    /// First and last x and y.
    pub(super) ends: [[f64; 2]; 2],
}

/// Least F of the wave against white noise: the strongest of 10⁵ waves of noise alone has about 3.
const LEAST_STRENGTH: f64 = 15.0;
/// Least amplitude of the first harmonic, in standard deviations from the scatter of the blocks of the image.
const STANDS_OUT: f64 = 5.0;
/// Ends of parts are multiples of this fraction of the image, and parts are as long as these.
const EIGHTHS: usize = 8;
const LENGTHS: [usize; 5] = [8, 7, 6, 5, 4];
/// Least number of wavelengths in a part, along x and y together.
const FEWEST: f64 = 6.0;
/// Largest number of rows and columns of the image in which parts are sought.
const COARSE: usize = 128;

impl Part {
    /// The largest part in which the ripples have settled, or the whole image if none has.
    pub(super) fn settled(image: &Pair) -> Result<Self, RippleError> {
        let wave = Wave::of(image)?;
        if wave.strength < LEAST_STRENGTH {
            return Err(RippleError::Nothing);
        }
        let (stands_out, has_settled) = (stands_out(&wave), has_settled(&wave));
        let whole = Self { wave, ends: ends(&image.trace) };
        if has_settled {
            return Ok(whole);
        }
        match largest(image) {
            Some(part) => Ok(part),
            None if stands_out => Ok(whole),
            None => Err(RippleError::NotUniform),
        }
    }
}

/// The largest part in which the ripples have settled; among several of equal area, the most uniform.
fn largest(image: &Pair) -> Option<Part> {
    let coarse = image.each(|image| coarse_image(image, COARSE)).ok()?;
    let mut parts: Vec<[[usize; 2]; 2]> =
        lengths().flat_map(|x| lengths().map(move |y| [x, y])).skip(1).collect();
    let area = |[[a, b], [c, d]]: &[[usize; 2]; 2]| (b - a) * (d - c);
    parts.sort_by_key(|part| std::cmp::Reverse(area(part)));
    for alike in parts.chunk_by(|a, b| area(a) == area(b)) {
        let wave = |part: &[[usize; 2]; 2]| Some((*part, settled(&cut(&coarse, *part)?)?));
        let found = alike.iter().filter_map(wave);
        let best = found.min_by(|a, b| a.1.modulation.total_cmp(&b.1.modulation));
        let fine = best.and_then(|(part, _)| {
            let image = cut(image, part)?;
            Some(Part { wave: settled(&image)?, ends: ends(&image.trace) })
        });
        if fine.is_some() {
            return fine;
        }
    }
    None
}

/// Both ends, in eighths of the image, of all parts in one direction.
fn lengths() -> impl Iterator<Item = [usize; 2]> {
    LENGTHS.into_iter().flat_map(|length| (0..=EIGHTHS - length).map(move |i| [i, i + length]))
}

fn cut(image: &Pair, [columns, rows]: [[usize; 2]; 2]) -> Option<Pair> {
    let range = |[first, last]: [usize; 2], count: usize| -> Range<usize> {
        first * count / EIGHTHS..last * count / EIGHTHS
    };
    let part =
        |image: &Image| image.part(range(columns, image.x().len()), range(rows, image.y().len()));
    image.each(part).ok()
}

/// The wave of ripples that have settled; `None` for other images.
fn settled(image: &Pair) -> Option<Wave> {
    let wave = Wave::of(image).ok()?;
    let length = |[first, last]: [f64; 2]| last - first;
    let [x, y] = ends(&image.trace).map(length);
    let count = (wave.q() * x).hypot(wave.kappa() * y) / TAU;
    (wave.strength >= LEAST_STRENGTH && count >= FEWEST && has_settled(&wave)).then_some(wave)
}

fn has_settled(wave: &Wave) -> bool {
    stands_out(wave) && wave.modulation <= Ripples::MOST_MODULATION
}

fn stands_out(wave: &Wave) -> bool {
    let error = (wave.covariance[(2, 2)] + wave.covariance[(3, 3)]).sqrt();
    wave.harmonic(1).norm() >= STANDS_OUT * error
}

pub(super) fn ends(image: &Image) -> [[f64; 2]; 2] {
    [image.x(), image.y()].map(|at| [at[0], at[at.len() - 1]])
}
