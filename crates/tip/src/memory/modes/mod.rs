//! The past as a few complex numbers: f' on one side is a sum of exponentials.

mod accuracy;
mod bank;
mod certificate;
mod fit;
mod past;
mod pencil;
mod term;
mod weights;

pub use accuracy::accuracy_needed;
pub use certificate::FitCertificate;
pub use fit::{Fit, FitError};
pub use term::Term;

use super::{Fft, Memory};
use crate::TipFunction;
use crate::collocation::{STAGES, Stages};
use crate::state::{Damaged, Reader, State};
use bank::{Bank, LocalGroove};
use past::Past;
use std::sync::Arc;

/// With f'(ξ) ≈ `Σ_j Re(w_j e^{s_j ξ})` for ξ ≥ -δ, the groove at `at` from the tip is
/// `Σ_j Re(w_j z_j e^{s_j at})`, and the state `z_j = ∫ e^{s_j (x_tip - x0(t'))}dt'` is all of the past: it fades as
/// the tip moves on, and a step costs the same for ever.
///
/// As exact as the [`Fit`], as long as the tip looks no farther back than δ behind the farthest point that
/// it has been to. A step that retreats further goes over to [`Fft`], which knows the past from a record
/// kept beside the state; when the tip has regained its farthest point the state is summed afresh.
/// The record spans 4096 bins, 2000 to 4000 widths; a tip that retreats beyond it is told so by
/// [`Memory::forgotten`].
pub struct Modes {
    tip: TipFunction,
    fit: Arc<Fit>,
    bank: Bank,
    groove: LocalGroove,
    /// The farthest-forward position, as a displacement from the tip.
    farthest: f64,
    past: Past,
    /// In use while the tip has retreated.
    fft: Option<Box<Fft>>,
    retreats: u64,
    forgotten: bool,
}

/// An expansion is made to hold a little beyond the stages that ask for it: Newton's next iteration asks
/// nearby.
const BEYOND_THE_STAGES: f64 = 1.05;
/// A retreat by more than this fraction of δ, between steps, leaves too little for the looks of the next.
const SHARE_OF_RETREAT: f64 = 0.5;

impl Modes {
    /// Nothing remembered yet; f' fitted to an error of at most `accuracy`.
    ///
    /// # Errors
    /// A footprint that the sum cannot represent so well.
    pub fn new(tip: TipFunction, accuracy: f64) -> Result<Self, FitError> {
        let fit = Fit::cached(&tip, accuracy)?;
        Self::with_fit(tip, fit)
    }

    /// Nothing remembered yet; f' as in the fit given, however good that is.
    ///
    /// # Errors
    /// A footprint that never fades.
    pub fn with_fit(tip: TipFunction, fit: Arc<Fit>) -> Result<Self, FitError> {
        let reach = tip.reach().ok_or(FitError::NeverFades)?;
        Ok(Self {
            bank: Bank::new(&fit),
            groove: LocalGroove::nowhere(),
            farthest: f64::NEG_INFINITY,
            past: Past::new(&tip, reach),
            fft: None,
            retreats: 0,
            forgotten: false,
            fit,
            tip,
        })
    }

