//! Linear stability of a raster: many scan lines beside each other, each in the grooves of those before it.
//!
//! Line n, at y = n d, moves over the grooves of the earlier lines. It deviates by A_n e^{iωt} from even motion, ω = qr, and
//! its weight is w0(1 + B_n e^{iωt}). With f(x,y) = Σ_l g_l(x) h_l(y), a = αw0, s = 1/(rT), p = s + iq, what is left of a
//! groove after a line c = e^{-X/(rT)}, one-sided transforms φ, φ1, G of f, f', f'' and ĝ_l(p) = ∫ g_l e^{-px}dx over all x,
//! small deviations obey
//!
//! ```text
//!     P (A_n, B_n) = (a/r) u Σ_j Σ_l c^j h_l(jd) ĝ_l(p) v·(A_{n-j}, B_{n-j}),    u = (p, β),   v = (-p, 1)
//!
//!     P = | 1 + irq - Mr²q² - (a/r)(G(s) - G(p) + s²E)    -(a/r) φ1(p)     |
//!         | -(aβ/r)(φ1(s) - φ1(p) + sE)                    1 - (aβ/r) φ(p) |
//! ```
//!
//! with E = Σ_j Σ_l c^j h_l(jd) ĝ_l(s) of the even grooves beside, u0 = -(a/r)(φ(s) + E) the height under the tip, w0 =
//! e^{-|u0|/b}, and β = ±1/b as u0 is above 0 or below. Under the basic law (s = β = M = 0, c = 1) this is
//!
//! ```text
//!     D(q) A_n = (α/r) q² Σ_j Σ_l h_l(jd) ĝ_l(q) A_{n-j},      D(q) = 1 + irq + (α/r) G(iq)
//! ```
//!
//! A line leaves one number, v·(A, B), and so ripples change from line to line as by a recurrence: A_n ∝ zⁿ grows where
//! |z| > 1. The threshold is the smallest α with a root on |z| = 1, z = e^{iφ}: crests qx + κy = const., κ = φ/d, that stand
//! oblique to the scan lines. On the way back of a zigzag q changes its sign: what is a line's own becomes its complex
//! conjugate. α = a e^{|u0|/b} rises with a. `docs/stability.md` derives it.
//!
//! A tip that gives way across the lines, y' = -u_y + κ_y (Y_n - y), deviates there by C_n e^{iωt} too. Even motion is then
//! displaced by (a/(κ_y r)) Σ_j Σ_l c^j h_l'(jd) ĝ_l(s) on all lines alike, so that they stay jd apart. Under the basic law
//!
//! ```text
//!     D(q) A_n = (α/r) Σ_j Σ_l ĝ_l(q) [q² h_l(jd) A_{n-j} - iq h_l'(jd) C_{n-j}]
//!     [irq + κ_y + (α/r)(S(iq) - S(0) - E'')] C_n = -(α/r) Σ_j Σ_l ĝ_l(q) [iq h_l'(jd) A_{n-j} + h_l''(jd) C_{n-j}]
//! ```
//!
//! S the transform of `f_yy(x,0)` over x > 0, E'' = Σ_j Σ_l h_l''(jd) ĝ_l(0); `plane.rs` has all of the wider law. On a soft
//! spring lines fall into the grooves of those before them, and bunch: with X(z) = Σ_j Σ_l h_l''(jd) ĝ_l(0) (1 - z^{-j}) and
//! small q, (κ_y + irq) r/α = X, so that for κ_y → 0
//!
//! ```text
//!     α = κ_y r/max_z Re X,      q = (κ_y/r) Im X/Re X
//! ```
//!
//! Lines that bunch in pairs, z = -1, have q = 0 and this α at any κ_y.

mod bands;
mod count;
mod critical;
mod determinant;
mod entry;
mod extent;
mod growth;
mod heights;
mod lines;
mod on_cell;
mod optimum;
mod patch;
mod plane;
mod polynomial;
mod reach;
mod search;
mod waves;

