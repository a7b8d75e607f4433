//! The choice between `direct`, `fft` and `modes`, which is made in this file only.

mod retreats;
mod saved;

use super::choice::{CROSSOVER_NODES, CROSSOVER_STEPS, MemoryChoice};
use super::derivatives::{Derivatives, ROOM, SteadyPast};
use super::direct;
use super::fading::Fading;
use super::fft::{Fft, Lattice};
use super::groove::Groove;
use super::modes::{Fit, FitError, Modes, Retreat};
use super::record::Record;
use super::report::{MemoryReport, Sum};
use crate::TipFunction;
use crate::sorting::ends_of;
use retreats::Retreats;
use std::sync::Arc;

/// The memory of a run: one history buffer, and the algorithm chosen for it.
///
/// `direct` sums over the buffer itself. `modes` needs the buffer when the tip retreats: then [`Fft`](Sum::Fft) is
/// built from the buffer and replaces the modes. When the tip is at its farthest point again, the modes are computed
/// anew from the buffer, which spans 2048 bins, 1,024 widths of a Gaussian. `fft` for a footprint without reach
/// builds longer lattices from the buffer; for a footprint with reach the lattice is sufficient, and there is no
/// buffer.
pub struct Policy {
    tip: TipFunction,
    choice: MemoryChoice,
    /// Allowed error of f' for `modes`.
    accuracy: f64,
    back: Retreat,
    record: Option<Record>,
    now: Now,
    fading: Fading,
    /// Scratch space for the scaled weights.
    measured: Vec<f64>,
}

/// The algorithm in use.
enum Now {
    Direct,
    Fft(Box<Fft>, Option<FitError>),
    Modes(Box<Modes>, Retreats),
}

impl Policy {
    /// An empty memory. `modes`, if chosen, fit f' with an error of at most `accuracy`, for a tip that retreats as
    /// far as `back` states.
    ///
    /// # Errors
    /// `modes` is requested, but exponentials cannot represent the footprint to this accuracy.
    pub fn new(
        choice: MemoryChoice,
        tip: TipFunction,
        accuracy: f64,
        back: Retreat,
    ) -> Result<Self, FitError> {
        let nothing = || std::iter::empty();
        let (record, now) = match choice {
            MemoryChoice::Auto | MemoryChoice::Direct => (Some(Record::whole(&tip)), Now::Direct),
            MemoryChoice::Fft => with_fft(&tip, nothing(), None),
            MemoryChoice::Modes => with_modes(&tip, Fit::cached(&tip, accuracy, back)?, nothing()),
        };
        Ok(Self::of((choice, accuracy), tip, back, (record, now)))
    }

    /// The sum of these exponentials, whatever its accuracy.
    ///
    /// # Errors
    /// A footprint that does not decay.
    pub fn with_fit(tip: TipFunction, fit: Arc<Fit>) -> Result<Self, FitError> {
        tip.reach().ok_or(FitError::NeverFades)?;
        let requested = (MemoryChoice::Modes, fit.wanted());
        let sum = with_modes(&tip, fit, std::iter::empty());
        Ok(Self::of(requested, tip, Retreat::Small, sum))
    }

    fn of(
        (choice, accuracy): (MemoryChoice, f64),
        tip: TipFunction,
        back: Retreat,
        (record, now): (Option<Record>, Now),
    ) -> Self {
        let (fading, measured) = (Fading::default(), vec![]);
        Self { tip, choice, accuracy, back, record, now, fading, measured }
    }

    /// The memory in use, and the reason for it.
    pub fn report(&self) -> MemoryReport {
        let sum = match &self.now {
            Now::Direct => Sum::Direct,
            Now::Fft(_, why) => Sum::Fft { instead_of_modes: *why },
            Now::Modes(modes, retreats) => Sum::Modes {
                terms: modes.fit().terms().len(),
                certificate: modes.fit().certificate(),
                retreats: retreats.count,
            },
        };
        MemoryReport { choice: self.choice, accuracy: self.accuracy, sum }
    }

