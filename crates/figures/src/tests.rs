//! A figure as a whole: limits, bytes, what is drawn of what.

use crate::{FigureFormat, Size, View, draw, of, svg};
use stickslip::{
    CellsDocument, ColourName, ColoursName, CurveDocument, FigureDocument, Indentation,
    MapDocument, ModelParameters, PanelDocument, Run, RunDocument, ScaleName, StyleName, Tip,
};
use stickslip_tip::{Model, TipFunction};

fn figure(panels: Vec<PanelDocument>) -> FigureDocument {
    FigureDocument::new("test", "α < α_c & r > 0", vec![], panels)
}

fn panel(x: &[f64], y: &[f64]) -> PanelDocument {
    let mut panel = PanelDocument::new("", ("x", "y"));
    panel.curves = vec![CurveDocument::new(StyleName::Line, "", x, y)];
    panel
}

#[test]
fn a_hundred_thousand_points_fit_into_300_kilobytes() {
    let x: Vec<f64> = (0..100_000).map(|i| 0.0044 * f64::from(i)).collect();
    let y: Vec<f64> = x.iter().map(|t| t.sin() + 0.3 * (37.0 * t).sin()).collect();
    let mut two = panel(&x, &y);
    two.curves.push(CurveDocument::new(StyleName::Dashed, "", &x, &y));
    let three = vec![two.clone(), two.clone(), two];
    let picture = svg(&figure(three), &Size::default()).unwrap();
    assert!(picture.len() < 300_000, "{} bytes", picture.len());
}

#[test]
fn the_same_figure_gives_the_same_bytes_in_every_format() {
    let figure = figure(vec![panel(&[0.0, 1.0, 2.0], &[0.5, 0.7, 0.6])]);
    let formats = [
        FigureFormat::Svg,
        #[cfg(feature = "png")]
        FigureFormat::Png,
        #[cfg(feature = "pdf")]
        FigureFormat::Pdf,
    ];
    for format in formats {
        let bytes = || draw(&figure, format, &Size::default()).unwrap();
        assert!(bytes() == bytes() && bytes().len() > 500, "{format:?}");
    }
}

#[test]
fn nothing_and_next_to_nothing_are_drawn() {
    for (x, y) in [(&[][..], &[][..]), (&[3.0], &[1.0]), (&[0.0, 1.0], &[f64::NAN, f64::INFINITY])]
    {
        for scale in [ScaleName::Linear, ScaleName::Logarithmic] {
            let mut panel = panel(x, y);
            (panel.x_scale, panel.y_scale) = (scale, scale);
            let picture = svg(&figure(vec![panel]), &Size::default()).unwrap();
            assert!(picture.starts_with("<svg") && !picture.contains("NaN"), "{picture}");
        }
    }
}

#[test]
fn panels_fill_rows_by_their_spans() {
    let one = panel(&[0.0, 1.0], &[0.0, 1.0]);
    let wide = PanelDocument { span: 2, ..one.clone() };
    let mut grid = figure(vec![wide, one.clone(), one.clone(), one]);
    grid.columns = 3;
    let height = |figure: &FigureDocument| {
        let picture = svg(figure, &Size::default()).unwrap();
        let view = picture.split_once("viewBox=\"0 0 900 ").unwrap().1;
        view.split_once('"').unwrap().0.parse::<f64>().unwrap()
    };
    let in_a_grid = height(&grid);
    grid.columns = 1;
    assert!(in_a_grid < 0.6 * height(&grid), "two rows instead of four");
}

/// The places of all images: x, y, width, height.
fn images(picture: &str) -> Vec<[f64; 4]> {
    let number = |text: &str, name: &str| -> f64 {
        let rest = text.split_once(&format!(" {name}=\"")).unwrap().1;
        rest.split_once('"').unwrap().0.parse().unwrap()
    };
    let elements = picture.split("<image").skip(1);
    elements.map(|text| ["x", "y", "width", "height"].map(|name| number(text, name))).collect()
}

fn map_panel(heading: &str, labels: (&str, &str), (across, up): (usize, usize)) -> PanelDocument {
    let of = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<f64>>();
    let z = (0..up).map(|j| (0..across).map(|i| (i * j) as f64).collect()).collect();
    let (x, y, colours) = (of(across), of(up), ColoursName::Cividis);
    let map = MapDocument { x, y, z, z_label: "u".into(), colours, z_range: None };
    PanelDocument { map: Some(map), ..PanelDocument::new(heading, labels) }
}

