//! The past as a density on a lattice, convolved with f' by FFT.

use super::{Memory, longest_look};
use crate::TipFunction;
use crate::collocation::{STAGES, Stages};
use crate::state::{Damaged, Reader, State};
use std::ops::Range;
use stickslip_convolution::{Convolver, Density, Field, Kernel};

/// ∫ f'(x - x0(t'))dt' = f' ∗ ρ with ρ the residence density of the tip, how long it spent where.
///
/// New history is spread onto a lattice that keeps ρ as far as some 12,000 widths about the tip; a window of
/// it is convolved with f' by FFT and read off at the tip. The cost of a step does not depend on how much
/// history lies within reach; a tip that comes back to what was dropped is told so by
/// [`Memory::forgotten`]. For a footprint without reach (J0) the window holds all that was visited and grows
/// with it; the newest steps are then summed directly for a while, so that the longer transforms are
/// shared by several steps.
pub struct Fft {
    tip: TipFunction,
    convolver: Convolver,
    density: Density,
    field: Field,
    /// Position of the tip, relative to an origin that follows it.
    position: f64,
    /// Position and weight of what is not yet in the field.
    pending: Vec<(f64, f64)>,
    most_pending: usize,
    /// All of the past, for a footprint without reach: a longer window has another lattice.
    past: Option<Vec<(f64, f64)>>,
    /// Cells outside of these may have been dropped.
    known: Range<i64>,
}

/// The origin moves by this many cells at a time: positions stay small, so that their differences keep
/// full precision however far the tip travels.
const CELLS_PER_ORIGIN: i64 = 512;

/// Cells of the density kept on either side of the tip, at least: 12,000 widths of a Gaussian. Beyond
/// twice as many are dropped.
const CELLS_KEPT: usize = 1 << 16;
/// And at least so many windows.
const WINDOWS_KEPT: usize = 4;
/// Cells are numbered within these bounds.
const EVERYWHERE: Range<i64> = -(1 << 60)..1 << 60;

/// A transform of this many cells costs about as much as summing one step directly.
const CELLS_PER_DIRECT_STEP: usize = 512;

impl Fft {
    /// Nothing remembered yet.
    #[must_use]
    pub fn new(tip: TipFunction) -> Self {
        Self::with_past(tip, &[])
    }

    /// With a past: displacements from where the tip stands now, and times spent there.
    #[must_use]
    pub fn with_past(tip: TipFunction, past: &[(f64, f64)]) -> Self {
        let look = longest_look(&tip);
        let extent = past.iter().fold(0.0, |m: f64, (x, _)| m.max(x.abs()));
        let separation = match tip.reach() {
            Some(reach) => reach + 2.0 * look,
            None => 2.0 * (extent + look).max(16.0),
        };
        let convolver = plan(&tip, separation);
        let mut memory = Self {
            density: Density::new(convolver.spacing()),
            field: Field::new(),
            position: 0.0,
            pending: past.to_vec(),
            most_pending: most_pending(&convolver),
            known: EVERYWHERE,
            past: tip.reach().is_none().then(|| past.to_vec()),
            tip,
            convolver,
        };
        memory.fold();
        memory
    }

    /// Moves what is pending into the density, and the field to where the tip is now.
    fn fold(&mut self) {
        for (position, weight) in self.pending.drain(..) {
            self.density.add(position, weight);
        }
        if !self.holds_all() {
            let past = self.past.take().unwrap_or_default();
            let relative: Vec<_> = past.iter().map(|(x, w)| (x - self.position, *w)).collect();
            *self = Self::with_past(self.tip.clone(), &relative);
            return;
        }
        if self.position.abs() > 2.0 * CELLS_PER_ORIGIN as f64 * self.convolver.spacing() {
            self.move_origin(CELLS_PER_ORIGIN * self.position.signum() as i64);
        }
        let first = self.convolver.first_cell_about(self.position);
        if self.past.is_none() {
            self.drop_far(first);
        }
        self.convolver.convolve(&self.density, first, &mut self.field);
    }

    /// Drops what lies far from a window that starts at `first`: the density takes no more room, however
    /// far the tip goes.
    fn drop_far(&mut self, first: i64) {
        let (range, kept) = (self.density.range(), self.kept());
        if first - range.start > 2 * kept {
            self.known.start = self.known.start.max(first - kept);
        }
        if range.end - first > 2 * kept {
            self.known.end = self.known.end.min(first + kept);
        }
        self.density.keep(&self.known);
    }

    /// Cells kept on either side of the window.
    fn kept(&self) -> i64 {
        CELLS_KEPT.max(WINDOWS_KEPT * self.convolver.length()) as i64
    }

