//! The past as a density on a lattice, convolved with f' by FFT.

mod saved;

use super::direct;
use super::groove::{Groove, longest_look};
use crate::TipFunction;
use crate::collocation::STAGES;
use std::ops::Range;
use stickslip_convolution::{Convolver, Density, Field, Kernel};

/// ∫ f'(x - x0(t'))dt' = f' ∗ ρ with ρ the residence density of the tip: time spent per length.
///
/// New nodes are spread onto a lattice that keeps ρ within some 12,000 widths of the tip. A window of the lattice is
/// convolved with f' by FFT and evaluated at the tip. The cost of a step does not depend on the length of the history
/// within reach. [`forgotten`](Self::forgotten) reports whether the tip returned to positions that were dropped. For
/// a footprint without reach (J0) the window contains all positions and grows with them; the newest steps are then
/// summed directly for a while, so that several steps share each of the longer transforms.
pub(crate) struct Fft {
    tip: TipFunction,
    convolver: Convolver,
    density: Density,
    field: Field,
    /// The field of heights, if heights have been requested.
    heights: Option<Heights>,
    /// Position of the tip, relative to an origin that moves with it.
    position: f64,
    /// Positions and weights of nodes that are not yet in the field.
    pending: Vec<(f64, f64)>,
    most_pending: usize,
    /// Range of cells outside of which cells may have been dropped.
    known: Range<i64>,
}

/// The density convolved with f on the same lattice.
struct Heights {
    convolver: Convolver,
    field: Field,
    /// Whether the field belongs to the present density.
    current: bool,
}

/// Change of the lattice when nodes were added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Lattice {
    /// No change.
    Same,
    /// The origin moved by this distance.
    Moved(f64),
    /// The lattice no longer spans all positions, for a footprint without reach, and must be built anew.
    Outgrown,
}

/// Number of cells by which the origin moves: positions remain small, so that their differences keep full precision
/// however far the tip travels.
const CELLS_PER_ORIGIN: i64 = 512;

/// Least number of cells of the density kept on either side of the tip: 12,000 widths of a Gaussian. Cells are dropped
/// beyond twice this number.
const CELLS_KEPT: usize = 1 << 16;
/// Least number of windows kept.
const WINDOWS_KEPT: usize = 4;
/// The range of cells while none has been dropped.
const EVERYWHERE: Range<i64> = -(1 << 60)..1 << 60;

/// Number of cells for which a transform takes about as long as a direct sum over one step.
const CELLS_PER_DIRECT_STEP: usize = 512;

impl Fft {
    /// A lattice with a past: displacements from the present position of the tip, and times spent there.
    pub(crate) fn new(tip: &TipFunction, past: impl Iterator<Item = (f64, f64)>) -> Self {
        let pending: Vec<_> = past.collect();
        let look = longest_look(tip);
        let extent = pending.iter().fold(0.0, |m: f64, (x, _)| m.max(x.abs()));
        let separation = match tip.reach() {
            Some(reach) => reach + 2.0 * look,
            None => 2.0 * (extent + look).max(16.0),
        };
        let convolver = plan(tip, separation);
        let mut fft = Self {
            tip: tip.clone(),
            density: Density::new(convolver.spacing()),
            field: Field::new(),
            heights: None,
            position: 0.0,
            pending,
            most_pending: most_pending(&convolver),
            known: EVERYWHERE,
            convolver,
        };
        // The window has just been made to hold it all.
        fft.fold();
        fft
    }

    /// As [`Policy::remember`](crate::memory::Policy::remember).
    pub(crate) fn remember(&mut self, position: &[f64], weight: &[f64]) -> Lattice {
        let Some(moved) = position.last() else { return Lattice::Same };
        let here = self.position;
        self.pending.extend(position.iter().zip(weight).map(|(p, w)| (here + p, *w)));
        self.position += moved;
        let strayed = !self.field_holds(self.position);
        if self.pending.len() >= self.most_pending || strayed { self.fold() } else { Lattice::Same }
    }

