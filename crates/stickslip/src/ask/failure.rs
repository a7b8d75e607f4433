//! Reasons why a question has no answer, in words for all interfaces.

use crate::Unusable;
use std::borrow::Cow;
use std::fmt::{self, Display};
use stickslip_cycles::CycleError;
use stickslip_stability::StabilityError;
use stickslip_tip::{ModelError, TipFunctionError, WiderError};
use stickslip_units::Unit;
use thiserror::Error;

/// The reason why a question has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Failure {
    /// A parameter is invalid.
    #[error("{0}")]
    Refused(Refused),
    /// The computation has no result, for this reason.
    #[error("{}", named(.0, str::to_owned))]
    Failed(String),
    /// The work was cancelled: see [`Context::cancelled_by`].
    #[error("cancelled")]
    Cancelled,
}

/// An invalid parameter, with the reason and the remedy. Names of parameters in `{}` are written in the style of the
/// interface: `--alpha-above` on a command line, `alpha_above` in Python.
#[derive(Debug, Clone, PartialEq)]
pub struct Refused {
    /// The name of the parameter, or several joined by " and ".
    pub parameter: Cow<'static, str>,
    /// The value as typed, or several joined by " and "; `None` if it is missing or the name is sufficient.
    pub value: Option<String>,
    /// The reason and the remedy.
    pub why: String,
}

impl Refused {
    /// The rejection of a number as value of a parameter.
    pub fn number(parameter: impl Into<Cow<'static, str>>, value: f64, why: impl Display) -> Self {
        let value = Some(Typed(value).to_string());
        Self { parameter: parameter.into(), value, why: why.to_string() }
    }

    /// The rejection of a word as value of a parameter.
    pub fn word(
        parameter: impl Into<Cow<'static, str>>,
        value: impl Into<String>,
        why: impl Display,
    ) -> Self {
        Self { parameter: parameter.into(), value: Some(value.into()), why: why.to_string() }
    }

    /// The number, if it is finite and above 0; otherwise its rejection.
    pub(crate) fn positive(parameter: &'static str, value: f64) -> Result<f64, Self> {
        if value.is_finite() && value > 0.0 {
            return Ok(value);
        }
        Err(Self::number(parameter, value, "must be a finite number above 0"))
    }

    /// The length of the unit, in m.
    ///
    /// # Errors
    /// `unit` is no unit of length.
    pub fn metres(parameter: &'static str, unit: &str) -> Result<f64, Self> {
        let why = "must be m, mm, um, nm, pm or Å (angstrom)";
        Unit::Length.one(unit).ok_or_else(|| Self::word(parameter, unit, why))
    }

    /// The rejection of a parameter, without its value.
    pub fn whole(parameter: impl Into<Cow<'static, str>>, why: impl Display) -> Self {
        Self { parameter: parameter.into(), value: None, why: why.to_string() }
    }

    /// The parameter with its value, such as `--r 0`; or several, such as `--alpha 1 --r 0`.
    pub fn named(&self, name: impl Fn(&str) -> String) -> String {
        let names: Vec<String> = self.parameter.split(" and ").map(name).collect();
        let values: Vec<&str> = self.value.iter().flat_map(|value| value.split(" and ")).collect();
        if names.len() > 1 && values.len() == names.len() {
            let each = names.iter().zip(values).map(|(name, value)| format!("{name} {value}"));
            return each.collect::<Vec<String>>().join(" ");
        }
        let values = values.iter().map(|value| format!(" {value}"));
        let listed = match names.as_slice() {
            [before @ .., last] if before.len() > 1 => format!("{} and {last}", before.join(", ")),
            names => names.join(" and "),
        };
        listed + &values.collect::<String>()
    }

    /// The reason, with names of parameters written by `name`.
    pub fn reason(&self, name: impl Fn(&str) -> String) -> String {
        named(&self.why, name)
    }

    /// Parameter, value and reason in one sentence.
    pub fn described(&self, name: impl Fn(&str) -> String) -> String {
        format!("{}: {}", self.named(&name), self.reason(&name))
    }
}

/// The sentence with the names of parameters as in Python.
impl Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.described(str::to_owned))
    }
}

/// A text with each `{parameter}` replaced by `name`.
fn named(text: &str, name: impl Fn(&str) -> String) -> String {
    let mut named = String::new();
    let mut rest = text;
    while let Some((before, (parameter, after))) =
        rest.split_once('{').and_then(|(before, more)| Some((before, more.split_once('}')?)))
    {
        named += before;
        let is_name = parameter.chars().all(|c| c.is_ascii_lowercase() || c == '_');
        named += &if is_name { name(parameter) } else { format!("{{{parameter}}}") };
        rest = after;
    }
    named + rest
}

impl Failure {
    /// The reason, with names of parameters written by `name`.
    pub fn described(&self, name: impl Fn(&str) -> String) -> String {
        match self {
            Self::Refused(refused) => refused.described(name),
            Self::Failed(why) => named(why, name),
            Self::Cancelled => self.to_string(),
        }
    }
}

impl From<Failure> for Unusable {
    /// The reason why the question of a document has no answer.
    fn from(failure: Failure) -> Self {
        Self::new(failure)
    }
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

impl From<WiderError> for Refused {
    fn from(error: WiderError) -> Self {
        let (parameter, value) = error.parameter();
        Self::number(parameter, value, error)
    }
}

impl From<ModelError> for Refused {
    fn from(error: ModelError) -> Self {
        match error {
            ModelError::R(r) | ModelError::SupportWithoutSpring(r) => Self::number("r", r, error),
            ModelError::Alpha(alpha) => Self::number("alpha", alpha, error),
            ModelError::Wider(error) => error.into(),
            ModelError::Cosine => Self::whole("tip", error),
        }
    }
}

impl From<TipFunctionError> for Refused {
    fn from(error: TipFunctionError) -> Self {
        Self::whole("tip", error)
    }
}

impl From<StabilityError> for Failure {
    fn from(error: StabilityError) -> Self {
        match error {
            StabilityError::Wider(error) => Refused::from(error).into(),
            StabilityError::R(r) => Refused::number("r", r, error).into(),
            StabilityError::Alpha(alpha) => Refused::number("alpha", alpha, error).into(),
            StabilityError::Stopped => Self::Cancelled,
            error => Self::Failed(error.to_string()),
        }
    }
}

impl From<CycleError> for Failure {
    /// A cycle that was not found is a failure, not an invalid question, unless the parameters admit no cycle at all.
    fn from(error: CycleError) -> Self {
        match error {
            CycleError::NeverFades => Refused::whole("tip", error).into(),
            CycleError::Tolerance(tolerance) => {
                Refused::number("tolerance", tolerance, error).into()
            }
            CycleError::Stopped => Self::Cancelled,
            CycleError::NoSmallCycle { .. } => Self::Failed(format!(
                "{error}; a large one, if there is any, is found {{from}} a cycle nearby"
            )),
            error => Self::Failed(error.to_string()),
        }
    }
}

/// A number in its shortest form: `1e300` rather than three hundred digits.
#[derive(Debug, Clone, Copy)]
pub struct Typed(pub f64);

impl Display for Typed {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (digits, exponent) = (self.0.to_string(), format!("{:e}", self.0));
        out.write_str(if digits.len() > exponent.len() + 4 { &exponent } else { &digits })
    }
}
