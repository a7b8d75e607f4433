//! The paper's figures and numbers, recomputed with the libraries of this project.
//!
//! Each figure is a function that computes a document, and is drawn from it alone; [`table`] compares every number
//! printed in the paper with ours. `docs/findings/reproduction.md` shows them.

mod bifurcation;
mod criticality;
mod failed;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod kymograph;
mod onset;
mod parts;
mod table;
mod tips;
mod work_precision;

pub use failed::Failed;
pub use table::{page, table};

use stickslip::FigureDocument;

/// A figure: its name, and the function that computes it.
pub type Figure = (&'static str, fn() -> Result<FigureDocument, Failed>);

/// All figures: those of the paper, and four others.
pub const FIGURES: [Figure; 11] = [
    ("fig1", fig1::figure),
    ("fig2", fig2::figure),
    ("fig3", fig3::figure),
    ("fig4", fig4::figure),
    ("fig5", fig5::figure),
    ("fig6", fig6::figure),
    ("fig7", fig7::figure),
    ("bifurcation", bifurcation::figure),
    ("criticality", criticality::figure),
    ("kymograph", kymograph::figure),
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
