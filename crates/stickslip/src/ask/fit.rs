//! The question `fit`: the parameters of the model that explain measured data.

use crate::documents::table::{Column, Named, Tabular};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, EstimateDocument, Failure, Question, Refused, Tip};
use serde::{Deserialize, Serialize};
use stickslip_measurement::{
    self as measurement, Alternative, Data, FitError, FitRequest, FittedNumber, Name, Part, Scan,
    Shape, Track, Values,
};
use stickslip_stability::critical;
use stickslip_tip::{Gaussian, TipFunction};

/// Parameters of the model estimated from measured data, with 95 % intervals by profile likelihood.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitFound {
    /// The fitted parameters.
    pub numbers: Vec<NumberFitted>,
    /// Correlation matrix of the logarithms of the fitted parameters.
    pub correlations: Vec<Vec<f64>>,
    /// αc at the known or fitted r, dimensionless; null if r is unknown, as for onsets and wavelengths.
    pub critical_alpha: Option<f64>,
    /// Each data set with its fit.
    pub data: Vec<DataFitted>,
    /// Total number of rows.
    pub rows: usize,
    /// Number of fitted parameters, including offsets, slopes, gains and phases.
    pub parameters_fitted: usize,
    /// Number of slips in a wavelength of the fitted motion: 2 beyond a period doubling.
    #[serde(default = "one")]
    pub slips: usize,
    /// Whether the model explains the data; if it does not, no parameter has an interval.
    #[serde(default = "yes")]
    pub explained: bool,
    /// For several data sets, the probability of an equally large deviation from one common model by chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_misfit: Option<f64>,
    /// Other minima of χ² that the data do not exclude at 99.7 %, the likeliest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alternatives: Vec<AlternativeDocument>,
    /// The best fit with a depth limit. Present if none was given, the data do not exclude one at 95 %, and it changes
    /// the parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with_depth_limit: Option<AlternativeDocument>,
}

/// A fit and the question that it answers.
pub type FitDocument = Document<Fit>;

/// Default of `explained` in documents of older versions.
fn yes() -> bool {
    true
}

/// Another minimum of χ².
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlternativeDocument {
    /// The parameters at this minimum, including the fixed ones.
    pub numbers: Vec<NumberHeld>,
    /// Direction of the scan, "right" or "left", for each data set.
    pub scans: Vec<String>,
    /// Excess of χ² over the best fit.
    pub behind: f64,
}

/// α, r and σ from measured ripples, lateral forces, onsets and wavelengths.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Fit {
    /// Footprint f(x), with x in σ; by default the triple Gaussian with β = 1. Documents contain the fitted β if it is
    /// free.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    pub tip: Option<Tip>,
    /// α, dimensionless, if known.
    #[schemars(extend("x-option" = option("A", "Known", 21)))]
    pub alpha: Option<f64>,
    /// r, dimensionless, if known.
    #[schemars(extend("x-option" = option("R", "Known", 20)))]
    pub r: Option<f64>,
    /// σ in the unit of the data, if known.
    pub width: Option<f64>,
    /// Depth limit b of (61), in kσ²/a, if known.
    #[schemars(extend("x-option" = option("B", "Known", 22)))]
    pub depth_limit: Option<f64>,
    /// Healing time T of the surface, in Γ/k, if known.
    #[schemars(extend("x-option" = option("T", "Known", 23)))]
    pub healing_time: Option<f64>,
    /// Inertia M of the tip, in Γ²/k, if known.
    #[schemars(extend("x-option" = option("M", "Known", 24)))]
    pub inertia: Option<f64>,
    /// Further parameters to fit. α, r and σ are free unless given.
    #[schemars(extend("x-option" = option("NAME,…", "Fitted", 30)))]
    pub free: Vec<FreeName>,
    /// Reduce the weight of outliers, by Huber's weights.
    #[schemars(extend("x-option" = option("", "Data", 12)))]
    pub robust: bool,
    /// Unit of lengths, for data without one and for the result; that of the first data by default.
    #[schemars(extend("x-option" = option("UNIT", "Data", 11)))]
    pub unit: Option<String>,
    /// Direction in which the tip moved along the positions of ripples and traces; both are tried by default.
    #[schemars(extend("x-option" = option("DIRECTION", "Data", 13)))]
    pub scan: Option<Scan>,
    /// Number of footprints used to propagate the error of a measured footprint.
    pub footprints: usize,
    /// Known parameters in documents of older versions.
    #[serde(skip_serializing)]
    pub known: Vec<NumberHeld>,
    /// Footprints drawn within the error of a measured one, each a sum of Gaussians with lengths in σ.
    #[serde(skip_serializing)]
    pub draws: Vec<Vec<Gaussian>>,
    /// The measured data sets, at least one. Documents contain them in the answer instead.
    #[serde(skip_serializing)]
    pub data: Vec<Measured>,
}

