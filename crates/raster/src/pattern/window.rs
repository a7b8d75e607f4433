//! The evaluated part of an area: the largest rectangle of evenly spaced lines.

use super::doubt::Doubt;
use crate::area::pitch_of;
use crate::line::Line;
use crate::path::{AreaLine, Path};
use crate::plan::{Plan, WIDTHS};
use crate::surface::carved_depth;

/// Evaluated part of the length, without the pit at the beginning and without the end.
pub(super) const ALONG: (f64, f64) = (0.2, 0.85);
/// Evaluated fraction of the lines, from the last one backwards.
const LAST: f64 = 0.5;
/// Largest number of evaluated lines.
const MOST_ROWS: usize = 256;
/// Largest number of lines among which a window is sought.
const MOST_TRIED: usize = 2048;
/// Distance, in widths, within which later lines would still change a line.
const UNFINISHED: f64 = 3.5;
/// Smallest number of lines for a wave vector.
pub(super) const FEWEST_ROWS: usize = 8;
/// Smallest extent of a window for a wave vector, along and across the lines, in widths of the footprint.
const SHORTEST: f64 = 12.0;

/// Lines first..end, over a range of x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) first: usize,
    pub(super) end: usize,
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) pitch: f64,
}

impl Window {
    /// The window within the first `scanned` lines of a plan.
    ///
    /// # Errors
    /// No window is large enough for a wave vector.
    pub(super) fn of(plan: &Plan, scanned: usize) -> Result<Self, Doubt> {
        let width = 8.7 / plan.band();
        let across = plan.reach_across() / WIDTHS;
        let lines: Vec<AreaLine> = (0..scanned).map(|n| line(plan, n)).collect();
        let gaps = lines.windows(2).map(|pair| pair[1].y - pair[0].y).filter(|gap| *gap > 0.0);
        let closest = gaps.fold(f64::INFINITY, f64::min);
        if plan.path == Path::Repeat || !closest.is_finite() {
            return Err(Doubt::OneLine);
        }
        let unfinished = (UNFINISHED * across / closest).ceil() as usize;
        let fewest = ((SHORTEST * across / closest).ceil() as usize).max(FEWEST_ROWS);
        let few = Doubt::FewLines((fewest as f64 / LAST).ceil() as usize + unfinished);
        let last = scanned.checked_sub(unfinished).ok_or(few.clone())?;
        let begin = (last - (LAST * last as f64) as usize).max(last.saturating_sub(MOST_TRIED));
        let window = largest(&lines[begin..last]).ok_or(few.clone())?;
        let window = Self { first: window.first + begin, end: window.end + begin, ..window };
        if window.to - window.from <= SHORTEST * width {
            return Err(Doubt::ShortLines(SHORTEST * width / (ALONG.1 - ALONG.0) + 1.0));
        }
        let rows = window.end - window.first;
        let is_enough = rows >= FEWEST_ROWS && window.pitch * rows as f64 >= SHORTEST * across;
        if is_enough { Ok(window) } else { Err(few) }
    }

    /// The distance of this number of evenly spaced x, and these.
    pub(super) fn points(&self, count: usize) -> (f64, Vec<f64>) {
        let spacing = (self.to - self.from) / count as f64;
        (spacing, (0..count).map(|i| self.from + spacing * i as f64).collect())
    }

    /// Mean carved depth, and the fraction of the relief of the first half of the lines that remains after the second half
    /// was scanned.
    pub(super) fn depth_and_healing(&self, plan: &Plan, lines: &[Line]) -> (f64, f64) {
        let carved = carved_depth(plan, &lines[self.first..self.end], self.pitch);
        let left = plan.law.model.wider().left_after(plan.duration(self.first));
        (carved, left.powf(0.5 * (self.end - self.first) as f64))
    }
}

/// The evaluated part of line n.
fn line(plan: &Plan, n: usize) -> AreaLine {
    let track = plan.track(n);
    let ends = [ALONG.0, ALONG.1].map(|part| track.x(part * track.length));
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    AreaLine { y: track.y, start: low, length: high - low }
}

/// The largest window within evenly spaced lines; of equal ones the last.
fn largest(lines: &[AreaLine]) -> Option<Window> {
    let mut best: Option<(f64, Window)> = None;
    for end in 2..=lines.len() {
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        let gap = lines[end - 1].y - lines[end - 2].y;
        for first in (end.saturating_sub(MOST_ROWS)..end).rev() {
            let line = &lines[first];
            (from, to) = (from.max(line.start), to.min(line.start + line.length));
            let rows = end - first;
            if to <= from
                || (rows > 2
                    && pitch_of(&lines[first..first + 2])
                        .is_none_or(|p| (p - gap).abs() > 1e-6 * gap))
            {
                break;
            }
            let size = (to - from) * rows as f64;
            if rows > 1 && best.is_none_or(|(most, _)| size >= most) {
                best = Some((size, Window { first, end, from, to, pitch: gap }));
            }
        }
    }
    best.map(|(_, window)| window)
        .filter(|window| pitch_of(&lines[window.first..window.end]).is_some())
}
