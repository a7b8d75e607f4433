//! One table in hundreds of forms: separators, decimal marks, encodings, line ends, headings, units, damaged rows. Each gives
//! the same answer, or a refusal that names the line; none gives another answer.
//!
//! Judge: the plain form, a CSV in UTF-8. Encodings are made here by hand: UTF-16 by `encode_utf16`, Latin-1 from a table.

use crate::folder::{Folder, said};
use serde_json::Value;
use std::process::Output;

/// How a table is written.
#[derive(Debug, Clone, Copy)]
struct Form {
    separator: &'static str,
    decimal: char,
    is_quoted: bool,
    encoding: &'static str,
    end: &'static str,
    /// Lines above the rows; `|` stands for the separator.
    heading: &'static str,
    /// Nanometres in the unit of the heading.
    unit: f64,
}

const PLAIN: Form = Form {
    separator: ",",
    decimal: '.',
    is_quoted: false,
    encoding: "utf-8",
    end: "\n",
    heading: "x_nm|z_nm\n",
    unit: 1.0,
};

const SEPARATORS: [&str; 7] = [",", ";", "\t", " ", ", ", "; ", "   "];
const ENCODINGS: [&str; 7] =
    ["utf-8", "utf-8-bom", "utf-16le", "utf-16be", "utf-16le-bom", "utf-16be-bom", "latin-1"];
const ENDS: [&str; 3] = ["\n", "\r\n", "\r"];

/// Headings with the nanometres in their unit.
const HEADINGS: [(&str, f64); 24] = [
    ("x_nm|z_nm\n", 1.0),
    ("x (nm)|z (nm)\n", 1.0),
    ("\"Distance [nm]\"|\"Height [nm]\"\n", 1.0),
    ("x/nm|z/nm\n", 1.0),
    ("x|z\nnm|nm\n", 1.0),
    ("Position|Height\n(nm)|(nm)\n", 1.0),
    ("[nm]|[nm]\n", 1.0),
    ("# x_nm|z_nm\n", 1.0),
    ("# measured in May\n# x [nm]|z [nm]\n", 1.0),
    ("# units: nm nm\nx|z\n", 1.0),
    ("Instrument: AFM 5\nDate: 23.11.2026 12:00\nx_nm|z_nm\n", 1.0),
    ("Samples|61\nX_Unit = nm\nx|z\n", 1.0),
    ("x_um|z_nm\n", 1e3),
    ("x (µm)|z (nm)\n", 1e3),
    ("x|z\nµm|nm\n", 1e3),
    ("x [micron]|z [nm]\n", 1e3),
    ("x (Å)|z (nm)\n", 0.1),
    ("x|z\n(Å)|(Å)\n", 0.1),
    ("Distance (m)|Height (m)\n", 1e9),
    ("m|m\n", 1e9),
    ("x_mm|z_nm\n", 1e6),
    ("x_pm|z_nm\n", 1e-3),
    ("Profile 1\nx_nm|z_nm\n\n", 1.0),
    ("x|z\nnm|V\n", 1.0),
];

/// A pit of width 30 nm, off centre, tilted, with noise by a fixed rule: positions in tenths of nm, heights in thousandths.
fn rows() -> Vec<[i64; 2]> {
    let mut state = 99_u32;
    let row = |i: i32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = f64::from(state) / f64::from(u32::MAX) - 0.5;
        let x = 5.0 * f64::from(i) - 140.5;
        let z = 3.0 + 0.01 * x - 12.0 * (-0.5 * ((x - 7.0) / 30.0_f64).powi(2)).exp() + 0.3 * noise;
        [(10.0 * x).round() as i64, (1e3 * z).round() as i64]
    };
    (0..61).map(row).collect()
}

/// A number of so many decimals, shifted by powers of ten without rounding.
fn digits(value: i64, decimals: i32, decimal: char) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let text = if decimals > 0 {
        let width = usize::try_from(decimals).unwrap() + 1;
        let padded = format!("{:0width$}", value.abs());
        let (above, below) = padded.split_at(padded.len() - width + 1);
        format!("{above}{decimal}{below}")
    } else {
        format!("{}{}", value.abs(), "0".repeat(usize::try_from(-decimals).unwrap()))
    };
    format!("{sign}{text}")
}