/// A parameter that is fitted on request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FreeName {
    /// Weight β of the side lobes of the triple Gaussian.
    Beta,
    /// Depth limit b.
    DepthLimit,
    /// Healing time T.
    HealingTime,
    /// Inertia M.
    Inertia,
}

/// A measured data set, with the name of its source, such as that of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Measured {
    /// Heights of ripples far behind the tip, along its path.
    Ripple {
        /// Name of the data.
        source: String,
        /// Positions.
        x: Vec<f64>,
        /// Heights.
        y: Vec<f64>,
        /// k/a, if known: heights are k/a times σ² times those of the model.
        gain: Option<f64>,
        /// Unit of the heights, such as nm or V; by default unknown.
        #[serde(default)]
        height_unit: Option<String>,
    },
    /// Lateral force against the position of the support.
    Friction {
        /// Name of the data.
        source: String,
        /// Positions of the support.
        x: Vec<f64>,
        /// Forces; for a loop, those of the trace.
        y: Vec<f64>,
        /// Forces of the retrace over the same positions.
        back: Option<Vec<f64>>,
        /// k, if known: forces are k times σ times those of the model.
        gain: Option<f64>,
        /// Unit of the forces, such as nN or V; by default unknown.
        #[serde(default)]
        force_unit: Option<String>,
    },
    /// Loads at the onset of stick-slip.
    Onsets {
        /// Name of the data.
        source: String,
        /// Velocities of the support.
        velocity: Vec<f64>,
        /// Loads.
        load: Vec<f64>,
        /// Unit of the velocities; by default unknown.
        #[serde(default)]
        velocity_unit: Option<String>,
        /// Unit of the loads; by default unknown.
        #[serde(default)]
        load_unit: Option<String>,
    },
    /// Wavelengths of ripples.
    Wavelengths {
        /// Name of the data.
        source: String,
        /// Velocities of the support.
        velocity: Vec<f64>,
        /// Loads.
        load: Vec<f64>,
        /// Wavelengths.
        wavelength: Vec<f64>,
        /// Unit of the velocities; by default unknown.
        #[serde(default)]
        velocity_unit: Option<String>,
        /// Unit of the loads; by default unknown.
        #[serde(default)]
        load_unit: Option<String>,
    },
}

impl Measured {
    /// The name of the data.
    pub fn source(&self) -> &str {
        match self {
            Self::Ripple { source, .. }
            | Self::Friction { source, .. }
            | Self::Onsets { source, .. }
            | Self::Wavelengths { source, .. } => source,
        }
    }

