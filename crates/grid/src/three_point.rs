//! The paper's grid: heights, with the slope by differences.

use crate::Footprint;
use crate::patch::Patch;
use crate::scheme::{Scheme, sample};

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
