//! Analysis of a track without a model: a periodic wave of any shape, and the noise from the scatter between
//! wavelengths.

use super::data::{Data, Track};
use super::noise::{Noise, one_line};
use super::start::least_between;
use super::subspace::{beyond, by_noise, dot, size};
use crate::projection::project;
use std::f64::consts::TAU;
use std::ops::Range;
use stickslip_tip::sorting::ends;

/// Rows of a track; a loop has two lines of them.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) lines: Vec<Range<usize>>,
}

impl Rows {
    /// The rows of a track; `None` for a series.
    pub(super) fn of(data: &Data) -> Option<Self> {
        let one = |track: &Track| {
            let rows = track.x.len();
            Self { x: track.x.clone(), y: track.y.clone(), lines: one_line(rows) }
        };
        match data {
            Data::Ripple(track) | Data::Friction(track) => Some(one(track)),
            Data::Loop(track, back) => {
                let rows = track.x.len();
                let x = [&*track.x, &track.x].concat();
                let y = [&*track.y, back].concat();
                Some(Self { x, y, lines: vec![0..rows, rows..2 * rows] })
            }
            Data::Onsets { .. } | Data::Wavelengths { .. } => None,
        }
    }

    fn extent(&self) -> f64 {
        let (first, last) = ends(self.x.iter().copied());
        last - first
    }

    /// The function of the position that is -1 at the first and 1 at the last row.
    fn part(&self) -> impl Fn(f64) -> f64 {
        let (first, last) = ends(self.x.iter().copied());
        move |x| (2.0 * x - first - last) / (last - first)
    }

    /// A column for each line, 0 on the other lines.
    fn columns(&self, value: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
        let on = |line: &Range<usize>| {
            let mut column = vec![0.0; self.x.len()];
            line.clone().for_each(|i| column[i] = value(self.x[i]));
            column
        };
        self.lines.iter().map(on).collect()
    }

    /// Offset and slope of every line.
    pub(super) fn ground(&self) -> Vec<Vec<f64>> {
        [self.columns(|_| 1.0), self.columns(self.part())].concat()
    }

    /// cos and sin of a number of turns per length, times a power of the position.
    fn wave(&self, turns: f64, power: i32) -> Vec<Vec<f64>> {
        let (first, last) = ends(self.x.iter().copied());
        let middle = 0.5 * (first + last);
        let angle = |x: f64| TAU * turns * (x - middle);
        let part = self.part();
        [
            self.columns(|x| angle(x).cos() * part(x).powi(power)),
            self.columns(|x| angle(x).sin() * part(x).powi(power)),
        ]
        .concat()
    }
}

/// A wave of any shape fitted to a track.
#[derive(Debug, Clone)]
pub(super) struct Comb {
    /// Wavelength, in the unit of the positions.
    pub(super) length: f64,
    /// Number of wavelengths along a line.
    pub(super) count: f64,
    harmonics: usize,
    /// Cosine and sine of each harmonic, and the derivative of the wave by its wavelength.
    pub(super) wave: Vec<Vec<f64>>,
    residuals: Vec<f64>,
}

/// Largest number of harmonics of the strongest wave; rows per wavelength that each requires, and total number of rows.
const HARMONICS: f64 = 12.0;
const ROWS_OF_A_WAVE: f64 = 4.0;
const ROWS_IN_ALL: f64 = 6.0;
/// Largest correction of the wavelength, in turns at the ends.
const OFF: f64 = 0.4;
/// Largest difference in the number of wavelengths along a line between two fits of one wave.
const NEXT: f64 = 0.15;

