//! The text of documents: the same bytes by any number of threads, and errors of the output.

use serde_json::{Value, json};
use std::io::{self, Write};
use stickslip::List;

/// Lists of any length, with any number and any text, have the same bytes on any number of threads.
#[test]
fn bytes_do_not_depend_on_threads() {
    let numbers = (0..60_000_u64)
        .map(|n| f64::from_bits(n.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
        .chain([0.0, -0.0, 1.0, 1e300, f64::MIN_POSITIVE, f64::NAN, f64::INFINITY]);
    let text = "\u{7f}\u{9b}31m ÿ \u{ff} \"σ\"\n \"lines\":[]";
    let numbers: Vec<f64> = numbers.collect();
    let mut rows: Vec<Value> = numbers.chunks(50).map(|row| json!({ "row": row })).collect();
    rows.push(json!({ text: text, "lines": [1], "none": null }));
    let document = |first: &[Value], second: &[Value]| {
        let history = json!({ "lines": second });
        json!([text, { "lines": first, "number": 7 }, { "count": 1, "history": history }])
    };
    for second in [0, 1, 5, rows.len()] {
        let mut alone = vec![];
        stickslip::write(&mut alone, &document(&rows, &rows[..second])).unwrap();
        assert!(alone.len() > 20 << 16, "{}", alone.len());
        for threads in [1, 2, 3, 64] {
            let (mut out, lists) = (vec![], [List::of(&rows), List::of(&rows[..second])]);
            let frame = document(&[], &[]);
            stickslip::write_lists(&mut out, &frame, ("lines", &lists), threads).unwrap();
            assert!(out == alone, "{second} {threads} threads");
        }
    }
}

/// An output that fails ends the work.
#[test]
fn an_error_is_returned() {
    struct Full(usize);
    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let numbers = vec![0.1_f64.sqrt(); 200_000];
    for room in [0, 300_000, 2_000_000] {
        let (frame, lists) = (json!({ "lines": [] }), [List::of(&numbers)]);
        let written = stickslip::write_lists(&mut Full(room), &frame, ("lines", &lists), 2);
        let error = written.unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }
}
