//! The boundary between stable and unstable steady motion in the (r, α) plane (Fig. 6).

use super::axis::{Axis, AxisPoint};
use super::critical::{Critical, bessel_wave_number, first_crossing};
use super::{StabilityError, critical};
use stickslip_tip::TipFunction;

/// The curve (r(Ω), α(Ω)) of (42), (43) for one tip function, sampled once for all r.
#[derive(Debug, Clone)]
pub struct Boundary {
    tip: TipFunction,
    /// `None` for J0, which has closed forms.
    axis: Option<Axis>,
}

/// A stretch of the curve on which Ω runs without a gap.
///
/// Where there are several, or where one of them turns back in r, only the lowest α at each r bounds
/// the stable region; the others are further crossings inside the unstable one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BoundaryBranch {
    /// Ω = ω/r, ascending.
    pub wave_number: Vec<f64>,
    /// (42)
    pub r: Vec<f64>,
    /// (43)
    pub alpha: Vec<f64>,
}

impl Boundary {
    /// Scans the imaginary axis over the band of `tip`.
    #[must_use]
    pub fn new(tip: &TipFunction) -> Self {
        let axis = (!matches!(tip, TipFunction::Bessel)).then(|| Axis::new(tip));
        Self { tip: tip.clone(), axis }
    }

    /// αc(r), as [`critical`], without scanning again.
    ///
    /// # Errors
    /// As [`critical`].
    pub fn at(&self, r: f64) -> Result<Critical, StabilityError> {
        match &self.axis {
            Some(axis) if r.is_finite() && r > 0.0 => first_crossing(axis, r),
            _ => critical(&self.tip, r),
        }
    }

    /// Every crossing at this r, by rising α: the first is [`Boundary::at`], the others are where
    /// further pairs of roots reach the imaginary axis.
    ///
    /// # Errors
    /// As [`critical`].
    pub fn all_at(&self, r: f64) -> Result<Vec<Critical>, StabilityError> {
        let first = self.at(r)?;
        let Some(axis) = &self.axis else { return Ok(vec![first]) };
        let critical = |p: &AxisPoint| Critical::new(r / p.cosine, r, p.wave_number);
        let mut all: Vec<Critical> = axis.crossings_of_r(r).iter().map(critical).collect();
        all.sort_by(|a, b| a.alpha.total_cmp(&b.alpha));
        Ok(all)
    }

    /// All stretches of the curve with `slowest` ≤ r ≤ `fastest`, `points` points in all, evenly spaced
    /// in Ω on each, ends included.
    ///
    /// # Errors
    /// [`StabilityError::R`] unless 0 < `slowest` < `fastest`, both finite, or
    /// [`StabilityError::NoCrossing`] if the curve has no such stretch.
    pub fn branches(
        &self,
        slowest: f64,
        fastest: f64,
        points: usize,
    ) -> Result<Vec<BoundaryBranch>, StabilityError> {
        for r in [slowest, fastest] {
            if !(r.is_finite() && r > 0.0) {
                return Err(StabilityError::R(r));
            }
        }
        if fastest <= slowest {
            return Err(StabilityError::R(fastest));
        }
        let stretches = self.stretches(slowest, fastest);
        let total: f64 = stretches.iter().map(|(from, to)| to - from).sum();
        if stretches.is_empty() || total <= 0.0 {
            return Err(StabilityError::NoCrossing { r: slowest });
        }
        let share = |(from, to): &(f64, f64)| {
            #[expect(
                clippy::cast_precision_loss,
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a share of a number of points"
            )]
            let count = (points as f64 * (to - from) / total).round().max(2.0) as u32;
            self.sampled(*from, *to, count)
        };
        Ok(stretches.iter().map(share).collect())
    }

    /// Intervals of Ω on which (42) gives r within the bounds.
    fn stretches(&self, slowest: f64, fastest: f64) -> Vec<(f64, f64)> {
        let Some(axis) = &self.axis else {
            return vec![(bessel_wave_number(fastest), bessel_wave_number(slowest))];
        };
        let crossings = |r| axis.crossings_of_r(r).into_iter().map(|p| p.wave_number);
        let mut ends: Vec<f64> = crossings(slowest).chain(crossings(fastest)).collect();
        ends.sort_by(f64::total_cmp);
        let within = |from: f64, to: f64| {
            let AxisPoint { cosine, sine, .. } = axis.at(0.5 * (from + to));
            cosine > 0.0 && (slowest..=fastest).contains(&(sine / cosine))
        };
        let pairs = ends.windows(2).map(|pair| (pair[0], pair[1]));
        pairs.filter(|(from, to)| within(*from, *to)).collect()
    }

    fn sampled(&self, from: f64, to: f64, count: u32) -> BoundaryBranch {
        let mut branch = BoundaryBranch::default();
        for i in 0..count {
            let wave_number = from + (to - from) * f64::from(i) / f64::from(count - 1);
            let (r, alpha) = self.point(wave_number);
            branch.wave_number.push(wave_number);
            branch.r.push(r);
            branch.alpha.push(alpha);
        }
        branch
    }

    /// (r, α) of (42), (43).
    fn point(&self, wave_number: f64) -> (f64, f64) {
        let Some(axis) = &self.axis else {
            let r = ((1.0 - wave_number) * (1.0 + wave_number)).sqrt() / wave_number.powi(2);
            return (r, r * r);
        };
        let AxisPoint { cosine, sine, .. } = axis.at(wave_number);
        let r = sine / cosine;
        (r, r / cosine)
    }
}