    /// The data by ascending position, averaged if there are more than a few thousand rows.
    fn reduced(self) -> Result<(String, Data), Refused> {
        let (source, data) = match self {
            Self::Ripple { source, x, y, gain, .. } => {
                (source, Data::Ripple(Track::new(x, y, gain)))
            }
            Self::Friction { source, x, y, back, gain, .. } => {
                let track = Track::new(x, y, gain);
                let data = match back {
                    Some(back) => Data::Loop(track, back),
                    None => Data::Friction(track),
                };
                (source, data)
            }
            Self::Onsets { source, velocity, load, .. } => {
                (source, Data::Onsets { velocity, load })
            }
            Self::Wavelengths { source, velocity, load, wavelength, .. } => {
                (source, Data::Wavelengths { velocity, load, wavelength })
            }
        };
        let refused = |error| Refused::word("data", &source, error);
        let data = data.reduced().map_err(refused)?;
        Ok((source, data))
    }
}

impl From<FreeName> for Name {
    fn from(name: FreeName) -> Self {
        match name {
            FreeName::Beta => Self::Beta,
            FreeName::DepthLimit => Self::DepthLimit,
            FreeName::HealingTime => Self::HealingTime,
            FreeName::Inertia => Self::Inertia,
        }
    }
}

/// A warning about a fit without a given footprint.
const ASSUMED: &str = "no footprint is given: the triple Gaussian of the paper, β = 1, is assumed; give the measured one with --tip-file";

impl Question for Fit {
    const FORMAT: &'static str = "stickslip/fit";
    type Answer = FitFound;
}

impl Fit {
    /// A fit to these data, with everything unknown.
    pub fn new(data: Vec<Measured>) -> Self {
        Self { data, ..Self::default() }
    }

    /// The value of a known parameter, by its name in documents.
    pub fn known(&self, name: &str) -> Option<f64> {
        match name {
            "alpha" => self.alpha,
            "r" => self.r,
            "width" => self.width,
            "depth_limit" => self.depth_limit,
            "healing_time" => self.healing_time,
            "inertia" => self.inertia,
            _ => None,
        }
        .or_else(|| self.known.iter().find(|held| held.name == name).map(|held| held.value))
    }

    /// All known parameters.
    fn all_known(&self) -> Result<Values, Refused> {
        let mut known = Values::default();
        for name in Name::ALL {
            let Some(value) = self.known(name.word()) else { continue };
            known.set(name, Refused::positive(name.word(), value)?);
        }
        Ok(known)
    }

    /// The units of the abscissas and ordinates of these data; `None` where they are unknown.
    fn units(&self, data: &Measured) -> [Option<String>; 2] {
        let lengths = &self.unit;
        let [x, y] = match data {
            Measured::Ripple { height_unit, .. } => [lengths, height_unit],
            Measured::Friction { force_unit, .. } => [lengths, force_unit],
            Measured::Onsets { velocity_unit, load_unit, .. } => [velocity_unit, load_unit],
            Measured::Wavelengths { velocity_unit, .. } => [velocity_unit, lengths],
        };
        [x.clone(), y.clone()]
    }

    /// The unit of a fitted parameter; `None` if it is unknown or the parameter is dimensionless.
    fn unit_of(&self, name: &str) -> Option<String> {
        let of_series = self.data.iter().find_map(|data| match data {
            Measured::Onsets { velocity_unit, load_unit, .. }
            | Measured::Wavelengths { velocity_unit, load_unit, .. } => {
                Some((velocity_unit.as_deref(), load_unit.as_deref()))
            }
            _ => None,
        });
        let (velocity, load) = of_series.unwrap_or_default();
        match name {
            "width" => self.unit.clone(),
            "alpha_per_load" => load.map(|unit| format!("1/{unit}")),
            "r_per_velocity" => velocity.map(|unit| match unit.split_once('/') {
                Some((length, time)) => format!("{time}/{length}"),
                None => format!("1/{unit}"),
            }),
            _ => None,
        }
    }

    fn is_free(&self, name: FreeName) -> bool {
        self.free.contains(&name)
    }

