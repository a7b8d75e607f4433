//! `stickslip compare --lines --stiffness-across`: a raster of a tip that is free to move across the lines, against
//! cells of a plane.

use super::{Asked, Watch, scan_lines};
use crate::commands::compare::grid::grid_work;
use crate::commands::compare::plane::Plane;
use crate::failure::Failure;
use stickslip::RasterCompared;
use stickslip_grid::{PlaneScan, scan_plane};
use stickslip_raster::{Free, Path};

/// The raster on cells of a plane.
pub(super) fn on_cells(
    asked: &Asked,
    free: &Free,
    plane: &Plane,
) -> Result<RasterCompared, Failure> {
    let Asked { plan, stepping, times, x, .. } = asked;
    let (model, wider) = (&plan.law.model, plan.law.model.wider());
    let lines = scan_lines(plan);
    let mut y: Vec<f64> = lines.iter().map(|line| line.y).collect();
    y.sort_by(f64::total_cmp);
    y.dedup();
    plane.fit(x[x.len() - 1] - x[0], (y[0], y[y.len() - 1]))?;
    let scan = PlaneScan {
        model: (model.alpha(), model.r()),
        law: (wider.depth_limit, wider.healing_time, wider.inertia),
        stiffness_across: free.stiffness,
        products: &plane.products,
        lines: &lines,
        zigzag: plan.path == Path::Zigzag,
        kick: free.kick,
        force: &|t| [plan.disturbance.value(t), free.disturbance.value(t)],
    };
    let points: Vec<[f64; 2]> = y.iter().flat_map(|y| x.iter().map(|x| [*x, *y])).collect();
    let mut watch = Watch::new(asked.session, lines.len(), asked.limit);
    let mut line = |done: f64| watch.reached(done);
    let scanned = scan_plane(&scan, &plane.method, stepping, (times, &points), &mut line);
    let (scanned, seconds) = watch.ended(scanned)?;
    let at_times = |at: &Vec<[f64; 2]>| times.iter().copied().zip(at.iter().copied()).collect();
    let motions = match times.is_empty() {
        true => scanned.steps,
        false => scanned.position.iter().map(at_times).collect(),
    };
    let u = scanned.u.chunks(x.len()).map(<[f64]>::to_vec).collect();
    Ok(RasterCompared { x: x.clone(), motions, y, u, work: grid_work(&scanned.work, seconds) })
}
