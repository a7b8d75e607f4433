//! Discretisations of the rows of a scanned area along x.

use crate::Footprint;
use crate::scheme::Scheme;
use crate::sinc::Sinc;
use crate::tableau::{DOP853, DOPRI5, Tableau};
use crate::three_point::ThreePoint;

/// Discretisation of rows along x and in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowMethod {
    /// Samples interpolated by a regularised sinc, exact to round-off for a spacing of at most π over the largest
    /// wave number in f; order 8 in time.
    Sinc,
    /// The paper's grid: slopes by central differences, interpolated linearly, order 2; order 5 in time.
    ThreePoint,
}

/// Cells on either side in the support of the sinc.
pub(crate) const HALF_WIDTH: usize = 80;

impl RowMethod {
    pub(crate) fn scheme(self, footprint: Footprint<'_>, spacing: f64) -> Box<dyn Scheme + '_> {
        match self {
            Self::Sinc => Box::new(Sinc::new(footprint, spacing, HALF_WIDTH)),
            Self::ThreePoint => Box::new(ThreePoint { footprint, spacing }),
        }
    }

    pub(crate) fn tableau(self) -> &'static Tableau {
        match self {
            Self::Sinc => &DOP853,
            Self::ThreePoint => &DOPRI5,
        }
    }
}