impl Comb {
    /// A fit close to this wavelength, which is this number of lengths of the strongest wave; `None` if there are too few
    /// rows.
    pub(super) fn near(rows: &Rows, length: f64, waves: usize) -> Option<Self> {
        let longest = rows.lines.iter().map(Range::len).max()? as f64;
        let count = rows.extent() / length;
        let harmonics = HARMONICS * waves as f64;
        let most = harmonics.min(longest / count / ROWS_OF_A_WAVE).min(longest / ROWS_IN_ALL);
        if most < 1.0 || most.is_nan() {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let harmonics = most as usize;
        let left = |turns: f64| {
            Self::fitted(rows, turns, harmonics)
                .map_or(f64::INFINITY, |(_, left)| dot(&left, &left))
        };
        let extent = rows.extent();
        let ends = ((count - OFF) / extent, (count + OFF) / extent);
        Self::at(rows, least_between(left, ends, 24), harmonics)
    }

    /// The fit at this wavelength if it is close to the current one, otherwise the current fit.
    pub(super) fn moved(self, rows: &Rows, length: f64) -> Self {
        if (rows.extent() / length - self.count).abs() > NEXT {
            return self;
        }
        Self::at(rows, 1.0 / length, self.harmonics).unwrap_or(self)
    }

    fn at(rows: &Rows, turns: f64, harmonics: usize) -> Option<Self> {
        let extent = rows.extent();
        let (coefficients, residuals) = Self::fitted(rows, turns, harmonics)?;
        let mut wave = Self::columns(rows, turns, harmonics);
        wave.push(slope(rows, turns, &coefficients));
        let length = 1.0 / turns;
        Some(Self { length, count: extent / length, harmonics, wave, residuals })
    }

    /// Whether there are enough wavelengths to show changes from one to the next.
    fn shows_changes(&self) -> bool {
        self.count >= FEWEST
    }

    /// Schwarz' criterion: the wave with the smallest value describes the track best.
    fn criterion(&self) -> f64 {
        let rows = self.residuals.len() as f64;
        let square = dot(&self.residuals, &self.residuals).max(f64::MIN_POSITIVE) / rows;
        rows * square.ln() + self.wave.len() as f64 * rows.ln()
    }

    fn columns(rows: &Rows, turns: f64, harmonics: usize) -> Vec<Vec<f64>> {
        (1..=harmonics).flat_map(|k| rows.wave(k as f64 * turns, 0)).collect()
    }

    /// Coefficients of the wave, and its residuals.
    fn fitted(rows: &Rows, turns: f64, harmonics: usize) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut columns = Self::columns(rows, turns, harmonics);
        let count = columns.len();
        columns.extend(rows.ground());
        let found = project(&columns, &rows.y)?;
        Some((found.coefficients[..count].to_vec(), found.residuals))
    }

    /// Columns of the first harmonics, and of the background of every line.
    pub(super) fn first(&self, rows: &Rows, harmonics: usize) -> Vec<Vec<f64>> {
        let most = (2 * harmonics * rows.lines.len()).min(self.wave.len() - 1);
        let mut found = rows.ground();
        found.extend_from_slice(&self.wave[..most]);
        found
    }

    /// Columns of the whole wave, and of the background of every line.
    pub(super) fn all(&self, rows: &Rows) -> Vec<Vec<f64>> {
        [rows.ground(), self.wave.clone()].concat()
    }

    /// Waves of twice the length: components that alternate from ripple to ripple.
    pub(super) fn doubled(&self, rows: &Rows) -> Vec<Vec<f64>> {
        if !self.shows_changes() {
            return vec![];
        }
        let waves = (0..self.harmonics.min(DOUBLED)).map(|k| k as f64 + 0.5);
        waves.flat_map(|k| rows.wave(k / self.length, 0)).collect()
    }

    /// First harmonics that grow, decay or shift along the track.
    pub(super) fn drifting(&self, rows: &Rows) -> Vec<Vec<f64>> {
        if !self.shows_changes() {
            return vec![];
        }
        let mut found = vec![];
        for k in 1..=self.harmonics.min(2) {
            found.extend(rows.wave(k as f64 / self.length, 1));
        }
        found.extend(rows.wave(1.0 / self.length, 2));
        found
    }

    /// The probability that chance alone changes the ripples along the track; `None` if there are too few rows.
    pub(super) fn drift(&self, rows: &Rows) -> Option<f64> {
        let others = [self.all(rows), self.doubled(rows)].concat();
        self.chance(rows, &beyond(&others, &self.drifting(rows)))
    }

    /// The probability that noise alone has as large a part in these directions as the track.
    fn chance(&self, rows: &Rows, directions: &[Vec<f64>]) -> Option<f64> {
        let besides = self.besides(rows);
        let noise = self.noise(rows, &besides);
        let Level { scale, freedom } = self.level(rows, &besides, &noise);
        let size = size(directions, &rows.y, &|v| noise.times(v), &[])?;
        by_noise(size / scale, directions.len(), freedom)
    }

