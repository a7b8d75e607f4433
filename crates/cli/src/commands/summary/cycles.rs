//! Summaries of periodic motion: cycles, branches, sweeps.

use super::{Summary, again, amplitude_of_u, digits};
use crate::commands::job::Product;
use stickslip::{
    ContinueDocument, CycleBranch, CycleDocument, EndName, EnsembleDocument, OverName, RegimeName,
    SpecialKind, StatisticsDocument, SweepDocument, to_its_digits,
};

impl Product for CycleDocument {
    fn summary(&self) -> Summary {
        let stable = if self.stable { "stable" } else { "unstable" };
        let slips = match self.slips {
            1 => "one slip".into(),
            n => format!("{n} slips"),
        };
        let held = |value: f64, error: Option<f64>| to_its_digits(value, error.unwrap_or(0.0));
        let period = held(self.period, self.period_error);
        let amplitude = held(self.amplitude_x0, self.amplitude_x0_error);
        let summary = Summary::new(format!(
            "{stable} cycle of {slips}, period {period}, amplitude of x0 {amplitude}"
        ));
        let shift = self.floquet.iter().map(|m| (m.re - 1.0).hypot(m.im));
        let shift = shift.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i);
        // But the one that stands for a shift in time.
        let leading = self.floquet.iter().enumerate().find(|(i, _)| Some(*i) != shift);
        let leading = leading.map(|(_, m)| {
            let [re, im] = [m.re, m.im].map(|part| digits(part, 6));
            format!("{re} + {im} i, ± {:.0e}", self.floquet_error)
        });
        summary
            .row("period", format!("{period} Γ/k"))
            .row("wavelength", format!("{} σ", held(self.wavelength, self.wavelength_error)))
            .row("amplitude of x0", format!("{amplitude} σ"))
            .row(
                amplitude_of_u(&self.parameters.law),
                format!("{} kσ²/a", held(self.amplitude_u, self.amplitude_u_error)),
            )
            .maybe("largest multiplier", leading)
            .row("residual of (18)", format!("{:.0e} kσ/Γ", self.residual))
            .next(again("-o cycle.json --plot cycle.svg"))
    }
}

impl Product for ContinueDocument {
    fn summary(&self) -> Summary {
        let over = self.parameters.over;
        let branches = self.branches.iter().enumerate();
        let lines: Vec<String> =
            branches.map(|(i, branch)| format!("branch {i}: {}", line(branch, over))).collect();
        let mut summary = Summary::new(lines.join("\n"));
        for special in &self.special {
            let at = if over == OverName::Alpha { ("α", special.alpha) } else { ("r", special.r) };
            let place =
                format!("{} = {}, period {}", at.0, digits(at.1, 10), digits(special.period, 10));
            summary =
                summary.row(name(special.kind), format!("{place}, branch {}", special.branch));
        }
        summary
            .maybe("trapping threshold", self.trapping.map(|value| digits(value, 7)))
            .remarks(&self.remarks)
            .next(again("-o branches.json --plot branches.svg"))
    }
}

fn line(branch: &CycleBranch, over: OverName) -> String {
    let (name, values) = match over {
        OverName::Alpha => ("alpha", &branch.alpha),
        OverName::R => ("r", &branch.r),
    };
    let end = |value: Option<&f64>| value.map_or(String::new(), |value| digits(*value, 7));
    let (first, last) = (end(values.first()), end(values.last()));
    format!("{} cycles, {name} from {first} to {last}, {}", values.len(), why(branch.end))
}

fn why(end: EndName) -> &'static str {
    match end {
        EndName::Reached => "the value of --to",
        EndName::LongPeriod => "where the period exceeds --longest-period",
        EndName::Steady => "where the cycle has shrunk to steady motion",
        EndName::Halved => "where it joins the branch of half the period",
        EndName::ManyPoints => "with --most-points",
        EndName::Lost => "where no further cycle was found",
        EndName::Interrupted => "where a signal ended it",
    }
}

fn name(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Hopf => "onset (Hopf)",
        SpecialKind::Fold => "fold",
        SpecialKind::PeriodDoubling => "period doubling",
        SpecialKind::PeriodHalving => "period halving",
        SpecialKind::BranchPoint => "branch point",
        SpecialKind::Torus => "torus",
    }
}

