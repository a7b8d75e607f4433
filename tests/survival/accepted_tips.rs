//! Tips as users bring them: tables of 8 to 2,000 rows, some of them noisy, lobes from 0.05 to 3 widths, several peaks.
//! Every command takes each of them, or says why not; whatever a run settles on, the cycle is found, or there is a
//! reason.

use crate::folder::{Folder, Measured};
use crate::tips::{Brought, Kind, tables, tips};
use serde_json::Value;
use std::collections::BTreeMap;
use std::time::Duration;

/// Of these α/αc, one each.
const ABOVE: [f64; 4] = [1.003, 1.03, 1.1, 1.4];
/// No command is given more processor time, in seconds.
const MOST: u64 = 120;
/// A cycle that is the same as that of the run, by its period, relatively.
const SAME: f64 = 1e-2;
/// Multipliers are wrong where the error that is stated of them tells nothing of stability. Footprints with corners in
/// their curvature have errors of some 1e-3 in long slips.
const TELLS_NOTHING: f64 = 1e-2;

#[derive(Default)]
struct Count {
    /// Whether what takes long is asked for too.
    is_campaign: bool,
    tips: usize,
    /// At the first command, with a reason.
    refused: usize,
    cycles: usize,
    settled: usize,
    /// What commands said where they gave nothing.
    reasons: Vec<String>,
    wrong: Vec<String>,
    spent: BTreeMap<&'static str, (Duration, Duration)>,
}

