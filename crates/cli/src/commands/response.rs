//! `stickslip response`.

use super::ask::answer;
use super::job::judge_places;
use super::run::disturbance::{parse_pulses, warn_of_pulses_outside};
use crate::arguments::ResponseArguments;
use crate::failure::Failure;
use crate::session::Session;
use serde_json::json;
use stickslip::{Response, parameter};

pub(crate) fn response(session: &Session, arguments: &ResponseArguments) -> Result<(), Failure> {
    let ResponseArguments { options, pulse, answer: place } = arguments;
    judge_places(&place.outlet, place.plot.as_deref(), &options.files())?;
    let mut values = options.values(session)?;
    let pulses = parse_pulses(pulse)?;
    if !pulses.is_empty() {
        values.insert("pulses".into(), json!(pulses));
    }
    let question: Response = parameter::question(values)?;
    // A pulse before the samples is felt in them.
    warn_of_pulses_outside(session, pulse, &pulses, (f64::NEG_INFINITY, question.until));
    answer(session, question, place, &options.tip)
}
