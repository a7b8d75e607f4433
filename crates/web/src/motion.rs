//! The run: its samples, the surface at any time of it, and its document.

use crate::asked::Asked;
use crate::limits::{MOST_MILLISECONDS, MOST_TIME};
use crate::refusal::Refusal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip::{Ask, Context, RunDocument};
use stickslip_surface::Surface;
use stickslip_tip::{InitialSurface, Scenario, Trajectory};

/// A run with its history.
pub(crate) struct Motion {
    document: RunDocument,
    scenario: Scenario,
    initial: InitialSurface,
    trajectory: Trajectory,
}

impl Motion {
    /// Makes the run, as far as it comes in [`MOST_MILLISECONDS`]; `now` is the time in milliseconds.
    pub(crate) fn of(asked: &Asked, now: fn() -> f64) -> Result<Self, Refusal> {
        if asked.until > MOST_TIME {
            return Err(Refusal::TooLong(asked.until));
        }
        let (began, cut_off) = (now(), Arc::new(AtomicBool::new(false)));
        let flag = Arc::clone(&cut_off);
        let watch = move |_, _: &str| {
            if now() - began > MOST_MILLISECONDS {
                flag.store(true, Ordering::Relaxed);
            }
        };
        let context = Context::cancelled_by(cut_off).watched_by(watch);
        let mut document = asked.run()?.ask(&context)?;
        document.work.seconds = (now() - began) / 1e3;
        let scenario = document.parameters.scenario()?;
        let initial = scenario.initial_surface()?;
        let trajectory = document.trajectory()?;
        Ok(Self { document, scenario, initial, trajectory })
    }

    /// The time reached by a run that was cut off.
    pub(crate) fn cut_off(&self) -> Option<f64> {
        self.document.interrupted.then(|| self.trajectory.end())
    }

    /// t, l, x0', the lag and x0 of the samples, one column after the other.
    pub(crate) fn columns(&self) -> Vec<f64> {
        let samples = &self.document.samples;
        let none = || vec![f64::NAN; samples.t.len()];
        let there = |column: &Option<Vec<f64>>| column.clone().unwrap_or_else(none);
        let (l, lag) = (there(&samples.l), there(&samples.lag));
        [&samples.t, &l, &samples.velocity, &lag, &samples.x0]
            .into_iter()
            .flatten()
            .copied()
            .collect()
    }

    pub(crate) fn heights(
        &self,
        t: f64,
        (from, to): (f64, f64),
        count: usize,
    ) -> Result<Vec<f64>, Refusal> {
        let spacing = (to - from) / count.max(2).saturating_sub(1) as f64;
        let x: Vec<f64> = (0..count).map(|i| from + spacing * i as f64).collect();
        let t = t.clamp(self.trajectory.start(), self.trajectory.end());
        let surface = Surface::new(&self.scenario.model, &self.initial, &self.trajectory);
        Ok(surface.heights(t, &x)?.to_vec())
    }

    pub(crate) fn positions(&self, t: f64) -> [f64; 2] {
        [self.trajectory.x0(t), self.trajectory.support().position(t)]
    }

    pub(crate) fn document(&self) -> &RunDocument {
        &self.document
    }
}
