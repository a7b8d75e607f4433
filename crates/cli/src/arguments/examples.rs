//! Examples below the help, in lines that fit a terminal.

/// Number of characters of a line.
const WIDTH: usize = 78;
const INDENTED: &str = "        ";

/// The text with long commands broken before their options, in a form that a shell accepts.
pub(super) fn examples(text: &str) -> String {
    text.lines().map(|line| broken(line) + "\n").collect()
}

fn broken(line: &str) -> String {
    // Every command makes the examples of the program when it starts, and few lines are long.
    if line.len() + 2 <= WIDTH {
        return line.into();
    }
    let mut lines = vec![String::new()];
    // An option stays with its value.
    for part in line.split_inclusive(' ').fold(vec![], joined) {
        let last = lines.len() - 1;
        let is_long = lines[last].chars().count() + part.chars().count() + 2 > WIDTH;
        if is_long && line.trim_start().starts_with("stickslip") && part.starts_with('-') {
            lines[last].push('\\');
            lines.push(INDENTED.into());
        }
        let last = lines.len() - 1;
        lines[last].push_str(&part);
    }
    lines.join("\n")
}

fn joined(mut parts: Vec<String>, word: &str) -> Vec<String> {
    match parts.last_mut().filter(|_| !word.starts_with('-')) {
        Some(last) => last.push_str(word),
        None => parts.push(word.into()),
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_commands_go_on_in_the_next_line() {
        let text = "Examples:\n  The paper's:\n    stickslip run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 -o run.json --plot run.svg";
        let shown = examples(text);
        assert_eq!(
            shown,
            "Examples:\n  The paper's:\n    stickslip run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 \\\n        -o run.json --plot run.svg\n"
        );
        assert!(shown.lines().all(|line| line.chars().count() <= WIDTH + 1));
    }
}
