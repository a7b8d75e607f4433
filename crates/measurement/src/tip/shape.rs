//! An even sum of Gaussians on a sloping or curved background, as a function of its parameters.
//!
//! ```text
//!     y(x) = Σ_j g_j z^j + Σ_k a_k G_k(x - c),   z = (x - x̄)/h,   G_k(x) = (e^{-(x-d_k)²/2w_k²} + e^{-(x+d_k)²/2w_k²})/2
//! ```
//!
//! x̄ and h are the middle and half of the extent; the `g_j` and the `a_k` are linear and projected out; c, ln w and
//! d are searched. The first term has d = 0.

use crate::Profile;
use crate::least_squares::Residuals;
use crate::projection::{Projected, project};
use stickslip_tip::Gaussian;

/// The range of widths that data determine: narrower Gaussians fall between rows, wider ones are part of the
/// background.
#[derive(Debug, Clone, Copy)]
pub(super) struct Widths {
    pub(super) least: f64,
    pub(super) most: f64,
}

/// A fit problem: model and data.
#[derive(Debug, Clone)]
pub(super) struct Shape<'a> {
    pub(super) profile: &'a Profile,
    /// Centre of symmetry of f, if known.
    pub(super) centre: Option<f64>,
    pub(super) widths: Widths,
    /// Middle and half of the extent.
    pub(super) middle: f64,
    pub(super) half: f64,
    pub(super) terms: usize,
    /// Highest power of the position in the background: 1 to 3.
    pub(super) order: usize,
}

/// c, and d and w of each term.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Places {
    pub(super) centre: f64,
    pub(super) terms: Vec<(f64, f64)>,
}

/// Smallest width, in mean distances of rows: a narrower Gaussian depends on one or two rows.
const LEAST_WIDTH: f64 = 1.5;
/// Largest width, relative to the distance from the centre to the end: at the end of the profile a footprint has
/// decayed, or cannot be separated from the background.
const MOST_WIDTH: f64 = 0.4;

impl<'a> Shape<'a> {
    /// The problem with no width below `finest`, unless the distance of the rows is too large.
    pub(super) fn of(
        profile: &'a Profile,
        centre: Option<f64>,
        (terms, finest): (usize, f64),
        order: usize,
    ) -> Self {
        let (first, last) = profile.ends();
        let extent = last - first;
        let least = (LEAST_WIDTH * profile.spacing()).max(finest).min(0.1 * extent);
        let way = centre.map_or(0.5 * extent, |c| (first - c).abs().max((last - c).abs()));
        let most = (MOST_WIDTH * way).max(2.0 * least);
        let widths = Widths { least, most };
        let (middle, half) = (0.5 * (first + last), 0.5 * extent);
        Self { profile, centre, widths, middle, half, terms, order }
    }

    /// Number of fitted parameters, including the linear ones.
    pub(super) fn count(&self) -> usize {
        self.order + usize::from(self.centre.is_none()) + 3 * self.terms
    }

    /// The search variables, of order 1: c and d over half of the extent, and the relative position of each width in
    /// its range.
    pub(super) fn searched(&self, places: &Places) -> Vec<f64> {
        let mut found = vec![];
        if self.centre.is_none() {
            found.push((places.centre - self.middle) / self.half);
        }
        for (k, (d, w)) in places.terms.iter().enumerate() {
            if k > 0 {
                found.push(d / self.half);
            }
            let Widths { least, most } = self.widths;
            let share = ((w / least).ln() / (most / least).ln()).clamp(1e-4, 1.0 - 1e-4);
            found.push((share / (1.0 - share)).ln());
        }
        found
    }

