//! The first step of a motion that begins at rest or backwards, as a function of time.

use super::super::chain::{Acting, Chain};
use super::super::pieces::{self, nodes};
use super::super::plan::{self, Limits};
use super::super::switch::Switch;
use super::super::values::Outlook;
use super::super::visits;
use super::Begin;
use super::past::Exponentials;
use crate::Wider;
use crate::collocation::STAGES;
use crate::history::Step;
use crate::integrator::landing::landing;
use crate::memory::ROOM;
use num_complex::Complex;

/// The pieces of this step on a flat surface, and the states after it; `None` for a run that is shorter.
pub(super) fn first_step(
    begin: &Begin,
    (limits, longest): (&Limits, f64),
    exponentials: &Exponentials,
) -> Option<(Vec<Step>, Vec<Complex<f64>>)> {
    let Begin { alpha, r, t, extension, until, .. } = *begin;
    let mut chain = Chain::new();
    chain.start((limits.order, false), alpha, &[0.0; ROOM], &[]);
    chain.run(&Acting {
        alpha,
        of_tip: &exponentials.of_tip,
        spring: 1.0,
        support: r,
        healing: 0.0,
        inertia: None,
        extension,
        depth: None,
    });
    let series = chain.displacement();
    let over = limits.accurate(series, None, &Wider::default());
    let over = plan::within(over, longest, |over| Outlook::over(series, over));
    let stiffness = 1.0 - chain.curvature();
    let plan = limits.plan(&mut Switch::new(false), over, stiffness, until - t)?;
    let total = landing(t, plan.length, until).filter(|total| t + total < until)?;
    let displacement = series.over(total);
    let mut room = pieces::ROOM_FOR_NODES;
    let positions = nodes(plan.pieces).table.sums(&displacement, &mut room).as_chunks().0;
    let end = positions.last()?[STAGES - 1];
    let steps = pieces::steps((t, total), (extension, r), positions.iter().copied(), None);
    let steps = steps.collect();
    let rule = limits.visits.rule(plan.fastest * total, 0.0).unwrap_or_else(visits::last);
    let mut room = visits::ROOM;
    let positions = rule.table.sums(&displacement, &mut room);
    let visit = |(position, weight): (&f64, &f64)| (end - position, total * weight);
    let visits: Vec<_> = positions.iter().zip(&rule.weights).map(visit).collect();
    Some((steps, exponentials.visited(&visits).collect()))
}