impl Form {
    /// The lines, without their ends.
    fn lines(&self) -> Vec<String> {
        // Heights stay as they are, whatever their unit: σ does not depend on it.
        let shift = self.unit.log10().round() as i32;
        let quoted = |text: String| if self.is_quoted { format!("\"{text}\"") } else { text };
        let heading = self.heading.replace('|', self.separator);
        let mut lines: Vec<String> = heading.lines().map(String::from).collect();
        lines.extend(rows().into_iter().map(|[x, z]| {
            let [x, z] =
                [digits(x, 1 + shift, self.decimal), digits(z, 3, self.decimal)].map(quoted);
            format!("{x}{}{z}", self.separator)
        }));
        lines
    }

    fn encoded(&self, lines: &[String]) -> Vec<u8> {
        let text: String = lines.iter().map(|line| format!("{line}{}", self.end)).collect();
        let marked = format!("\u{feff}{text}");
        let utf16 =
            |text: &str, bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect();
        match self.encoding {
            "utf-8" => text.into_bytes(),
            "utf-8-bom" => marked.into_bytes(),
            "utf-16le" => utf16(&text, u16::to_le_bytes),
            "utf-16be" => utf16(&text, u16::to_be_bytes),
            "utf-16le-bom" => utf16(&marked, u16::to_le_bytes),
            "utf-16be-bom" => utf16(&marked, u16::to_be_bytes),
            _ => text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect(),
        }
    }

    fn written(&self) -> Vec<u8> {
        self.encoded(&self.lines())
    }
}

/// Every separator, mark, encoding and line end; headings in turn.
fn forms() -> Vec<Form> {
    let mut forms = vec![];
    for separator in SEPARATORS {
        for decimal in ['.', ','] {
            for encoding in ENCODINGS {
                for end in ENDS {
                    let (heading, unit) = HEADINGS[forms.len() % HEADINGS.len()];
                    // Names with blanks need another separator, or quotes.
                    let is_blank = separator.trim().is_empty() && separator != "\t";
                    let heading =
                        if is_blank && heading.contains(' ') { "x_nm|z_nm\n" } else { heading };
                    let unit = if heading == "x_nm|z_nm\n" { 1.0 } else { unit };
                    let is_quoted = decimal == ',' && separator.starts_with(',');
                    forms.push(Form {
                        separator,
                        decimal,
                        is_quoted,
                        encoding,
                        end,
                        heading,
                        unit,
                    });
                }
            }
        }
    }
    forms
}

const TIP: &str = "tip FORM --resamples 2 --print sigma_metres --print critical_alpha.value --print centre --print apex";

fn printed(output: &Output) -> Vec<f64> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    text.lines().map(|line| line.parse().unwrap_or(f64::NAN)).collect()
}

/// What a command prints of a table, or its refusal.
fn asked(folder: &Folder, line: &str, bytes: &[u8]) -> Result<Vec<f64>, String> {
    folder.write("form.txt", bytes);
    let output = folder.stickslip(&line.replace("FORM", "form.txt"));
    match output.status.code() {
        Some(0) => Ok(printed(&output)),
        Some(2) if output.stdout.is_empty() => Err(said(&output)),
        _ => panic!("{line}: {}", said(&output)),
    }
}

#[test]
fn a_profile_in_any_form_is_the_same_tip() {
    let folder = Folder::new("table_forms");
    let plain = asked(&folder, TIP, &PLAIN.written()).unwrap();
    assert!((plain[0] / 30e-9 - 1.0).abs() < 0.02, "{plain:?}");
    let forms = forms();
    assert!(forms.len() > 290);
    for form in &forms {
        let found = asked(&folder, TIP, &form.written());
        let found = found.unwrap_or_else(|refused| panic!("{form:?}: {refused}"));
        if (form.unit - 1.0).abs() < 1e-12 {
            assert_eq!(found[..2], plain[..2], "{form:?}");
        }
        assert!((found[0] / plain[0] - 1.0).abs() < 1e-9, "{form:?}: {found:?} for {plain:?}");
        assert!((found[1] / plain[1] - 1.0).abs() < 1e-9, "{form:?}: {found:?} for {plain:?}");
        assert!(
            (found[2] * form.unit - plain[2]).abs() < 1e-6,
            "{form:?}: {found:?} for {plain:?}"
        );
        assert!((found[3] / plain[3] - 1.0).abs() < 1e-9, "{form:?}: {found:?} for {plain:?}");
    }
}