    /// Whether the window, for a footprint without reach, still spans everything that was visited.
    fn holds_all(&self) -> bool {
        let range = self.density.range();
        if self.past.is_none() || range.is_empty() {
            return true;
        }
        let spacing = self.convolver.spacing();
        let look = longest_look(&self.tip);
        let behind = self.position + look - range.start as f64 * spacing;
        let ahead = range.end as f64 * spacing - self.position + look;
        behind.max(ahead) <= self.convolver.plan().separation
    }

    /// Exact: the spacing has few significant bits.
    fn move_origin(&mut self, cells: i64) {
        let shift = cells as f64 * self.convolver.spacing();
        self.position -= shift;
        self.density.rebase(cells);
        self.known = self.known.start - cells..self.known.end - cells;
        self.past.iter_mut().flatten().for_each(|(x, _)| *x -= shift);
    }
}

fn most_pending(convolver: &Convolver) -> usize {
    STAGES * (convolver.length() / CELLS_PER_DIRECT_STEP).isqrt()
}

/// A separation that a saved state may have: one that a run of some length comes to.
fn within(separation: f64, tip: &TipFunction) -> Result<f64, Damaged> {
    let allowed = tip.reach().is_none() && (1.0..=1e6).contains(&separation);
    if allowed { Ok(separation) } else { Err(Damaged::OutOfRange) }
}

fn plan(tip: &TipFunction, separation: f64) -> Convolver {
    let slope = |x: f64| tip.slope(x);
    Convolver::new(&Kernel { value: &slope, band: tip.band(), reach: tip.reach() }, separation)
}

impl Memory for Fft {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        for i in 0..STAGES {
            let x = self.position + at[i];
            (slope[i], curvature[i]) = self.field.value_and_derivative(x);
            for (position, weight) in &self.pending {
                let (f1, f2) = self.tip.slope_and_curvature(x - position);
                slope[i] += weight * f1;
                curvature[i] += weight * f2;
            }
        }
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        let here = self.position;
        let nodes = position.iter().zip(weight).map(|(p, w)| (here + p, *w));
        self.pending.extend(nodes.clone());
        if let Some(past) = &mut self.past {
            past.extend(nodes);
        }
        self.position += position[STAGES - 1];
        let strayed = !self.field_holds(self.position);
        if self.pending.len() >= self.most_pending || strayed {
            self.fold();
        }
    }

    fn name(&self) -> &'static str {
        "fft"
    }

    fn save(&self, state: &mut State) {
        state.number(self.position);
        state.number(self.convolver.plan().separation);
        state.pairs(self.pending.iter());
        state.flag(self.past.is_some());
        state.pairs(self.past.iter().flatten().collect::<Vec<_>>().into_iter());
        let (first, sums, excess) = self.density.parts();
        state.whole(first);
        state.numbers(sums.iter().copied());
        state.numbers(excess.iter().copied());
        state.whole(self.field.first_cell());
        [self.known.start, self.known.end].into_iter().for_each(|cell| state.whole(cell));
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.position = state.finite()?;
        let separation = state.finite()?;
        if separation.to_bits() != self.convolver.plan().separation.to_bits() {
            self.convolver = plan(&self.tip, within(separation, &self.tip)?);
        }
        self.most_pending = most_pending(&self.convolver);
        self.pending = state.pairs()?;
        let past = (state.flag()?, state.pairs()?);
        self.past = past.0.then_some(past.1);
        let (first, sums, excess) = (state.whole()?, state.numbers()?, state.numbers()?);
        let density = Density::from_parts(self.convolver.spacing(), first, sums, excess);
        self.density = density.ok_or(Damaged::OutOfRange)?;
        self.convolver.convolve(&self.density, state.whole()?, &mut self.field);
        self.known = state.whole()?..state.whole()?;
        if self.field_holds(self.position) && self.stands_on_its_past() {
            return Ok(());
        }
        Err(Damaged::OutOfRange)
    }

    fn forgotten(&self) -> Option<f64> {
        let first = self.field.first_cell();
        let seen = first..first + self.convolver.length() as i64;
        let forgot = seen.start < self.known.start || seen.end > self.known.end;
        forgot.then(|| self.kept() as f64 * self.convolver.spacing())
    }
}

impl Fft {
    /// Whether the tip is where it has been and, unless that is all kept, near the origin.
    fn stands_on_its_past(&self) -> bool {
        let (cells, cell) = (self.density.range(), self.position / self.convolver.spacing());
        let about = |cells: &Range<i64>| {
            (cells.start as f64 - 1.0..=cells.end as f64 + 1.0).contains(&cell)
        };
        let near = self.past.is_some() || cell.abs() <= 4.0 * CELLS_PER_ORIGIN as f64;
        near && (cells.is_empty() || about(&cells))
    }

    /// Whether the field is right wherever the tip may look from x.
    fn field_holds(&self, x: f64) -> bool {
        let look = longest_look(&self.tip);
        let range = self.field.range();
        range.contains(&(x - look)) && range.contains(&(x + look))
    }
}
