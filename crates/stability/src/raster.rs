//! Linear stability of a raster: parallel scan lines, each affected by the grooves of earlier lines.
//!
//! Line n, at y = n d, moves over the grooves of the earlier lines. It deviates by A_n e^{iωt} from steady motion, ω =
//! qr, and its weight is w0(1 + B_n e^{iωt}). Let f(x,y) = Σ_l g_l(x) h_l(y), a = αw0, s = 1/(rT) and p = s + iq. With
//! lines of length X a groove decays by the factor c = e^{-X/(rT)} per line; φ, φ1, G are the one-sided transforms of
//! f, f', f'', and ĝ_l(p) = ∫ g_l e^{-px}dx over all x. Small deviations obey
//!
//! ```text
//!     P (A_n, B_n) = (a/r) u Σ_j Σ_l c^j h_l(jd) ĝ_l(p) v·(A_{n-j}, B_{n-j}),    u = (p, β),   v = (-p, 1)
//!
//!     P = | 1 + irq - Mr²q² - (a/r)(G(s) - G(p) + s²E)    -(a/r) φ1(p)     |
//!         | -(aβ/r)(φ1(s) - φ1(p) + sE)                    1 - (aβ/r) φ(p) |
//! ```
//!
//! with E = Σ_j Σ_l c^j h_l(jd) ĝ_l(s) of the steady grooves of the earlier lines, the height u0 = -(a/r)(φ(s) + E)
//! under the tip, w0 = e^{-|u0|/b}, and β = 1/b if u0 is above 0, -1/b if below. In the basic model (s = β = M = 0, c
//! = 1) this is
//!
//! ```text
//!     D(q) A_n = (α/r) q² Σ_j Σ_l h_l(jd) ĝ_l(q) A_{n-j},      D(q) = 1 + irq + (α/r) G(iq)
//! ```
//!
//! Each line affects the later ones by one number, v·(A, B), so that ripples change from line to line by a recurrence:
//! A_n ∝ zⁿ grows if |z| > 1. The threshold is the smallest α with a root on |z| = 1, z = e^{iφ}. The crests of its wave,
//! qx + κy = const., κ = φ/d, are oblique to the scan lines. On the retrace of a zigzag q changes its sign: the
//! coefficients of a line alone become the complex conjugates of those for the mirrored footprint. α = a e^{|u0|/b}
//! increases with a. `docs/explanation/rasters.md` derives these equations.
//!
//! If the tip is flexible across the lines, y' = -u_y + κ_y (Y_n - y), it also deviates by C_n e^{iωt} in y. Steady
//! motion is then displaced by (a/(κ_y r)) Σ_j Σ_l c^j h_l'(jd) ĝ_l(s) on all lines alike, so that they stay jd apart.
//! In the basic model
//!
//! ```text
//!     D(q) A_n = (α/r) Σ_j Σ_l ĝ_l(q) [q² h_l(jd) A_{n-j} - iq h_l'(jd) C_{n-j}]
//!     [irq + κ_y + (α/r)(S(iq) - S(0) - E'')] C_n = -(α/r) Σ_j Σ_l ĝ_l(q) [iq h_l'(jd) A_{n-j} + h_l''(jd) C_{n-j}]
//! ```
//!
//! where S is the transform of `f_yy(x,0)` over x > 0 and E'' = Σ_j Σ_l h_l''(jd) ĝ_l(0); `plane.rs` contains the
//! extended model. On a soft spring the tip is pulled into the grooves of earlier lines, so that lines bunch. With
//! X(z) = Σ_j Σ_l h_l''(jd) ĝ_l(0) (1 - z^{-j}) and small q, (κ_y + irq) r/α = X, so that for κ_y → 0
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
mod growth;
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
use super::law::Law;
pub use critical::{RasterCertificate, RasterCritical, RasterKind, RasterPath};
use determinant::{Heights, Lines, Terms};
use lines::heights;
use optimum::Place;
use plane::Sideways;
use search::{Found, MARGIN, largest};
use std::f64::consts::PI;
use stickslip_tip::roots::zero_between;
use stickslip_tip::{Footprint, TipFunction, Wider};
use waves::Waves;

