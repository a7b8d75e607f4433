//! The text of documents: the same bytes by any number of threads, and errors of the output.

use serde_json::json;
use std::io::{self, Write};

/// Documents of several pieces, with any number and any text, have the same bytes on any number of threads.
#[test]
fn bytes_do_not_depend_on_threads() {
    let numbers: Vec<f64> = (0..60_000_u64)
        .map(|n| f64::from_bits(n.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
        .chain([0.0, -0.0, 1.0, 1e300, f64::MIN_POSITIVE, f64::NAN, f64::INFINITY])
        .collect();
    let text = "\u{7f}\u{9b}31m ÿ \u{ff} \"σ\"\n";
    let document = json!({ text: { "numbers": numbers, "count": 7, "none": null, "text": text } });
    let written = |threads| {
        let mut out = vec![];
        stickslip::write_on_threads(&mut out, &(&document, &numbers), threads).unwrap();
        out
    };
    let alone = written(1);
    assert!(alone.len() > 20 << 16, "{}", alone.len());
    for threads in [2, 3, 64] {
        assert!(written(threads) == alone, "{threads} threads");
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
        let error = stickslip::write_on_threads(&mut Full(room), &numbers, 2).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }
}