    /// The distance behind the farthest point within which the past is kept, if the tip has retreated beyond it: its
    /// motion is then not reliable. `None` otherwise.
    pub fn forgotten(&self) -> Option<f64> {
        match &self.now {
            Now::Fft(fft, _) => fft.forgotten(),
            // They hold wherever the tip goes, and need no record.
            Now::Modes(modes, _) if modes.fit().retreat().is_infinite() => None,
            Now::Direct | Now::Modes(..) => self.record.as_ref().and_then(Record::forgotten),
        }
    }

    /// Changes to another algorithm if it is cheaper after the nodes just added.
    fn decide(&mut self) {
        let Some(record) = &self.record else { return };
        match &mut self.now {
            Now::Direct => {
                if self.choice == MemoryChoice::Auto
                    && is_long(record)
                    && let Some(other) = self.without_direct(record.all())
                {
                    (self.record, self.now) = other;
                }
            }
            Now::Modes(modes, retreats) if retreats.fft.is_some() => {
                if modes.behind() <= 0.0 {
                    retreats.fft = None;
                    modes.sum_up(record.near(0.0, 0.0));
                } else {
                    retreats.continue_retreat(&self.tip, record, modes.behind());
                }
            }
            Now::Modes(modes, retreats) => {
                if modes.retreated() {
                    retreats.begin(&self.tip, record, modes.behind());
                }
            }
            Now::Fft(..) => {}
        }
    }

    /// The successor of a direct sum; `None` after a cancellation, so that a resumed run decides anew.
    fn without_direct(
        &self,
        past: impl Iterator<Item = (f64, f64)>,
    ) -> Option<(Option<Record>, Now)> {
        Some(match Fit::cached(&self.tip, self.accuracy, self.back) {
            Ok(fit) => with_modes(&self.tip, fit, past),
            Err(FitError::Stopped) => return None,
            Err(why) => with_fft(&self.tip, past, Some(why)),
        })
    }

    /// Adds nodes with weights in the scale of the algorithm in use.
    fn remember_scaled(&mut self, position: &[f64], weight: &[f64]) {
        if let Some(record) = &mut self.record {
            record.remember(position, weight);
        }
        match &mut self.now {
            Now::Direct => {}
            Now::Fft(fft, _) => {
                let lattice = fft.remember(position, weight);
                if let Some(record) = &mut self.record {
                    follow(lattice, &self.tip, record, fft);
                }
            }
            Now::Modes(modes, Retreats { fft: Some(fft), .. }) => {
                modes.pass(position);
                // It is one of a footprint with reach: the lattice holds for any position.
                fft.remember(position, weight);
            }
            Now::Modes(modes, _) => modes.remember(position, weight),
        }
        self.decide();
    }

    /// The groove in the scale of the algorithm in use.
    fn groove_scaled(&mut self, at: &[f64], groove: &mut Groove<'_>) {
        match (&mut self.now, &self.record) {
            (Now::Fft(fft, _), _) => fft.groove(at, groove),
            (Now::Modes(_, Retreats { fft: Some(fft), .. }), _) => fft.groove(at, groove),
            (Now::Direct, Some(record)) => direct::groove(record, &self.tip, at, groove),
            (Now::Modes(modes, _), Some(record)) => {
                if modes.reach_back_to(at) {
                    modes.groove(at, groove);
                } else {
                    // An iteration gone astray, or the last step before a retreat is noticed.
                    let (low, high) = ends_of(at);
                    groove.clear();
                    for visit in record.near(low, high) {
                        direct::add(&[visit], &self.tip, (0.0, at), groove);
                    }
                }
            }
            (Now::Direct | Now::Modes(..), None) => unreachable!("they have a record"),
        }
    }

