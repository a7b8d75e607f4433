//! The summary of steady walks.

use super::{Summary, again, digits};
use crate::commands::job::Product;
use stickslip::{WalkDocument, WalkingDocument, to_its_digits};

/// Number of significant digits of a walk.
const WALK: usize = 10;

impl Product for WalkingDocument {
    fn summary(&self) -> Summary {
        let alpha = digits(self.parameters.indentation.alpha.unwrap_or(f64::NAN), WALK);
        let stable = self.walks.iter().filter(|walk| walk.stable).count();
        let headline = match self.walks.len() {
            0 => format!("no steady walk at α = {alpha}"),
            1 => format!("one steady walk at α = {alpha}: {}", state(&self.walks[0])),
            more => format!("{more} steady walks at α = {alpha}, {stable} of them stable"),
        };
        let begins = self.walking_alpha.map(|least| format!("α = {}", digits(least, WALK)));
        let summary = Summary::new(headline).maybe("a tip at rest walks below", begins);
        let walks = self.walks.iter();
        walks
            .fold(summary, tell)
            .remarks(&self.remarks)
            .next(again("-o walking.json --plot roots.svg"))
    }
}

fn state(walk: &WalkDocument) -> &'static str {
    if walk.stable { "stable" } else { "unstable" }
}

fn tell(summary: Summary, walk: &WalkDocument) -> Summary {
    let error = walk.certificate.largest_error;
    // The first of the others: 0 is that of a shift.
    let leading = walk.roots.iter().find(|root| root.re != 0.0 || root.im != 0.0).map(|root| {
        let [re, im] = [root.re, root.im].map(|part| to_its_digits(part, error));
        format!("({re}) + ({im}) i k/Γ")
    });
    let certain = if walk.certificate.complete { "none is missing" } else { "some may be missing" };
    summary
        .row("speed", format!("{} kσ/Γ, {}", digits(walk.speed, WALK), state(walk)))
        .maybe("leading growth exponent", leading)
        .row("growth exponents", format!("{}, {certain}", walk.roots.len()))
}
