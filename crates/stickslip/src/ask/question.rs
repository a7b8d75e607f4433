//! Parameters that several questions share: footprint, law, indentation rate.

use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Law, LayerDocument, ModelParameters, Refused, TipDocument, Typed, judge_details};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use stickslip_stability as stability;
use stickslip_tip::{Gaussian, Model, ModelError, TipFunction, Wider};

/// A footprint in a question, written as [`TipDocument`]. It is read from this form, from a name with `beta` and
/// `width`, or from a table with the columns `x` and `f`.
#[derive(Debug, Clone, PartialEq)]
pub struct Tip(pub TipFunction);

/// The footprints that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TipName {
    /// (48): a Gaussian with side lobes of weight -beta/2 at ±2 widths.
    TripleGaussian,
    /// exp(-x²/(2 W²)).
    Gaussian,
    /// The Bessel function J0(x).
    Bessel,
    /// cos x, for tips without a spring or on a surface that heals.
    Cosine,
}

/// A footprint given by its name, with the parameters of that name.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct NamedTip {
    /// The name; the triple Gaussian by default.
    pub name: Option<TipName>,
    /// Weight β of the side lobes of the triple Gaussian; 1 by default.
    pub beta: Option<f64>,
    /// Width W of either Gaussian, in σ; 1 by default.
    pub width: Option<f64>,
}

impl NamedTip {
    /// The footprint.
    ///
    /// # Errors
    /// The footprint has no such parameter, or a number is out of its range.
    pub fn tip(&self) -> Result<TipFunction, Refused> {
        let name = self.name.unwrap_or(TipName::TripleGaussian);
        let unused = |parameter, value, with: &str| {
            let why = format!("has no meaning with {with}: leave one of them out");
            Err(Refused::number(parameter, value, why))
        };
        if let Some(beta) = self.beta.filter(|_| name != TipName::TripleGaussian) {
            return unused("beta", beta, "a tip without side lobes");
        }
        let endless = match name {
            TipName::Bessel => Some("{tip} bessel"),
            TipName::Cosine => Some("{tip} cosine"),
            TipName::TripleGaussian | TipName::Gaussian => None,
        };
        if let Some((width, name)) = self.width.zip(endless) {
            return unused("width", width, name);
        }
        let b = self.beta.unwrap_or(1.0);
        let w = Refused::positive("width", self.width.unwrap_or(1.0))?;
        let width = |error| Refused::number("width", w, error);
        match name {
            TipName::Bessel => Ok(TipFunction::Bessel),
            TipName::Cosine => Ok(TipFunction::Cosine),
            TipName::Gaussian => TipFunction::gaussian(w).map_err(width),
            TipName::TripleGaussian => TipFunction::triple_gaussian(b, w).map_err(|error| {
                // Gaussian number 1 has amplitude 1 whatever beta.
                let widthless = TipFunction::gaussian(w).is_err() || !(2.0 * w).is_finite();
                if widthless { width(error) } else { Refused::number("beta", b, error) }
            }),
        }
    }
}

impl Default for Tip {
    /// The triple Gaussian (48) with β = 1.
    fn default() -> Self {
        Self(TipFunction::default())
    }
}

impl Tip {
    /// Rejects a footprint whose sides differ; `what` names the computation that needs equal sides.
    pub(crate) fn judge_even(&self, what: &str) -> Result<(), Refused> {
        if self.0.is_even() {
            return Ok(());
        }
        let why = format!(
            "{what} is available only for a tip with two equal sides: give one side, such as `stickslip tip PROFILE \
             --both-sides --print sides.trace.footprint`"
        );
        Err(Refused::whole("tip", why))
    }
}

impl Serialize for Tip {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        TipDocument::from(&self.0).serialize(serializer)
    }
}

/// The fields of all forms of a footprint in one struct: the error of an untagged enumeration would only be that no
/// variant fits.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = r#"an object such as {"name": "gaussian"}"#)]
struct TipFields {
    /// A name as in documents (gaussians, bessel, cosine, footprint), triple-gaussian or gaussian.
    name: Option<String>,
    /// Weight β of the side lobes of triple-gaussian; default 1.
    beta: Option<f64>,
    /// Width of gaussian or triple-gaussian, in σ; default 1.
    width: Option<f64>,
    /// Terms of a sum of Gaussians.
    gaussians: Option<Vec<Gaussian>>,
    /// Terms g(x)h(y) of a footprint in three dimensions.
    layers: Option<Vec<LayerDocument>>,
    /// Positions x ≥ 0 of a table, in σ, ascending from 0.
    x: Option<Vec<f64>>,
    /// f at each x.
    f: Option<Vec<f64>>,
}

