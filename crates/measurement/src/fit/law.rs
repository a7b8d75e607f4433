//! Test of a depth limit as an alternative explanation of the data.
//!
//! A depth limit gives ripples of nearly the same shape as the basic model at another α and r. Heights of unknown gain
//! contain only this shape. Therefore the parameters are fitted once more with a depth limit.

use super::data::Data;
use super::likelihood::Around;
use super::parameters::{Name, Values};
use super::problem::Problem;
use super::rivals::Alternative;
use crate::least_squares::minimum;

/// α/αc and r of a second starting point, if the search from the best fit fails: the basic model may have its best
/// fit in a separate valley.
const ELSEWHERE: (f64, f64) = (1.15, 1.0);
/// Depth limits to try, in kσ²/a: that of a surface a few ripples deep, and one with a weak effect.
const TRIED: [f64; 2] = [4.0, 16.0];

/// The best fit with a depth limit, if the data do not exclude it at 95 % and it changes a parameter by more than
/// half of its interval; `None` if the request contains a depth limit, or a gain is known.
pub(super) fn with_depth_limit(problem: &Problem, around: &Around) -> Option<Alternative> {
    let name = Name::DepthLimit;
    let is_requested = problem.free.contains(&name) || problem.held.get(name).is_some();
    if is_requested || problem.data.iter().any(Data::has_gain) {
        return None;
    }
    let best = problem.values(&around.best.parameters)?;
    let numbers = problem.free.len();
    let of = |limit: f64, begun: &Values| {
        let held = problem.held.with(name, limit);
        let there = Problem { held, by_excess: true, ..problem.clone() };
        // As far above its own onset as the motion without a limit is above its.
        let mut start = there.searched_for(begun)?;
        start.extend(&around.best.parameters[numbers..]);
        let (there, end) = there.by_logarithms(&minimum(&there, &start)?)?;
        let behind = around.behind(&end);
        let moved = |i: usize| (end.parameters[i] - around.best.parameters[i]).abs();
        let is_elsewhere = (0..numbers).any(|i| moved(i) > around.deviation(i));
        let values = there.values(&end.parameters)?;
        let found = Alternative { values, scans: there.scans, behind };
        (behind < around.most() && is_elsewhere).then_some(found)
    };
    let try_from = |begun: &Values| TRIED.into_iter().find_map(|limit| of(limit, begun));
    try_from(&best).or_else(|| try_from(&elsewhere(problem, &best)?))
}

/// A model at [`ELSEWHERE`] with the same wavelength.
fn elsewhere(problem: &Problem, best: &Values) -> Option<Values> {
    let r = problem.held.get(Name::R).unwrap_or(ELSEWHERE.1);
    let near = best.with(Name::R, r);
    let near = near.with(Name::Alpha, ELSEWHERE.0 * problem.onset(&near, r)?.0);
    let stretched = problem.wavelength(best)? / problem.wavelength(&near)?;
    Some(near.with(Name::Width, stretched * best.get(Name::Width)?))
}
