//! Is it told what the noise of a raw table does to αc? Judged by αc of the footprint that was put in.

use crate::noisy_table::table;
use stickslip_measurement::{Verdict, judge};
use stickslip_stability::critical;
use stickslip_tip::{TipFunction, Wider};

/// Relative errors of αc that are told, and from which on a table is refused.
const TOLD: f64 = 0.02;
const REFUSED: f64 = 0.1;

/// αc(1) of the Gaussian is 1.879427, DESIGN's reference value to 30 digits.
#[test]
fn noise_that_decides_is_seen_whenever_it_does() {
    let (mut decided, mut sound) = (0, 0);
    for (i, rows) in [20, 40, 60, 120, 200].into_iter().cycle().take(28).enumerate() {
        let noise = [0.0, 1e-3, 0.02, 0.03][i % 4];
        let (x, f) = table(rows, noise, i as u64);
        let tip = TipFunction::table(&x, &f).unwrap();
        let off = (critical(&Wider::default(), &tip, 1.0).unwrap().alpha / 1.879_427).ln().abs();
        let verdict = judge((&x, &f), &tip);
        match verdict {
            Verdict::Sound => assert!(off < 2.0 * TOLD, "{rows} {noise}: off by {off}"),
            Verdict::Felt { .. } => assert!(off < 1.2 * REFUSED, "{rows} {noise}: {off}"),
            Verdict::Decided { fitted, .. } => {
                let fitted = fitted.unwrap();
                assert!((fitted / 1.879_427 - 1.0).abs() < REFUSED, "{rows} {noise}: {fitted}");
            }
            Verdict::Few { .. } => panic!("{rows} rows"),
        }
        decided += usize::from(matches!(verdict, Verdict::Decided { .. }));
        sound += usize::from(verdict == Verdict::Sound);
        assert!(noise > 0.0 || verdict == Verdict::Sound, "{rows}: {verdict:?}");
    }
    assert!(decided >= 5 && sound >= 10, "{decided} {sound}");
    let (x, f) = table(12, 0.0, 0);
    let few = judge((&x, &f), &TipFunction::table(&x, &f).unwrap());
    assert_eq!(few, Verdict::Few { rows: 12 });
}
