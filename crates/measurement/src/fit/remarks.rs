//! Warnings about a fit, in words.

use super::likelihood::{Around, Fitted, least_determined};
use super::parameters::{Name, Values};
use super::problem::Problem;
use super::verdict::{CHANGE, MISFIT};
use super::{Fit, Part};

/// Ratio of the ends of an interval above which it is reported as wide.
const WIDE: f64 = 3.0;
/// Smallest exponent listed in a combination of parameters.
const NO_POWER: f64 = 0.15;
/// Ratio of effective to actual rows below which rows are reported as correlated.
const CORRELATED: f64 = 0.7;
/// Smallest number of wavelengths that shows changes of the ripples.
const FEW: f64 = 3.0;

pub(super) fn remarks(
    problem: &Problem,
    around: &Around,
    fit: &Fit,
    scattered: bool,
) -> Vec<String> {
    let mut remarks = vec![];
    for (i, part) in fit.parts.iter().enumerate() {
        of_part(&mut remarks, i + 1, part);
    }
    if let Some(joint) = fit.joint.filter(|p| *p < MISFIT) {
        remarks.push(format!(
            "no common set of parameters explains all data (probability {}): they belong to different motions, or the model is incomplete",
            in_percent(joint)
        ));
    }
    if !scattered {
        remarks.push(
            "the rows fit the model exactly, so their scatter gives no estimate of the errors: no intervals".into(),
        );
    } else if !fit.explained {
        remarks.push(
            "intervals are left out, because they assume that the model explains the data".into(),
        );
    }
    if fit.slips > 1 {
        remarks.push(
            "the ripples repeat after two slips: the numbers are those of a motion beyond a period doubling".into(),
        );
    }
    alternatives(&mut remarks, problem, fit);
    depth_limit(&mut remarks, problem, fit);
    if fit.explained {
        wide(&mut remarks, problem, around, fit);
    }
    remarks
}

fn in_percent(probability: f64) -> String {
    if probability < 1e-5 {
        "below 0.001 %".into()
    } else {
        format!("{:.2} %", 100.0 * probability)
    }
}

fn of_part(remarks: &mut Vec<String>, number: usize, part: &Part) {
    let judged = &part.judged;
    if let Some(p) = judged.doubling.filter(|p| *p < CHANGE) {
        remarks.push(format!(
            "data {number} repeat with twice the wavelength (probability of this by chance: {}), and no motion of two \
             slips in a wavelength explains them",
            in_percent(p)
        ));
    }
    if judged.irregular {
        remarks.push(format!(
            "the ripples of data {number} differ from one to the next by more than 30 %, and smoothly: they are \
             irregular, or not from one settled motion"
        ));
    }
    if let Some(p) = judged.drift.filter(|p| *p < CHANGE) {
        remarks.push(format!(
            "the ripples of data {number} change along the track (probability of this by chance: {}): the motion has not settled, or the \
             instrument drifts; cut out a part where they are uniform",
            in_percent(p)
        ));
    }
    if let Some(p) = judged.misfit.filter(|p| *p < MISFIT) {
        remarks.push(format!(
            "the model does not explain data {number} (probability of so large a deviation by chance: {}): try \
             another footprint, or an extended model (depth limit, healing, inertia)",
            in_percent(p)
        ));
    }
    if part.gain.is_some_and(|gain| gain < 0.0) {
        remarks.push(format!(
            "data {number} have the opposite sign of the model: heights are positive upwards, forces positive against the motion"
        ));
    }
    if judged.wavelengths.is_some_and(|count| count < FEW) {
        remarks.push(format!(
            "data {number} have fewer than three wavelengths: too few to show whether the ripples are uniform"
        ));
    }
    let rows = part.model.len() as f64;
    if let Some(effective) = judged.effective.filter(|e| *e < CORRELATED * rows) {
        remarks.push(format!(
            "the noise of data {number} is correlated from row to row: {rows} rows count as {effective:.0} independent ones, and the \
             intervals are wider accordingly"
        ));
    }
}

fn alternatives(remarks: &mut Vec<String>, problem: &Problem, fit: &Fit) {
    let Some(first) = fit.alternatives.first() else { return };
    let turned = first.scans != problem.scans;
    let words = if turned { ", for a scan in the other direction," } else { "" };
    let covered = if fit.explained { "; the intervals cover both where the data do" } else { "" };
    remarks.push(format!(
        "another minimum{words} is nearly as good (χ² higher by {:.1}): {}{covered}",
        first.behind.max(0.0),
        numbers(problem, &first.values)
    ));
}

fn depth_limit(remarks: &mut Vec<String>, problem: &Problem, fit: &Fit) {
    let Some(found) = &fit.with_depth_limit else { return };
    let limit = found.values.get(Name::DepthLimit).unwrap_or(f64::INFINITY);
    remarks.push(format!(
        "a surface with a depth limit of {limit} kσ²/a explains the data as well (χ² {} by {:.1}): {}; the intervals are those of a \
         surface without one. Give k/a or a friction trace, or fit the depth limit too",
        if found.behind < 0.0 { "lower" } else { "higher" },
        found.behind.abs(),
        numbers(problem, &found.values)
    ));
}

/// The fitted parameters, as text.
fn numbers(problem: &Problem, values: &Values) -> String {
    let number = |name: &Name| Some(format!("{} = {:.4}", name.word(), values.get(*name)?));
    problem.free.iter().filter_map(number).collect::<Vec<String>>().join(", ")
}

fn wide(remarks: &mut Vec<String>, problem: &Problem, around: &Around, fit: &Fit) {
    let open = |n: &&Fitted| n.estimate.high / n.estimate.low > WIDE;
    let wide: Vec<&str> = fit.numbers.iter().filter(open).map(|n| n.name.word()).collect();
    if wide.is_empty() {
        return;
    }
    let combination = least_determined(around)
        .filter(|(powers, _)| powers.iter().filter(|p| p.abs() > NO_POWER).count() > 1);
    remarks.push(match combination {
        Some((powers, _)) => {
            let each = problem.free.iter().zip(powers).filter(|(_, p)| p.abs() > NO_POWER);
            let words = each.map(|(name, p)| format!("{}^{p:.2}", name.word()));
            format!(
                "these data hardly constrain {}: they change little along {}; fix one of these parameters, or give data of another kind",
                wide.join(" and "),
                words.collect::<Vec<String>>().join(" · ")
            )
        }
        None => format!("these data hardly constrain {}", wide.join(" and ")),
    });
}
