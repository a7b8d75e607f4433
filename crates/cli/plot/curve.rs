//! A curve or a cloud of points, and how it is drawn.

use super::style::{BLACK, BLUE, PALETTE, VERMILLION};

/// Points, and how to draw them.
#[derive(Debug, Clone)]
pub(super) struct Curve<'a> {
    pub(super) x: &'a [f64],
    pub(super) y: &'a [f64],
    pub(super) pen: Pen,
    /// Its name in the legend, if any.
    pub(super) label: Option<String>,
}

/// How points are drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    pub(super) colour: &'static str,
    pub(super) mark: Mark,
}

/// A line of some width and dash pattern (SVG `stroke-dasharray`, empty: solid), or a mark for each point.
#[derive(Debug, Clone, Copy)]
pub(super) enum Mark {
    Line { width: f64, dashes: &'static str },
    Dots { radius: f64 },
    Triangles { radius: f64 },
}

impl Pen {
    /// What a panel is about.
    pub(super) const MAIN: Self = Self::line(BLUE, 1.6, "");
    /// A constant to compare with.
    pub(super) const REFERENCE: Self = Self::line(VERMILLION, 1.8, "9 5");
    /// What was there before.
    pub(super) const BEFORE: Self = Self::line(BLACK, 1.4, "2 4");

    /// One of many.
    pub(super) const POINTS: Self = Self { colour: BLACK, mark: Mark::Dots { radius: 1.3 } };

    const fn line(colour: &'static str, width: f64, dashes: &'static str) -> Self {
        Self { colour, mark: Mark::Line { width, dashes } }
    }

    /// Of what is too small to be told apart.
    pub(super) const fn thin(colour: &'static str) -> Self {
        Self::line(colour, 1.6, "")
    }

    pub(super) const fn small_dots(colour: &'static str, radius: f64) -> Self {
        Self { colour, mark: Mark::Dots { radius } }
    }

    pub(super) const fn dots(colour: &'static str) -> Self {
        Self::small_dots(colour, 5.0)
    }

    pub(super) const fn small_triangles(colour: &'static str, radius: f64) -> Self {
        Self { colour, mark: Mark::Triangles { radius } }
    }

    pub(super) const fn triangles(colour: &'static str) -> Self {
        Self::small_triangles(colour, 6.0)
    }

    /// The same, dashed if it draws a line.
    pub(super) const fn dashed(self) -> Self {
        match self.mark {
            Mark::Line { width, .. } => Self::line(self.colour, width, "6 4"),
            Mark::Dots { .. } | Mark::Triangles { .. } => self,
        }
    }

    /// The pen of curve number `index`: colours first, then the same colours dashed.
    pub(super) fn numbered(index: usize) -> Self {
        const DASHES: [&str; 3] = ["", "9 5", "3 3"];
        let dashes = DASHES[index / PALETTE.len() % DASHES.len()];
        Self::line(PALETTE[index % PALETTE.len()], 1.6, dashes)
    }
}
