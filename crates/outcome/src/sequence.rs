//! Changes of the extrema of l from one period to the next, and their extrapolation.

use stickslip_tip::motion::Extremum;

/// The latest extrema of l, latest first: maxima and minima in turn.
pub(crate) struct Sequence<'a>(pub(crate) &'a [Extremum]);

/// Number of periods over which the changes are compared.
const PERIODS: usize = 6;
const FEWEST: usize = 4;
/// Successive changes with a larger ratio possibly do not decrease at all.
const FALLS: f64 = 0.95;
/// Largest number of maxima of l in a period.
pub(crate) const MOST_SLIPS: usize = 8;

impl Sequence<'_> {
    /// Largest change of an extremum between the period of `slips` maxima that ended `back` periods ago and the one
    /// before it; `None` if the extrema do not extend that far back.
    pub(crate) fn change(&self, slips: usize, back: usize) -> Option<f64> {
        let changes = self.changes(slips, back)?;
        Some(changes.map(f64::abs).fold(0.0, f64::max))
    }

    fn changes(&self, slips: usize, back: usize) -> Option<impl Iterator<Item = f64>> {
        let period = 2 * slips;
        let here = self.0.get(back * period..(back + 1) * period)?;
        let before = self.0.get((back + 1) * period..(back + 2) * period)?;
        Some(here.iter().zip(before).map(|(a, b)| a.l - b.l))
    }

    /// The largest ratio of a change to that one period before, over at least four changes; `None` unless it is below
    /// [`FALLS`].
    pub(crate) fn slowest_factor(&self, slips: usize) -> Option<f64> {
        let sizes: Vec<f64> = (0..PERIODS).map_while(|back| self.change(slips, back)).collect();
        let factors = sizes.windows(2).map(|pair| pair[0] / pair[1]);
        let slowest = factors.fold(0.0, f64::max);
        (sizes.len() >= FEWEST && slowest < FALLS).then_some(slowest)
    }

    /// The candidate numbers of maxima in a period, the likeliest first. The first is the smallest number with which the
    /// motion repeats itself within `near`, or else best within a factor of 2. Then follow 1, and 2 if every other slip is
    /// alike.
    pub(crate) fn likely_slips(&self, near: f64) -> Vec<usize> {
        let changes: Vec<(usize, f64)> = (1..=MOST_SLIPS)
            .map_while(|slips| self.change(slips, 0).map(|change| (slips, change)))
            .collect();
        let least = changes.iter().map(|(_, change)| *change).fold(f64::INFINITY, f64::min);
        let repeats = |most: f64| changes.iter().find(|(_, change)| *change <= most);
        let best = repeats(near).or_else(|| repeats(2.0 * least));
        let mut likely: Vec<usize> = best.map(|(slips, _)| *slips).into_iter().collect();
        let alternates = changes.len() > 1 && changes[1].1 < changes[0].1;
        let others = [Some(1), alternates.then_some(2)].into_iter().flatten();
        for slips in others {
            if !likely.contains(&slips) && self.0.len() > 2 * slips {
                likely.push(slips);
            }
        }
        likely
    }

    /// Half the latest peak-to-peak value of l, and the rate of growth of the oscillation over the last periods.
    pub(crate) fn swing(&self) -> Option<(f64, f64)> {
        let swings: Vec<(f64, f64)> =
            self.0.windows(2).map(|e| (e[0].t, 0.5 * (e[0].l - e[1].l).abs())).collect();
        let (last, first) = (swings.first()?, swings.get(..2 * PERIODS).unwrap_or(&swings).last()?);
        let rate = (last.1 / first.1).ln() / (last.0 - first.0);
        Some((last.1, if rate.is_finite() { rate } else { 0.0 }))
    }
}
