//! Bicubic splines: heights at points of a grid (`x_i`, `y_j`), interpolated with continuous second derivatives.
//!
//! On a piece of an axis, with a = (high - x)/h and b = (x - low)/h, the spline is
//!
//! ```text
//!     a u_0 + b u_1 + ((a³ - a) m_0 + (b³ - b) m_1) h²/6
//! ```
//!
//! with the second derivatives m at its knots. The spline of splines needs u, `u_xx`, `u_yy` and `u_xxyy` at each point.

use crate::relief::{Axis, Piece};
use crate::spline::{CubicSpline, Ends};

/// `∂x^a ∂y^b u` in row a and column b; higher derivatives of a bicubic are 0.
pub(super) type Partials = [[f64; 4]; 4];

#[derive(Debug, Clone)]
pub(super) struct Bicubic {
    x: Vec<f64>,
    y: Vec<f64>,
    /// u, `u_xx`, `u_yy`, `u_xxyy` at each point, row after row.
    points: Vec<[f64; 4]>,
}

/// The pieces of both axes that contain a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    pub(super) x: Piece,
    pub(super) y: Piece,
}

impl Bicubic {
    /// The spline through heights given row after row. Across the scan the spline has slope 0 at both ends and is
    /// constant beyond them; a single row is the same for all y. Along the scan the spline is 0 beyond its ends. The
    /// callers ensure that both axes increase, that there are at least two x, and a height for each point.
    pub(super) fn through(x: Vec<f64>, y: Vec<f64>, u: &[f64], ends: Ends) -> Self {
        let columns = x.len();
        let mut points: Vec<[f64; 4]> = u.iter().map(|u| [*u, 0.0, 0.0, 0.0]).collect();
        for row in points.chunks_exact_mut(columns) {
            let heights = row.iter().map(|point| point[0]).collect();
            let spline = CubicSpline::through(x.clone(), heights, ends);
            row.iter_mut().zip(spline.curvatures()).for_each(|(point, m)| point[1] = *m);
        }
        for column in 0..if y.len() > 1 { columns } else { 0 } {
            for of in 0..2 {
                let along = points.iter().skip(column).step_by(columns);
                let spline = CubicSpline::through(
                    y.clone(),
                    along.map(|point| point[of]).collect(),
                    Ends::Level,
                );
                let along = points.iter_mut().skip(column).step_by(columns);
                along.zip(spline.curvatures()).for_each(|(point, m)| point[of + 2] = *m);
            }
        }
        Self { x, y, points }
    }

    /// The patch that contains a tip at (x, y), or that the tip is about to enter if it is at a border. `forward`
    /// contains the signs of its velocities; the position has an error of at most `accuracy`.
    pub(super) fn patch(&self, at: [f64; 2], forward: [bool; 2], accuracy: f64) -> Patch {
        let axis = |knots: &[f64], j: usize| match knots {
            [_] => Piece::EVERYWHERE,
            knots => Axis(knots).piece(at[j], forward[j], accuracy),
        };
        Patch { x: axis(&self.x, 0), y: axis(&self.y, 1) }
    }

    /// Height and derivatives at (x, y) of the polynomial of a patch.
    pub(super) fn jet(&self, patch: &Patch, [x, y]: [f64; 2]) -> Partials {
        let Some(column) = patch.x.index else { return [[0.0; 4]; 4] };
        let along = weights(&self.x[column..], x);
        let (rows, across) = match patch.y.index {
            Some(row) => ([row, row + 1], weights(&self.y[row..], y)),
            None => {
                let is_before = patch.y.low.is_infinite();
                let row = if is_before { 0 } else { self.y.len() - 1 };
                let mut constant = [[0.0; 4]; 4];
                constant[0][0] = 1.0;
                ([row, row], constant)
            }
        };
        // Value and second derivative across, of value and second derivative along.
        let at = |i: usize, j: usize| &self.points[rows[j] * self.x.len() + column + i];
        let told = |p: usize, q: usize| at(p % 2, q % 2)[p / 2 + 2 * (q / 2)];
        std::array::from_fn(|a| {
            std::array::from_fn(|b| {
                let row = |p: usize| (0..4).map(|q| across[b][q] * told(p, q)).sum::<f64>();
                (0..4).map(|p| along[a][p] * row(p)).sum()
            })
        })
    }
}