    /// The inverse of [`searched`](Self::searched).
    pub(super) fn places(&self, searched: &[f64]) -> Places {
        let mut numbers = searched.iter();
        let mut next = || numbers.next().copied().unwrap_or(0.0);
        let centre = self.centre.unwrap_or_else(|| self.middle + self.half * next());
        let terms = (0..self.terms).map(|k| {
            let d = if k > 0 { (self.half * next()).abs() } else { 0.0 };
            let share = 1.0 / (1.0 + (-next()).exp());
            let Widths { least, most } = self.widths;
            (d, least * (most / least).powf(share))
        });
        Places { centre, terms: terms.collect() }
    }

    /// Columns of the powers of the position.
    pub(super) fn ground(&self) -> Vec<Vec<f64>> {
        let x = self.profile.x();
        let power = |k| x.iter().map(|x| ((x - self.middle) / self.half).powi(k)).collect();
        (0..).take(self.order + 1).map(power).collect()
    }

    /// Coefficients of 1, x, x², … of a background with these coefficients of 1, z, z², ….
    pub(super) fn in_powers_of_x(&self, coefficients: &[f64]) -> Vec<f64> {
        // Horner's rule for polynomials: times (x - middle)/half, plus the next.
        coefficients.iter().rev().fold(vec![], |sum: Vec<f64>, c| {
            let mut next = vec![0.0; sum.len() + 1];
            for (k, v) in sum.iter().enumerate() {
                next[k + 1] += v / self.half;
                next[k] -= v * self.middle / self.half;
            }
            next[0] += c;
            next.truncate(coefficients.len());
            next
        })
    }

    /// The fit of the linear parameters for these centres and widths.
    pub(super) fn projected(&self, places: &Places) -> Option<Projected> {
        let x = self.profile.x();
        let mut columns = self.ground();
        columns.extend(
            places.terms.iter().map(|(d, w)| {
                x.iter().map(|x| pair(x - places.centre, *d, *w)).collect::<Vec<f64>>()
            }),
        );
        project(&columns, self.profile.f())
    }
}

/// A Gaussian at x.
pub(crate) fn bell(g: &Gaussian, x: f64) -> f64 {
    g.amplitude * (-0.5 * ((x - g.center) / g.width).powi(2)).exp()
}

/// A sum of Gaussians at x.
pub(super) fn value(terms: &[Gaussian], x: f64) -> f64 {
    terms.iter().map(|g| bell(g, x)).sum()
}

/// The function G.
pub(super) fn pair(x: f64, d: f64, w: f64) -> f64 {
    let bell = |z: f64| (-0.5 * z * z).exp();
    0.5 * (bell((x - d) / w) + bell((x + d) / w))
}

/// ∂G/∂c, ∂G/∂d and ∂G/∂ln w at distance x from c.
fn pair_slopes(x: f64, d: f64, w: f64) -> [f64; 3] {
    let (y, z) = ((x - d) / w, (x + d) / w);
    let (a, b) = (0.5 * (-0.5 * y * y).exp(), 0.5 * (-0.5 * z * z).exp());
    [(y * a + z * b) / w, (y * a - z * b) / w, y * y * a + z * z * b]
}

impl Residuals for Shape<'_> {
    fn at(&self, searched: &[f64]) -> Option<Vec<f64>> {
        self.projected(&self.places(searched)).map(|found| found.residuals)
    }

    fn derivatives(&self, _: &[f64], searched: &[f64]) -> Option<Vec<Vec<f64>>> {
        let places = self.places(searched);
        let found = self.projected(&places)?;
        let x = self.profile.x();
        let Widths { least, most } = self.widths;
        let mut by_centre = vec![0.0; x.len()];
        let mut columns = vec![];
        for (k, ((d, w), a)) in
            places.terms.iter().zip(&found.coefficients[self.order + 1..]).enumerate()
        {
            let share = (w / least).ln() / (most / least).ln();
            let by_share = a * (most / least).ln() * share * (1.0 - share);
            // Searched is d with a sign, of which nothing depends.
            let side = (k > 0).then(|| searched[searched.len() - 2 * (self.terms - k)].signum());
            let by_place = a * self.half * side.unwrap_or(1.0);
            let (mut of_place, mut of_width) = (vec![], vec![]);
            for (x, sum) in x.iter().zip(&mut by_centre) {
                let [c, d, ln_w] = pair_slopes(x - places.centre, *d, *w);
                *sum += a * self.half * c;
                of_place.push(-by_place * d);
                of_width.push(-by_share * ln_w);
            }
            if k > 0 {
                columns.push(found.beyond(of_place));
            }
            columns.push(found.beyond(of_width));
        }
        if self.centre.is_none() {
            let by_centre = by_centre.into_iter().map(|v| -v).collect();
            columns.insert(0, found.beyond(by_centre));
        }
        Some(columns)
    }
}

