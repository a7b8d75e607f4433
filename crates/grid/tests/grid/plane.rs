//! The plane: a tip free in both coordinates.

use crate::common::{FINE, REACH, distance, observed_orders, terms, triple_gaussian};
use std::ops::ControlFlow;
use stickslip_grid::{
    Footprint, Gaussian, GridError, Layer, Method, Path, PlaneMethod, PlaneProblem, PlaneRequest,
    PlaneRun, PlaneScan, PlaneScanned, PlaneStart, Problem, Product, Request, RowMethod, Scan,
    ScanLine, Start, Stepping, Wider, scan, scan_plane, solve, solve_plane,
};

const SPECTRAL: PlaneMethod = PlaneMethod::Spectral { spacing: FINE };

/// (48) at β = 1 times a Gaussian of this width across.
fn footprint(width: f64) -> [Product; 1] {
    let along = terms(&[(1.0, 0.0, 1.0), (-0.5, 2.0, 1.0), (-0.5, -2.0, 1.0)]);
    [Product { along, across: terms(&[(1.0, 0.0, width)]) }]
}

/// α, κ_y and the law of a line at r = 1 with the steady start at 14, and its displacement.
struct Line {
    alpha: f64,
    stiffness_across: f64,
    law: fn() -> Wider<'static>,
    displaced: [f64; 2],
    span: f64,
}

/// A line that snakes: α is above 0.8305410127, where theory puts the onset for κ_y = 0.25.
const SNAKING: Line = Line {
    alpha: 1.2,
    stiffness_across: 0.25,
    law: Wider::default,
    displaced: [-0.05, 0.3],
    span: 16.0,
};

fn all_terms() -> Wider<'static> {
    let inertia = Some((0.4, 1.0));
    Wider { depth_limit: Some(4.0), healing_time: Some(9.0), inertia, ..Wider::default() }
}

impl Line {
    fn times(&self, start: f64) -> Vec<f64> {
        (1..=20).map(|k| start + self.span * f64::from(k) / 20.0).collect()
    }

    fn run(&self, method: &PlaneMethod, stepping: &Stepping) -> Result<PlaneRun, GridError> {
        self.run_with(&footprint(1.0), method, stepping)
    }

    fn run_with(
        &self,
        products: &[Product],
        method: &PlaneMethod,
        stepping: &Stepping,
    ) -> Result<PlaneRun, GridError> {
        let wider = (self.law)();
        let start =
            PlaneStart::steady(&wider, (self.alpha, 1.0), products, 14.0).displaced(self.displaced);
        let times = self.times(start.time);
        let points: Vec<[f64; 2]> =
            (0..40).map(|k| [10.0 + 0.6 * f64::from(k), 0.1 * f64::from(k) - 2.0]).collect();
        let problem = PlaneProblem {
            model: (self.alpha, 1.0),
            stiffness_across: self.stiffness_across,
            line: 0.0,
            products,
            wider,
            force: &|_| [0.0; 2],
            start,
        };
        let request = PlaneRequest { times: &times, points: &points };
        solve_plane(&problem, method, stepping, &request, &mut |_, _| ControlFlow::Continue(()))
    }
}

/// Largest differences of x0, y0 and u.
fn differences(a: &PlaneRun, b: &PlaneRun) -> [f64; 3] {
    let of = |run: &PlaneRun, axis: usize| -> Vec<f64> {
        run.position.iter().map(|position| position[axis]).collect()
    };
    [distance(&of(a, 0), &of(b, 0)), distance(&of(a, 1), &of(b, 1)), distance(&a.u, &b.u)]
}

