//! Angle and wavelength of the strongest wave, with their errors.

use super::doubt::Doubt;
use super::estimate::Estimate;
use super::local::Local;
use super::sheet::Sheet;
use super::wave::Wave;
use std::f64::consts::{PI, TAU};

/// The strongest wave of an area, with its rivals.
pub(super) struct Vector {
    wave: Wave,
    q: Estimate,
    kappa: Estimate,
    angle: Estimate,
    length: Estimate,
    /// Waves of about the same power that make angle or wavelength uncertain.
    rivals: Vec<Wave>,
    lines: usize,
    /// Largest wave number across lines of this pitch.
    edge: f64,
}

/// Largest error of an angle that is reported, in degrees.
pub(super) const MOST_ANGLE: f64 = 15.0;
/// Largest relative error of a wavelength that is reported.
const MOST_LENGTH: f64 = 0.25;
/// Largest relative error of a significant wave number.
const NO_WAVE: f64 = 0.5;
/// Largest order of harmonics that are recognised as such.
const MOST_HARMONIC: f64 = 8.0;

impl Vector {
    /// The vector of the first of these waves, which are sorted by falling power.
    pub(super) fn of(sheet: &Sheet, local: &Local, waves: &[Wave], lines: usize) -> Self {
        let wave = waves[0];
        let extent = local.extent(sheet);
        // Half of what is resolved: TAU over the extent, halved.
        let (dq, dk) = (PI / extent.along, PI / extent.across);
        let quarters = local.waves();
        let estimate = |of: fn(&Wave, f64) -> f64, error: f64| {
            let sign = if wave.kappa < 0.0 { -1.0 } else { 1.0 };
            let quarters = quarters.map(|quarter| (of(&quarter, sign), quarter.power));
            Estimate::of_quarters(of(&wave, sign), &quarters).and(error)
        };
        let (q, kappa, k) = (wave.q, wave.kappa, wave.q.hypot(wave.kappa));
        let found = Self {
            wave,
            q: estimate(|wave, _| wave.q, dq),
            kappa: estimate(|wave, _| wave.kappa, dk),
            // Across zero of κ as it comes, so that upright crests have an error.
            angle: estimate(
                |wave, sign| wave.q.atan2(sign * wave.kappa).to_degrees(),
                ((kappa * dq).hypot(q * dk) / k.powi(2)).to_degrees(),
            ),
            length: estimate(|wave, _| wave.length(), TAU * (q * dq).hypot(kappa * dk) / k.powi(3)),
            rivals: vec![],
            lines,
            edge: PI / sheet.pitch,
        };
        let rivals: Vec<Wave> =
            waves[1..].iter().filter(|other| !found.covers(other)).copied().collect();
        let angle = rivals.iter().fold(found.angle, |angle, rival| angle.enclosing(rival.angle()));
        let length =
            rivals.iter().fold(found.length, |length, rival| length.enclosing(rival.length()));
        Self { angle, length, rivals, ..found }
    }

    /// Whether another wave is the same within the errors, or a harmonic.
    fn covers(&self, other: &Wave) -> bool {
        let order = (other.q / self.wave.q).round().clamp(1.0, MOST_HARMONIC);
        let turns = (other.kappa - order * self.wave.kappa) / (2.0 * self.edge);
        let kappa = 2.0 * self.edge * (turns - turns.round());
        (other.q - order * self.wave.q).abs() <= order * self.q.error
            && kappa.abs() <= order * self.kappa.error
    }

    /// Whether the wave number along the lines is significant, or much smaller than that across them.
    pub(super) fn is_wave(&self) -> bool {
        self.q.error <= NO_WAVE * self.wave.q || self.wave.q < NO_WAVE * self.wave.kappa.abs()
    }

    pub(super) fn changes(&self, sheet: &Sheet) -> [f64; 2] {
        self.wave.changes(sheet)
    }

    /// The angle in degrees; `None`, with a doubt, if it is undetermined.
    pub(super) fn crest_angle(&self, doubts: &mut Vec<Doubt>) -> Option<Estimate> {
        if self.wave.kappa.abs() > self.edge - self.kappa.error {
            doubts.push(Doubt::Antiphase);
            return None;
        }
        if self.angle.error <= MOST_ANGLE {
            return Some(self.angle);
        }
        if self.rivals.is_empty() {
            let error = self.angle.error;
            let lines = (self.lines as f64 * error / MOST_ANGLE).ceil() as usize;
            doubts.push(Doubt::Unresolved { error, lines });
        } else {
            doubts.push(self.competing());
        }
        None
    }

    /// The wavelength in σ; `None`, with a doubt, if it is undetermined, or if the wave still grows or decays.
    pub(super) fn wavelength(&self, is_settled: bool, doubts: &mut Vec<Doubt>) -> Option<Estimate> {
        let part = self.length.error / self.length.value;
        if part <= MOST_LENGTH {
            return is_settled.then_some(self.length);
        }
        let rivals = self.competing();
        if self.rivals.is_empty() {
            doubts.push(Doubt::Unmeasured(part));
        } else if !doubts.contains(&rivals) {
            doubts.push(rivals);
        }
        None
    }

    fn competing(&self) -> Doubt {
        let all = std::iter::once(&self.wave).chain(&self.rivals);
        Doubt::Rivals(all.map(|wave| (wave.length(), wave.angle())).collect())
    }
}