/// In row n the weights of `u_0`, `u_1`, `m_0`, `m_1` in the n-th derivative at x, on the piece from the first knot.
fn weights(knots: &[f64], x: f64) -> [[f64; 4]; 4] {
    let h = knots[1] - knots[0];
    let (a, b) = ((knots[1] - x) / h, (x - knots[0]) / h);
    let sixth = h / 6.0;
    [
        [a, b, (a * a * a - a) * h * sixth, (b * b * b - b) * h * sixth],
        [-1.0 / h, 1.0 / h, (1.0 - 3.0 * a * a) * sixth, (3.0 * b * b - 1.0) * sixth],
        [0.0, 0.0, a, b],
        [0.0, 0.0, -1.0 / h, 1.0 / h],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(n: i32, length: f64) -> Vec<f64> {
        (0..=n).map(|i| length * f64::from(i) / f64::from(n)).collect()
    }

    /// cos πx cos 2πy, level at all borders of the unit square.
    fn exact([x, y]: [f64; 2]) -> f64 {
        (std::f64::consts::PI * x).cos() * (2.0 * std::f64::consts::PI * y).cos()
    }

    fn spline(n: i32) -> Bicubic {
        let (x, y) = (grid(n, 1.0), grid(2 * n, 1.0));
        let u: Vec<f64> = y.iter().flat_map(|y| x.iter().map(|x| exact([*x, *y]))).collect();
        Bicubic::through(x, y, &u, Ends::Level)
    }

    fn jet_at(spline: &Bicubic, at: [f64; 2]) -> Partials {
        spline.jet(&spline.patch(at, [true; 2], 0.0), at)
    }

    #[test]
    fn the_error_in_height_falls_with_the_fourth_power_of_the_spacing() {
        let error = |n: i32| {
            let spline = spline(n);
            let at = |i: i32| [f64::from(i % 43) / 43.0, f64::from(i % 97) / 97.0];
            (0..4000)
                .map(|i| (jet_at(&spline, at(i))[0][0] - exact(at(i))).abs())
                .fold(0.0, f64::max)
        };
        for n in [8, 16, 32] {
            let order = (error(n) / error(2 * n)).log2();
            assert!((order - 4.0).abs() < 0.2, "order {order} from {n} to {}", 2 * n);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_height() {
        let (spline, h) = (spline(5), 1e-3);
        for at in [[0.13, 0.47], [0.51, 0.09], [0.97, 0.88]] {
            let patch = spline.patch(at, [true; 2], 0.0);
            let jet = |dx: f64, dy: f64| spline.jet(&patch, [at[0] + dx, at[1] + dy]);
            let told = jet(0.0, 0.0);
            for a in 0..4 {
                for b in 0..4 {
                    // Cubics: central differences of derivatives err by the third.
                    let along = (jet(h, 0.0)[a][b] - jet(-h, 0.0)[a][b]) / (2.0 * h);
                    let across = (jet(0.0, h)[a][b] - jet(0.0, -h)[a][b]) / (2.0 * h);
                    let [along_told, across_told] = [
                        told.get(a + 1).map_or(0.0, |row| row[b]),
                        told[a].get(b + 1).map_or(0.0, |d| *d),
                    ];
                    let near =
                        |told: f64, found: f64| (told - found).abs() < 1e-4 * (1.0 + told.abs());
                    assert!(near(along_told, along) && near(across_told, across), "{a} {b}");
                }
            }
        }
    }

    /// Nothing beyond the ends along, and the outermost row beyond those across.
    #[test]
    fn beyond_its_borders_it_is_nothing_or_its_last_row() {
        let spline = spline(6);
        assert_eq!(jet_at(&spline, [1.2, 0.3]), [[0.0; 4]; 4]);
        assert_eq!(jet_at(&spline, [-0.1, 0.3]), [[0.0; 4]; 4]);
        for (beyond, border) in [(-0.4, 0.0), (1.7, 1.0)] {
            let (there, here) = (jet_at(&spline, [0.4, beyond]), jet_at(&spline, [0.4, border]));
            (0..4).for_each(|a| assert!((there[a][0] - here[a][0]).abs() < 1e-12));
            assert!(there.iter().all(|row| row[1..] == [0.0; 3]) && here[0][1].abs() < 1e-12);
        }
    }
}