    /// The request for this fit, with the footprint and those drawn within its error.
    fn request(&self) -> Result<FitRequest, Refused> {
        let (shape, footprints) = if self.is_free(FreeName::Beta) {
            (Shape::Triple, vec![])
        } else {
            let refused = |error| Refused::whole("draws", error);
            let draws = self
                .draws
                .iter()
                .map(|draw| TipFunction::gaussian_sum(draw.clone()).map_err(refused));
            let tip = self.tip.clone().unwrap_or_default().0;
            (Shape::Known(tip), draws.collect::<Result<_, _>>()?)
        };
        Ok(FitRequest {
            shape,
            known: self.all_known()?,
            free: self.free.iter().copied().map(Into::into).collect(),
            robust: self.robust,
            scan: self.scan,
            footprints,
        })
    }

    /// The data, [reduced](Data::reduced), each with its name.
    fn reduced(&self) -> Result<Vec<(String, Data)>, Refused> {
        if self.data.is_empty() {
            return Err(Refused::whole("data", "at least one data set is needed"));
        }
        self.data.iter().cloned().map(Measured::reduced).collect()
    }

    /// The footprint, with this β if it was fitted.
    fn footprint(&self, beta: Option<f64>) -> Result<Tip, Refused> {
        let free = beta.filter(|_| self.is_free(FreeName::Beta));
        let Some(beta) = free else { return Ok(self.tip.clone().unwrap_or_default()) };
        Ok(Tip(TipFunction::triple_gaussian(beta, 1.0)?))
    }

    /// A rejection that names all data sets.
    fn refused(&self, error: &FitError) -> Refused {
        let sources: Vec<&str> = self.data.iter().map(Measured::source).collect();
        Refused::word("data", sources.join(", "), error)
    }
}

impl Ask for Fit {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        if self.is_free(FreeName::Beta)
            && self.tip.as_ref().is_some_and(|tip| beta(&tip.0).is_none())
        {
            let why = "β is that of the triple Gaussian: leave {tip} out";
            return Err(Refused::word("free", "beta", why).into());
        }
        self.tip.iter().try_for_each(|tip| tip.judge_even("a fit"))?;
        let heals = self.all_known()?.get(Name::HealingTime).is_some();
        let has_ripple = self.data.iter().any(|data| matches!(data, Measured::Ripple { .. }));
        if has_ripple && (heals || self.is_free(FreeName::HealingTime)) {
            let name = if heals { "healing_time" } else { "free" };
            let why = "on a surface that heals, ripples far behind the tip have faded: fit lateral \
                       forces, onsets or wavelengths";
            return Err(Refused::whole(name, why).into());
        }
        let footprints = if self.is_free(FreeName::Beta) { 0 } else { self.draws.len() };
        Ok(Self { footprints, ..self })
    }

    fn answer(&self, _: &Context) -> Result<(FitFound, Vec<String>), Failure> {
        let data = self.reduced()?;
        let rows: Vec<Data> = data.iter().map(|(_, rows)| rows.clone()).collect();
        let request = self.request()?;
        let found = measurement::fit(&rows, &request).map_err(|error| match error {
            FitError::Stopped => Failure::Cancelled,
            FitError::NoStart => Failure::Failed(error.to_string()),
            error => self.refused(&error).into(),
        })?;
        let critical_alpha = found.values.get(Name::R).and_then(|r| {
            let model = found.values.model(&request.shape, 1.0, r)?;
            critical(model.wider(), model.tip(), r).ok()
        });
        let mut answer = FitFound::of(&found, &data, critical_alpha.map(|at| at.alpha));
        for (fitted, measured) in answer.data.iter_mut().zip(&self.data) {
            [fitted.x_unit, fitted.y_unit] = self.units(measured);
        }
        for number in &mut answer.numbers {
            number.unit = self.unit_of(&number.name);
        }
        let is_assumed = self.tip.is_none() && !self.is_free(FreeName::Beta);
        let assumed = is_assumed.then(|| ASSUMED.into());
        Ok((answer, assumed.into_iter().chain(found.remarks).collect()))
    }

    fn answered(self, context: &Context) -> Result<Document<Self>, Failure> {
        let (answer, remarks) = context.within(|| self.answer(context))?;
        let beta = answer.numbers.iter().find(|number| number.name == Name::Beta.word());
        let tip = Some(self.footprint(beta.map(|number| number.estimate.value))?);
        Ok(Document::new(Self { tip, ..self }, answer, remarks))
    }
}

