//! The phase diagram: what the motion comes to, over two parameters.

use super::axis::Axis;
use super::curve::{Curve, Mark, Pen};
use super::panel::Panel;
use super::sheet::sheet;
use super::style::{BLACK, BLUE, MARGIN_RIGHT, PALETTE, TALL, VERMILLION, WIDTH};

/// Kinds of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Phase {
    Steady,
    OneSlip,
    TwoSlips,
    MoreSlips,
    Trapped,
    Unsettled,
}

impl Phase {
    pub(super) const ALL: [Self; 6] = [
        Self::Steady,
        Self::OneSlip,
        Self::TwoSlips,
        Self::MoreSlips,
        Self::Trapped,
        Self::Unsettled,
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::OneSlip => "one slip a period",
            Self::TwoSlips => "two",
            Self::MoreSlips => "more",
            Self::Trapped => "trapped",
            Self::Unsettled => "not settled",
        }
    }

    pub(super) fn colour(self) -> &'static str {
        match self {
            Self::Steady => "#D9D9D9",
            Self::OneSlip => BLUE,
            Self::TwoSlips => VERMILLION,
            Self::MoreSlips => PALETTE[4],
            Self::Trapped => BLACK,
            Self::Unsettled => PALETTE[3],
        }
    }
}

/// A grid of kinds of motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PhaseFigure<'a> {
    pub(crate) title: &'a str,
    /// Of abscissas and ordinates.
    pub(crate) labels: (&'a str, &'a str),
    /// First and last abscissa, and how many.
    pub(crate) x: (f64, f64, usize),
    pub(crate) y: (f64, f64, usize),
    /// By abscissa, then ordinate; `None` where nothing is known.
    pub(crate) phases: &'a [Option<Phase>],
}

/// Cells overlap by this many pixels, so that no gap shows between them.
const OVERLAP: f64 = 0.6;
/// About what axis and labels take on the left.
const LEFT: f64 = 80.0;

/// A column of cells for every abscissa, equal ones in one piece. An SVG document.
pub(crate) fn phases(figure: &PhaseFigure) -> String {
    let (x, y) = (Cells::of(figure.x), Cells::of(figure.y));
    let width = (WIDTH - LEFT - MARGIN_RIGHT) / figure.x.2 as f64 + OVERLAP;
    let mut pieces: Vec<(Phase, [f64; 2], [f64; 2])> = vec![];
    for (i, column) in figure.phases.chunks(figure.y.2).enumerate() {
        let mut from = 0;
        for piece in column.chunk_by(|a, b| a == b) {
            let ends = [y.edge(from), y.edge(from + piece.len())];
            pieces.extend(piece[0].map(|phase| (phase, [x.middle(i); 2], ends)));
            from += piece.len();
        }
    }
    // In the legend each kind once, as a dot.
    let present = Phase::ALL.into_iter().filter(|phase| pieces.iter().any(|p| p.0 == *phase));
    let names = present.map(|phase| Curve {
        x: &[],
        y: &[],
        pen: Pen::dots(phase.colour()),
        label: Some(phase.name().to_owned()),
    });
    let cells = pieces.iter().map(|(phase, x, y)| Curve {
        x,
        y,
        pen: Pen { colour: phase.colour(), mark: Mark::Line { width, dashes: "" } },
        label: None,
    });
    let panel = Panel {
        x: Axis::new(x.edge(0), x.edge(figure.x.2), 9.0),
        y: Axis::new(y.edge(0), y.edge(figure.y.2), 8.0),
        x_label: figure.labels.0,
        y_label: figure.labels.1,
        height: 1.15 * TALL,
        curves: names.chain(cells).collect(),
        shades: vec![],
        notes: vec![],
        heading: "",
        map: None,
    };
    sheet(figure.title, &[panel])
}

/// Cells of equal size about evenly spaced values.
struct Cells {
    low: f64,
    spacing: f64,
}

impl Cells {
    fn of((low, high, points): (f64, f64, usize)) -> Self {
        Self { low, spacing: (high - low) / (points - 1) as f64 }
    }

    fn middle(&self, i: usize) -> f64 {
        self.low + self.spacing * i as f64
    }

    /// Between cell i - 1 and cell i.
    fn edge(&self, i: usize) -> f64 {
        self.low + self.spacing * (i as f64 - 0.5)
    }
}
