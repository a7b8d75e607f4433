//! Lines of a tip that is held on them, one after the other or several at a time.
//!
//! Earlier lines affect a line only locally: it may begin when the line before it is a few reaches of the footprint ahead.
//! Its motion depends on the traces of earlier lines, and not on the time at which they become known. If a tip returns to
//! a place that the next line has already passed, that line and all later ones begin anew.

use crate::earlier::{Earlier, Expanders};
use crate::error::RasterError;
use crate::grooves::{ahead, same};
use crate::line::Line;
use crate::plan::Plan;
use crate::trace::{Trace, Ways, Writer};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use stickslip_tip::threads::side_by_side;
use stickslip_tip::{InitialSurface, Layer, Relief, Running, Step, Support, stop};

/// The trace of all lines at one y.
#[derive(Clone)]
struct Row {
    y: f64,
    /// The fraction of the trace that has not yet healed.
    left: f64,
    trace: Arc<Trace>,
}

/// The rows within reach of later lines, in the order of their last lines.
#[derive(Clone, Default)]
pub(crate) struct Rows(Arc<Vec<Row>>);

/// The scan of all lines of a plan.
pub(crate) struct Course<'a> {
    plan: &'a Plan,
    expanders: Arc<Expanders>,
    /// Range of y of the remaining lines after each line.
    ahead: Vec<(f64, f64)>,
    /// The largest number of steps of a line so far, for which the next one has room at once: a list that grows step by
    /// step makes threads wait for memory.
    most_steps: AtomicUsize,
}

struct Job {
    n: usize,
    /// The rows before this line.
    rows: Rows,
    /// The rows after it.
    after: Rows,
    given_up: Arc<AtomicBool>,
}

/// A line, the result of `of_line` for it, and the rows after it.
type Made<T> = (Line, T, Rows);
type Take<'a, T> = Box<dyn FnMut(Made<T>) -> bool + Send + 'a>;

struct Shared<'a, T> {
    /// The next line to begin, and the rows before it.
    next: usize,
    rows: Rows,
    /// Lines under way, each with the flag that gives it up.
    under_way: Vec<(usize, Arc<AtomicBool>)>,
    /// Finished lines that wait for those before them.
    finished: Vec<(usize, Result<Made<T>, RasterError>)>,
    /// A line whose tip has returned: no later line begins before it ends.
    returned: Option<usize>,
    /// The first line that has not been passed to `take`.
    out: usize,
    /// `None` while a thread calls it.
    take: Option<Take<'a, T>>,
    /// Number of threads that wait.
    waiting: usize,
    ended: Option<Result<(), RasterError>>,
}

/// What a thread does next.
enum Turn<'a, T> {
    Scan(Job),
    Take(Take<'a, T>, Result<Made<T>, RasterError>),
}

/// Number of finished lines per thread that may wait for those before them.
const WAITING: usize = 16;
/// Longest time until waiting threads notice that the work is cancelled.
const PATIENCE: Duration = Duration::from_millis(20);

impl<'a> Course<'a> {
    /// `None` for footprints for which transforms of whole lines cost less.
    pub(crate) fn new(plan: &'a Plan) -> Option<Self> {
        let most_steps = AtomicUsize::new(0);
        Some(Self { plan, expanders: Expanders::new(plan)?, ahead: ahead(plan), most_steps })
    }

    /// Scans line n after these rows. The tip begins at this distance ahead of the support, with this velocity. `None` if
    /// the work is cancelled.
    pub(crate) fn line(
        &self,
        n: usize,
        rows: &mut Rows,
        begins: (f64, f64),
    ) -> Result<Option<Line>, RasterError> {
        let job = self.job(n, rows);
        let Some((line, writer)) = self.run(&job, begins, |_, _| {})? else { return Ok(None) };
        writer.finish();
        *rows = job.after;
        Ok(Some(line))
    }

    /// Adds a finished line to the rows.
    pub(crate) fn put(&self, n: usize, line: &Line, rows: &mut Rows) {
        let job = self.job(n, rows);
        let mut writer = self.writer(&job);
        for step in line.trajectory().steps() {
            writer.add(step);
        }
        writer.finish();
        *rows = job.after;
    }

    fn job(&self, n: usize, rows: &Rows) -> Job {
        let after = self.after(n, rows);
        Job { n, rows: rows.clone(), after, given_up: Arc::default() }
    }

    /// Scans one-way or repeated lines from `out` on with this number of threads. Each is passed to `take` in its order,
    /// with the result of `of_line` and the rows after it, until `take` returns false or the work is cancelled. Any thread
    /// takes lines between those that it scans: one for that alone would displace others.
    pub(crate) fn each_line<T: Send>(
        &self,
        (out, rows): (usize, Rows),
        threads: usize,
        of_line: impl Fn(usize, &Line) -> T + Sync,
        take: impl FnMut(Made<T>) -> bool + Send,
    ) -> Result<(), RasterError> {
        let shared = Shared {
            next: out,
            rows,
            under_way: vec![],
            finished: vec![],
            returned: None,
            out,
            take: Some(Box::new(take)),
            waiting: 0,
            ended: None,
        };
        let most = WAITING * threads;
        let (shared, news) = (Mutex::new(shared), Condvar::new());
        let flag = stop::flag().unwrap_or_default();
        let work = || {
            let course = (&shared, &news);
            let _on_panic = OnPanic(course);
            stop::with_flag(&flag, || self.work(course, most, &of_line));
        };
        side_by_side(threads, work);
        let shared = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
        shared.ended.unwrap_or(Ok(()))
    }

