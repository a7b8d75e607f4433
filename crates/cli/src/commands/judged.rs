//! Checks of a raw table of a tip.

use super::summary::quoted;
use crate::failure::Failure;
use crate::session::Session;
use std::path::Path;
use stickslip_measurement::{Verdict, judge};
use stickslip_tip::TipFunction;

/// Rejects a table whose result depends on noise, and warns if noise has an effect or if that is unknown.
pub(super) fn judge_table(
    session: &Session,
    path: &Path,
    (x, f): (&[f64], &[f64]),
    tip: &TipFunction,
) -> Result<(), Failure> {
    let option = format!("--tip-file {}", path.display());
    let advice = match tip.footprint() {
        Some(_) => "fit it: `stickslip tip IMAGE.gsf -o tip.json` with the original image, then --tip-file tip.json".into(),
        None => format!(
            "fit it: `stickslip tip {} --half --sigma 1σ -o tip.json`, then --tip-file tip.json",
            quoted(path.display().to_string())
        ),
    };
    match judge((x, f), tip) {
        Verdict::Sound => Ok(()),
        Verdict::Few { rows } => {
            session.say(format_args!(
                "stickslip: {option}: {rows} rows are too few to distinguish noise from shape: 2 % of noise can halve alpha_c"
            ));
            Ok(())
        }
        Verdict::Felt { change } => {
            session.say(format_args!(
                "stickslip: {option}: its noise may change alpha_c by {:.0} % (r = 1); {advice}",
                100.0 * change
            ));
            Ok(())
        }
        Verdict::Decided { table, fitted } => {
            let instead =
                fitted.map(|fitted| format!(" where a sum of few Gaussians has {fitted:.4}"));
            let message = format!(
                "the noise dominates: alpha_c = {table:.4} at r = 1{}; {advice}",
                instead.unwrap_or_default()
            );
            Err(Failure::input(option, message))
        }
    }
}
