//! The interface of a discretisation.

use crate::GridError;
use crate::patch::Patch;

/// Cells x_j = j h, with a rule for writing and a rule for reading.
///
/// The cells contain numbers w_j with w_j' = -α `imprint`(x_j - x0); the surface (or, for a scheme that stores only
/// the groove, its difference from u0) is a fixed linear combination of them.
pub(crate) trait Scheme {
    /// Spacing h.
    fn spacing(&self) -> f64;
    /// The imprint of the tip at `tip`, within its reach.
    fn imprint(&self, tip: f64, out: &mut Patch);
    /// Weights of the cells in the sum for u_x at `x`.
    fn slope_stencil(&self, x: f64, out: &mut Patch);
    /// Weights of the cells in the sum for u at `x`.
    fn height_stencil(&self, x: f64, out: &mut Patch);
}

/// The cells within `reach` of `x`: first index and count.
pub(crate) fn cells_within(x: f64, reach: f64, spacing: f64) -> (i64, usize) {
    let first = ((x - reach) / spacing).ceil() as i64;
    let last = ((x + reach) / spacing).floor() as i64;
    (first, usize::try_from(last + 1 - first).unwrap_or(0))
}

/// Samples of f at the cells within its reach.
pub(crate) fn sample(footprint: &crate::Footprint, spacing: f64, tip: f64, out: &mut Patch) {
    let (first, len) = cells_within(tip, footprint.reach(), spacing);
    out.reset(first, len);
    sample_at(footprint, spacing, tip, out);
}

/// Samples of f at the cells of a patch.
pub(crate) fn sample_at(footprint: &crate::Footprint, spacing: f64, tip: f64, out: &mut Patch) {
    for (value, cell) in out.values.iter_mut().zip(out.first..) {
        *value = footprint.value(cell as f64 * spacing - tip);
    }
}

/// Largest relative error with which a discretisation may reproduce the footprint.
const LARGEST_DEFECT: f64 = 0.01;

/// A scheme, if it reproduces the footprint.
pub(crate) fn sound<'a>(
    scheme: Box<dyn Scheme + 'a>,
    footprint: &crate::Footprint,
) -> Result<Box<dyn Scheme + 'a>, GridError> {
    let defect = defect(&*scheme, footprint);
    if defect > LARGEST_DEFECT { Err(GridError::Defect { defect }) } else { Ok(scheme) }
}

/// max |Σ_j read(x - x_j) write(x_j - y) - f(x - y)| over the reach, relative to max |f|.
fn defect(scheme: &dyn Scheme, footprint: &crate::Footprint) -> f64 {
    let (mut read, mut write, mut local) = Default::default();
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for k in -64..=64 {
        let f = footprint.value(f64::from(k) / 64.0 * footprint.reach());
        // An irrational offset, so that tip and point lie differently among the cells each time.
        let y = f64::from(k) * std::f64::consts::SQRT_2 * scheme.spacing();
        scheme.height_stencil(y + f64::from(k) / 64.0 * footprint.reach(), &mut read);
        scheme.imprint(y, &mut write);
        local_copy(&mut local, &read, &write);
        worst = worst.max((read.dot(&local.values) - f).abs());
        largest = largest.max(f.abs());
    }
    worst / largest
}

/// The values of `write` at the cells of `read`.
fn local_copy(local: &mut Patch, read: &Patch, write: &Patch) {
    local.reset(read.first, read.values.len());
    local.add(1.0, write);
}

/// A spacing, if it is a finite number above 0.
pub(crate) fn positive(spacing: f64) -> Result<f64, GridError> {
    if spacing.is_finite() && spacing > 0.0 {
        Ok(spacing)
    } else {
        Err(GridError::Spacing(spacing))
    }
}
