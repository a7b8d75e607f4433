//! Fits of increasing numbers of Gaussians, each started at the largest residual of the one before, and the selection
//! by the data.

use super::shape::{Places, Shape, gaussians, pair};
use crate::Profile;
use crate::least_squares::{minimum, squares};
use crate::projection::project;
use stickslip_tip::Gaussian;
use stickslip_tip::sorting::sort_by_number;

/// A fit with a given number of Gaussians (a symmetric pair counts as one), a local minimum.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Number of Gaussians, where a symmetric pair counts as one.
    pub terms: usize,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// Standard deviation of the residuals, with the remaining degrees of freedom, in the unit of the heights.
    pub residual: f64,
    /// Schwarz' criterion, n ln(S/n) + p ln n; lower is better.
    pub criterion: f64,
    /// αc(r) of this sum; NaN if it has none.
    pub critical_alpha: f64,
    /// Lower bound on the widths.
    pub(super) finest: f64,
    pub(super) places: Places,
    /// Coefficients of 1, x, x², … of the background.
    pub(super) ground: Vec<f64>,
    pub(super) amplitudes: Vec<f64>,
    pub(super) residuals: Vec<f64>,
}

/// Largest number of Gaussians.
pub(super) const MOST_TERMS: usize = 6;
/// Number of starting points of a further term.
const TRIED: usize = 4;
/// Positions and widths in the grid of starting points.
const POSITIONS: usize = 15;
const WIDTHS: usize = 7;
/// Number of starting centres of the first term.
const CENTRES: usize = 31;
/// Residual relative to the heights that counts as round-off.
const ROUND_OFF: f64 = 1e-13;

/// The result of a search.
#[derive(Debug)]
pub(super) struct Found {
    /// The best fit with one, two … Gaussians.
    pub(super) best: Vec<Candidate>,
    /// Other local minima, worse than the best with as many Gaussians.
    pub(super) others: Vec<Candidate>,
}

/// Relative difference of residuals above which two sums count as different.
const ANOTHER: f64 = 1e-3;

impl Candidate {
    /// Whether two sums are different minima.
    fn is_another_than(&self, other: &Self) -> bool {
        let apart = self.residuals.iter().zip(&other.residuals).map(|(a, b)| a - b);
        squares(&apart.collect::<Vec<f64>>()) > ANOTHER * ANOTHER * squares(&other.residuals)
    }

    /// The fit at the end of a search. `effective` is the number of independent rows.
    fn at(shape: &Shape, searched: &[f64], effective: f64) -> Option<Self> {
        let places = shape.places(searched);
        let found = shape.projected(&places)?;
        let (rows, parameters) = (found.residuals.len(), shape.count());
        let sum = squares(&found.residuals);
        let size = squares(shape.profile.f()).sqrt() * ROUND_OFF;
        let mean = (sum / rows as f64).max(size * size);
        Some(Self {
            terms: shape.terms,
            parameters,
            residual: (sum / rows.saturating_sub(parameters).max(1) as f64).sqrt(),
            criterion: effective * mean.ln() + parameters as f64 * effective.ln(),
            critical_alpha: f64::NAN,
            finest: shape.widths.least,
            ground: shape.in_powers_of_x(&found.coefficients[..=shape.order]),
            amplitudes: found.coefficients[shape.order + 1..].to_vec(),
            residuals: found.residuals,
            places,
        })
    }

    /// The Gaussians of the sum, with symmetric pairs written as two, about x = 0.
    pub(super) fn gaussians(&self) -> Vec<Gaussian> {
        gaussians(&self.places, &self.amplitudes)
    }

    /// The sum at a position of the data.
    pub(super) fn height(&self, x: f64) -> f64 {
        let terms = self.places.terms.iter().zip(&self.amplitudes);
        let sum = terms.map(|((d, w), a)| a * pair(x - self.places.centre, *d, *w)).sum::<f64>();
        self.ground_at(x) + sum
    }

