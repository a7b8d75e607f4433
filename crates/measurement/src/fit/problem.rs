//! The residuals of all data sets, as a function of the searched parameters.

use super::data::{Data, Scan, Track, ground};
use super::parameters::{Name, Shape, Values};
use super::pattern::Pattern;
use super::wave::{Cycles, Wave};
use crate::least_squares::{Minimum, Residuals, differences, forward, minimum};
use crate::projection::{Projected, project};
use stickslip_stability::critical;
use stickslip_tip::sorting::ends;

/// A fit problem: data, model and parameters.
#[derive(Clone)]
pub(super) struct Problem<'a> {
    pub(super) shape: &'a Shape,
    pub(super) data: &'a [Data],
    /// Known or fixed parameters.
    pub(super) held: Values,
    /// Searched parameters, in order.
    pub(super) free: Vec<Name>,
    /// Standard deviation of the noise of each data set.
    pub(super) noise: Vec<f64>,
    /// Square root of the weight of each row.
    pub(super) weights: Vec<Vec<f64>>,
    pub(super) cycles: &'a Cycles,
    /// Whether α is searched by α/αc(r) - 1: there are no ripples below onset, and a search in α would often step
    /// beyond this limit.
    pub(super) by_excess: bool,
    /// Direction of the scan of each data set.
    pub(super) scans: Vec<Scan>,
    /// How the ripples repeat.
    pub(super) pattern: Pattern,
}

/// Columns, and the data to be represented by them.
type Columns = (Vec<Vec<f64>>, Vec<f64>);

/// Range of α/αc - 1 in the search.
const EXCESSES: std::ops::RangeInclusive<f64> = 1e-4..=5.0;
const RS: std::ops::RangeInclusive<f64> = 0.03..=20.0;

impl Problem<'_> {
    /// The parameters for these search variables: logarithms, then phases in turns. `None` outside of the range of
    /// motions.
    pub(super) fn values(&self, searched: &[f64]) -> Option<Values> {
        let mut values = self.held;
        self.free.iter().zip(searched).for_each(|(name, v)| values.set(*name, v.exp()));
        if self.by_excess && self.free.contains(&Name::Alpha) {
            let (excess, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
            let usable = EXCESSES.contains(&excess) && RS.contains(&r);
            let onset = if usable { self.onset(&values, r)?.0 } else { return None };
            values.set(Name::Alpha, onset * (1.0 + excess));
        }
        if self.by_wavelength() {
            let length = values.get(Name::Width)? / self.wavelength(&values)?;
            values.set(Name::Width, length);
        }
        Some(values)
    }

    /// Whether σ is searched by the resulting wavelength, which the data determine directly; α and r then change only the
    /// shape of the wave.
    fn by_wavelength(&self) -> bool {
        let tracks = self.data.iter().any(|data| !data.is_series());
        self.by_excess && tracks && self.free.contains(&Name::Width)
    }

    /// The problem with the i-th parameter fixed.
    pub(super) fn holding(&self, i: usize, value: f64) -> Self {
        let held = self.held.with(self.free[i], value);
        let mut free = self.free.clone();
        free.remove(i);
        Self { held, free, ..self.clone() }
    }

    /// The wavelength, in σ.
    pub(super) fn wavelength(&self, values: &Values) -> Option<f64> {
        let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
        Some(self.cycles.waves(&values.model(self.shape, alpha, r)?)?.ripple.wavelength)
    }

    /// The search variables for these values, without phases; `None` if a value is missing, or α is below onset.
    pub(super) fn searched_for(&self, values: &Values) -> Option<Vec<f64>> {
        let of = |name: &Name| {
            let value = values.get(*name)?;
            if self.by_excess && *name == Name::Alpha {
                let onset = self.onset(values, values.get(Name::R)?)?.0;
                let excess = value / onset - 1.0;
                return EXCESSES.contains(&excess).then(|| excess.ln());
            }
            if *name == Name::Width && self.by_wavelength() {
                return Some((value * self.wavelength(values)?).ln());
            }
            Some(value.ln())
        };
        self.free.iter().map(of).collect()
    }

    /// Number of search variables: the parameters, and the phases of each track.
    pub(super) fn searched(&self) -> usize {
        self.free.len() + self.data.iter().map(Data::phases).sum::<usize>()
    }

    /// Number of all fitted parameters, including those projected out.
    pub(super) fn parameters(&self) -> usize {
        self.searched() + self.data.iter().map(Data::linear).sum::<usize>()
    }

    pub(super) fn rows(&self) -> usize {
        self.data.iter().map(Data::rows).sum()
    }

    /// The projection of each data set, in units of its noise, and weighted.
    pub(super) fn parts(&self, searched: &[f64]) -> Option<Vec<Projected>> {
        let values = self.values(searched)?;
        let mut phases = searched[self.free.len()..].iter().copied();
        let part = |(i, data): (usize, &Data)| {
            let mine: Vec<f64> = phases.by_ref().take(data.phases()).collect();
            let (columns, rest) = self.weighted(i, &values, &mine)?;
            if columns.is_empty() {
                Some(Projected::nothing(rest))
            } else {
                project(&columns, &rest)
            }
        };
        self.data.iter().enumerate().map(part).collect()
    }

    /// The columns of the i-th data set that are projected out, in units of its noise, and weighted.
    pub(super) fn linear(&self, searched: &[f64], i: usize) -> Option<Vec<Vec<f64>>> {
        let values = self.values(searched)?;
        let before: usize = self.data[..i].iter().map(Data::phases).sum();
        let phases = &searched[self.free.len() + before..][..self.data[i].phases()];
        Some(self.weighted(i, &values, phases)?.0)
    }

    /// Columns and data, in units of the noise, and weighted.
    fn weighted(&self, i: usize, values: &Values, phases: &[f64]) -> Option<Columns> {
        let (columns, rest) = self.columns((&self.data[i], self.scans[i]), values, phases)?;
        let scaled = |column: Vec<f64>| -> Vec<f64> {
            column.into_iter().zip(&self.weights[i]).map(|(v, w)| v * w / self.noise[i]).collect()
        };
        Some((columns.into_iter().map(scaled).collect(), scaled(rest)))
    }

    /// The columns of the linear model of the data, and the data to be represented by them.
    fn columns(
        &self,
        (data, scan): (&Data, Scan),
        values: &Values,
        phases: &[f64],
    ) -> Option<Columns> {
        let waves = || {
            let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
            self.cycles.waves(&values.model(self.shape, alpha, r)?)
        };
        let width = values.get(Name::Width);
        match data {
            Data::Ripple(track) => {
                let (wave, width) = (waves()?.ripple, width?);
                let model = along(&wave, track, width, (phases[0], scan.sign()));
                Some(track_columns(track, model, width * width))
            }
            Data::Friction(track) | Data::Loop(track, _) => {
                let (wave, width) = (waves()?.lag, width?);
                let there = along(&wave, track, width, (phases[0], scan.sign()));
                let mut model: Vec<f64> = there.into_iter().map(|v| v + wave.mean).collect();
                let Data::Loop(_, back) = data else {
                    return Some(track_columns(track, model, width));
                };
                let here = along(&wave, track, width, (phases[1], -scan.sign()));
                model.extend(here.into_iter().map(|v| -v - wave.mean));
                let both = Track {
                    x: [&*track.x, &track.x].concat(),
                    y: [&*track.y, back].concat(),
                    ..*track
                };
                Some(track_columns(&both, model, width))
            }
            Data::Onsets { velocity, load } => {
                let rows = velocity.iter().zip(load).map(|(v, load)| {
                    let r = values.get(Name::RPerVelocity)? * v;
                    let alpha = values.get(Name::AlphaPerLoad)? * load;
                    Some((alpha / self.onset(values, r)?.0).ln())
                });
                Some((vec![], rows.collect::<Option<_>>()?))
            }
            Data::Wavelengths { velocity, load, wavelength } => {
                let rows = velocity.iter().zip(load).zip(wavelength).map(|((v, load), found)| {
                    let r = values.get(Name::RPerVelocity)? * v;
                    let alpha = values.get(Name::AlphaPerLoad)? * load;
                    let (onset, born) = self.onset(values, r)?;
                    // Below onset there are no ripples: the nearest are those that are born there.
                    let told = if alpha > onset * (1.0 + 1e-6) {
                        self.cycles.waves(&values.model(self.shape, alpha, r)?)?.ripple.wavelength
                    } else {
                        born
                    };
                    Some((found / (width? * told)).ln())
                });
                Some((vec![], rows.collect::<Option<_>>()?))
            }
        }
    }

    /// αc and the wavelength at αc.
    pub(super) fn onset(&self, values: &Values, r: f64) -> Option<(f64, f64)> {
        let model = values.model(self.shape, 1.0, r)?;
        let found = critical(model.wider(), model.tip(), r).ok()?;
        Some((found.alpha, found.wavelength))
    }
}

