//! The boundary between stable and unstable steady motion in the (r, α) plane (Fig. 6).

use super::axis::{Axis, AxisPoint};
use super::critical::{Critical, OnsetKind, bessel_wave_number, by_cosine, unless_stopped};
use super::crossings::Scan;
use super::law::Law;
use super::{StabilityError, corner, limits};
use std::sync::Arc;
use stickslip_tip::cache::Cache;
use stickslip_tip::sorting::{sort_by_number, sort_numbers};
use stickslip_tip::{TipFunction, Wider, stop};

/// αc(r): the smallest α at which a root reaches the imaginary axis. Steady motion is stable below αc.
///
/// Several Ω can belong to one r. All are found by a scan of Ω over the band of the tip function, and the one with the
/// smallest α is returned. For J0 in the basic model, αc = r² and Ω of (47) are exact. The ω of (46), (47) is the Ω of
/// section IV.B, so that the frequency in time is rΩ.
///
/// If the height of the surface under the steady tip is 0, steady motion lies on the kink of |h| in the depth limit (β
/// = 1 without healing). Small deviations then obey an equation that is homogeneous but not linear. The returned α is
/// the one at which a small oscillation of any amplitude neither grows nor decays, marked [`OnsetKind::NonSmooth`].
/// No roots λ exist at this point.
///
/// # Errors
/// r is not a positive finite number, a parameter of the model is out of range, or there is no spring;
/// [`StabilityError::NoCrossing`], also if αc is not finite; or [`StabilityError::Unsettled`].
pub fn critical(law: &Wider, tip: &TipFunction, r: f64) -> Result<Critical, StabilityError> {
    // A map needs it twice at each of the many α of one r.
    static KEPT: Cache<(f64, Wider, TipFunction), Critical> = Cache::new(MOST_KEPT);
    let is_same = |known: &(f64, Wider, TipFunction)| {
        known.0.to_bits() == r.to_bits() && known.1 == *law && known.2 == *tip
    };
    if let Some(known) = KEPT.get(is_same) {
        return Ok(known);
    }
    let found = Boundary::new(law, tip).at(r)?;
    // A cancelled search may be unfinished.
    if !stop::is_requested() {
        KEPT.keep((r, *law, tip.clone()), found);
    }
    Ok(found)
}

/// Number of thresholds that are kept for the next calls.
const MOST_KEPT: usize = 8;

/// The stability boundary of one model and one tip function: the imaginary axis, scanned once for all r.
#[derive(Debug, Clone)]
pub struct Boundary {
    law: Wider,
    search: Search,
}

#[derive(Debug, Clone)]
enum Search {
    /// J0 in the basic model.
    ClosedForm,
    /// The curve (r(Ω), α(Ω)) of (42), (43), in the basic model.
    Curve(Arc<Axis>),
    /// Any model.
    General(Scan),
}

/// A branch of the boundary curve, continuous in Ω.
///
/// There may be several branches, and one of them may turn back in r. Only the lowest α at each r bounds the stable
/// region; the others are further crossings inside the unstable one.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "BranchDocument"))]
#[cfg_attr(
    feature = "schema",
    schemars(description = "A stretch of the curve (42), (43), evenly spaced in Ω.")
)]
pub struct BoundaryBranch {
    /// Ω, ascending, in 1/σ.
    #[cfg_attr(feature = "serde", serde(rename = "Omega"))]
    pub wave_number: Vec<f64>,
    /// r, dimensionless, (42).
    pub r: Vec<f64>,
    /// α, dimensionless, (43).
    pub alpha: Vec<f64>,
}

const NO_CURVE: StabilityError =
    StabilityError::PapersLawOnly("the curve of all crossings in the (r, α) plane");

impl Boundary {
    /// Scans the imaginary axis over the band of `tip`.
    pub fn new(law: &Wider, tip: &TipFunction) -> Self {
        let search = match tip {
            TipFunction::Gaussians(_) if law.is_basic() => Search::Curve(Axis::of(tip)),
            TipFunction::Bessel if law.is_basic() => Search::ClosedForm,
            _ => Search::General(Scan::new(law, tip)),
        };
        Self { law: *law, search }
    }

    /// αc(r), as [`critical`](super::critical), without another scan unless the surface heals.
    ///
    /// # Errors
    /// As [`critical`](super::critical).
    pub fn at(&self, r: f64) -> Result<Critical, StabilityError> {
        Law::judge(&self.law, r)?;
        let none = || unless_stopped(StabilityError::NoCrossing { r });
        match &self.search {
            Search::ClosedForm => Ok(Critical::bessel(r)),
            Search::Curve(axis) => {
                // αc = r/c: the first crossing is the one of the largest c.
                let first = axis.crossings_of_r(r).into_iter().max_by(by_cosine);
                Ok(Critical::on_curve(r, first.ok_or_else(none)?))
            }
            Search::General(scan) => self.first(scan, r)?.ok_or_else(none),
        }
    }

    /// b_c(r), as [`least_depth_limit`](super::least_depth_limit), without another scan unless the surface heals.
    ///
    /// # Errors
    /// As [`least_depth_limit`](super::least_depth_limit), and [`StabilityError::NoLimit`] for Gaussians and J0 in the
    /// basic model, whose boundary is found without a scan.
    pub fn least_depth_limit(&self, r: f64) -> Result<f64, StabilityError> {
        match &self.search {
            Search::General(scan) => limits::least_on(scan, &self.law, r),
            _ => Err(StabilityError::NoLimit("the boundary of the basic law has no depth limit")),
        }
    }

