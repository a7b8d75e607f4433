//! In-process commands: the same commands and options, without files and processes.
//!
//! ```ignore
//! let host = Arc::new(Host::new([]));
//! let made = hosted::call(["run", "--alpha=1.2", "--r=1", "--until=60"], &host)?;
//! ```

pub use crate::session::{Host, Made, Pace, Supply};
pub use stickslip_saved::Document;

use crate::arguments::{Cli, Command};
use crate::commands::carried_out;
use crate::commands::quantities::translated;
use crate::commands::run::many;
use crate::failure::Failure;
use crate::files::input::open;
use crate::message::harmless;
use crate::session::{Session, locked};
use clap::{ArgAction, CommandFactory, FromArgMatches};
use std::ffi::OsString;
use std::io::Read;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, OnceLock};
use stickslip::{UnitsDocument, Unusable, VerifyDocument, identified};
use stickslip_saved::{Saved, drawn};
use stickslip_tip::stop;

/// The reason why there is no result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Refusal {
    /// Invalid input.
    Input(String),
    /// An error at run time.
    Run(String),
    /// The host cancelled the command.
    Stopped(String),
}

/// Runs a command, such as `["stability", "--r=1"]`. Returns `None` if the result was written to a
/// file and not kept. A result obtained before an error is available from [`Host::take`].
///
/// # Errors
/// The messages of the program.
pub fn call<'a>(
    words: impl IntoIterator<Item = &'a str>,
    host: &Arc<Host>,
) -> Result<Option<Made>, Refusal> {
    let (session, cli) = parse(host, words)?;
    match stop::with_flag(host.stop(), || carried_out(&session, &cli.command)) {
        Ok(()) => Ok(host.take()),
        // Work that ends early has its own message.
        Err(failure) if host.stop().load(Ordering::Relaxed) => {
            Err(Refusal::Stopped(failure.to_string()))
        }
        Err(failure) => Err(session.restored(failure).into()),
    }
}

/// Runs several `run` commands together, side by side where possible. Each command comes as its words, such as `["run",
/// "--r=1", …]`, with a host of its own for its files and warnings. `host` gets the progress of all commands and can
/// cancel them. Invalid input of any command is an error before the first run begins.
///
/// # Errors
/// The messages of the program, with the number of the command, from 0.
pub fn runs(
    commands: &[(Vec<String>, Arc<Host>)],
    host: &Arc<Host>,
) -> Result<Vec<Result<Made, Refusal>>, (usize, Refusal)> {
    let order = |(words, own): &(Vec<String>, Arc<Host>)| {
        let (session, cli) = parse(own, words.iter().map(String::as_str))?;
        let Command::Run(arguments) = &cli.command else {
            return Err(Refusal::Input("only runs can be computed together".into()));
        };
        many::order_of(&session, arguments).map_err(|failure| session.restored(failure).into())
    };
    let orders = commands.iter().enumerate();
    let orders = orders.map(|(number, command)| order(command).map_err(|e| (number, e)));
    let orders = orders.collect::<Result<_, _>>()?;
    let runs = stop::with_flag(host.stop(), || many::runs(&Session::of(host), orders));
    let stopped = host.stop().load(Ordering::Relaxed);
    let refused = |failure: Failure| match failure {
        failure if stopped => Refusal::Stopped(failure.to_string()),
        failure => failure.into(),
    };
    Ok(runs.into_iter().map(|run| run.map_err(refused)).collect())
}

impl From<Failure> for Refusal {
    fn from(failure: Failure) -> Self {
        // A host prints it, as it does the name of a file in it.
        let said = harmless(&failure.to_string()).into_owned();
        match failure.status() {
            2 => Self::Input(said),
            1 | 3 => Self::Run(said),
            _ => Self::Stopped(said),
        }
    }
}

/// The command-line parser, built once because that takes longer than many commands.
fn parser() -> &'static Mutex<clap::Command> {
    static PARSER: OnceLock<Mutex<clap::Command>> = OnceLock::new();
    PARSER.get_or_init(|| Mutex::new(Cli::command().no_binary_name(true)))
}