/// A minus of typography is one; a row without a value is left out, with a word.
#[test]
fn signs_and_missing_values_are_what_they_mean() {
    let folder = Folder::new("table_signs");
    let plain = asked(&folder, TIP, &PLAIN.written()).unwrap();
    let lines = PLAIN.lines();
    for minus in ['\u{2212}', '\u{2013}', '\u{2010}'] {
        let lines: Vec<String> =
            lines.iter().map(|line| line.replace('-', &minus.to_string())).collect();
        assert_eq!(asked(&folder, TIP, &PLAIN.encoded(&lines)).unwrap(), plain, "{minus}");
    }
    // Windows' own dash.
    let dashed: Vec<u8> =
        PLAIN.written().iter().map(|byte| if *byte == b'-' { 0x96 } else { *byte }).collect();
    assert_eq!(asked(&folder, TIP, &dashed).unwrap(), plain);
    for missing in ["NaN", "", "--", "#N/A", "null", "1.#QNAN"] {
        let mut with = lines.clone();
        for (at, row) in [
            (1, format!("{missing},1.5")),
            (20, format!("-77.5,{missing}")),
            (64, format!("999,{missing}")),
        ] {
            with.insert(at, row);
        }
        folder.write("missing.csv", PLAIN.encoded(&with));
        let output = folder.stickslip(&TIP.replace("FORM", "missing.csv"));
        assert_eq!(printed(&output), plain, "{missing}");
        assert!(said(&output).contains("3 of 64 rows have no value"), "{}", said(&output));
        assert!(said(&output).contains("line 2"), "{}", said(&output));
    }
}

/// Rows that cannot be read, anywhere: each refused with its line.
#[test]
fn a_damaged_row_is_refused_with_its_line() {
    let folder = Folder::new("table_damage");
    let damages: [fn(&str) -> String; 12] = [
        |row| row.replacen(|c: char| c.is_ascii_digit(), "O", 1),
        |row| format!("x{row}"),
        |row| format!("({row})"),
        |row| format!("{row} nm"),
        |row| row.replace(['.', ','], "·"),
        |row| row.split([';', ',', '\t']).next().unwrap_or_default().into(),
        |row| format!("{row};7;8"),
        |row| row.replace('.', "..").replace(',', ",,"),
        |row| format!("1e999{row}").replace("1e999-", "-1e999"),
        |row| row.replace(['0', '1', '2', '3', '4', '5', '6', '7', '8', '9'], "?"),
        |row| format!("1'{row}"),
        |_| "end of data".into(),
    ];
    let forms = [
        PLAIN,
        Form { separator: ";", decimal: ',', end: "\r\n", encoding: "utf-16le", ..PLAIN },
        Form { separator: "\t", end: "\r", heading: "x|z\nnm|nm\n", ..PLAIN },
        Form { separator: ";", heading: "", ..PLAIN },
    ];
    for form in forms {
        let whole = form.lines();
        let above = whole.len() - rows().len();
        for (which, damage) in damages.iter().enumerate() {
            for at in [above, above + 30, whole.len() - 1] {
                let mut lines = whole.clone();
                lines[at] = damage(&lines[at]);
                let line = format!("{TIP} --unit nm");
                let refused = asked(&folder, &line, &form.encoded(&lines));
                let row = &lines[at];
                let Err(refused) = refused else {
                    // Words above all rows are a title.
                    assert!(at == above && which == 11, "{form:?}, {row}: {refused:?}");
                    continue;
                };
                let named = format!("line {}", at + 1);
                assert!(refused.contains(&named), "{form:?}, {row}, {named}: {refused}");
            }
        }
    }
    // All of the first half: they are rows all the same.
    let mut lines = PLAIN.lines();
    lines[1..31].iter_mut().for_each(|line| *line = line.replace('.', " "));
    let refused = asked(&folder, TIP, &PLAIN.encoded(&lines)).unwrap_err();
    assert!(refused.contains("line 2"), "{refused}");
}

/// Decimal commas between commas are three columns or four: no loop is made of a profile, nor another profile.
#[test]
fn what_may_be_read_in_two_ways_is_refused() {
    let folder = Folder::new("table_ambiguous");
    let commas = Form { decimal: ',', ..PLAIN };
    let integers: String =
        (0..40).map(|i| format!("{i},{},{}\n", 10 + i % 3, 10 + (i * 7) % 83)).collect();
    for (line, bytes) in [
        (TIP, commas.written()),
        ("fit --ripple FORM", commas.written()),
        ("fit --friction FORM", commas.written()),
        ("fit --friction FORM", integers.clone().into_bytes()),
        ("fit --friction FORM", format!("way,force\n{integers}").into_bytes()),
        (TIP, integers.into_bytes()),
    ] {
        let refused = asked(&folder, line, &bytes).unwrap_err();
        assert!(refused.contains("line "), "{line}: {refused}");
    }
}