#[test]
fn a_surface_has_one_scale_for_both_of_its_axes() {
    for (across, up) in [(20, 10), (10, 10), (10, 30), (60, 12)] {
        let panel = map_panel("", ("x (nm)", "y (nm)"), (across, up));
        let picture = svg(&figure(vec![panel]), &Size::default()).unwrap();
        let [_, _, width, height] = images(&picture)[0];
        let wanted = across as f64 / up as f64;
        assert!((width / height - wanted).abs() < 1e-3 * wanted, "{across} {up}: {width} {height}");
    }
    // Passes have no scale in common with a length.
    let passes = map_panel("", ("x (σ)", "pass"), (10, 30));
    let picture = svg(&figure(vec![passes]), &Size::default()).unwrap();
    let [_, _, width, height] = images(&picture)[0];
    assert!(width > height);
}

#[test]
fn numbers_beside_a_low_map_do_not_run_into_each_other() {
    let panel = map_panel("", ("x (σ)", "y (σ)"), (70, 7));
    let picture = svg(&figure(vec![panel]), &Size::default()).unwrap();
    let of = |line: &str| line.split_once(" y=\"")?.1.split_once('"')?.0.parse::<f64>().ok();
    let at: Vec<f64> =
        picture.lines().filter(|line| line.contains("\"end\"")).filter_map(of).collect();
    assert!(at.len() > 1 && at.windows(2).all(|pair| pair[0] - pair[1] > 14.0), "{at:?}");
}

#[test]
fn panels_of_a_pair_are_of_one_size_whatever_their_headings() {
    let long =
        "ripples of a heading that is wrapped into some lines because it is so long: coherence 1";
    let one = map_panel(long, ("x (σ)", "y (σ)"), (30, 20));
    let mut other = map_panel("short", ("support at x (σ)", "y (σ)"), (30, 20));
    // Longer numbers beside the bar.
    other.map.as_mut().unwrap().z[3][3] = 123_456.0;
    let mut pair = figure(vec![one, other]);
    pair.columns = 2;
    let [a, b] = images(&svg(&pair, &Size::default()).unwrap())[..] else { panic!() };
    assert_eq!(a[1..], b[1..]);
    // On a narrow page one is below the other, as large as the page allows.
    let narrow = Size::new(Some("85mm".parse().unwrap()), None).unwrap();
    let [a, b] = images(&svg(&pair, &narrow).unwrap())[..] else { panic!() };
    assert!(b[1] > a[1] + a[3] && a[2] > 250.0, "{a:?} {b:?}");
}

#[test]
fn the_bar_of_a_map_says_at_which_end_colours_are_clipped() {
    let triangles = |range: Option<[f64; 2]>| {
        let mut panel = map_panel("", ("x (σ)", "y (σ)"), (5, 5));
        panel.map.as_mut().unwrap().z_range = range;
        let picture = svg(&figure(vec![panel]), &Size::default()).unwrap();
        let bar = picture.rsplit_once("<image").unwrap().1;
        bar.lines().filter(|line| line.contains("Z\"") && line.contains("fill=\"#")).count()
    };
    let counts = [None, Some([0.0, 16.0]), Some([2.0, 16.0]), Some([0.0, 9.0]), Some([3.0, 9.0])];
    assert_eq!(counts.map(triangles), [0, 0, 1, 1, 2]);
}

#[test]
fn lines_over_cells_have_a_light_edge() {
    let mut panel = panel(&[0.0, 2.0], &[0.0, 2.0]);
    let edges = |panel: &PanelDocument| {
        let picture = svg(&figure(vec![panel.clone()]), &Size::default()).unwrap();
        picture.matches("stroke=\"#ffffff\"").count()
    };
    assert_eq!(edges(&panel), 0);
    let (kinds, names) = (vec![vec![Some(0); 3]; 3], vec!["trapped".into()]);
    let (x, y, colours) = (vec![0.0, 1.0, 2.0], vec![0.0, 1.0, 2.0], vec![ColourName::Black]);
    panel.cells = Some(CellsDocument { x, y, kinds, names, colours });
    assert_eq!(edges(&panel), 1);
}

fn read_figure(text: &str) -> FigureDocument {
    stickslip::read(text, FigureDocument::FORMAT).unwrap()
}