/// Of these tips those from `from` on.
fn accepted(name: &str, brought: Vec<Brought>, from: usize, is_campaign: bool) {
    let folder = Folder::new(&format!("{name}_{from}_{}", brought.len()));
    let mut count = Count { is_campaign, ..Count::default() };
    for (i, tip) in brought.into_iter().enumerate().skip(from) {
        count.judge(&folder, i, &tip);
    }
    let Count { tips, refused, cycles, settled, reasons, wrong, spent, .. } = count;
    println!(
        "{tips} tips, {refused} refused, {settled} runs that settled on stick-slip, {cycles} cycles, {} reasons",
        reasons.len()
    );
    for (name, (all, longest)) in spent {
        println!("    {name}: {all:.1?}, at most {longest:.1?}");
    }
    wrong.iter().for_each(|line| println!("    WRONG {line}"));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_command_takes_accepted_tips() {
    // A table, and lobes whose cycle is found in no time.
    accepted("accepted_tips", tips(2), 1, false);
    accepted("accepted_tips", tips(5), 4, false);
}

#[test]
#[ignore = "400 tips take an hour: make survive"]
fn every_command_takes_four_hundred_accepted_tips() {
    let from = number("FROM", 0);
    accepted("accepted_tips", tips(from + number("TIPS", 400)), from, true);
}

/// Some forty more than are asked for: noise decides those that are refused.
#[test]
#[ignore = "540 tables take an hour: make survive"]
fn every_command_takes_five_hundred_accepted_tables() {
    let from = number("FROM", 0);
    accepted("accepted_tables", tables(from + number("TIPS", 540)), from, true);
}

fn number(name: &str, otherwise: usize) -> usize {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(otherwise)
}

impl Count {
    fn judge(&mut self, folder: &Folder, i: usize, tip: &Brought) {
        folder.write(tip.name, &tip.contents);
        let name = format!("{i:3} {:?}", tip.kind);
        let mut file = tip.name;
        if let Kind::Profile(..) = tip.kind {
            file = "tip.json";
            let line = "tip profile.csv --both --unit nm --sigma 1nm --resamples 50 -o tip.json --print terms";
            if self.of(folder, &name, "tip", line).is_err() {
                self.refused += 1;
                return;
            }
        }
        self.tips += 1;
        let model = format!("--tip-file {file} --r 1");
        let mut said = vec![];
        let mut of = |command: &'static str, options: String| {
            let found = self.of(folder, &name, command, &format!("{command} {model} {options}"));
            let (value, words) = found.map_or_else(|why| (None, why), |v| (Some(v), String::new()));
            if !words.is_empty() {
                said.push(format!("{command}: {words}"));
            }
            (value, words)
        };
        let (onset, _) = of("stability", String::new());
        if onset.is_none() && file == "tip.csv" {
            self.refused += 1;
            println!("{name}: {}", said.join(" "));
            return;
        }
        let onset = onset.and_then(|found| found["critical"]["alpha"].as_f64());
        let critical = onset.unwrap_or(1.0);
        let (below, alpha) = (0.9 * critical, ABOVE[(i + i / 4) % ABOVE.len()] * critical);
        // Motions settle within a time that grows towards onset; next to it nobody waits for it.
        let above = alpha / critical - 1.0;
        let until = if above < 0.01 { 80.0 } else { (200.0 + 8.0 / above).min(500.0) };
        let run = format!("--alpha {alpha} --kick 0.3 --until {until} --tolerance 1e-7");
        // Of many tables cycles are known no better than to the second.
        let tolerance = ["1e-9", "1e-6"][(i / 2) % 2];
        let (run, _) = of("run", format!("{run} --history none --sample-every 500"));
        let (cycle, why) =
            of("cycle", format!("--alpha {alpha} --points 50 --tolerance {tolerance}"));
        let branch = format!("--over alpha --to {} --most-points 3", 1.1 * critical);
        of("continue", format!("{branch} --tolerance {tolerance}"));
        of("sweep", format!("--alpha {below}:{alpha}:2 --threads 1 --tolerance {tolerance}"));
        of("response", format!("--alpha {below} --pulse 1e-4,20,0.5 --until 40"));
        let start = "--start flat --until 16 --kick 0.1 --tolerance 1e-7 --time-limit 20";
        of("compare", format!("--alpha {alpha} {start}"));
        if self.is_campaign {
            said.extend(self.kept(folder, &name, &format!("{model} --alpha {alpha}"), file));
        }
        let judged = self.beside(run.as_ref(), cycle.as_ref(), &why);
        if let Err(wrong) = &judged {
            self.wrong.push(format!("{name} at {:.3} αc: {wrong}", alpha / critical));
        }
        let judged = judged.unwrap_or_else(|wrong| format!("WRONG {wrong}"));
        println!("{name} at {alpha}, {:.3} αc: {judged}", alpha / critical);
        said.iter().for_each(|words| println!("        {words}"));
    }

    /// What is said of a run that is kept and verified, which takes many times as long as the run, and of a boundary.
    fn kept(&mut self, folder: &Folder, name: &str, model: &str, file: &str) -> Vec<String> {
        let kept = "--until 30 --tolerance 1e-5 -o run.json --print work.steps";
        let lines = [
            ("run", format!("run {model} --kick 0.3 {kept}")),
            ("verify", "verify run.json".to_owned()),
            ("boundary", format!("boundary --tip-file {file} --r-range 0.7:1.3:3")),
        ];
        let mut said = vec![];
        for (command, line) in lines {
            let words = self.of(folder, name, command, &line).err();
            said.extend(words.map(|words| format!("{command}: {words}")));
        }
        said
    }

    /// What a command gives, or what it says.
    fn of(
        &mut self,
        folder: &Folder,
        name: &str,
        command: &'static str,
        line: &str,
    ) -> Result<Value, String> {
        let Measured { output, took, .. } = folder.measured_within(line, MOST);
        let (all, longest) = self.spent.entry(command).or_default();
        (*all, *longest) = (*all + took, (*longest).max(took));
        let words = String::from_utf8_lossy(&output.stderr).trim().to_string();
        let code = output.status.code();
        let said = words.contains("stickslip: ") && !words.contains("panicked");
        match code {
            Some(0) => match serde_json::from_slice(&output.stdout) {
                Ok(found) if !words.contains("panicked") => return Ok(found),
                _ => self.wrong.push(format!("{name}: {line}: no document: {words}")),
            },
            Some(1 | 2) if said => self.reasons.push(words.clone()),
            _ => {
                self.wrong.push(format!("{name}: {line}: {:?}, {took:.1?}: {words}", output.status))
            }
        }
        Err(words)
    }

    /// A run beside the cycle at the same parameters.
    fn beside(
        &mut self,
        run: Option<&Value>,
        cycle: Option<&Value>,
        why: &str,
    ) -> Result<String, String> {
        let settled = run.filter(|run| run["regime"] == "stick-slip");
        self.settled += usize::from(settled.is_some());
        let regime = run.map_or("no run".to_owned(), |run| run["regime"].to_string());
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let Some(cycle) = cycle else {
            // That nothing was found is no reason where there is something to find.
            let missed = settled.is_some() && why.contains("no cycle was");
            let said = format!("{regime}, {why}");
            return if missed { Err(said) } else { Ok(said) };
        };
        self.cycles += 1;
        let of_cycle = (number(&cycle["period"]), number(&cycle["period_error"]));
        let said = format!(
            "{regime}, cycle T {:.9}({:.1e}), amplitude {:.6}, stable {}, {} slips",
            of_cycle.0, of_cycle.1, cycle["amplitude_x0"], cycle["stable"], cycle["slips"]
        );
        if number(&cycle["floquet_error"]) > TELLS_NOTHING || number(&cycle["amplitude_x0"]) < 1e-6
        {
            return Err(format!("{said}, multiplier off by {}", cycle["floquet_error"]));
        }
        let Some(oscillation) = settled.map(|run| &run["oscillation"]) else { return Ok(said) };
        let of_run = (number(&oscillation["period"]), number(&oscillation["period_error"]));
        let said = format!("{said}, run T {:.9}({:.1e})", of_run.0, of_run.1);
        let off = (of_run.0 - of_cycle.0).abs();
        let same = off < SAME * of_run.0 && cycle["stable"] == true;
        if same && off > of_run.1 + of_cycle.1 {
            return Err(format!("{said}: periods apart by {off:.1e}"));
        }
        Ok(if same { said } else { format!("{said}: ANOTHER cycle") })
    }
}
