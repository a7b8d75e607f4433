//! Figure of a sweep: a phase diagram over two parameters, amplitude and period over one.

mod cells;
mod row;
mod varied;

use super::drawn::{Drawn, View};
use super::tip::tip_name;
use crate::error::FigureError;
use crate::number::short;
use stickslip::{FigureDocument, ModelParameters, SweepDocument, SweepParameters, Tip};
pub(super) use varied::Phase;
use varied::varied;

/// Rejects a grid that no picture can show, before its points are computed.
///
/// # Errors
/// The grid is a single point, or has more than two parameters that vary.
pub fn judge_sweep(parameters: &SweepParameters) -> Result<(), FigureError> {
    match varied(parameters).len() {
        1 | 2 => Ok(()),
        0 => Err(FigureError::Nothing(
            "a single point makes no picture: give a range LO:HI:N".into(),
        )),
        _ => {
            let advice = "a picture can show two ranges: fix one of them";
            Err(FigureError::Nothing(advice.into()))
        }
    }
}

impl Drawn for SweepDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        judge_sweep(&self.parameters)?;
        let title = format!("Regimes of motion, {}", fixed(&self.parameters));
        let panels = match varied(&self.parameters).as_slice() {
            [slow, fast] => vec![cells::panel(self, *slow, *fast)],
            [axis] => row::panels(self, *axis),
            _ => vec![],
        };
        Ok(FigureDocument::new("sweep", &title, models(&self.parameters), panels))
    }
}

/// The parameters that do not vary, as text.
fn fixed(parameters: &SweepParameters) -> String {
    let SweepParameters { tips, beta, r, alpha, alpha_above, .. } = parameters;
    let mut said = vec![];
    match (beta.as_deref().map(<[f64]>::len), tips.first()) {
        (Some(2..), _) => said.push("triple Gaussian".to_owned()),
        (_, Some(tip)) => said.push(tip_name(&(&tip.0).into())),
        (_, None) => {}
    }
    let mut one = |name: &str, values: &[f64]| {
        if let [value] = values {
            said.push(format!("{name} = {}", short(*value)));
        }
    };
    one("r", r);
    one("α", alpha.as_deref().unwrap_or(&[]));
    one("α − α_c", alpha_above.as_deref().unwrap_or(&[]));
    said.join(", ")
}

/// The model of the first point.
fn models(parameters: &SweepParameters) -> Vec<ModelParameters> {
    let first = |values: &Option<Vec<f64>>| values.as_ref().and_then(|v| v.first().copied());
    let (alpha, alpha_above) = (first(&parameters.alpha), first(&parameters.alpha_above));
    let model = |tip: &Tip| {
        let (alpha, r) = (alpha.or(alpha_above)?, *parameters.r.first()?);
        Some(ModelParameters::papers((&tip.0).into(), alpha, alpha_above, r))
    };
    parameters.tips.first().and_then(model).into_iter().collect()
}