/// The Gaussians of Σ `a_k` `G_k`, with symmetric pairs written as two.
pub(super) fn gaussians(places: &Places, amplitudes: &[f64]) -> Vec<Gaussian> {
    let terms = places.terms.iter().zip(amplitudes);
    terms
        .flat_map(|((d, width), a)| {
            let at = |amplitude, center| Gaussian { amplitude, center, width: *width };
            // Twins closer than a thousandth of their width are one.
            if *d <= 1e-3 * width {
                vec![at(*a, 0.0)]
            } else {
                vec![at(0.5 * a, -d), at(0.5 * a, *d)]
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::least_squares::differences;

    /// Comparison with differences where the sum follows the data: there Kaufman's derivative is exact.
    #[test]
    fn derivatives_are_those_of_the_residuals() {
        let x: Vec<f64> = (0..80).map(|i| 0.2 * f64::from(i) - 7.0).collect();
        let places = Places { centre: 0.8, terms: vec![(0.0, 1.1), (2.5, 0.7), (1.0, 2.0)] };
        let height = |x: &f64| {
            let g = |k: usize| pair(x - 0.8, places.terms[k].0, places.terms[k].1);
            3.0 + 0.1 * x + 2.0 * g(0) - 0.8 * g(1) + 0.3 * g(2)
        };
        let profile = Profile::new(x.clone(), x.iter().map(height).collect()).unwrap();
        for (centre, order) in [(None, 1), (Some(0.8), 1), (None, 3)] {
            let shape = Shape::of(&profile, centre, (3, 0.0), order);
            let mut searched = shape.searched(&places);
            assert_eq!(searched.len() + 4 + order, shape.count());
            let second = searched.len() - 2;
            searched[second] = -searched[second];
            assert_eq!(shape.places(&searched).terms.len(), 3);
            let here = shape.at(&searched).unwrap();
            assert!(here.iter().all(|v| v.abs() < 1e-8));
            let told = shape.derivatives(&here, &searched).unwrap();
            let seen = differences(&shape, (&here, &searched), 1e-5).unwrap();
            assert_eq!(told.len(), seen.len());
            for (told, seen) in told.iter().zip(&seen) {
                let size = seen.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                for (told, seen) in told.iter().zip(seen) {
                    assert!((told - seen).abs() < 1e-6 * size.max(1e-3), "{told} {seen}");
                }
            }
        }
    }

    #[test]
    fn a_ground_is_the_same_in_powers_of_x() {
        let x: Vec<f64> = (0..20).map(|i| 3.0 + f64::from(i)).collect();
        let profile = Profile::new(x.clone(), x).unwrap();
        let shape = Shape::of(&profile, None, (1, 0.0), 3);
        let coefficients = [0.5, -1.0, 2.0, 0.3];
        let powers = shape.in_powers_of_x(&coefficients);
        for x in [3.0, 7.7, 22.0] {
            let z: f64 = (x - shape.middle) / shape.half;
            let value: f64 = coefficients.iter().rev().fold(0.0, |s, c| s * z + c);
            let found: f64 = powers.iter().rev().fold(0.0, |s, c| s * x + c);
            assert!((value - found).abs() < 1e-11, "{value} {found}");
        }
    }
}
