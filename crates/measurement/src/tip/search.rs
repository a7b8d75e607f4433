//! Sums of ever more Gaussians, each begun where the one before leaves most, and which of them the data ask for.

use super::shape::{Places, Shape, gaussians, pair};
use crate::Profile;
use crate::least_squares::{minimum, squares};
use crate::projection::project;
use stickslip_tip::Gaussian;

/// A sum of so many Gaussians (a pair of twins is one), as near to the data as any near it.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Gaussians, a pair of twins counted once.
    pub terms: usize,
    /// Numbers fitted.
    pub parameters: usize,
    /// Standard deviation of what is left, for as many degrees of freedom as are left, in the unit of the heights.
    pub residual: f64,
    /// Schwarz' criterion, n ln(S/n) + p ln n: the lower, the better.
    pub criterion: f64,
    /// αc(r) of this sum; NaN where it has none.
    pub critical_alpha: f64,
    /// No Gaussian is narrower.
    pub(super) finest: f64,
    pub(super) places: Places,
    /// Coefficients of 1, x, x², … of the ground.
    pub(super) ground: Vec<f64>,
    pub(super) amplitudes: Vec<f64>,
    pub(super) residuals: Vec<f64>,
}

/// Most Gaussians that are tried.
pub(super) const MOST_TERMS: usize = 6;
/// Starts of a further term that are tried.
const TRIED: usize = 4;
/// Positions and widths that these are chosen from.
const POSITIONS: usize = 15;
const WIDTHS: usize = 7;
/// Centres that the first term is begun from.
const CENTRES: usize = 31;
/// What is smaller than the heights by so much is round-off.
const ROUND_OFF: f64 = 1e-13;

/// What a search came to.
#[derive(Debug)]
pub(super) struct Found {
    /// The best sum of one, two … Gaussians.
    pub(super) best: Vec<Candidate>,
    /// Sums that are less good than the best of as many, but as any near them.
    pub(super) others: Vec<Candidate>,
}

/// Residuals that differ by more, over their size, belong to two sums.
const ANOTHER: f64 = 1e-3;

impl Candidate {
    /// Whether it is not the same sum found from elsewhere.
    fn is_another_than(&self, other: &Self) -> bool {
        let apart = self.residuals.iter().zip(&other.residuals).map(|(a, b)| a - b);
        squares(&apart.collect::<Vec<f64>>()) > ANOTHER * ANOTHER * squares(&other.residuals)
    }

    /// From where a search ended. `effective` of the rows are independent.
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

    /// The terms as they stand in the data: twins apart, about x = 0.
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

    /// Highest power of x in the ground.
    pub(super) fn order(&self) -> usize {
        self.ground.len() - 1
    }

    /// The criterion as if so many rows were independent.
    pub(super) fn judged(mut self, effective: f64) -> Self {
        let rows = self.residuals.len() as f64;
        let mean = squares(&self.residuals) / rows;
        if mean > 0.0 {
            self.criterion = effective * mean.ln() + self.parameters as f64 * effective.ln();
        }
        self
    }

    /// The same sum fitted to other heights, from where it is.
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

/// So many sums in a row that are worse than one with fewer terms: more will not be better.
const ENOUGH_BEHIND: usize = 2;

/// The lowest criterion.
fn least(candidates: &[Candidate]) -> f64 {
    candidates.iter().map(|c| c.criterion).fold(f64::INFINITY, f64::min)
}

/// What a footprint hides below the noise is taken to be no finer than this part of its width; where that leaves more
/// than the noise, as fine as the rows.
const FINEST: f64 = 0.4;
/// A residual of so many times the noise from row to row is more than that.
const ABOVE_NOISE: f64 = 1.2;

/// A ground that is straight, curved, or an S.
const ORDERS: std::ops::RangeInclusive<usize> = 1..=3;

/// The best sums of one, two … Gaussians, as many as `asked`, or as there are rows for and as the data may ask for, on
/// the ground that they ask for; sums on other grounds are among the others.
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

/// Those on a ground of one order.
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

/// The same with further Gaussians no narrower than this part of the first.
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
        ends.sort_by(|a, b| a.residual.total_cmp(&b.residual));
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

/// So many widths between the ends.
fn widths(shape: &Shape) -> impl Iterator<Item = f64> {
    let (least, most) = (shape.widths.least, shape.widths.most);
    (0..WIDTHS).map(move |i| {
        let part = (i as f64 + 0.5) / WIDTHS as f64;
        least * (most / least).powf(part)
    })
}

/// The best single Gaussians of a lattice of centres and widths.
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

/// The sum before with one more term, where a lattice of places and widths has it take away most.
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

/// The few that leave least.
fn best(mut judged: Vec<(f64, Places)>) -> Vec<Places> {
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    judged.into_iter().take(TRIED).map(|(_, places)| places).collect()
}
