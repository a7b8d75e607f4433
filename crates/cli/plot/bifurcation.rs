//! The bifurcation diagram: branches of cycles over a parameter.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::phases_over::scaled;
use super::sheet::sheet;
use super::style::{BLACK, LOW, PALETTE};

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

/// Amplitude and period over the parameter, stable parts solid and unstable ones dashed. An SVG document.
pub(crate) fn bifurcations(figure: &BifurcationFigure) -> String {
    let (figure, period_label) = with_scaled_periods(figure);
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
            pen: if piece.stable[0] { Pen::numbered(*i) } else { Pen::numbered(*i).dashed() },
            label: label(&pieces, n),
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
        panel(|p| &p.amplitude, |m| &m.amplitude, "amplitude of x₀ (σ)", 1.3 * LOW),
        panel(|p| &p.period, |m| &m.period, &period_label, 1.3 * LOW),
    ];
    sheet(figure.title, &panels)
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

    fn drawn(periods: [f64; 3]) -> String {
        let branch = BranchCurve {
            parameter: vec![1.0, 1.5, 2.0],
            amplitude: vec![0.1, 1.0, 2.0],
            period: periods.to_vec(),
            stable: vec![true; 3],
        };
        let mark = SpecialMark { parameter: 1.0, amplitude: 0.0, period: periods[0], name: "Hopf" };
        let (title, label) = ("test", "alpha");
        bifurcations(&BifurcationFigure {
            title,
            label,
            branches: vec![branch],
            special: vec![mark],
        })
    }

    #[test]
    fn periods_that_span_much_are_drawn_by_their_logarithm() {
        assert!(!drawn([6.0, 8.0, 20.0]).contains("log₁₀ period"));
        assert!(drawn([6.0, 8.0, 300.0]).contains("log₁₀ period"));
    }
}
