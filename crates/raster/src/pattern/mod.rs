//! The pattern of the lines: ripples and their wave vector, pits, or disorder.

mod bunched;
mod doubt;
mod estimate;
mod local;
mod regime;
mod sheet;
#[cfg(test)]
mod tests;
mod vector;
mod wave;
mod window;

pub use doubt::Doubt;
pub use regime::Regime;

use crate::grooves::Grooves;
use crate::line::Line;
use crate::path::Path;
use crate::plan::Plan;
use crate::surface::Scanned;
use estimate::Estimate;
use local::Local;
use rayon::prelude::*;
use regime::{FLAT, Measures, PITTED};
use sheet::{Sheet, halves_of};
use stickslip_tip::sorting::ends;
use vector::Vector;
use wave::Wave;
use window::{ALONG, FEWEST_ROWS, Window};

/// The pattern after some lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The regime of the surface.
    pub regime: Regime,
    /// The ripple; `None` if there is none.
    pub pattern: Option<Pattern>,
    /// Reasons why a result is not reported, or may differ after more lines.
    pub doubts: Vec<Doubt>,
}

/// The strongest ripple e^{i(qx + κy)}, the highest maximum of the power spectrum of the last half of the lines.
///
/// Errors are halves of 95 % intervals, from half of the resolution of the window and from the scatter among its quarters.
/// A wavelength is reported if its error is at most 25 % and the wave neither grows nor decays; a crest angle if its error
/// is at most 15° and κ is not ±π/d within its error, where d is the distance of the lines. The coherence is
/// |Σ ψ_n* ψ_{n+1}| over √(Σ|ψ_n|² Σ|ψ_{n+1}|²), with ψ the local complex amplitude of the groove of each line alone: 1 if
/// all shifts are equal. Around a defect the phase of ψ turns once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "PatternDocument"))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "The strongest ripple e^{i(qx + κy)}, the highest maximum of the power spectrum of the last half of the lines.\nErrors are halves of 95 % intervals. A number that these lines do not determine is null, with the reason in\n`remarks`."
    )
)]
pub struct Pattern {
    /// Wave number along the lines, in 1/σ, 0 for trenches along the scan; null if several waves have about the same power.
    pub q: Option<f64>,
    /// Wave number κ across the lines, in 1/σ; null if q is, and at ±π/pitch, where its sign is undefined.
    pub kappa: Option<f64>,
    /// 2π/√(q² + κ²), in σ; null also if ripples still grow or decay from line to line.
    pub wavelength: Option<f64>,
    /// Error of the wavelength (95 %), in σ.
    #[cfg_attr(feature = "serde", serde(default))]
    pub wavelength_error: Option<f64>,
    /// Angle between crests and scan axis, atan(q/|κ|), in degrees.
    pub crest_angle: Option<f64>,
    /// Error of the crest angle (95 %), in degrees.
    #[cfg_attr(feature = "serde", serde(default))]
    pub crest_angle_error: Option<f64>,
    /// Correlation of each line with the one before, shifted by the same distance for all lines; at most 1.
    pub coherence: f64,
    /// Error of the coherence (95 %).
    #[cfg_attr(feature = "serde", serde(default))]
    pub coherence_error: Option<f64>,
    /// Coherence of successive lines in the same direction, on a zigzag.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub coherence_same_way: Option<f64>,
    /// Half peak-to-peak of the surface, in kσ²/a.
    pub amplitude: f64,
    /// Number of places at which a crest begins or ends.
    pub defects: usize,
}

impl Pattern {
    /// The ripple with this wave, of which wavelength and angle, and the coherence in the same direction, may be unknown.
    fn of(
        wave: &Wave,
        (wavelength, angle): (Option<Estimate>, Option<Estimate>),
        (coherence, same_way): (Estimate, Option<Estimate>),
        amplitude: f64,
        defects: usize,
    ) -> Self {
        Self {
            q: wavelength.map(|_| wave.q),
            kappa: wavelength.and(angle).map(|_| wave.kappa),
            wavelength: wavelength.map(|of| of.value),
            wavelength_error: wavelength.map(|of| of.error),
            crest_angle: angle.map(|of| of.value),
            crest_angle_error: angle.map(|of| of.error),
            coherence: coherence.value,
            coherence_error: Some(coherence.error),
            coherence_same_way: same_way.map(|of| of.value),
            amplitude,
            defects,
        }
    }
}

