//! Maxima and minima of l(t), looked for from the end of a run backwards.

use crate::collocation::{RADAU, apply};
use crate::roots::bisect;
use crate::{Step, Trajectory};

/// A time and the value of l there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremum {
    pub(crate) t: f64,
    pub(crate) l: f64,
    pub(crate) is_maximum: bool,
}

/// The extrema of l, latest first.
#[derive(Debug, Clone)]
pub(crate) struct Extrema {
    pub(crate) latest_first: Vec<Extremum>,
}

/// So many are enough to compare three cycles of up to eight slips.
const MOST: usize = 64;

impl Extrema {
    pub(crate) fn at_the_end_of(trajectory: &Trajectory) -> Self {
        let mut latest_first = vec![];
        for step in trajectory.steps().iter().rev() {
            let mut here = turning_points(trajectory, step);
            here.reverse();
            latest_first.extend(here);
            if latest_first.len() >= MOST {
                break;
            }
        }
        Self { latest_first }
    }

    /// The maxima, latest first.
    pub(crate) fn maxima(&self) -> Vec<Extremum> {
        self.latest_first.iter().filter(|e| e.is_maximum).copied().collect()
    }
}

/// Where l' = r - x0' changes sign between collocation nodes of the step.
fn turning_points(trajectory: &Trajectory, step: &Step) -> Vec<Extremum> {
    let l_slope = |tau: f64| trajectory.r() - RADAU.slope(&step.displacement, tau) / step.h;
    let at_nodes = apply(&RADAU.derivative, &step.displacement);
    let mut before = (0.0, l_slope(0.0));
    let mut found = vec![];
    for (c, moving) in RADAU.c.iter().zip(at_nodes) {
        let after = (*c, trajectory.r() - moving / step.h);
        if before.1 * after.1 < 0.0 {
            let tau = bisect(l_slope, before.0, after.0);
            let t = step.t + tau * step.h;
            found.push(Extremum { t, l: trajectory.l(t), is_maximum: before.1 > 0.0 });
        }
        before = after;
    }
    found
}