/// A unit that is none is asked for; one of something else is refused; `--unit` does not overrule the file.
#[test]
fn a_unit_is_read_or_asked_for() {
    let folder = Folder::new("table_units");
    let with = |heading: &'static str| Form { separator: ";", heading, ..PLAIN }.written();
    for heading in [
        "x (furlong)|z\n",
        "x [?m]|z\n",
        "t (s)|z\n",
        "x_ms|z\n",
        "x|z\n(furlong)|(nm)\n",
        "x_nm|z_nm\num|nm\n",
    ] {
        let refused = asked(&folder, TIP, &with(heading)).unwrap_err();
        assert!(refused.contains("unit"), "{heading}: {refused}");
    }
    let bare = asked(&folder, &format!("{TIP} --unit nm"), &with("x (furlong)|z\n")).unwrap();
    assert_eq!(bare, asked(&folder, TIP, &PLAIN.written()).unwrap());
    for heading in ["x_foo|z\n", "x|z\n", ""] {
        folder.write("form.csv", with(heading));
        folder.prints("tip form.csv --resamples 2 -o tip.json");
        let tip = folder.json("tip.json");
        assert!(tip["sigma_metres"].is_null() && tip["parameters"]["unit"].is_null(), "{heading}");
    }
    folder.write("form.csv", PLAIN.written());
    folder.refuses("tip form.csv --unit um", &["--unit um", "another unit"]);
    // A length without a unit is refused, whatever the unit of the data.
    for line in [
        "tip form.csv --sigma 30",
        "tip form.csv --unit nm --sigma 30",
        "run --alpha 1 --r 1 --until 20 --sigma 30",
        "stability --r 1 --sigma 3e-8",
        "units --damping 1mNs/m --stiffness 0.05N/m --sigma 30 --slope-force 5nN --alpha 1.2 --r 1",
    ] {
        folder.refuses(line, &["has no unit", "such as 30nm"]);
    }
    folder.prints("tip form.csv --sigma 30nm --resamples 2 -o tip.json");
    let found = folder.json("tip.json")["sigma"]["value"].as_f64().unwrap();
    assert!((found - 30.0).abs() < 1e-12, "{found}");
}

/// The numbers of a row, by its index.
type Row<'a> = &'a dyn Fn(i32) -> [f64; 3];

/// The tables of every other command.
#[test]
fn every_command_reads_every_form() {
    let folder = Folder::new("table_commands");
    let table = |names: &str, columns: usize, row: &dyn Fn(i32) -> [f64; 3], form: &Form| {
        let names: Vec<&str> = names.split(',').collect();
        let mut lines = vec![names.join(form.separator)];
        for i in 0..41 {
            let values = row(i);
            let cells = values[..columns].iter().map(|v| {
                let text = format!("{v:.6}").replace('.', &form.decimal.to_string());
                if form.is_quoted { format!("\"{text}\"") } else { text }
            });
            lines.push(cells.collect::<Vec<_>>().join(form.separator));
        }
        form.encoded(&lines)
    };
    let gaussian = |i: i32| {
        let x = 0.2 * f64::from(i);
        [x, if i == 40 { 0.0 } else { (-0.5 * x * x).exp() }, 0.0]
    };
    let wave = |i: i32| [0.5 * f64::from(i), 0.1 * f64::from(i % 7) - 0.3, 0.0];
    let path = |i: i32| [f64::from(i), 1.5 * f64::from(i), 0.0];
    let area = |i: i32| [0.5 * f64::from(i / 8), 0.25, 12.5];
    let run =
        "run --tip gaussian --alpha 0.6 --r 1 --until 40 --print regime --print samples.x0.1999";
    let cases: [(&str, &str, usize, Row); 5] = [
        ("stability --r 1 --tip-file FORM --print critical.alpha", "x,f", 2, &gaussian),
        (&format!("{run} --force-file FORM"), "t,force", 2, &wave),
        (&format!("{run} --initial-surface FORM"), "x,u", 2, &wave),
        (&format!("{run} --support-path FORM"), "t,R", 2, &path),
        (
            "raster --tip gaussian --alpha 0.3 --r 1 --area FORM --print volume",
            "y,start,length",
            3,
            &area,
        ),
    ];
    for (line, names, columns, row) in cases {
        let asked = |bytes: Vec<u8>| {
            folder.write("form.txt", bytes);
            let output = folder.stickslip(&line.replace("FORM", "form.txt"));
            assert!(output.status.success(), "{line}: {}", said(&output));
            output.stdout
        };
        let plain = asked(table(names, columns, row, &PLAIN));
        // One in each encoding, of changing separators, marks and line ends.
        for form in forms().iter().step_by(53) {
            assert_eq!(asked(table(names, columns, row, form)), plain, "{line}: {form:?}");
        }
        // Nothing is left out of these.
        let text = String::from_utf8(table(names, columns, row, &PLAIN)).unwrap();
        for (damaged, named) in [
            (text.replacen("\n0.", "\nO.", 1), "line 2"),
            (text.clone() + "NaN,1,2".split_at(2 * columns + 1).0, "line 43"),
            (text.clone() + "end", "line 43"),
        ] {
            folder.write("form.txt", damaged);
            folder.refuses(&line.replace("FORM", "form.txt"), &[named]);
        }
        let swapped: Vec<&str> = names.split(',').rev().collect();
        folder.write("form.txt", table(&swapped.join(","), columns, row, &PLAIN));
        folder.refuses(&line.replace("FORM", "form.txt"), &["are needed"]);
    }
}

