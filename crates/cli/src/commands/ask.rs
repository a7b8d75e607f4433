//! From the options of a command to a question, and from its answer to the output.

use super::in_units::scales;
use super::job::{Job, Product};
use super::model::tip;
use super::progress::Progress;
use crate::arguments::{
    AnswerArguments, Given, InUnitsArguments, Options, Questions, TipArguments,
};
use crate::failure::{Failure, Typed};
use crate::files::distinct::Named;
use crate::files::text::{LARGEST_TABLE, read_text};
use crate::interrupt::Interrupt;
use crate::session::{Session, locked};
use serde_json::{Map, Value};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use std::time::Instant;
use stickslip::parameter::{Distinct, Parameter, overridden};
use stickslip::{
    self as documents, Ask, Context, Document, KnownScales, Physical, Question, Refused, Tip,
    parameter,
};

/// A context that reports progress to the terminal or to the host, which may cancel the work.
pub(crate) fn context(session: &Session) -> Context {
    context_cancelled_by(session, session.stop())
}

pub(crate) fn context_cancelled_by(session: &Session, flag: Arc<AtomicBool>) -> Context {
    let progress: Mutex<Option<Progress>> = Mutex::new(None);
    let session = session.clone();
    Context::cancelled_by(flag).timed_by(seconds).watched_by(move |part, counted| {
        let mut progress = locked(&progress);
        let bar = progress.get_or_insert_with(|| match part {
            Some(_) => Progress::new(&session, 0.0, 1.0).at_every_call(),
            None => Progress::without_end(&session).at_every_call(),
        });
        bar.counted(part.unwrap_or_default(), || counted);
    })
}

/// Seconds since the first call.
fn seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// A parameter as an option: `--alpha-above` for `alpha_above`.
pub(crate) fn option(parameter: &str) -> String {
    match parameter {
        "pulses" => "--pulse".into(),
        "force" => "--force-file".into(),
        _ => format!("--{}", parameter.replace('_', "-")),
    }
}

/// The error for a rejected parameter in terms of the command line: it names the file that a value came from, or the
/// option of a footprint.
pub(crate) fn refusal(failure: documents::Failure, tip: &TipArguments, files: &[Named]) -> Failure {
    let documents::Failure::Refused(refused) = &failure else { return failure.into() };
    let option = |parameter: &str| match parameter {
        "tip" if tip.tip_file.is_some() => "--tip-file".into(),
        "tip" if tip.beta.is_some() => "--beta".into(),
        _ => option(parameter),
    };
    let named = option(&refused.parameter);
    let file = match &*named {
        "--tip-file" => tip.tip_file.as_deref(),
        _ => files.iter().find_map(|(option, path)| path.filter(|_| *option == named)),
    };
    let beta = tip.beta.filter(|_| named == "--beta" && refused.value.is_none());
    let named = match (file, beta) {
        (Some(path), _) => format!("{named} {}", path.display()),
        (None, Some(beta)) => format!("{named} {}", Typed(beta)),
        (None, None) => refused.named(option),
    };
    Failure::input(named, refused.reason(option))
}

impl<Q: Questions> Options<Q> {
    /// The values of the parameters: those of --parameters, replaced by those given as options.
    pub(crate) fn values(&self, session: &Session) -> Result<Map<String, Value>, Failure> {
        let read = |path| read_parameters(session, path, (Q::formats, Q::parameters), &self.given);
        let base = self.parameters.as_deref().map(read).transpose()?;
        self.values_instead_of(session, base.unwrap_or_default())
    }
}

impl Given {
    /// The files that the options name.
    pub(crate) fn files(&self) -> [Named<'_>; 2] {
        [("--tip-file", self.tip.tip_file.as_deref()), ("--parameters", self.parameters.as_deref())]
    }

