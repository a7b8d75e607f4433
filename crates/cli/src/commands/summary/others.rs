//! Summaries of surfaces, comparisons and units.

use super::{Summary, again, digits, ends, extremes, times};
use crate::commands::job::Product;
use stickslip::{
    CompareDocument, CompareFound, DifferenceDocument, SurfaceDocument, UnitsDocument,
};

impl Product for SurfaceDocument {
    fn summary(&self) -> Summary {
        let curves = self.surfaces.iter().map(|s| (s.t, &s.x, s.u.to_vec()));
        let images = self.images.iter().map(|image| {
            (image.t, &image.x, image.u.iter().flatten().copied().collect::<Vec<f64>>())
        });
        let all: Vec<(f64, &Vec<f64>, Vec<f64>)> = curves.chain(images).collect();
        let line = |(t, x, u): &(f64, &Vec<f64>, Vec<f64>)| {
            let [low, high] = extremes(u.iter().copied()).map(|u| digits(u, 4));
            let (count, t, x) = (u.len(), digits(*t, 10), ends(x));
            (
                format!("t = {t}"),
                format!("{count} heights from {low} to {high} kσ²/a, x from {x} σ"),
            )
        };
        let rows: Vec<(String, String)> = all.iter().map(line).collect();
        let headline = match rows.as_slice() {
            [(t, heights)] => format!("u at {t}: {heights}"),
            _ => format!("u at {} times", rows.len()),
        };
        let summary =
            rows.into_iter().fold(Summary::new(headline), |summary, (t, row)| summary.row(&t, row));
        summary.next(again("-o surface.csv --plot surface.svg"))
    }
}

impl Product for CompareDocument {
    fn summary(&self) -> Summary {
        let CompareFound { closed, grid, max_difference, speedup, .. } = &self.answer;
        let across = max_difference.y0.map(|y0| format!("{y0:.1e} in y0, "));
        let summary = Summary::new(format!(
            "largest difference {:.1e} in x0, {}{:.1e} in u; closed equation {:.2} ms, grid {:.2} ms: \
             {} times as fast per unit of time",
            max_difference.x0,
            across.unwrap_or_default(),
            max_difference.u,
            1e3 * closed.work.seconds,
            1e3 * grid.work.seconds,
            times(*speedup),
        ));
        differences(summary, max_difference)
            .row(
                "closed equation",
                format!("{} steps, {:.2} ms", closed.work.steps, 1e3 * closed.work.seconds),
            )
            .row("grid", format!("{} steps, {:.2} ms", grid.work.steps, 1e3 * grid.work.seconds))
            .row("speedup", format!("{} per unit of time simulated", times(*speedup)))
            .next(again("-o compare.json --plot compare.svg"))
    }
}

/// Adds the largest differences between closed equation and grid.
pub(super) fn differences(summary: Summary, largest: &DifferenceDocument) -> Summary {
    summary
        .row("difference in x0", format!("{:.1e} σ", largest.x0))
        .maybe("difference in y0", largest.y0.map(|y0| format!("{y0:.1e} σ")))
        .row("difference in u", format!("{:.1e} kσ²/a", largest.u))
}

impl Product for UnitsDocument {
    fn summary(&self) -> Summary {
        let stable =
            if self.stable { "steady motion is stable" } else { "steady motion is unstable" };
        let [alpha, r] = [self.alpha, self.r].map(|value| digits(value, 7));
        let summary = Summary::new(format!("α = {alpha}, r = {r}: {stable}"));
        let rows = self.quantities().into_iter().fold(summary, |summary, (name, value, unit)| {
            let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
            summary.maybe(&name.replace('_', " "), value.map(|v| format!("{}{unit}", digits(v, 7))))
        });
        let next = format!(
            "stickslip run --alpha {alpha} --r {r} --kick 0.05 --until 400 --units units.json -o run.json --plot run.svg"
        );
        rows.remarks(&self.remarks).next(again("-o units.json")).next(next)
    }
}