    /// As [`Policy::groove`](crate::memory::Policy::groove).
    pub(super) fn groove(&mut self, at: &[f64], groove: &mut Groove<'_>) {
        let told = groove.slope.iter_mut().zip(groove.curvature.iter_mut());
        for (at, (slope, curvature)) in at.iter().zip(told) {
            (*slope, *curvature) = self.field.value_and_derivative(self.position + at);
        }
        if let Some(heights) = &mut groove.height {
            let here = self.position;
            let field = self.heights();
            for (at, height) in at.iter().zip(heights.iter_mut()) {
                *height = field.value(here + at);
            }
        }
        direct::add(&self.pending, &self.tip, (self.position, at), groove);
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.pending.iter_mut().for_each(|(_, weight)| *weight *= factor);
        self.density.scale(factor);
        let first = self.field.first_cell();
        self.convolver.convolve(&self.density, first, &mut self.field);
        self.heights.iter_mut().for_each(|heights| heights.current = false);
    }

    /// Height, slope and curvature at a displacement from the tip, after [`prepare`](Self::prepare).
    pub(crate) fn jet(&self, at: f64) -> [f64; 3] {
        let x = self.position + at;
        let (slope, curvature) = self.field.value_and_derivative(x);
        let height = self.heights.as_ref().map_or(0.0, |heights| heights.field.value(x));
        let mut jet = [height, slope, curvature];
        for (position, weight) in &self.pending {
            let distance = x - position;
            let (slope, curvature) = self.tip.slope_and_curvature(distance);
            let of_node = [self.tip.value(distance), slope, curvature];
            jet.iter_mut().zip(of_node).for_each(|(sum, of_node)| *sum += weight * of_node);
        }
        jet
    }

    /// Brings the field of heights up to date.
    pub(crate) fn prepare(&mut self) {
        self.heights();
    }

    /// A lattice without a past, for a tip at the same position about the same origin.
    pub(crate) fn empty_copy(&self) -> Self {
        let mut copy = Self::new(&self.tip, std::iter::empty());
        (copy.position, copy.known) = (self.position, self.known.clone());
        copy.convolver.convolve(&copy.density, self.field.first_cell(), &mut copy.field);
        copy
    }

    /// Changes the densities of lattices for the same nodes with different weights: `change` gets the densities of all
    /// lattices, cell by cell.
    pub(crate) fn mix(all: &mut [Self], change: impl FnOnce(&mut [f64])) {
        all.iter_mut().for_each(|fft| {
            fft.fold();
        });
        let ranges = all.iter().map(|fft| fft.density.range()).filter(|range| !range.is_empty());
        let union = |a: Range<i64>, b: Range<i64>| a.start.min(b.start)..a.end.max(b.end);
        let Some(cells) = ranges.reduce(union) else { return };
        let (count, length) = (all.len(), (cells.end - cells.start) as usize);
        let mut table = vec![0.0; count * length];
        let mut column = vec![0.0; length];
        for (m, fft) in all.iter().enumerate() {
            fft.density.copy_window(cells.start, &mut column);
            table.iter_mut().skip(m).step_by(count).zip(&column).for_each(|(to, from)| *to = *from);
        }
        change(&mut table);
        for (m, fft) in all.iter_mut().enumerate() {
            let sums: Vec<f64> = table.iter().skip(m).step_by(count).copied().collect();
            let spacing = fft.convolver.spacing();
            let density = Density::from_parts(spacing, cells.start, sums, vec![0.0; length]);
            fft.density = density.unwrap_or_else(|| Density::new(spacing));
            fft.scale(1.0);
        }
    }

    /// Distance behind the farthest point within which no position is dropped.
    pub(crate) fn retreat(&self) -> f64 {
        (self.kept() - self.convolver.length() as i64) as f64 * self.convolver.spacing()
    }

    /// Number of real numbers in the lattice and its fields.
    pub(crate) fn size(&self) -> usize {
        let range = self.density.range();
        2 * (range.end - range.start) as usize
            + 2 * self.convolver.length()
            + 2 * self.pending.len()
    }

