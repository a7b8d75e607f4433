//! Scan of the lines one after the other; it can be stopped and resumed between any two.

use crate::error::RasterError;
use crate::grooves::Grooves;
use crate::line::Line;
use crate::path::{Path, Track};
use crate::plan::Plan;
use stickslip_tip::{InitialSurface, Running, Step, stop};

/// A raster in progress.
pub struct Scanning<'a> {
    plan: &'a Plan,
    grooves: Grooves,
    lines: Vec<Line>,
}

impl<'a> Scanning<'a> {
    /// The state before the first line.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn new(plan: &'a Plan) -> Result<Self, RasterError> {
        plan.validate()?;
        Ok(Self { plan, grooves: Grooves::new(plan), lines: vec![] })
    }

    /// The state after these lines of the same plan: all later lines are the same to the last bit as without the
    /// interruption.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn resumed(plan: &'a Plan, lines: Vec<Line>) -> Result<Self, RasterError> {
        let mut scanning = Self::new(plan)?;
        for n in 1..=lines.len() {
            scanning.grooves.add(&lines[..n]);
        }
        Ok(Self { lines, ..scanning })
    }

    /// The finished lines.
    #[must_use]
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The initial surface of the next line, in the frame of that line: the sum of all grooves within reach; flat
    /// after the last line.
    #[must_use]
    pub fn surface_ahead(&mut self) -> InitialSurface {
        if self.lines.len() >= self.plan.lines() {
            return InitialSurface::flat();
        }
        let track = self.plan.track(self.lines.len());
        let relief = self.grooves.relief(&track);
        relief.into_iter().fold(InitialSurface::flat(), InitialSurface::with)
    }

    /// Scans the next line; `None` after the last one, or if the work is told to [`stop`], in which case the
    /// unfinished line is lost.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn next_line(&mut self) -> Result<Option<&Line>, RasterError> {
        let n = self.lines.len();
        if n == self.plan.lines() {
            return Ok(None);
        }
        let track = self.plan.track(n);
        let surface = self.surface_ahead();
        let scenario = self.plan.line(n, self.begins(track));
        let failed = |error| RasterError::Line { line: n + 1, error };
        let mut running = Running::new(&scenario, &surface).map_err(failed)?;
        let mut steps: Vec<Step> = vec![];
        while let Some(step) = running.step().map_err(failed)? {
            steps.push(step);
            if stop::is_asked() {
                return Ok(None);
            }
        }
        let line = Line::new(track, &scenario.model, steps, running.work());
        drop(running);
        self.lines.push(line);
        self.grooves.add(&self.lines);
        Ok(self.lines.last())
    }

    /// Distance of the tip ahead of the support at the start of a line, and its velocity, in the frame of the line:
    /// on a zigzag the tip keeps its position when the support turns.
    fn begins(&self, track: Track) -> (f64, f64) {
        match self.lines.last().filter(|_| self.plan.path == Path::Zigzag) {
            Some(last) => (track.along(last.x0_at_end()), track.sign() * last.velocity_at_end()),
            None => (0.0, 0.0),
        }
    }

    /// The finished lines, by value.
    #[must_use]
    pub fn into_lines(self) -> Vec<Line> {
        self.lines
    }
}
