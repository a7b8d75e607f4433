//! How far f64 goes.

use crate::arguments::ModelArguments;
use crate::failure::{Failure, Typed};
use stickslip::FARTHEST;
use stickslip_tip::{Model, Scenario};

/// Refuses what no run can do justice to, for want of digits.
pub(crate) fn within_range(arguments: &ModelArguments, scenario: &Scenario) -> Result<(), Failure> {
    let (x, kick, until) = (scenario.start_position, scenario.kick, scenario.until);
    let r = scenario.model.r();
    // Without a spring there is none.
    let lag = if scenario.model.wider().spring { scenario.model.steady_lag() } else { 0.0 };
    let distances = [
        (format!("--start-position {}", Typed(x)), "the tip would start at", x),
        (format!("--kick {}", Typed(kick)), "the tip would be displaced by", kick),
        (format!("--until {}", Typed(until)), "the support would go to r until =", r * until),
        (
            behind_the_lag(arguments, &scenario.model),
            "in steady motion the tip would lag behind by r + alpha f(0)/r =",
            lag,
        ),
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

/// The option that makes r + α f(0)/r what it is: the one farthest from 1.
fn behind_the_lag(arguments: &ModelArguments, model: &Model) -> String {
    let (alpha, r, height) = (model.alpha(), model.r(), model.tip().value(0.0).abs());
    if height > alpha.max(r).max(1.0 / r) {
        if let Some(beta) = arguments.tip.beta {
            return format!("--beta {}", Typed(beta));
        }
        if let Some(path) = &arguments.tip.tip_file {
            return format!("--tip-file {}", path.display());
        }
    }
    match arguments.alpha_above {
        _ if r.max(1.0 / r) > alpha => format!("--r {}", Typed(r)),
        Some(above) => format!("--alpha-above {}", Typed(above)),
        None => format!("--alpha {}", Typed(alpha)),
    }
}
