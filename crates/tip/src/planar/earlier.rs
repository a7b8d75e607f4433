//! The surface that earlier scans left, for a tip that is free to move across the scan.
//!
//! A Gaussian of variance v² is the convolution of one of variance s² with one of v² - s². With rows `y_j` = jb close
//! enough, the integral of the convolution is a sum, except for round-off (6e-16 for b = 0.36 v, s² = v²/2):
//!
//! ```text
//!     e^{-(y-y')²/2v²} = (v b/(√(2π) s q)) Σ_j e^{-(y-y_j)²/2q²} e^{-(y_j-y')²/2s²}        q² = v² - s²
//! ```
//!
//! Therefore a surface carved with f(x,y) = Σ_l g_l(x) h_l(y) is represented by rows, functions of x at the `y_j`, for
//! any path of the tip. Unlike layers about a center, rows need no change of the center and no bound on positions.

use super::jet::Jet;
use crate::elementary::exp;
use crate::footprint::{Across, Footprint};
use crate::tip_function::Gaussian;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use stickslip_convolution::Rows;

/// Distance of the rows and s, in units of the smallest width v of the footprint.
const SPACING: f64 = 0.36;
const SPREAD: f64 = FRAC_1_SQRT_2;
/// Distance in widths beyond which e^{-z²/2} is negligible.
pub(super) const NOTHING: f64 = 8.7;

/// Rows parallel to the scan: their distance, and the contribution of a visit of the tip at any y to each row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowLattice {
    spacing: f64,
    spread: f64,
}

/// The factor of one row in a Gaussian that is represented by a sum over rows: a Gaussian about `center`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reading {
    center: f64,
    /// q, and the amplitude times v b/(√(2π) s q).
    width: f64,
    scale: f64,
}

/// The heights of one layer of the footprint on all rows, and their slopes along the rows.
#[derive(Debug, Clone)]
pub struct GrooveRows {
    /// The factor h(y) of the layer.
    pub across: Across,
    /// Heights on the rows.
    pub heights: Rows,
    /// Slopes along the rows, summed separately from the heights: curvatures, their derivatives, are then as accurate
    /// as slopes.
    pub slopes: Rows,
}

/// The surface of earlier scans in the frame of a scan line: the support starts at x = 0 and moves to larger x, and the line is
/// y = 0.
#[derive(Debug, Clone)]
pub struct EarlierGrooves {
    lattice: RowLattice,
    /// Index of the first row.
    first: i64,
    /// For each layer its reading, heights and slopes.
    layers: Vec<(Vec<Reading>, Rows, Rows)>,
    /// Position and direction of the line: the position at x is origin + sign x, and at y it is `y` + y.
    origin: f64,
    sign: f64,
    y: f64,
    /// Largest distance from the line at which all rows are present.
    wide: f64,
}

impl RowLattice {
    /// The rows for a footprint.
    pub fn of(footprint: &Footprint) -> Self {
        Self::for_widths(footprint.layers().iter().map(|layer| layer.across.width))
    }

    /// The rows for Gaussians of these widths.
    pub(super) fn for_widths(widths: impl Iterator<Item = f64>) -> Self {
        let smallest = widths.fold(f64::INFINITY, f64::min);
        Self { spacing: SPACING * smallest, spread: SPREAD * smallest }
    }

    /// Index of the first row at y or above.
    #[expect(clippy::cast_possible_truncation, reason = "saturates far out of range")]
    fn row_above(&self, y: f64) -> i64 {
        (y / self.spacing).ceil() as i64
    }

    /// Index of the row closest to y.
    #[expect(clippy::cast_possible_truncation, reason = "saturates far out of range")]
    pub fn row_at(&self, y: f64) -> i64 {
        (y / self.spacing).round() as i64
    }

    /// y of a row.
    pub fn y(&self, row: i64) -> f64 {
        row as f64 * self.spacing
    }

    /// Indices of the first and the last row to which visits with y between `low` and `high` contribute.
    pub fn touched(&self, (low, high): (f64, f64)) -> (i64, i64) {
        let far = NOTHING * self.spread;
        (self.row_above(low - far), self.row_above(high + far))
    }

    /// e^{-(y_j-y)²/2s²} on the rows from `row` on: the contribution of a tip at y in unit time.
    pub fn shares(&self, y: f64, row: i64, shares: &mut [f64]) {
        for (j, share) in shares.iter_mut().enumerate() {
            let z = (self.y(row + j as i64) - y) / self.spread;
            *share = exp(-0.5 * z * z);
        }
    }

    /// The factor of a row in h, at this distance from the row.
    pub fn height(&self, across: Across, distance: f64) -> f64 {
        jet(self.readings(across), distance)[0]
    }

