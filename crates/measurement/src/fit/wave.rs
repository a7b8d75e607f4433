//! Surface and lag of a cycle over one wavelength, as Fourier series; and a cache of cycles from which later ones are
//! started.

use super::pattern::Pattern;
use std::cell::RefCell;
use std::f64::consts::TAU;
use stickslip_cycles::{Cycle, cycle, cycle_near};
use stickslip_tip::Model;

/// A periodic function of position, in σ, by its Fourier series.
#[derive(Debug, Clone)]
pub(super) struct Wave {
    pub(super) wavelength: f64,
    pub(super) mean: f64,
    /// Coefficients of cos and sin of 1, 2, … times the wave number.
    coefficients: Vec<(f64, f64)>,
}

/// Number of samples of a wavelength.
const SAMPLES: usize = 256;
/// Smallest harmonic kept, relative to the largest.
const NOTHING: f64 = 1e-8;

impl Wave {
    fn of(wavelength: f64, samples: &[f64]) -> Self {
        let count = samples.len();
        let turns: Vec<(f64, f64)> =
            (0..count).map(|i| (TAU * i as f64 / count as f64).sin_cos()).collect();
        let harmonic = |k: usize| {
            let (mut of_cos, mut of_sin) = (0.0, 0.0);
            for (i, value) in samples.iter().enumerate() {
                let (sin, cos) = turns[(i * k) % count];
                of_cos += value * cos;
                of_sin += value * sin;
            }
            (2.0 * of_cos / count as f64, 2.0 * of_sin / count as f64)
        };
        let mut coefficients: Vec<(f64, f64)> = (1..count / 3).map(harmonic).collect();
        let size = |(a, b): &(f64, f64)| a.hypot(*b);
        let largest = coefficients.iter().map(size).fold(0.0, f64::max);
        let last = coefficients.iter().rposition(|c| size(c) > NOTHING * largest);
        coefficients.truncate(last.map_or(0, |last| last + 1));
        let mean = samples.iter().sum::<f64>() / count as f64;
        Self { wavelength, mean, coefficients }
    }

    /// The wave averaged, about each position, over `count` positions at this distance from each other, in σ.
    pub(super) fn averaged(mut self, count: usize, distance: f64) -> Self {
        if count < 2 {
            return self;
        }
        let half = 0.5 * TAU * distance / self.wavelength;
        for (k, (c, s)) in self.coefficients.iter_mut().enumerate() {
            let angle = half * (k as f64 + 1.0);
            let part = (count as f64 * angle).sin() / (count as f64 * angle.sin());
            let part = if part.is_finite() { part } else { 1.0 };
            (*c, *s) = (*c * part, *s * part);
        }
        self
    }

    /// The value minus the mean.
    pub(super) fn at(&self, x: f64) -> f64 {
        let (sin, cos) = (TAU * x / self.wavelength).sin_cos();
        // Clenshaw's recurrence for both sums at once.
        let (mut a, mut b) = ((0.0, 0.0), (0.0, 0.0));
        for (c, s) in self.coefficients.iter().rev() {
            a = (c + 2.0 * cos * a.0 - a.1, a.0);
            b = (s + 2.0 * cos * b.0 - b.1, b.0);
        }
        cos * a.0 - a.1 + sin * b.0
    }

    /// The position of the crest of its first harmonic.
    pub(super) fn crest(&self) -> f64 {
        let (c, s) = self.coefficients.first().copied().unwrap_or((1.0, 0.0));
        s.atan2(c) / TAU * self.wavelength
    }
}

/// Waves of one motion: u far behind the tip against x, in kσ²/a, and the lag against the position of the support, in
/// σ.
#[derive(Debug, Clone)]
pub(super) struct Waves {
    pub(super) ripple: Wave,
    pub(super) lag: Wave,
}

impl Waves {
    fn of(cycle: &Cycle) -> Self {
        let (wavelength, motion, r) = (cycle.wavelength(), cycle.motion(), cycle.model().r());
        let part = |i: usize| i as f64 / SAMPLES as f64;
        let x: Vec<f64> = (0..SAMPLES).map(|i| wavelength * part(i)).collect();
        let lags: Vec<f64> = (0..SAMPLES).map(|i| motion.l(cycle.period() * part(i)) + r).collect();
        Self {
            ripple: Wave::of(wavelength, &cycle.surface_behind(&x)),
            lag: Wave::of(wavelength, &lags),
        }
    }
}

/// A cache of cycles that repeat in one way; each new one is started from the nearest.
#[derive(Debug)]
pub(super) struct Cycles {
    pattern: Pattern,
    last: RefCell<Vec<(Cycle, Waves)>>,
}

/// Number of cycles kept.
const KEPT: usize = 12;
/// Largest distance in ln α and ln r at which a cycle is started from another.
const NEAR: f64 = 0.2;

