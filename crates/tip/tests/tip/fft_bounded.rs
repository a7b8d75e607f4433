//! Does the `fft` memory stay the same, in bounded room, however far the tip goes? Judged by one that was
//! told only of what lies within reach, and by the number of words in its saved state.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use stickslip_tip::memory::{Groove, Policy, Retreat};
use stickslip_tip::state::{Saved, State};
use stickslip_tip::{MemoryChoice, STAGES, Stages, TipFunction, nodes_and_weights};

fn tip() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).unwrap()
}

fn fft() -> Policy {
    Policy::new(MemoryChoice::Fft, tip(), 0.0, Retreat::Small).unwrap()
}

fn stride(memory: &mut Policy, length: f64) {
    let (c, b) = nodes_and_weights();
    memory.remember(&c.map(|c| length * c), &b);
}

fn words(memory: &Policy) -> usize {
    let mut state = State::default();
    memory.save(&mut state);
    state.words().len()
}

fn groove(memory: &mut Policy) -> (Stages, Stages) {
    let at: Stages = std::array::from_fn(|i| 0.5 * i as f64 - 1.0);
    let (mut slope, mut curvature) = ([0.0; STAGES], [0.0; STAGES]);
    memory.groove(&at, &mut Groove::new(&mut slope, &mut curvature));
    (slope, curvature)
}

#[test]
fn room_is_bounded_and_the_groove_is_that_of_what_is_within_reach() {
    let (mut far, mut near) = (fft(), fft());
    let mut largest = 0;
    for i in 0..40_000 {
        stride(&mut far, 1.0);
        if i >= 40_000 - 60 {
            stride(&mut near, 1.0);
        }
        if i % 1000 == 0 {
            largest = largest.max(words(&far));
        }
    }
    println!("{largest} words at most");
    // Two numbers a cell, 65,536 to 131,072 cells.
    assert!((200_000..300_000).contains(&largest), "{largest} words");
    assert_eq!(far.forgotten(), None);
    let ((a, b), (c, d)) = (groove(&mut far), groove(&mut near));
    for i in 0..STAGES {
        assert!((a[i] - c[i]).abs() < 1e-13 && (b[i] - d[i]).abs() < 1e-13, "{i}");
    }
}

#[test]
fn a_tip_that_comes_back_to_what_was_dropped_is_told() {
    let mut memory = fft();
    (0..30_000).for_each(|_| stride(&mut memory, 1.0));
    let way_back = (0..30_000).find(|_| {
        stride(&mut memory, -1.0);
        memory.forgotten().is_some()
    });
    let kept = memory.forgotten().unwrap();
    println!("forgotten {way_back:?} widths behind, {kept} are kept");
    assert!(way_back.unwrap() as f64 > kept - 40.0);
    assert!(kept > 10_000.0);
}