    /// Level of the noise if these columns are fitted in addition. The columns remove most of the noise at low wave
    /// numbers; there the level is taken from the wave numbers between the columns.
    pub(super) fn level(&self, rows: &Rows, besides: &[Vec<f64>], noise: &Noise) -> Level {
        let freedom = self.freedom(noise, besides.len());
        let sound = Level { scale: 1.0, freedom };
        if noise.is_white() || !self.shows_changes() {
            return sound;
        }
        let between = (0..self.harmonics.min(DOUBLED))
            .flat_map(|k| [k as f64 + 0.25, k as f64 + 0.75])
            .flat_map(|k| rows.wave(k / self.length, 0));
        let taken = [self.all(rows), besides.to_vec()].concat();
        let directions = beyond(&taken, &between.collect::<Vec<_>>());
        match size(&directions, &rows.y, &|v| noise.times(v), &[]) {
            Some(found) => {
                Level { scale: found.max(1.0), freedom: freedom.min(directions.len() as f64) }
            }
            None => sound,
        }
    }

    /// The noise of the residuals if these columns are fitted in addition.
    pub(super) fn noise(&self, rows: &Rows, besides: &[Vec<f64>]) -> Noise {
        let columns = [self.all(rows), besides.to_vec()].concat();
        let found = project(&columns, &rows.y);
        let residuals = found.map_or_else(|| self.residuals.clone(), |found| found.residuals);
        let band = 2.0 * self.count * (self.harmonics as f64 + 0.5) * rows.lines.len() as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let within = band as usize + 2 * rows.lines.len();
        Noise::of(&residuals, &rows.lines, (columns.len(), within.min(rows.y.len())))
    }

    /// Columns of all doubled and drifting components. There are none if the rows are fewer than twice the number of
    /// all columns, those of the periodic wave included.
    pub(super) fn besides(&self, rows: &Rows) -> Vec<Vec<f64>> {
        let found = [self.doubled(rows), self.drifting(rows)].concat();
        if 2 * (found.len() + self.wave.len()) > rows.y.len() { vec![] } else { found }
    }

    /// Degrees of freedom of the estimate of the noise.
    pub(super) fn freedom(&self, noise: &Noise, besides: usize) -> f64 {
        let taken = (self.wave.len() + besides) as f64;
        (noise.effective() - 0.5 * taken).max(4.0)
    }
}

/// Reliability of an estimate of the noise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Level {
    /// Factor of the variances.
    pub(super) scale: f64,
    /// Degrees of freedom of the estimate.
    pub(super) freedom: f64,
}

/// Smallest number of wavelengths that shows changes from one to the next.
const FEWEST: f64 = 3.0;
/// Number of harmonics of twice the wavelength that are tested.
const DOUBLED: usize = 5;

/// The derivative of a wave by its number of turns.
fn slope(rows: &Rows, turns: f64, coefficients: &[f64]) -> Vec<f64> {
    let mut found = vec![0.0; rows.x.len()];
    let lines = rows.lines.len();
    for (k, pair) in coefficients.chunks(2 * lines).enumerate() {
        let k = k as f64 + 1.0;
        let waves = rows.wave(k * turns, 1);
        for line in 0..lines {
            let (cos, sin) = (&waves[line], &waves[lines + line]);
            let (a, b) = (pair[line], pair[lines + line]);
            for (sum, (cos, sin)) in found.iter_mut().zip(cos.iter().zip(sin)) {
                *sum += k * (b * cos - a * sin);
            }
        }
    }
    found
}

/// The probability that noise alone contains a wave as strong as the strongest of the track, whose length was chosen
/// among `trials`, if the track repeats after this number of lengths of it; `None` if there are too few rows.
pub(super) fn by_chance(rows: &Rows, length: f64, waves: usize, trials: f64) -> Option<f64> {
    let comb = Comb::near(rows, length * waves as f64, waves)?;
    let strongest = rows.wave(waves as f64 / comb.length, 0);
    let one = comb.chance(rows, &beyond(&rows.ground(), &strongest))?;
    Some(-f64::exp_m1(trials * f64::ln_1p(-one.min(1.0 - f64::EPSILON))))
}

