//! The paper's scaling laws (Figs. 2, 3, 5): amplitude² and wavelength are linear in α - αc and in r - rc. Cycles and
//! runs, which share no equation solver, must give the same; and the slopes at onset are those of the amplitude
//! equation (stability/onset.rs), which is derived from neither.

use crate::acceptance::Acceptance;
use stickslip_cycles::{DEFAULT_TOLERANCE, Measured, Parameter, scaling};
use stickslip_stability::{critical_r, onset};
use stickslip_tip::{TipFunction, Wider};

fn tip() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).unwrap()
}

fn judge(name: &str, error: f64, bound: f64) {
    Acceptance { floor: bound, slack: 0.0 }.judge(name, error.abs(), 0.0);
}

const CYCLES: Measured = Measured::Cycles(DEFAULT_TOLERANCE);

#[test]
fn at_onset_the_slopes_are_those_of_the_amplitude_equation() {
    let born = onset(&tip(), 1.0).unwrap();
    let distances = [2e-5, 4e-5, 6e-5, 8e-5, 1e-4];
    let law = scaling(&tip(), (Parameter::Alpha, 1.0), &distances, CYCLES).unwrap();
    judge("αc", law.critical - born.critical.alpha, 1e-15);
    let squared = law.amplitude_x0_squared;
    judge("amplitude²", squared.slope / born.amplitude_squared_slope - 1.0, 1e-3);
    judge("amplitude² at onset", squared.intercept, 1e-7);
    judge("wavelength", law.wavelength.slope / born.period_slope - 1.0, 1e-3);
    judge("wavelength at onset", law.wavelength.intercept - born.critical.wavelength, 1e-7);
    // (37) ties the amplitudes of surface and tip.
    let ratio = law.amplitude_u_squared.unwrap().slope / squared.slope;
    judge("ratio of amplitudes", ratio.sqrt() - 2.121_387_9, 1e-4);
}

#[test]
fn cycles_and_runs_obey_the_same_laws() {
    let rc = critical_r(&Wider::default(), &tip(), 1.0).unwrap().r;
    let alpha = (Parameter::Alpha, 1.0, [0.004, 0.008, 0.012, 0.016]);
    let r = (Parameter::R, 1.0, [-0.004, -0.008, -0.012, -0.016]);
    for (over, other, distances) in [alpha, r] {
        let of = |measured| scaling(&tip(), (over, other), &distances, measured).unwrap();
        let (cycles, runs) = (of(CYCLES), of(Measured::Runs(1e-10)));
        for (a, b) in cycles.points.iter().zip(&runs.points) {
            judge("amplitude", a.amplitude_x0 - b.amplitude_x0, 1e-6);
            judge("wavelength", a.wavelength - b.wavelength, 1e-6);
        }
        let slopes = [&cycles, &runs].map(|law| law.amplitude_x0_squared.slope);
        judge("slope", slopes[0] / slopes[1] - 1.0, 1e-5);
        assert!(runs.amplitude_u_squared.is_none());
        // Amplitudes grow into the unstable side, which in r lies below.
        assert_eq!(slopes[0] > 0.0, over == Parameter::Alpha);
    }
    assert!((rc - 0.959_969_050_524).abs() < 1e-11);
}

#[test]
fn on_the_stable_side_there_is_no_law() {
    for (over, wrong) in [(Parameter::Alpha, -0.01), (Parameter::R, 0.01)] {
        assert!(scaling(&tip(), (over, 1.0), &[wrong], CYCLES).is_err());
    }
}
