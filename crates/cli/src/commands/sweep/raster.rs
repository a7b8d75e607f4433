//! `stickslip sweep raster`: the pattern of a raster over pitch and α.

use super::divided::Divided;
use super::merge::is_done;
use super::threads;
use super::work::compute;
use crate::arguments::RasterSweepArguments;
use crate::arithmetic::arithmetic;
use crate::commands::finished::{Finished, Part};
use crate::commands::in_units::scales;
use crate::commands::job::{Job, judge_places};
use crate::commands::model::{tip, wider};
use crate::failure::{Failure, Typed};
use crate::interrupt::Interrupt;
use stickslip::lines::footprint;
use stickslip::{
    Document, PathName, Physical, RasterSweepDocument, RasterSweepFound, RasterSweepParameters,
    RasterSweepPoint,
};
use stickslip_raster::{
    Free, Line, LineRegime, Path, Plan, RasterError, Scanning, line_regime, pattern,
};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

const MOST_POINTS: usize = 100_000;

impl Part for RasterSweepPoint {
    const NAME: &'static str = "point";
    const WHOLE: &'static str = "sweep";

    fn index(&self) -> usize {
        self.index
    }
}

/// Common parameters of all points.
struct Grid {
    tip: TipFunction,
    footprint: Footprint,
    law: Wider,
    parameters: RasterSweepParameters,
}

pub(super) fn sweep(arguments: &RasterSweepArguments) -> Result<(), Failure> {
    let threads = threads(arguments.threads)?;
    let read = [("--tip-file", arguments.tip.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let grid = Grid::asked(arguments)?;
    let tip_file = arguments.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, Some(grid.parameters.r))?;
    let job = Job::open::<RasterSweepDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let (count, part) = (grid.parameters.points(), grid.parameters.part());
    let has = |index| index < count && part.has(index);
    let indices: Vec<usize> = part.indices(count).collect();
    let is_done = |file| is_done::<RasterSweepDocument>(file, &grid.parameters, &indices);
    if arguments.if_needed && job.file().is_some_and(is_done) {
        return Ok(());
    }
    let finished = match job.file() {
        Some(file) => Finished::beside(file, &grid.parameters, has)?,
        None => Finished::in_memory(),
    };
    let interrupt = Interrupt::listen()?;
    let mut finished = compute(&indices, finished, (threads, 1), &interrupt, |indices, take| {
        indices.iter().for_each(|index| take(grid.point(*index)));
    })?;
    let points = finished.take_in_order();
    let found = RasterSweepFound { points, arithmetic: Some(arithmetic()), crc32: None };
    let document: RasterSweepDocument = Document::new(grid.parameters, found, vec![]);
    job.finish(document.sealed()?.in_units(scales.as_ref()))?;
    finished.remove();
    Ok(())
}

impl Grid {
    fn asked(arguments: &RasterSweepArguments) -> Result<Self, Failure> {
        let (tip, law) = (tip(&arguments.tip)?, wider(&arguments.wider));
        let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
        let path = arguments.path;
        if path == PathName::Repeat {
            let message = "a repeated line has no pitch: take one-way or zigzag";
            return Err(Failure::input("--path repeat", message));
        }
        let (pitch, alpha) = (arguments.pitch.values(), arguments.alpha.values());
        let count = pitch.len().saturating_mul(alpha.len());
        if count > MOST_POINTS {
            let message = format!("make {count} points; at most {MOST_POINTS} are accepted");
            return Err(Failure::input("--pitch and --alpha", message));
        }
        let parameters = RasterSweepParameters {
            tip: (&tip).into(),
            r: arguments.r,
            depth_limit: law.depth_limit,
            healing_time: law.healing_time,
            inertia: law.inertia,
            width_y,
            stiffness_across: arguments.stiffness_across,
            path,
            pitch,
            alpha,
            lines: arguments.lines,
            length: arguments.length,
            tolerance: arguments.tolerance,
            shard: arguments.shard.map(Into::into),
        };
        let grid = Self { tip, footprint, law, parameters };
        // Both ends: what is wrong with any is wrong with one of them.
        for index in [0, count - 1] {
            grid.plan(index)?;
        }
        Ok(grid)
    }

    /// Pitch and α of a point.
    fn place(&self, index: usize) -> (f64, f64) {
        let RasterSweepParameters { pitch, alpha, .. } = &self.parameters;
        (pitch[index / alpha.len()], alpha[index % alpha.len()])
    }

    fn plan(&self, index: usize) -> Result<Plan, Failure> {
        let (pitch, alpha) = self.place(index);
        let RasterSweepParameters { r, path, lines, length, tolerance, .. } = &self.parameters;
        let named = |error: String| {
            Failure::input(
                format!("--pitch {} --alpha {} --r {}", Typed(pitch), Typed(alpha), Typed(*r)),
                error,
            )
        };
        let model = Model::under(self.law, self.tip.clone(), alpha, *r);
        let model = model.map_err(|error| named(error.to_string()))?;
        let (footprint, path) = (self.footprint.clone(), Path::from(*path));
        let mut plan = Plan::new(footprint, model, path, pitch, *lines, *length);
        plan.free = self.parameters.stiffness_across.map(Free::new);
        plan.law.tolerance = *tolerance;
        plan.validate().map_err(|error| match (&error, self.parameters.stiffness_across) {
            (RasterError::Free { .. }, Some(stiffness)) => {
                Failure::input(format!("--stiffness-across {}", Typed(stiffness)), error)
            }
            _ => named(error.to_string()),
        })?;
        Ok(plan)
    }

    /// The point with its results; depends on this point alone.
    fn point(&self, index: usize) -> RasterSweepPoint {
        let (pitch, alpha) = self.place(index);
        let point = RasterSweepPoint::at(index, (pitch, alpha), self.threshold(pitch));
        let scanned = || -> Result<(Plan, Vec<Line>), String> {
            let plan = self.plan(index).map_err(|failure| failure.to_string())?;
            let mut scanning = Scanning::new(&plan).map_err(|error| error.to_string())?;
            while scanning.next_line().map_err(|error| error.to_string())?.is_some() {}
            let lines = scanning.into_lines();
            Ok((plan, lines))
        };
        match scanned() {
            Err(error) => RasterSweepPoint { error: Some(error), ..point },
            Ok((plan, lines)) => {
                let is_stuck =
                    |line: &&Line| line_regime(&plan, line) == LineRegime::StuckAtTheEdge;
                let stuck = lines.iter().filter(is_stuck).count();
                point.written(&pattern(&plan, &lines), stuck)
            }
        }
    }

    /// αc for growth from line to line, if linear theory has one.
    fn threshold(&self, pitch: f64) -> Option<f64> {
        let RasterSweepParameters { r, path, length, .. } = &self.parameters;
        let path = if *path == PathName::Zigzag { RasterPath::Zigzag } else { RasterPath::OneWay };
        let left = self.law.left_after(length / r);
        let held = Raster::new(&self.footprint, self.law, (*r, pitch), left);
        let raster = match self.parameters.stiffness_across {
            None => held,
            Some(stiffness) => held.and_then(|held| held.with_stiffness_across(stiffness)),
        };
        let critical = raster.and_then(|raster| raster.critical(path));
        critical.ok().map(|at| at.alpha)
    }
}
