//! The bifurcation diagram: branches of cycles over a parameter.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::phases_over::{WIDE, scaled};
use super::sheet::sheet;
use super::style::{BLACK, GREY, LOW, PALETTE};

/// Branches and special points.
#[derive(Debug, Clone)]
pub(crate) struct BifurcationFigure<'a> {
    /// Above all panels.
    pub(crate) title: &'a str,
    /// Of the parameter.
    pub(crate) label: &'a str,
    pub(crate) branches: Vec<BranchCurve>,
    pub(crate) special: Vec<SpecialMark>,
}

/// Columns of equal length.
#[derive(Debug, Clone)]
pub(crate) struct BranchCurve {
    pub(crate) parameter: Vec<f64>,
    pub(crate) amplitude: Vec<f64>,
    pub(crate) period: Vec<f64>,
    pub(crate) stable: Vec<bool>,
}

/// A point with a name.
#[derive(Debug, Clone)]
pub(crate) struct SpecialMark {
    pub(crate) parameter: f64,
    pub(crate) amplitude: f64,
    pub(crate) period: f64,
    pub(crate) name: &'static str,
}

/// Marks, told apart from each other by shape and from the first branches by colour.
const MARKS: [Pen; 5] = [
    Pen::dots(BLACK),
    Pen::triangles(BLACK),
    Pen::dots(PALETTE[5]),
    Pen::triangles(PALETTE[5]),
    Pen::dots(PALETTE[4]),
];

/// A branch over less than this part of the abscissas shows as a dot, if at all, and has no name of its own.
const SHORT: f64 = 0.01;

/// Amplitude and period over the parameter, stable parts solid and unstable ones dashed. An SVG document.
pub(crate) fn bifurcations(figure: &BifurcationFigure) -> String {
    let (figure, period_label) = with_scaled_periods(figure);
    let (figure, amplitude_label) = with_scaled_amplitudes(&figure);
    let short = short_branches(&figure.branches);
    let short_name = match short.iter().filter(|short| **short).count() {
        1 => "a branch too short to see".to_owned(),
        n => format!("{n} branches too short to see"),
    };
    let first_short = short.iter().position(|short| *short);
    let pieces: Vec<(usize, BranchCurve)> = figure
        .branches
        .iter()
        .enumerate()
        .flat_map(|(i, branch)| pieces(branch).into_iter().map(move |piece| (i, piece)))
        .collect();
    let marks = Marks::of(&figure.special);
    let panel = |ordinate: fn(&BranchCurve) -> &[f64],
                 of_mark: fn(&MarksOfAName) -> &[f64],
                 name,
                 height| {
        let curves = pieces.iter().enumerate().map(|(n, (i, piece))| Curve {
            x: &piece.parameter,
            y: ordinate(piece),
            pen: match (short[*i], piece.stable[0]) {
                (true, _) => Pen::thin(GREY),
                (false, true) => Pen::numbered(*i),
                (false, false) => Pen::numbered(*i).dashed(),
            },
            label: match short[*i] {
                false => label(&pieces, n),
                true => {
                    let is_first = Some(*i) == first_short && (n == 0 || pieces[n - 1].0 != *i);
                    is_first.then(|| short_name.clone())
                }
            },
        });
        let marks = marks.0.iter().enumerate().map(|(n, mark)| Curve {
            x: &mark.parameter,
            y: of_mark(mark),
            pen: MARKS[n % MARKS.len()],
            label: Some(mark.name.to_owned()),
        });
        let fitted =
            Panel::fitted((figure.label, name), curves.chain(marks).collect(), height, 0.0);
        // Room for the marks at the ends of branches.
        let pad = 0.03 * (fitted.x.high - fitted.x.low);
        Panel { x: Axis::new(fitted.x.low - pad, fitted.x.high + pad, 9.0), ..fitted }
    };
    let panels = [
        panel(|p| &p.amplitude, |m| &m.amplitude, &amplitude_label, 1.3 * LOW),
        panel(|p| &p.period, |m| &m.period, &period_label, 1.3 * LOW),
    ];
    sheet(figure.title, &panels)
}