use super::StabilityError;
pub use critical::{RasterCertificate, RasterCritical, RasterKind, RasterPath};
use determinant::{Heights, Lines, Terms};
use heights::heights;
use optimum::Place;
use plane::Sideways;
use search::{Found, MARGIN, largest};
use std::f64::consts::PI;
use stickslip_tip::roots::zero_between;
use stickslip_tip::{Footprint, TipFunction, Wider};
use waves::Waves;

/// Lines that pass over each other's grooves.
#[derive(Debug, Clone)]
pub struct Raster {
    footprint: Footprint,
    waves: Waves,
    r: f64,
    pitch: f64,
    law: Wider,
    /// c
    left: f64,
    heights: Heights,
    /// u0 = -a times this.
    depth: f64,
    terms: Terms,
}

/// Crests at less than so many degrees to the scan lines are nearer to them than to the diagonal.
const FLATTEST: f64 = 22.5;
/// Thresholds of a kind are looked for at T above this part of the largest.
const LEAST_OF_KIND: f64 = 0.01;
/// Grooves that change a line by less than this leave it alone.
const ALONE: f64 = 1e-13;
/// A T = r/a below this part of what a tip could have is none: nothing grows.
const LEAST: f64 = 1e-6;
/// α = a e^{|u0|/b} is infinite where |u0|/b is larger.
const LARGEST_EXPONENT: f64 = 700.0;
/// A height under the tip below this part of those that cancel in it is 0.
const LEVEL: f64 = 1e-9;

impl Raster {
    /// Lines a pitch d apart, dragged at r, of whose grooves so much is left after a line as `left` says: e^{-X/(rT)},
    /// 1 where nothing heals.
    ///
    /// # Errors
    /// r or the pitch not a positive finite number, or a pitch so small that the lines within reach cannot be summed. Under a
    /// wider law than the basic one also a parameter out of range, no spring, J0 and cos x, and a height of 0 under the tip,
    /// where |h| has its corner.
    pub fn new(
        footprint: &Footprint,
        law: Wider,
        (r, pitch): (f64, f64),
        left: f64,
    ) -> Result<Self, StabilityError> {
        if !(r.is_finite() && r > 0.0) {
            return Err(StabilityError::R(r));
        }
        if !law.spring {
            return Err(StabilityError::NoSupport);
        }
        law.validate()?;
        if !law.is_papers() && !is_gaussian(footprint) {
            let what = "a raster of a tip that is no sum of Gaussians";
            return Err(StabilityError::PapersLawOnly(what));
        }
        let heights = vec![heights(footprint, (pitch, left), 0)?];
        let fading = law.healing_time.map_or(0.0, |time| 1.0 / (r * time));
        let waves = Waves::new(footprint, fading);
        let beside = beside(&waves, &heights[0]);
        let [own, ..] = waves.steady;
        let depth = (own + beside) / r;
        if law.depth_limit.is_some()
            && (own + beside).abs() <= LEVEL * footprint.path().value(0.0).abs()
        {
            return Err(StabilityError::Corner);
        }
        let steepness = law.depth_limit.map_or(0.0, |limit| -depth.signum() / limit);
        let mass = law.inertia.unwrap_or(0.0);
        let terms = Terms { r, mass, steepness, beside, across: None };
        let footprint = footprint.clone();
        Ok(Self { footprint, waves, r, pitch, law, left, heights, depth, terms })
    }

    /// The same with a tip that gives way across the lines, on a spring κ_y in units of that along them. The inertia is that
    /// along the lines.
    ///
    /// # Errors
    /// κ_y not a positive finite number; J0 and cos x.
    pub fn with_stiffness_across(mut self, stiffness: f64) -> Result<Self, StabilityError> {
        judge_stiffness(stiffness, self.r)?;
        if !is_gaussian(&self.footprint) {
            return Err(StabilityError::NoRipples);
        }
        self.heights.truncate(1);
        for order in [1, 2] {
            self.heights.push(heights(&self.footprint, (self.pitch, self.left), order)?);
        }
        self.waves = self.waves.giving_way(&self.footprint);
        let beside = [1, 2].map(|order: usize| beside(&self.waves, &self.heights[order]));
        self.terms.across = Some(Sideways { stiffness, beside });
        Ok(self)
    }