impl Pattern {
    /// Wavelength and crest angle, such as "4.57 ± 0.33 σ" and "46 ± 3°"; `None` if unknown.
    pub fn in_words(&self) -> [Option<String>; 2] {
        let of = |value: Option<f64>, error: Option<f64>, unit: &str| {
            let value = value?;
            Some(match error.filter(|error| *error > 0.0) {
                Some(error) => format!("{}{unit}", with_error(value, error)),
                None => format!("{value:.3}{unit}"),
            })
        };
        [
            of(self.wavelength, self.wavelength_error, " σ"),
            of(self.crest_angle, self.crest_angle_error, "°"),
        ]
    }
}

/// A value with its error, rounded so that the error has two digits.
fn with_error(value: f64, error: f64) -> String {
    let places = (1.0 - error.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.places$} ± {error:.places$}")
}

/// The larger of these changes of a wave, if it has not settled.
fn changing(changes: [f64; 2]) -> Option<Doubt> {
    let is_changing = changes.iter().any(|factor| factor.ln().abs() > SETTLED);
    let most = changes.into_iter().max_by(|a, b| a.ln().abs().total_cmp(&b.ln().abs()));
    most.filter(|_| is_changing).map(Doubt::Changing)
}

/// Regimes of motion along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "LineRegimeName"))]
pub enum LineRegime {
    /// The lag changes by less than 2 % between 20 % and 85 % of the line.
    Steady,
    /// The lag changes by 2 % or more between 20 % and 85 % of the line.
    StickSlip,
    /// The tip covered less than half of the line: it stayed in a pit at one of its ends.
    StuckAtTheEdge,
}

/// Points per width of the footprint.
const POINTS: f64 = 4.0;
/// Smallest number of wavelengths along the window that count as ripples.
const FEWEST_WAVES: f64 = 2.0;
/// Lines count as alike if the part of the relief that differs between them is below this fraction of it.
const ALIKE: f64 = 0.5;
/// Relative error of the amplitude.
const AMPLITUDE_ERROR: f64 = 0.2;
/// Error of the fraction of a wave that remains away from the edges.
const KEPT_ERROR: f64 = 0.1;
/// Largest change of the logarithm of the relief, between the two halves of the lines, of a settled pattern.
const SETTLED: f64 = 0.1;
/// Smallest factor of differences between lines, from one half of the lines to the other, that counts as growth.
const GROWS: f64 = 1.02;
/// Smallest size of these differences, in units of the tolerance times the carved depth.
const SEEN: f64 = 10.0;
/// Largest relative change of a steady lag.
const SAME_LAG: f64 = 0.02;

/// The result for these lines: the regime, the pattern if there is one, and doubts.
///
/// The evaluated window is the last half of the lines (at most 256, without those that later lines would still
/// change), from 20 % to 85 % of their length. The pattern is the strongest maximum of the power spectrum in this
/// window (Hann).
pub fn pattern(plan: &Plan, lines: &[Line]) -> Written {
    let mut doubts = vec![];
    let stuck: Vec<bool> = lines.par_iter().map(is_stuck).collect();
    let count = |stuck: &[bool]| stuck.iter().filter(|stuck| **stuck).count();
    let all = count(&stuck);
    if all > 0 {
        doubts.push(Doubt::Stuck { lines: all, of: lines.len() });
    }
    let last = &stuck[lines.len() / 2..];
    if 2 * count(last) > last.len() {
        return Written { regime: Regime::StuckAtTheEdge, pattern: None, doubts };
    }
    let unknown = |mut doubts: Vec<Doubt>, why: Doubt| {
        doubts.push(why);
        Written { regime: Regime::Unknown, pattern: None, doubts }
    };
    if plan.free.is_some() {
        let window = match Window::of(plan, lines.len()) {
            Ok(window) => window,
            Err(why) => return unknown(doubts, why),
        };
        if let Some(written) = bunched::bunched(plan, lines, &window) {
            doubts.extend(written.doubts);
            return Written { doubts, ..written };
        }
    }
    let sheets = match sheets(plan, lines) {
        Ok(sheets) => sheets,
        Err(why) => return unknown(doubts, why),
    };
    let seen = Seen::of(plan, &sheets, lines.len());
    let mut written = match seen {
        Ok(seen) => seen.written(doubts),
        Err(why) => return unknown(doubts, why),
    };
    let is_growing = |doubt: &Doubt| matches!(doubt, Doubt::Growing { .. });
    let is_still = written.regime == Regime::Steady && !written.doubts.iter().any(is_growing);
    if is_still && plan.free.is_some() {
        written.doubts.extend(bunched::growing(plan, lines));
    }
    written
}

