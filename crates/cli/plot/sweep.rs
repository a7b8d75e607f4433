//! The figure of a sweep: a phase diagram, or amplitude and period over the one parameter that varies.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::sheet::sheet;
use super::style::{BLUE, LOW, TALL, VERMILLION};

/// What the tip settles into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SweepKind {
    Steady,
    StickSlip,
    /// Stick-slip with several slips in a period.
    SeveralSlips,
    /// A run did not settle.
    Unsettled,
    Trapped,
}

/// A point of a sweep.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SweepMark {
    pub(crate) beta: Option<f64>,
    pub(crate) r: f64,
    pub(crate) alpha: f64,
    pub(crate) kind: SweepKind,
    /// Half peak-to-peak of l; NaN where there is none.
    pub(crate) amplitude: f64,
    pub(crate) period: f64,
    pub(crate) critical_alpha: f64,
}

/// Kinds with their names and colours, in the order of the legend.
const KINDS: [(SweepKind, &str, &str); 5] = [
    (SweepKind::Steady, "steady", "#BBBBBB"),
    (SweepKind::StickSlip, "stick-slip", BLUE),
    (SweepKind::SeveralSlips, "several slips a period", "#E69F00"),
    (SweepKind::Unsettled, "not settled", "#CC79A7"),
    (SweepKind::Trapped, "trapped", VERMILLION),
];

/// An SVG document: α over r, a panel for each β; or amplitude and period over the parameter that varies.
pub(crate) fn sweep(marks: &[SweepMark]) -> String {
    let differ = |value: fn(&SweepMark) -> f64| {
        marks.windows(2).any(|pair| (value(&pair[0]) - value(&pair[1])).abs() > 0.0)
    };
    let above = |mark: &SweepMark| mark.alpha - mark.critical_alpha;
    let (beta, r, alpha) =
        (differ(|m| m.beta.unwrap_or(0.0)), differ(|m| m.r), differ(|m| m.alpha));
    match (beta, r, alpha) {
        (false, false, _) => over(marks, "α = ΓNa/(k²σ²)", |m| m.alpha),
        // αc(r) + D with a single D: α varies with r.
        (false, true, _) if !spread(marks, |m| m.r, above) => over(marks, "r = Γv₀/(kσ)", |m| m.r),
        (true, false, _) if !spread(marks, |m| m.beta.unwrap_or(0.0), above) => {
            over(marks, "β", |m| m.beta.unwrap_or(0.0))
        }
        _ => phase_diagram(marks),
    }
}

/// Whether points with the same x have several y.
fn spread(
    marks: &[SweepMark],
    x: impl Fn(&SweepMark) -> f64,
    y: impl Fn(&SweepMark) -> f64,
) -> bool {
    let same = |pair: &&[SweepMark]| (x(&pair[0]) - x(&pair[1])).abs() <= 0.0;
    let differ = |pair: &[SweepMark]| (y(&pair[0]) - y(&pair[1])).abs() > 0.0;
    marks.windows(2).filter(same).any(differ)
}

fn phase_diagram(marks: &[SweepMark]) -> String {
    let columns = groups(marks);
    let height = if columns.len() > 1 { LOW + 100.0 } else { TALL };
    let labels: Vec<String> = columns
        .iter()
        .map(|group| group.beta.map_or(String::new(), |beta| format!(", β = {beta}")))
        .map(|beta| format!("α = ΓNa/(k²σ²){beta}"))
        .collect();
    let panel = |(group, label): (&Group<'_>, &String)| -> (Vec<Points>, String, f64) {
        let points = KINDS.iter().map(|kind| points(group.marks, kind.0, |m| (m.r, m.alpha)));
        (points.collect(), label.clone(), height)
    };
    let panels: Vec<_> = columns.iter().zip(&labels).map(panel).collect();
    let drawn: Vec<Panel> = panels
        .iter()
        .map(|(points, label, height)| panel_of(points, ("r = Γv₀/(kσ)", label), *height))
        .collect();
    sheet("What the tip settles into", &drawn)
}

fn over(marks: &[SweepMark], label: &str, x: fn(&SweepMark) -> f64) -> String {
    let (amplitude, amplitude_label) = scaled(marks, |m| m.amplitude, "amplitude of l (σ)");
    let (period, period_label) = scaled(marks, |m| m.period, "period (Γ/k)");
    let of = |y: &dyn Fn(&SweepMark) -> f64| -> Vec<Points> {
        KINDS.iter().map(|kind| points(marks, kind.0, |m| (x(m), y(m)))).collect()
    };
    let (amplitudes, periods) = (of(&amplitude), of(&period));
    let panels = [
        panel_of(&amplitudes, (label, &amplitude_label), LOW),
        panel_of(&periods, (label, &period_label), LOW),
    ];
    sheet("What the tip settles into", &panels)
}

/// Values that span more than this ratio are drawn by their logarithm.
const WIDE: f64 = 30.0;

/// A value as it is drawn, and what it is called then.
fn scaled(
    marks: &[SweepMark],
    value: fn(&SweepMark) -> f64,
    name: &str,
) -> (impl Fn(&SweepMark) -> f64 + use<>, String) {
    let values = marks.iter().map(value).filter(|v| *v > 0.0);
    let (low, high) =
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    let wide = high > WIDE * low;
    let label = if wide { format!("log₁₀ {name}") } else { name.to_owned() };
    (move |mark: &SweepMark| if wide { value(mark).log10() } else { value(mark) }, label)
}

fn panel_of<'a>(points: &'a [Points], labels: (&'a str, &'a str), height: f64) -> Panel<'a> {
    let mut panel = Panel::fitted(labels, clouds(points, KINDS.iter()), height, 1.0);
    // Dots at the ends are to be seen whole.
    let air = 0.02 * (panel.x.high - panel.x.low);
    panel.x = Axis::new(panel.x.low - air, panel.x.high + air, 9.0);
    panel
}

type Points = (Vec<f64>, Vec<f64>);

/// Points of a kind.
fn points(marks: &[SweepMark], kind: SweepKind, at: impl Fn(&SweepMark) -> (f64, f64)) -> Points {
    marks.iter().filter(|m| m.kind == kind).map(at).filter(|(_, y)| y.is_finite()).unzip()
}

/// A cloud for each kind that there is.
fn clouds<'a>(
    points: &'a [Points],
    kinds: impl Iterator<Item = &'a (SweepKind, &'static str, &'static str)>,
) -> Vec<Curve<'a>> {
    let there = points.iter().zip(kinds).filter(|((x, _), _)| !x.is_empty());
    let most = points.iter().map(|(x, _)| x.len()).sum::<usize>().max(1) as f64;
    // Dots of a map of n by n fill it without covering each other.
    let radius = (300.0 / most.sqrt()).clamp(1.5, 5.0);
    there
        .map(|((x, y), (_, name, colour))| Curve {
            x,
            y,
            pen: Pen::small_dots(colour, radius),
            label: Some((*name).to_owned()),
        })
        .collect()
}

/// Points of one footprint.
struct Group<'a> {
    beta: Option<f64>,
    marks: &'a [SweepMark],
}

fn groups(marks: &[SweepMark]) -> Vec<Group<'_>> {
    marks
        .chunk_by(|a, b| a.beta == b.beta)
        .map(|marks| Group { beta: marks.first().and_then(|m| m.beta), marks })
        .collect()
}
