//! `stickslip run --walker`.

use super::disturbance::{parse_pulses, warn_of_pulses_outside};
use super::{format_of, order};
use crate::arguments::RunArguments;
use crate::commands::ask::{answer_until_signal, context_cancelled_by, refuse_unknown};
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::session::Session;
use serde_json::{Map, Value};
use std::sync::Arc;
use stickslip::{Ask, RunFormat, Walker, WalkerDocument, parameter};

/// The run, up to its end or to a signal.
pub(super) fn run(
    session: &Session,
    arguments: &RunArguments,
    values: Map<String, Value>,
) -> Result<(), Failure> {
    let format = order::format(session, arguments)?;
    judge(arguments, format)?;
    order::judge_files(arguments)?;
    refuse_unknown::<Walker, _>(&arguments.options, &values, "--walker")?;
    let mut question: Walker = parameter::question(values)?;
    let typed = &arguments.disturbance.pulse;
    if !typed.is_empty() {
        let pulses = parse_pulses(typed)?;
        warn_of_pulses_outside(session, typed, &pulses, (0.0, question.until));
        question.pulses = pulses;
    }
    let scales = scales(session, &arguments.in_units, None, None)?;
    let (output, plot) = (arguments.output(), arguments.plot.as_deref());
    let interrupt = Interrupt::listen(session)?;
    let context = context_cancelled_by(session, Arc::clone(interrupt.flag()));
    let question = question.resolved(&context)?;
    let fields = &arguments.fields;
    let job =
        Job::of_format(session, WalkerDocument::FORMAT, format_of(format), output, fields, plot)?;
    answer_until_signal(question, &context, interrupt, (job, scales.as_ref()), Failure::from)
}

/// Rejects options that are not available for a walker.
fn judge(arguments: &RunArguments, format: RunFormat) -> Result<(), Failure> {
    let (disturbance, tip) = (&arguments.disturbance, &arguments.options.tip);
    let unavailable = [
        ("--tip", tip.tip.is_some()),
        ("--beta", tip.beta.is_some()),
        ("--width", tip.width.is_some()),
        ("--tip-file", tip.tip_file.is_some()),
        ("--noise", disturbance.noise.is_some()),
        ("--initial-surface", disturbance.initial_surface.is_some()),
        ("--force-file", disturbance.force_file.is_some()),
        ("--support-path", arguments.support_path.is_some()),
        ("--verify", arguments.verify),
        ("--checkpoint", arguments.checkpoint.is_some()),
        ("--format jsonl", format == RunFormat::Jsonl),
    ];
    let message = "is not available with --walker: leave one of them out";
    Failure::if_given(&unavailable, message)
}
