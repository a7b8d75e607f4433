//! Amplitude and period of what the motion comes to, over one parameter.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::phases::Phase;
use super::sheet::sheet;
use super::style::LOW;

/// Points of a row; NaN or `None` where there is no value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PhasesOver<'a> {
    pub(crate) title: &'a str,
    /// Of the abscissas.
    pub(crate) label: &'a str,
    pub(crate) x: &'a [f64],
    pub(crate) phases: &'a [Option<Phase>],
    /// Half peak-to-peak of l.
    pub(crate) amplitude: &'a [f64],
    pub(crate) period: &'a [f64],
}

/// Values that span more than this ratio are drawn by their logarithm.
const WIDE: f64 = 30.0;

/// Two panels of dots. An SVG document.
pub(crate) fn phases_over(figure: &PhasesOver) -> String {
    let (amplitude, amplitude_label) = scaled(figure.amplitude, "amplitude of l (σ)");
    let (period, period_label) = scaled(figure.period, "period (Γ/k)");
    let (amplitudes, periods) = (clouds(figure, &amplitude), clouds(figure, &period));
    let panels = [
        panel(&amplitudes, (figure.label, &amplitude_label), figure.x),
        panel(&periods, (figure.label, &period_label), figure.x),
    ];
    sheet(figure.title, &panels)
}

/// Values as they are drawn, and what they are called then.
pub(super) fn scaled(values: &[f64], name: &str) -> (Vec<f64>, String) {
    let above_0 = values.iter().filter(|v| **v > 0.0);
    let (low, high) =
        above_0.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
    if high > WIDE * low {
        (values.iter().map(|v| v.log10()).collect(), format!("log₁₀ {name}"))
    } else {
        (values.to_vec(), name.to_owned())
    }
}

type Cloud = (Phase, Vec<f64>, Vec<f64>);

/// The points of each kind.
fn clouds(figure: &PhasesOver, values: &[f64]) -> Vec<Cloud> {
    let points = figure.phases.iter().zip(figure.x.iter().zip(values));
    let of = |kind: Phase| -> Cloud {
        let here = points.clone().filter(|(phase, (_, y))| **phase == Some(kind) && y.is_finite());
        let (x, y) = here.map(|(_, (x, y))| (*x, *y)).unzip();
        (kind, x, y)
    };
    Phase::ALL.into_iter().map(of).filter(|(_, x, _)| !x.is_empty()).collect()
}

fn panel<'a>(clouds: &'a [Cloud], labels: (&'a str, &'a str), x: &[f64]) -> Panel<'a> {
    let curve = |(kind, x, y): &'a Cloud| Curve {
        x,
        y,
        pen: Pen::small_dots(kind.colour(), 3.0),
        label: Some(kind.name().to_owned()),
    };
    let mut panel = Panel::fitted(labels, clouds.iter().map(curve).collect(), LOW, 1.0);
    // All that was asked for, and dots at the ends whole.
    let (low, high) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
    let air = 0.02 * (high - low);
    panel.x = Axis::new(low - air, high + air, 9.0);
    panel
}
