//! The short help, `-h`: options of everyday work, with a sentence each. The long help, `--help`, has all of them.

use clap::builder::StyledStr;
use clap::{Arg, Command};
use std::cell::Cell;

thread_local! {
    static HAS_HELP: Cell<bool> = const { Cell::new(true) };
}

/// Calls `parse`, which builds commands without the texts of their help: they take longer than all other parsing.
pub(crate) fn without_help<T>(parse: impl FnOnce() -> T) -> T {
    HAS_HELP.set(false);
    let parsed = parse();
    HAS_HELP.set(true);
    parsed
}

/// Whether commands are built with their help.
pub(super) fn has_help() -> bool {
    HAS_HELP.get()
}

/// Groups of options that only the long help lists.
const FURTHER: [&str; 8] = [
    "Extended model",
    "Across the scan",
    "Walker",
    "Force",
    "Long runs",
    "Parts of a sweep",
    "Grid",
    "Pattern",
];
/// Options of other groups that only the long help lists.
const RARE: [&str; 8] = [
    "start",
    "start_position",
    "start_velocity",
    "noise_spacing",
    "memory",
    "history",
    "parameters",
    "slope_force",
];
/// Number of examples in the short help.
const EXAMPLES: usize = 2;

/// A command with a short help.
pub(super) trait Brief {
    /// The command, whose short help leaves out rare options and all but the first sentences and examples.
    fn brief(self) -> Self;
}

impl Brief for Command {
    fn brief(self) -> Self {
        if !has_help() {
            return self;
        }
        let is_rare = |argument: &Arg| {
            let is_further = |group: &str| FURTHER.contains(&group);
            RARE.contains(&argument.get_id().as_str())
                || argument.get_help_heading().is_some_and(is_further)
        };
        let count = self.get_arguments().filter(|argument| is_rare(argument)).count();
        let all = self.get_after_help().map(text).unwrap_or_default();
        let few = first_examples(&all);
        let more = match (count, few.len() < all.len()) {
            (0, false) => String::new(),
            (0, true) => "More examples: --help".into(),
            (1, _) => "One more option, with full descriptions: --help".into(),
            _ => format!("{count} more options, with full descriptions: --help"),
        };
        let shortened = |argument: Arg| {
            let is_rare = is_rare(&argument);
            let Some(help) = argument.get_help().map(text) else {
                return argument;
            };
            let long = argument.get_long_help().map_or(help.clone(), text);
            argument.help(first_sentence(&help)).long_help(long).hide_short_help(is_rare)
        };
        self.mut_args(shortened).after_help(few + &more).after_long_help(all)
    }
}

/// The text unchanged. `to_string` would search it for colours, which takes a sixth of the time of parsing; it has none.
fn text(styled: &StyledStr) -> String {
    styled.ansi().to_string()
}

/// The first sentence, and the default value.
fn first_sentence(help: &str) -> String {
    let (text, default) = match help.rfind(" [default: ") {
        Some(at) if help.ends_with(']') => help.split_at(at),
        _ => (help, ""),
    };
    let end = text.find(". ").unwrap_or(text.len());
    text[..end].to_owned() + default
}

/// The first examples: a line of words and the commands below it make one.
fn first_examples(text: &str) -> String {
    let begins = |line: &str| line.starts_with("  ") && !line.starts_with("    ");
    let mut count = 0;
    let within = |line: &&str| {
        count += usize::from(begins(line));
        count <= EXAMPLES
    };
    text.lines().take_while(within).map(|line| format!("{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_default_stays_with_the_first_sentence() {
        assert_eq!(first_sentence("Time T. More of it [default: 3]"), "Time T [default: 3]");
        assert_eq!(first_sentence("Length, 0.1 or more"), "Length, 0.1 or more");
    }

    #[test]
    fn two_examples_are_kept_whole() {
        let text =
            "Examples:\n  One:\n    stickslip a \\\n        -o b\n  Two:\n    c\n  Three:\n    d\n";
        let kept = "Examples:\n  One:\n    stickslip a \\\n        -o b\n  Two:\n    c\n";
        assert_eq!(first_examples(text), kept);
        assert_eq!(first_examples("Example:\n  x\n"), "Example:\n  x\n");
    }
}