    /// The first crossing in any model, or the non-smooth onset if the steady tip is on the kink of |h|.
    fn first(&self, scan: &Scan, r: f64) -> Result<Option<Critical>, StabilityError> {
        let mut law = scan.law_at(r);
        let crossings = scan.crossings(&law).into_iter();
        let Some(mut first) = crossings.min_by(|a, b| a.density.total_cmp(&b.density)) else {
            return Ok(None);
        };
        let mut kind = OnsetKind::Smooth;
        if let Some(limit) = self.law.depth_limit.filter(|_| scan.has_corner(&law)) {
            first = corner::onset(&law, limit, first).ok_or(StabilityError::Unsettled { limit })?;
            kind = OnsetKind::NonSmooth;
        }
        law.density = first.density;
        let alpha = law.alpha();
        Ok(alpha.is_finite().then(|| Critical::new(alpha, r, kind, first)))
    }

    /// All crossings at this r in the basic model, by increasing α. The first is [`Boundary::at`]; at the others
    /// further pairs of roots reach the imaginary axis.
    ///
    /// # Errors
    /// As [`critical`](super::critical); a model other than the basic one.
    pub fn all_at(&self, r: f64) -> Result<Vec<Critical>, StabilityError> {
        let first = self.at(r)?;
        match &self.search {
            Search::ClosedForm => Ok(vec![first]),
            Search::Curve(axis) => {
                let mut crossings = axis.crossings_of_r(r);
                sort_by_number(&mut crossings, |at| -at.cosine);
                Ok(crossings.into_iter().map(|at| Critical::on_curve(r, at)).collect())
            }
            Search::General(_) => Err(NO_CURVE),
        }
    }

    /// All branches of the curve with `slowest` ≤ r ≤ `fastest`: `points` points in total, evenly spaced in Ω on each
    /// branch, ends included.
    ///
    /// # Errors
    /// [`StabilityError::R`] unless 0 < `slowest` < `fastest`, both finite; [`StabilityError::NoCrossing`] if the
    /// curve has no point in this range; a model other than the basic one.
    pub fn branches(
        &self,
        slowest: f64,
        fastest: f64,
        points: usize,
    ) -> Result<Vec<BoundaryBranch>, StabilityError> {
        [slowest, fastest].into_iter().try_for_each(StabilityError::unless_positive)?;
        if fastest <= slowest {
            return Err(StabilityError::R(fastest));
        }
        let stretches = self.stretches(slowest, fastest)?;
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
    fn stretches(&self, slowest: f64, fastest: f64) -> Result<Vec<(f64, f64)>, StabilityError> {
        let axis = match &self.search {
            Search::ClosedForm => {
                return Ok(vec![(bessel_wave_number(fastest), bessel_wave_number(slowest))]);
            }
            Search::Curve(axis) => axis,
            Search::General(_) => return Err(NO_CURVE),
        };
        let crossings = |r| axis.crossings_of_r(r).into_iter().map(|p| p.wave_number);
        let mut ends: Vec<f64> = crossings(slowest).chain(crossings(fastest)).collect();
        sort_numbers(&mut ends);
        let within = |from: f64, to: f64| {
            let AxisPoint { cosine, sine, .. } = axis.at(0.5 * (from + to));
            cosine > 0.0 && (slowest..=fastest).contains(&(sine / cosine))
        };
        let pairs = ends.windows(2).map(|pair| (pair[0], pair[1]));
        Ok(pairs.filter(|(from, to)| within(*from, *to)).collect())
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
        let Search::Curve(axis) = &self.search else {
            let r = ((1.0 - wave_number) * (1.0 + wave_number)).sqrt() / wave_number.powi(2);
            return (r, r * r);
        };
        let AxisPoint { cosine, sine, .. } = axis.at(wave_number);
        let r = sine / cosine;
        (r, r / cosine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 61 rows of a lobed footprint.
    fn table() -> TipFunction {
        let x: Vec<f64> = (0..=60).map(|i| 0.2 * f64::from(i)).collect();
        let bell = |x: f64| (-0.5 * x * x).exp();
        let f: Vec<f64> = x.iter().map(|x| bell(*x) - 0.4 * bell(x - 2.5)).collect();
        TipFunction::table(&x, &f).unwrap()
    }

    /// Comparison of the basic model with the code for any model: both use the same transforms, but different searches.
    #[test]
    fn branches_of_the_basic_law_find_what_the_general_code_finds() {
        let law = Wider::default();
        let triple = |beta| TipFunction::triple_gaussian(beta, 1.0).unwrap();
        let tips = [
            TipFunction::gaussian(0.7).unwrap(),
            triple(0.0),
            triple(0.6),
            triple(1.0),
            triple(1.9),
            TipFunction::Bessel,
            table(),
        ];
        for tip in tips {
            let special = Boundary::new(&law, &tip);
            let general = Boundary { law, search: Search::General(Scan::new(&law, &tip)) };
            for i in 0..=24 {
                let r = 0.01 * 10_f64.powf(f64::from(i) / 6.0);
                match (special.at(r), general.at(r)) {
                    (Ok(special), Ok(general)) => {
                        let apart = |a: f64, b: f64| (a / b - 1.0).abs();
                        assert!(apart(special.alpha, general.alpha) < 1e-13, "{tip:?} {r}");
                        assert!(apart(special.omega, general.omega) < 1e-13, "{tip:?} {r}");
                        assert!(apart(general.weight, 1.0) < 1e-15);
                    }
                    (special, general) => {
                        assert_eq!(special.is_ok(), general.is_ok(), "{tip:?} {r}")
                    }
                }
            }
        }
    }
}
