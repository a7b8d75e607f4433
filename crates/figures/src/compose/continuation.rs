//! The bifurcation diagram: branches of cycles over a parameter.

use super::axes::{ALPHA, R, WIDE};
use super::drawn::{Drawn, View};
use super::tip::law_name;
use crate::axis::extremes;
use crate::error::FigureError;
use crate::number::seven_digits;
use stickslip::{
    ColourName, ContinueDocument, CurveDocument, CycleBranch, FigureDocument, OverName,
    PanelDocument, ScaleName, SpecialKind, StyleName,
};

/// Branches that span less than this fraction of the axis have no name.
const SHORT: f64 = 0.01;

/// Colours of the branches, in order.
const COLOURS: [ColourName; 6] = [
    ColourName::Blue,
    ColourName::Vermillion,
    ColourName::Green,
    ColourName::Purple,
    ColourName::Orange,
    ColourName::Sky,
];

impl Drawn for ContinueDocument {
    /// Amplitude and period against the parameter, solid for stable cycles and dashed for unstable ones.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let lengths = |b: &CycleBranch| {
            [&b.alpha, &b.r, &b.period, &b.amplitude_x0].map(Vec::len) == [b.stable.len(); 4]
        };
        if !self.branches.iter().all(lengths) {
            return Err(FigureError::Damaged(
                "the columns of a branch have different lengths".into(),
            ));
        }
        let model = &self.parameters.model_parameters();
        let over_alpha = self.parameters.over == OverName::Alpha;
        let fixed = match over_alpha {
            true => format!("r = {}", seven_digits(model.r)),
            false => format!("α = {}", seven_digits(model.alpha)),
        };
        let title = format!("Cycles, {}, {fixed}", law_name(model));
        let branches = Branches::of(self, over_alpha);
        let label = if over_alpha { ALPHA } else { R };
        let amplitudes = branches.panel((label, "amplitude of x₀ (σ)"), |p| p.amplitude, false);
        let periods = branches.panel((label, "period (Γ/k)"), |p| p.period, true);
        let panels = vec![amplitudes, periods];
        Ok(FigureDocument::new("continue", &title, vec![model.clone()], panels))
    }
}

/// A point of a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    parameter: f64,
    amplitude: f64,
    period: f64,
}

/// A stretch of a branch with one stability.
struct Piece {
    branch: usize,
    stable: bool,
    points: Vec<Point>,
}

struct Branches {
    pieces: Vec<Piece>,
    short: Vec<bool>,
    /// Special points, by kind.
    special: Vec<(SpecialKind, Vec<Point>)>,
}

impl Branches {
    fn of(document: &ContinueDocument, over_alpha: bool) -> Self {
        let parameter = |alpha: f64, r: f64| if over_alpha { alpha } else { r };
        let special_points = |branch: Option<usize>| {
            let here =
                document.special.iter().filter(move |s| branch.is_none_or(|b| s.branch == b));
            here.map(move |s| {
                let (amplitude, period) = (s.amplitude_x0, s.period);
                (s.kind, Point { parameter: parameter(s.alpha, s.r), amplitude, period })
            })
        };
        let mut pieces = vec![];
        for (i, branch) in document.branches.iter().enumerate() {
            let points = points(branch, parameter);
            let joints: Vec<Point> = special_points(Some(i)).map(|(_, point)| point).collect();
            pieces.extend(cut(i, &points, &branch.stable, &joints));
        }
        let mut special: Vec<(SpecialKind, Vec<Point>)> = vec![];
        // A doubled branch ends where the mark of the doubling is already.
        for (kind, point) in special_points(None).filter(|s| s.0 != SpecialKind::PeriodHalving) {
            match special.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, points)) => points.push(point),
                None => special.push((kind, vec![point])),
            }
        }
        Self { short: short(&document.branches, parameter), pieces, special }
    }

    /// One quantity against the parameter.
    fn panel(
        &self,
        labels: (&str, &str),
        of: fn(&Point) -> f64,
        is_positive: bool,
    ) -> PanelDocument {
        let mut panel = PanelDocument::new("", labels);
        let all = || self.pieces.iter().flat_map(|piece| piece.points.iter().map(of));
        // Towards onset amplitudes go to 0 on any scale: the criterion is their ratio to the size of the tip, σ.
        let least = if is_positive { 0.0 } else { 1.0 };
        let low = all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min);
        let high = all().fold(0.0, f64::max);
        if high > WIDE * low.max(least) {
            panel.y_scale = ScaleName::Logarithmic;
        }
        // 0, at onset itself, is drawn where its branch begins.
        let floor = if panel.y_scale == ScaleName::Logarithmic { low } else { f64::NEG_INFINITY };
        let columns = |points: &[Point]| -> (Vec<f64>, Vec<f64>) {
            points.iter().map(|p| (p.parameter, of(p).max(floor))).unzip()
        };
        for (n, piece) in self.pieces.iter().enumerate() {
            let (x, y) = columns(&piece.points);
            let style = if piece.stable { StyleName::Line } else { StyleName::Dashed };
            let mut curve = CurveDocument::new(style, &self.name(n), &x, &y);
            let own = COLOURS[piece.branch % COLOURS.len()];
            curve.colour = Some(if self.short[piece.branch] { ColourName::Grey } else { own });
            curve.smooth = true;
            panel.curves.push(curve);
        }
        for (kind, points) in &self.special {
            let (x, y) = columns(points);
            panel.curves.push(CurveDocument::new(mark(*kind), name(*kind), &x, &y));
        }
        panel
    }

    /// The legend entry of piece n, branch and stability, on its first use only.
    fn name(&self, n: usize) -> String {
        let piece = &self.pieces[n];
        let (branch, is_short) = (piece.branch, self.short[piece.branch]);
        let same = |p: &Piece| match is_short {
            true => self.short[p.branch],
            false => p.branch == branch && p.stable == piece.stable,
        };
        if self.pieces[..n].iter().any(same) {
            return String::new();
        }
        let what = if piece.stable { "stable" } else { "unstable" };
        match (is_short, self.short.iter().filter(|short| **short).count(), branch) {
            (true, 1, _) => "a branch too short to see".into(),
            (true, many, _) => format!("{many} branches too short to see"),
            (false, _, 0) => format!("{what} cycles"),
            (false, ..) => format!("{what}, branch {branch}"),
        }
    }
}

