//! A raster, line by line.

use crate::asked::Asked;
use crate::limits::MOST_LINES;
use crate::refusal::Refusal;
use serde::{Deserialize, Serialize};
use stickslip::{
    Indentation, MemoryName, PathName, PatternDocument, Raster, RasterRegimeName, Sampling, Tip,
};
use stickslip_raster::{Plan, Scanned, Scanning, pattern};

/// Error of each line. A picture needs less, but transforms round differently here and there, and a step that one takes and the
/// other repeats changes a pattern by a part of it: to 1e-9 no more than this.
pub(crate) const TOLERANCE: f64 = 1e-8;
/// Heights in a width of the tip along a line; two rows to a pitch.
const COLUMNS: f64 = 4.0;
const ROWS: usize = 2;
/// Distance in widths across within which a line changes rows: e^{-18} of its depth is left there.
const REACH: f64 = 6.0;
/// A tip that can leave its line stays within so many widths of it while a spring holds it, as far as a picture shows.
const AWAY: f64 = 4.0;

/// Lengths in σ.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Scan {
    pub(crate) pitch: f64,
    pub(crate) lines: usize,
    pub(crate) length: f64,
    pub(crate) path: PathName,
}

impl Scan {
    pub(crate) fn read(text: &str) -> Result<Self, Refusal> {
        serde_json::from_str(text).map_err(Refusal::Json)
    }

    pub(crate) fn path_option(&self) -> &'static str {
        match self.path {
            PathName::OneWay => "",
            PathName::Zigzag => " --path zigzag",
            PathName::Repeat => " --path repeat",
        }
    }
}

/// What the lines have written.
#[derive(Debug, Serialize)]
pub(crate) struct Written {
    regime: RasterRegimeName,
    pattern: Option<PatternDocument>,
    remarks: Vec<String>,
}

fn plan(asked: &Asked, scan: &Scan) -> Result<Plan, Refusal> {
    if scan.lines > MOST_LINES {
        return Err(Refusal::TooManyLines(scan.lines));
    }
    let question = Raster {
        tip: Tip(asked.tip()?),
        indentation: Indentation::given(asked.alpha),
        r: asked.r,
        law: asked.wider().into(),
        width_y: None,
        path: scan.path,
        pitch: (scan.path != PathName::Repeat).then_some(scan.pitch),
        lines: scan.lines,
        length: scan.length,
        area: None,
        pulses: vec![],
        tolerance: TOLERANCE,
        memory: MemoryName::Auto,
        stiffness_across: asked.stiffness_across,
        kick_across: asked.pushed_across(),
        sampling: Sampling::default(),
    };
    Ok(question.prepared()?)
}

/// Scans; hands over, after each line, its number from 1, the first row that it changed, the columns and the heights.
pub(crate) fn raster(
    asked: &Asked,
    scan: &Scan,
    mut on_line: impl FnMut(usize, usize, usize, &[f64]),
) -> Result<Written, Refusal> {
    let plan = plan(asked, scan)?;
    let mut scanning = Scanning::new(&plan)?;
    let view = View::new(asked, scan);
    while scanning.next_line()?.is_some() {
        let lines = scanning.lines();
        // Of these alone anything is to be seen in the rows that the last has changed.
        let near = &lines[lines.len().saturating_sub(view.lines_that_count())..];
        let (first, y) = view.rows(lines.len());
        let heights = Scanned::new(&plan, near).heights(&view.x, &y);
        on_line(lines.len(), first, view.x.len(), heights.as_slice().unwrap_or_default());
    }
    let found = pattern(&plan, scanning.lines());
    Ok(Written {
        regime: found.regime.into(),
        pattern: found.pattern.map(Into::into),
        remarks: found.doubts.iter().map(ToString::to_string).collect(),
    })
}

/// What is shown of the surface.
struct View {
    /// Of lines that coincide each gives one row: the groove after it.
    is_repeated: bool,
    x: Vec<f64>,
    row: f64,
    lines_within_reach: usize,
}

impl View {
    fn new(asked: &Asked, scan: &Scan) -> Self {
        let columns = (COLUMNS * scan.length / asked.width).ceil().clamp(2.0, 600.0);
        let x = (0..=columns as usize).map(|i| scan.length * i as f64 / columns).collect();
        let away = asked.stiffness_across.map_or(0.0, |_| AWAY);
        let within =
            ((REACH + away) * asked.width / scan.pitch).ceil().clamp(1.0, MOST_LINES as f64);
        let is_repeated = scan.path == PathName::Repeat;
        Self { is_repeated, x, row: scan.pitch / ROWS as f64, lines_within_reach: within as usize }
    }

    /// How many of the latest lines are to be seen in rows that the last has changed.
    fn lines_that_count(&self) -> usize {
        if self.is_repeated { MOST_LINES } else { 2 * self.lines_within_reach }
    }

    /// Those that a line, counted from 1, changes behind it: number of the first, and where they lie.
    fn rows(&self, line: usize) -> (usize, Vec<f64>) {
        if self.is_repeated {
            return (line - 1, vec![0.0]);
        }
        let end = ROWS * (line - 1) + 1;
        let first = end.saturating_sub(ROWS * self.lines_within_reach + 1);
        (first, (first..end).map(|n| self.row * n as f64).collect())
    }
}