    fn ground_at(&self, x: f64) -> f64 {
        self.ground.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// Highest power of x in the background.
    pub(super) fn order(&self) -> usize {
        self.ground.len() - 1
    }

    /// The fit with the criterion for this number of independent rows.
    pub(super) fn judged(mut self, effective: f64) -> Self {
        let rows = self.residuals.len() as f64;
        let mean = squares(&self.residuals) / rows;
        if mean > 0.0 {
            self.criterion = effective * mean.ln() + self.parameters as f64 * effective.ln();
        }
        self
    }

    /// The same sum fitted to other heights, started from here.
    pub(super) fn again(
        &self,
        profile: &Profile,
        centre: Option<f64>,
        effective: f64,
    ) -> Option<Self> {
        let shape = Shape::of(profile, centre, (self.terms, self.finest), self.order());
        let start = shape.searched(&self.places);
        Self::at(&shape, &minimum(&shape, &start)?.parameters, effective)
    }
}

/// Number of consecutive sums worse than one with fewer terms after which the search ends.
const ENOUGH_BEHIND: usize = 2;

/// The lowest criterion.
fn least(candidates: &[Candidate]) -> f64 {
    candidates.iter().map(|c| c.criterion).fold(f64::INFINITY, f64::min)
}

/// Smallest width of further terms relative to that of the footprint; if the residual then exceeds the noise, the
/// rows determine the smallest width.
const FINEST: f64 = 0.4;
/// Ratio of residual to noise from row to row above which the residual counts as too large.
const ABOVE_NOISE: f64 = 1.2;

/// Orders of the background: straight, curved, or S-shaped.
const ORDERS: std::ops::RangeInclusive<usize> = 1..=3;

/// The best fits, on the best background, with one, two … Gaussians up to `asked`, or up to the number that the rows
/// permit and the data may require. Fits on other backgrounds are in [`Found::others`].
pub(super) fn candidates(profile: &Profile, centre: Option<f64>, asked: Option<usize>) -> Found {
    let mut chosen = on_ground(profile, (centre, 1), asked);
    for order in ORDERS.skip(1) {
        let mut found = on_ground(profile, (centre, order), asked);
        if found.best.is_empty() {
            break;
        }
        if least(&found.best) < least(&chosen.best) {
            std::mem::swap(&mut chosen, &mut found);
        }
        chosen.others.extend(found.best.into_iter().chain(found.others));
    }
    chosen
}

/// The fits on a background of one order.
fn on_ground(
    profile: &Profile,
    (centre, order): (Option<f64>, usize),
    asked: Option<usize>,
) -> Found {
    let coarse = ever_more(profile, (centre, order), asked, FINEST);
    let left = |found: &[Candidate]| {
        let best = found.iter().min_by(|a, b| a.criterion.total_cmp(&b.criterion));
        best.map_or(f64::INFINITY, |best| best.residual)
    };
    if left(&coarse.best) <= ABOVE_NOISE * profile.noise() {
        return coarse;
    }
    let fine = ever_more(profile, (centre, order), asked, 0.0);
    if least(&fine.best) < least(&coarse.best) { fine } else { coarse }
}

/// The fits with further Gaussians no narrower than this fraction of the first.
fn ever_more(
    profile: &Profile,
    (centre, order): (Option<f64>, usize),
    asked: Option<usize>,
    finest: f64,
) -> Found {
    let rows = profile.x().len();
    let most = asked.unwrap_or(MOST_TERMS);
    let (mut found, mut others): (Vec<Candidate>, Vec<Candidate>) = (vec![], vec![]);
    for terms in 1..=most {
        let width = found.first().map_or(0.0, |first| first.places.terms[0].1);
        let shape = Shape::of(profile, centre, (terms, finest * width), order);
        if shape.count() + 4 > rows {
            break;
        }
        let starts = match found.last() {
            None => first(&shape),
            Some(before) => further(&shape, before),
        };
        let ends = starts.iter().filter_map(|start| {
            let end = minimum(&shape, &shape.searched(start))?;
            Candidate::at(&shape, &end.parameters, rows as f64)
        });
        let mut ends: Vec<Candidate> = ends.collect();
        sort_by_number(&mut ends, |item| item.residual);
        let mut ends = ends.into_iter();
        let Some(best) = ends.next() else { break };
        others.extend(ends.filter(|other| other.is_another_than(&best)));
        found.push(best);
        let behind = found.iter().rev().take_while(|c| c.criterion > least(&found)).count();
        if asked.is_none() && behind == ENOUGH_BEHIND {
            break;
        }
    }
    Found { best: found, others }
}

/// A grid of widths between the limits.
fn widths(shape: &Shape) -> impl Iterator<Item = f64> {
    let (least, most) = (shape.widths.least, shape.widths.most);
    (0..WIDTHS).map(move |i| {
        let part = (i as f64 + 0.5) / WIDTHS as f64;
        least * (most / least).powf(part)
    })
}

/// The best single Gaussians on a grid of centres and widths.
fn first(shape: &Shape) -> Vec<Places> {
    let centres: Vec<f64> = match shape.centre {
        Some(centre) => vec![centre],
        None => {
            let at = |i: usize| 1.8 * (i as f64 / (CENTRES - 1) as f64 - 0.5);
            (0..CENTRES).map(|i| shape.middle + shape.half * at(i)).collect()
        }
    };
    let places = centres.into_iter().flat_map(|centre| {
        widths(shape).map(move |width| Places { centre, terms: vec![(0.0, width)] })
    });
    let judged = places.filter_map(|places| {
        let left = squares(&shape.projected(&places)?.residuals);
        Some((left, places))
    });
    best(judged.collect())
}

/// The previous sum with one more term, at the points of a grid of positions and widths that reduce the residual
/// most.
fn further(shape: &Shape, before: &Candidate) -> Vec<Places> {
    let x = shape.profile.x();
    let centre = before.places.centre;
    let mut columns = shape.ground();
    let column = |d: f64, w: f64| x.iter().map(|x| pair(x - centre, d, w)).collect::<Vec<f64>>();
    columns.extend(before.places.terms.iter().map(|(d, w)| column(*d, *w)));
    let reach = x.iter().map(|x| (x - centre).abs()).fold(0.0, f64::max);
    let judged = |d: f64, w: f64| {
        let new = column(d, w);
        // What the terms that are there leave of it, and how much of what they leave of the data that takes.
        let new = project(&columns, &new)?.residuals;
        let size = squares(&new);
        let along: f64 = new.iter().zip(&before.residuals).map(|(a, b)| a * b).sum();
        let gain = along * along / size;
        let terms = before.places.terms.iter().copied().chain([(d, w)]).collect();
        gain.is_finite().then_some((-gain, Places { centre, terms }))
    };
    // One of each place, so that they lead to different ends.
    let places = (0..POSITIONS).filter_map(|i| {
        let d = 0.9 * reach * i as f64 / POSITIONS as f64;
        widths(shape).filter_map(|w| judged(d, w)).min_by(|a, b| a.0.total_cmp(&b.0))
    });
    best(places.collect())
}

/// The few candidates with the smallest residuals.
fn best(mut judged: Vec<(f64, Places)>) -> Vec<Places> {
    sort_by_number(&mut judged, |item| item.0);
    judged.into_iter().take(TRIED).map(|(_, places)| places).collect()
}