/// The regime of one line.
pub fn line_regime(plan: &Plan, line: &Line) -> LineRegime {
    if is_stuck(line) {
        return LineRegime::StuckAtTheEdge;
    }
    let duration = plan.duration_of(line.track().length);
    let at = |i: u32| {
        let part = ALONG.0 + (ALONG.1 - ALONG.0) * f64::from(i) / 400.0;
        line.lag(part * duration).abs()
    };
    let (low, high) = ends((0..=400).map(at));
    if high - low < SAME_LAG * high { LineRegime::Steady } else { LineRegime::StickSlip }
}

/// Whether the tip covered less than half of its line.
fn is_stuck(line: &Line) -> bool {
    let (track, start) = (line.track(), line.x0(0.0));
    let end = line.x0(line.trajectory().end());
    track.along(end) - track.along(start) < 0.5 * track.length
}

/// The evaluated part of lines and surface.
struct Sheets<'a> {
    plan: &'a Plan,
    /// The surface on each line.
    surface: Sheet,
    /// The evaluated lines, and their points.
    lines: &'a [Line],
    x: Vec<f64>,
    /// Mean carved depth.
    depth: f64,
    /// Fraction of the relief of the first half of the lines that remains after the second half was scanned.
    healed: f64,
}

fn sheets<'a>(plan: &'a Plan, lines: &'a [Line]) -> Result<Sheets<'a>, Doubt> {
    let window = Window::of(plan, lines.len())?;
    let Window { first, end, from, to, pitch } = window;
    let width = 8.7 / plan.band();
    let (spacing, x) = window.points((POINTS * (to - from) / width) as usize);
    let y: Vec<f64> = lines[first..end].iter().map(|line| line.track().y).collect();
    let heights = Scanned::new(plan, felt(plan, lines, (y[0], y[y.len() - 1]))).heights(&x, &y);
    let surface = Sheet::new(heights, (from, spacing), pitch, plan.band());
    let (depth, healed) = window.depth_and_healing(plan, lines);
    let sheets = Sheets { plan, surface, lines: &lines[first..end], x, depth, healed };
    let visible = sheets.surface.visible_rows();
    if visible < FEWEST_ROWS as f64 && sheets.surface.amplitude() > FLAT * depth {
        let healed = plan.law.model.wider().healing_time.is_some();
        return Err(Doubt::FewVisible { lines: visible.round() as usize, healed });
    }
    Ok(sheets)
}

/// The lines that have an effect on rows between these y. Between them none may be left out, as surfaces heal.
fn felt<'a>(plan: &Plan, lines: &'a [Line], (low, high): (f64, f64)) -> &'a [Line] {
    let (low, high) = (low - plan.reach_across(), high + plan.reach_across());
    let is_felt = |line: &Line| {
        // The tip itself may be elsewhere.
        let off = if line.is_free() { farthest_across(line) } else { 0.0 };
        (low - off..=high + off).contains(&line.track().y)
    };
    let ends = (lines.iter().position(is_felt), lines.iter().rposition(is_felt));
    &lines[ends.0.unwrap_or(0)..ends.1.map_or(0, |last| last + 1)]
}

/// Largest distance of the tip from its line.
fn farthest_across(line: &Line) -> f64 {
    let y = line.track().y;
    line.visits().iter().map(|visit| (visit.y - y).abs()).fold(0.0, f64::max)
}

/// Measured quantities.
struct Seen {
    measures: Measures,
    pattern: Option<Pattern>,
    doubts: Vec<Doubt>,
}

