//! The cycle that `cycle` is about and `continue` begins with.

use crate::arguments::CycleStart;
use crate::commands::model::{indentation, law, r, refuse_endless, tip};
use crate::failure::Failure;
use crate::files::input::read_document;
use std::path::Path;
use stickslip::{Cycle, CycleDocument, Indentation, Law, Tip, Unusable};

/// What the options ask for, or the document of --from with what they change.
///
/// # Errors
/// Options that do not fit, a document that cannot be read.
pub(crate) fn question(arguments: &CycleStart) -> Result<Cycle, Failure> {
    let CycleStart { model, tolerance, from } = arguments;
    refuse_endless(&model.tip, &model.wider)?;
    let question = match from {
        Some(path) => changed(again(path)?, arguments)?,
        None => {
            let (tip, indentation) = (Tip(tip(&model.tip)?), indentation(model)?);
            let law = law(&model.wider);
            Cycle { law, ..Cycle::new(tip, indentation, r(model)?) }
        }
    };
    Ok(Cycle { tolerance: *tolerance, ..question })
}

fn again(path: &Path) -> Result<Cycle, Failure> {
    let document: CycleDocument = read_document("--from", path, CycleDocument::FORMAT)?;
    let unusable = |error: Unusable| Failure::input(format!("--from {}", path.display()), error);
    Cycle::again(&document).map_err(unusable)
}

/// A question with what was given in place of its own.
fn changed(before: Cycle, arguments: &CycleStart) -> Result<Cycle, Failure> {
    let given = &arguments.model;
    let asked = &given.tip;
    let is_given = asked.tip.is_some()
        || asked.beta.is_some()
        || asked.width.is_some()
        || asked.tip_file.is_some();
    if is_given && tip(asked)? != before.tip.0 {
        let message = "the footprint is that of the document: leave --tip and its options out";
        return Err(Failure::input("--from", message));
    }
    let is_another = given.alpha.or(given.alpha_above).is_some();
    let wider = law(&given.wider);
    Ok(Cycle {
        indentation: match before.indentation.alpha {
            Some(alpha) if !is_another => Indentation::given(alpha),
            _ => indentation(given)?,
        },
        r: given.r.unwrap_or(before.r),
        law: Law {
            depth_limit: wider.depth_limit.or(before.law.depth_limit),
            healing_time: wider.healing_time.or(before.law.healing_time),
            inertia: wider.inertia.or(before.law.inertia),
            no_spring: before.law.no_spring,
        },
        ..before
    })
}
