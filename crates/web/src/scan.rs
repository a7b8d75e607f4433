//! A raster, line by line.

use crate::limits::MOST_LINES;
use crate::parameters::Parameters;
use crate::refusal::Refusal;
use serde::{Deserialize, Serialize};
use stickslip::{
    Indentation, MemoryChoice, PathName, Pattern, Raster, RasterRegimeName, Sampling, Tip,
};
use stickslip_raster::{Plan, Scanned, Scanning, pattern};

/// Tolerance of each line. A picture needs less. But transforms round differently in the browser: a step that is accepted here
/// and repeated there changes the pattern by a part of the tolerance. With 1e-8 the patterns agree to 1e-9.
pub(crate) const TOLERANCE: f64 = 1e-8;
/// Heights per tip width along a line, and rows per pitch.
const COLUMNS: f64 = 4.0;
const ROWS: usize = 2;
/// Distance across, in tip widths, beyond which a line changes no rows: its depth is below e^{-18} there.
const REACH: f64 = 6.0;
/// Largest distance from its line, in tip widths, of a tip with a spring across the scan, to the accuracy of a picture.
const AWAY: f64 = 4.0;

/// The raster to scan. Lengths in σ.
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

/// The pattern of the lines.
#[derive(Debug, Serialize)]
pub(crate) struct Found {
    regime: RasterRegimeName,
    pattern: Option<Pattern>,
    remarks: Vec<String>,
}

fn plan(parameters: &Parameters, scan: &Scan) -> Result<Plan, Refusal> {
    if scan.lines > MOST_LINES {
        return Err(Refusal::TooManyLines(scan.lines));
    }
    let question = Raster {
        tip: Tip(parameters.tip()?),
        indentation: Indentation::given(parameters.alpha),
        r: parameters.r,
        law: parameters.wider().into(),
        width_y: None,
        path: scan.path,
        pitch: (scan.path != PathName::Repeat).then_some(scan.pitch),
        lines: scan.lines,
        length: scan.length,
        area: None,
        pulses: vec![],
        tolerance: TOLERANCE,
        memory: MemoryChoice::Auto,
        stiffness_across: parameters.stiffness_across,
        kick_across: parameters.pushed_across(),
        sampling: Sampling::default(),
    };
    Ok(question.plan()?)
}

/// Scans, and calls `on_line` after each line with its number from 1, the first row that it changed, the columns and the heights.
pub(crate) fn raster(
    parameters: &Parameters,
    scan: &Scan,
    mut on_line: impl FnMut(usize, usize, usize, &[f64]),
) -> Result<Found, Refusal> {
    let plan = plan(parameters, scan)?;
    let mut scanning = Scanning::new(&plan)?;
    let view = View::new(parameters, scan);
    while scanning.next_line()?.is_some() {
        let lines = scanning.lines();
        // Only these lines contribute to the rows that the last line has changed.
        let near = &lines[lines.len().saturating_sub(view.lines_that_count())..];
        let (first, y) = view.rows(lines.len());
        let heights = Scanned::new(&plan, near).heights(&view.x, &y);
        on_line(lines.len(), first, view.x.len(), heights.as_slice().unwrap_or_default());
    }
    let found = pattern(&plan, scanning.lines());
    Ok(Found {
        regime: found.regime.into(),
        pattern: found.pattern.map(Into::into),
        remarks: found.doubts.iter().map(ToString::to_string).collect(),
    })
}

/// The points of the surface that are shown.
struct View {
    /// Whether all lines coincide; each then has one row, the groove after the line.
    is_repeated: bool,
    x: Vec<f64>,
    row: f64,
    lines_within_reach: usize,
}

impl View {
    fn new(parameters: &Parameters, scan: &Scan) -> Self {
        let columns = (COLUMNS * scan.length / parameters.width).ceil().clamp(2.0, 600.0);
        let x = (0..=columns as usize).map(|i| scan.length * i as f64 / columns).collect();
        let away = parameters.stiffness_across.map_or(0.0, |_| AWAY);
        let within =
            ((REACH + away) * parameters.width / scan.pitch).ceil().clamp(1.0, MOST_LINES as f64);
        let is_repeated = scan.path == PathName::Repeat;
        Self { is_repeated, x, row: scan.pitch / ROWS as f64, lines_within_reach: within as usize }
    }

    /// Number of latest lines that contribute to the rows that the last line has changed.
    fn lines_that_count(&self) -> usize {
        if self.is_repeated { MOST_LINES } else { 2 * self.lines_within_reach }
    }

    /// The rows that a line (counted from 1) changes: number of the first, and their y.
    fn rows(&self, line: usize) -> (usize, Vec<f64>) {
        if self.is_repeated {
            return (line - 1, vec![0.0]);
        }
        let end = ROWS * (line - 1) + 1;
        let first = end.saturating_sub(ROWS * self.lines_within_reach + 1);
        (first, (first..end).map(|n| self.row * n as f64).collect())
    }
}