    /// Whether an option was given.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.given.contains_key(name)
    }

    /// The scales of a result whose r, if it is given, is among these values; `None` without physical units.
    pub(crate) fn scales(
        &self,
        session: &Session,
        in_units: &InUnitsArguments,
        values: &Map<String, Value>,
    ) -> Result<Option<KnownScales>, Failure> {
        let r = values.get("r").and_then(Value::as_f64);
        scales(session, in_units, self.tip.tip_file.as_deref(), r)
    }

    /// The values `base`, replaced by those given as options.
    pub(crate) fn values_instead_of(
        &self,
        session: &Session,
        base: Map<String, Value>,
    ) -> Result<Map<String, Value>, Failure> {
        for (option, range) in &self.ranges {
            range.ends(option)?;
            range.points(option, self.counted_by)?;
        }
        let mut given = self.given.clone();
        if self.tip.is_given() {
            let tip = serde_json::to_value(Tip(tip(session, &self.tip)?));
            given.insert("tip".into(), tip.map_err(Failure::run)?);
        }
        Ok(overridden(base, given))
    }
}

/// The formats of documents with the parameters of a command, and these parameters.
type Known = (fn() -> Vec<&'static str>, fn() -> Vec<&'static Parameter>);

/// The parameters in a file, a document or its `parameters` alone, beside those given as options.
fn read_parameters(
    session: &Session,
    path: &Path,
    (formats, known): Known,
    given: &Map<String, Value>,
) -> Result<Map<String, Value>, Failure> {
    const OPTION: &str = "--parameters";
    let named = || format!("{OPTION} {}", path.display());
    let text = read_text(session, OPTION, path, LARGEST_TABLE)?;
    let Distinct(value) = serde_json::from_str(&text).map_err(|error| {
        let why = if error.is_data() { "is ambiguous" } else { "is not JSON" };
        Failure::input(named(), format!("{why}: {error}"))
    })?;
    let mut whole = match value {
        Value::Object(whole) => whole,
        _ => return Err(Failure::input(named(), "needs an object, {\"r\": 1, …}, or a document")),
    };
    let Some(Value::String(format)) = whole.remove("format") else { return Ok(whole) };
    let Some(Value::Object(mut parameters)) = whole.remove("parameters") else {
        return Err(Failure::input(named(), "is a document without \"parameters\""));
    };
    if !formats().contains(&format.as_str()) {
        let known = known();
        let knows = |name: &str| known.iter().any(|parameter| parameter.name == name);
        parameters.retain(|name, _| knows(name));
        for name in without_effect(&parameters, given, knows) {
            parameters.remove(name);
        }
        let names: Vec<&str> = parameters.keys().map(String::as_str).collect();
        session.remark(format_args!(
            "stickslip: {}: a document {format}: its parameters {} are used",
            named(),
            names.join(", ")
        ));
    }
    Ok(parameters)
}

/// Parameters of a document that have no effect in a command of another kind, which rejects them as options.
fn without_effect(
    parameters: &Map<String, Value>,
    given: &Map<String, Value>,
    knows: impl Fn(&str) -> bool,
) -> Vec<&'static str> {
    let has = |name: &str| parameters.get(name).is_some_and(|value| !value.is_null());
    // The length of lines that are not scanned, on a surface that does not heal.
    let length = !knows("lines") && !has("healing_time");
    // The width across of a tip that stays on a single line.
    let across = ["pitch_range", "stiffness_range"].iter().any(|name| given.contains_key(*name));
    let width = !knows("pitch") && !across && !has("stiffness_across");
    // What a boundary computes, or varies; a map over loads begins at the values of one motion.
    let is_map = given.keys().any(|name| name.starts_with("load"));
    let computed = knows("load_range") && !is_map;
    let names = [
        ("length", length),
        ("width_y", width),
        ("alpha", computed),
        ("alpha_above", computed),
        ("r", computed && given.contains_key("r_range")),
        ("stiffness_across", given.contains_key("stiffness_range")),
    ];
    names.into_iter().filter_map(|(name, is_without)| is_without.then_some(name)).collect()
}

/// Answers a question, with results in physical units if requested.
pub(crate) fn answered<Q: Ask>(
    session: &Session,
    question: Q,
    place: &AnswerArguments,
    tip: &TipArguments,
) -> Result<Document<Q>, Failure> {
    Ok(answered_into(session, question, place, tip, || Ok(()))?.0)
}

