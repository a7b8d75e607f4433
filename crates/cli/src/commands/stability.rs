//! `stickslip stability`.

use super::ask::answer_values;
use super::job::judge_places;
use crate::arguments::StabilityArguments;
use crate::failure::Failure;
use crate::session::Session;
use serde_json::Value;
use stickslip::{RasterStability, Stability, Walking};

pub(crate) fn stability(session: &Session, arguments: &StabilityArguments) -> Result<(), Failure> {
    let StabilityArguments { options, answer } = arguments;
    judge_places(&answer.outlet, answer.plot.as_deref(), &options.files())?;
    let values = options.values(session)?;
    let has = |name: &str| values.get(name).is_some_and(|value| !value.is_null());
    if values.get("no_spring") == Some(&Value::Bool(true)) {
        answer_values::<Walking, _>(session, options, values, answer, "--no-spring")
    } else if has("pitch") || has("path") {
        answer_values::<RasterStability, _>(session, options, values, answer, "--pitch or --path")
    } else {
        let chosen_by = "a single line, without --pitch or --path";
        answer_values::<Stability, _>(session, options, values, answer, chosen_by)
    }
}
