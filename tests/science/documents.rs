//! What is read back of documents: a run whole, what is something else refused by its beginning.

use std::io::{self, Read};
use stickslip_documents::{
    RegimeName, RunDocument, RunEnd, RunParameters, SteadyState, SweepDocument, WorkDocument, read,
    read_from,
};
use stickslip_tip::{Model, Scenario, TipFunction, run};

/// Counts what is read of an endless stream.
struct Endless<'a>(&'a [u8], u64);

impl Read for Endless<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        for byte in buffer.iter_mut() {
            let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
            (*byte, self.0) = (*first, rest);
        }
        self.1 += buffer.len() as u64;
        Ok(buffer.len())
    }
}

#[test]
fn what_is_something_else_is_told_by_its_beginning() {
    let begins = [
        ("", "not a whole JSON document"),
        ("0.1,0.2\n", "not a whole JSON document"),
        ("{\"format\":\"stickslip/run\",\"format_version\":1,", "format is stickslip/run"),
        ("{\"format\":\"stickslip/sweep\",\"format_version\":7,", "format_version is 7"),
        ("{\"format\":\"stickslip/sweep\",\"format_version\":1,\"points\":[", "damaged"),
        ("{\"points\":[1,2,3],\"format_version\":1,", "not a whole"),
    ];
    for (begins, words) in begins {
        let mut endless = Endless(begins.as_bytes(), 0);
        let read = read_from::<SweepDocument>(&mut endless, SweepDocument::FORMAT);
        let said = read.unwrap_err().to_string();
        assert!(said.contains(words), "{begins}: {said}");
        assert!(endless.1 < 4 << 16, "{begins}: {} bytes", endless.1);
    }
}

/// A document is the run: scenario and motion come back from its text to the last bit.
#[test]
fn a_run_comes_back_from_its_document() {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 1.0).unwrap();
    let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 40.0) };
    let done = run(&scenario).unwrap();
    let end = RunEnd {
        end: 40.0,
        regime: RegimeName::Transient,
        oscillation: None,
        creep: None,
        transient: None,
        remarks: vec![],
        interrupted: false,
        work: WorkDocument {
            memory: done.memory.into(),
            memory_reason: String::new(),
            steps: done.work.steps,
            rejected: done.work.rejected,
            newton_iterations: done.work.newton_iterations,
            series: done.work.series,
            switches: done.work.switches,
            seconds: 0.0,
        },
    };
    let document = RunDocument::new(
        RunParameters::of(&scenario, None, &[], None),
        SteadyState::of(&scenario.model),
        &[],
        Some((&done.trajectory).into()),
        end,
    );
    let text = serde_json::to_string(&document).unwrap();
    let back: RunDocument = read(&text, RunDocument::FORMAT).unwrap();
    let again = run(&back.parameters.scenario().unwrap()).unwrap();
    let trajectory = back.trajectory().unwrap();
    for t in [16.5, 25.0, 40.0] {
        let bits = [&done.trajectory, &again.trajectory, &trajectory].map(|m| m.l(t).to_bits());
        assert_eq!(bits, [bits[0]; 3], "t = {t}");
    }
    let other = read::<RunDocument>(&text, "stickslip/cycle").unwrap_err();
    assert!(other.to_string().contains("is needed"), "{other}");
    let none = RunDocument { history: None, ..back }.trajectory().unwrap_err();
    assert!(none.to_string().contains("--history all"), "{none}");
}