    /// The work of one thread: it scans lines and passes them on until there are no more.
    fn work<'t, T>(
        &self,
        course: (&Mutex<Shared<'t, T>>, &Condvar),
        most: usize,
        of_line: &impl Fn(usize, &Line) -> T,
    ) {
        while let Some(turn) = self.turn(course, most) {
            match turn {
                Turn::Scan(job) => {
                    let Some(made) = self.make(&job, course.0).transpose() else { continue };
                    let made = made.map(|(line, rows)| {
                        let of_line = of_line(job.n, &line);
                        (line, of_line, rows)
                    });
                    change(course, |now| now.finish(&job, made));
                }
                Turn::Take(mut take, made) => {
                    let goes_on = made.map(&mut take);
                    change(course, |now| {
                        now.take = Some(take);
                        match goes_on {
                            Ok(true) => {}
                            ended => now.end(ended.map(|_| ())),
                        }
                    });
                }
            }
        }
    }

    /// What a thread does next; `None` if nothing is left for it. At most `most` lines wait for those before them.
    fn turn<'t, T>(
        &self,
        (shared, news): (&Mutex<Shared<'t, T>>, &Condvar),
        most: usize,
    ) -> Option<Turn<'t, T>> {
        let mut now = lock(shared);
        while !now.is_over() {
            if let Some(take) = now.next_finished() {
                return Some(take);
            }
            if now.next >= self.plan.lines() {
                return None;
            }
            if now.returned.is_none() && now.next < now.out + most {
                let job = self.job(now.next, &now.rows);
                (now.next, now.rows) = (job.n + 1, job.after.clone());
                now.under_way.push((job.n, Arc::clone(&job.given_up)));
                return Some(Turn::Scan(job));
            }
            now.waiting += 1;
            now = news.wait_timeout(now, PATIENCE).unwrap_or_else(PoisonError::into_inner).0;
            now.waiting -= 1;
        }
        None
    }

    /// Scans a line, and returns it with the rows after it; `None` if it is given up.
    fn make<T>(
        &self,
        job: &Job,
        shared: &Mutex<Shared<T>>,
    ) -> Result<Option<(Line, Rows)>, RasterError> {
        let mut has_returned = false;
        let made = self.run(job, (0.0, 0.0), |writer, is_ahead| {
            if !is_ahead && !has_returned {
                has_returned = true;
                lock(shared).returns(job);
            } else if !has_returned {
                writer.publish();
            }
        });
        Ok(made?.map(|(line, writer)| {
            if has_returned {
                let after = self.after(job.n, &job.rows);
                writer.finish_anew(after.newest());
                return (line, after);
            }
            writer.finish();
            (line, job.after.clone())
        }))
    }

    fn writer(&self, job: &Job) -> Writer {
        let (n, plan) = (job.n, self.plan);
        let (track, wider) = (plan.track(n), *plan.law.model.wider());
        let (support, duration) = (Support::Moving(plan.law.model.r()), plan.duration(n));
        let left = wider.left_after(duration);
        let before = job.rows.0.iter().find(|row| same(row.y, track.y));
        let before = before.map(|row| (Arc::clone(&row.trace), left * row.left));
        let ways = Ways { track, support, wider, duration, before };
        let given_up = Arc::clone(&job.given_up);
        Writer::new(ways, job.after.newest(), self.expanders.spacing(), given_up)
    }

    /// The rows after line n, without those that are out of reach of all later lines.
    fn after(&self, n: usize, rows: &Rows) -> Rows {
        let y = self.plan.track(n).y;
        let healed = self.plan.law.model.wider().left_after(self.plan.duration(n));
        let earlier = rows.0.iter().filter(|row| !same(row.y, y));
        let mut after = Vec::with_capacity(rows.0.len() + 1);
        after.extend(earlier.map(|row| Row { left: healed * row.left, ..row.clone() }));
        if let Some((low, high)) = self.ahead.get(n + 1) {
            let reach = self.plan.reach_across();
            after.retain(|row| row.y >= low - reach && row.y <= high + reach);
        }
        after.push(Row { y, left: 1.0, trace: Arc::default() });
        Rows(Arc::new(after))
    }

    fn surface_of(&self, job: &Job) -> InitialSurface {
        let (track, reach) = (self.plan.track(job.n), self.plan.reach_across());
        let alpha = self.plan.law.model.alpha();
        let layers = self.plan.footprint.layers();
        let mut traces = Vec::with_capacity(job.rows.0.len());
        let mut factors = Vec::with_capacity(job.rows.0.len() * layers.len());
        for row in job.rows.0.iter().filter(|row| (row.y - track.y).abs() <= reach) {
            traces.push(Arc::clone(&row.trace));
            let of = |layer: &Layer| -alpha * row.left * layer.across.value(track.y - row.y);
            factors.extend(layers.iter().map(of));
        }
        if traces.is_empty() {
            return InitialSurface::flat();
        }
        let (expanders, given_up) = (Arc::clone(&self.expanders), Arc::clone(&job.given_up));
        let earlier = Arc::new(Earlier::new(expanders, (traces, factors), given_up));
        let along = (track.start, track.backward);
        InitialSurface::flat().with(Relief::expanded(earlier, along))
    }

    /// Runs a line. Each step is added to the writer, which `made` then receives, with whether the step avoids all positions
    /// that later lines may have read. `None` if the run is given up.
    fn run(
        &self,
        job: &Job,
        begins: (f64, f64),
        mut made: impl FnMut(&mut Writer, bool),
    ) -> Result<Option<(Line, Writer)>, RasterError> {
        let (surface, mut writer) = (self.surface_of(job), self.writer(job));
        let scenario = self.plan.line(job.n, begins);
        let failed = |error| RasterError::Line { line: job.n + 1, error };
        let is_given_up = || job.given_up.load(Ordering::Relaxed) || stop::is_requested();
        let mut running = Running::new(&scenario, &surface).map_err(failed)?;
        let mut steps: Vec<Step> = Vec::with_capacity(self.most_steps.load(Ordering::Relaxed));
        loop {
            let step = running.step();
            if is_given_up() {
                return Ok(None);
            }
            let Some(step) = step.map_err(failed)? else { break };
            let is_ahead = writer.add(&step);
            steps.push(step);
            made(&mut writer, is_ahead);
        }
        self.most_steps.fetch_max(steps.len(), Ordering::Relaxed);
        if 2 * steps.len() < steps.capacity() {
            steps.shrink_to_fit();
        }
        let line = Line::new(self.plan.track(job.n), &scenario.model, steps, running.work());
        Ok(Some((line, writer)))
    }
}

