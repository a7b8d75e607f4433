//! The residence density of a line, which becomes known piece by piece while the tip moves along it.

use crate::path::Track;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use stickslip_convolution::Density;
use stickslip_tip::{Step, Support, Wider, stop};

/// Number of cells of a piece.
pub(crate) const PIECE: usize = 32;
pub(crate) type Piece = [f64; PIECE];
/// Pieces by their number; missing ones are 0.
pub(crate) type Pieces = BTreeMap<i64, Arc<Piece>>;

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

/// ρ of all lines so far at one y, at the end of the last of them. Lines that follow may read a piece as soon as the tip
/// has left it behind, and wait for it until then.
#[derive(Debug, Default)]
pub(crate) struct Trace {
    known: Mutex<Known>,
    news: Condvar,
}

#[derive(Debug, Default)]
struct Known {
    /// Shared once all of them are known.
    pieces: Arc<Pieces>,
    /// All pieces below this one are known; `None` if none is known, and the largest number after the end of the line.
    to: Option<i64>,
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
    /// The pieces `from`..`to`, once all of them are known; `None` if the line that needs them is given up before.
    pub(crate) fn pieces(
        &self,
        (from, to): (i64, i64),
        given_up: &AtomicBool,
    ) -> Option<Vec<(i64, Arc<Piece>)>> {
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
        Some(known.pieces.range(from..to).map(|(n, piece)| (*n, Arc::clone(piece))).collect())
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
        let known = self.lock();
        (known.to == Some(i64::MAX)).then(|| Arc::clone(&known.pieces))
    }

    fn publish(&self, pieces: Pieces, to: i64) {
        let mut known = self.lock();
        Arc::make_mut(&mut known.pieces).extend(pieces);
        known.to = Some(to);
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
        Self { ways, trace, density: Density::new(spacing), given_up, farthest, to }
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
        let (size, cells) = (PIECE as i64, self.density.range());
        let mut pieces: BTreeMap<i64, Piece> = BTreeMap::new();
        if let Some((before, left)) = &self.ways.before {
            let Some(before) = before.pieces((self.to, to), &self.given_up) else { return };
            pieces.extend(before.iter().map(|(n, piece)| (*n, piece.map(|rho| left * rho))));
        }
        let first = cells.start.div_euclid(size).max(self.to);
        let last = (cells.end + size - 1).div_euclid(size).min(to);
        for n in first..last {
            let mut own = [0.0; PIECE];
            self.density.copy_window(n * size, &mut own);
            let all = pieces.entry(n).or_insert([0.0; PIECE]);
            all.iter_mut().zip(own).for_each(|(all, own)| *all += own);
        }
        self.trace.publish(pieces.into_iter().map(|(n, piece)| (n, Arc::new(piece))).collect(), to);
        self.to = to;
    }
}
