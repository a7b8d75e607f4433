//! Small ripples of nonlinear rasters under the wider law grow from line to line as linear theory says
//! (`stickslip_stability::Raster`, which knows nothing of runs): with inertia, healing and a depth limit, alone and
//! together. A weak pulse on the first line, with either sign; half the difference is linear. What is measured is what
//! deviates of the density that a line leaves, ∫ w e^{-px0(t)} e^{t/T} dt with p = iq + 1/(rT), over the motion itself.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex64;
use stickslip_raster::{Line, Path, Plan, Scanning};
use stickslip_stability::{Raster, RasterCritical, RasterPath, StabilityError};
use stickslip_tip::{Footprint, Force, Model, Pulse, TipFunction, Wider};

const WEAK: f64 = 1e-4;
const LENGTH: f64 = 500.0;

fn footprint(beta: f64) -> Footprint {
    Footprint::separable(TipFunction::triple_gaussian(beta, 1.0).unwrap(), 1.0).unwrap()
}

fn left(law: &Wider, r: f64) -> f64 {
    law.left_after(LENGTH / r)
}

struct Case {
    beta: f64,
    law: Wider,
    alpha: f64,
    r: f64,
    pitch: f64,
    lines: usize,
    path: Path,
}

impl Case {
    fn plan(&self) -> Plan {
        let tip = footprint(self.beta).path().clone();
        let model = Model::under(self.law, tip, self.alpha, self.r).unwrap();
        let size = (self.pitch, self.lines, LENGTH);
        let footprint = footprint(self.beta);
        let mut plan = Plan::new(footprint, model, self.path, size.0, size.1, size.2);
        plan.law.tolerance = 1e-13;
        plan
    }

    fn critical(&self) -> RasterCritical {
        let path = match self.path {
            Path::Zigzag => RasterPath::Zigzag,
            _ => RasterPath::OneWay,
        };
        self.theory().critical(path).unwrap()
    }

    fn theory(&self) -> Raster {
        let at = (self.r, self.pitch);
        Raster::new(&footprint(self.beta), self.law, at, left(&self.law, self.r)).unwrap()
    }

    /// What deviates of the density of every line.
    fn deviations(&self, q: f64) -> Vec<Complex64> {
        let one = |sign: f64| -> Vec<Line> {
            // Ripples drift along from line to line, on a zigzag to and fro.
            let part = if self.path == Path::Zigzag { 0.5 } else { 0.3 };
            let begin = part * LENGTH / self.r;
            let pulse = Pulse { amplitude: sign * WEAK, time: begin, width: 0.7 };
            let disturbance = Force::new(vec![pulse], None).unwrap();
            let plan = Plan { disturbance, ..self.plan() };
            let mut scanning = Scanning::new(&plan).unwrap();
            while scanning.next_line().unwrap().is_some() {}
            scanning.into_lines()
        };
        let s = self.law.healing_time.map_or(0.0, |time| 1.0 / (self.r * time));
        let density = |line: &Line| -> Complex64 {
            let (positions, weights) = line.residence();
            let terms = positions.iter().zip(&weights);
            // About the middle, where the factor is of order 1.
            terms.map(|(x, w)| w * (-Complex64::new(s, q) * (x - 0.5 * LENGTH)).exp()).sum()
        };
        let (up, down) = (one(1.0), one(-1.0));
        up.iter().zip(&down).map(|(a, b)| density(a) - density(b)).collect()
    }
}