/// Answers a question, writes and draws the answer, and prints a summary.
pub(crate) fn answer<Q: Ask>(
    session: &Session,
    question: Q,
    place: &AnswerArguments,
    tip: &TipArguments,
) -> Result<(), Failure>
where
    Document<Q>: Product,
{
    let open = || Job::open(session, Q::FORMAT, &place.outlet, place.plot.as_deref());
    let (document, job) = answered_into(session, question, place, tip, open)?;
    job.finish(document)
}

/// Writes the answer to a question, or what a signal left of it, and draws it.
pub(crate) fn answer_until_signal<Q: Ask>(
    question: Q,
    context: &Context,
    interrupt: Interrupt,
    (job, scales): (Job, Option<&KnownScales>),
    refused: impl FnOnce(documents::Failure) -> Failure,
) -> Result<(), Failure>
where
    Document<Q>: Product,
{
    let found = question.answered(context);
    let signal = interrupt.signal();
    let document = match (found, signal) {
        (Err(_), Some(signal)) => return Err(Failure::Stopped(signal)),
        (found, _) => found.map_err(refused)?,
    };
    // The result can be computed again: from here on a first signal ends the program immediately.
    let _keeps = signal.map(|_| interrupt);
    job.finish(document.in_units(scales))?;
    signal.map_or(Ok(()), |signal| Err(Failure::Interrupted(signal)))
}

/// The answer to a question, and its output, which is opened once the question is known to be valid.
fn answered_into<Q: Ask, T>(
    session: &Session,
    question: Q,
    place: &AnswerArguments,
    tip: &TipArguments,
    open: impl FnOnce() -> Result<T, Failure>,
) -> Result<(Document<Q>, T), Failure> {
    let context = context(session);
    let refused = |failure| refusal(failure, tip, &[]);
    let question = question.resolved(&context).map_err(refused)?;
    let tip_file = tip.tip_file.as_deref();
    let scales = scales(session, &place.in_units, tip_file, question.support_velocity())?;
    let output = open()?;
    let document = question.answered(&context).map_err(refused)?;
    Ok((document.in_units(scales.as_ref()), output))
}

/// Answers the question with these values of options; `chosen_by` is the option that selects this question.
pub(crate) fn answer_values<Q: Ask, K: Questions>(
    session: &Session,
    options: &Options<K>,
    values: Map<String, Value>,
    place: &AnswerArguments,
    chosen_by: &str,
) -> Result<(), Failure>
where
    Document<Q>: Product,
{
    refuse_unknown::<Q, K>(options, &values, chosen_by)?;
    let question: Q = parameter::question(values)?;
    answer(session, question, place, &options.tip)
}

/// Rejects options that do not belong to `Q`; `chosen_by` is the option that selects this question.
pub(crate) fn refuse_unknown<Q: Question, K: Questions>(
    _: &Options<K>,
    values: &Map<String, Value>,
    chosen_by: &str,
) -> Result<(), Failure> {
    let unknown = parameter::unknown_parameter::<Q>(values);
    unknown.map_or(Ok(()), |name| refused_unless_misspelt(name, values, chosen_by, K::parameters))
}

fn refused_unless_misspelt(
    name: &str,
    values: &Map<String, Value>,
    chosen_by: &str,
    known: fn() -> Vec<&'static Parameter>,
) -> Result<(), Failure> {
    if known().iter().all(|parameter| parameter.name != name) {
        // Unknown to all questions: reported with the question.
        return Ok(());
    }
    let named = format!("{} {}", option(name), parameter::typed(&values[name]));
    Err(Failure::input(named, format!("has no meaning with {chosen_by}: leave one of them out")))
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::input(refused.named(option), refused.reason(option))
    }
}

impl From<documents::Failure> for Failure {
    fn from(failure: documents::Failure) -> Self {
        match failure {
            documents::Failure::Refused(refused) => refused.into(),
            documents::Failure::Cancelled => Self::Stopped(signal_hook::consts::SIGINT as u8),
            other => Self::Run(other.described(option)),
        }
    }
}
