//! Scan of the lines one after the other; it can be stopped and resumed between any two lines.

use crate::course::{Course, Rows};
use crate::error::RasterError;
use crate::free::Free;
use crate::grooves::Grooves;
use crate::line::Line;
use crate::path::{Path, Track};
use crate::plan::Plan;
use stickslip_tip::planar::{self, EarlierGrooves, PlanarError, PlanarRunning, PlanarScenario};
use stickslip_tip::{InitialSurface, Running, Step, Work, stop, threads};

/// A raster in progress.
pub struct Scanning<'a> {
    plan: &'a Plan,
    past: Past<'a>,
    lines: Vec<Line>,
}

/// The grooves of earlier lines.
enum Past<'a> {
    /// As power series, for a tip that is held on its lines.
    Traces(Course<'a>, Rows),
    /// As transforms of whole lines, for other tips and for footprints with many layers.
    Grooves(Box<Grooves>),
}

impl<'a> Scanning<'a> {
    /// The state before the first line.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn new(plan: &'a Plan) -> Result<Self, RasterError> {
        plan.validate()?;
        let course = if plan.free.is_none() { Course::new(plan) } else { None };
        let past = match course {
            Some(course) => Past::Traces(course, Rows::default()),
            None => Past::Grooves(Box::new(Grooves::new(plan))),
        };
        Ok(Self { plan, past, lines: vec![] })
    }

    /// The state after these lines of the same plan: all later lines are the same to the last bit as without the
    /// interruption.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn resumed(plan: &'a Plan, lines: Vec<Line>) -> Result<Self, RasterError> {
        let mut scanning = Self::new(plan)?;
        for (n, line) in lines.iter().enumerate() {
            match &mut scanning.past {
                Past::Traces(course, rows) => course.put(n, line, rows),
                Past::Grooves(grooves) => grooves.add(&lines[..=n]),
            }
        }
        Ok(Self { lines, ..scanning })
    }

    /// The finished lines.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// Scans the next line; `None` after the last one, or if the work is [cancelled](stop), in which case the
    /// unfinished line is lost.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn next_line(&mut self) -> Result<Option<&Line>, RasterError> {
        let n = self.lines.len();
        if n == self.plan.lines() {
            return Ok(None);
        }
        let begins = self.begins(self.plan.track(n));
        let line = match (&mut self.past, &self.plan.free) {
            (Past::Traces(course, rows), _) => course.line(n, rows, begins)?,
            (Past::Grooves(grooves), None) => held_line(self.plan, (n, begins), grooves)?,
            (Past::Grooves(grooves), Some(free)) => {
                free_line((self.plan, free), (begins, &self.lines), grooves)?
            }
        };
        let Some(line) = line else { return Ok(None) };
        self.lines.push(line);
        if let Past::Grooves(grooves) = &mut self.past {
            grooves.add(&self.lines);
        }
        Ok(self.lines.last())
    }

    /// Scans all remaining lines with this number of threads (0: one per core), and passes them to `take` in their
    /// order, until `take` returns false or the work is [cancelled](stop). Any of the threads calls `take`, one at a
    /// time. The number of threads does not affect the lines.
    ///
    /// Lines of a zigzag are scanned one after the other, because the tip begins a line where it has ended the one
    /// before. So are lines of a tip that is free to move across them, and of footprints with many layers.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn scan(
        &mut self,
        threads: usize,
        mut take: impl FnMut(&Line) -> bool + Send,
    ) -> Result<(), RasterError> {
        self.scan_with(threads, |_, _| (), |line, ()| take(line))
    }

    /// As [`scan`](Self::scan), but on the thread that has scanned a line, `of_line` is called with its number, from 0,
    /// and the line; `take` receives the result.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn scan_with<T: Send>(
        &mut self,
        threads: usize,
        of_line: impl Fn(usize, &Line) -> T + Sync,
        mut take: impl FnMut(&Line, T) -> bool + Send,
    ) -> Result<(), RasterError> {
        let threads = threads::count(threads);
        let Self { plan, past, lines } = self;
        if let (Past::Traces(course, rows), true) = (past, plan.path != Path::Zigzag && threads > 1)
        {
            let begin = (lines.len(), rows.clone());
            return course.each_line(begin, threads, of_line, |(line, made, after)| {
                *rows = after;
                let goes_on = take(&line, made);
                lines.push(line);
                goes_on
            });
        }
        let mut n = lines.len();
        while let Some(line) = self.next_line()? {
            let made = of_line(n, line);
            if !take(line, made) {
                break;
            }
            n += 1;
        }
        Ok(())
    }

    /// Distance of the tip ahead of the support at the start of a line, and its velocity, in the frame of the line. On a
    /// zigzag the tip keeps its position when the support turns.
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

/// Line n of a tip that is held on it, from its beginning; `None` if the work is cancelled.
fn held_line(
    plan: &Plan,
    (n, begins): (usize, (f64, f64)),
    grooves: &mut Grooves,
) -> Result<Option<Line>, RasterError> {
    let track = plan.track(n);
    // The sum of all grooves within reach.
    let relief = grooves.relief(&track);
    let surface = relief.into_iter().fold(InitialSurface::flat(), InitialSurface::with);
    let scenario = plan.line(n, begins);
    let failed = |error| RasterError::Line { line: n + 1, error };
    let mut running = Running::new(&scenario, &surface).map_err(failed)?;
    let mut steps: Vec<Step> = vec![];
    while let Some(step) = running.step().map_err(failed)? {
        steps.push(step);
        if stop::is_requested() {
            return Ok(None);
        }
    }
    Ok(Some(Line::new(track, &scenario.model, steps, running.work())))
}

/// The line after these of a tip that is free to move across, from its beginning; `None` if the work is cancelled.
fn free_line(
    (plan, free): (&Plan, &Free),
    (begins, lines): ((f64, f64), &[Line]),
    grooves: &mut Grooves,
) -> Result<Option<Line>, RasterError> {
    let n = lines.len();
    let track = plan.track(n);
    let off = match lines.last() {
        None => free.kick,
        Some(last) if plan.path == Path::Zigzag => last.y0_at_end() - track.y,
        Some(_) => 0.0,
    };
    let scenario = free.scenario(&plan.footprint, plan.line(n, begins), (n, off));
    loop {
        let earlier = grooves.around(&track);
        match run(&scenario, earlier.as_ref()) {
            Ok(Some((steps, work))) => {
                let model = &scenario.along.model;
                return Ok(Some(Line::free(track, model, &steps, work)));
            }
            Ok(None) => return Ok(None),
            // The surface farther away from the line is needed too.
            Err(PlanarError::BeyondGrooves { .. }) => grooves.widen_across(lines),
            Err(error) => return Err(RasterError::of_free(n, error)),
        }
    }
}

/// The steps of a line over these grooves; `None` if the work is cancelled.
fn run(
    scenario: &PlanarScenario,
    earlier: Option<&EarlierGrooves>,
) -> Result<Option<(Vec<planar::Step>, Work)>, PlanarError> {
    let mut running = match earlier {
        None => PlanarRunning::new(scenario)?,
        Some(earlier) => PlanarRunning::over(scenario, earlier)?,
    };
    let mut steps = vec![];
    while let Some(step) = running.step()? {
        steps.push(step);
        if stop::is_requested() {
            return Ok(None);
        }
    }
    Ok(Some((steps, running.work())))
}
