//! Values of options.

use chacha20::ChaCha8Rng;
use rand::{RngExt, seq::IndexedRandom};

/// What an option takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Nothing,
    Real,
    Count,
    /// `LO:HI`, and how many.
    Range,
    List,
    Pulse,
    /// Of a picture.
    Length,
    /// With a unit.
    Quantity,
    Part,
    Field,
    Read,
    Written,
    Folder,
    Name,
}

impl Kind {
    /// By the name that the help gives the value.
    pub(super) fn of(command: &str, value: Option<&str>) -> Self {
        match value {
            None => Self::Nothing,
            Some("Γ" | "k" | "σ" | "N" | "a" | "v0") if command == "units" => Self::Quantity,
            Some("N") => Self::Count,
            Some("LO:HI:N" | "RANGE" | "LO:HI") => Self::Range,
            Some("A,T,W") => Self::Pulse,
            Some("WIDTH") => Self::Length,
            Some("I/N") => Self::Part,
            Some("FIELD") => Self::Field,
            Some("DIR") => Self::Folder,
            Some("FILE") => Self::Written,
            Some(name) if name.ends_with(".json") => Self::Read,
            Some(name) if name.contains(",…") => {
                if name.contains("NAME") {
                    Self::Name
                } else {
                    Self::List
                }
            }
            Some("NAME" | "MEMORY" | "GRID" | "FORMAT" | "START" | "PART") => Self::Name,
            Some(_) => Self::Real,
        }
    }
}

const REALS: [&str; 34] = [
    "NaN", "inf", "-inf", "1e308", "-1e308", "1e300", "1e-300", "5e-324", "-5e-324", "1e400", "0",
    "-0", "-1", "1e18", "-1e18", "1e15", "1e12", "1e10", "1e9", "1e8", "1e7", "1e6", "1e5", "1e4",
    "1e3", "100", "30", "1e-3", "1e-6", "1e-9", "1e-12", "1e-15", "1e-18", "one",
];
const COUNTS: [&str; 22] = [
    "0",
    "1",
    "2",
    "-1",
    "3",
    "10",
    "100",
    "1000",
    "10000",
    "100000",
    "1000000",
    "10000000",
    "100000000",
    "1000000000",
    "4294967296",
    "100000000000",
    "1000000000000000000",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "1.5",
    "NaN",
];

/// `None` where an option takes none.
pub(super) fn value(kind: Kind, rng: &mut ChaCha8Rng) -> Option<String> {
    let pick = |from: &[&str], rng: &mut ChaCha8Rng| (*from.choose(rng).unwrap()).to_owned();
    Some(match kind {
        Kind::Nothing => return None,
        Kind::Real => extreme(rng),
        Kind::Count => pick(&COUNTS, rng),
        Kind::Range => {
            let (low, high) = (real(rng, 0.01, 0.9), real(rng, 1.0, 30.0));
            match rng.random_range(0..8) {
                0 => format!("{low}:{high}"),
                1 => format!("{low},{high}"),
                2 => extreme(rng),
                _ => format!("{low}:{high}:{}", pick(&COUNTS, rng)),
            }
        }
        Kind::List => {
            let many = [1, 2, 5, 3000][rng.random_range(0..4)];
            let each: Vec<String> = (0..many).map(|_| real(rng, 16.5, 29.0)).collect();
            each.join(",")
        }
        Kind::Pulse => {
            let (a, t, w) = (real(rng, 0.01, 1.0), real(rng, 15.0, 20.0), real(rng, 0.1, 2.0));
            format!("{a},{t},{w}")
        }
        Kind::Length => {
            let unit = pick(&["px", "mm", "cm", "in", "pt", "", "m"], rng);
            format!("{}{unit}", real(rng, 50.0, 2000.0))
        }
        Kind::Quantity => {
            let unit = pick(&["", "N/m", "kg/s", "nm", "m/s", "N", "Ym", "ym", "GN"], rng);
            format!("{}{unit}", real(rng, 0.1, 10.0))
        }
        Kind::Part => format!("{}/{}", pick(&COUNTS, rng), pick(&COUNTS, rng)),
        Kind::Field => pick(
            &["parameters", "parameters.alpha", "a.b.c", "", "samples.t", ".", "critical.alpha"],
            rng,
        ),
        Kind::Read => pick(
            &["cycle.json", "run.json", "units.json", "none.json", "/dev/null", "/dev/zero"],
            rng,
        ),
        Kind::Written => pick(
            &[
                "out.json",
                "out.csv",
                "out.npz",
                "out.jsonl",
                "out.svg",
                "out.png",
                "out.pdf",
                "out.gsf",
                "/dev/null",
                "run.json",
            ],
            rng,
        ),
        Kind::Folder => pick(&["figures", "run.json", "/dev/null"], rng),
        Kind::Name => pick(
            &[
                "triple-gaussian",
                "gaussian",
                "bessel",
                "steady",
                "flat",
                "paper",
                "direct",
                "fft",
                "modes",
                "auto",
                "uniform",
                "windowed",
                "sinc",
                "spectral",
                "json",
                "csv",
                "npz",
                "text",
                "jsonl",
                "alpha",
                "r",
                "fig2",
                "none",
            ],
            rng,
        ),
    })
}

/// An extreme one, or one that would do.
fn real(rng: &mut ChaCha8Rng, low: f64, high: f64) -> String {
    if rng.random_range(0..2) == 0 { extreme(rng) } else { rng.random_range(low..high).to_string() }
}

fn extreme(rng: &mut ChaCha8Rng) -> String {
    match rng.random_range(0..6) {
        0 => format!("{:e}", 10_f64.powf(rng.random_range(-20.0..20.0))),
        1 | 2 => format!("{:e}", 10_f64.powf(rng.random_range(-5.0..5.0))),
        _ => (*REALS.choose(rng).unwrap()).to_owned(),
    }
}