    /// Adds pending nodes to the density, and moves the field to the present position of the tip.
    fn fold(&mut self) -> Lattice {
        for (position, weight) in self.pending.drain(..) {
            self.density.add(position, weight);
        }
        if !self.holds_all() {
            return Lattice::Outgrown;
        }
        let mut lattice = Lattice::Same;
        if self.position.abs() > 2.0 * CELLS_PER_ORIGIN as f64 * self.convolver.spacing() {
            lattice = self.move_origin(CELLS_PER_ORIGIN * self.position.signum() as i64);
        }
        let first = self.convolver.first_cell_about(self.position);
        if !self.keeps_all() {
            self.drop_far(first);
        }
        self.convolver.convolve(&self.density, first, &mut self.field);
        self.heights.iter_mut().for_each(|heights| heights.current = false);
        lattice
    }

    fn heights(&mut self) -> &Field {
        let new = || {
            let value = |x: f64| self.tip.value(x);
            let kernel = kernel(&self.tip, &value);
            let convolver = Convolver::with_plan(&kernel, *self.convolver.plan());
            Heights { convolver, field: Field::new(), current: false }
        };
        let heights = self.heights.get_or_insert_with(new);
        if !heights.current {
            let first = self.field.first_cell();
            heights.convolver.convolve(&self.density, first, &mut heights.field);
            heights.current = true;
        }
        &heights.field
    }

    /// Drops cells far from a window that starts at `first`, so that the size of the density is bounded however far
    /// the tip travels.
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

    /// Number of cells kept on either side of the window.
    fn kept(&self) -> i64 {
        CELLS_KEPT.max(WINDOWS_KEPT * self.convolver.length()) as i64
    }

    /// Whether no cells are ever dropped.
    fn keeps_all(&self) -> bool {
        self.tip.reach().is_none()
    }

    /// Whether the window, for a footprint without reach, still spans all positions.
    fn holds_all(&self) -> bool {
        let range = self.density.range();
        if !self.keeps_all() || range.is_empty() {
            return true;
        }
        let spacing = self.convolver.spacing();
        let look = longest_look(&self.tip);
        let behind = self.position + look - range.start as f64 * spacing;
        let ahead = range.end as f64 * spacing - self.position + look;
        behind.max(ahead) <= self.convolver.plan().separation
    }

    /// Moves the origin. This is exact, because the spacing has few significant bits.
    fn move_origin(&mut self, cells: i64) -> Lattice {
        let shift = cells as f64 * self.convolver.spacing();
        self.position -= shift;
        self.density.rebase(cells);
        self.known = self.known.start - cells..self.known.end - cells;
        Lattice::Moved(shift)
    }

    /// Whether the field is valid at every point that the memory may evaluate for a tip at x.
    fn field_holds(&self, x: f64) -> bool {
        let look = longest_look(&self.tip);
        let range = self.field.range();
        range.contains(&(x - look)) && range.contains(&(x + look))
    }

    /// Distance within which the past is kept, if the tip has returned to cells that were dropped; `None` otherwise.
    pub(super) fn forgotten(&self) -> Option<f64> {
        let first = self.field.first_cell();
        let seen = first..first + self.convolver.length() as i64;
        let forgot = seen.start < self.known.start || seen.end > self.known.end;
        forgot.then(|| self.kept() as f64 * self.convolver.spacing())
    }
}

fn most_pending(convolver: &Convolver) -> usize {
    STAGES * (convolver.length() / CELLS_PER_DIRECT_STEP).isqrt()
}

fn plan(tip: &TipFunction, separation: f64) -> Convolver {
    let slope = |x: f64| tip.slope(x);
    Convolver::new(&kernel(tip, &slope), separation)
}

/// f or a derivative of it.
fn kernel<'a>(tip: &TipFunction, value: &'a (dyn Fn(f64) -> f64 + Sync)) -> Kernel<'a> {
    Kernel { value, band: tip.band(), reach: tip.reach() }
}
