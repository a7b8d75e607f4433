//! Summaries of rasters.

use super::others::differences;
use super::{Summary, again, digits, ends, extremes, times};
use crate::commands::job::Product;
use stickslip::{
    HeightMap, LoadMapDocument, PathName, Pattern, RasterBoundaryDocument, RasterCompareDocument,
    RasterCompareFound, RasterCriticalDocument, RasterDocument, RasterKind,
    RasterStabilityDocument, RasterSurfaceDocument, RasterSweepDocument, SnakingBoundaryDocument,
};

impl Product for RasterDocument {
    fn summary(&self) -> Summary {
        let (count, regime) = (self.lines.len(), self.regime);
        let of = |value: f64, unit: &str| format!("{} {unit}", digits(value, 4));
        let pattern = self.pattern.as_ref();
        let [wavelength, angle] = pattern.map(Pattern::in_words).unwrap_or_default();
        let mut headline = format!("{count} lines: {regime}");
        headline.extend(wavelength.iter().map(|words| format!(", wavelength {words}")));
        headline.extend(angle.iter().map(|words| format!(", crests at {words} to the scan axis")));
        let coherence = |p: &Pattern| {
            let error = p.coherence_error.map(|error| format!(" ± {}", digits(error, 2)));
            digits(p.coherence, 4) + &error.unwrap_or_default()
        };
        Summary::new(headline)
            .maybe("q along the lines", pattern.and_then(|p| p.q).map(|q| of(q, "1/σ")))
            .maybe("κ across them", pattern.and_then(|p| p.kappa).map(|kappa| of(kappa, "1/σ")))
            .maybe("wavelength", wavelength)
            .maybe("crests to scan axis", angle)
            .maybe("coherence", pattern.map(coherence))
            .maybe(
                "of lines that go the same way",
                pattern.and_then(|p| p.coherence_same_way).map(|c| digits(c, 4)),
            )
            .maybe("amplitude of u", pattern.map(|p| of(p.amplitude, "kσ²/a")))
            .maybe("defects", pattern.map(|p| p.defects.to_string()))
            .row("volume", format!("{} kσ⁴/a", digits(self.volume, 10)))
            .row("steps", self.work.steps.to_string())
            .remarks(&self.remarks)
            .next(again("-o raster.json --plot raster.png"))
    }
}

impl Product for RasterStabilityDocument {
    fn summary(&self) -> Summary {
        let at = self.critical.as_ref();
        let number = |value: f64| digits(value, 10);
        let is_plane = self.thresholds.is_some();
        let stable = match (self.stable, is_plane) {
            (Some(true), false) => ": every ripple fades",
            (Some(false), false) => ": ripples grow",
            (Some(true), true) => ": every wave fades",
            (Some(false), true) => ": waves grow",
            (None, _) => "",
        };
        let headline = match (at, self.parameters.path) {
            (Some(at), _) => format!("{} above α = {}", grows(at), number(at.alpha)),
            (None, PathName::Repeat) => "every α makes some ripple of a repeated line grow".into(),
            (None, _) => "nothing grows from line to line, however large α".into(),
        };
        let alpha =
            self.parameters.indentation.alpha.filter(|_| !self.parameters.at_critical_point);
        let here = alpha.map(|alpha| format!("; α = {}{stable}", digits(alpha, 10)));
        let length =
            at.and_then(|at| at.wavelength_x).map(|length| format!("{} σ", number(length)));
        let summary = Summary::new(headline + &here.unwrap_or_default())
            .maybe("critical α", at.map(|at| number(at.alpha)))
            .maybe("q along the lines", at.map(|at| format!("{} 1/σ", number(at.q))))
            .maybe("wavelength along them", length)
            .maybe("wavelength across the crests", at.and_then(across_crests))
            .maybe("phase per line", at.map(|at| number(at.phase_per_line)))
            .maybe("crests to scan axis", at.and_then(angle));
        let others = self.thresholds.iter().flatten().skip(1);
        let summary = others.fold(summary, |summary, at| {
            let crests = angle(at).map(|angle| format!(", crests at {angle}")).unwrap_or_default();
            summary.row(
                &format!("{} above", at.kind.map_or("", RasterKind::as_str)),
                format!("α = {}, q = {} 1/σ{crests}", number(at.alpha), digits(at.q, 7)),
            )
        });
        let alpha = if self.parameters.at_critical_point { "--alpha 0.5 " } else { "" };
        let next = again(&format!("{alpha}-o growth.csv --plot growth.svg"));
        summary.remarks(&self.remarks).next(next)
    }
}

/// Wavelength across the crests, 2π/|(q, κ)|; `None` for a zigzag, where the phase alternates.
fn across_crests(at: &RasterCriticalDocument) -> Option<String> {
    let length = std::f64::consts::TAU / at.q.hypot(at.kappa?);
    Some(format!("{} σ", digits(length, 10)))
}

/// Description of the motion that grows above a threshold.
fn grows(at: &RasterCriticalDocument) -> &'static str {
    match at.kind {
        Some(RasterKind::Bunching) if at.wavelength_x.is_none() => "lines bunch in pairs",
        Some(RasterKind::Bunching) => "lines bunch",
        Some(RasterKind::Snaking) => "lines snake",
        Some(RasterKind::Ripples) | None => "ripples grow from line to line",
    }
}

fn angle(at: &RasterCriticalDocument) -> Option<String> {
    at.crest_angle.map(|angle| format!("{} °", digits(angle, 6)))
}

