//! The Floquet multipliers: eigenvalues of the monodromy matrix.

use nalgebra::DMatrix;
use num_complex::Complex;
use stickslip_tip::eigenvalues;

/// By falling modulus, of a pair the one above the real axis first. `None` where there are none to be had.
pub(super) fn multipliers(monodromy: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let mut found = eigenvalues(monodromy)?;
    // Both of a pair have the same modulus to the last bit, and stay in their order.
    found.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    Some(found)
}