fn points(branch: &CycleBranch, parameter: impl Fn(f64, f64) -> f64) -> Vec<Point> {
    let place = |i: usize| Point {
        parameter: parameter(branch.alpha[i], branch.r[i]),
        amplitude: branch.amplitude_x0[i],
        period: branch.period[i],
    };
    (0..branch.stable.len()).map(place).collect()
}

/// The branch, divided where its stability changes: at the special point between two cycles, or half-way.
fn cut(branch: usize, points: &[Point], stable: &[bool], joints: &[Point]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = vec![];
    for (i, (point, stable)) in points.iter().zip(stable).enumerate() {
        match pieces.last_mut() {
            Some(piece) if piece.stable == *stable => {
                // A fold at which stability does not change is a point of the curve all the same.
                piece.points.extend(between(&points[i - 1], point, joints));
                piece.points.push(*point);
            }
            last => {
                let mut points_here = vec![];
                if let Some(before) = last {
                    let joint = joint(&points[i - 1], point, joints);
                    before.points.push(joint);
                    points_here.push(joint);
                }
                points_here.push(*point);
                pieces.push(Piece { branch, stable: *stable, points: points_here });
            }
        }
    }
    pieces
}

/// The special point between two neighbours, recognised by a period and an amplitude between theirs.
fn between(a: &Point, b: &Point, joints: &[Point]) -> Option<Point> {
    let within = |a: f64, b: f64, v: f64| {
        let slack = 1e-9 * (a.abs() + b.abs()) + 0.05 * (b - a).abs();
        (a.min(b) - slack..=a.max(b) + slack).contains(&v)
    };
    let lies = |p: &&Point| {
        within(a.amplitude, b.amplitude, p.amplitude)
            && within(a.period, b.period, p.period)
            && **p != *a
            && **p != *b
    };
    let distance = |p: &Point| (p.parameter - 0.5 * (a.parameter + b.parameter)).abs();
    let near = |p: &&Point| distance(p) <= 2.0 * (a.parameter - b.parameter).abs() + 1e-3;
    joints
        .iter()
        .filter(lies)
        .filter(near)
        .min_by(|p, q| distance(p).total_cmp(&distance(q)))
        .copied()
}

fn joint(a: &Point, b: &Point, joints: &[Point]) -> Point {
    between(a, b, joints).unwrap_or(Point {
        parameter: 0.5 * (a.parameter + b.parameter),
        amplitude: 0.5 * (a.amplitude + b.amplitude),
        period: 0.5 * (a.period + b.period),
    })
}

/// For each branch, whether it is short relative to the common range; the first never is.
fn short(branches: &[CycleBranch], parameter: impl Fn(f64, f64) -> f64) -> Vec<bool> {
    let span = |branch: &CycleBranch| {
        extremes(branch.alpha.iter().zip(&branch.r).map(|(alpha, r)| parameter(*alpha, *r)))
    };
    let all = branches.iter().filter_map(span);
    let whole = all
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (low, high)| (a.min(low), b.max(high)));
    let is_short = |(i, branch): (usize, &CycleBranch)| {
        let (low, high) = span(branch).unwrap_or((0.0, 0.0));
        i > 0 && high - low < SHORT * (whole.1 - whole.0)
    };
    branches.iter().enumerate().map(is_short).collect()
}

/// The mark of a special point: an outline, so that the branches remain visible.
fn mark(kind: SpecialKind) -> StyleName {
    match kind {
        SpecialKind::Hopf => StyleName::OpenDots,
        SpecialKind::Fold => StyleName::OpenSquares,
        SpecialKind::PeriodDoubling | SpecialKind::PeriodHalving => StyleName::OpenTriangles,
        SpecialKind::BranchPoint | SpecialKind::Torus => StyleName::OpenDiamonds,
    }
}

fn name(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Hopf => "Hopf",
        SpecialKind::Fold => "fold",
        SpecialKind::PeriodDoubling => "period doubling",
        SpecialKind::PeriodHalving => "period halving",
        SpecialKind::BranchPoint => "branch point",
        SpecialKind::Torus => "torus",
    }
}
