//! A document of a raster is the raster: plan and lines come back from its text.

use serde_json::json;
use stickslip::{KeptLine, PathName, Raster, RasterDocument, Tip, read};
use stickslip_raster::{Free, Line, Path, Plan, Scanned, Scanning};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

/// One-way under a depth limit on a surface that heals, the others under the paper's law.
fn plan(path: Path) -> Plan {
    let tip = TipFunction::triple_gaussian(0.5, 1.0).unwrap();
    let footprint = Footprint::separable(tip.clone(), 1.3).unwrap();
    let is_wider = path == Path::OneWay;
    let wider = Wider {
        depth_limit: is_wider.then_some(4.0),
        healing_time: is_wider.then_some(50.0),
        ..Wider::default()
    };
    let model = Model::under(wider, tip, 0.6, 0.9).unwrap();
    Plan::new(footprint, model, path, 0.7, 5, 20.0)
}

/// The question with this plan.
fn question(plan: &Plan) -> Raster {
    let (model, free) = (&plan.law.model, plan.free.as_ref());
    let path = match plan.path {
        Path::OneWay => PathName::OneWay,
        Path::Zigzag => PathName::Zigzag,
        Path::Repeat => PathName::Repeat,
    };
    let values = json!({
        "tip": Tip(model.tip().clone()), "alpha": model.alpha(), "r": model.r(), "width_y": 1.3, "path": path,
        "depth_limit": model.wider().depth_limit, "healing_time": model.wider().healing_time,
        "pitch": plan.area.pitch(plan.path), "lines": plan.lines(), "length": plan.area.longest(),
        "stiffness_across": free.map(|free| free.stiffness), "kick_across": free.map(|free| free.kick),
    });
    serde_json::from_value(values).unwrap()
}

fn document(path: Path) -> (Plan, Vec<Line>, RasterDocument) {
    let plan = plan(path);
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    let parameters = question(&plan);
    let document = parameters.document(&plan, &lines, &[0.0, 10.0, 20.0]);
    (plan, lines, document)
}

/// A document is the raster: plan and lines come back from its text to the last bit.
#[test]
fn a_raster_comes_back_from_its_document() {
    for path in [Path::OneWay, Path::Zigzag, Path::Repeat] {
        let (plan, lines, document) = document(path);
        let text = serde_json::to_string(&document).unwrap();
        let back: RasterDocument = read(&text, RasterDocument::FORMAT).unwrap();
        let (again, found) = back.scanned().unwrap();
        assert_eq!((again.path, again.lines()), (plan.path, plan.lines()));
        for (a, b) in found.iter().zip(&lines) {
            assert_eq!((a.track(), a.trajectory()), (b.track(), b.trajectory()));
        }
        let at = ([3.0, 9.5], [0.0, 1.9]);
        let heights = |plan, lines| Scanned::new(plan, lines).heights(&at.0, &at.1);
        assert_eq!(heights(&again, &found), heights(&plan, &lines));
    }
}

/// What was scanned, and no other, is what the rest of a raster goes on from.
#[test]
fn a_line_kept_is_the_line() {
    let (plan, lines, _) = document(Path::OneWay);
    assert!(lines[0].height(3.0).is_some_and(|height| height < 0.0));
    for (n, line) in lines.iter().enumerate() {
        let kept = KeptLine::from_text(&KeptLine::of(n, line).to_text()).unwrap();
        let again = kept.line(&plan).unwrap();
        assert_eq!((again.track(), again.work()), (line.track(), line.work()));
        assert_eq!(again.trajectory(), line.trajectory());
    }
    let other = KeptLine { index: 7, ..KeptLine::of(0, &lines[0]) };
    let mut without = KeptLine::of(0, &lines[0]);
    // The heights of the second step.
    without.steps[16 + 9..32].fill(f64::NAN);
    let short = KeptLine { steps: vec![], ..KeptLine::of(0, &lines[0]) };
    for line in [other, without, short] {
        assert!(line.line(&plan).is_err(), "{}", line.index);
    }
    let text = KeptLine::of(0, &lines[0]).to_text();
    assert!(KeptLine::from_text(&text[..text.len() - 4]).is_none());
    assert!(KeptLine::from_text("").is_none());
}

#[test]
fn a_damaged_history_is_refused() {
    let (_, _, mut document) = document(Path::OneWay);
    document.history.lines[2].extension[1] += 1e-3;
    let said = document.scanned().unwrap_err().to_string();
    assert!(said.contains("line 3"), "{said}");
    document.history.lines.truncate(2);
    assert!(document.scanned().is_err());
}

/// Of a tip that is free to move across the lines: y0 on the surface is rounded, what is kept between lines is not.
#[test]
fn free_lines_come_back_too() {
    let plan = plan(Path::Zigzag).with_free(Free { kick: 0.3, ..Free::new(0.9) });
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    let parameters = question(&plan);
    assert_eq!((parameters.stiffness_across, parameters.kick_across), (Some(0.9), Some(0.3)));
    let mut document = parameters.document(&plan, &lines, &[0.0, 10.0, 20.0]);
    let samples = &document.lines[2].samples;
    let (y0, velocity) = (samples.y0.as_ref().unwrap(), samples.velocity_y.as_ref().unwrap());
    assert!((y0[1] - lines[2].y0(10.0)).abs() < 1e-15 && (y0[1] - 1.4).abs() > 1e-3);
    assert!((velocity[1] - lines[2].velocity_y(10.0)).abs() < 1e-15);
    let text = serde_json::to_string(&document).unwrap();
    let back: RasterDocument = read(&text, RasterDocument::FORMAT).unwrap();
    let (again, found) = back.scanned().unwrap();
    let at = ([3.0, 9.5], [0.0, 1.9]);
    let heights = |plan, lines| Scanned::new(plan, lines).heights(&at.0, &at.1);
    let pairs = heights(&again, &found).into_iter().zip(heights(&plan, &lines));
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-13));
    for (n, line) in lines.iter().enumerate() {
        let kept = KeptLine::from_text(&KeptLine::of(n, line).to_text()).unwrap();
        assert!(kept.line(&plan).unwrap().planar_steps().eq(line.planar_steps()));
        let mut without = kept;
        without.steps[23 + 16..46].fill(f64::NAN);
        assert!(without.line(&plan).is_err());
    }
    let damaged = document.history.lines[1].y0.as_mut().unwrap();
    damaged[0][2] = f64::NAN;
    assert!(document.scanned().unwrap_err().to_string().contains("line 2"));
    document.history.lines[1].y0 = None;
    assert!(document.scanned().is_err());
}
