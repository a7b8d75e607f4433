//! The picture of a sweep: a phase diagram over two parameters, amplitude and period over one.

use crate::failure::Failure;
use crate::plot::{self, Phase};
use stickslip_documents::{RegimeName, SweepParameters, SweepPoint};

const ALPHA: &str = "α = ΓNa/(k²σ²)";
const R: &str = "r = Γv₀/(kσ)";

/// A parameter that varies.
#[derive(Debug, Clone, Copy)]
struct Axis<'a> {
    values: &'a [f64],
    label: &'static str,
    /// Index of a point in the grid to its place along this axis.
    stride: usize,
}

/// Those that vary, the slowest first.
fn axes(parameters: &SweepParameters) -> Vec<Axis<'_>> {
    let SweepParameters { beta, r, alpha, alpha_above, .. } = parameters;
    let above = alpha_above.as_deref().map(|values| (values, "α − αc"));
    let (alphas, label) =
        alpha.as_deref().map(|values| (values, ALPHA)).or(above).unwrap_or((&[], ALPHA));
    let stride = alphas.len();
    let all = [
        Axis { values: beta.as_deref().unwrap_or(&[]), label: "β", stride: stride * r.len() },
        Axis { values: r, label: R, stride },
        Axis { values: alphas, label, stride: 1 },
    ];
    all.into_iter().filter(|axis| axis.values.len() > 1).collect()
}

/// Refuses a grid that no picture shows.
pub(crate) fn judge(parameters: &SweepParameters) -> Result<(), Failure> {
    match axes(parameters).len() {
        1 | 2 => Ok(()),
        0 => Err(Failure::input("--plot", "a single point is no picture: give a range LO:HI:N")),
        _ => Err(Failure::input("--plot", "a picture has room for two ranges: fix one of them")),
    }
}

/// An SVG document.
pub(crate) fn draw(parameters: &SweepParameters, points: &[SweepPoint]) -> String {
    match axes(parameters).as_slice() {
        [axis] => over(*axis, points),
        [slow, fast] => phases(*slow, *fast, points),
        _ => String::new(),
    }
}

fn over(axis: Axis, points: &[SweepPoint]) -> String {
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let of = |value: fn(&SweepPoint) -> Option<f64>| -> Vec<f64> {
        points.iter().map(|p| number(value(p))).collect()
    };
    let x: Vec<f64> =
        points.iter().map(|p| axis.values[p.index / axis.stride % axis.values.len()]).collect();
    let phases: Vec<Option<Phase>> = points.iter().map(phase).collect();
    plot::phases_over(&plot::PhasesOver {
        title: "What the tip settles into",
        label: axis.label,
        x: &x,
        phases: &phases,
        amplitude: &of(|p| p.amplitude_x0),
        period: &of(|p| p.period),
    })
}

fn phases(slow: Axis, fast: Axis, points: &[SweepPoint]) -> String {
    let mut cells = vec![None; slow.values.len() * fast.values.len()];
    for point in points {
        let at = |axis: &Axis| point.index / axis.stride % axis.values.len();
        cells[at(&slow) * fast.values.len() + at(&fast)] = phase(point);
    }
    let range = |axis: &Axis| {
        let (first, last) = (axis.values[0], axis.values[axis.values.len() - 1]);
        (first, last, axis.values.len())
    };
    plot::phases(&plot::PhaseFigure {
        title: "What the tip settles into",
        labels: (slow.label, fast.label),
        x: range(&slow),
        y: range(&fast),
        phases: &cells,
    })
}

fn phase(point: &SweepPoint) -> Option<Phase> {
    Some(match (point.regime?, point.slips) {
        (RegimeName::Steady, _) => Phase::Steady,
        (RegimeName::StickSlip, Some(1)) => Phase::OneSlip,
        (RegimeName::StickSlip, Some(2)) => Phase::TwoSlips,
        (RegimeName::StickSlip, _) => Phase::MoreSlips,
        (RegimeName::Trapped, _) => Phase::Trapped,
        (RegimeName::Transient, _) => Phase::Unsettled,
    })
}