impl Product for RasterBoundaryDocument {
    fn summary(&self) -> Summary {
        let pitches = self.pitch.len();
        if pitches == 0 {
            return Summary::new("no ripple grows at any of these pitches").remarks(&self.remarks);
        }
        let summary = Summary::new(format!(
            "αc from {} at {pitches} pitches from {}",
            ends(&self.alpha),
            ends(&self.pitch)
        ))
        .row("αc one-way", format!("from {}", ends(&self.alpha)))
        .row("crests to scan axis", format!("from {} °", ends(&self.crest_angle)));
        let kinds = self.thresholds.iter().flat_map(|columns| columns.kind.chunk_by(|a, b| a == b));
        let mut first = 0;
        let summary = kinds.fold(summary, |summary, kind| {
            let pitches = ends(&self.pitch[first..first + kind.len()]);
            first += kind.len();
            summary
                .row(&format!("{} first", kind[0].as_str()), format!("at pitches from {pitches}"))
        });
        summary.remarks(&self.remarks).next(again("-o pitch.csv --plot pitch.svg"))
    }
}

impl Product for SnakingBoundaryDocument {
    fn summary(&self) -> Summary {
        let over_stiffness = self.parameters.stiffness_range.is_some();
        let (name, values) =
            if over_stiffness { ("κ_y", &self.stiffness) } else { ("r", &self.r) };
        if values.is_empty() {
            return Summary::new(format!("the line snakes at none of these values of {name}"))
                .remarks(&self.remarks);
        }
        let headline = format!(
            "the line snakes above α from {} at {} values of {name} from {}",
            ends(&self.alpha),
            values.len(),
            ends(values)
        );
        let summary =
            Summary::new(headline).row("wavelength", format!("from {} σ", ends(&self.wavelength)));
        let summary = self.crossings.iter().fold(summary, |summary, at| {
            let place = digits(if over_stiffness { at.stiffness } else { at.r }, 7);
            let alpha = digits(at.alpha, 7);
            summary.row("as stick-slip", format!("at {name} = {place}, α = {alpha}"))
        });
        summary.remarks(&self.remarks).next(again("-o snaking.json --plot snaking.svg"))
    }
}

impl Product for RasterCompareDocument {
    fn summary(&self) -> Summary {
        let RasterCompareFound { closed_work, grid_work, max_difference, speedup, lines, .. } =
            &self.answer;
        let [closed, grid] = [closed_work.seconds, grid_work.seconds].map(|s| 1e3 * s);
        let across = max_difference.y0.map(|y0| format!("{y0:.1e} in y0, ")).unwrap_or_default();
        let summary = Summary::new(format!(
            "{} lines: largest difference {:.1e} in x0, {across}{:.1e} in u; closed equation {closed:.2} ms, grid {grid:.0} ms: \
             {} times as fast",
            lines.len(),
            max_difference.x0,
            max_difference.u,
            times(*speedup),
        ));
        differences(summary, max_difference)
            .row("closed equation", format!("{} steps, {closed:.2} ms", closed_work.steps))
            .row("grid", format!("{} steps, {grid:.0} ms", grid_work.steps))
            .row("speedup", times(*speedup))
            .next(again("-o compare.json --plot compare.png"))
    }
}

impl Product for RasterSweepDocument {
    fn summary(&self) -> Summary {
        let mut regimes: Vec<(String, usize)> = vec![];
        for point in &self.points {
            let name = point.regime.map_or("failed".into(), |regime| regime.to_string());
            match regimes.iter_mut().find(|(known, _)| *known == name) {
                Some((_, many)) => *many += 1,
                None => regimes.push((name, 1)),
            }
        }
        let each: Vec<String> =
            regimes.iter().map(|(name, many)| format!("{many} {name}")).collect();
        let summary = Summary::new(format!("{} rasters: {}", self.points.len(), each.join(", ")));
        summary.next(again("-o map.json --plot map.svg"))
    }
}

impl Product for RasterSurfaceDocument {
    fn summary(&self) -> Summary {
        let all = |map: &HeightMap| map.u.concat();
        let heights: Vec<f64> = self.surfaces.iter().flat_map(all).collect();
        let [low, high] = extremes(heights.iter().copied()).map(|u| digits(u, 4));
        Summary::new(format!("{} heights from {low} to {high} kσ²/a", heights.len()))
            .next(again("-o surface.npz --plot surface.png"))
    }
}

impl Product for LoadMapDocument {
    fn summary(&self) -> Summary {
        let scales = self.physical.as_ref().map(|physical| physical.scales).unwrap_or_default();
        let length = |value: f64| match scales.length {
            Some(sigma) => format!("{} nm", digits(value * sigma * 1e9, 6)),
            None => format!("{} σ", digits(value, 6)),
        };
        let nanonewtons = |load: Option<f64>| load.map(|load| format!("{} nN", digits(load, 6)));
        let lever = &self.lever;
        let here = format!("{} nN, r = {}", digits(lever.load, 6), digits(lever.velocity, 6));
        let regime = lever.regime.map_or("unknown".into(), |regime| regime.to_string());
        let apart = lever.wavelength.map(length);
        let headline = match &apart {
            Some(apart) => format!("at {here}: ripples, {apart} apart"),
            None => format!("at {here}: {regime}"),
        };
        let ripples = self.points.iter().filter(|point| point.wavelength.is_some());
        let part = format!("at {} of {} points", ripples.clone().count(), self.points.len());
        let [shortest, longest] = extremes(ripples.filter_map(|point| point.wavelength));
        let range =
            (longest > 0.0).then(|| format!("{} to {} σ", digits(shortest, 6), digits(longest, 6)));
        Summary::new(headline)
            .maybe("critical load there", nanonewtons(self.lever_critical_load))
            .row("ripples", part)
            .maybe("their distances", range)
            .remarks(&self.remarks)
            .next(again("-o loads.csv --plot loads.svg"))
    }
}
