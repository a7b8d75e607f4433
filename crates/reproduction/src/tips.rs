//! The paper's two tips, and their critical points.

use super::parts::{Failed, failed, figure};
use std::f64::consts::FRAC_1_SQRT_2;
use stickslip::FigureDocument;
use stickslip_stability::{Critical, critical, critical_r};
use stickslip_tip::{Model, TipFunction, Wider};

/// Remark of every figure that has a panel for β = 0.
pub(super) const BETA_0: &str = "β = 0 is drawn with exp(-x²), a Gaussian of width 1/√2: the numbers that the \
     paper prints for β = 0 are those of this tip, not of exp(-x²/2), (48) with β = 0 (docs/findings/corrections.md, 3)";

/// A tip of the paper.
#[derive(Debug, Clone)]
pub(super) struct Tip {
    pub(super) function: TipFunction,
    /// Name in headings.
    pub(super) name: &'static str,
}

/// (48) with β = 1, the triple Gaussian.
pub(super) fn beta_1() -> Result<Tip, Failed> {
    let function = TipFunction::triple_gaussian(1.0, 1.0).map_err(failed("the tip"))?;
    Ok(Tip { function, name: "β = 1" })
}

/// The tip of the figures for β = 0.
pub(super) fn beta_0() -> Result<Tip, Failed> {
    let function = TipFunction::gaussian(FRAC_1_SQRT_2).map_err(failed("the tip"))?;
    Ok(Tip { function, name: "β = 0, f = exp(−x²)" })
}

/// Both tips, and a figure without panels for their models at r = 1 and this α.
pub(super) fn figure_of_both(
    (name, title): (&str, &str),
    alpha: impl Fn(&Tip) -> Result<f64, Failed>,
) -> Result<([Tip; 2], FigureDocument), Failed> {
    let tips = [beta_1()?, beta_0()?];
    let model = |tip: &Tip| tip.model(alpha(tip)?, 1.0);
    let mut document = figure(name, title, &[model(&tips[0])?, model(&tips[1])?]);
    document.remarks.push(BETA_0.into());
    Ok((tips, document))
}

impl Tip {
    /// αc(r).
    pub(super) fn critical(&self, r: f64) -> Result<Critical, Failed> {
        critical(&Wider::default(), &self.function, r).map_err(failed("the critical point"))
    }

    /// rc(α).
    pub(super) fn critical_r(&self, alpha: f64) -> Result<Critical, Failed> {
        critical_r(&Wider::default(), &self.function, alpha).map_err(failed("the critical point"))
    }

    pub(super) fn model(&self, alpha: f64, r: f64) -> Result<Model, Failed> {
        Model::new(self.function.clone(), alpha, r).map_err(failed("the model"))
    }
}