impl Cycles {
    /// No cycles yet of those that repeat in this way.
    pub(super) fn of(pattern: Pattern) -> Self {
        Self { pattern, last: RefCell::default() }
    }

    /// The waves of the cycle of a model; `None` if none is found.
    pub(super) fn waves(&self, model: &Model) -> Option<Waves> {
        let distance = |other: &Model| {
            let same = other.tip() == model.tip() && other.wider() == model.wider();
            let apart = (other.alpha() / model.alpha()).ln().hypot((other.r() / model.r()).ln());
            if same { apart } else { apart + 0.5 * NEAR }
        };
        let mut last = self.last.borrow_mut();
        let nearest = (0..last.len())
            .min_by(|a, b| distance(last[*a].0.model()).total_cmp(&distance(last[*b].0.model())));
        let found = nearest.filter(|i| distance(last[*i].0.model()) < NEAR).and_then(|i| {
            let (other, waves) = &last[i];
            if distance(other.model()) <= 0.0 {
                return Some((None, waves.clone()));
            }
            let near = cycle_near(model, other.motion(), self.pattern.tolerance()).ok()?;
            if self.pattern.slips > 1 && near.slips() != self.pattern.slips {
                return None;
            }
            let waves = Waves::of(&near);
            Some((Some(near), waves))
        });
        let (new, waves) = match found {
            Some(found) => found,
            None => {
                let found = self.found(model)?;
                let waves = Waves::of(&found);
                (Some(found), waves)
            }
        };
        if let Some(new) = new {
            if last.len() == KEPT {
                last.remove(0);
            }
            last.push((new, waves.clone()));
        }
        Some(waves)
    }

    /// The cycle of a model, found without a guess.
    fn found(&self, model: &Model) -> Option<Cycle> {
        let tolerance = self.pattern.tolerance();
        match self.pattern.slips {
            1 => of_one_crest(model, tolerance),
            slips => cycle(model, tolerance).ok().filter(|found| found.slips() == slips),
        }
    }
}

/// Ratio of α from one step to the next, and largest number of steps, in which a cycle is followed.
const RATIO: f64 = 0.96;
const STEPS: i32 = 12;

/// The cycle of a model, with one crest in a wavelength if there is one.
///
/// Beyond a period doubling a search without a guess finds a stable cycle of twice the wavelength, and one from a guess
/// nearby the cycle that doubled. A fit needs waves that do not depend on its way: they are those of the latter cycle.
fn of_one_crest(model: &Model, tolerance: f64) -> Option<Cycle> {
    let found = cycle(model, tolerance).ok()?;
    if found.slips() == 1 {
        return Some(found);
    }
    Some(followed_from_below(model, tolerance).unwrap_or(found))
}

/// The cycle with one crest, followed from an α at which a search without a guess finds it.
fn followed_from_below(model: &Model, tolerance: f64) -> Option<Cycle> {
    let below = |step: i32| {
        let alpha = model.alpha() * RATIO.powi(step);
        Model::under(*model.wider(), model.tip().clone(), alpha, model.r()).ok()
    };
    let (first, mut found) = (1..=STEPS)
        .map_while(|step| Some((step, cycle(&below(step)?, tolerance).ok()?)))
        .find(|(_, found)| found.slips() == 1)?;
    for step in (0..first).rev() {
        found = cycle_near(&below(step)?, found.motion(), tolerance).ok()?;
    }
    (found.slips() == 1).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::super::pattern::ONE;
    use super::*;
    use stickslip_tip::TipFunction;

    /// α/αc = 1.21, just beyond a period doubling.
    #[test]
    fn waves_beyond_a_period_doubling_do_not_depend_on_those_before() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let last = |alphas: &[f64]| {
            let cycles = Cycles::of(ONE);
            let lengths = alphas.iter().map(|alpha| {
                let model = Model::new(tip.clone(), *alpha, 2.056).unwrap();
                cycles.waves(&model).unwrap().ripple.wavelength
            });
            lengths.last().unwrap()
        };
        let [alone, followed] = [last(&[4.6364]), last(&[4.2, 4.35, 4.5, 4.6364])];
        assert!(followed < 10.0 && (alone - followed).abs() < 1e-4, "{alone} {followed}");
    }

    #[test]
    fn the_mean_of_neighbours_is_that_of_the_values() {
        let value = |x: f64| (x + 0.3).cos() + 0.4 * (2.0 * x).sin() - 0.2 * (5.0 * x).cos();
        let samples: Vec<f64> = (0..64).map(|i| value(TAU * f64::from(i) / 64.0)).collect();
        let wave = Wave::of(TAU, &samples);
        assert!((wave.at(1.1) - value(1.1)).abs() < 1e-12);
        let mean = (-2..=2).map(|i| value(1.1 + 0.07 * f64::from(i))).sum::<f64>() / 5.0;
        assert!((wave.averaged(5, 0.07).at(1.1) - mean).abs() < 1e-12);
    }
}