impl Rows {
    /// The trace of the last line.
    fn newest(&self) -> Arc<Trace> {
        self.0.last().map(|row| Arc::clone(&row.trace)).unwrap_or_default()
    }
}

impl<'a, T> Shared<'a, T> {
    fn is_over(&self) -> bool {
        self.ended.is_some() || stop::is_requested()
    }

    /// To take the next line in order, if it is finished and no other is being taken.
    fn next_finished(&mut self) -> Option<Turn<'a, T>> {
        let at = self.finished.iter().position(|(line, _)| *line == self.out)?;
        let take = self.take.take()?;
        self.out += 1;
        Some(Turn::Take(take, self.finished.swap_remove(at).1))
    }

    /// Ends the work: gives up all lines.
    fn end(&mut self, ended: Result<(), RasterError>) {
        self.ended.get_or_insert(ended);
        self.give_up_from(0);
    }

    /// Gives up all later lines, because the tip of this line has returned to places that they have passed.
    fn returns(&mut self, job: &Job) {
        if job.given_up.load(Ordering::Relaxed) {
            return;
        }
        self.give_up_from(job.n + 1);
        self.returned = Some(job.n);
    }

    fn give_up_from(&mut self, n: usize) {
        let later = self.under_way.iter().filter(|(line, _)| *line >= n);
        later.for_each(|(_, given_up)| given_up.store(true, Ordering::Relaxed));
        self.under_way.retain(|(line, _)| *line < n);
        self.finished.retain(|(line, _)| *line < n);
    }

    /// Stores a finished line, unless it was given up meanwhile.
    fn finish(&mut self, job: &Job, made: Result<Made<T>, RasterError>) {
        if job.given_up.load(Ordering::Relaxed) {
            return;
        }
        self.under_way.retain(|(line, _)| *line != job.n);
        if self.returned == Some(job.n) {
            let rows = made.as_ref().map_or(&job.after, |(_, _, rows)| rows);
            (self.returned, self.next, self.rows) = (None, job.n + 1, rows.clone());
        }
        self.finished.push((job.n, made));
    }
}

/// Ends the work of all threads if one panics.
struct OnPanic<'a, 't, T>((&'a Mutex<Shared<'t, T>>, &'a Condvar));

impl<T> Drop for OnPanic<'_, '_, T> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            change(self.0, |now| now.end(Ok(())));
        }
    }
}

fn lock<'a, 't, T>(shared: &'a Mutex<Shared<'t, T>>) -> MutexGuard<'a, Shared<'t, T>> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Changes the state, and lets threads look at it that wait.
fn change<'t, T>(
    (shared, news): (&Mutex<Shared<'t, T>>, &Condvar),
    change: impl FnOnce(&mut Shared<'t, T>),
) {
    let mut now = lock(shared);
    change(&mut now);
    if now.waiting > 0 {
        drop(now);
        news.notify_all();
    }
}
