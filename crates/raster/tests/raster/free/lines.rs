//! Lines and surfaces against the reference, which sums over every position of every line.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::reference::{Law, Reference, Terms, Way};
use stickslip_raster::{Area, AreaLine, Free, Line, Path, Plan, Scanned, Scanning};
use stickslip_tip::{Footprint, Force, Gaussian2d, MemoryChoice, Model, Pulse, TipFunction, Wider};

pub(crate) fn scanned(plan: &Plan) -> Vec<Line> {
    let mut scanning = Scanning::new(plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    scanning.into_lines()
}

/// (48) with these side lobes times a Gaussian across, with its terms.
pub(crate) fn footprint(beta: f64, width_y: f64) -> (Footprint, Terms) {
    let along = TipFunction::triple_gaussian(beta, 1.0).unwrap();
    let term = |a: f64, c: f64| [a, c, 1.0, 0.0, width_y];
    let terms = vec![term(1.0, 0.0), term(-0.5 * beta, -2.0), term(-0.5 * beta, 2.0)];
    (Footprint::separable(along, width_y).unwrap(), terms)
}

struct Case {
    name: &'static str,
    beta: f64,
    alpha: f64,
    stiffness: f64,
    path: Path,
    /// Pitch, number and length of the lines.
    size: (f64, usize, f64),
    wider: Wider,
    kick: f64,
    /// Amplitude of a pulse across in the middle of the first line.
    push: f64,
}

impl Case {
    fn plan(&self) -> (Plan, Law) {
        let (footprint, terms) = footprint(self.beta, 1.0);
        let model = Model::under(self.wider, footprint.path().clone(), self.alpha, 1.0).unwrap();
        let (pitch, lines, length) = self.size;
        let pulse = |amplitude| [amplitude, 0.5 * length, 1.2];
        let force = |[amplitude, time, width]: [f64; 3]| {
            Force::new(vec![Pulse { amplitude, time, width }], None).unwrap()
        };
        let mut free = Free { kick: self.kick, ..Free::new(self.stiffness) };
        if self.push.abs() > 0.0 {
            free.disturbance = force(pulse(self.push));
        }
        let plan = Plan::new(footprint, model, self.path, pitch, lines, length).with_free(free);
        let law = Law {
            terms,
            alpha: self.alpha,
            r: 1.0,
            stiffness: self.stiffness,
            inertia: self.wider.inertia,
            healing: self.wider.healing_time,
            depth: self.wider.depth_limit,
            pulses: [None, (self.push.abs() > 0.0).then(|| pulse(self.push))],
        };
        (plan, law)
    }
}

/// The ways of the support over the lines of a plan.
fn ways(plan: &Plan, kick: f64) -> Vec<Way> {
    let way = |n: usize| {
        let track = plan.track(n);
        let goes_on = plan.path == Path::Zigzag && n > 0;
        let off = [0.0, if n == 0 { kick } else { 0.0 }];
        Way {
            y: track.y,
            from: track.start,
            to: track.x(track.length),
            put_down: (!goes_on).then_some(off),
        }
    };
    (0..plan.lines()).map(way).collect()
}

/// Largest differences of x0 and y0 on any line, and of u around the lines; and the lines.
fn differences(plan: &Plan, law: Law, steps: usize) -> ([f64; 3], Vec<Line>) {
    let kick = plan.free.as_ref().unwrap().kick;
    let (lines, mut reference) = (scanned(plan), Reference::new(law));
    let mut worst = [0.0_f64; 3];
    for (way, line) in ways(plan, kick).iter().zip(&lines) {
        for (t, at) in reference.line(way, steps) {
            worst[0] = worst[0].max((line.x0(t) - at[0]).abs());
            worst[1] = worst[1].max((line.y0(t) - at[1]).abs());
        }
    }
    let (low, high) = plan.area.ends();
    let x: Vec<f64> = (0..7).map(|i| low + (high - low) * f64::from(i) / 5.7).collect();
    let y = [-1.2, 0.3, 0.9, 2.6];
    let u = Scanned::new(plan, &lines).heights(&x, &y);
    for ((n, i), u) in u.indexed_iter() {
        worst[2] = worst[2].max((u - reference.height([x[i], y[n]])).abs());
    }
    (worst, lines)
}

fn judge(case: &Case, steps: usize) -> Vec<Line> {
    let (plan, law) = case.plan();
    let (worst, lines) = differences(&plan, law, steps);
    let farthest = lines.iter().flat_map(|line| {
        let off = |visit: stickslip_tip::planar::Visit| (visit.y - line.track().y).abs();
        line.visits().into_iter().map(off)
    });
    println!("{}: {worst:?}, {:.2} off the line", case.name, farthest.fold(0.0, f64::max));
    assert!(worst.iter().all(|miss| *miss < 3e-8), "{}: {worst:?}", case.name);
    lines
}

fn plain() -> Case {
    Case {
        name: "one-way",
        beta: 0.0,
        alpha: 0.5,
        stiffness: 1.0,
        path: Path::OneWay,
        size: (0.5, 4, 10.0),
        wider: Wider::default(),
        kick: 0.0,
        push: 0.6,
    }
}

#[test]
fn one_way_lines_are_those_of_the_direct_sum() {
    judge(&plain(), 100);
    judge(&Case { name: "soft", stiffness: 0.2, alpha: 0.8, kick: 0.4, ..plain() }, 200);
    let sided = Case { beta: 1.0, stiffness: 0.4, size: (0.7, 3, 9.0), ..plain() };
    judge(&Case { name: "side lobes", push: 1.4, ..sided }, 160);
}

#[test]
fn zigzag_lines_are_those_of_the_direct_sum() {
    let zigzag = Case { name: "zigzag", path: Path::Zigzag, ..plain() };
    let heavy = Wider { inertia: Some(0.5), ..Wider::default() };
    judge(&Case { size: (0.5, 5, 8.0), ..zigzag }, 80);
    let sided = Case { name: "side lobes, heavy", beta: 1.0, wider: heavy, ..zigzag };
    judge(&Case { stiffness: 0.4, size: (0.7, 3, 9.0), ..sided }, 160);
}

#[test]
fn lines_under_the_wider_law_are_those_of_the_direct_sum() {
    let healing = Wider { healing_time: Some(9.0), ..Wider::default() };
    let heavy = Wider { inertia: Some(0.6), ..Wider::default() };
    let both = Wider { inertia: Some(0.3), ..healing };
    let case = |name, wider, path| Case { name, wider, path, alpha: 0.6, ..plain() };
    judge(&case("healing", healing, Path::OneWay), 100);
    judge(&case("heavy", heavy, Path::OneWay), 100);
    judge(&case("both, there and back", both, Path::Zigzag), 100);
    judge(&case("both, repeated", both, Path::Repeat), 100);
    let limited = Wider { depth_limit: Some(2.0), ..Wider::default() };
    let all = Wider { depth_limit: Some(3.0), ..both };
    judge(&case("limited", limited, Path::OneWay), 100);
    judge(&case("all, there and back", all, Path::Zigzag), 100);
}

#[test]
fn lines_of_each_memory_are_those_of_the_direct_sum() {
    let zigzag = Case { name: "zigzag", path: Path::Zigzag, size: (0.5, 4, 8.0), ..plain() };
    let mut all = vec![];
    for memory in [MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes] {
        let (mut plan, law) = zigzag.plan();
        plan.law.memory = memory;
        let (worst, lines) = differences(&plan, law, 80);
        println!("{memory:?}: {worst:?}");
        assert!(worst.iter().all(|miss| *miss < 3e-8), "{memory:?}: {worst:?}");
        all.push(lines[3].x0(5.0).to_bits());
    }
    assert!(all[0] != all[2] && all[1] != all[2], "{all:?}");
}

/// Lines of several lengths that begin at several x, one of them twice, and one that goes back.
#[test]
fn lines_of_any_shape_are_those_of_the_direct_sum() {
    let line = |(y, start, length): (f64, f64, f64)| AreaLine { y, start, length };
    let shape =
        [(0.0, -4.0, 8.0), (0.6, -4.5, 9.0), (1.2, 1.0, 6.0), (1.2, 1.0, 6.0), (0.3, -2.0, 7.0)];
    for path in [Path::OneWay, Path::Zigzag] {
        let (mut plan, law) = Case { path, ..plain() }.plan();
        plan.area = Area::Lines(shape.into_iter().map(line).collect());
        let (worst, _) = differences(&plan, law, 100);
        println!("{path:?}: {worst:?}");
        assert!(worst.iter().all(|miss| *miss < 3e-8), "{path:?}: {worst:?}");
    }
}

/// Negative control: a tip that is held on its lines moves otherwise, and so does one that ignores earlier lines.
/// Lobes of several widths all around, and a table of such a footprint.
#[test]
fn lines_of_a_sum_of_products_are_those_of_the_direct_sum() {
    let lobe = |a: f64, c: f64, w: f64, d: f64, v: f64| [a, c, w, d, v];
    let star = vec![
        lobe(1.0, 0.0, 1.0, 0.0, 1.0),
        lobe(-0.3, -2.0, 0.9, 0.0, 0.8),
        lobe(-0.3, 2.0, 0.9, 0.0, 0.8),
        lobe(-0.2, 0.0, 1.1, -1.8, 0.9),
        lobe(-0.2, 0.0, 1.1, 1.8, 0.9),
    ];
    let term = |[amplitude, center, width, center_y, width_y]: &[f64; 5]| Gaussian2d {
        amplitude: *amplitude,
        center: *center,
        width: *width,
        center_y: *center_y,
        width_y: *width_y,
    };
    let of_terms = Footprint::gaussian_sum(&star.iter().map(term).collect::<Vec<_>>()).unwrap();
    let place = |n: usize| 0.25 * n as f64;
    let points = || (0..36).flat_map(|j| (0..36).map(move |i| (place(i), place(j))));
    let (x, y): (Vec<f64>, Vec<f64>) = points().unzip();
    let f: Vec<f64> = points().map(|(x, y)| of_terms.value(x, y)).collect();
    let of_table = Footprint::table(&x, &y, &f).unwrap();
    for (name, footprint, path) in
        [("star", &of_terms, Path::Zigzag), ("table", &of_table, Path::OneWay)]
    {
        let case = Case { name, path, ..plain() };
        let (plan, law) = case.plan();
        let model = Model::new(footprint.path().clone(), case.alpha, 1.0).unwrap();
        let mut plan = Plan { footprint: footprint.clone(), ..plan };
        plan.law.model = model;
        let law = Law { terms: star.clone(), ..law };
        let (worst, _) = differences(&plan, law, 100);
        println!("{name}: {worst:?}");
        assert!(worst.iter().all(|miss| *miss < 3e-8), "{name}: {worst:?}");
    }
}

#[test]
fn a_tip_that_is_held_would_be_found_out() {
    let (plan, _) = plain().plan();
    let free = scanned(&plan);
    let held = scanned(&Plan { free: None, ..plan.clone() });
    let alone =
        scanned(&Plan { area: Area::Rectangle { pitch: 40.0, lines: 2, length: 10.0 }, ..plan });
    let apart = |a: &Line, b: &Line| {
        (0..50).map(|i| 0.2 * f64::from(i)).map(|t| (a.x0(t) - b.x0(t)).abs()).fold(0.0, f64::max)
    };
    assert!(apart(&free[1], &held[1]) > 1e-2 && apart(&free[1], &alone[1]) > 1e-2);
}

/// Largest difference of x0 and y0 between lines and motions of the reference.
fn apart(lines: &[Line], motions: &[Vec<(f64, [f64; 2])>]) -> f64 {
    let of = |(line, motion): (&Line, &Vec<(f64, [f64; 2])>)| {
        let miss = |(t, at): &(f64, [f64; 2])| {
            (line.x0(*t) - at[0]).abs().max((line.y0(*t) - at[1]).abs())
        };
        motion.iter().map(miss).fold(0.0, f64::max)
    };
    lines.iter().zip(motions).map(of).fold(0.0, f64::max)
}

/// Errors of lines on earlier lines follow the tolerance, and the reference is of its order.
#[test]
fn errors_of_lines_follow_the_tolerance() {
    let (plan, law) = plain().plan();
    let motions = |steps: usize| -> Vec<Vec<(f64, [f64; 2])>> {
        let mut reference = Reference::new(law.clone());
        ways(&plan, 0.0).iter().map(|way| reference.line(way, steps)).collect()
    };
    let finest = motions(120);
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut plan = plan.clone();
        plan.law.tolerance = tolerance;
        let error = apart(&scanned(&plan), &finest);
        println!("{tolerance:e}: {error:.1e}");
        assert!(error < 3.0 * tolerance, "{tolerance:e}: {error:e}");
    }
    let ends = |motions: &[Vec<(f64, [f64; 2])>]| -> Vec<[f64; 2]> {
        motions.iter().filter_map(|motion| Some(motion.last()?.1)).collect()
    };
    let (exact, mut errors) = (ends(&finest), vec![]);
    for steps in [30, 60] {
        let found = ends(&motions(steps));
        let pairs = found.iter().flatten().zip(exact.iter().flatten());
        errors.push(pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max));
    }
    let order = f64::log2(errors[0] / errors[1]);
    println!("{errors:?}, order {order:.2}");
    assert!(order > 7.0, "{errors:?}");
}
