//! Other minima than the best, and fits with other footprints.

use super::data::Scan;
use super::likelihood::{Around, Rival};
use super::parameters::{Name, Shape, Values};
use super::problem::Problem;
use super::start::Start;
use super::wave::Cycles;
use crate::least_squares::{Minimum, Residuals, minimum, squares};
use stickslip_tip::TipFunction;
use stickslip_tip::sorting::sort_by_number;

/// Another motion that the data do not exclude.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// All parameters, including the known ones.
    pub values: Values,
    /// Direction of the scan of each data set.
    pub scans: Vec<Scan>,
    /// Excess of the sum of squares over the best, in units of the variance of the noise.
    pub behind: f64,
}

/// Largest excess of a minimum that is reported: the 99.7 % quantile of χ² with one degree of freedom.
const REPORTED: f64 = 9.0;
/// Largest relative excess of the sum of squares at which a minimum is refined, before correlations are known.
const FOLLOWED: f64 = 0.25;
/// Largest number of refined minima.
const MOST: usize = 3;
/// Difference of logarithms, in standard deviations, below which two minima count as the same.
const SAME: f64 = 0.3;
/// Absolute difference of logarithms up to which two minima count as the same.
const EQUAL: f64 = 5e-3;

/// All different minima with about the same residual as the best, with their scan directions.
pub(super) fn found(
    problem: &Problem,
    best: &Minimum,
    others: Vec<Start>,
) -> Vec<(Vec<Scan>, Minimum)> {
    let numbers = problem.free.len();
    let is_other = |(scans, at): (&Vec<Scan>, &[f64]), other: (&Vec<Scan>, &[f64])| {
        let apart = |(a, b): (&f64, &f64)| (a - b).abs() > EQUAL;
        scans != other.0 || at[..numbers].iter().zip(&other.1[..numbers]).any(apart)
    };
    let mut found: Vec<(Vec<Scan>, Minimum)> = vec![];
    // Ends of one valley are followed once.
    let mut followed: Vec<(Vec<Scan>, Vec<f64>)> = vec![];
    for Start { scans, searched } in others {
        let is_new =
            |known: &(Vec<Scan>, Vec<f64>)| is_other((&scans, &searched), (&known.0, &known.1));
        if found.len() == MOST || !followed.iter().all(is_new) {
            continue;
        }
        let there = Problem { by_excess: true, scans: scans.clone(), ..problem.clone() };
        followed.push((scans, searched.clone()));
        let near = there.at(&searched).map_or(f64::INFINITY, |left| squares(&left));
        if near > best.sum * (1.0 + FOLLOWED) {
            continue;
        }
        let Some((there, end)) =
            Minimum::at(&there, &searched).and_then(|start| there.by_logarithms(&start))
        else {
            continue;
        };
        let known = found.iter().map(|(scans, other)| (scans, &*other.parameters));
        if known
            .chain([(&problem.scans, &*best.parameters)])
            .all(|known| is_other((&there.scans, &end.parameters), known))
        {
            found.push((there.scans, end));
        }
    }
    found
}

/// The minima that the data do not exclude, for intervals and for the report.
pub(super) fn judged(
    problem: &Problem,
    around: &Around,
    found: Vec<(Vec<Scan>, Minimum)>,
) -> (Vec<Rival>, Vec<Alternative>) {
    let mut rivals: Vec<Rival> = vec![];
    let mut alternatives = vec![];
    for (scans, end) in found {
        let behind = around.behind(&end);
        let there = Problem { scans, ..problem.clone() };
        let Some(values) = there.values(&end.parameters).filter(|_| behind < REPORTED) else {
            continue;
        };
        let Some(deviations) = Around::of(&there, &end).map(|near| near.deviations()) else {
            continue;
        };
        let numbers = problem.free.len();
        let is_same = (0..numbers).all(|i| {
            let apart = (end.parameters[i] - around.best.parameters[i]).abs();
            apart < SAME * around.deviation(i)
        });
        if is_same && there.scans == problem.scans {
            continue;
        }
        rivals.push(Rival { behind, at: end.parameters[..numbers].to_vec(), deviations });
        alternatives.push(Alternative { values, scans: there.scans, behind });
    }
    sort_by_number(&mut alternatives, |alternative| alternative.behind);
    (rivals, alternatives)
}

/// The fits with other footprints, each started at the same relative distance from onset as the best fit.
pub(super) fn with_footprints(
    problem: &Problem,
    best: &Minimum,
    footprints: &[TipFunction],
) -> Vec<Minimum> {
    let of = |tip: &TipFunction| {
        let shape = Shape::Known(tip.clone());
        let cycles = Cycles::of(problem.pattern);
        let other = Problem { shape: &shape, cycles: &cycles, ..problem.clone() };
        let near = Problem { by_excess: true, ..problem.clone() };
        let values = problem.values(&best.parameters)?;
        let mut searched = near.searched_for(&values)?;
        searched.extend(&best.parameters[problem.free.len()..]);
        let there = Problem { by_excess: true, ..other.clone() };
        let values = there.values(&searched).or(Some(values))?;
        let mut start = other.searched_for(&values)?;
        start.extend(&best.parameters[problem.free.len()..]);
        minimum(&other, &start)
    };
    if problem.free.contains(&Name::Beta) {
        return vec![];
    }
    footprints.iter().filter_map(of).collect()
}