/// The command of these words, and its session.
fn parse<'a>(
    host: &Arc<Host>,
    words: impl IntoIterator<Item = &'a str>,
) -> Result<(Session, Cli), Refusal> {
    let (mut parser, session) = (locked(parser()), Session::of(host));
    let refused = |error: clap::Error| {
        let said = error.render().to_string();
        // The error, without usage and advice for a shell.
        let said = said.split("\n\nUsage:").next().unwrap_or_default();
        let said = said.split("\n\nFor more information").next().unwrap_or_default();
        Refusal::Input(said.trim_start_matches("error: ").trim_end().to_owned())
    };
    let words = words.into_iter().map(OsString::from).collect();
    let line = translated(&session, words, || &mut *parser)?;
    let matches = parser.try_get_matches_from_mut(&line.words).map_err(refused)?;
    let cli = Cli::from_arg_matches(&matches).map_err(refused)?;
    Ok((session.with_quantities(line.typed), cli))
}

/// An option of a command, as described in its help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OptionDescription {
    /// Name, such as `alpha-above`; for a positional argument such as `RUN.json` a name in lower case, `run`.
    pub name: String,
    /// Whether it is a positional argument.
    pub is_positional: bool,
    /// Placeholder of its value in help, such as `FILE`; `None` for a switch.
    pub value: Option<String>,
    /// Separator of several values of one option.
    pub delimiter: Option<char>,
    /// Whether the option may be given several times.
    pub is_repeatable: bool,
    /// Its description.
    pub help: String,
}

/// The options of a command or subcommand, such as `["sweep", "raster"]`; `None` if there is no such command.
pub fn options(path: &[&str]) -> Option<Vec<OptionDescription>> {
    let mut parser = locked(parser());
    parser.build();
    let command = path.iter().try_fold(&*parser, |at, name| at.find_subcommand(name))?;
    let summary = |argument: &clap::Arg| OptionDescription {
        name: argument.get_long().unwrap_or(argument.get_id().as_str()).to_owned(),
        is_positional: argument.is_positional(),
        value: value_of(argument),
        delimiter: argument.get_value_delimiter(),
        is_repeatable: matches!(argument.get_action(), ArgAction::Append),
        help: argument
            .get_long_help()
            .or(argument.get_help())
            .map(ToString::to_string)
            .unwrap_or_default(),
    };
    let own =
        |argument: &&clap::Arg| !["help", "version", "quiet"].contains(&argument.get_id().as_str());
    Some(command.get_arguments().filter(own).map(summary).collect())
}

fn value_of(argument: &clap::Arg) -> Option<String> {
    let takes = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    let name = argument.get_value_names().and_then(|names| names.first());
    takes.then(|| name.map(ToString::to_string).unwrap_or_default())
}

/// The names of all commands, with descriptions.
pub fn commands() -> Vec<(String, String)> {
    let parser = locked(parser());
    let summary = |command: &clap::Command| {
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        (command.get_name().to_owned(), about)
    };
    parser.get_subcommands().map(summary).collect()
}

/// The document in a file, of any format.
///
/// # Errors
/// The file cannot be read, or is not a document of this program.
pub fn load(path: &Path) -> Result<Box<dyn Document>, Refusal> {
    let refused = |error: Unusable| Refusal::from(Failure::file("DOCUMENT.json", path, error));
    read(open(&Session::default(), "DOCUMENT.json", path)?).map_err(refused)
}

