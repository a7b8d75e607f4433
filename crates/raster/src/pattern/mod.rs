//! What the lines have written: ripples and their wave vector, pits, or no order.

mod local;
mod wave;

use crate::line::Line;
use crate::path::Path;
use crate::plan::{Plan, WIDTHS};
use crate::surface::Scanned;
use local::Local;
use wave::{Sheet, Wave};

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
    /// Half peak-to-peak.
    pub amplitude: f64,
    /// Places where a crest begins or ends: around them the phase of ψ turns once.
    pub defects: usize,
}

/// The kinds of surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// No ripples: the surface is as deep everywhere.
    Steady,
    /// Crests, the same from line to line.
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

/// The part of the length that is looked at: neither the pit at the beginning nor the end.
const ALONG: (f64, f64) = (0.2, 0.85);
/// Of the lines the last part, but no more than so many.
const LAST: f64 = 0.5;
const MOST_ROWS: usize = 256;
/// The last lines have not yet been gone over by those that would follow within so many widths.
const UNFINISHED: f64 = 3.5;
/// Fewer rows, or a shorter stretch in wavelengths of the footprint, show no wave vector.
const FEWEST_ROWS: usize = 8;
const SHORTEST: f64 = 12.0;
/// Points in a width of the footprint.
const POINTS: f64 = 4.0;
/// Ripples below this part of the depth are none.
const FLAT: f64 = 0.01;
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
    let stuck = lines.iter().filter(|line| is_stuck(plan, line)).count();
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
    let coherence = Local::of(&sheets.own, &wave).coherence();
    let is_pitted = sheet.straightness() < STRAIGHT && amplitude > PITTED * sheets.depth.abs();
    let regime = match is_pitted {
        true if coherence >= LATTICE => Regime::Pits,
        false if coherence >= ORDERED => Regime::Ripples,
        _ => Regime::Disordered,
    };
    let Wave { q, kappa, .. } = wave;
    let pattern = Pattern {
        q,
        kappa,
        wavelength: std::f64::consts::TAU / q.hypot(kappa),
        crest_angle: q.atan2(kappa.abs()).to_degrees(),
        coherence,
        amplitude,
        defects: local.defects(),
    };
    (regime, Some(pattern))
}

/// What one line did.
#[must_use]
pub fn line_regime(plan: &Plan, line: &Line) -> LineRegime {
    if is_stuck(plan, line) {
        return LineRegime::StuckAtTheEdge;
    }
    let duration = plan.duration();
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
fn is_stuck(plan: &Plan, line: &Line) -> bool {
    let track = line.track();
    track.along(line.x0(line.trajectory().end())) < 0.5 * plan.length
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
    let width = 8.7 / plan.band();
    let across = plan.reach_across() / WIDTHS;
    let (from, to) = (ALONG.0 * plan.length, ALONG.1 * plan.length);
    let unfinished = (UNFINISHED * across / plan.pitch).ceil();
    let enough = plan.path != Path::Repeat && to - from > SHORTEST * width;
    let last = lines.len().checked_sub(unfinished as usize).filter(|_| enough)?;
    let rows = ((LAST * last as f64) as usize).min(MOST_ROWS);
    if rows < FEWEST_ROWS || plan.pitch * (rows as f64) < SHORTEST * across {
        return None;
    }
    let points = (POINTS * (to - from) / width) as usize;
    let spacing = (to - from) / points as f64;
    let x: Vec<f64> = (0..points).map(|i| from + spacing * i as f64).collect();
    let first = last - rows;
    let y: Vec<f64> = lines[first..last].iter().map(|line| line.track().y).collect();
    // Lines out of reach of these rows need not be read.
    let within = (plan.reach_across() / plan.pitch).ceil() as usize;
    let end = lines.len().min(last + within);
    let heights = Scanned::new(plan, &lines[first.saturating_sub(within)..end]).heights(&x, &y);
    let own = Scanned::new(plan, &lines[first..last]).own_grooves(&x);
    let depth = heights.mean()?;
    let sheet = |u| Sheet::new(u, (from, spacing), plan.pitch, plan.band());
    Some(Sheets { surface: sheet(heights), own: sheet(own), depth })
}
