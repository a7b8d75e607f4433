//! What is told of rasters.

use super::{Told, again, digits, times};
use crate::commands::job::Product;
use stickslip::{
    HeightMap, PatternDocument, RasterBoundaryDocument, RasterCompareDocument, RasterCompareFound,
    RasterDocument, RasterStabilityDocument, RasterSurfaceDocument, RasterSweepDocument,
};

impl Product for RasterDocument {
    fn told(&self) -> Told {
        let (count, regime) = (self.lines.len(), self.regime);
        let of = |value: f64, unit: &str| format!("{} {unit}", digits(value, 4));
        let pattern = self.pattern.as_ref();
        let [wavelength, angle] = pattern.map(PatternDocument::in_words).unwrap_or_default();
        let mut headline = format!("{count} lines: {regime}");
        headline.extend(wavelength.iter().map(|words| format!(", wavelength {words}")));
        headline.extend(angle.iter().map(|words| format!(", crests at {words} to the scan axis")));
        let coherence = |p: &PatternDocument| {
            let error = p.coherence_error.map(|error| format!(" ± {}", digits(error, 2)));
            digits(p.coherence, 4) + &error.unwrap_or_default()
        };
        Told::new(headline)
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
    fn told(&self) -> Told {
        let at = self.critical.as_ref();
        let number = |value: f64| digits(value, 10);
        let stable = match self.stable {
            Some(true) => ": every ripple fades",
            Some(false) => ": ripples grow",
            None => "",
        };
        let headline = match at {
            Some(at) => format!("ripples grow from line to line above α = {}", number(at.alpha)),
            None => "every α makes some ripple of a repeated line grow".into(),
        };
        let alpha =
            self.parameters.indentation.alpha.filter(|_| !self.parameters.at_critical_point);
        let here = alpha.map(|alpha| format!("; α = {}{stable}", digits(alpha, 10)));
        let angle = at.and_then(|at| at.crest_angle).map(|angle| format!("{} °", digits(angle, 6)));
        Told::new(headline + &here.unwrap_or_default())
            .maybe("critical α", at.map(|at| number(at.alpha)))
            .maybe("q along the lines", at.map(|at| format!("{} 1/σ", number(at.q))))
            .maybe("wavelength along them", at.map(|at| format!("{} σ", number(at.wavelength_x))))
            .maybe("phase per line", at.map(|at| number(at.phase_per_line)))
            .maybe("crests to scan axis", angle)
            .remarks(&self.remarks)
            .next(again("--alpha 0.5 -o growth.csv --plot growth.svg"))
    }
}

impl Product for RasterBoundaryDocument {
    fn told(&self) -> Told {
        let ends = |v: &[f64]| {
            let [first, last] = [v.first(), v.last()].map(|v| digits(v.copied().unwrap_or(0.0), 7));
            format!("{first} to {last}")
        };
        let pitches = self.pitch.len();
        Told::new(format!(
            "αc from {} at {pitches} pitches from {}",
            ends(&self.alpha),
            ends(&self.pitch)
        ))
        .row("αc one-way", format!("from {}", ends(&self.alpha)))
        .row("crests to scan axis", format!("from {} °", ends(&self.crest_angle)))
        .remarks(&self.remarks)
        .next(again("-o pitch.csv --plot pitch.svg"))
    }
}

impl Product for RasterCompareDocument {
    fn told(&self) -> Told {
        let RasterCompareFound { closed_work, grid_work, max_difference, speedup, lines, .. } =
            &self.answer;
        let [closed, grid] = [closed_work.seconds, grid_work.seconds].map(|s| 1e3 * s);
        let told = Told::new(format!(
            "{} lines: largest difference {:.1e} in x0, {:.1e} in u; closed equation {closed:.2} ms, grid {grid:.0} ms: \
             {} times as fast",
            lines.len(),
            max_difference.x0,
            max_difference.u,
            times(*speedup),
        ));
        told.row("difference in x0", format!("{:.1e} σ", max_difference.x0))
            .row("difference in u", format!("{:.1e} kσ²/a", max_difference.u))
            .row("closed equation", format!("{} steps, {closed:.2} ms", closed_work.steps))
            .row("grid", format!("{} steps, {grid:.0} ms", grid_work.steps))
            .row("speedup", times(*speedup))
            .next(again("-o compare.json --plot compare.png"))
    }
}

impl Product for RasterSweepDocument {
    fn told(&self) -> Told {
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
        let told = Told::new(format!("{} rasters: {}", self.points.len(), each.join(", ")));
        told.next(again("-o map.json --plot map.svg"))
    }
}

impl Product for RasterSurfaceDocument {
    fn told(&self) -> Told {
        let all = |map: &HeightMap| map.u.concat();
        let heights: Vec<f64> = self.surfaces.iter().flat_map(all).collect();
        let low = digits(heights.iter().copied().fold(f64::INFINITY, f64::min), 4);
        let high = digits(heights.iter().copied().fold(f64::NEG_INFINITY, f64::max), 4);
        Told::new(format!("{} heights from {low} to {high} kσ²/a", heights.len()))
            .next(again("-o surface.npz --plot surface.png"))
    }
}