    /// The first ripple that does not fade from line to line: the smallest α at which, for some q, a wave that fades at all
    /// smaller α has |z| = 1.
    ///
    /// Phases are those of all z on the circle, on a zigzag too. The search ends on no sample: all wave numbers and phases are
    /// bounded, and the threshold itself is a root to round-off. See [`RasterCertificate`].
    ///
    /// # Errors
    /// [`StabilityError::NoCrossing`] where no ripple grows, however large α; [`StabilityError::HealingZigzag`];
    /// [`StabilityError::NoRipples`] for J0 and cos x; [`StabilityError::Uncertified`], [`StabilityError::Stopped`].
    pub fn critical(&self, path: RasterPath) -> Result<RasterCritical, StabilityError> {
        let lines = self.lines(path)?;
        let none = StabilityError::NoCrossing { r: self.r };
        let floor = self.least_t(&lines);
        let single_line = lines.alone();
        let alone = largest(&single_line, floor)?;
        let single = alone.place.map_or(floor, |place| place.t);
        let found = if self.is_alone() {
            Found { place: None, cells: 0 }
        } else {
            largest(&lines, single)?
        };
        let cells = alone.cells + found.cells;
        let place = found.place.or(alone.place).ok_or(none)?;
        if !self.alpha(self.r / place.t).is_finite() {
            return Err(none);
        }
        let lines = if found.place.is_some() { lines } else { single_line };
        let mut critical = self.described(&lines, place, path);
        (critical.certificate.tolerance, critical.certificate.cells) = (MARGIN, cells);
        Ok(critical)
    }

    /// The lowest threshold of each kind, by rising α: the first is [`Raster::critical`], the only one that is certain.
    ///
    /// Where the tip gives way across the lines, waves of several kinds have bands of their own, in each of which T = r/α is
    /// largest among its neighbours. A kind without such a band is left out. That of a threshold is the smallest α of its kind
    /// is not certain but for the first: their `tolerance` is 1, their `cells` 0; the waves of its q are counted for each.
    ///
    /// # Errors
    /// As [`Raster::critical`].
    pub fn thresholds(&self, path: RasterPath) -> Result<Vec<RasterCritical>, StabilityError> {
        let mut thresholds = vec![self.critical(path)?];
        let lines = self.lines(path)?;
        if !lines.is_plane() || self.is_alone() {
            return Ok(thresholds);
        }
        let least = LEAST_OF_KIND * self.r / self.density(thresholds[0].alpha);
        for place in bands::bands(&lines, least, self.footprint.path().band())? {
            let other = self.described(&lines, place, path);
            if thresholds.iter().all(|known| known.kind != other.kind) {
                thresholds.push(other);
            }
        }
        Ok(thresholds)
    }

    /// What there is to say of the wave at a place, but for its being the first.
    fn described(&self, lines: &Lines, place: Place, path: RasterPath) -> RasterCritical {
        let counted = (!lines.is_alone()).then(|| count::beside(lines, place));
        let certificate = RasterCertificate {
            tolerance: 1.0,
            cells: 0,
            margin: counted.map_or(0.0, |counted| counted.margin),
            growing_below: counted.and_then(|counted| counted.below),
            growing_above: counted.and_then(|counted| counted.above),
        };
        let phase = if lines.is_alone() { 0.0 } else { Self::phase(lines, place) };
        let across = phase.abs() / self.pitch;
        let angle = place.q.atan2(across).to_degrees();
        let kappa = (path == RasterPath::OneWay).then_some(phase / self.pitch);
        RasterCritical {
            kind: Self::kind(lines, place, angle),
            alpha: self.alpha(self.r / place.t),
            r: self.r,
            q: place.q,
            phase_per_line: phase,
            kappa,
            crest_angle: kappa.map(|kappa| place.q.atan2(kappa.abs()).to_degrees()),
            wavelength_x: 2.0 * PI / place.q,
            certificate,
        }
    }

    /// φ of z = e^{iφ} = 1/w; on a zigzag that between both ways.
    fn phase(lines: &Lines, place: Place) -> f64 {
        if !lines.is_zigzag() {
            return wrapped(-place.theta);
        }
        let (wave, phase) = (lines.wave(place.q, 1.0), lines.phase(place.theta, 1.0));
        lines.back_by_forth(&wave, &phase, place.t).arg()
    }

