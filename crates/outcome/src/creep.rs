//! A stuck tip: whether it slips again, and when.
//!
//! Let the tip be at X at the time t, hardly moving. Ahead of it its groove exerts the force -u_x(X + ξ, t), and the
//! spring the force rt - X - ξ; their sum is H(ξ). Let θ(x) be the time at which the advancing tip reaches x. The
//! groove that it digs meanwhile adds α ∫ f'(ξ - η) θ'(X + η)dη to the force, and the spring adds r(θ - t). The
//! velocity is negligible, so the total force is 0. Its Laplace transform is
//!
//! ```text
//!     (r - α Q(p)) Φ(p) = -p Ĥ(p),   Φ = ∫ e^{-pξ} θ'(X + ξ)dξ,   Ĥ = ∫ e^{-pξ} H(ξ)dξ,
//! ```
//!
//! with Q(p) = p ∫_0^∞ e^{-px}(-f'(x))dx. So θ'(X + ξ) = Σ c e^{pξ} over the roots of r = α Q(p), c = p Ĥ(p)/(α Q'(p)): the
//! present surface determines the later motion. If this sum stays positive, the tip is held permanently; it slips where
//! the sum reaches 0.

use crate::ahead::Ahead;
use crate::thinned::Thinned;
use gauss_quad::legendre::GaussLegendre;
use num_complex::Complex64;
use std::num::NonZeroUsize;
use stickslip_stability::{Creep, creep};
use stickslip_tip::elementary::complex_exp;
use stickslip_tip::memory::POINTS;
use stickslip_tip::{InitialSurface, Model, Step, Trajectory, stop};

/// The logarithmic creep of a trapped tip, x0 ~ (1/p) ln t.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "CreepDocument"))]
pub struct Creeping {
    /// p at the end of the run, the rate at which 1/x0' grows with time, in 1/σ.
    pub rate: f64,
    /// The stable creep rate p that the motion approaches, in 1/σ: one of those that `stability` lists.
    pub attracting: f64,
}

/// Prediction for a stuck tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fate {
    /// The tip creeps permanently.
    Held(Creeping),
    /// The tip slips after this time.
    Slips(f64),
    /// It cannot be decided whether the tip slips.
    Open,
}

/// A velocity v is negligible where p v²/r, its share in the balance of forces, is below this.
const SLOW: f64 = 0.01;
/// Largest relative difference between the sum of the exponentials and the velocity at the end.
const ADDS_UP: f64 = 0.2;
/// Upper limit of tolerances, as a fraction of the length in which θ' changes by a factor of e.
const COARSE: f64 = 1e-3;
/// Fraction of a position error that is not a common shift of everything ahead of the tip.
const DISPLACED: f64 = 0.2;
/// Errors of the groove below this fraction of the velocity are negligible.
const UNSEEN: f64 = 0.003;
/// Safety factor for the error that the velocity and the tolerance cause in a coefficient.
const MARGIN: f64 = 10.0;

/// A tip and its surface at the end of a run.
pub(crate) struct Stuck<'a> {
    pub(crate) model: &'a Model,
    pub(crate) surface: &'a InitialSurface,
    pub(crate) tail: &'a Trajectory,
    pub(crate) tolerance: f64,
}

impl Stuck<'_> {
    /// The prediction for this tip; `None` if it is not stuck.
    pub(crate) fn fate(&self) -> Option<Fate> {
        let (model, end) = (self.model, self.tail.end());
        let velocity = self.tail.velocity(end);
        if velocity.abs() > 0.5 * model.r() {
            return None;
        }
        let creep = creep(model).ok()?;
        let fastest = creep.roots.first()?.re;
        if fastest * velocity * velocity > SLOW * model.r() {
            return None;
        }
        let exponentials = Exponentials::of(self, &creep);
        if stop::is_requested() {
            return None;
        }
        Some(exponentials.map_or(Fate::Open, |e| e.fate(self, velocity, &creep)))
    }
}

/// θ'(X + ξ) = Σ c e^{pξ}
struct Exponentials {
    terms: Vec<(Complex64, Complex64)>,
}

impl Exponentials {
    /// `None` for a footprint that never fades, and after a request to stop.
    fn of(stuck: &Stuck, creep: &Creep) -> Option<Self> {
        let Stuck { model, surface, tail, .. } = stuck;
        let reach = model.tip().reach()?;
        let last = tail.steps().last()?;
        let (end, r) = (tail.end(), tail.r());
        let extension = last.extension_at_end(r);
        let at = r * end - extension;
        let (positions, weights) = tail.residence(end);
        // Those within reach of a place ahead.
        let visits = positions.iter().map(|x| at - x).zip(weights);
        let visits = visits.filter(|(x, _)| x.abs() < reach).collect();
        let allowed = UNSEEN * tail.velocity(end).abs() / model.alpha();
        let groove = Ahead::new(model.tip(), visits, allowed);
        let largest = creep.roots.iter().map(|p| p.norm()).fold(0.0, f64::max);
        let nodes = nodes(reach, LONGEST_PANEL / model.tip().band(), 1.0 / largest);
        let mut pushes = Vec::with_capacity(nodes.len());
        for nodes in nodes.chunks(POINTS) {
            // On a table each of them takes long.
            if stop::is_requested() {
                return None;
            }
            let mut places = [0.0; POINTS];
            places.iter_mut().zip(nodes).for_each(|(place, (ahead, _))| *place = *ahead);
            for ((ahead, weight), slope) in nodes.iter().zip(groove.slopes(&places)) {
                let of_surface = surface.slope_and_curvature(at + ahead).0;
                pushes.push((*ahead, weight * (model.alpha() * slope - of_surface)));
            }
        }
        let coefficient = |(p, slope): (&Complex64, &Complex64)| {
            let groove: Complex64 =
                pushes.iter().map(|(x, push)| complex_exp(-p * *x) * *push).sum();
            let spring = (extension - p.inv()) / p;
            (*p, p * (groove + spring) / (slope * model.alpha()))
        };
        Some(Self { terms: creep.roots.iter().zip(&creep.slopes).map(coefficient).collect() })
    }

