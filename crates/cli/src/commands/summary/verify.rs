//! The summary of a verification.

use super::{Summary, digits};
use crate::commands::job::Product;
use crate::commands::verify::claims::said;
use stickslip::{LargestDifferenceDocument, VerifyDocument};

impl Product for VerifyDocument {
    fn summary(&self) -> Summary {
        let found = &self.verification;
        let l = &found.l;
        let verdict = if found.kept { "kept" } else { "not kept" };
        let summary = Summary::new(format!(
            "the tolerance of {:e} is {verdict}: l is off by {:.1e} at most, {:.1e} is allowed; repeated with {} at {:.0e}",
            self.parameters.tolerance, l.largest, l.allowed, found.memory, found.tolerance
        ));
        let off = self.differences.iter();
        let summary = off.fold(summary, |summary, off| summary.row("does not follow", said(off)));
        summary
            .row("l", difference(l, "t"))
            .maybe("y0", found.y0.as_ref().map(|y0| difference(y0, "t")))
            .maybe("u", found.u.as_ref().map(|u| difference(u, "x")))
            .maybe("trusted until", found.trusted_until.map(|t| format!("t = {}", digits(t, 10))))
            .row("errors amplified", format!("{:.1e} times", found.amplification))
            .maybe(
                "Lyapunov exponent",
                found.lyapunov_exponent.map(|exponent| format!("{} k/Γ", digits(exponent, 3))),
            )
            .maybe("samples", self.lines.as_ref().map(|lines| lines.samples.to_string()))
    }
}

fn difference(found: &LargestDifferenceDocument, at: &str) -> String {
    let LargestDifferenceDocument { largest, at: place, allowed } = found;
    format!("{largest:.1e} at {at} = {}, {allowed:.1e} allowed", digits(*place, 7))
}