/// Largest number of lengths of the strongest wave that are tried.
pub(super) const MOST_WAVES: usize = 8;

/// A wave of any shape of the number of lengths of the strongest wave after which a track repeats, by Schwarz' criterion.
pub(super) fn repeated(rows: &Rows, length: f64) -> Option<(usize, Comb)> {
    let comb = |waves: usize| {
        let comb = Comb::near(rows, length * waves as f64, waves)?;
        (waves == 1 || comb.shows_changes()).then_some((waves, comb))
    };
    let found = (1..=MOST_WAVES).filter_map(comb);
    found.min_by(|a, b| a.1.criterion().total_cmp(&b.1.criterion()))
}

#[cfg(test)]
mod tests {
    use super::super::subspace::probability;
    use super::*;

    fn track(wave: impl Fn(f64) -> f64) -> Rows {
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        let x: Vec<f64> = (0..400).map(|i| 0.1 * f64::from(i)).collect();
        let y = x.iter().map(|x| wave(*x) + 0.1 * random()).collect();
        Rows { x, y, lines: one_line(400) }
    }

    #[test]
    fn a_wave_is_told_from_noise_and_its_noise_from_it() {
        let wave = |x: f64| (TAU * x / 6.3).sin() + 0.4 * (2.0 * TAU * x / 6.3).cos();
        let rows = track(wave);
        let comb = Comb::near(&rows, 6.4, 1).unwrap();
        assert!((comb.length - 6.3).abs() < 0.01, "{}", comb.length);
        let noise = comb.noise(&rows, &[]).deviation();
        assert!((noise / 0.1 * 12_f64.sqrt() - 1.0).abs() < 0.1, "{noise}");
        assert!(by_chance(&rows, 6.3, 1, 200.0).unwrap() < 1e-12);
        assert!(by_chance(&track(|_| 0.0), 6.3, 1, 200.0).unwrap() > 1e-2);
    }

    #[test]
    fn every_other_ripple_and_a_growing_one_are_seen() {
        let judged = |rows: &Rows| {
            let comb = Comb::near(rows, 6.3, 1).unwrap();
            let besides = comb.besides(rows);
            let noise = comb.noise(rows, &besides);
            let of = |more: Vec<Vec<f64>>| {
                let directions = beyond(&comb.all(rows), &more);
                probability(&directions, &rows.y, &|v| noise.times(v), &[], 300.0).unwrap()
            };
            (of(comb.doubled(rows)), of(comb.drifting(rows)))
        };
        let wave = |x: f64| (TAU * x / 6.3).sin();
        let (doubling, drift) = judged(&track(wave));
        assert!(doubling > 0.01 && drift > 0.01, "{doubling} {drift}");
        let (doubling, _) = judged(&track(|x| wave(x) + 0.05 * (0.5 * TAU * x / 6.3).cos()));
        assert!(doubling < 1e-6, "{doubling}");
        let (_, drift) = judged(&track(|x| wave(x) * (1.0 + 0.004 * (x - 20.0))));
        assert!(drift < 1e-6, "{drift}");
    }

    /// A wave of length 20 whose second or third harmonic is the strongest, and one of the strongest alone.
    #[test]
    fn the_length_after_which_a_track_repeats_is_seen() {
        let noise = |i: u32| 0.05 * (1e4 * f64::from(i * i % 7919)).sin();
        let repeated = |strongest: f64, first: f64| {
            let x: Vec<f64> = (0..600_u32).map(|i| 0.25 * f64::from(i)).collect();
            let wave = |x: f64| (strongest * TAU * x / 20.0).sin() + first * (TAU * x / 20.0).cos();
            let y = (0..600_u32).map(|i| wave(0.25 * f64::from(i)) + noise(i)).collect();
            let rows = Rows { x, y, lines: one_line(600) };
            repeated(&rows, 20.0 / strongest).map(|found| found.0)
        };
        assert_eq!(repeated(1.0, 0.0), Some(1));
        assert_eq!(repeated(2.0, 0.5), Some(2));
        assert_eq!(repeated(3.0, 0.5), Some(3));
        assert_eq!(repeated(3.0, 0.0), Some(1));
    }
}
