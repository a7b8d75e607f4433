//! How far f64 goes.

use crate::arguments::ModelArguments;
use crate::failure::{Failure, Typed};
use stickslip_tip::Scenario;

/// Positions beyond this are rounded by a thousandth of σ and more, a tenth of the largest tolerance.
pub(super) const FARTHEST: f64 = 1e13;

/// Refuses what no run can do justice to, for want of digits.
pub(crate) fn within_range(arguments: &ModelArguments, scenario: &Scenario) -> Result<(), Failure> {
    let (x, kick, until) = (scenario.start_position, scenario.kick, scenario.until);
    let (r, lag) = (scenario.model.r(), scenario.model.steady_lag());
    let alpha = match (arguments.alpha, arguments.alpha_above) {
        (_, Some(above)) => format!("--alpha-above {}", Typed(above)),
        _ => format!("--alpha {}", Typed(scenario.model.alpha())),
    };
    let distances = [
        (format!("--start-position {}", Typed(x)), "the tip would start at", x),
        (format!("--kick {}", Typed(kick)), "the tip would be displaced by", kick),
        (format!("--until {}", Typed(until)), "the support would go to r until =", r * until),
        (alpha, "in steady motion the tip would lag behind by r + alpha f(0)/r =", lag),
    ];
    // What is not finite is left to the validation of the scenario.
    let far = |distance: f64| distance.abs() > FARTHEST;
    match distances.into_iter().find(|(_, _, distance)| far(*distance)) {
        None => Ok(()),
        Some((option, what, distance)) => Err(Failure::input(
            option,
            format!(
                "{what} {}; at most {FARTHEST:e} will do, where a thousandth is the last digit that \
                 a position has",
                Typed(distance)
            ),
        )),
    }
}