/// A tip that starts on its line stays there, and moves as on the grid of one coordinate.
#[test]
fn a_tip_on_its_line_moves_as_in_one_coordinate() -> Result<(), GridError> {
    let laws: [fn() -> Wider<'static>; 2] = [Wider::default, all_terms];
    for law in laws {
        let line = Line { law, displaced: [-0.05, 0.0], ..SNAKING };
        let plane = line.run(&SPECTRAL, &Stepping::absolute(1e-12))?;
        let along = Footprint::new(&triple_gaussian, REACH)?;
        let start = Start::steady_under(&law(), (line.alpha, 1.0), along, 14.0, 0.05);
        let times = line.times(start.time);
        let problem = Problem::under(law(), (line.alpha, 1.0), along, start)?;
        let gaussians = footprint(1.0)[0].along.clone();
        let method = Method::Spectral { gaussians, spacing: FINE };
        let request = Request { times: &times, points: &[] };
        let held = solve(&problem, &method, &Stepping::absolute(1e-12), &request)?;
        let x0: Vec<f64> = plane.position.iter().map(|[x, _]| *x).collect();
        let off = plane.position.iter().map(|[_, y]| y.abs()).fold(0.0, f64::max);
        let apart = distance(&x0, &held.x0);
        println!("x0 {apart:.1e}, y0 {off:.1e}");
        assert!(apart < 3e-11 && off < 1e-13, "{apart:e} {off:e}");
    }
    Ok(())
}

/// Lattices of Gaussians and sincs share the stepper only.
#[test]
fn the_two_spectral_planes_agree() -> Result<(), GridError> {
    for law in [Wider::default as fn() -> Wider<'static>, all_terms] {
        let line = Line { law, span: 6.0, ..SNAKING };
        let gaussians = line.run(&SPECTRAL, &Stepping::absolute(1e-11))?;
        let sinc = PlaneMethod::Sinc { spacing: [FINE; 2], half_width: 80 };
        let sinc = line.run(&sinc, &Stepping::absolute(1e-11))?;
        let apart = differences(&gaussians, &sinc);
        println!("{apart:?} {:?} {:?}", gaussians.work, sinc.work);
        assert!(apart.iter().all(|apart| *apart < 1e-9), "{apart:?}");
    }
    Ok(())
}

#[test]
fn cells_of_heights_are_of_second_order() -> Result<(), GridError> {
    let line = Line { span: 8.0, ..SNAKING };
    let exact = line.run(&SPECTRAL, &Stepping::absolute(1e-11))?;
    let mut errors = [vec![], vec![], vec![]];
    for spacing in [0.2, 0.1, 0.05] {
        let method = PlaneMethod::ThreePoint { spacing: [spacing; 2] };
        let run = line.run(&method, &Stepping::fixed(0.04))?;
        let apart = differences(&run, &exact);
        errors.iter_mut().zip(apart).for_each(|(errors, apart)| errors.push(apart));
    }
    for (what, errors) in ["x0", "y0", "u"].iter().zip(&errors) {
        let orders = observed_orders(errors);
        println!("{what}: orders {orders:.3?}, errors {errors:?}");
        assert!(orders.iter().all(|p| (1.8..=2.2).contains(p)), "{what}: {orders:?}");
    }
    Ok(())
}

#[test]
fn spectral_planes_are_of_eighth_order_in_time() -> Result<(), GridError> {
    for law in
        [Wider::default as fn() -> Wider<'static>, || Wider { depth_limit: None, ..all_terms() }]
    {
        let line = Line { law, span: 8.0, ..SNAKING };
        let exact = line.run(&SPECTRAL, &Stepping::fixed(0.05))?;
        let error = |step: f64| {
            let run = line.run(&SPECTRAL, &Stepping::fixed(step))?;
            let [x, y, _] = differences(&run, &exact);
            Ok(x.max(y))
        };
        let errors =
            [0.4, 0.2, 0.1].map(error).into_iter().collect::<Result<Vec<_>, GridError>>()?;
        let orders = observed_orders(&errors);
        println!("orders {orders:.2?}, errors {errors:?}");
        assert!(orders.iter().all(|p| *p > 7.0), "{orders:?}, {errors:?}");
    }
    Ok(())
}

/// The error of lattices falls as exp(-π²/2h²), faster than any power of their spacing.
#[test]
fn spectral_planes_converge_exponentially_in_cells() -> Result<(), GridError> {
    let line = Line { span: 6.0, ..SNAKING };
    let exact = line.run(&SPECTRAL, &Stepping::absolute(1e-11))?;
    let error = |spacing: f64| {
        let run = line.run(&PlaneMethod::Spectral { spacing }, &Stepping::absolute(1e-11))?;
        let [x, y, _] = differences(&run, &exact);
        Ok(x.max(y))
    };
    let errors =
        [0.8, 0.6, 0.5, 0.42].map(error).into_iter().collect::<Result<Vec<_>, GridError>>()?;
    println!("{errors:?}");
    assert!(errors[0] > 1e-5 && errors[3] < 1e-8, "{errors:?}");
    let order = (errors[1] / errors[2]).ln() / (0.6_f64 / 0.5).ln();
    assert!(order > 8.0, "{errors:?}");
    Ok(())
}

/// What the tip removes is α ∫∫f a time unit wherever it goes, and a mirrored start gives a mirrored motion; with two
/// products, one with lobes across.
#[test]
fn the_volume_falls_as_the_tip_carves() -> Result<(), GridError> {
    let product = |along: &[(f64, f64, f64)], across: &[(f64, f64, f64)]| Product {
        along: terms(along),
        across: terms(across),
    };
    let products = [
        product(&[(1.0, 0.0, 1.0)], &[(1.0, 0.0, 1.2)]),
        product(&[(-0.2, 0.0, 1.3)], &[(1.0, 1.5, 0.9), (1.0, -1.5, 0.9)]),
    ];
    let run = |side: f64| {
        let points: Vec<[f64; 2]> = (0..130)
            .flat_map(|i| {
                (0..90).map(move |j| [0.35 * f64::from(i) - 16.0, 0.3 * f64::from(j) - 13.35])
            })
            .collect();
        let problem = PlaneProblem {
            model: (0.9, 1.0),
            stiffness_across: 0.3,
            line: 0.0,
            products: &products,
            wider: Wider::default(),
            force: &|t| [0.0, 0.4 * side * (-t).exp()],
            start: PlaneStart::flat(0.0, [0.0, 0.2 * side]),
        };
        let request = PlaneRequest { times: &[5.0, 14.0], points: &points };
        solve_plane(&problem, &SPECTRAL, &Stepping::absolute(1e-10), &request, &mut |_, _| {
            ControlFlow::Continue(())
        })
    };
    let (right, left) = (run(1.0)?, run(-1.0)?);
    let volume: f64 = right.u.iter().sum::<f64>() * 0.35 * 0.3;
    let integral = |terms: &[Gaussian]| -> f64 {
        terms.iter().map(|g| g.amplitude * g.width * std::f64::consts::TAU.sqrt()).sum()
    };
    let f: f64 = products.iter().map(|p| integral(&p.along) * integral(&p.across)).sum();
    println!("{volume} {}, {:?}", -0.9 * f * 14.0, right.position);
    assert!((volume + 0.9 * f * 14.0).abs() < 1e-9, "{volume} {f}");
    for (right, left) in right.position.iter().zip(&left.position) {
        assert!((right[0] - left[0]).abs() < 1e-9 && (right[1] + left[1]).abs() < 1e-9);
        assert!(right[1].abs() > 1e-3, "the tip leaves its line");
    }
    Ok(())
}

/// Four lines at a pitch of 1, one-way or zigzag, with a push across on the first.
fn raster(
    zigzag: bool,
    stiffness_across: f64,
    law: (Option<f64>, Option<f64>, Option<f64>),
    push: f64,
) -> Result<PlaneScanned, GridError> {
    let line = |n: i32| {
        let (low, high) = (0.0, 12.0);
        let (from, to) = if zigzag && n % 2 == 1 { (high, low) } else { (low, high) };
        ScanLine { y: f64::from(n), from, to }
    };
    let lines: Vec<ScanLine> = (0..4).map(line).collect();
    let scan = PlaneScan {
        model: (0.7, 1.0),
        law,
        stiffness_across,
        products: &footprint(1.0),
        lines: &lines,
        zigzag,
        kick: 0.0,
        force: &|t| [0.0, push * (-0.5 * (t - 3.0).powi(2)).exp()],
    };
    let times: Vec<f64> = (1..8).map(|k| 1.7 * f64::from(k)).collect();
    let points: Vec<[f64; 2]> = (0..30).map(|k| [0.4 * f64::from(k), 2.0]).collect();
    let stepping = Stepping::absolute(1e-11);
    let mut go_on = |_: f64| ControlFlow::Continue(());
    scan_plane(&scan, &SPECTRAL, &stepping, (&times, &points), &mut go_on)
}

/// A tip held by a stiff spring across scans as on rows of cells, at first order in 1/κ_y.
#[test]
fn rasters_of_a_stiff_tip_come_to_those_on_rows() -> Result<(), GridError> {
    let law = (None, Some(20.0), Some(0.3));
    for zigzag in [false, true] {
        let line = |n: i32| {
            let (from, to) = if zigzag && n % 2 == 1 { (12.0, 0.0) } else { (0.0, 12.0) };
            ScanLine { y: f64::from(n), from, to }
        };
        let lines: Vec<ScanLine> = (0..4).map(line).collect();
        let across = |y: f64| (-0.5 * y * y).exp();
        let held = Scan {
            model: (0.7, 1.0),
            law,
            layers: &[Layer { along: &triple_gaussian, across: &across }],
            reach: (REACH, 8.85),
            lines: &lines,
            zigzag,
            force: &|_| 0.0,
        };
        let times: Vec<f64> = (1..8).map(|k| 1.7 * f64::from(k)).collect();
        let points: Vec<f64> = (0..30).map(|k| 0.4 * f64::from(k)).collect();
        let rows = scan(
            &held,
            (RowMethod::Sinc, FINE),
            &Stepping::absolute(1e-11),
            (&times, &points),
            &mut |_| ControlFlow::Continue(()),
        )?;
        let apart = |stiffness: f64| -> Result<f64, GridError> {
            let plane = raster(zigzag, stiffness, law, 0.0)?;
            let x0 = |line: &Vec<[f64; 2]>| line.iter().map(|[x, _]| *x).collect::<Vec<f64>>();
            let lines = plane.position.iter().map(x0).zip(&rows.x0);
            let motion = lines.map(|(plane, held)| distance(&plane, held)).fold(0.0, f64::max);
            Ok(motion.max(distance(&plane.u, &rows.u[2])))
        };
        let errors = [apart(50.0)?, apart(100.0)?, apart(200.0)?];
        let orders = observed_orders(&errors);
        println!("zigzag {zigzag}: {errors:?}, orders {orders:?}");
        assert!(errors[2] < 0.02 && orders.iter().all(|p| (0.85..1.15).contains(p)), "{orders:?}");
    }
    Ok(())
}

/// A scan is its lines, one after the other: the first of them is a line of its own, and a push on it is felt on all.
#[test]
fn the_first_line_of_a_raster_is_a_line() -> Result<(), GridError> {
    let law = (Some(5.0), None, None);
    let (quiet, pushed) = (raster(true, 1.0, law, 0.0)?, raster(true, 1.0, law, 0.5)?);
    let position = |t: f64| t;
    let path = Path { position: &position, knots: &[] };
    let problem = PlaneProblem {
        model: (0.7, 1.0),
        stiffness_across: 1.0,
        line: 0.0,
        products: &footprint(1.0),
        wider: Wider { depth_limit: law.0, path: Some(path), ..Wider::default() },
        force: &|t| [0.0, 0.5 * (-0.5 * (t - 3.0).powi(2)).exp()],
        start: PlaneStart::flat(0.0, [0.0; 2]),
    };
    let times: Vec<f64> = (1..8).map(|k| 1.7 * f64::from(k)).collect();
    let request = PlaneRequest { times: &times, points: &[] };
    let go_on = &mut |_: f64, _: [f64; 2]| ControlFlow::Continue(());
    let line = solve_plane(&problem, &SPECTRAL, &Stepping::absolute(1e-11), &request, go_on)?;
    assert_eq!(line.position, pushed.position[0]);
    for (quiet, pushed) in quiet.position.iter().zip(&pushed.position) {
        let apart = |axis: usize| {
            let both = quiet.iter().zip(pushed);
            both.map(|(a, b)| (a[axis] - b[axis]).abs()).fold(0.0, f64::max)
        };
        println!("{:.2e} {:.2e}", apart(0), apart(1));
        assert!(apart(1) > 1e-4, "{}", apart(1));
    }
    Ok(())
}

#[test]
fn planes_refuse_what_makes_no_sense() {
    let refused = |line: Line, products: &[Product], method: PlaneMethod| {
        line.run_with(products, &method, &Stepping::absolute(1e-9)).err()
    };
    let line = || Line { ..SNAKING };
    let soft = Line { stiffness_across: -1.0, ..line() };
    assert_eq!(refused(soft, &footprint(1.0), SPECTRAL), Some(GridError::StiffnessAcross(-1.0)));
    assert_eq!(refused(line(), &[], SPECTRAL), Some(GridError::Gaussians));
    assert_eq!(refused(line(), &footprint(0.0), SPECTRAL), Some(GridError::Gaussians));
    let wide = PlaneMethod::Spectral { spacing: 1.5 };
    assert!(matches!(refused(line(), &footprint(1.0), wide), Some(GridError::Defect { .. })));
    let none = PlaneMethod::ThreePoint { spacing: [0.1, 0.0] };
    assert_eq!(refused(line(), &footprint(1.0), none), Some(GridError::Spacing(0.0)));
}