impl Product for SweepDocument {
    fn summary(&self) -> Summary {
        let regimes =
            [RegimeName::Steady, RegimeName::StickSlip, RegimeName::Trapped, RegimeName::Transient];
        // In one pass, which unpacks each point once.
        let (mut counts, mut failed, mut first_failed) = ([0; 4], 0, None);
        for point in self.points.iter() {
            let is_of = |regime: &RegimeName| point.regime == Some(*regime);
            if let Some(regime) = regimes.iter().position(is_of) {
                counts[regime] += 1;
            }
            failed += usize::from(point.error.is_some());
            first_failed = first_failed.or(point.error.map(|error| (point.r, error)));
        }
        let ensembles = self.ensembles.iter().flatten().collect::<Vec<_>>();
        let counts = regimes.iter().map(ToString::to_string).zip(counts);
        let found: Vec<String> = counts
            .clone()
            .chain([("failed".into(), failed)])
            .filter(|(_, count)| *count > 0)
            .map(|(regime, count)| format!("{count} {regime}"))
            .collect();
        let apart = match ensembles[..] {
            [EnsembleDocument { slip_distance: Some(found), .. }] => {
                format!("; slips {} σ apart", mean(found))
            }
            _ => String::new(),
        };
        let (count, found) = (self.points.len(), found.join(", "));
        let summary = Summary::new(format!("{count} points: {found}{apart}"));
        let summary = counts
            .fold(summary, |summary, (regime, count)| summary.row(&regime, count.to_string()));
        let why = first_failed
            .map(|(r, error)| format!("{failed}, the first at r = {}: {error}", digits(r, 7)));
        statistics(summary, &ensembles)
            .maybe("failed", why)
            .next(again("-o map.json --plot map.svg"))
    }
}

/// Largest number of ensembles with all their numbers listed; for more, only l is listed.
const IN_FULL: usize = 1;
/// Largest number of ensembles with a row.
const LISTED: usize = 20;

/// Adds means of ensembles with their standard errors, and standard deviations of the members.
fn statistics(summary: Summary, ensembles: &[&EnsembleDocument]) -> Summary {
    if ensembles.len() <= IN_FULL {
        return ensembles.iter().fold(summary, |summary, ensemble| {
            summary
                .maybe("period", ensemble.period.as_ref().map(|s| spread(s, "Γ/k")))
                .maybe("wavelength", ensemble.wavelength.as_ref().map(|s| spread(s, "σ")))
                .maybe("amplitude of x0", ensemble.amplitude_x0.as_ref().map(|s| spread(s, "σ")))
                .maybe("amplitude of u", ensemble.amplitude_u.as_ref().map(|s| spread(s, "kσ²/a")))
                .maybe("mean of l", ensemble.mean_l.as_ref().map(|s| spread(s, "σ")))
                .maybe("deviation of l", ensemble.deviation_l.as_ref().map(|s| spread(s, "σ")))
                .maybe("distance of slips", ensemble.slip_distance.as_ref().map(|s| spread(s, "σ")))
        });
    }
    let row = |summary: Summary, ensemble: &&EnsembleDocument| {
        let last = ensemble.first + ensemble.count - 1;
        let points = |of: &str| format!("{of}, points {} to {last}", ensemble.first);
        summary
            .maybe(&points("l"), ensemble.mean_l.as_ref().map(|s| spread(s, "σ")))
            .maybe(&points("slips"), ensemble.slip_distance.as_ref().map(|s| spread(s, "σ")))
    };
    let summary = ensembles.iter().take(LISTED).fold(summary, row);
    let more = ensembles.len().saturating_sub(LISTED);
    summary.maybe("more ensembles", (more > 0).then(|| more.to_string()))
}

fn mean(of: &StatisticsDocument) -> String {
    of.error.map_or_else(|| digits(of.mean, 7), |error| to_its_digits(of.mean, error))
}

fn spread(of: &StatisticsDocument, unit: &str) -> String {
    let mean = mean(of);
    let deviation = of.deviation.map_or(String::new(), |d| format!("spread {}, ", digits(d, 3)));
    let [least, largest] = [of.least, of.largest].map(|value| digits(value, 5));
    format!("mean of {}: {mean}, {deviation}{least} to {largest} {unit}", of.count)
}
