//! The initial surface u0(x).
//!
//! The initial surface is a sum of reliefs. An infinite steady past is the profile (24), a flat start is no relief,
//! noise and a measured profile are splines. Equation (15) contains the force of u0 with a factor α; according to (14)
//! it is -u0'(x0), because u0 is a height.

use crate::Model;
use crate::memory::ROOM;
use crate::relief::{Piece, Relief};

/// The initial surface u0(x), a sum of reliefs.
#[derive(Debug, Clone, Default)]
pub struct InitialSurface {
    reliefs: Vec<Relief>,
}

/// A stretch of x on which u0 is one smooth function: between the breaks of its reliefs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stretch {
    /// Ends of the stretch, with their slack.
    pub(crate) ends: Piece,
    /// Whether u0 = 0 within the largest distance at which a step evaluates it.
    pub(crate) flat: bool,
    /// The number of the piece of each relief.
    pieces: Vec<Option<usize>>,
}

impl InitialSurface {
    /// u0 = 0.
    pub fn flat() -> Self {
        Self::default()
    }

    /// The groove of a tip in steady motion, now at `position`.
    pub fn steady(model: &Model, position: f64) -> Self {
        Self::flat().with(Relief::steady(model, position))
    }

    /// Whether u0 = 0 everywhere.
    pub fn is_flat(&self) -> bool {
        self.reliefs.is_empty()
    }

    /// Adds a relief.
    #[must_use]
    pub fn with(mut self, relief: Relief) -> Self {
        self.reliefs.push(relief);
        self
    }

    /// u0(x).
    pub fn height(&self, x: f64) -> f64 {
        let carved = |relief: &&Relief| relief.steady_position().is_some();
        let carved = self.reliefs.iter().filter(carved).fold(0.0, |sum, r| sum + r.height(x));
        carved + self.texture(x)
    }

    /// u0(x) without the groove of steady motion (24).
    pub fn texture(&self, x: f64) -> f64 {
        let texture = |relief: &&Relief| relief.steady_position().is_none();
        self.reliefs.iter().filter(texture).fold(0.0, |sum, r| sum + r.height(x))
    }

    /// The end of the given profile and the noise, if there are any.
    pub fn texture_ends(&self) -> Option<f64> {
        self.reliefs.iter().filter_map(Relief::end).reduce(f64::max)
    }

    /// Position of the tip whose groove in steady motion, (24), is part of u0; `None` if no such groove is.
    pub fn steady_position(&self) -> Option<f64> {
        self.reliefs.iter().find_map(Relief::steady_position)
    }

    /// u0'(x) and u0''(x).
    pub fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        sum(self.reliefs.iter().map(|relief| relief.slope_and_curvature(x)))
    }

    /// u0' and u0'' of the smooth function that equals u0 on the stretch, evaluated at any x, so that everything is
    /// smooth within a step that begins there.
    pub(crate) fn slope_and_curvature_on(&self, stretch: &Stretch, x: f64) -> (f64, f64) {
        let told = self.reliefs.iter().zip(&stretch.pieces);
        sum(told.map(|(relief, piece)| relief.slope_and_curvature_on(*piece, x)))
    }

    /// Sets `jet` to u0 and its derivatives on the stretch, without the groove of steady motion. Returns the number of
    /// entries that may differ from 0, or `None` if derivatives are unknown.
    pub(crate) fn jet_on(&self, stretch: &Stretch, x: f64, jet: &mut [f64; ROOM]) -> Option<usize> {
        if stretch.flat || self.reliefs.is_empty() {
            return Some(0);
        }
        jet.fill(0.0);
        let mut reliefs = self.reliefs.iter().zip(&stretch.pieces);
        let add = |most: usize, (relief, piece): (&Relief, &Option<usize>)| {
            Some(most.max(relief.add_jet_on(*piece, x, jet)?))
        };
        reliefs.try_fold(0, add)
    }

    /// The height at x of the function of [`slope_and_curvature_on`](Self::slope_and_curvature_on).
    pub(crate) fn height_on(&self, stretch: &Stretch, x: f64) -> f64 {
        let told = self.reliefs.iter().zip(&stretch.pieces);
        told.map(|(relief, piece)| relief.height_on(*piece, x)).sum()
    }

    /// Error of u0' due to the rounding of x, per unit of curvature: 0 where u0 is flat.
    pub(crate) fn rounding(&self, x: f64) -> f64 {
        let textured = self.reliefs.iter().any(|relief| relief.covers(x));
        if textured { f64::EPSILON * x.abs() } else { 0.0 }
    }

    /// Sets `stretch` to the stretch that contains a tip at x, or that the tip is about to enter if it is at a break; x
    /// has an error of at most `accuracy`.
    pub(crate) fn enter(&self, stretch: &mut Stretch, x: f64, forward: bool, accuracy: f64) {
        stretch.ends = Piece::EVERYWHERE;
        stretch.pieces.clear();
        stretch.flat = true;
        for relief in &self.reliefs {
            let piece = relief.piece(x, forward, accuracy);
            stretch.ends.narrow(&piece);
            stretch.flat &= relief.is_flat_about(&piece, x);
            stretch.pieces.push(piece.index);
        }
    }
}

