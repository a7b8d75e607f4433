//! The residence density of a line, which becomes known piece by piece while the tip moves along it.

use crate::path::Track;
use std::mem;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use stickslip_convolution::Density;
use stickslip_tip::{Step, Support, Wider, stop};

/// Number of cells of a piece.
pub(crate) const PIECE: usize = 32;
pub(crate) type Piece = [f64; PIECE];
/// Number of pieces for which a stretch has room at first: a hundred widths of a Gaussian.
const ROOM: usize = 16;

/// Number of cells below its own that a source changes.
const BELOW: i64 = 8;
/// Number of cells by which a tip may retreat without changing known pieces: three widths of a Gaussian.
const RETREAT: i64 = 16;
/// Number of pieces by which a line that had to wait falls back, so that it need not wait again at each piece.
const LEAD: i64 = 2;
/// Time that a line waits before its thread sleeps: to wake it may take as long.
const AWAKE: Duration = Duration::from_micros(200);
/// Longest time until a waiting line notices that the work is cancelled.
const PATIENCE: Duration = Duration::from_millis(20);

/// Pieces by their number, in stretches, each with the number of its first; missing ones are 0. A stretch is one piece of
/// memory: a thread also frees what other threads have allocated, and makes them wait each time.
#[derive(Debug, Default)]
pub(crate) struct Pieces(Vec<(i64, Vec<Piece>)>);

impl Pieces {
    pub(crate) fn get(&self, n: i64) -> Option<&Piece> {
        let stretches = self.0.partition_point(|(first, _)| *first <= n);
        let (first, pieces) = self.0[..stretches].last()?;
        pieces.get(usize::try_from(n - first).ok()?)
    }

    /// Adds a piece after all others.
    fn push(&mut self, n: i64, piece: Piece) {
        if let Some((first, pieces)) = self.0.last_mut()
            && *first + pieces.len() as i64 == n
        {
            pieces.push(piece);
            return;
        }
        let mut pieces = Vec::with_capacity(ROOM);
        pieces.push(piece);
        self.0.push((n, pieces));
    }

    /// The pieces `from`..`to` that are not missing.
    fn within(&self, (from, to): (i64, i64)) -> impl Iterator<Item = (i64, &Piece)> {
        let all = self.0.iter().flat_map(|(first, pieces)| (*first..).zip(pieces));
        all.skip_while(move |(n, _)| *n < from).take_while(move |(n, _)| *n < to)
    }
}

/// ρ of all lines so far at one y, at the end of the last of them. Lines that follow may read a piece as soon as the tip
/// has left it behind, and wait for it until then.
#[derive(Debug, Default)]
pub(crate) struct Trace {
    known: Mutex<Known>,
    news: Condvar,
}

#[derive(Debug, Default)]
struct Known {
    pieces: Pieces,
    /// All pieces below this one are known; `None` if none is known, and the largest number after the end of the line.
    to: Option<i64>,
    /// All pieces, once they are known: `pieces` has none then.
    whole: Option<Arc<Pieces>>,
    /// The piece up to which the trace must be known before waiting lines continue.
    wanted: Option<i64>,
}

impl Known {
    /// Whether all pieces below this one are known.
    fn reaches(&self, to: i64) -> bool {
        self.to.is_some_and(|known| known >= to)
    }
}

