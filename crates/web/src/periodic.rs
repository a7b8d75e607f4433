//! The cycle at the parameters, with its multipliers.

use crate::parameters::Parameters;
use crate::refusal::Refusal;
use stickslip::{Ask, Context, Cycle, CycleDocument, Indentation, Tip};

pub(crate) fn cycle_document(parameters: &Parameters) -> Result<CycleDocument, Refusal> {
    let model = parameters.model()?;
    let indentation = Indentation::given(model.alpha());
    let law = (*model.wider()).into();
    let question = Cycle { law, ..Cycle::new(Tip(model.tip().clone()), indentation, model.r()) };
    Ok(question.ask(&Context::default())?)
}