/// Of each branch, whether it is short beside the range of all of them; the first never is.
fn short_branches(branches: &[BranchCurve]) -> Vec<bool> {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
    };
    let (low, high) = range(&mut branches.iter().flat_map(|b| b.parameter.iter().copied()));
    let is_short = |(i, branch): (usize, &BranchCurve)| {
        let (from, to) = range(&mut branch.parameter.iter().copied());
        i > 0 && to - from < SHORT * (high - low)
    };
    branches.iter().enumerate().map(is_short).collect()
}

/// Amplitudes by their logarithm where they leave the size of the tip, σ, far behind, as towards trapping: towards
/// onset they go to 0 on any scale. 0, at onset itself, is then drawn as the smallest of the others.
fn with_scaled_amplitudes<'a>(figure: &BifurcationFigure<'a>) -> (BifurcationFigure<'a>, String) {
    let (mut figure, label) = (figure.clone(), "amplitude of x₀ (σ)");
    let of_branches = figure.branches.iter_mut().flat_map(|branch| branch.amplitude.iter_mut());
    let of_marks = figure.special.iter_mut().map(|mark| &mut mark.amplitude);
    let all: Vec<&mut f64> = of_branches.chain(of_marks).collect();
    let above_0 = all.iter().map(|a| **a).filter(|a| *a > 0.0);
    let (low, high) = above_0.fold((f64::INFINITY, 0.0_f64), |(l, h), a| (l.min(a), h.max(a)));
    if high <= WIDE * low.max(1.0) {
        return (figure, label.to_owned());
    }
    all.into_iter().for_each(|amplitude| *amplitude = amplitude.max(low).log10());
    (figure, format!("log₁₀ {label}"))
}

/// Periods by their logarithm where they span much, as towards trapping; and the label of their axis.
fn with_scaled_periods<'a>(figure: &BifurcationFigure<'a>) -> (BifurcationFigure<'a>, String) {
    let of_branches = figure.branches.iter().flat_map(|branch| branch.period.iter().copied());
    let all: Vec<f64> = of_branches.chain(figure.special.iter().map(|mark| mark.period)).collect();
    let (values, label) = scaled(&all, "period (Γ/k)");
    let (mut figure, mut values) = (figure.clone(), values.into_iter());
    let of_branches = figure.branches.iter_mut().flat_map(|branch| branch.period.iter_mut());
    let of_marks = figure.special.iter_mut().map(|mark| &mut mark.period);
    for (period, value) in of_branches.chain(of_marks).zip(&mut values) {
        *period = value;
    }
    (figure, label)
}

/// The name of piece n: that of its branch and stability, once.
fn label(pieces: &[(usize, BranchCurve)], n: usize) -> Option<String> {
    let (branch, piece) = &pieces[n];
    let same = |(i, p): &(usize, BranchCurve)| i == branch && p.stable[0] == piece.stable[0];
    if pieces[..n].iter().any(same) {
        return None;
    }
    let what = if piece.stable[0] { "stable" } else { "unstable" };
    Some(match branch {
        0 => format!("{what} cycles"),
        _ => format!("{what}, branch {branch}"),
    })
}

/// The branch cut where its stability changes; the pieces meet half-way.
fn pieces(branch: &BranchCurve) -> Vec<BranchCurve> {
    let mut pieces: Vec<BranchCurve> = vec![];
    for i in 0..branch.stable.len() {
        let here = (branch.parameter[i], branch.amplitude[i], branch.period[i]);
        let stable = branch.stable[i];
        match pieces.last_mut() {
            Some(piece) if piece.stable[0] == stable => piece.push(here, stable),
            last => {
                let mut piece = BranchCurve {
                    parameter: vec![],
                    amplitude: vec![],
                    period: vec![],
                    stable: vec![],
                };
                if let Some(before) = last {
                    let j = i - 1;
                    let middle = (
                        0.5 * (branch.parameter[j] + here.0),
                        0.5 * (branch.amplitude[j] + here.1),
                        0.5 * (branch.period[j] + here.2),
                    );
                    before.push(middle, !stable);
                    piece.push(middle, stable);
                }
                piece.push(here, stable);
                pieces.push(piece);
            }
        }
    }
    pieces
}

