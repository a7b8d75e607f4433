//! Our stepper on a window and on the whole grid against the crate's.

use crate::by_crate;
use crate::common::{Kicked, distance, main_case};
use stickslip_grid::{GridError, Method, Run, Stepping, Work};

fn both(case: &Kicked, spacing: f64, stepping: Stepping) -> Result<[Run; 2], GridError> {
    let uniform = Method::Uniform { spacing, from: 3.0, to: 47.0 };
    Ok([case.run(&uniform, &stepping)?, case.run(&Method::Windowed { spacing }, &stepping)?])
}

#[test]
fn given_the_same_steps_they_agree_to_round_off() -> Result<(), GridError> {
    let (case, stepping) = (main_case(20.0), Stepping::fixed(0.04));
    let (x0, u, steps) = by_crate::run(&case, (0.05, 3.0, 47.0), &stepping);
    for ours in both(&case, 0.05, stepping)? {
        // 500 steps, each rounding x0 ≈ 35 to 7e-15, and a growing motion.
        assert!(distance(&x0, &ours.x0) < 1e-11);
        assert!(distance(&u, &ours.u) < 1e-11);
        assert_eq!(steps, ours.work.steps);
    }
    Ok(())
}

/// Same tolerances, same rule, so the same steps until round-off decides about one of them. At 1e-8 half
/// of the steps are rejected: the slope has a kink at every cell. What the kinks leave, 1e-5, is still far
/// below the grid's own 4e-3.
#[test]
fn left_to_choose_their_steps_they_agree_to_the_tolerance() -> Result<(), GridError> {
    for (stepping, bound) in [(Stepping::ode45(), 1e-9), (Stepping::absolute(1e-8), 1e-4)] {
        let case = main_case(20.0);
        let (x0, ..) = by_crate::run(&case, (0.05, 3.0, 47.0), &stepping);
        for ours in both(&case, 0.05, stepping)? {
            let difference = distance(&x0, &ours.x0);
            println!("{stepping:?}: {difference:.1e}, {:?}", ours.work);
            assert!(difference < bound, "{difference:e}: {:?}", ours.work);
        }
    }
    Ok(())
}

/// The window saves cells and nothing else: 432 (10.8 · 2 / 0.05) instead of 881.
#[test]
fn the_window_updates_only_cells_within_reach() -> Result<(), GridError> {
    let [uniform, windowed] = both(&main_case(20.0), 0.05, Stepping::fixed(0.04))?;
    let Work { steps, rejected, right_hand_sides, cells_updated } = windowed.work;
    assert_eq!((rejected, right_hand_sides), (0, 6 * steps + 1));
    assert!((431 * right_hand_sides..=433 * right_hand_sides).contains(&cells_updated));
    let all = Work { cells_updated: 881 * right_hand_sides, ..windowed.work };
    assert_eq!(uniform.work, all);
    Ok(())
}
