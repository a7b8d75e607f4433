//! What was found, for a person: a line or two, aligned values with their errors, and what to try next.

use std::fmt::Write;

/// What a person is told of a result.
#[derive(Debug, Default)]
pub(crate) struct Told {
    headline: String,
    rows: Vec<(String, String)>,
    remarks: Vec<String>,
    next: Vec<String>,
}

impl Told {
    /// What was found, and whether what was promised is kept, in a line or two: all that is said beside a file.
    pub(crate) fn new(headline: impl Into<String>) -> Self {
        Self { headline: headline.into(), ..Self::default() }
    }

    /// A value under its name.
    #[must_use]
    pub(crate) fn row(mut self, name: &str, value: impl Into<String>) -> Self {
        self.rows.push((name.into(), value.into()));
        self
    }

    /// The same, if there is one.
    #[must_use]
    pub(crate) fn maybe(self, name: &str, value: Option<String>) -> Self {
        match value {
            Some(value) => self.row(name, value),
            None => self,
        }
    }

    /// What a reader should know.
    #[must_use]
    pub(crate) fn remarks(mut self, remarks: &[String]) -> Self {
        self.remarks.extend_from_slice(remarks);
        self
    }

    /// A command to try.
    #[must_use]
    pub(crate) fn next(mut self, command: impl Into<String>) -> Self {
        self.next.push(command.into());
        self
    }

    pub(crate) fn headline(&self) -> &str {
        &self.headline
    }

    /// All of it, in lines.
    pub(crate) fn text(&self) -> String {
        let width = self.rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        let mut text = format!("{}\n", self.headline.trim_end());
        for (name, value) in &self.rows {
            let gap = width - name.chars().count();
            // A String takes all that is written to it.
            writeln!(text, "  {name}{:gap$}  {value}", "").ok();
        }
        for remark in &self.remarks {
            writeln!(text, "  note: {remark}").ok();
        }
        for command in &self.next {
            writeln!(text, "next: {command}").ok();
        }
        text
    }
}

/// The command as it was typed, with more behind it; the program's name as users know it.
pub(crate) fn again(more: &str) -> String {
    let quoted = |word: String| {
        let is_plain = |c: char| c.is_alphanumeric() || "-_=.,:/+@%".contains(c);
        if !word.is_empty() && word.chars().all(is_plain) { word } else { format!("'{word}'") }
    };
    let words = std::env::args_os().skip(1).map(|word| quoted(word.to_string_lossy().into()));
    let words: Vec<String> = words.collect();
    format!("stickslip {} {more}", words.join(" "))
}

/// With so many digits that count, as few as it needs.
pub(crate) fn digits(value: f64, count: usize) -> String {
    let exponent = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !value.is_finite() || !(-5..15).contains(&exponent) {
        let mantissa = format!("{value:.*e}", count - 1);
        let Some((number, exponent)) = mantissa.split_once('e') else { return mantissa };
        return format!("{}e{exponent}", without_zeros(number));
    }
    let decimals = usize::try_from(count as i32 - 1 - exponent).unwrap_or(0);
    without_zeros(&format!("{value:.decimals$}")).into()
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// The digits that hold where the error is at most so large, and that error: `6.6936889 ± 3e-8`.
pub(crate) fn held(value: f64, error: f64) -> String {
    if !(error.is_finite() && error > 0.0 && value.is_finite()) {
        return digits(value, 10);
    }
    let exponent = error.log10().floor() as i32;
    let decimals = usize::try_from(-exponent).unwrap_or(0).min(15);
    if value.abs() < 1e-4 || decimals > 12 {
        return format!("{} ± {error:.0e}", digits(value, 10));
    }
    format!("{value:.decimals$} ± {error:.0e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_below_each_other() {
        let told = Told::new("steady: t = 5").row("α", "1.2").maybe("none", None).row("period", "6");
        let told = told.remarks(&["few".into()]).next("stickslip units");
        let text = "steady: t = 5\n  α       1.2\n  period  6\n  note: few\nnext: stickslip units\n";
        assert_eq!(told.text(), text);
    }

    #[test]
    fn digits_are_those_that_count() {
        let cases = [(1.0690361749, 7), (0.0, 7), (2e-9, 3), (1234567.0, 7), (-0.5, 3), (1e300, 4)];
        let shown = cases.map(|(value, count)| digits(value, count));
        assert_eq!(shown, ["1.069036", "0", "2e-9", "1234567", "-0.5", "1e300"]);
        assert_eq!(held(6.693688892159, 3e-8), "6.69368889 ± 3e-8");
        assert_eq!(held(19.4565, 2.0), "19 ± 2e0");
        assert_eq!(held(0.5, f64::NAN), "0.5");
    }
}