    /// θ' and θ'' at a distance ahead.
    fn at(&self, ahead: f64) -> (f64, f64) {
        self.terms.iter().fold((0.0, 0.0), |sum, (p, c)| {
            let term = c * complex_exp(p * ahead);
            (sum.0 + term.re, sum.1 + (p * term).re)
        })
    }

    fn fate(&self, stuck: &Stuck, velocity: f64, creep: &Creep) -> Fate {
        let (now, slope) = self.at(0.0);
        let (p, c) = self.terms[0];
        // The slope of a coarse step is no velocity of a tip that hardly moves: that of the exponentials is.
        let coarse = stuck.tolerance * p.norm() > COARSE && now * stuck.model.r() > MARGIN;
        if !coarse && (now * velocity - 1.0).abs() > ADDS_UP {
            return Fate::Open;
        }
        let velocity = if coarse { 1.0 / now } else { velocity };
        // What the velocity neglected, and an error of the position, make of the coefficient.
        let displaced = DISPLACED * stuck.tolerance;
        let pushed = velocity.abs() + stuck.model.r() * now * displaced;
        let unknown = MARGIN * pushed / (stuck.model.alpha() * creep.slopes[0].norm());
        if c.norm() <= unknown {
            return Fate::Open;
        }
        let next = self.terms.iter().map(|(p, _)| p.im.abs()).fold(p.re, f64::max);
        let step = 0.02 / next;
        let (mut ahead, mut time, mut before) = (0.0, 0.0, now);
        for _ in 0..LONGEST_LOOK {
            ahead += step;
            let (here, _) = self.at(ahead);
            if here <= 0.0 {
                return Fate::Slips(time);
            }
            time += 0.5 * step * (before + here);
            before = here;
            let others: f64 =
                self.terms[1..].iter().map(|(p, c)| (c * complex_exp(p * ahead)).norm()).sum();
            if let Some(attracting) = creep.attracting()
                && c.re > 0.0
                && (c * complex_exp(p * ahead)).norm() > 4.0 * others
            {
                return Fate::Held(Creeping { rate: slope / now, attracting });
            }
            if !time.is_finite() {
                break;
            }
        }
        Fate::Open
    }
}

/// Number of steps of the search ahead.
const LONGEST_LOOK: usize = 100_000;

/// Widest panel of the quadrature, in units of 1/band: a third more than a wavelength of f'.
const LONGEST_PANEL: f64 = 8.0;
const NODES_OF_PANEL: usize = 10;

/// Nodes and weights of Gauss-Legendre panels over the reach. The first is as narrow as the exponentials require, and
/// later ones are wider.
fn nodes(reach: f64, longest: f64, first: f64) -> Vec<(f64, f64)> {
    let rule = GaussLegendre::new(const { NonZeroUsize::new(NODES_OF_PANEL).unwrap() });
    let (mut nodes, mut from, mut width) = (vec![], 0.0, first.min(longest));
    while from < reach {
        let half = 0.5 * width;
        let panel = rule.as_node_weight_pairs().iter();
        nodes.extend(panel.map(|(x, weight)| (from + half * (1.0 + x), half * weight)));
        from += width;
        width = (2.0 * width).min(longest);
    }
    nodes
}

/// Fraction of the time since the last turning point over which the creep rate is measured.
const MEASURED_SHARE: f64 = 0.5;
/// Largest relative difference between the measured rate and the attracting one.
const WITHIN: f64 = 0.1;

/// The creep of a tip whose footprint never fades, so that the last steps are only a part of its history. `None` unless l
/// has only risen in the last half of the run, and 1/x0' = p (t - const) with nearly the attracting p.
pub(crate) fn measured(
    model: &Model,
    (start, since): (f64, f64),
    risen: &Thinned,
    last: &Step,
) -> Option<Creeping> {
    let (end, velocity) = (last.end(), last.velocity(last.end()));
    if since > 0.5 * (start + end) || velocity >= model.r() {
        return None;
    }
    let attracting = creep(model).ok()?.attracting()?;
    let earlier = end - MEASURED_SHARE * (end - since);
    let then = risen.at(earlier)?;
    let earlier = earlier.min(then.end());
    let rate = (1.0 / velocity - 1.0 / then.velocity(earlier)) / (end - earlier);
    ((rate / attracting - 1.0).abs() < WITHIN).then_some(Creeping { rate, attracting })
}
