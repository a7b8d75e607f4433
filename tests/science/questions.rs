//! Questions as data: read from JSON, saved with their answers, asked again, cancelled, refused by the name of a parameter.

use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use stickslip::{
    Ask, Boundary, BoundaryDocument, Context, Cycle, CycleDocument, Document, Failure, Stability,
    StabilityDocument, Tip, WalkingDocument, read,
};
use stickslip_tip::TipFunction;

fn asked<A: Ask>(question: Value) -> Document<A> {
    serde_json::from_value::<A>(question).unwrap().ask(&Context::default()).unwrap()
}

fn text(document: &impl serde::Serialize) -> String {
    serde_json::to_string(document).unwrap()
}

#[test]
fn a_saved_question_asked_again_has_the_same_answer() {
    let tip = json!({"name": "triple-gaussian", "beta": 0.5});
    let first: BoundaryDocument =
        asked(json!({"tip": tip, "r_range": [0.5, 2.0], "points": 5, "depth_limit": 5.0}));
    let saved: BoundaryDocument = read(&text(&first), BoundaryDocument::FORMAT).unwrap();
    assert_eq!(text(&saved), text(&first));
    let again = saved.parameters.ask(&Context::default()).unwrap();
    assert_eq!(text(&again), text(&first));

    let first: CycleDocument = asked(json!({"tip": tip, "alpha_above": 0.05, "r": 1.0}));
    let saved: CycleDocument = read(&text(&first), CycleDocument::FORMAT).unwrap();
    assert_eq!(text(&saved), text(&first));
    // α and αc + D are both there, and agree.
    let again = saved.parameters.clone().ask(&Context::default()).unwrap();
    assert_eq!(text(&again), text(&first));
    let from_there = Cycle::again(&saved).unwrap().ask(&Context::default()).unwrap();
    assert!((from_there.period - first.period).abs() < 1e-8);
    assert!(from_there.work.newton_iterations < first.work.newton_iterations);
}

#[test]
fn questions_of_linear_theory_asked_again_have_the_same_answer() {
    let tip = json!({"name": "triple-gaussian", "beta": 0.5});
    for question in [
        json!({"tip": tip, "r": 1.0}),
        json!({"tip": tip, "alpha": 1.0, "solve_for": "r"}),
        json!({"tip": tip, "alpha_above": 0.1, "r": 0.7, "healing_time": 20.0, "roots": 4}),
        json!({"alpha": 1.2, "r": 1.0, "re_above": -3.0}),
        json!({"alpha": 1.2, "r": 1.0, "stiffness_across": 0.5}),
        json!({"tip": {"name": "gaussian"}, "r": 1.0, "stiffness_across": 0.5, "width_y": 0.7}),
    ] {
        let first: StabilityDocument = asked(question.clone());
        let saved: StabilityDocument = read(&text(&first), StabilityDocument::FORMAT).unwrap();
        assert_eq!(text(&saved), text(&first));
        let again = saved.parameters.ask(&Context::default()).unwrap();
        assert_eq!(text(&again), text(&first), "{question}");
    }
    let walk = json!({"tip": {"name": "gaussians", "gaussians": [{"amplitude": 1.0, "center": 0.0, "width": 1.0}]}, "alpha": -3.0, "r": 0.0,
        "healing_time": 5.0, "no_spring": true, "roots": 3});
    let first: WalkingDocument = asked(walk);
    assert!(!first.walks.is_empty());
    let again = first.parameters.clone().ask(&Context::default()).unwrap();
    assert_eq!(text(&again), text(&first));
}

/// On a spring across the scan the line snakes, or never does; held on its line it has nothing to say of that.
#[test]
fn a_line_that_gives_way_is_asked_where_it_snakes() {
    let snaking = |question: Value| {
        let document: StabilityDocument = asked(question);
        serde_json::to_value(&document).unwrap()
    };
    let soft = snaking(json!({"alpha": 1.0, "r": 1.0, "stiffness_across": 0.25}));
    assert!((soft["snaking"]["alpha"].as_f64().unwrap() - 0.830_541_012_7).abs() < 6e-11);
    assert!((soft["snaking"]["wavelength"].as_f64().unwrap() - 17.1).abs() < 0.05);
    // Below αc = 1.069 along the scan.
    assert_eq!((&soft["stable"], &soft["parameters"]["width_y"]), (&json!(false), &json!(1.0)));
    let stiff = snaking(json!({"alpha": 1.0, "r": 1.0, "stiffness_across": 1.0}));
    assert_eq!(stiff["stable"], true);
    let gaussian =
        json!({"tip": {"name": "gaussian"}, "alpha": 1.0, "r": 1.0, "stiffness_across": 0.25});
    let gaussian = snaking(gaussian);
    assert!(gaussian["snaking"].is_null() && gaussian.as_object().unwrap().contains_key("snaking"));
    let held = snaking(json!({"alpha": 1.0, "r": 1.0}));
    for name in ["snaking", "stiffness_across", "width_y"] {
        assert!(held.get(name).is_none() && held["parameters"].get(name).is_none());
    }
    for (question, parameter) in [
        (json!({"r": 1.0, "stiffness_across": 0.0}), "stiffness_across"),
        (json!({"r": 1.0, "stiffness_across": -2.0}), "stiffness_across"),
        (json!({"r": 1.0, "width_y": 1.0}), "width_y"),
        (json!({"r": 1.0, "stiffness_across": 1.0, "width_y": 0.0}), "width_y"),
        (json!({"tip": {"name": "bessel"}, "r": 1.0, "stiffness_across": 1.0}), "width_y"),
    ] {
        let stability: Stability = serde_json::from_value(question.clone()).unwrap();
        match stability.ask(&Context::default()) {
            Err(Failure::Refused(refused)) => assert_eq!(refused.parameter, parameter),
            other => panic!("{question}: {other:?}"),
        }
    }
}