    /// The factor of one row in h: a sum of one or two Gaussians.
    fn readings(&self, Across { center, width }: Across) -> impl Iterator<Item = Reading> {
        let twin = (center > 0.0).then_some(-center);
        let of = move |center| self.reading(Gaussian { amplitude: 1.0, center, width });
        std::iter::once(center).chain(twin).map(of)
    }

    /// The factor of one row in this Gaussian.
    pub(super) fn reading(&self, Gaussian { amplitude, center, width: v }: Gaussian) -> Reading {
        let Self { spacing, spread } = *self;
        let width = (v * v - spread * spread).sqrt();
        let scale = v * spacing / ((2.0 * PI).sqrt() * spread * width);
        Reading { center, width, scale: scale * amplitude }
    }

    /// The distance of the rows, and s.
    pub(super) fn lengths(&self) -> (f64, f64) {
        (self.spacing, self.spread)
    }
}

/// Distance beyond which a row has no effect.
pub(super) fn reach(readings: &[Reading]) -> f64 {
    let reach = |reading: &Reading| reading.center.abs() + NOTHING * reading.width;
    readings.iter().map(reach).fold(0.0, f64::max)
}

/// Value and two derivatives of the factor of a row, at this distance from the row.
pub(super) fn jet(readings: impl Iterator<Item = Reading>, distance: f64) -> [f64; 3] {
    let mut jet = [0.0; 3];
    for Reading { center, width: q, scale } in readings {
        let z = (distance - center) / q;
        let value = scale * exp(-0.5 * z * z);
        jet[0] += value;
        jet[1] -= z / q * value;
        jet[2] += (z * z - 1.0) / (q * q) * value;
    }
    jet
}

/// Number of rows that are evaluated together.
const BLOCK: usize = 32;

impl EarlierGrooves {
    /// The surface on rows from number `first` on, in the frame of a line at `y`. The support of the line starts at x =
    /// `along.0`; it moves to smaller x if `along.1` is true. All rows that affect the surface within `wide` of the
    /// line must be present.
    pub fn new(
        lattice: RowLattice,
        first: i64,
        layers: Vec<GrooveRows>,
        (y, wide): (f64, f64),
        along: (f64, bool),
    ) -> Self {
        let layer = |layer: GrooveRows| {
            (lattice.readings(layer.across).collect(), layer.heights, layer.slopes)
        };
        let layers = layers.into_iter().map(layer).collect();
        let sign = if along.1 { -1.0 } else { 1.0 };
        Self { lattice, first, layers, origin: along.0, sign, y, wide }
    }

    /// Largest distance from the line at which the surface is complete.
    pub fn wide(&self) -> f64 {
        self.wide
    }

    /// The surface at a position in the frame of the line; 0 beyond the ends of the rows.
    pub fn at(&self, x: f64, y: f64) -> Jet {
        let (x, y) = (self.origin + self.sign * x, self.y + y);
        let mut jet = Jet::default();
        for (readings, heights, slopes) in &self.layers {
            if heights.range().contains(&x) {
                self.add(readings, (heights, slopes), (x, y), &mut jet);
            }
        }
        jet.slope[0] *= self.sign;
        jet.curvature[1] *= self.sign;
        jet
    }