/// The weight β of a triple Gaussian (48) of width 1; `None` for any other footprint.
fn beta(tip: &TipFunction) -> Option<f64> {
    let TipFunction::Gaussians(sum) = tip else { return None };
    let beta = -2.0 * sum.terms().iter().find(|term| term.center > 0.0)?.amplitude;
    (TipFunction::triple_gaussian(beta, 1.0).ok()? == *tip).then_some(beta)
}

/// A parameter at a fixed value.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberHeld {
    /// Name, such as "alpha".
    pub name: String,
    /// Value of the parameter.
    pub value: f64,
}

/// A fitted parameter with its interval.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberFitted {
    /// "alpha" and "r", dimensionless; "width", σ in the unit of lengths; "beta"; "depth_limit" in kσ²/a,
    /// "healing_time" in Γ/k, "inertia" in Γ²/k. For onsets and wavelengths: "alpha_per_load" and "r_per_velocity".
    pub name: String,
    /// Unit of the parameter, such as nm, or 1/nN for an α per load; null if it is dimensionless or its unit is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Estimate and interval.
    pub estimate: EstimateDocument,
    /// Values at which the parameter was held in the profile likelihood, ascending.
    pub profile_values: Vec<f64>,
    /// Signed root of the excess of χ² over its minimum at each of `profile_values`: the interval ends at about ±1.96.
    pub profile_roots: Vec<f64>,
}

/// Measured data, in their own units, with the fitted model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DataFitted {
    /// Kind of the data: "ripple", "friction", "loop", "onsets" or "wavelengths".
    pub kind: String,
    /// Name of the file as given.
    pub source: String,
    /// Positions, or velocities for onsets and wavelengths.
    pub x: Vec<f64>,
    /// Heights, forces (trace of a loop, then retrace), loads at onset or wavelengths.
    pub y: Vec<f64>,
    /// Unit of `x`, such as nm or um/s; null if it is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_unit: Option<String>,
    /// Unit of `y`, such as nm or V; null if it is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y_unit: Option<String>,
    /// Value of the model for each entry of `y`, in its unit.
    pub model: Vec<f64>,
    /// Standard deviation of the residuals in the unit of `y`, or relative for onsets and wavelengths.
    pub residual: f64,
    /// Linear background at position 0, in the unit of `y`; null if it is not fitted.
    pub offset: Option<f64>,
    /// Slope of the background, in the unit of `y` per unit of `x`; null if it is not fitted.
    pub slope: Option<f64>,
    /// Scale factor, fitted or given: k/a for heights, k for forces.
    pub gain: Option<f64>,
    /// Probability of an equally large periodic residual by chance; below 0.005 the model does not explain the data.
    /// Null if there are too few rows.
    pub misfit: Option<f64>,
    /// Probability that chance alone makes a component of twice the wavelength; below 0.001 ripples are period-doubled.
    #[serde(default)]
    pub doubling: Option<f64>,
    /// Probability that chance alone changes the ripples along the track; below 0.001 the motion has not settled.
    #[serde(default)]
    pub drift: Option<f64>,
    /// Standard deviation of the noise, from the scatter between wavelengths, in the unit of `y`.
    #[serde(default)]
    pub noise: Option<f64>,
    /// Number of independent rows with as much information as the rows of the data.
    #[serde(default)]
    pub effective_rows: Option<f64>,
    /// Direction of the scan along `x`: "right" or "left"; null for onsets and wavelengths.
    #[serde(default)]
    pub scan: Option<String>,
    /// Number of rows of the file averaged into each entry of `y`.
    #[serde(default = "one")]
    pub averaged: usize,
}

