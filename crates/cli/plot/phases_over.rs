//! Amplitude and period of what the motion comes to, over one parameter. Steady and trapped tips have neither: they
//! are marked at the foot of the panels.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::phases::Phase;
use super::sheet::sheet;
use super::style::{GREY, LOW};

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

/// What has no value is marked below all values by this part of their span.
const FOOT: f64 = 0.1;

/// Values that span more than this ratio are drawn by their logarithm.
pub(super) const WIDE: f64 = 30.0;

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

/// Points of one kind, those that have a value and those that have none.
struct Cloud {
    kind: Phase,
    has_values: bool,
    x: Vec<f64>,
    y: Vec<f64>,
}

/// The points of each kind.
fn clouds(figure: &PhasesOver, values: &[f64]) -> Vec<Cloud> {
    let foot = foot(values);
    let of = |(kind, has_values): (Phase, bool)| -> Cloud {
        let points = figure.phases.iter().zip(figure.x.iter().zip(values));
        let here = points
            .filter(|(phase, (_, y))| **phase == Some(kind) && y.is_finite() == has_values)
            .map(|(_, (x, y))| (*x, if has_values { *y } else { foot }));
        let (x, y) = here.unzip();
        Cloud { kind, has_values, x, y }
    };
    let all = Phase::ALL.into_iter().flat_map(|kind| [(kind, true), (kind, false)]);
    all.map(of).filter(|cloud| !cloud.x.is_empty()).collect()
}

/// Where that is drawn which has no value.
fn foot(values: &[f64]) -> f64 {
    let finite = values.iter().filter(|v| v.is_finite());
    let (low, high) = finite
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
    match high - low {
        span if span > 0.0 => low - FOOT * span,
        0.0 => low - FOOT * low.abs(),
        _ => 0.0,
    }
}

impl Cloud {
    /// Triangles where a tip that is not steady has no value: they differ in shape, not in colour alone.
    fn pen(&self) -> Pen {
        match (self.kind, self.has_values) {
            (Phase::Steady, _) => Pen::small_dots(GREY, 3.0),
            (kind, true) => Pen::small_dots(kind.colour(), 3.0),
            (kind, false) => Pen::small_triangles(kind.colour(), 4.5),
        }
    }

    fn name(&self) -> String {
        let name = self.kind.name();
        if self.has_values { name.to_owned() } else { format!("{name} (foot: no value)") }
    }
}

fn panel<'a>(clouds: &'a [Cloud], labels: (&'a str, &'a str), x: &[f64]) -> Panel<'a> {
    let curve = |cloud: &'a Cloud| Curve {
        x: &cloud.x,
        y: &cloud.y,
        pen: cloud.pen(),
        label: Some(cloud.name()),
    };
    let mut panel = Panel::fitted(labels, clouds.iter().map(curve).collect(), LOW, 1.0);
    if !clouds.iter().any(|cloud| cloud.has_values) {
        // The foot is 0, and no value is below it.
        panel.y = Axis::new(-FOOT, 1.0, LOW / 65.0);
    }
    // All that was asked for, and dots at the ends whole.
    let (low, high) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
    let air = 0.02 * (high - low);
    panel.x = Axis::new(low - air, high + air, 9.0);
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_value_is_below_all_that_have_one() {
        let phases = [Phase::Steady, Phase::OneSlip, Phase::OneSlip, Phase::Trapped].map(Some);
        let (x, values) = ([1.0, 2.0, 3.0, 4.0], [f64::NAN, 7.0, 9.0, f64::NAN]);
        let (title, label) = ("test", "alpha");
        let figure = PhasesOver {
            title,
            label,
            x: &x,
            phases: &phases,
            amplitude: &values,
            period: &values,
        };
        let clouds = clouds(&figure, &values);
        let found: Vec<(Phase, &[f64])> = clouds.iter().map(|c| (c.kind, &*c.y)).collect();
        let foot = 7.0 - 2.0 * FOOT;
        assert_eq!(
            found,
            [
                (Phase::Steady, &[foot][..]),
                (Phase::OneSlip, &[7.0, 9.0]),
                (Phase::Trapped, &[foot])
            ]
        );
        let picture = phases_over(&figure);
        for name in ["steady (foot: no value)", "one slip a period<", "trapped (foot: no value)"] {
            assert!(picture.contains(name), "{name}");
        }
    }

    #[test]
    fn a_row_without_any_value_is_drawn() {
        assert!(foot(&[f64::NAN]).abs() < 1e-300 && foot(&[2.0]) < 2.0 && foot(&[]).is_finite());
        let (kind, has_values, x, y) = (Phase::Steady, false, vec![1.0, 2.0], vec![0.0; 2]);
        let clouds = [Cloud { kind, has_values, x, y }];
        let panel = panel(&clouds, ("", ""), &[1.0, 2.0]);
        assert!(panel.y.low < 0.0 && panel.y.high > -5.0 * panel.y.low);
    }
}
