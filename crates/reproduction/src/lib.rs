//! The paper's figures and numbers, recomputed with the libraries of this project.
//!
//! Each figure is a function that computes a document, and is drawn from it alone; [`table`] compares every number
//! printed in the paper with ours. `docs/findings/reproduction.md` shows them.

mod bifurcation;
mod boundary;
mod fig1;
mod onset;
mod parts;
mod surfaces;
mod table;
mod tips;
mod work_precision;

pub use parts::Failed;
pub use table::{page, table};

use stickslip::FigureDocument;

/// A figure: its name, and the function that computes it.
pub type Figure = (&'static str, fn() -> Result<FigureDocument, Failed>);

/// All figures: those of the paper, and four others.
pub const FIGURES: [Figure; 11] = [
    ("fig1", fig1::figure),
    ("fig2", onset::fig2),
    ("fig3", onset::fig3),
    ("fig4", surfaces::fig4),
    ("fig5", onset::fig5),
    ("fig6", boundary::fig6),
    ("fig7", surfaces::fig7),
    ("bifurcation", bifurcation::figure),
    ("criticality", boundary::criticality),
    ("kymograph", surfaces::kymograph),
    ("work-precision", work_precision::figure),
];

/// The figure of that name.
///
/// # Errors
/// There is no such figure, or it could not be computed.
pub fn figure(name: &str) -> Result<FigureDocument, Failed> {
    let known = FIGURES.iter().find(|(known, _)| *known == name);
    let (_, compute) = known.ok_or_else(|| Failed::new(format!("there is no figure {name}")))?;
    compute()
}
