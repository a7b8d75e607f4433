//! The past as a few complex numbers: f' on one side is a sum of exponentials.

mod accuracy;
mod bank;
mod certificate;
mod fit;
mod local;
mod pencil;
mod powers;
mod prepared;
mod standard;
mod term;
mod weights;
mod window;

pub(crate) use accuracy::FINEST_OF_SWINGING;
pub use accuracy::{accuracy_needed, displacement};
pub(crate) use bank::{ExpandedPart, LANES as TERMS, LOWEST_DEGREE, Terms, expansion_lengths};
pub use certificate::FitCertificate;
pub use fit::{Fit, FitError};
pub(crate) use local::HIGHEST_DEGREE;
pub(crate) use prepared::Prepared;
pub use term::Term;
pub use window::Retreat;

use super::derivatives::{Derivatives, ROOM, SteadyPast};
use super::groove::Groove;
use crate::elementary::{complex_exp, larger};
use crate::sorting::ends_of;
use crate::state::{Damaged, Reader, State};
use bank::Bank;
use local::LocalGroove;
use num_complex::Complex;
use std::sync::Arc;

/// With f'(ξ) ≈ `Σ_j Re(w_j e^{s_j ξ})` for ξ ≥ -(allowed retreat), the slope of the groove at a displacement ξ from
/// the tip is `Σ_j Re(w_j z_j e^{s_j ξ})`. The state `z_j = ∫ e^{s_j (x_tip - x0(t'))}dt'` contains the whole past. It
/// decays as the tip moves on, and the cost of a step is constant.
///
/// The error is that of the [`Fit`], as long as the groove is evaluated no farther back than the retreat behind the
/// farthest point of the tip.
pub(super) struct Modes {
    fit: Arc<Fit>,
    bank: Bank,
    prepared: Arc<Prepared>,
    groove: LocalGroove,
    /// The farthest-forward position, as a displacement from the tip.
    farthest: f64,
}

/// Radius of an expansion, relative to that of the requested points: the next iteration of Newton's method requests
/// points close to them.
const BEYOND_THE_STAGES: f64 = 1.05;

impl Modes {
    pub(super) fn new(fit: Arc<Fit>) -> Self {
        let prepared = Prepared::cached(&fit);
        let (bank, groove) = (Bank::new(&prepared.bank), LocalGroove::nowhere());
        Self { bank, prepared, groove, farthest: f64::NEG_INFINITY, fit }
    }

    pub(super) fn fit(&self) -> &Fit {
        &self.fit
    }

    /// Whether the sum is valid at all these displacements.
    pub(super) fn reach_back_to(&self, at: &[f64]) -> bool {
        let lowest = at.iter().copied().fold(f64::INFINITY, f64::min);
        lowest >= self.farthest - self.fit.retreat()
    }

    /// Whether the tip has retreated so far that the next step may evaluate the groove where the sum is invalid.
    pub(super) fn retreated(&self) -> bool {
        self.farthest > self.fit.retreat_between_steps()
    }

    /// Distance of the tip behind its farthest point.
    pub(super) fn behind(&self) -> f64 {
        self.farthest
    }

    /// Records a displacement at which the tip has been.
    pub(super) fn reached(&mut self, position: f64) {
        self.farthest = self.farthest.max(position);
    }

    /// As [`Policy::remember`](crate::memory::Policy::remember).
    pub(super) fn remember(&mut self, position: &[f64], weight: &[f64]) {
        self.pass(position);
        self.bank.advance(position, weight);
    }

    pub(super) fn scale(&mut self, factor: f64) {
        self.bank.scale(factor);
        self.groove.forget();
    }

    /// Records positions without adding them to the state, while it is not in use.
    pub(super) fn pass(&mut self, position: &[f64]) {
        let Some(moved) = position.last() else { return };
        self.farthest = larger(ends_of(position).1, self.farthest) - moved;
        self.groove.forget();
    }

    /// Computes the state anew from displacements from the tip, and times spent there.
    pub(super) fn sum_up(&mut self, visits: impl Iterator<Item = (f64, f64)>) {
        self.bank.clear();
        self.groove.forget();
        visits.for_each(|(position, weight)| self.bank.add(position, weight));
    }

    /// As [`Policy::groove`](crate::memory::Policy::groove), where the sum is valid.
    pub(super) fn groove(&mut self, at: &[f64], groove: &mut Groove<'_>) {
        if !self.groove.holds(at) {
            let (low, high) = ends_of(at);
            let (center, radius) = (0.5 * (low + high), 0.5 * BEYOND_THE_STAGES * (high - low));
            if !self.bank.expand(center, radius, &mut self.groove, groove.height.is_some()) {
                self.groove.forget();
                self.one_by_one(at, groove);
                return;
            }
        }
        self.groove.read(at, groove.slope, groove.curvature);
        if let Some(height) = &mut groove.height {
            self.groove.read_height(at, height, |center| self.bank.height(center));
        }
    }

    /// The groove at each point separately, where no polynomial is accurate.
    fn one_by_one(&self, at: &[f64], groove: &mut Groove<'_>) {
        let told = groove.slope.iter_mut().zip(groove.curvature.iter_mut());
        for (at, (slope, curvature)) in at.iter().zip(told) {
            (*slope, *curvature) = self.bank.at(*at);
        }
        if let Some(heights) = &mut groove.height {
            for (at, height) in at.iter().zip(heights.iter_mut()) {
                *height = self.bank.height(*at);
            }
        }
    }

    /// As [`Policy::derivatives`](crate::memory::Policy::derivatives), with the state multiplied by `left`.
    pub(super) fn derivatives(
        &self,
        steady: Option<&SteadyPast>,
        left: f64,
        count: usize,
        found: &mut Derivatives,
    ) -> &[f64; ROOM] {
        (found.farthest, found.retreat) = (self.farthest, self.fit.retreat());
        let mut room = std::mem::take(&mut found.room);
        self.bank.all_states(left, &mut room);
        if let Some(past) = steady {
            for (z, term) in room.chunks_exact_mut(2).zip(self.fit.terms()) {
                let fading: Complex<f64> = past.velocity * term.exponent - past.healing;
                let steady = -past.weight / fading * complex_exp(term.exponent * past.distance);
                z[0] += steady.re;
                z[1] += steady.im;
            }
        }
        self.prepared.powers.derivatives(&room, count, &mut found.past);
        found.room = room;
        &self.prepared.powers.of_tip
    }

    pub(super) fn save(&self, state: &mut State) {
        self.bank.save(state);
        state.number(self.farthest);
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.bank.restore(state)?;
        self.groove.forget();
        self.farthest = state.number()?;
        Ok(())
    }
}