    fn kind(lines: &Lines, place: Place, angle: f64) -> RasterKind {
        if !lines.is_plane() {
            return RasterKind::Ripples;
        }
        let (wave, phase) = (lines.wave(place.q, 1.0), lines.phase(place.theta, 1.0));
        let is_across = lines.share_along(&wave, &phase, place.t) < 0.5;
        if is_across && lines.own_across(place.q) > 0.5 * place.t {
            return RasterKind::Snaking;
        }
        if angle < FLATTEST { RasterKind::Bunching } else { RasterKind::Ripples }
    }

    fn lines(&self, path: RasterPath) -> Result<Lines, StabilityError> {
        if !is_gaussian(&self.footprint) {
            return Err(StabilityError::NoRipples);
        }
        match path {
            RasterPath::OneWay => Ok(Lines::one_way(self.waves.clone(), self.terms, &self.heights)),
            RasterPath::Zigzag if self.law.healing_time.is_some() => {
                Err(StabilityError::HealingZigzag)
            }
            RasterPath::Zigzag => Ok(Lines::zigzag(self.waves.clone(), self.terms, &self.heights)),
        }
    }

    /// T below which nothing is looked for: α would be infinite, or far beyond all scales of the tip.
    fn least_t(&self, lines: &Lines) -> f64 {
        let finite = self
            .law
            .depth_limit
            .map_or(0.0, |limit| self.r * self.depth.abs() / (LARGEST_EXPONENT * limit));
        finite.max(LEAST * lines.scale())
    }

    fn is_alone(&self) -> bool {
        self.heights.iter().flatten().flatten().all(|h| h.abs() < ALONE)
    }

    /// α of a.
    fn alpha(&self, a: f64) -> f64 {
        self.law.depth_limit.map_or(a, |limit| a * (a * self.depth.abs() / limit).exp())
    }

    /// a of α.
    fn density(&self, alpha: f64) -> f64 {
        if self.law.depth_limit.is_none() {
            return alpha;
        }
        zero_between(|a| self.alpha(a) - alpha, 0.0, alpha)
    }
}

/// Σ_j Σ_l c^j h_l(jd) ĝ_l(s)
fn beside(waves: &Waves, heights: &[Vec<f64>]) -> f64 {
    let each = waves.steady_layers();
    each.iter().zip(heights).map(|(g, heights)| g * heights.iter().sum::<f64>()).sum()
}

/// A spring across that is told from none: S(s) - S(p) has a round-off of 1e-16.
const LEAST_STIFFNESS: f64 = 1e-9;

/// Refuses a κ_y that is none, or so small a part of r that nothing is left of it.
pub(super) fn judge_stiffness(stiffness: f64, r: f64) -> Result<(), StabilityError> {
    if stiffness.is_finite() && stiffness >= LEAST_STIFFNESS * r {
        return Ok(());
    }
    Err(StabilityError::StiffnessAcross(stiffness))
}

/// The largest T and its q at which a single line that gives way across keeps a deviation across, and how many cells were
/// gone through; `None` where it fades at any T above [`LEAST`] of what it could be.
pub(super) fn single_across(
    footprint: &Footprint,
    fading: f64,
    (r, stiffness): (f64, f64),
) -> Result<(Option<(f64, f64)>, usize), StabilityError> {
    let waves = Waves::new(footprint, fading).giving_way(footprint);
    let across = Some(Sideways { stiffness, beside: [0.0; 2] });
    let terms = Terms { r, mass: 0.0, steepness: 0.0, beside: 0.0, across };
    let lines = Lines::single_across(waves, terms);
    let found = largest(&lines, LEAST * lines.scale())?;
    Ok((found.place.map(|place| (place.t, place.q)), found.cells))
}

fn is_gaussian(footprint: &Footprint) -> bool {
    let of_gaussians = |tip: &TipFunction| matches!(tip, TipFunction::Gaussians(_));
    footprint.layers().iter().all(|layer| of_gaussians(&layer.along))
}

/// Between -π and π.
fn wrapped(phase: f64) -> f64 {
    phase - 2.0 * PI * (phase / (2.0 * PI)).round()
}
