//! Footprint and cells of a plane for the grid.

use crate::failure::Failure;
use stickslip::GridName;
use stickslip_grid::{Gaussian, PlaneMethod, Product};
use stickslip_tip::{Across, Footprint, Layer, TipFunction};

/// Default spacing of the second-order grid, in widths of the tip.
pub(super) const SECOND_ORDER: f64 = 0.05;
/// Cells on either side in the support of the sinc, for errors at round-off.
const SINC_HALF_WIDTH: usize = 80;
/// Largest number of cells: 190 MB.
const MOST_CELLS: f64 = 2.4e7;
/// Distance in widths beyond which a Gaussian is taken as 0.
const WIDTHS_OF_REACH: f64 = 8.85;

/// The terms of f(x,y), and cells in which Δy is to the width across as Δx is to the width along.
pub(super) struct Plane {
    pub(super) products: Vec<Product>,
    pub(super) method: PlaneMethod,
    spacing: [f64; 2],
    /// Distance across beyond which the tip leaves cells unchanged.
    reach: f64,
}

impl Plane {
    pub(super) fn of(grid: GridName, spacing: f64, footprint: &Footprint) -> Result<Self, Failure> {
        let products = footprint.layers().iter().map(product).collect::<Result<Vec<_>, _>>()?;
        let smallest = |of: fn(&Product) -> &Vec<Gaussian>| {
            products.iter().flat_map(of).map(|g| g.width).fold(f64::INFINITY, f64::min)
        };
        let widths = [smallest(|product| &product.along), smallest(|product| &product.across)];
        let across = products.iter().flat_map(|product| &product.across);
        let reach = across.map(|g| g.center.abs() + WIDTHS_OF_REACH * g.width).fold(0.0, f64::max);
        let in_widths = spacing / widths[0];
        let spacing = [spacing, in_widths * widths[1]];
        let method = match grid {
            GridName::Spectral => PlaneMethod::Spectral { spacing: in_widths },
            GridName::Sinc => PlaneMethod::Sinc { spacing, half_width: SINC_HALF_WIDTH },
            GridName::Windowed => PlaneMethod::ThreePoint { spacing },
            GridName::Uniform => return Err(uniform_refused()),
        };
        Ok(Self { products, method, spacing, reach })
    }

    /// Checks the number of cells over a length along the scan and a range of y0.
    pub(super) fn fit(&self, length: f64, (low, high): (f64, f64)) -> Result<(), Failure> {
        let cells = length / self.spacing[0] * (high - low + 2.0 * self.reach) / self.spacing[1];
        if cells <= MOST_CELLS {
            return Ok(());
        }
        let coarser = self.spacing[0] * (cells / MOST_CELLS).sqrt();
        let message = format!(
            "would make {cells:.1e} cells, more than fit in memory; take {coarser:.1e} or more, or scan less"
        );
        Err(Failure::number("--spacing", self.spacing[0], message))
    }
}

/// Rejects `--grid uniform`, which is available along the scan only.
pub(super) fn uniform_refused() -> Failure {
    let message = "is not available across the scan: take spectral or sinc (exact) or windowed (second order)";
    Failure::input("--grid uniform", message)
}

/// A layer of the footprint in the types of the grid.
fn product(layer: &Layer) -> Result<Product, Failure> {
    let TipFunction::Gaussians(sum) = &layer.along else {
        return Err(Failure::Run("the grid needs a footprint that is a sum of Gaussians".into()));
    };
    let of = |g: &stickslip_tip::Gaussian| Gaussian {
        amplitude: g.amplitude,
        center: g.center,
        width: g.width,
    };
    let Across { center, width } = layer.across;
    let twin = (center > 0.0).then_some(-center);
    let bell = |center| Gaussian { amplitude: 1.0, center, width };
    let across = std::iter::once(center).chain(twin).map(bell).collect();
    Ok(Product { along: sum.terms().iter().map(of).collect(), across })
}
