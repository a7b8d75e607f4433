//! Position R(t) of the support of the spring.

use crate::series::{SeriesError, checked};
use crate::spline::{next_knot, piece_of};
use std::sync::Arc;
use thiserror::Error;

/// The motion of the support.
#[derive(Debug, Clone, PartialEq)]
pub enum Support {
    /// A support of constant velocity: R = rt.
    Moving(f64),
    /// A support on a given path.
    Path(Arc<SupportPath>),
    /// No support, because there is no spring; R is set to 0.
    None,
}

/// A piecewise linear R(t) from t = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportPath {
    /// R at t = 0.
    start: f64,
    /// Knots: times, and displacements from the start.
    t: Vec<f64>,
    displacement: Vec<f64>,
}

/// Errors in a path.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PathError {
    /// The path is not a function of time.
    #[error("the path of the support: {0}")]
    Series(#[from] SeriesError),
    /// The first row is not t = 0, R = 0.
    #[error(
        "the path of the support begins at t = {t:?}, R = {displacement:?}: times and displacements count from the start of the run, so that its first row is 0,0"
    )]
    Start {
        /// Time of the first row.
        t: f64,
        /// Displacement of the first row.
        displacement: f64,
    },
}

impl SupportPath {
    /// A piecewise linear path through these knots; times and displacements are relative to the start of the run.
    ///
    /// # Errors
    /// Fewer than three rows, columns of different lengths, a number that is not finite, times that do not increase, or
    /// a first row other than 0, 0.
    pub fn new(t: Vec<f64>, displacement: Vec<f64>) -> Result<Self, PathError> {
        let (t, displacement) = checked(t, displacement)?;
        if t[0].abs() > 0.0 || displacement[0].abs() > 0.0 {
            return Err(PathError::Start { t: t[0], displacement: displacement[0] });
        }
        Ok(Self { start: 0.0, t, displacement })
    }

    /// The same path with this position at t = 0.
    #[must_use]
    pub fn starting_at(self, start: f64) -> Self {
        Self { start, ..self }
    }

    /// The last time of the path.
    pub fn end(&self) -> f64 {
        self.t[self.t.len() - 1]
    }

    /// Knots: times, and displacements from the start.
    pub fn knots(&self) -> (&[f64], &[f64]) {
        (&self.t, &self.displacement)
    }

    /// Velocity on the piece that contains t; at a knot, on the piece after it.
    fn velocity(&self, t: f64) -> f64 {
        let piece = piece_of(&self.t, t);
        let [from, to] = [piece, piece + 1].map(|i| (self.t[i], self.displacement[i]));
        (to.1 - from.1) / (to.0 - from.0)
    }

    fn displacement(&self, t: f64) -> f64 {
        let piece = piece_of(&self.t, t);
        self.displacement[piece] + self.velocity(t) * (t - self.t[piece])
    }
}

impl Support {
    /// Position R(t).
    pub fn position(&self, t: f64) -> f64 {
        match self {
            Self::Moving(r) => r * t,
            Self::Path(path) => path.start + path.displacement(t),
            Self::None => 0.0,
        }
    }

    /// Advance R(t + dt) - R(t), for dt ≥ 0 within the piece that contains t or begins there.
    pub fn advance(&self, t: f64, dt: f64) -> f64 {
        self.velocity(t) * dt
    }

    /// Velocity R'(t); at a knot, the velocity after the knot.
    pub fn velocity(&self, t: f64) -> f64 {
        match self {
            Self::Moving(r) => *r,
            Self::Path(path) => path.velocity(t),
            Self::None => 0.0,
        }
    }

    /// The next time after t at which a step must end.
    pub(crate) fn next_break(&self, t: f64) -> f64 {
        match self {
            Self::Path(path) => next_knot(&path.t, t),
            Self::Moving(_) | Self::None => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_straight_between_its_knots() {
        let path = SupportPath::new(vec![0.0, 2.0, 3.0, 5.0], vec![0.0, 4.0, 4.0, 0.0]).unwrap();
        let support = Support::Path(Arc::new(path.starting_at(10.0)));
        for (t, position, velocity, next) in [
            (0.0, 10.0, 2.0, 2.0),
            (1.0, 12.0, 2.0, 2.0),
            (2.0, 14.0, 0.0, 3.0),
            (4.0, 12.0, -2.0, 5.0),
            (5.0, 10.0, -2.0, f64::INFINITY),
        ] {
            assert!((support.position(t) - position).abs() < 1e-14, "{t}");
            assert!((support.velocity(t) - velocity).abs() < 1e-14, "{t}");
            assert!(support.next_break(t) >= next && support.next_break(t) <= next, "{t}");
        }
        assert!((support.advance(3.0, 0.5) + 1.0).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_function_of_time_from_zero_on_is_refused() {
        let refused = |t: &[f64], r: &[f64]| SupportPath::new(t.to_vec(), r.to_vec()).is_err();
        assert!(refused(&[0.0, 1.0, 1.0], &[0.0, 1.0, 2.0]));
        assert!(refused(&[0.5, 1.0, 2.0], &[0.0, 1.0, 2.0]));
        assert!(refused(&[0.0, 1.0, 2.0], &[1.0, 1.0, 2.0]));
        assert!(refused(&[0.0, 1.0, f64::NAN], &[0.0, 1.0, 2.0]));
    }
}