    fn add(
        &self,
        readings: &[Reading],
        (heights, slopes): (&Rows, &Rows),
        at: (f64, f64),
        jet: &mut Jet,
    ) {
        let (x, y) = at;
        let reach = reach(readings);
        let (low, high) = (y - reach, y + reach);
        let place = |row: i64| usize::try_from(row - self.first).unwrap_or(0).min(heights.count());
        let end = place(self.lattice.row_above(high));
        let mut from = place(self.lattice.row_above(low));
        while from < end {
            let count = BLOCK.min(end - from);
            let mut rooms = [[0.0; BLOCK]; 4];
            let [value, unused, slope, curvature] = rooms.each_mut().map(|room| &mut room[..count]);
            heights.read(x, from, value, unused);
            slopes.read(x, from, slope, curvature);
            for j in 0..count {
                let row = self.lattice.y(self.first + (from + j) as i64);
                let [factor, steep, bent] = self::jet(readings.iter().copied(), y - row);
                jet.height += factor * value[j];
                jet.slope[0] += factor * slope[j];
                jet.slope[1] += steep * value[j];
                jet.curvature[0] += factor * curvature[j];
                jet.curvature[1] += steep * slope[j];
                jet.curvature[2] += bent * value[j];
            }
            from += count;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Layer, TipFunction};
    use num_complex::Complex;
    use stickslip_convolution::Spectra;

    /// Two layers, one of them with lobes across, and positions all over a rectangle.
    fn footprint() -> Footprint {
        let along = |width| TipFunction::gaussian(width).unwrap();
        let layers = vec![
            Layer { along: along(1.0), across: Across::central(0.8) },
            Layer { along: along(1.3), across: Across { center: 1.1, width: 1.0 } },
        ];
        Footprint::from_layers(layers).unwrap()
    }

    fn visits() -> Vec<[f64; 3]> {
        let at = |i: i32| {
            let i = f64::from(i);
            [
                9.0 * (0.618 * i).fract(),
                4.0 * (0.414 * i).fract() - 1.0,
                0.1 + (0.37 * i).cos().powi(2),
            ]
        };
        (0..50).map(at).collect()
    }

    fn grooves(footprint: &Footprint, frame: (f64, f64), along: (f64, bool)) -> EarlierGrooves {
        let lattice = RowLattice::of(footprint);
        let (first, last) = lattice.touched((-1.0, 3.0));
        let count = usize::try_from(last - first).unwrap() + 1;
        let mut spectra = Spectra::new(8.7, -25.0, 35.0);
        let mut densities = spectra.rows(count);
        let mut shares = vec![0.0; count];
        for [x, y, weight] in visits() {
            lattice.shares(y, first, &mut shares);
            shares.iter_mut().for_each(|share| *share *= weight);
            densities.add(x, 0, &shares);
        }
        let k: Vec<f64> = spectra.wave_numbers().collect();
        let layer = |layer: &Layer| {
            let (mut heights, mut slopes) = (spectra.rows(count), spectra.rows(count));
            for row in 0..count {
                let rho = spectra.of_row(&densities, row);
                let height: Vec<_> =
                    rho.iter().zip(&k).map(|(rho, k)| rho * layer.along.fourier(*k)).collect();
                let slope: Vec<_> = height
                    .iter()
                    .zip(&k)
                    .map(|(height, k)| Complex::new(0.0, *k) * height)
                    .collect();
                spectra.set_row(&mut heights, row, &height);
                spectra.set_row(&mut slopes, row, &slope);
            }
            GrooveRows { across: layer.across, heights, slopes }
        };
        let layers = footprint.layers().iter().map(layer).collect();
        EarlierGrooves::new(lattice, first, layers, frame, along)
    }

    /// Sums of f and its derivatives over all positions, from the formula.
    fn direct(x: f64, y: f64) -> [f64; 6] {
        let mut sums = [0.0; 6];
        // amplitude, widths along and across, center across
        let terms = [(1.0, 1.0, 0.8, 0.0), (1.0, 1.3, 1.0, 1.1), (1.0, 1.3, 1.0, -1.1)];
        for [x1, y1, weight] in visits() {
            for (a, w, v, c) in terms {
                let (z, s): (f64, f64) = ((x - x1) / w, (y - y1 - c) / v);
                let f = weight * a * (-0.5 * (z * z + s * s)).exp();
                let of = [
                    1.0,
                    -z / w,
                    -s / v,
                    (z * z - 1.0) / (w * w),
                    z * s / (w * v),
                    (s * s - 1.0) / (v * v),
                ];
                sums.iter_mut().zip(of).for_each(|(sum, of)| *sum += of * f);
            }
        }
        sums
    }

    #[test]
    fn grooves_are_the_sum_over_all_positions() {
        let footprint = footprint();
        let (there, back) = (
            grooves(&footprint, (0.7, 9.0), (0.5, false)),
            grooves(&footprint, (-0.4, 9.0), (8.0, true)),
        );
        let mut worst = [0.0_f64; 6];
        for i in 0..400 {
            let i = f64::from(i);
            let (x, y) = (20.0 * (0.618 * i).fract() - 5.0, 9.0 * (0.755 * i).fract() - 3.5);
            let wanted = direct(x, y);
            let numbers = |jet: Jet, sign: f64| {
                let ([a, b], [c, d, e]) = (jet.slope, jet.curvature);
                [jet.height, sign * a, b, c, sign * d, e]
            };
            for found in
                [numbers(there.at(x - 0.5, y - 0.7), 1.0), numbers(back.at(8.0 - x, y + 0.4), -1.0)]
            {
                for n in 0..6 {
                    worst[n] = worst[n].max((found[n] - wanted[n]).abs());
                }
            }
        }
        println!("{worst:?}");
        assert!(worst.iter().all(|miss| *miss < 1e-12), "{worst:?}");
        assert_eq!(there.at(1e6, 0.0), Jet::default());
    }
}