impl BranchCurve {
    fn push(&mut self, (parameter, amplitude, period): (f64, f64, f64), stable: bool) {
        self.parameter.push(parameter);
        self.amplitude.push(amplitude);
        self.period.push(period);
        self.stable.push(stable);
    }
}

struct MarksOfAName {
    name: &'static str,
    parameter: Vec<f64>,
    amplitude: Vec<f64>,
    period: Vec<f64>,
}

/// Special points by name.
struct Marks(Vec<MarksOfAName>);

impl Marks {
    fn of(special: &[SpecialMark]) -> Self {
        let mut marks: Vec<MarksOfAName> = vec![];
        for mark in special {
            let name = mark.name;
            let known = marks.iter().position(|m| m.name == name);
            let i = known.unwrap_or_else(|| {
                let (parameter, amplitude, period) = (vec![], vec![], vec![]);
                marks.push(MarksOfAName { name, parameter, amplitude, period });
                marks.len() - 1
            });
            marks[i].parameter.push(mark.parameter);
            marks[i].amplitude.push(mark.amplitude);
            marks[i].period.push(mark.period);
        }
        Self(marks)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch(parameter: [f64; 3], amplitude: [f64; 3], period: [f64; 3]) -> BranchCurve {
        BranchCurve {
            parameter: parameter.to_vec(),
            amplitude: amplitude.to_vec(),
            period: period.to_vec(),
            stable: vec![true; 3],
        }
    }

    fn figure(branches: Vec<BranchCurve>) -> BifurcationFigure<'static> {
        let period = branches[0].period[0];
        let special = vec![SpecialMark { parameter: 1.0, amplitude: 0.0, period, name: "Hopf" }];
        BifurcationFigure { title: "test", label: "alpha", branches, special }
    }

    fn drawn(amplitudes: [f64; 3], periods: [f64; 3]) -> String {
        bifurcations(&figure(vec![branch([1.0, 1.5, 2.0], amplitudes, periods)]))
    }

    #[test]
    fn periods_that_span_much_are_drawn_by_their_logarithm() {
        let amplitudes = [0.1, 1.0, 2.0];
        assert!(!drawn(amplitudes, [6.0, 8.0, 20.0]).contains("log₁₀ period"));
        assert!(drawn(amplitudes, [6.0, 8.0, 300.0]).contains("log₁₀ period"));
    }

    #[test]
    fn amplitudes_far_above_the_size_of_the_tip_are_drawn_by_their_logarithm() {
        let periods = [6.0, 8.0, 20.0];
        assert!(!drawn([0.001, 1.0, 20.0], periods).contains("log₁₀ amplitude"));
        assert!(drawn([0.001, 1.0, 200.0], periods).contains("log₁₀ amplitude"));
    }

    #[test]
    fn on_a_logarithmic_axis_onset_is_where_its_branch_begins() {
        let whole = figure(vec![branch([1.0, 1.5, 2.0], [0.01, 1.0, 200.0], [6.0, 8.0, 20.0])]);
        let (scaled, _) = with_scaled_amplitudes(&whole);
        assert!((scaled.special[0].amplitude + 2.0).abs() < 1e-12);
        assert!((scaled.branches[0].amplitude[1]).abs() < 1e-12);
    }

    #[test]
    fn branches_too_short_to_see_share_one_name() {
        let long = branch([1.0, 1.5, 2.0], [0.1, 1.0, 2.0], [6.0, 8.0, 20.0]);
        let short = branch([1.7, 1.701, 1.702], [1.0, 1.1, 1.2], [9.0, 9.1, 9.2]);
        let picture = bifurcations(&figure(vec![long.clone(), short.clone(), long, short]));
        assert!(picture.contains("2 branches too short to see"));
        assert!(picture.contains("stable, branch 2"));
        assert!(!picture.contains("branch 1<") && !picture.contains("branch 3<"));
    }
}
