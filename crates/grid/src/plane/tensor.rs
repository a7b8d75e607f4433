//! Discretisations of the plane: one scheme along and one across.

use super::product::{self, Product};
use crate::patch::Patch;
use crate::scheme::{Scheme, positive, sound};
use crate::sinc::Sinc;
use crate::tableau::{DOP853, DOPRI5, Tableau};
use crate::theta::Theta;
use crate::three_point::ThreePoint;
use crate::{Footprint, Gaussian, GridError};

/// A discretisation of the plane and of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlaneMethod {
    /// Heights; slopes by central differences, interpolated bilinearly: order 2. Dormand–Prince 5(4) in time.
    ThreePoint {
        /// Δx and Δy
        spacing: [f64; 2],
    },
    /// Lattices with narrower Gaussians for writing and reading, exact to round-off at a spacing of π/8.7;
    /// Dormand–Prince 8(5,3) in time.
    Spectral {
        /// Spacing in both coordinates, each in units of the smallest width in this coordinate.
        spacing: f64,
    },
    /// Samples and a regularised sinc in both coordinates; Dormand–Prince 8(5,3) in time.
    Sinc {
        /// Δx and Δy: at most π over the largest wave number in f.
        spacing: [f64; 2],
        /// Cells on either side in the support of the interpolation, 80 for round-off.
        half_width: usize,
    },
}

impl PlaneMethod {
    pub(super) fn tableau(&self) -> &'static Tableau {
        match self {
            Self::ThreePoint { .. } => &DOPRI5,
            Self::Spectral { .. } | Self::Sinc { .. } => &DOP853,
        }
    }
}

/// The functions g and h of all products.
pub(super) struct Factors<'a> {
    products: &'a [Product],
    functions: [Vec<Function<'a>>; 2],
    reach: [f64; 2],
}

type Function<'a> = Box<dyn Fn(f64) -> f64 + 'a>;

impl<'a> Factors<'a> {
    pub(super) fn new(products: &'a [Product]) -> Self {
        let of = |axis: usize| {
            let function = |product: &'a Product| -> Function<'a> {
                let terms = product.factors()[axis];
                Box::new(move |x| product::value(terms, x))
            };
            products.iter().map(function).collect()
        };
        Self { products, functions: [of(0), of(1)], reach: product::reach(products) }
    }
}

/// The tensor product of schemes of one coordinate. The scheme of each product writes its g or h, and all read alike.
pub(super) struct Tensor<'a> {
    axes: [Vec<Box<dyn Scheme + 'a>>; 2],
}

/// Stencils of the height and of the slope in each coordinate.
#[derive(Debug, Default)]
pub(super) struct Stencils {
    pub(super) height: [Patch; 2],
    pub(super) slope: [Patch; 2],
}

impl<'a> Tensor<'a> {
    /// # Errors
    /// A spacing that is not a finite number above 0, or too wide for the footprint.
    pub(super) fn new(method: &PlaneMethod, factors: &'a Factors) -> Result<Self, GridError> {
        let widths = product::smallest_widths(factors.products);
        let of = |axis: usize| {
            let terms = factors.products.iter().map(|product| product.factors()[axis]);
            let functions = factors.functions[axis].iter();
            let each = terms.zip(functions).map(|(terms, function)| {
                let footprint = Footprint::new(function, factors.reach[axis])?;
                scheme_of(method, axis, (terms, footprint), widths[axis])
            });
            each.collect::<Result<Vec<_>, GridError>>()
        };
        Ok(Self { axes: [of(0)?, of(1)?] })
    }

    /// The factors of the imprint of a tip: one pair for each product.
    pub(super) fn imprint(&self, tip: [f64; 2], out: &mut Vec<[Patch; 2]>) {
        out.resize_with(self.axes[0].len(), Default::default);
        for (product, pair) in out.iter_mut().enumerate() {
            for axis in 0..2 {
                self.axes[axis][product].imprint(tip[axis], &mut pair[axis]);
            }
        }
    }

    pub(super) fn stencils(&self, at: [f64; 2], out: &mut Stencils) {
        for (axis, (schemes, at)) in self.axes.iter().zip(at).enumerate() {
            schemes[0].height_stencil(at, &mut out.height[axis]);
            schemes[0].slope_stencil(at, &mut out.slope[axis]);
        }
    }
}

fn scheme_of<'a>(
    method: &PlaneMethod,
    axis: usize,
    (terms, footprint): (&[Gaussian], Footprint<'a>),
    width: f64,
) -> Result<Box<dyn Scheme + 'a>, GridError> {
    let spectral: Box<dyn Scheme + 'a> = match *method {
        PlaneMethod::ThreePoint { spacing } => {
            return Ok(Box::new(ThreePoint { footprint, spacing: positive(spacing[axis])? }));
        }
        PlaneMethod::Spectral { spacing } => {
            Box::new(Theta::read_by(width, terms, positive(spacing)?))
        }
        PlaneMethod::Sinc { spacing, half_width } => {
            Box::new(Sinc::checked(footprint, spacing[axis], half_width)?)
        }
    };
    sound(spectral, &footprint)
}