/// The wave minus its mean at these positions. The phase is the position of the crest of its first harmonic, in turns
/// from the middle, where it depends least on the wavelength; the direction is 1 or -1.
fn along(wave: &Wave, track: &Track, width: f64, (phase, direction): (f64, f64)) -> Vec<f64> {
    let (first, last) = ends(track.x.iter().copied());
    let middle = 0.5 * (first + last);
    let moved = phase * wave.wavelength - wave.crest();
    let wave = wave.clone().averaged(track.averaged, track.spacing() / width);
    track.x.iter().map(|x| wave.at(direction * (x - middle) / width - moved)).collect()
}

/// Columns of offset, slope and, unless the gain is known, the model.
fn track_columns(track: &Track, model: Vec<f64>, size: f64) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut columns = ground(&track.x);
    match track.gain {
        Some(gain) => {
            let rest = track.y.iter().zip(&model).map(|(y, v)| y - gain * size * v);
            (columns, rest.collect())
        }
        None => {
            columns.push(model.into_iter().map(|v| size * v).collect());
            (columns, track.y.clone())
        }
    }
}

impl Problem<'_> {
    /// The best fit with all parameters as logarithms, in which intervals are computed.
    pub(super) fn by_logarithms(&self, best: &Minimum) -> Option<(Self, Minimum)> {
        let values = self.values(&best.parameters)?;
        let problem = Self { by_excess: false, ..self.clone() };
        let mut at = problem.searched_for(&values)?;
        at.extend(&best.parameters[self.free.len()..]);
        // A last step, by the same derivatives as the intervals.
        let best = minimum(&problem, &at)?;
        Some((problem, best))
    }

    /// Derivatives at the best fit, more accurate than those of the search.
    pub(super) fn slopes(&self, here: &[f64], searched: &[f64]) -> Option<Vec<Vec<f64>>> {
        differences(self, (here, searched), self.pattern.step())
    }
}

impl Residuals for Problem<'_> {
    fn at(&self, searched: &[f64]) -> Option<Vec<f64>> {
        let parts = self.parts(searched)?;
        Some(parts.into_iter().flat_map(|part| part.residuals).collect())
    }

    fn derivatives(&self, here: &[f64], searched: &[f64]) -> Option<Vec<Vec<f64>>> {
        forward(self, (here, searched), self.pattern.step())
    }

    fn enough(&self) -> f64 {
        1e-6
    }
}
