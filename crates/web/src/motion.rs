//! The run: its samples, the surface at any time of it, and its document.

use crate::limits::{MOST_TIME, Stopwatch};
use crate::parameters::Parameters;
use crate::refusal::Refusal;
use stickslip::{Ask, RunDocument};
use stickslip_surface::{Surface, SurfaceAcross};
use stickslip_tip::planar::{self, PlanarScenario};
use stickslip_tip::{InitialSurface, Scenario, Trajectory};

/// A run with its history.
pub(crate) struct Motion {
    document: RunDocument,
    path: Path,
}

/// The motion of a tip that is held on its line, or of one that can leave it.
enum Path {
    Along { scenario: Box<Scenario>, initial: InitialSurface, trajectory: Trajectory },
    Across { scenario: Box<PlanarScenario>, trajectory: planar::Trajectory },
}

impl Motion {
    /// Computes the run up to the page's limit of computing time; `now` is the time in milliseconds.
    pub(crate) fn of(parameters: &Parameters, now: fn() -> f64) -> Result<Self, Refusal> {
        if parameters.until > MOST_TIME {
            return Err(Refusal::TooLong(parameters.until));
        }
        let stopwatch = Stopwatch::from(now);
        let mut document = parameters.run()?.ask(&stopwatch.context())?;
        document.work.seconds = stopwatch.seconds();
        let path = Path::of(&document)?;
        Ok(Self { document, path })
    }

    /// The time reached by a run that was cut off.
    pub(crate) fn cut_off(&self) -> Option<f64> {
        self.document.interrupted.then(|| self.path.span().1)
    }

    /// Columns t, l, x0', lag, x0 and y0 of the samples, one after the other.
    pub(crate) fn columns(&self) -> Vec<f64> {
        let samples = &self.document.samples;
        let filled = |column: &Option<Vec<f64>>, missing: f64| {
            column.clone().unwrap_or_else(|| vec![missing; samples.t.len()])
        };
        let (l, lag) = (filled(&samples.l, f64::NAN), filled(&samples.lag, f64::NAN));
        [&samples.t, &l, &samples.velocity, &lag, &samples.x0, &filled(&samples.y0, 0.0)]
            .into_iter()
            .flatten()
            .copied()
            .collect()
    }

    /// Heights u at `count` points along the scan, at the y of the tip.
    pub(crate) fn heights(
        &self,
        t: f64,
        (from, to): (f64, f64),
        count: usize,
    ) -> Result<Vec<f64>, Refusal> {
        let spacing = (to - from) / count.max(2).saturating_sub(1) as f64;
        let x: Vec<f64> = (0..count).map(|i| from + spacing * i as f64).collect();
        let (start, end) = self.path.span();
        self.path.heights(t.clamp(start, end), &x)
    }

    /// The positions x0 of the tip and R of the support, and y0.
    pub(crate) fn positions(&self, t: f64) -> [f64; 3] {
        match &self.path {
            Path::Along { trajectory, .. } => {
                [trajectory.x0(t), trajectory.support().position(t), 0.0]
            }
            Path::Across { trajectory, .. } => {
                [trajectory.x0(t), trajectory.support().position(t), trajectory.y0(t)]
            }
        }
    }

    pub(crate) fn document(&self) -> &RunDocument {
        &self.document
    }
}

impl Path {
    fn of(document: &RunDocument) -> Result<Self, Refusal> {
        if document.parameters.stiffness_across.is_some() {
            let (scenario, trajectory) = document.trajectory_across()?;
            return Ok(Self::Across { scenario: Box::new(scenario), trajectory });
        }
        let scenario = Box::new(document.parameters.scenario()?);
        let initial = scenario.initial_surface()?;
        Ok(Self::Along { scenario, initial, trajectory: document.trajectory()? })
    }

    fn span(&self) -> (f64, f64) {
        match self {
            Self::Along { trajectory, .. } => (trajectory.start(), trajectory.end()),
            Self::Across { trajectory, .. } => (trajectory.start(), trajectory.end()),
        }
    }

    fn heights(&self, t: f64, x: &[f64]) -> Result<Vec<f64>, Refusal> {
        Ok(match self {
            Self::Along { scenario, initial, trajectory } => {
                Surface::new(&scenario.model, initial, trajectory).heights(t, x)?.to_vec()
            }
            Self::Across { scenario, trajectory } => {
                let image =
                    SurfaceAcross::new(scenario, trajectory)?.image(t, x, &[trajectory.y0(t)])?;
                image.into_iter().collect()
            }
        })
    }
}