fn sum(terms: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    terms.fold((0.0, 0.0), |(slope, curvature), (s, c)| (slope + s, curvature + c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Noise, TipFunction};

    fn model() -> Model {
        Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 0.8).unwrap()
    }

    /// Two profiles and two noises: as many reliefs as there are, in any order.
    fn surface() -> (InitialSurface, Vec<Relief>) {
        let x: Vec<f64> = (0..30).map(|i| 5.0 + 0.7 * f64::from(i)).collect();
        let u = |k: f64| x.iter().map(|x| 0.3 * (k * x).sin()).collect::<Vec<_>>();
        let noise = |seed| Noise { amplitude: 0.01, spacing: 0.31, seed };
        let reliefs = vec![
            Relief::noise(noise(1), 0.0, 20.0),
            Relief::profile(x.clone(), u(1.1)).unwrap(),
            Relief::steady(&model(), 14.0),
            Relief::noise(noise(2), 10.0, 40.0),
            Relief::profile(x.clone(), u(0.3)).unwrap(),
        ];
        (reliefs.iter().cloned().fold(InitialSurface::flat(), InitialSurface::with), reliefs)
    }

    #[test]
    fn a_surface_is_the_sum_of_its_reliefs() {
        let (surface, reliefs) = surface();
        for i in 0..500 {
            let x = -3.0 + 0.1 * f64::from(i);
            let height: f64 = reliefs.iter().map(|r| r.height(x)).sum();
            assert!((surface.height(x) - height).abs() < 1e-15);
            let slope: f64 = reliefs.iter().map(|r| r.slope_and_curvature(x).0).sum();
            assert!((surface.slope_and_curvature(x).0 - slope).abs() < 1e-15);
        }
        assert_eq!(surface.steady_position(), Some(14.0));
    }

    #[test]
    fn slopes_and_curvatures_are_those_of_the_height() {
        let (surface, _) = surface();
        let h = 1e-4;
        for i in 0..300 {
            let x = 1.0 + 0.113 * f64::from(i);
            // Where a spline ends with a slope there is a corner.
            if [5.0, 20.15, 10.0, 20.0, 25.3, 40.0].iter().any(|end| (x - end).abs() < 0.4) {
                continue;
            }
            let (slope, curvature) = surface.slope_and_curvature(x);
            let difference = (surface.height(x + h) - surface.height(x - h)) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-6, "{x}: {slope} {difference}");
            let slopes = [x + h, x - h].map(|x| surface.slope_and_curvature(x).0);
            let difference = (slopes[0] - slopes[1]) / (2.0 * h);
            assert!((curvature - difference).abs() < 1e-3, "{x}: {curvature} {difference}");
        }
    }

    #[test]
    fn a_stretch_lies_between_the_breaks_of_all_reliefs() {
        let (surface, reliefs) = surface();
        let mut stretch = Stretch::default();
        for i in 0..400 {
            let x = -2.0 + 0.117 * f64::from(i);
            surface.enter(&mut stretch, x, true, 1e-12);
            assert!(stretch.ends.low <= x && x < stretch.ends.high, "{x} {stretch:?}");
            assert_eq!(stretch.pieces.len(), reliefs.len());
            let on = surface.slope_and_curvature_on(&stretch, x);
            assert_eq!(on, surface.slope_and_curvature(x), "{x}");
            // Beyond its ends it goes on without a break.
            let (here, beyond) = (stretch.ends.high - 1e-9, stretch.ends.high + 1e-9);
            if stretch.ends.high.is_finite() {
                let at = |x| surface.slope_and_curvature_on(&stretch, x);
                assert!((at(here).1 - at(beyond).1).abs() < 1e-6, "{x}");
            }
        }
    }
}
