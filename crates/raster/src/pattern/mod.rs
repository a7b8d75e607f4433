//! What the lines have written: ripples and their wave vector, pits, or no order.

#[cfg(test)]
mod judged;
mod local;
mod wave;
mod window;

use crate::line::Line;
use crate::path::Path;
use crate::plan::Plan;
use crate::surface::Scanned;
use local::Local;
use wave::{Sheet, Wave};
use window::{ALONG, Window};

/// A ripple e^{i(qx + κy)} of the surface. Lengths in σ, heights in kσ²/a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    /// Wave number along the lines, above 0.
    pub q: f64,
    /// Wave number across them, between -π/d and π/d.
    pub kappa: f64,
    /// 2π/√(q² + κ²)
    pub wavelength: f64,
    /// Between crests and scan axis, in degrees: atan(q/|κ|).
    pub crest_angle: f64,
    /// How far each line is the one before, shifted: 1 where all shifts are the same. |Σ ψ_n* ψ_{n+1}| over
    /// √(Σ|ψ_n|² Σ|ψ_{n+1}|²), ψ the local complex amplitude of what each line alone has carved.
    pub coherence: f64,
    /// The same of a line and the one two after it, on a zigzag: lines that go the same way.
    pub coherence_same_way: Option<f64>,
    /// Half peak-to-peak.
    pub amplitude: f64,
    /// Places where a crest begins or ends: around them the phase of ψ turns once.
    pub defects: usize,
}

/// The kinds of surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// No ripples: the surface is as deep everywhere, but for what fades from the edge at which lines begin.
    Steady,
    /// Crests, the same from line to line; on a zigzag from each to the next that goes the same way.
    Ripples,
    /// Crests broken into pits, lines still following each other.
    Pits,
    /// Neither.
    Disordered,
    /// Most lines did not leave the pit at their beginning.
    StuckAtTheEdge,
    /// Too few or too short lines to tell.
    Unknown,
}

/// What one line did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineRegime {
    /// The lag hardly changes in the middle of the line.
    Steady,
    /// It does.
    StickSlip,
    /// The tip stayed in the pit at the beginning.
    StuckAtTheEdge,
}

/// Points in a width of the footprint.
const POINTS: f64 = 4.0;
/// Ripples below this part of the depth are none.
const FLAT: f64 = 0.01;
/// Columns of which less than this is left along the lines fade.
const FADED: f64 = 0.5;
/// Coherence of ripples, and of a lattice of pits.
const ORDERED: f64 = 0.95;
const LATTICE: f64 = 0.4;
/// Crests are broken into pits where slopes point one way less than this, and the surface is that rough, in its depth.
/// (One-way lines of a round Gaussian half a width apart: 0.99 at 1.1 αc, 0.95 at 1.2, 0.91 at 1.3, 0.81 at 1.5.)
const STRAIGHT: f64 = 0.93;
const PITTED: f64 = 0.3;
/// A lag that changes by less than this part of itself is steady.
const SAME_LAG: f64 = 0.02;

/// What is to be seen after these lines, and the pattern if there is one.
#[must_use]
pub fn pattern(plan: &Plan, lines: &[Line]) -> (Regime, Option<Pattern>) {
    let stuck = lines.iter().filter(|line| is_stuck(line)).count();
    if 2 * stuck > lines.len() {
        return (Regime::StuckAtTheEdge, None);
    }
    let Some(sheets) = sheets(plan, lines) else { return (Regime::Unknown, None) };
    let sheet = &sheets.surface;
    let amplitude = sheet.amplitude();
    if amplitude < FLAT * sheets.depth.abs() {
        return (Regime::Steady, None);
    }
    let Some(wave) = Wave::of_ripples(sheet) else { return (Regime::Unknown, None) };
    let local = Local::of(sheet, &wave);
    // What begins at the edge from which all lines start, and fades from there, is its mark and no ripple.
    if wave.is_upright(sheet) && sheet.kept_along() < FADED {
        return (Regime::Steady, None);
    }
    let own = Local::of(&sheets.own, &wave);
    let coherence = own.coherence(1);
    let same_way = (plan.path == Path::Zigzag).then(|| own.coherence(2));
    let followed = same_way.unwrap_or(coherence);
    let is_pitted = sheet.straightness() < STRAIGHT && amplitude > PITTED * sheets.depth.abs();
    let regime = match is_pitted {
        true if followed >= LATTICE => Regime::Pits,
        false if followed >= ORDERED => Regime::Ripples,
        _ => Regime::Disordered,
    };
    let Wave { q, kappa, .. } = wave;
    let pattern = Pattern {
        q,
        kappa,
        wavelength: std::f64::consts::TAU / q.hypot(kappa),
        crest_angle: q.atan2(kappa.abs()).to_degrees(),
        coherence,
        coherence_same_way: same_way,
        amplitude,
        defects: local.defects(),
    };
    (regime, Some(pattern))
}

/// What one line did.
#[must_use]
pub fn line_regime(plan: &Plan, line: &Line) -> LineRegime {
    if is_stuck(line) {
        return LineRegime::StuckAtTheEdge;
    }
    let duration = plan.duration_of(line.track().length);
    let at = |i: u32| {
        let part = ALONG.0 + (ALONG.1 - ALONG.0) * f64::from(i) / 400.0;
        line.lag(part * duration).abs()
    };
    let (low, high) = (0..=400)
        .map(at)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), lag| (low.min(lag), high.max(lag)));
    if high - low < SAME_LAG * high { LineRegime::Steady } else { LineRegime::StickSlip }
}

/// Whether the tip ended its line nearer to its beginning than to its end.
fn is_stuck(line: &Line) -> bool {
    let track = line.track();
    track.along(line.x0(line.trajectory().end())) < 0.5 * track.length
}

/// The part of lines and surface that is looked at.
struct Sheets {
    /// The surface on each line.
    surface: Sheet,
    /// What each line alone has carved.
    own: Sheet,
    /// Mean height of the surface.
    depth: f64,
}

fn sheets(plan: &Plan, lines: &[Line]) -> Option<Sheets> {
    let Window { first, end, from, to, pitch } = Window::of(plan, lines.len())?;
    let width = 8.7 / plan.band();
    let points = (POINTS * (to - from) / width) as usize;
    let spacing = (to - from) / points as f64;
    let x: Vec<f64> = (0..points).map(|i| from + spacing * i as f64).collect();
    let y: Vec<f64> = lines[first..end].iter().map(|line| line.track().y).collect();
    // Lines out of reach of these rows need not be read; between them none may be left out, as surfaces heal.
    let (low, high) = (y[0] - plan.reach_across(), y[y.len() - 1] + plan.reach_across());
    let is_felt = |line: &Line| (low..=high).contains(&line.track().y);
    let felt = (lines.iter().position(is_felt)?, lines.iter().rposition(is_felt)?);
    let heights = Scanned::new(plan, &lines[felt.0..=felt.1]).heights(&x, &y);
    let own = Scanned::new(plan, &lines[first..end]).own_grooves(&x);
    let depth = heights.mean()?;
    let sheet = |u| Sheet::new(u, (from, spacing), pitch, plan.band());
    Some(Sheets { surface: sheet(heights), own: sheet(own), depth })
}