#[test]
fn footprints_are_read_by_name_as_sums_and_as_tables() {
    let read = |tip: Value| serde_json::from_value::<Tip>(tip);
    let gaussian = TipFunction::gaussian(2.0).unwrap();
    for tip in [
        json!({"name": "gaussian", "width": 2.0}),
        json!({"name": "gaussians", "gaussians": [{"amplitude": 1.0, "center": 0.0, "width": 2.0}]}),
        json!({"gaussians": [{"amplitude": 1.0, "center": 0.0, "width": 2.0}]}),
    ] {
        assert_eq!(read(tip).unwrap().0, gaussian);
    }
    assert_eq!(read(json!({})).unwrap(), Tip::default());
    let x: Vec<f64> = (0..60).map(|i| 0.25 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| gaussian.value(*x)).collect();
    let table = read(json!({"x": x, "f": f})).unwrap().0;
    assert!((table.value(1.1) - gaussian.value(1.1)).abs() < 1e-6);
    for (tip, word) in [
        (json!({"name": "bessel", "width": 2.0}), "width"),
        (json!({"name": "gaussian", "beta": 1.0}), "beta"),
        (json!({"name": "none"}), "triple-gaussian"),
        (json!({"name": "gaussian", "size": 1.0}), "size"),
        (json!({"name": "gaussian", "width": -1.0}), "above 0"),
    ] {
        let refused = read(tip).unwrap_err().to_string();
        assert!(refused.contains(word), "{refused}");
    }
}

#[test]
fn a_refusal_names_the_parameter_as_each_face_writes_it() {
    let refusal = |question: Value| match serde_json::from_value::<Cycle>(question)
        .unwrap()
        .ask(&Context::default())
    {
        Err(Failure::Refused(refused)) => refused,
        other => panic!("{other:?}"),
    };
    let missing = refusal(json!({"r": 1.0}));
    assert_eq!(missing.parameter, "alpha");
    let option = |name: &str| format!("--{}", name.replace('_', "-"));
    assert!(missing.described(option).contains("give --alpha, or --alpha-above for"));
    assert!(missing.described(str::to_owned).contains("give alpha, or alpha_above for"));
    // No second list of what is refused: each question judges its own numbers.
    for (question, parameter) in [
        (json!({"alpha": 1.2, "r": 0.0}), "r"),
        (json!({"alpha": -1.2, "r": 1.0}), "alpha"),
        (json!({"alpha_above": -9.0, "r": 1.0}), "alpha_above"),
        (json!({"alpha": 1.2, "alpha_above": 0.5, "r": 1.0}), "alpha and alpha_above"),
        (json!({"alpha": 1.2, "r": 1.0, "depth_limit": 0.0}), "depth_limit"),
        (json!({"alpha": 1.2, "r": 1.0, "no_spring": true}), "no_spring"),
        (json!({"alpha": 1.2, "r": 1.0, "tolerance": 1.0}), "tolerance"),
        (json!({"alpha": 1.2, "r": 1.0, "points": 0}), "points"),
        (json!({"alpha": 1.2, "r": 1.0, "tip": {"name": "bessel"}}), "tip"),
    ] {
        assert_eq!(refusal(question.clone()).parameter, parameter, "{question}");
    }
}

#[test]
fn work_is_watched_and_ends_when_it_is_cancelled() {
    let question = Boundary { points: 40, ..Boundary::new(Tip::default(), [0.5, 2.0]) };
    let (cancel, calls) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicUsize::new(0)));
    let (flag, count) = (Arc::clone(&cancel), Arc::clone(&calls));
    let context = Context::cancelled_by(cancel).watched_by(move |part, counted| {
        assert!(
            part.is_some_and(|part| (0.0..=1.0).contains(&part))
                && counted.ends_with(" of 80 steps")
        );
        count.fetch_add(1, Ordering::Relaxed);
        flag.store(part > Some(0.2), Ordering::Relaxed);
    });
    assert_eq!(question.clone().ask(&context).unwrap_err(), Failure::Cancelled);
    let until_then = calls.load(Ordering::Relaxed);
    assert!((16..80).contains(&until_then), "{until_then}");
    assert!(question.ask(&Context::default()).is_ok());
}