/// Default of `averaged` in documents of older versions.
fn one() -> usize {
    1
}

fn words(scan: Scan) -> String {
    scan.word().into()
}

impl From<&Alternative> for AlternativeDocument {
    fn from(other: &Alternative) -> Self {
        let number = |name: Name| {
            Some(NumberHeld { name: name.word().into(), value: other.values.get(name)? })
        };
        Self {
            numbers: Name::ALL.into_iter().filter_map(number).collect(),
            scans: other.scans.iter().copied().map(words).collect(),
            behind: other.behind,
        }
    }
}

impl FitFound {
    /// The document of a fit to these data, [reduced](Data::reduced), each with the name of its file.
    fn of(found: &measurement::Fit, data: &[(String, Data)], critical_alpha: Option<f64>) -> Self {
        let each = data.iter().zip(&found.parts);
        Self {
            numbers: found.numbers.iter().map(NumberFitted::from).collect(),
            correlations: found.correlations.clone(),
            critical_alpha,
            data: each.map(|((source, data), part)| DataFitted::of(source, data, part)).collect(),
            rows: found.rows,
            parameters_fitted: found.parameters,
            slips: found.slips,
            explained: found.explained,
            joint_misfit: found.joint,
            alternatives: found.alternatives.iter().map(AlternativeDocument::from).collect(),
            with_depth_limit: found.with_depth_limit.as_ref().map(AlternativeDocument::from),
        }
    }
}

impl From<&FittedNumber> for NumberFitted {
    fn from(number: &FittedNumber) -> Self {
        let (profile_values, profile_roots) = number.profile.iter().copied().unzip();
        let mut estimate = EstimateDocument::from(number.estimate);
        // All are above 0: to exclude nothing below is to exclude nothing above 0.
        estimate.low = estimate.low.filter(|low| *low > 0.0);
        let name = number.name.word().into();
        Self { name, unit: None, estimate, profile_values, profile_roots }
    }
}

impl DataFitted {
    fn of(source: &str, data: &Data, part: &Part) -> Self {
        let (kind, x, y) = match data {
            Data::Ripple(track) => ("ripple", track.x.clone(), track.y.clone()),
            Data::Friction(track) => ("friction", track.x.clone(), track.y.clone()),
            Data::Loop(track, back) => {
                ("loop", [&*track.x, &track.x].concat(), [&*track.y, back].concat())
            }
            Data::Onsets { velocity, load } => ("onsets", velocity.clone(), load.clone()),
            Data::Wavelengths { velocity, wavelength, .. } => {
                ("wavelengths", velocity.clone(), wavelength.clone())
            }
        };
        let (averaged, given) = match data {
            Data::Ripple(track) | Data::Friction(track) | Data::Loop(track, _) => {
                (track.averaged, track.gain)
            }
            Data::Onsets { .. } | Data::Wavelengths { .. } => (1, None),
        };
        Self {
            kind: kind.into(),
            source: source.into(),
            x,
            y,
            x_unit: None,
            y_unit: None,
            model: part.model.clone(),
            residual: part.residual,
            offset: part.offset,
            slope: part.slope,
            gain: part.gain.or(given),
            misfit: part.judged.misfit,
            doubling: part.judged.doubling,
            drift: part.judged.drift,
            noise: part.judged.noise,
            effective_rows: part.judged.effective,
            scan: part.scan.map(words),
            averaged,
        }
    }
}

impl Tabular for FitFound {
    /// The parameters as a table, with a row for each parameter.
    fn columns(&self) -> Vec<Named<'_>> {
        let names = self.numbers.iter().map(|n| n.name.clone());
        let of = |of: fn(&EstimateDocument) -> Option<f64>| {
            self.numbers.iter().map(|n| of(&n.estimate)).collect()
        };
        vec![
            ("number", Column::words(names)),
            ("value", of(|e| Some(e.value))),
            ("low", of(|e| e.low)),
            ("high", of(|e| e.high)),
        ]
    }
}
