//! The question `load-map`: at which load and velocity a tip writes ripples, and how far apart they are.
//!
//! One measured point fixes the map: at its load F₀ the indentation rate is α and the width of the contact σ, at its
//! velocity r. Elsewhere α is proportional to the load F. Where the contact is w times as wide, the same Γ, k and a
//! give the rate α (F/F₀)/w² and the velocity r/w; w follows from a power of F or a table. Lengths are in σ of the
//! measured point throughout.

use super::boundary::{judge_range, refused_range};
use crate::documents::table::{Array, Column, Named, Tabular};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, Failure, Law, Question, Refused, RegimeName, Tip};
use serde::{Deserialize, Serialize};
use stickslip_cycles::DEFAULT_TOLERANCE;
use stickslip_outcome::{Motion, motion};
use stickslip_stability::{Boundary, StabilityError};
use stickslip_tip::{Model, Wider};

/// Largest exponent of the width: beyond it α falls with the load.
const MOST_GROWTH: f64 = 0.5;
/// Steps of the bisection for a critical load, to its last bits.
const BISECTIONS: u32 = 60;
/// Factor by which a critical load may lie beyond the loads of the map.
const BEYOND: f64 = 1e3;
/// Number of loads per factor of e in the search for a critical load.
const PER_E: f64 = 8.0;

/// Regimes and wavelengths of ripples over load and velocity.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct LoadMap {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α at the load `load`; α is proportional to the load.
    #[schemars(extend("x-option" = option("A", "Load", 53)))]
    pub alpha: f64,
    /// Dimensionless support velocity r (12) of the measured point; above 0.
    #[schemars(extend("x-option" = option("R", "Raster", 31)))]
    pub r: f64,
    /// First and last load, in nN, above 0, such as 2nN:20nN: with `r_range`, compute where there are ripples, and
    /// their wavelength. There are as many loads as velocities, 41 by default.
    #[schemars(extend("x-option" = option("LO:HI", "Load", 50)))]
    pub load_range: [f64; 2],
    /// First and last r, above 0, and the number of values, both ends included.
    #[schemars(extend("x-option" = option("LO:HI:N", "Boundary", 20)))]
    pub r_range: [f64; 2],
    /// Load of the measured point, in nN, such as 10nN; above 0.
    #[schemars(extend("x-option" = option("F", "Load", 51)))]
    pub load: f64,
    /// Exponent s of a contact that grows with the load F, σ ∝ F^s: 1/3 by Hertz; 0 to 0.5. `load_widths` gives a table
    /// instead.
    #[schemars(extend("x-option" = option("S", "Load", 52)))]
    #[serde(default)]
    pub width_exponent: f64,
    /// Table of the width of the contact against the load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_widths: Option<LoadWidths>,
    /// Number of loads, and of velocities; from 2 to 1,000.
    #[serde(default = "default_points")]
    #[schemars(extend("x-option" = option("N", "Boundary", 21)))]
    pub points: usize,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
}

fn default_points() -> usize {
    41
}

/// Widths of the contact at several loads; a power of the load connects neighbours. Only ratios of widths count, so
/// that they may have any unit.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadWidths {
    /// Loads, ascending, in nN.
    #[serde(rename = "load_nN")]
    pub load: Vec<f64>,
    /// Width of the contact at each load, above 0.
    pub width: Vec<f64>,
}

impl LoadWidths {
    /// The reason why this is no table of widths over the whole range of loads; `None` if it is one.
    fn fault(&self, loads: [f64; 2]) -> Option<String> {
        let Self { load, width } = self;
        let are_good = |values: &[f64]| values.iter().all(|v| v.is_finite() && *v > 0.0);
        if load.len() != width.len() || load.len() < 2 {
            return Some("needs two rows or more, with a load and a width each".into());
        }
        if !(are_good(load) && are_good(width)) || load.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Some("loads and widths must be above 0, and each load be there once".into());
        }
        let (first, last) = (load[0], load[load.len() - 1]);
        loads.into_iter().find(|load| !(first..=last).contains(load)).map(|load| {
            format!("has loads from {first} to {last} nN, and none as far as {load} nN")
        })
    }

    /// The width at a load within the table.
    fn at(&self, load: f64) -> f64 {
        let last = self.load.len() - 1;
        let above = self.load.partition_point(|other| *other < load).clamp(1, last);
        let part = |values: &[f64]| (values[above] / values[above - 1]).ln();
        let exponent = part(&self.width) / part(&self.load);
        self.width[above - 1] * (load / self.load[above - 1]).powf(exponent)
    }
}

/// A map of loads and the question that it answers.
pub type LoadMapDocument = Document<LoadMap>;

/// The motion at one load and velocity.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadPoint {
    /// Load, in nN.
    #[serde(rename = "load_nN")]
    pub load: f64,
    /// Velocity of the support, in kσ/Γ.
    pub velocity: f64,
    /// α of the contact at this load, dimensionless.
    pub alpha: f64,
    /// Width of the contact, in σ of the measured point.
    pub width: f64,
    /// The regime that the tip settles into; null if the computation failed.
    pub regime: Option<RegimeName>,
    /// Distance of the ripples, in σ: the wavelength of the motion over its number of slips; null for regimes without ripples.
    pub wavelength: Option<f64>,
}