/// A raster of parallel scan lines with overlapping grooves.
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
    /// The depth -u0/a.
    depth: f64,
    terms: Terms,
}

/// Crests at less than this angle to the scan lines, in degrees, are closer to the lines than to the diagonal.
const FLATTEST: f64 = 22.5;
/// Smallest T in the search for thresholds of a kind, as a fraction of the largest T.
const LEAST_OF_KIND: f64 = 0.01;
/// A wave number below this, in 1/σ, is 0: no line is as long as its wave.
const STRAIGHT: f64 = 1e-12;
/// Grooves that change a line by less than this are negligible.
const ALONE: f64 = 1e-13;
/// A T = r/a below this fraction of the largest possible one counts as 0: nothing grows.
const LEAST: f64 = 1e-6;
/// α = a e^{|u0|/b} is infinite if |u0|/b is larger.
const LARGEST_EXPONENT: f64 = 700.0;
/// A height under the tip below this fraction of its terms, which cancel, counts as 0.
const LEVEL: f64 = 1e-9;

impl Raster {
    /// Lines with the pitch d at the velocity r. After each line the grooves decay by the factor `left`: e^{-X/(rT)}
    /// for lines of length X and the healing time T, or 1 without healing.
    ///
    /// # Errors
    /// r or the pitch is not a positive finite number, or the pitch is so small that the lines within reach cannot be
    /// summed. There is no spring, or a parameter of the extended model is out of range. In this model also: the
    /// footprint is J0 or cos x, or the height under the tip is 0, on the kink of |h|.
    pub fn new(
        footprint: &Footprint,
        law: Wider,
        (r, pitch): (f64, f64),
        left: f64,
    ) -> Result<Self, StabilityError> {
        Law::judge(&law, r)?;
        if !law.is_basic() && !is_gaussian(footprint) {
            let what = "a raster of a tip that is no sum of Gaussians";
            return Err(StabilityError::PapersLawOnly(what));
        }
        let heights = vec![heights(footprint, (pitch, left), 0)?];
        let waves = Waves::new(footprint, law.fading(r));
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

    /// The same lines with a tip that is flexible across them, on a spring κ_y in units of the spring along them.
    /// Inertia acts along the lines only.
    ///
    /// # Errors
    /// κ_y is not a positive finite number, or the footprint is J0, cos x or not even.
    pub fn with_stiffness_across(mut self, stiffness: f64) -> Result<Self, StabilityError> {
        judge_stiffness(stiffness, self.r)?;
        if !is_gaussian(&self.footprint) {
            return Err(StabilityError::NoRipples);
        }
        if !self.footprint.is_even() {
            return Err(StabilityError::EvenOnly("the motion across the lines"));
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

    /// The threshold: the smallest α at which, for some q, a wave neither grows nor decays from line to line.
    ///
    /// The search covers all wave numbers, and all phases from one line to the next. It does not rely on samples: bounds
    /// hold between them, and the threshold itself is a root to round-off. See [`RasterCertificate`].
    ///
    /// # Errors
    /// [`StabilityError::NoCrossing`] if no wave grows at any α; [`StabilityError::HealingZigzag`];
    /// [`StabilityError::EvenOnly`] for a zigzag under a depth limit if the footprint is not even;
    /// [`StabilityError::NoRipples`] for J0 and cos x; [`StabilityError::Uncertified`], [`StabilityError::Stopped`].
    pub fn critical(&self, path: RasterPath) -> Result<RasterCritical, StabilityError> {
        let lines = self.lines(path)?;
        let none = StabilityError::NoCrossing { r: self.r };
        let floor = self.least_t(&lines);
        let (mut single, mut single_line, mut alone) =
            (floor, lines.alone(), Found { place: None, cells: 0 });
        for line in lines.each_alone() {
            let found = largest(&line, single)?;
            alone.cells += found.cells;
            if let Some(place) = found.place {
                (single, single_line, alone.place) = (place.t, line, Some(place));
            }
        }
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

    /// The lowest threshold of each kind of wave, by increasing α. The first is [`Raster::critical`].
    ///
    /// If the tip is flexible across the lines, each of several kinds of waves has its own band of q, with a local
    /// minimum of α. A kind without such a band is left out. Only the first threshold is certified to be the smallest α
    /// of its kind. For the others `tolerance` is 1 and `cells` is 0, but growing waves are counted at the q of each.
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

    /// The threshold at a given wave, without the certificate that it is the first.
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
        // The search approaches straight lines, an end of its interval, but need not reach them.
        let q = if place.q < STRAIGHT { 0.0 } else { place.q };
        let across = phase.abs() / self.pitch;
        let angle = q.atan2(across).to_degrees();
        let kappa = (path == RasterPath::OneWay).then_some(phase / self.pitch);
        RasterCritical {
            kind: Self::kind(lines, place, angle),
            alpha: self.alpha(self.r / place.t),
            r: self.r,
            q,
            phase_per_line: phase,
            kappa,
            crest_angle: kappa.map(|kappa| q.atan2(kappa.abs()).to_degrees()),
            wavelength_x: 2.0 * PI / q,
            certificate,
        }
    }

    /// φ of z = e^{iφ} = 1/w; on a zigzag the phase between trace and retrace.
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
        let is_even = self.footprint.is_even();
        match path {
            RasterPath::OneWay => Ok(Lines::one_way(self.waves.clone(), self.terms, &self.heights)),
            RasterPath::Zigzag if self.law.healing_time.is_some() => {
                Err(StabilityError::HealingZigzag)
            }
            RasterPath::Zigzag if !is_even && self.law.depth_limit.is_some() => {
                Err(StabilityError::EvenOnly("the threshold of a zigzag under a depth limit"))
            }
            RasterPath::Zigzag => {
                let back = (!is_even).then(|| Waves::new(&self.footprint.mirrored(), 0.0));
                Ok(Lines::zigzag((self.waves.clone(), back), self.terms, &self.heights))
            }
        }
    }

    /// Lower end of the search for T: below it α would be infinite, or far beyond all scales of the tip.
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

    /// α for a given a = αw0.
    fn alpha(&self, a: f64) -> f64 {
        self.law.depth_limit.map_or(a, |limit| a * (a * self.depth.abs() / limit).exp())
    }

    /// a = αw0 for a given α.
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
    // Where c is 0 the surface may heal so fast that ĝ(s) is infinite.
    let felt = each.iter().zip(heights).filter(|(_, heights)| !heights.is_empty());
    felt.map(|(g, heights)| g * heights.iter().sum::<f64>()).sum()
}

/// Smallest distinguishable ratio of a spring across to r: S(s) - S(p) has a round-off of 1e-16.
const LEAST_STIFFNESS: f64 = 1e-9;

/// An error for a κ_y that is not positive and finite, or so small compared with r that round-off hides it.
pub(super) fn judge_stiffness(stiffness: f64, r: f64) -> Result<(), StabilityError> {
    if stiffness.is_finite() && stiffness >= LEAST_STIFFNESS * r {
        return Ok(());
    }
    Err(StabilityError::StiffnessAcross(stiffness))
}

/// The largest T, and its q, at which a single flexible line has an undamped deviation across, and the number of cells
/// examined; `None` if it decays at any T above [`LEAST`] of its largest possible value.
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

/// The phase, shifted by turns to between -π and π.
fn wrapped(phase: f64) -> f64 {
    phase - 2.0 * PI * (phase / (2.0 * PI)).round()
}