impl Trace {
    /// What `read` finds in the pieces, once all below `to` are known; `None` if the line that needs them is given up before.
    pub(crate) fn read<T>(
        &self,
        to: i64,
        given_up: &AtomicBool,
        read: impl FnOnce(&Pieces) -> T,
    ) -> Option<T> {
        let mut known = self.lock();
        if !known.reaches(to) {
            known = self.awake(known, to);
        }
        if !known.reaches(to) {
            known.wanted = known.wanted.max(Some(to.saturating_add(LEAD)));
        }
        while !known.reaches(to) {
            if given_up.load(Ordering::Relaxed) || stop::is_requested() {
                return None;
            }
            let waited = self.news.wait_timeout(known, PATIENCE);
            known = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        Some(read(known.whole.as_deref().unwrap_or(&known.pieces)))
    }

    /// Waits a while, without sleep, until all pieces below this one are known.
    fn awake<'a>(&'a self, mut known: MutexGuard<'a, Known>, to: i64) -> MutexGuard<'a, Known> {
        let began = Instant::now();
        while !known.reaches(to) && began.elapsed() < AWAKE {
            drop(known);
            thread::yield_now();
            known = self.lock();
        }
        known
    }

    /// All pieces, if they are known.
    pub(crate) fn whole(&self) -> Option<Arc<Pieces>> {
        self.lock().whole.clone()
    }

    fn publish(&self, pieces: impl Iterator<Item = (i64, Piece)>, to: i64) {
        let mut known = self.lock();
        pieces.for_each(|(n, piece)| known.pieces.push(n, piece));
        known.to = Some(to);
        if to == i64::MAX {
            known.whole = Some(Arc::new(mem::take(&mut known.pieces)));
        }
        if known.wanted.is_some_and(|wanted| wanted <= to) {
            known.wanted = None;
            drop(known);
            self.news.notify_all();
        }
    }

    fn lock(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The data of a line that its trace depends on, except its steps.
pub(crate) struct Ways {
    pub(crate) track: Track,
    pub(crate) support: Support,
    pub(crate) wider: Wider,
    pub(crate) duration: f64,
    /// Trace of the earlier lines at the same y, and the fraction of it that has not healed at the end of this line.
    pub(crate) before: Option<(Arc<Trace>, f64)>,
}

pub(crate) struct Writer {
    ways: Ways,
    trace: Arc<Trace>,
    density: Density,
    given_up: Arc<AtomicBool>,
    /// Farthest cell of the tip.
    farthest: i64,
    /// The trace is known below this piece.
    to: i64,
}

impl Writer {
    pub(crate) fn new(
        ways: Ways,
        trace: Arc<Trace>,
        spacing: f64,
        given_up: Arc<AtomicBool>,
    ) -> Self {
        let (farthest, to) = (i64::MIN, i64::MIN);
        let mut density = Density::new(spacing);
        let (start, end) = (ways.track.x(0.0), ways.track.x(ways.track.length));
        density.reserve((start.min(end), start.max(end)));
        Self { ways, trace, density, given_up, farthest, to }
    }

    /// Adds a step; false if it leads back to pieces that are published already.
    pub(crate) fn add(&mut self, step: &Step) -> bool {
        let Ways { track, support, wider, duration, .. } = &self.ways;
        let origin = support.position(step.t) - step.extension;
        let mut is_ahead = true;
        step.each_moment(wider, *duration, |moment| {
            let x = track.x(origin + moment.value(&step.displacement));
            self.density.add(x, moment.weight);
            #[expect(clippy::cast_possible_truncation, reason = "a cell")]
            let cell = (x / self.density.spacing()).floor() as i64;
            is_ahead &= cell - BELOW >= self.to.saturating_mul(PIECE as i64);
            self.farthest = self.farthest.max(cell);
        });
        is_ahead
    }

    /// Publishes the pieces that the tip has left behind, if the line runs towards larger x.
    pub(crate) fn publish(&mut self) {
        let to = (self.farthest - BELOW - RETREAT).div_euclid(PIECE as i64);
        if !self.ways.track.backward && to > self.to {
            self.publish_to(to);
        }
    }

    /// Publishes all remaining pieces.
    pub(crate) fn finish(mut self) {
        self.publish_to(i64::MAX);
    }

    /// Publishes all pieces in a trace that no line has read so far.
    pub(crate) fn finish_anew(self, trace: Arc<Trace>) {
        Self { trace, to: i64::MIN, ..self }.finish();
    }

    fn publish_to(&mut self, to: i64) {
        let (size, cells, from) = (PIECE as i64, self.density.range(), self.to);
        let mut before: Vec<(i64, Piece)> = vec![];
        if let Some((trace, left)) = &self.ways.before {
            let read = |pieces: &Pieces| {
                let faded = |(n, piece): (_, &Piece)| (n, piece.map(|rho| left * rho));
                pieces.within((from, to)).map(faded).collect()
            };
            let Some(known) = trace.read(to, &self.given_up, read) else { return };
            before = known;
        }
        let first = cells.start.div_euclid(size).max(from);
        let last = (cells.end + size - 1).div_euclid(size).min(to).max(first);
        let own = (first..last).map(|n| {
            let mut piece = [0.0; PIECE];
            self.density.copy_window(n * size, &mut piece);
            if let Ok(at) = before.binary_search_by_key(&n, |(n, _)| *n) {
                piece.iter_mut().zip(before[at].1).for_each(|(own, before)| *own += before);
            }
            (n, piece)
        });
        let below = before.iter().copied().take_while(|(n, _)| *n < first);
        let above = before.iter().copied().skip_while(|(n, _)| *n < last);
        self.trace.publish(below.chain(own).chain(above), to);
        self.to = to;
    }
}