/// The document in a stream, of any format.
///
/// # Errors
/// The stream is not a document of this program.
pub fn read(source: impl Read) -> Result<Box<dyn Document>, Unusable> {
    let (kind, mut source) = identified(Box::new(source), "stickslip/COMMAND")?;
    match kind.format.as_deref() {
        Some(UnitsDocument::FORMAT) => Ok(Box::new(UnitsDocument::read(&mut source)?)),
        Some(VerifyDocument::FORMAT) => Ok(Box::new(VerifyDocument::read(&mut source)?)),
        _ => drawn(Box::new(source)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::any::Any;
    use stickslip::{RunDocument, SweepDocument};

    fn host(supplies: impl IntoIterator<Item = (&'static str, Supply)>) -> Arc<Host> {
        Arc::new(Host::new(supplies.into_iter().map(|(name, supply)| (name.into(), supply))))
    }

    fn run_of(document: &dyn Document) -> &RunDocument {
        (document as &dyn Any).downcast_ref().unwrap()
    }

    fn run(words: &[&str], host: &Arc<Host>) -> RunDocument {
        let made = call(words.iter().copied(), host).unwrap().unwrap();
        run_of(&*made.document).clone()
    }

    #[test]
    fn a_run_in_hand_is_the_one_written_to_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("run.json");
        let output = format!("--output={}", file.display());
        let words = ["run", "--alpha=1.2", "--r=1", "--kick=0.05", "--until=60", &output];
        let host = host([]);
        let in_hand = run(&words, &host);
        let written = load(&file).unwrap();
        let text = |run: &RunDocument| serde_json::to_string(run).unwrap();
        assert_eq!(text(&in_hand), text(run_of(&*written)));
        assert!(in_hand.history.is_some());
    }

    #[test]
    fn several_runs_are_those_of_the_command_within_their_tolerance() {
        let words = |alpha: &str, more: &[&str]| {
            let usual = ["run", alpha, "--r=1", "--kick=0.05", "--until=60", "--sample-every=2"];
            let words = usual.into_iter().chain(more.iter().copied()).map(str::to_owned);
            (words.collect::<Vec<_>>(), host([]))
        };
        let commands = [
            words("--alpha=1.2", &[]),
            words("--alpha=0.8", &["--noise=1e-3", "--noise-spacing=0.5"]),
            words("--alpha=0.9", &["--history=none"]),
        ];
        let together: Vec<_> =
            runs(&commands, &host([])).unwrap().into_iter().map(Result::unwrap).collect();
        for ((words, own), made) in commands.iter().zip(&together) {
            let alone = call(words.iter().map(String::as_str), own).unwrap().unwrap();
            let (beside, single) = (run_of(&*made.document), run_of(&*alone.document));
            assert_eq!(beside.regime, single.regime);
            assert_eq!(beside.samples.t, single.samples.t);
            for (a, b) in beside.samples.x0.iter().zip(&single.samples.x0) {
                assert!((a - b).abs() < 1e-8, "{a} {b}");
            }
            let is_beside = beside.work.memory_reason.starts_with("side by side");
            assert_eq!(is_beside, !words.iter().any(|word| word.starts_with("--noise")));
            assert_eq!(beside.history.is_none(), words.iter().any(|word| word == "--history=none"));
            assert_eq!(made.headline.split(':').next(), alone.headline.split(':').next());
        }
        let refused = runs(&[words("--alpha=1", &[]), words("--alpha=-1", &[])], &host([]));
        assert!(
            matches!(refused, Err((1, Refusal::Input(said))) if said.starts_with("--alpha -1"))
        );
        let refused = runs(&[words("--alpha=1", &["--output=x.json"])], &host([]));
        assert!(matches!(refused, Err((0, Refusal::Input(said))) if said.starts_with("--output")));
    }

    #[test]
    fn files_from_memory_are_read_as_files_are() {
        let tip = "{\"gaussians\":[{\"amplitude\":1,\"center\":0,\"width\":1}]}";
        let host = host([("<tip>", Supply::Text(tip.into()))]);
        let words = ["run", "--alpha=1", "--r=1", "--until=20", "--tip-file=<tip>"];
        let own = run(&words, &host);
        let usual = run(&["run", "--alpha=1", "--r=1", "--until=20", "--tip=gaussian"], &host);
        assert_eq!(own.samples.l, usual.samples.l);
        let refused = call(["run", "--alpha=1", "--r=1", "--until=20", "--tip-file=<tap>"], &host);
        assert!(matches!(refused, Err(Refusal::Input(said)) if said.contains("--tip-file <tap>")));
    }

    /// Columns from memory give the bits of a text with shortest digits, and the same errors.
    #[test]
    fn columns_from_memory_are_read_as_a_text_of_them_is() {
        let pit = |x: f64| -12.5 * (-x * x / (2.0 * 31.7 * 31.7)).exp() + 0.003 * (17.0 * x).sin();
        let x: Vec<f64> = (-60..=60).map(|i| f64::from(i) * 3.1).collect();
        let z: Vec<f64> =
            x.iter().map(|x| if x.abs() < 1.0 { f64::NAN } else { pit(*x) }).collect();
        let rows = x.iter().zip(&z).map(|(x, z)| format!("{x:?};{z:?}\n"));
        let text = format!("# \"x (nm)\";\"z (nm)\"\n{}", rows.collect::<String>());
        let columns = |x: &[f64], z: &[f64]| {
            Supply::Columns(vec![("x (nm)".into(), x.to_vec()), ("z (nm)".into(), z.to_vec())])
        };
        let words = ["tip", "<pit>", "--resamples=5"];
        let [(typed, left_out), (in_hand, named)] =
            [Supply::Text(text), columns(&x, &z)].map(|supply| {
                let host = host([("<pit>", supply)]);
                let made = call(words, &host).unwrap().unwrap();
                (
                    serde_json::to_string(made.document.serialized()).unwrap(),
                    host.heard().join("\n"),
                )
            });
        assert_eq!(typed, in_hand);
        assert!(left_out.contains("1 of 121 rows have no value"), "{left_out}");
        assert!(
            named.contains("1 of 121 rows have no value") && named.contains("in row 61"),
            "{named}"
        );
        let nothing = vec![f64::NAN; x.len()];
        let infinite: Vec<f64> =
            z.iter().map(|z| if *z < -12.0 { f64::INFINITY } else { *z }).collect();
        let one = Supply::Columns(vec![("x".into(), x.clone())]);
        for (supply, why) in [
            (columns(&x, &nothing), "no row has all its values"),
            (columns(&x, &infinite), "a number is infinite"),
            (columns(&x, &z[1..]), "different numbers of rows"),
            (columns(&[], &[]), "there is no row of numbers in it"),
            (one, "1 column of numbers; 2 are needed"),
        ] {
            match call(words, &host([("<pit>", supply)])) {
                Err(Refusal::Input(said)) => assert!(said.contains(why), "{said}"),
                _ => panic!("{why}"),
            }
        }
    }

    #[test]
    fn what_is_said_is_heard_and_what_is_wrong_is_told_in_the_programs_words() {
        let host = host([]);
        run(&["run", "--alpha=1", "--r=1", "--until=20", "--pulse=1,500,1"], &host);
        let heard = host.heard().join("\n");
        assert!(heard.contains("--pulse 1,500,1"), "{heard}");
        for (words, said) in [
            (["stability", "--r=-1"], "--r -1: "),
            (["stability", "--r=one"], "invalid value 'one' for '--r <R>'"),
            (["stability", "--spring"], "unexpected argument '--spring' found"),
        ] {
            match call(words, &host) {
                Err(Refusal::Input(found)) => {
                    assert!(found.starts_with(said) && !found.contains("Usage"), "{found}");
                }
                _ => panic!("{words:?}"),
            }
        }
    }

    #[test]
    fn a_host_stops_what_it_asked_for() {
        let host = host([]);
        host.stop().store(true, Ordering::Relaxed);
        let words = ["run", "--alpha=1.2", "--r=1", "--until=1e5"];
        assert!(matches!(call(words, &host), Err(Refusal::Stopped(_))));
        let words = ["sweep", "--r=1", "--alpha=1:2:10"];
        assert!(matches!(call(words, &host), Err(Refusal::Stopped(_))));
        host.stop().store(false, Ordering::Relaxed);
        let made = call(["sweep", "--r=1", "--alpha=1:1.2:2"], &host).unwrap().unwrap();
        let sweep = (&*made.document as &dyn Any).downcast_ref::<SweepDocument>().unwrap();
        assert_eq!(sweep.points.len(), 2);
        assert!(made.headline.contains("2 points"), "{}", made.headline);
        assert_eq!(host.pace(), Some(Pace { part: Some(1.0), counted: "2 of 2 points".into() }));
    }

    #[test]
    fn a_host_stops_a_comparison_within_either_grid() {
        // Hours of work, were it not stopped, and nothing is shown before the grid marches.
        for line in [
            "compare --alpha=1.2 --r=1 --until=20 --grid=uniform --spacing=1e-3 --step=1e-5 --time-limit=1e9",
            "compare --tip=gaussian --alpha=0.4 --r=1 --pitch=1 --length=1e3 --lines=2 --step=1e-6 --time-limit=1e9",
        ] {
            let host = host([]);
            let raise = Arc::clone(&host);
            let work = std::thread::spawn(move || call(line.split(' '), &host).map(drop));
            while raise.pace().is_none() {
                assert!(!work.is_finished(), "{line}: {:?}", work.join());
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            raise.stop().store(true, Ordering::Relaxed);
            assert!(matches!(work.join(), Ok(Err(Refusal::Stopped(_)))), "{line}");
        }
    }

    #[test]
    fn options_are_those_of_the_help() {
        let summary = options(&["run"]).unwrap();
        let named = |name: &str| summary.iter().find(|option| option.name == name).unwrap();
        assert_eq!(named("tip-file").value.as_deref(), Some("FILE"));
        assert_eq!(named("sample-at").delimiter, Some(','));
        assert!(named("pulse").is_repeatable && named("no-spring").value.is_none());
        assert!(options(&["surface"]).unwrap().iter().any(|o| o.is_positional && o.name == "run"));
        assert!(options(&["sweep", "merge"]).is_some() && options(&["dance"]).is_none());
        assert!(commands().iter().any(|(name, _)| name == "continue"));
    }
}