impl Seen {
    fn of(plan: &Plan, sheets: &Sheets, lines: usize) -> Result<Self, Doubt> {
        let sheet = &sheets.surface;
        // Of a tip that carves nothing the depth is 0.
        let amplitude = sheet.amplitude() / sheets.depth.max(f64::MIN_POSITIVE);
        let amplitude = Estimate { value: amplitude, error: AMPLITUDE_ERROR * amplitude };
        let certain = Estimate { value: 1.0, error: 0.0 };
        let growing = growing(plan, sheets, lines);
        let flat = Measures { amplitude, kept: certain, straightness: certain, followed: certain };
        if amplitude.value + amplitude.error < FLAT {
            return Ok(Self {
                measures: flat,
                pattern: None,
                doubts: growing.into_iter().collect(),
            });
        }
        let length = sheet.spacing * sheet.u.ncols() as f64 / (ALONG.1 - ALONG.0);
        let waves = Wave::strongest(sheet, FEWEST_WAVES);
        let Some(wave) = waves.first() else { return Err(Doubt::NoWave(2.0 * length)) };
        let local = Local::of(sheet, wave);
        let vector = Vector::of(sheet, &local, &waves, lines);
        let is_upright = wave.kappa.abs() <= sheet.resolution().1;
        let changes = vector.changes(sheet).map(|factor| factor * sheets.healed);
        let changing = changing(changes);
        // An oblique wave may still spread from the edge while it grows.
        let is_of_the_edge = is_upright || changing.is_none();
        let kept = if is_of_the_edge { sheets.kept(plan.path, &local) } else { certain };
        let is_alike = is_upright && unlike(sheet) < ALIKE;
        let is_wave = !is_alike || vector.is_wave();
        let own = Local::of(&sheets.own(), wave);
        let coherence = own.coherence(1);
        let same_way = (plan.path == Path::Zigzag).then(|| own.coherence(2));
        let quarters = sheet.quarters().map(|part| (part.straightness(), part.amplitude().powi(2)));
        let straightness = Estimate::of_quarters(sheet.straightness(), &quarters);
        let followed = same_way.unwrap_or(coherence);
        let measures = Measures { amplitude, kept, straightness, followed };
        if !is_wave && measures.regime() != Regime::Steady {
            return Err(Doubt::NoWave(2.0 * length));
        }
        let mut doubts: Vec<Doubt> = changing.into_iter().collect();
        if measures.regime() == Regime::Steady {
            doubts.extend(growing);
            return Ok(Self { measures, pattern: None, doubts });
        }
        let is_settled = changes[1].ln().abs() <= SETTLED;
        let angle = vector.crest_angle(&mut doubts);
        let wavelength = vector.wavelength(is_settled, &mut doubts);
        let (coherences, amplitude) = ((coherence, same_way), sheet.amplitude());
        let pattern =
            Pattern::of(wave, (wavelength, angle), coherences, amplitude, local.defects());
        Ok(Self { measures, pattern: Some(pattern), doubts })
    }

    fn written(self, mut doubts: Vec<Doubt>) -> Written {
        let regime = self.measures.regime();
        doubts.extend(self.doubts);
        doubts.extend(self.measures.beside().map(|other| Doubt::Between(regime, other)));
        Written { regime, pattern: self.pattern, doubts }
    }
}

/// Root mean square of the part of the relief that differs between lines, relative to that of the relief.
fn unlike(sheet: &Sheet) -> f64 {
    let square = |u: &ndarray::Array2<f64>| u.iter().map(|u| u * u).sum::<f64>();
    (square(&sheet.unlike()) / square(&sheet.u)).sqrt()
}

impl Sheets<'_> {
    /// The groove of each line alone.
    fn own(&self) -> Sheet {
        let Sheet { from, spacing, pitch, band, .. } = self.surface;
        let own = Grooves::own_heights_of(self.plan, self.lines, &self.x);
        Sheet::new(own, (from, spacing), pitch, band)
    }

    /// Fraction of a wave that remains away from the starting edges, relative to its amplitude next to them; 1 if the
    /// surface is still rough there.
    fn kept(&self, path: Path, local: &Local) -> Estimate {
        let ends = |[first, middle, last]: [f64; 3]| {
            if path == Path::Zigzag { (first.max(last), middle) } else { (first, last) }
        };
        let (near, far) = ends(local.thirds());
        let rough = ends(self.surface.thirds()).1 / (PITTED * self.depth);
        if rough > 1.0 + AMPLITUDE_ERROR {
            return Estimate { value: 1.0, error: 0.0 };
        }
        let error = if rough > 1.0 - AMPLITUDE_ERROR { 1.0 } else { KEPT_ERROR };
        Estimate { value: far / near.max(f64::MIN_POSITIVE), error }
    }
}

/// Growth of differences between lines, and the number of lines after which ripples would be visible.
fn growing(plan: &Plan, sheets: &Sheets, lines: usize) -> Option<Doubt> {
    let unlike = sheets.surface.unlike();
    growth(plan, &unlike, (sheets.depth, sheets.healed), (unlike.nrows(), lines))
}

/// Growth of these heights over this number of rows, and the number of lines after which it would be visible.
fn growth(
    plan: &Plan,
    heights: &ndarray::Array2<f64>,
    (depth, healed): (f64, f64),
    (rows, lines): (usize, usize),
) -> Option<Doubt> {
    let [before, after] = halves_of(heights);
    let ratio = after / before * healed;
    let is_seen = after > SEEN * plan.law.tolerance * depth;
    (is_seen && ratio > GROWS).then(|| {
        let factor = ratio.powf(2.0 / rows as f64);
        let more = (FLAT * depth / after).ln() / factor.ln();
        let more = more.clamp(lines as f64, 1e9);
        Doubt::Growing { factor, lines: lines + more as usize }
    })
}