/// Motions over load and velocity.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadMapFound {
    /// The measured point.
    pub lever: LoadPoint,
    /// Load above which there are ripples at the velocity of the measured point, in nN; null if there is none.
    #[serde(rename = "lever_critical_load_nN")]
    pub lever_critical_load: Option<f64>,
    /// Velocities of the support, in kσ/Γ: the r of a contact of width σ.
    pub velocity: Vec<f64>,
    /// For each velocity the load above which steady motion is unstable, in nN; null if there is none up to a thousand times the
    /// largest load, or within the table of widths.
    #[serde(rename = "critical_load_nN")]
    pub critical_load: Vec<Option<f64>>,
    /// The points, velocity varying fastest.
    pub points: Vec<LoadPoint>,
}

impl Question for LoadMap {
    const FORMAT: &'static str = "stickslip/load-map";
    type Answer = LoadMapFound;
}

impl LoadMap {
    fn judged(&self) -> Result<(), Refused> {
        for (name, value) in [("alpha", self.alpha), ("r", self.r), ("load", self.load)] {
            Refused::positive(name, value)?;
        }
        if !(0.0..=MOST_GROWTH).contains(&self.width_exponent) {
            let why = format!("must be from 0, a constant width, to {MOST_GROWTH}; 0.333 by Hertz");
            return Err(Refused::number("width_exponent", self.width_exponent, why));
        }
        if self.points > 1000 {
            return Err(Refused::number("points", self.points as f64, "must be from 2 to 1,000"));
        }
        judge_range("load_range", self.load_range, self.points)?;
        judge_range("r_range", self.r_range, self.points)?;
        let Some(widths) = &self.load_widths else { return Ok(()) };
        if self.width_exponent != 0.0 {
            let why = "the widths are those of {load_widths}: leave one of them out";
            return Err(Refused::number("width_exponent", self.width_exponent, why));
        }
        let [low, high] = self.load_range;
        let fault = widths.fault([low.min(self.load), high.max(self.load)]);
        fault.map_or(Ok(()), |why| Err(Refused::whole("load_widths", why)))
    }

    /// Width of the contact at a load, in σ.
    fn width(&self, load: f64) -> f64 {
        match &self.load_widths {
            Some(widths) => widths.at(load) / widths.at(self.load),
            None => (load / self.load).powf(self.width_exponent),
        }
    }

    /// Whether the contact is equally wide at all loads.
    fn is_constant(&self) -> bool {
        self.load_widths.is_none() && self.width_exponent == 0.0
    }

    /// First and last load between which a critical load is sought; a table of widths bounds them.
    fn sought(&self) -> [f64; 2] {
        match &self.load_widths {
            Some(LoadWidths { load, .. }) => [load[0], load[load.len() - 1]],
            None => [self.load_range[0] / BEYOND, self.load_range[1] * BEYOND],
        }
    }

    /// α at a load, and r at a load and a velocity, both in units of the contact there.
    fn numbers(&self, load: f64, velocity: f64) -> (f64, f64) {
        let width = self.width(load);
        (self.alpha * (load / self.load) / (width * width), velocity / width)
    }

    /// The law in units of a contact of this width: the unit of heights, kσ²/a, grows with its square.
    fn law_at(&self, law: Wider, width: f64) -> Wider {
        Wider { depth_limit: law.depth_limit.map(|b| b / (width * width)), ..law }
    }

    fn point(&self, law: Wider, load: f64, velocity: f64) -> LoadPoint {
        let (width, (alpha, r)) = (self.width(load), self.numbers(load, velocity));
        let model = Model::under(self.law_at(law, width), self.tip.0.clone(), alpha, r).ok();
        let (regime, wavelength) = match model
            .and_then(|model| motion(&model, DEFAULT_TOLERANCE).ok())
        {
            None => (None, None),
            Some(Motion::Steady) => (Some(RegimeName::Steady), None),
            Some(Motion::Cycle(cycle)) => {
                (Some(RegimeName::StickSlip), Some(apart(cycle.wavelength(), cycle.slips())))
            }
            Some(Motion::Run(outcome)) => {
                let wavelength = outcome.oscillation.as_ref().map(|m| apart(m.wavelength, m.slips));
                (Some(outcome.regime.into()), wavelength)
            }
        };
        LoadPoint {
            load,
            velocity,
            alpha,
            width,
            regime,
            wavelength: wavelength.map(|l| width * l),
        }
    }