#[test]
fn a_figure_reads_back_as_it_was_and_leaves_out_what_is_plain() {
    let mut figure = figure(vec![panel(&[0.0, 1.0], &[0.0, 1.0])]);
    let plain = serde_json::to_string(&figure).unwrap();
    for field in
        ["columns", "x_range", "x_scale", "notes", "shades", "span", "colour", "low", "cells"]
    {
        assert!(!plain.contains(&format!("\"{field}\"")), "{field}: {plain}");
    }
    figure.columns = 2;
    figure.panels[0].x_scale = ScaleName::Logarithmic;
    figure.panels[0].curves[0].colour = Some(ColourName::Green);
    let text = serde_json::to_string(&figure).unwrap();
    let again = of(&read_figure(&text), &View::default()).unwrap();
    assert_eq!(serde_json::to_string(&again).unwrap(), text);
}

#[test]
fn a_map_that_does_not_fit_its_axes_is_refused() {
    let text = r#"{"format":"stickslip/figure","format_version":1,"software":{"name":"","version":""},"name":"",
        "title":"","parameters":{"models":[]},"remarks":[],"panels":[{"heading":"","x_label":"","y_label":"",
        "curves":[],"map":{"x":[0,1],"y":[0],"z":[[1]],"z_label":"","colours":"grey"},"y_range":null}]}"#;
    let error = of(&read_figure(text), &View::default()).unwrap_err();
    assert!(error.to_string().contains("as many rows and columns"), "{error}");
}

/// The finding: 2,000 samples of a long run miss its slips.
#[test]
fn a_run_is_drawn_from_its_history_and_not_from_its_samples() {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let model = Model::new(tip, 1.9, 1.0).unwrap();
    let scenario =
        stickslip_tip::Scenario { kick: 0.1, ..stickslip_tip::Scenario::new(model, 1500.0) };
    let run = stickslip_tip::run(&scenario).unwrap();
    let steps = run.trajectory.steps();
    let fine = steps
        .iter()
        .flat_map(|s| (0..200).map(move |i| s.velocity(s.t + s.h * f64::from(i) / 200.0)));
    let highest = fine.fold(0.0, f64::max);
    let document = document(&scenario, &run.trajectory);
    let figure = of(&document, &View::default()).unwrap();
    let velocity = figure.panels.iter().find(|p| p.y_label.contains("kσ/Γ")).unwrap();
    let drawn = velocity.curves[0].y.iter().flatten().fold(0.0_f64, |m, v| m.max(*v));
    assert!((drawn - highest).abs() < 1e-2 * highest, "{drawn} {highest}");
    // Three samples tell nothing.
    assert!(document.samples.t.len() == 3 && highest > 2.0);
    let detail =
        of(&document, &View { x_range: Some([1400.0, 1440.0]), ..View::default() }).unwrap();
    assert_eq!(detail.panels[0].x_range, Some([1400.0, 1440.0]));
    assert!(detail.panels[0].curves[0].x.iter().all(|t| (1400.0..=1440.0).contains(t)));
}

/// The question with this scenario.
pub(crate) fn question(scenario: &stickslip_tip::Scenario) -> Run {
    let model = &scenario.model;
    let (tip, alpha) = (Tip(model.tip().clone()), Indentation::given(model.alpha()));
    Run {
        start_position: scenario.start_position,
        kick: scenario.kick,
        ..Run::new(tip, alpha, model.r(), scenario.until)
    }
}

fn document(
    scenario: &stickslip_tip::Scenario,
    trajectory: &stickslip_tip::Trajectory,
) -> RunDocument {
    let parameters = question(scenario);
    let model: ModelParameters = parameters.model_parameters();
    let text = serde_json::json!({
        "format": "stickslip/run", "format_version": 1, "software": {"name": "", "version": ""},
        "parameters": parameters, "steady_state": {"l": scenario.model.steady_l(), "lag": 0.0, "surface_behind": null},
        "samples": {"t": [0.0, 1.0, 2.0], "l": [0.0, 0.0, 0.0], "x0": [0.0, 0.0, 0.0], "velocity": [0.0, 0.0, 0.0]},
        "history": stickslip::History::from(trajectory), "regime": "transient", "oscillation": null,
        "interrupted": false,
        "work": {"memory": "", "memory_reason": "", "steps": 0, "rejected": 0, "newton_iterations": 0, "seconds": 0.0},
    });
    assert!((model.alpha - 1.9).abs() < 1e-12);
    serde_json::from_value(text).unwrap()
}