/// Onsets with velocities in um/s and wavelengths with velocities in nm/s are of one series, as are their loads and lengths.
#[test]
fn files_with_different_units_meet() {
    let folder = Folder::new("table_meet");
    folder.prints("boundary --r-range 0.4:1.6:7 -o boundary.csv");
    let text = String::from_utf8(folder.read("boundary.csv")).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|n| n.parse().unwrap()).collect())
        .collect();
    // σ = 30 nm; r = 2 v/(um/s), α = 0.5 N/nN; a hundredth of scatter by a fixed rule.
    let off = |i: usize, k: usize| 1.0 + 0.01 * (((7 * i + 3 * k) % 5) as f64 - 2.0) / 2.0;
    let onsets = |v: f64, load: f64, heading: &str| {
        let row = |(i, r): (usize, &Vec<f64>)| {
            format!("{},{}\n", v * 0.5 * r[1], load * 2.0 * r[2] * off(i, 1))
        };
        heading.to_owned() + &rows.iter().enumerate().map(row).collect::<String>()
    };
    let wavelengths = |v: f64, load: f64, length: f64, heading: &str| {
        let row = |(i, r): (usize, &Vec<f64>)| {
            let wavelength = 30.0 * std::f64::consts::TAU / r[0] * off(i, 2);
            format!("{},{},{}\n", v * 0.5 * r[1], load * 2.0 * r[2] * 1.02, length * wavelength)
        };
        heading.to_owned() + &rows.iter().enumerate().map(row).collect::<String>()
    };
    folder.write("onsets.csv", onsets(1.0, 1.0, "v (um/s),load (nN)\n"));
    folder.write("same.csv", wavelengths(1.0, 1.0, 1.0, "v (um/s),load (nN),L (nm)\n"));
    folder.write("other.csv", wavelengths(1e3, 1e-3, 1e-3, "v (nm/s),load (uN),L (um)\n"));
    folder.write("none.csv", wavelengths(1.0, 1.0, 1.0, "v,load,L\n"));
    let fit = |file: &str| {
        folder.prints_json(&format!(
            "fit --onsets onsets.csv --wavelengths {file} --width 30 --unit nm"
        ))
    };
    let (same, other) = (fit("same.csv"), fit("other.csv"));
    assert_eq!(other["parameters"]["unit"], "nm");
    let values = |fit: &Value| -> Vec<(String, f64)> {
        let numbers = fit["numbers"].as_array().unwrap().iter();
        numbers.map(|n| (n["name"].to_string(), n["estimate"]["value"].as_f64().unwrap())).collect()
    };
    let (same, other) = (values(&same), values(&other));
    assert_eq!(same.len(), 2, "{same:?}");
    for ((name, wanted), (_, found)) in same.iter().zip(&other) {
        assert!((found / wanted - 1.0).abs() < 1e-6, "{name}: {found} for {wanted}");
    }
    folder.refuses("fit --onsets onsets.csv --wavelengths none.csv", &["none.csv", "has no unit"]);
}