const UNKNOWN: &str = "a tip has a name (triple-gaussian, gaussian, bessel, cosine), or gaussians, or layers, or x and f";

impl TipFields {
    fn tip(self) -> Result<TipFunction, String> {
        let whole = |tip: TipDocument| tip.tip().map_err(|error| error.to_string());
        let Self { name, beta, width, gaussians, layers, x, f } = self;
        let named = |name| {
            let named = NamedTip { name: Some(name), beta, width };
            named.tip().map_err(|refused| refused.to_string())
        };
        match (name.as_deref(), gaussians, layers, x.zip(f)) {
            (None | Some("gaussians"), Some(gaussians), None, None) => {
                whole(TipDocument::Gaussians { gaussians })
            }
            (None | Some("footprint"), None, Some(layers), None) => {
                whole(TipDocument::Footprint { layers })
            }
            (None, None, None, Some((x, f))) => {
                let tip = TipFunction::table(&x, &f).map_err(|error| error.to_string())?;
                judge_details(&tip).map_err(|error| error.to_string())?;
                Ok(tip)
            }
            (None, None, None, None) => named(TipName::TripleGaussian),
            (Some(name), None, None, None) => {
                named(serde_json::from_value(name.into()).map_err(|_| UNKNOWN)?)
            }
            _ => Err(UNKNOWN.into()),
        }
    }
}

impl<'de> Deserialize<'de> for Tip {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        TipFields::deserialize(deserializer)?.tip().map(Self).map_err(D::Error::custom)
    }
}

#[cfg(feature = "schema")]
impl JsonSchema for Tip {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        TipDocument::schema_name()
    }

    /// The schema of the form that is written.
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        TipDocument::json_schema(generator)
    }
}

/// Dimensionless indentation rate, given as α or by its distance from the critical value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Indentation {
    /// Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.
    #[schemars(extend("x-option" = option("A", "Model", 3)))]
    pub alpha: Option<f64>,
    /// D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.
    #[schemars(extend("x-option" = option("D", "Model", 4)))]
    pub alpha_above: Option<f64>,
}

/// Largest relative difference at which α and αc + D count as equal.
const SAME: f64 = 1e-9;

impl Indentation {
    /// An indentation rate given as α.
    pub fn given(alpha: f64) -> Self {
        Self { alpha: Some(alpha), alpha_above: None }
    }

    /// An indentation rate given as αc(r) + D.
    pub fn above_critical(distance: f64) -> Self {
        Self { alpha: None, alpha_above: Some(distance) }
    }

    /// This indentation rate with α as a number. A resolved one is returned unchanged.
    ///
    /// # Errors
    /// Neither is given; both are given and differ; or αc does not exist.
    pub fn resolved(self, tip: &TipFunction, law: Wider, r: f64) -> Result<Self, Refused> {
        let Some(distance) = self.alpha_above else {
            let why =
                "the indentation rate is missing: give {alpha}, or {alpha_above} for αc(r) + D";
            return self.alpha.map(Self::given).ok_or_else(|| Refused::whole("alpha", why));
        };
        Model::under(law, tip.clone(), 0.0, r)?;
        let critical = stability::critical(&law, tip, r).map_err(|error| {
            Refused::number("alpha_above", distance, format!("{error}; give {{alpha}} instead"))
        })?;
        let found = critical.alpha + distance;
        match self.alpha {
            Some(alpha) if (alpha - found).abs() > SAME * found.abs() => {
                let [alpha, found] = [alpha, found].map(|value| Typed(value).to_string());
                let why =
                    format!("give one of them, not both: they are {alpha} and αc(r) + D = {found}");
                Err(Refused::whole("alpha and alpha_above", why))
            }
            Some(_) => Ok(self),
            None => Ok(Self { alpha: Some(found), ..self }),
        }
    }

    /// The model with this indentation rate, which must be resolved.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn model(&self, tip: &TipFunction, law: Wider, r: f64) -> Result<Model, Refused> {
        let alpha = self.alpha.unwrap_or(f64::NAN);
        Model::under(law, tip.clone(), alpha, r).map_err(|error| match (error, self.alpha_above) {
            (ModelError::Alpha(_), Some(distance)) => {
                Refused::number("alpha_above", distance, error)
            }
            _ => error.into(),
        })
    }
}

impl ModelParameters {
    /// The parameters of a resolved question, in the form of documents.
    pub(crate) fn of_question(tip: &Tip, indentation: Indentation, r: f64, law: Law) -> Self {
        let alpha = indentation.alpha.unwrap_or(f64::NAN);
        let alpha_above = indentation.alpha_above;
        let tip = (&tip.0).into();
        Self { tip, alpha, alpha_above, r, law }
    }
}
