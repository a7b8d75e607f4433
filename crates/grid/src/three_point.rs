//! The paper's grid: heights, with the slope by differences.

use crate::patch::Patch;
use crate::scheme::{Scheme, sample, sample_at};
use crate::{Footprint, GridError};

/// Cells contain u(x_j). With j the cell to the left of x and s = x/h - j,
///
/// u_x(x) ≈ (1-s) (u_{j+1} - u_{j-1})/2h + s (u_{j+2} - u_j)/2h:
///
/// central differences, interpolated linearly. Second order: the error is
/// (1/6 + s(1-s)/2) h² u''' + O(h³), continuous in x, with a kink at every cell.
pub(crate) struct ThreePoint<'a> {
    pub(crate) footprint: Footprint<'a>,
    pub(crate) spacing: f64,
}

impl ThreePoint<'_> {
    /// The cell at or to the left of x, and the distance of x from it, in cells.
    fn locate(&self, x: f64) -> (i64, f64) {
        let left = (x / self.spacing).floor();
        (left as i64, x / self.spacing - left)
    }
}

impl Scheme for ThreePoint<'_> {
    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn imprint(&self, tip: f64, out: &mut Patch) {
        sample(&self.footprint, self.spacing, tip, out);
    }

    fn slope_stencil(&self, x: f64, out: &mut Patch) {
        let (left, s) = self.locate(x);
        out.reset(left - 1, 4);
        let unit = 0.5 / self.spacing;
        out.values.copy_from_slice(&[-(1.0 - s) * unit, -s * unit, (1.0 - s) * unit, s * unit]);
    }

    fn height_stencil(&self, x: f64, out: &mut Patch) {
        let (left, s) = self.locate(x);
        out.reset(left, 2);
        out.values.copy_from_slice(&[1.0 - s, s]);
    }
}

/// [`ThreePoint`] with all N + 1 cells of a fixed grid written at every stage, as in the paper.
pub(crate) struct WholeGrid<'a> {
    grid: ThreePoint<'a>,
    first: i64,
    len: usize,
}

impl<'a> WholeGrid<'a> {
    pub(crate) fn new(grid: ThreePoint<'a>, from: f64, to: f64) -> Result<Self, GridError> {
        let first = (from / grid.spacing).ceil();
        let len = (to / grid.spacing).floor() - first + 1.0;
        if !(4.0..=2_147_483_648.0).contains(&len) {
            return Err(GridError::Domain { from, to });
        }
        Ok(Self { grid, first: first as i64, len: len as usize })
    }

    /// The positions of a tip that reads cells of this grid only.
    pub(crate) fn inside(&self) -> std::ops::Range<f64> {
        let last = self.first + self.len as i64 - 1;
        (self.first + 1) as f64 * self.grid.spacing..(last - 1) as f64 * self.grid.spacing
    }
}

impl Scheme for WholeGrid<'_> {
    fn spacing(&self) -> f64 {
        self.grid.spacing
    }

    fn imprint(&self, tip: f64, out: &mut Patch) {
        out.reset(self.first, self.len);
        sample_at(&self.grid.footprint, self.grid.spacing, tip, out);
    }

    fn slope_stencil(&self, x: f64, out: &mut Patch) {
        self.grid.slope_stencil(x, out);
    }

    fn height_stencil(&self, x: f64, out: &mut Patch) {
        self.grid.height_stencil(x, out);
    }
}
