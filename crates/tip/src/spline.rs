//! The cubic spline through given points, with two derivatives: for initial surfaces, measured forces and unevenly
//! sampled footprints. (No crate found yields the derivatives.)

/// Cubic spline through (x_i, y_i).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CubicSpline {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Second derivatives at the knots.
    m: Vec<f64>,
}

impl CubicSpline {
    /// The spline with this condition at both ends. The callers ensure that `x` increases, is as long as `y`, and
    /// contains at least two points.
    pub(crate) fn through(x: Vec<f64>, y: Vec<f64>, ends: Ends) -> Self {
        let m = second_derivatives(&x, &y, ends);
        Self { x, y, m }
    }

    pub(crate) fn first(&self) -> f64 {
        self.x[0]
    }

    pub(crate) fn last(&self) -> f64 {
        self.x[self.x.len() - 1]
    }

    pub(crate) fn value(&self, x: f64) -> f64 {
        self.jet(x).0
    }

    /// Value, first and second derivative at x; the end pieces continue beyond the ends.
    pub(crate) fn jet(&self, x: f64) -> (f64, f64, f64) {
        self.jet_on(self.piece_of(x), x)
    }

    /// Value, first and second derivative of the polynomial of a piece, evaluated at any x.
    pub(crate) fn jet_on(&self, piece: usize, x: f64) -> (f64, f64, f64) {
        let (low, high) = self.ends_of(piece);
        let h = high - low;
        let (b, a) = ((x - low) / h, (high - x) / h);
        let (y0, y1) = (self.y[piece], self.y[piece + 1]);
        let (m0, m1) = (self.m[piece], self.m[piece + 1]);
        let value = a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0;
        let slope = (y1 - y0) / h + ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0) * h / 6.0;
        (value, slope, a * m0 + b * m1)
    }

    /// The third derivative on a piece.
    pub(crate) fn third_on(&self, piece: usize) -> f64 {
        let (low, high) = self.ends_of(piece);
        (self.m[piece + 1] - self.m[piece]) / (high - low)
    }

    /// Second derivatives at the knots.
    pub(crate) fn curvatures(&self) -> &[f64] {
        &self.m
    }

    pub(crate) fn knots(&self) -> &[f64] {
        &self.x
    }

    /// The piece between knots that contains x, or the nearest one.
    pub(crate) fn piece_of(&self, x: f64) -> usize {
        piece_of(&self.x, x)
    }

    /// The knots at both ends of a piece.
    fn ends_of(&self, piece: usize) -> (f64, f64) {
        (self.x[piece], self.x[piece + 1])
    }
}

/// The piece between knots that contains x, or the nearest one.
pub(crate) fn piece_of(knots: &[f64], x: f64) -> usize {
    knots.partition_point(|knot| *knot <= x).clamp(1, knots.len() - 1) - 1
}

/// The first knot above x, or infinity.
pub(crate) fn next_knot(knots: &[f64], x: f64) -> f64 {
    knots.get(knots.partition_point(|knot| *knot <= x)).copied().unwrap_or(f64::INFINITY)
}

/// The derivative that vanishes at both ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ends {
    /// The second derivative: the natural spline.
    Straight,
    /// The first derivative.
    Level,
}

/// The second derivatives at the knots: solves their tridiagonal, diagonally dominant system by Thomas's algorithm.
fn second_derivatives(x: &[f64], y: &[f64], ends: Ends) -> Vec<f64> {
    let last = x.len() - 1;
    let h = |i: usize| x[i + 1] - x[i];
    let slope = |i: usize| (y[i + 1] - y[i]) / h(i);
    // Neighbours to the left and right, diagonal, right-hand side.
    let row = |i: usize| match (i, ends) {
        (i, Ends::Straight) if i == 0 || i == last => [0.0, 0.0, 1.0, 0.0],
        (0, Ends::Level) => [0.0, h(0), 2.0 * h(0), 6.0 * slope(0)],
        (i, Ends::Level) if i == last => [h(i - 1), 0.0, 2.0 * h(i - 1), -6.0 * slope(i - 1)],
        (i, _) => [h(i - 1), h(i), 2.0 * (h(i - 1) + h(i)), 6.0 * (slope(i) - slope(i - 1))],
    };
    let mut m = vec![0.0; x.len()];
    let mut upper = vec![0.0; x.len()];
    for i in 0..=last {
        let [left, right, diagonal, wanted] = row(i);
        let (upper_before, m_before) = if i == 0 { (0.0, 0.0) } else { (upper[i - 1], m[i - 1]) };
        let pivot = diagonal - left * upper_before;
        upper[i] = right / pivot;
        m[i] = (wanted - left * m_before) / pivot;
    }
    for i in (0..last).rev() {
        m[i] -= upper[i] * m[i + 1];
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_in_value_falls_with_the_fourth_power_of_the_spacing() {
        let error = |n: i32| {
            let x: Vec<f64> = (0..=n).map(|i| f64::from(i) / f64::from(n)).collect();
            // sin(πx) has vanishing second derivatives at both ends, as the natural spline has.
            let y = x.iter().map(|x| (std::f64::consts::PI * x).sin()).collect();
            let spline = CubicSpline::through(x, y, Ends::Straight);
            let at = |i: i32| f64::from(i) / 1000.0;
            let miss = |x: f64| spline.value(x) - (std::f64::consts::PI * x).sin();
            (0..=1000).map(|i| miss(at(i)).abs()).fold(0.0, f64::max)
        };
        for n in [8, 16, 32, 64] {
            let order = (error(n) / error(2 * n)).log2();
            assert!((order - 4.0).abs() < 0.1, "order {order} from {n} to {}", 2 * n);
        }
    }

    #[test]
    fn a_level_spline_ends_level_and_is_as_accurate_where_the_function_is() {
        let error = |n: i32| {
            let x: Vec<f64> = (0..=n).map(|i| f64::from(i) / f64::from(n)).collect();
            let y = x.iter().map(|x| (std::f64::consts::PI * x).cos()).collect();
            let spline = CubicSpline::through(x, y, Ends::Level);
            assert!(spline.jet(0.0).1.abs() < 1e-13 && spline.jet(1.0).1.abs() < 1e-13);
            let at = |i: i32| f64::from(i) / 1000.0;
            let miss = |x: f64| spline.value(x) - (std::f64::consts::PI * x).cos();
            (0..=1000).map(|i| miss(at(i)).abs()).fold(0.0, f64::max)
        };
        for n in [8, 16, 32, 64] {
            let order = (error(n) / error(2 * n)).log2();
            assert!((order - 4.0).abs() < 0.1, "order {order} from {n} to {}", 2 * n);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_value() {
        let x = vec![0.0, 0.3, 1.0, 1.2, 2.0];
        let y = vec![1.0, -0.5, 0.2, 0.9, 0.0];
        let spline = CubicSpline::through(x, y, Ends::Straight);
        for x in [0.1, 0.5, 1.1, 1.7] {
            let h = 1e-4;
            let (_, slope, curvature) = spline.jet(x);
            assert!((slope - (spline.value(x + h) - spline.value(x - h)) / (2.0 * h)).abs() < 1e-6);
            let second = spline.value(x + h) - 2.0 * spline.value(x) + spline.value(x - h);
            assert!((curvature - second / (h * h)).abs() < 1e-5);
        }
    }
}