    /// α - αc at a load; `None` if steady motion is stable at every α there.
    fn excess(&self, law: Wider, load: f64, velocity: f64) -> Result<Option<f64>, Failure> {
        let (alpha, r) = self.numbers(load, velocity);
        match Boundary::new(&self.law_at(law, self.width(load)), &self.tip.0).at(r) {
            Ok(critical) => Ok(Some(alpha - critical.alpha)),
            Err(StabilityError::Stopped) => Err(Failure::Cancelled),
            Err(StabilityError::Wider(error)) => Err(Refused::from(error).into()),
            Err(_) => Ok(None),
        }
    }

    /// The lowest load above which steady motion is unstable at this velocity.
    fn critical_load(&self, law: Wider, velocity: f64) -> Result<Option<f64>, Failure> {
        let excess = |load: f64| self.excess(law, load, velocity);
        let is_unstable = |load: f64| Ok::<bool, Failure>(excess(load)?.is_some_and(|e| e > 0.0));
        if self.is_constant() {
            // αc does not depend on the load.
            let above = excess(self.load)?;
            return Ok(above.map(|above| self.load * (self.alpha - above) / self.alpha));
        }
        let [first, last] = self.sought();
        if self.load_widths.is_some() && is_unstable(first)? {
            // The critical load lies below the table.
            return Ok(None);
        }
        let steps = (PER_E * (last / first).ln()).ceil();
        let mut low = first;
        for step in 1..=steps as usize {
            let mut high = first * (last / first).powf(step as f64 / steps);
            if is_unstable(high)? {
                for _ in 0..BISECTIONS {
                    let middle = (low * high).sqrt();
                    if is_unstable(middle)? { high = middle } else { low = middle }
                }
                return Ok(Some(high));
            }
            low = high;
        }
        Ok(None)
    }
}

/// The distance of the ripples of a motion: if the period is doubled, a wavelength has two ripples.
fn apart(wavelength: f64, slips: usize) -> f64 {
    wavelength / slips.max(1) as f64
}

impl Ask for LoadMap {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.judged()?;
        self.law.dragged(&self.tip.0)?;
        Ok(self)
    }

    fn answer(&self, context: &Context) -> Result<(LoadMapFound, Vec<String>), Failure> {
        let law = self.law.dragged(&self.tip.0)?;
        let even =
            |[low, high]: [f64; 2]| crate::SpacingName::Linear.values([low, high], self.points);
        let (loads, velocity) = (even(self.load_range), even(self.r_range));
        let steps = self.points * (self.points + 1);
        let mut critical_load = vec![];
        for (n, velocity) in velocity.iter().enumerate() {
            critical_load.push(self.critical_load(law, *velocity)?);
            context.counted(n + 1, steps, "points")?;
        }
        let mut points = vec![];
        for load in &loads {
            for velocity in &velocity {
                points.push(self.point(law, *load, *velocity));
                context.counted(self.points + points.len(), steps, "points")?;
            }
        }
        let failed = points.iter().filter(|point| point.regime.is_none()).count();
        if failed == points.len() {
            let why = "no motion was found at any of these loads and velocities";
            return Err(refused_range("load_range", self.load_range, self.points, why).into());
        }
        let remark = (failed > 0).then(|| format!("no motion was found at {failed} points"));
        let lever = self.point(law, self.load, self.r);
        let lever_critical_load = self.critical_load(law, self.r)?;
        let found = LoadMapFound { lever, lever_critical_load, velocity, critical_load, points };
        Ok((found, remark.into_iter().collect()))
    }
}

impl Tabular for LoadMapFound {
    fn columns(&self) -> Vec<Named<'_>> {
        let of = |number: fn(&LoadPoint) -> f64| self.points.iter().map(number).collect();
        let word =
            |regime: Option<RegimeName>| regime.map_or(String::new(), |name| name.to_string());
        let critical = self.points.iter().enumerate();
        let critical = critical.map(|(n, _)| self.critical_load[n % self.velocity.len()]);
        vec![
            ("load_nN", of(|point| point.load)),
            ("velocity", of(|point| point.velocity)),
            ("alpha", of(|point| point.alpha)),
            ("width", of(|point| point.width)),
            ("regime", Column::words(self.points.iter().map(|point| word(point.regime)))),
            ("wavelength", self.points.iter().map(|point| point.wavelength).collect()),
            ("critical_load_nN", critical.collect()),
        ]
    }

    /// Loads, velocities, and the wavelength over both.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let columns = self.velocity.len().max(1);
        let row = |points: &[LoadPoint]| {
            points.iter().map(|point| point.wavelength.unwrap_or(f64::NAN)).collect::<Vec<_>>()
        };
        let loads = self.points.iter().step_by(columns).map(|point| point.load).collect::<Vec<_>>();
        let wavelength: Vec<Vec<f64>> = self.points.chunks(columns).map(row).collect();
        let critical = self.critical_load.iter().map(|load| load.unwrap_or(f64::NAN));
        vec![
            ("load_nN", Array::vector(loads)),
            ("velocity", Array::vector(&self.velocity[..])),
            ("critical_load_nN", Array::vector(critical.collect::<Vec<_>>())),
            ("wavelength", Array::matrix(&wavelength)),
        ]
    }
}
