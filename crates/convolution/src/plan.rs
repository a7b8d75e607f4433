//! The choice of lattice and period for one kernel.

use std::f64::consts::PI;

use crate::Kernel;
use crate::lattice::dyadic_at_most;
use crate::window::WIDTH;

/// Number of lattice points relative to the least that the sampling theorem allows for the band.
pub(crate) const UPSAMPLING: f64 = 2.0;

/// Distance between the ends of a taper and its center, in widths: erfc(5.95)/2 = 2e-17.
const TAPER_HALF_WIDTHS: f64 = 5.95;

/// Increase of the bandwidth by a taper, in inverse widths: exp(−12.4²/4) = 2e-17.
const TAPER_BAND_WIDTHS: f64 = 12.4;

/// The factor `χ(ξ) = ½ erfc((|ξ| − center)/width)` that truncates a kernel without reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taper {
    /// Separation at which χ is one half.
    pub center: f64,
    /// Width of the decay.
    pub width: f64,
}

impl Taper {
    /// χ(ξ).
    pub fn value(&self, separation: f64) -> f64 {
        0.5 * libm::erfc((separation.abs() - self.center) / self.width)
    }

    /// The taper that leaves the kernel unchanged up to the separation A, with the width w that gives the fewest cells.
    /// Their number is proportional to `(2A + 11.9w)(band + 12.4/w)`, hence `w² ≈ 2A/band`.
    fn beyond(separation: f64, band: f64) -> Self {
        let width = (2.0 * separation.max(1.0 / band) / band).sqrt();
        Self { center: separation + TAPER_HALF_WIDTHS * width, width }
    }

    fn end(&self) -> f64 {
        self.center + TAPER_HALF_WIDTHS * self.width
    }
}

/// The plan of a sum: all choices that do not depend on the sources.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The largest separation of source and target for which the kernel is exact.
    pub separation: f64,
    /// Distance between cells: at most half the sampling distance of the band, with six
    /// significant bits, so that its multiples are exact.
    pub spacing: f64,
    /// Number of cells of the window, an even product of 2, 3 and 5.
    pub length: usize,
    /// Reach of the kernel, including the taper.
    pub reach: f64,
    /// The taper of a kernel without reach.
    pub taper: Option<Taper>,
}

impl Plan {
    /// The plan for separations |x − y| up to `separation`.
    ///
    /// A window of length `P` sums the kernel as if sources repeated with period `P`. The nearest repetition is at `P
    /// − separation` or farther, beyond the reach if `P ≥ separation + reach`; 48 cells are added for the windows of
    /// sources and targets at either end (see [`margin`](Self::margin)), and 3 because the window is centered on a
    /// cell.
    ///
    /// # Panics
    /// The bandwidth is not positive and finite, or the separation or reach is negative or not finite.
    pub fn new(kernel: &Kernel, separation: f64) -> Self {
        let not_negative = |x: f64| x >= 0.0 && x.is_finite();
        assert!(kernel.band > 0.0 && kernel.band.is_finite(), "band {}", kernel.band);
        assert!(not_negative(separation), "separation {separation}");
        assert!(not_negative(kernel.reach.unwrap_or(0.0)), "reach {:?}", kernel.reach);
        let taper = match kernel.reach {
            Some(_) => None,
            None => Some(Taper::beyond(separation, kernel.band)),
        };
        let reach = taper.map_or(kernel.reach.unwrap_or(0.0), |t| t.end());
        let band = kernel.band + taper.map_or(0.0, |t| TAPER_BAND_WIDTHS / t.width);
        let spacing = dyadic_at_most(PI / (UPSAMPLING * band));
        let cells = ((separation + reach) / spacing).ceil() as usize + 3 * WIDTH + 3;
        Self { separation, spacing, length: fast_length(cells), reach, taper }
    }

    /// Smallest distance of a target from the ends of the window.
    ///
    /// A kernel with reach: `reach` plus 24 cells, for any sources outside the window. The window truncates the
    /// spread of sources at its ends, which leaves fragments up to 16 cells inside; these have the reach of the
    /// kernel, and the target uses cells up to 8 away.
    ///
    /// A tapered kernel: 8 cells; every source must also lie at least 8 cells inside the window.
    pub fn margin(&self) -> f64 {
        let half = (WIDTH / 2) as f64 * self.spacing;
        if self.taper.is_some() { half } else { self.reach + 3.0 * half }
    }
}

/// The smallest even product of 2, 3 and 5 that is not below `least`.
pub(crate) fn fast_length(least: usize) -> usize {
    let mut length = least.next_multiple_of(2);
    while !is_smooth(length) {
        length += 2;
    }
    length
}

pub(crate) fn is_smooth(mut n: usize) -> bool {
    for prime in [2, 3, 5] {
        while n.is_multiple_of(prime) {
            n /= prime;
        }
    }
    n == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_the_least_even_smooth_numbers() {
        let lengths = [1, 2, 7, 48, 211, 217, 1001].map(fast_length);
        assert_eq!(lengths, [2, 2, 8, 48, 216, 240, 1024]);
    }

    #[test]
    fn a_taper_is_one_within_the_separation_and_zero_at_its_end() {
        let taper = Taper::beyond(1000.0, 1.0);
        assert!((taper.value(-1000.0) - 1.0).abs() < 1e-16);
        assert!(taper.value(taper.end()) < 1e-16);
    }
}