    /// Which the past (displacements from the tip, weights) is put into at once.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_past(
        tip: TipFunction,
        accuracy: f64,
        past: &[(f64, f64)],
    ) -> Result<Self, FitError> {
        let mut modes = Self::new(tip, accuracy)?;
        for &(position, weight) in past {
            modes.past.add(position, weight);
            modes.farthest = modes.farthest.max(position);
        }
        if modes.farthest > SHARE_OF_RETREAT * modes.fit.retreat() {
            modes.hand_over();
        } else {
            modes.take_back();
        }
        Ok(modes)
    }

    /// The sum in use.
    #[must_use]
    pub fn fit(&self) -> &Fit {
        &self.fit
    }

    /// The definition, for a look farther back than the sum holds: an iteration gone astray, or the last
    /// step before a retreat is noticed.
    fn look_back(&self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        let low = at.iter().copied().fold(f64::INFINITY, f64::min);
        let high = at.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (*slope, *curvature) = ([0.0; STAGES], [0.0; STAGES]);
        for (position, weight) in self.past.near(low, high) {
            for i in 0..STAGES {
                let (f1, f2) = self.tip.slope_and_curvature(at[i] - position);
                slope[i] += weight * f1;
                curvature[i] += weight * f2;
            }
        }
    }

    /// The sum where it holds.
    fn look(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        if !self.groove.holds(at) {
            let low = at.iter().copied().fold(f64::INFINITY, f64::min);
            let high = at.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let (center, radius) = (0.5 * (low + high), 0.5 * BEYOND_THE_STAGES * (high - low));
            if !self.bank.expand(center, radius, &mut self.groove) {
                self.groove.forget();
                for i in 0..STAGES {
                    (slope[i], curvature[i]) = self.bank.at(at[i]);
                }
                return;
            }
        }
        self.groove.read(at, slope, curvature);
    }

    fn hand_over(&mut self) {
        let past: Vec<_> = self.past.all().collect();
        self.fft = Some(Box::new(Fft::with_past(self.tip.clone(), &past)));
        self.retreats += 1;
    }

    fn take_back(&mut self) {
        self.fft = None;
        self.bank.clear();
        for (position, weight) in self.past.near(0.0, 0.0) {
            self.bank.add(position, weight);
        }
    }
}

impl Memory for Modes {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        let low = at.iter().copied().fold(f64::INFINITY, f64::min);
        if let Some(fft) = &mut self.fft {
            fft.groove(at, slope, curvature);
        } else if low < self.farthest - self.fit.retreat() {
            self.look_back(at, slope, curvature);
        } else {
            self.look(at, slope, curvature);
        }
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        let moved = position[STAGES - 1];
        let farthest = position.iter().copied().fold(self.farthest, f64::max) - moved;
        self.farthest = farthest;
        self.past.remember(position, weight);
        self.groove.forget();
        let lowest = position.iter().copied().fold(f64::INFINITY, f64::min);
        self.forgotten |= self.past.forgot(lowest - moved);
        if let Some(fft) = &mut self.fft {
            fft.remember(position, weight);
            if farthest <= 0.0 {
                self.take_back();
            }
        } else {
            self.bank.advance(position, weight);
            if farthest > SHARE_OF_RETREAT * self.fit.retreat() {
                self.hand_over();
            }
        }
    }

    fn name(&self) -> &'static str {
        "modes"
    }

    fn save(&self, state: &mut State) {
        self.bank.save(state);
        state.number(self.farthest);
        self.past.save(state);
        state.count(self.retreats);
        state.flag(self.forgotten);
        state.flag(self.fft.is_some());
        self.fft.iter().for_each(|fft| fft.save(state));
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.bank.restore(state)?;
        self.groove.forget();
        self.farthest = state.number()?;
        self.past.restore(state)?;
        (self.retreats, self.forgotten) = (state.count()?, state.flag()?);
        self.fft = None;
        if state.flag()? {
            let mut fft = Box::new(Fft::new(self.tip.clone()));
            fft.restore(state)?;
            self.fft = Some(fft);
        }
        Ok(())
    }

    fn note(&self) -> Option<String> {
        let FitCertificate { slope, area, .. } = self.fit.certificate();
        let fit = format!(
            "{} exponentials fit f' to {slope:.1e}, and the force on a tip of velocity v to {area:.1e} alpha/v",
            self.fit.terms().len()
        );
        Some(match self.retreats {
            0 => fit,
            n => format!(
                "{fit}; {n} times the tip retreated beyond them, and fft took over until it was back"
            ),
        })
    }

    fn forgotten(&self) -> Option<f64> {
        self.forgotten.then(|| self.past.kept())
    }
}