    #[cold]
    fn scale(&mut self, factor: f64) {
        self.record.iter_mut().for_each(|record| record.scale(factor));
        match &mut self.now {
            Now::Direct => {}
            Now::Fft(fft, _) => fft.scale(factor),
            Now::Modes(modes, retreats) => {
                modes.scale(factor);
                retreats.fft.iter_mut().for_each(|fft| fft.scale(factor));
            }
        }
    }
}

/// Positions are displacements from the present position of the tip.
impl Policy {
    /// Adds nodes to the history: the tip spent the time `weight[j]` at `position[j]`, and is now at the last of
    /// these positions. The weights may contain the relative indentation rate.
    pub fn remember(&mut self, position: &[f64], weight: &[f64]) {
        let Some(left) = self.fading.left() else { return self.remember_scaled(position, weight) };
        let mut measured = std::mem::take(&mut self.measured);
        measured.clear();
        measured.extend(weight.iter().map(|weight| weight / left));
        self.remember_scaled(position, &measured);
        self.measured = measured;
    }

    /// Multiplies all weights by this factor, at most 1, for a surface that heals.
    pub fn fade(&mut self, factor: f64) {
        if let Some(scale) = self.fading.by(factor) {
            self.scale(scale);
        }
    }

    /// Evaluates the groove at the points x = tip + `at`, each at most [`longest_look`](super::longest_look) from the
    /// tip.
    pub fn groove(&mut self, at: &[f64], groove: &mut Groove<'_>) {
        self.groove_scaled(at, groove);
        if let Some(left) = self.fading.left() {
            groove.scale(left);
        }
    }

    /// Computes `count` derivatives of the groove at the tip, including those of a steady past before the first node.
    /// Returns the derivatives of f at 0, on the side of the past, which a unit of time spent at the present position adds
    /// to them; `None` if no series is valid at every point that the next step may reach.
    pub fn derivatives(
        &self,
        steady: Option<&SteadyPast>,
        count: usize,
        found: &mut Derivatives,
    ) -> Option<&[f64; ROOM]> {
        let Now::Modes(modes, Retreats { fft: None, .. }) = &self.now else { return None };
        Some(modes.derivatives(steady, self.fading.left().unwrap_or(1.0), count, found))
    }
}

/// Whether a direct sum costs more than the other memories.
fn is_long(record: &Record) -> bool {
    record.nodes_within_reach() > CROSSOVER_NODES || record.steps() > CROSSOVER_STEPS
}

/// The modes with their buffer; a lattice replaces them if the tip has already retreated too far.
fn with_modes(
    tip: &TipFunction,
    fit: Arc<Fit>,
    past: impl Iterator<Item = (f64, f64)>,
) -> (Option<Record>, Now) {
    let (mut modes, mut retreats) = (Box::new(Modes::new(fit)), Retreats::default());
    let record = Record::bounded(tip).with(past.inspect(|(position, _)| modes.reached(*position)));
    if modes.retreated() {
        retreats.begin(tip, &record, modes.behind());
    } else {
        modes.sum_up(record.near(0.0, 0.0));
    }
    (Some(record), Now::Modes(modes, retreats))
}

fn with_fft(
    tip: &TipFunction,
    past: impl Iterator<Item = (f64, f64)>,
    instead_of_modes: Option<FitError>,
) -> (Option<Record>, Now) {
    if tip.reach().is_some() {
        return (None, Now::Fft(Box::new(Fft::new(tip, past)), instead_of_modes));
    }
    let record = Record::on_lattice(tip).with(past);
    let fft = Box::new(Fft::new(tip, record.all()));
    (Some(record), Now::Fft(fft, instead_of_modes))
}

/// Updates buffer and lattice after a change of the lattice: the buffer has the same origin, and a longer lattice is
/// built from it.
fn follow(lattice: Lattice, tip: &TipFunction, record: &mut Record, fft: &mut Fft) {
    match lattice {
        Lattice::Same => {}
        Lattice::Moved(shift) => record.move_origin(shift),
        Lattice::Outgrown => {
            *record = Record::on_lattice(tip).with(record.all());
            *fft = Fft::new(tip, record.all());
        }
    }
}
