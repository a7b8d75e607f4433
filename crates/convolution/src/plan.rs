//! The choice of lattice and period for one kernel, as plain data.

use std::f64::consts::PI;

use crate::Kernel;
use crate::lattice::dyadic_at_most;
use crate::window::WIDTH;

/// Lattice points per period of the band edge are twice what the sampling theorem asks.
pub(crate) const UPSAMPLING: f64 = 2.0;

/// Widths between the ends of a taper and its center: erfc(5.95)/2 = 2e-17.
const TAPER_HALF_WIDTHS: f64 = 5.95;

/// What a taper adds to the band, in inverse widths: exp(−12.4²/4) = 2e-17.
const TAPER_BAND_WIDTHS: f64 = 12.4;

/// The factor `χ(ξ) = ½ erfc((|ξ| − center)/width)` that ends a kernel without reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taper {
    /// Where χ is one half.
    pub center: f64,
    /// The scale on which it falls.
    pub width: f64,
}

impl Taper {
    /// χ(ξ).
    pub fn value(&self, separation: f64) -> f64 {
        0.5 * libm::erfc((separation.abs() - self.center) / self.width)
    }

    /// The taper that leaves separations up to `separation` alone and makes the fewest cells,
    /// `(2A + 11.9w)(band + 12.4/w)` up to a factor, hence `w² ≈ 2A/band`.
    fn beyond(separation: f64, band: f64) -> Self {
        let width = (2.0 * separation.max(1.0 / band) / band).sqrt();
        Self { center: separation + TAPER_HALF_WIDTHS * width, width }
    }

    fn end(&self) -> f64 {
        self.center + TAPER_HALF_WIDTHS * self.width
    }
}

/// How a kernel will be summed: everything that is decided before any source is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The largest separation of source and target whose kernel is exact.
    pub separation: f64,
    /// Distance between cells: at most half the sampling distance of the band, with six
    /// significant bits, so that its multiples are exact.
    pub spacing: f64,
    /// Cells in the window, an even product of 2, 3 and 5.
    pub length: usize,
    /// Where the kernel ends, taper included.
    pub reach: f64,
    /// The taper of a kernel that would not end by itself.
    pub taper: Option<Taper>,
}

impl Plan {
    /// The plan for separations |x − y| up to `separation`.
    ///
    /// A window of length `P` sums the kernel as if sources repeated with period `P`. The nearest
    /// repetition is at `P − separation` or farther, beyond the reach if `P ≥ separation + reach`;
    /// 48 cells are added for the windows of sources and targets at either end (see
    /// [`margin`](Self::margin)), and 3 because it is centered on a cell.
    ///
    /// # Panics
    /// If the band is not positive and finite, or the separation or reach negative or not finite.
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

    /// How far inside the window a target must lie.
    ///
    /// A kernel with reach: `reach` plus 24 cells, whatever sources lie outside the window. The
    /// window cuts the spread of sources at its ends, leaving fragments up to 16 cells inside;
    /// they reach as far as the kernel, and the target reads from 8 cells nearer.
    ///
    /// A tapered kernel: 8 cells, where every source must lie in the window, 8 cells inside too.
    pub fn margin(&self) -> f64 {
        let half = (WIDTH / 2) as f64 * self.spacing;
        if self.taper.is_some() { half } else { self.reach + 3.0 * half }
    }
}

/// The least even product of 2, 3 and 5 that is not below `least`.
pub(crate) fn fast_length(least: usize) -> usize {
    let mut length = least.next_multiple_of(2);
    while !is_smooth(length) {
        length += 2;
    }
    length
}

fn is_smooth(mut n: usize) -> bool {
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