/// Σ c_j of what deviated before, against what deviates of the last line, where lines are all alike but for that: somewhat
/// below the threshold, so that what begins at the edge does not come to the middle. Ripples drift along from line to line,
/// and may not come to the end.
#[test]
fn every_line_answers_to_those_before_as_theory_says() {
    let papers = Wider::default();
    let healing = Wider { healing_time: Some(600.0), ..papers };
    let limited = Wider { depth_limit: Some(6.0), ..papers };
    let all = Wider { depth_limit: Some(9.0), inertia: Some(0.6), ..healing };
    let heavy = Wider { inertia: Some(0.4), ..limited };
    for (name, beta, law, r, pitch, lines, path) in [
        ("healing", 0.0, healing, 1.0, 1.0, 18, Path::OneWay),
        ("depth limit", 0.5, limited, 0.8, 0.9, 24, Path::OneWay),
        ("all", 0.0, all, 1.0, 1.0, 17, Path::OneWay),
        ("there", 0.0, heavy, 1.0, 1.0, 15, Path::Zigzag),
        ("and back", 0.0, heavy, 1.0, 1.0, 16, Path::Zigzag),
    ] {
        let case = Case { beta, law, alpha: 1.0, r, pitch, lines, path };
        let (theory, critical) = (case.theory(), case.critical());
        let case = Case { alpha: 0.9 * critical.alpha, ..case };
        let found = case.deviations(critical.q);
        let last = case.lines - 1;
        let is_back = case.plan().track(last).backward;
        let felt = |answers: &[Complex64]| -> Complex64 {
            let answer = |c: &Complex64| if is_back { c.conj() } else { *c };
            let earlier = found[..last].iter().rev();
            earlier.zip(answers).map(|(y, c)| y * answer(c)).sum()
        };
        let off = |answers: &[Complex64]| (felt(answers) - found[last]).norm() / found[last].norm();
        let error = off(&theory.answers(case.alpha, critical.q));
        println!("{name}: α {:.4}, q {:.4}: {error:.1e}", case.alpha, critical.q);
        assert!(error < 1e-6, "{name}: {error:e}");
        // Negative control: the paper's law says otherwise.
        let plain = Raster::new(&footprint(beta), papers, (r, pitch), 1.0).unwrap();
        assert!(off(&plain.answers(case.alpha, critical.q)) > 1e-2, "{name}");
    }
}

/// With next to nothing of the wider law the thresholds are the paper's, to all digits; at the threshold the recurrence
/// neither grows nor fades, and at no q does it grow.
#[test]
fn thresholds_are_where_the_recurrence_neither_grows_nor_fades() {
    let round = footprint(0.0);
    // Of the full determinant, in which next to nothing heals and no depth is limited.
    let slight = Wider { healing_time: Some(1e12), depth_limit: Some(1e12), ..Wider::default() };
    for pitch in [0.25, 1.0] {
        let [papers, found] = [Wider::default(), slight].map(|law| {
            let raster = Raster::new(&round, law, (1.0, pitch), 1.0).unwrap();
            raster.critical(RasterPath::OneWay).unwrap()
        });
        assert!((found.alpha - papers.alpha).abs() < 1e-10, "{found:?} {papers:?}");
        assert!((found.q - papers.q).abs() < 1e-7);
    }
    let limited = Wider { depth_limit: Some(8.0), ..Wider::default() };
    let heavy = Wider { inertia: Some(0.5), ..Wider::default() };
    let healing = Wider { healing_time: Some(100.0), ..Wider::default() };
    let all =
        Wider { depth_limit: Some(8.0), healing_time: Some(100.0), inertia: Some(0.5), ..heavy };
    for law in [limited, heavy, healing, all] {
        for pitch in [0.5, 1.0] {
            let left = law.healing_time.map_or(1.0, |_| 0.3);
            let raster = Raster::new(&round, law, (1.0, pitch), left).unwrap();
            let at = raster.critical(RasterPath::OneWay).unwrap();
            let z = raster.growth(at.alpha, at.q);
            println!("{law:?} {pitch}: {at:?} {z}");
            assert!((z.norm() - 1.0).abs() < 1e-8, "{law:?} {z}");
            assert!((z.arg() - at.phase_per_line).abs() < 1e-6, "{law:?} {z} {at:?}");
            for i in 1..80 {
                let q = 0.03 * f64::from(i);
                assert!(raster.growth(0.995 * at.alpha, q).norm() < 1.0, "{law:?} {q}");
            }
            assert!(raster.growth(1.02 * at.alpha, at.q).norm() > 1.0);
        }
    }
}

#[test]
fn where_there_is_no_linear_law_it_is_said() {
    let limited = Wider { depth_limit: Some(3.0), ..Wider::default() };
    let at = (1.0, 0.5);
    let error = Raster::new(&footprint(1.0), limited, at, 1.0).unwrap_err();
    assert_eq!(error, StabilityError::Corner);
    let bessel = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    assert!(Raster::new(&bessel, limited, at, 1.0).is_err());
    // A shallow limit leaves nothing to grow.
    let shallow = Wider { depth_limit: Some(0.01), ..Wider::default() };
    let error = Raster::new(&footprint(0.0), shallow, at, 1.0)
        .unwrap()
        .critical(RasterPath::OneWay)
        .unwrap_err();
    assert_eq!(error, StabilityError::NoCrossing { r: 1.0 });
}
