//! Animations as viewers see them: each file is decoded by the decoders of its crates, and its pixels are compared with
//! the surface at the time of each frame, which `stickslip-surface` and `stickslip-raster` compute.

use super::{Film, animate};
use crate::format::AnimationFormat;
use crate::scene::Shot;
use crate::sheet::Sheet;
use crate::size::Width;
use crate::{FigureError, colours, scene_of};
use serde_json::json;
use std::io::Cursor;
use stickslip::{
    Ask, Context, KnownScales, PathName, Raster, RasterDocument, Run, RunDocument, Tip,
};
use stickslip_raster::{Line, Plan, Scanned, Scanning};
use stickslip_surface::Surface;
use stickslip_tip::{Model, Scenario, TipFunction, Trajectory};

const SIZE: f64 = 400.0;
/// Width of the line of the surface, in pixels.
const LINE: f64 = 1.6;
const FORMATS: [AnimationFormat; 3] =
    [AnimationFormat::Gif, AnimationFormat::Webp, AnimationFormat::Apng];

/// A frame as a viewer shows it, and its duration in milliseconds.
struct Seen {
    size: (usize, usize),
    rgb: Vec<[u8; 3]>,
    milliseconds: u32,
}

impl Seen {
    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        self.rgb[self.size.0 * y + x]
    }
}

/// A rectangle of RGBA pixels drawn over the frame before.
struct Drawn {
    place: [usize; 4],
    rgba: Vec<u8>,
    milliseconds: u32,
}

fn composed(size: (usize, usize), parts: Vec<Drawn>) -> Vec<Seen> {
    let mut canvas = vec![[0; 3]; size.0 * size.1];
    let draw = |Drawn { place: [left, top, width, height], rgba, milliseconds }: Drawn| {
        assert!(left + width <= size.0 && top + height <= size.1);
        for (i, pixel) in rgba.chunks_exact(4).enumerate().filter(|(_, p)| p[3] == 255) {
            let (x, y) = (left + i % width, top + i / width);
            canvas[size.0 * y + x] = [pixel[0], pixel[1], pixel[2]];
        }
        Seen { size, rgb: canvas.clone(), milliseconds }
    };
    parts.into_iter().map(draw).collect()
}

fn seen(bytes: &[u8], format: AnimationFormat) -> Vec<Seen> {
    match format {
        AnimationFormat::Gif => seen_gif(bytes),
        AnimationFormat::Webp => seen_webp(bytes),
        AnimationFormat::Apng => seen_apng(bytes),
    }
}

fn seen_gif(bytes: &[u8]) -> Vec<Seen> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).unwrap();
    let size = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut parts = vec![];
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!(frame.dispose, gif::DisposalMethod::Keep);
        parts.push(Drawn {
            place: [frame.left, frame.top, frame.width, frame.height].map(usize::from),
            rgba: frame.buffer.to_vec(),
            milliseconds: 10 * u32::from(frame.delay),
        });
    }
    composed(size, parts)
}

fn seen_apng(bytes: &[u8]) -> Vec<Seen> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let info = reader.info();
    let size = (info.width as usize, info.height as usize);
    let count = info.animation_control.unwrap().num_frames;
    let mut parts = vec![];
    for _ in 0..count {
        let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
        let output = reader.next_frame(&mut rgba).unwrap();
        rgba.truncate(output.buffer_size());
        let control = *reader.info().frame_control().unwrap();
        let place = [control.x_offset, control.y_offset, control.width, control.height];
        let milliseconds = u32::from(control.delay_num);
        assert_eq!(control.delay_den, 1000);
        parts.push(Drawn { place: place.map(|side| side as usize), rgba, milliseconds });
    }
    composed(size, parts)
}

fn seen_webp(bytes: &[u8]) -> Vec<Seen> {
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).unwrap();
    let size = (decoder.dimensions().0 as usize, decoder.dimensions().1 as usize);
    let mut buffer = vec![0; decoder.output_buffer_size().unwrap()];
    let mut frames = vec![];
    for _ in 0..decoder.num_frames() {
        let milliseconds = decoder.read_frame(&mut buffer).unwrap();
        let rgb = buffer.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
        frames.push(Seen { size, rgb, milliseconds });
    }
    frames
}

fn film() -> Film {
    Film::new(Some(0.6), Some(10.0), Some(Width::Pixels(SIZE))).unwrap()
}

fn close(a: [u8; 3], b: [u8; 3], within: u8) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= within)
}

fn scenario() -> Scenario {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let model = Model::new(tip, 1.3, 1.0).unwrap();
    Scenario { kick: 0.1, ..Scenario::new(model, 60.0) }
}

fn run_document(scenario: &Scenario, trajectory: &Trajectory) -> RunDocument {
    let text = serde_json::json!({
        "format": "stickslip/run", "format_version": 1, "software": {"name": "", "version": ""},
        "parameters": crate::tests::question(scenario),
        "steady_state": {"l": scenario.model.steady_l(), "lag": 0.0, "surface_behind": null},
        "samples": {"t": [0.0], "l": [0.0], "x0": [0.0], "velocity": [0.0]},
        "history": stickslip::History::from(trajectory), "regime": "transient", "oscillation": null,
        "interrupted": false,
        "work": {"memory": "", "memory_reason": "", "steps": 0, "rejected": 0, "newton_iterations": 0, "seconds": 0.0},
    });
    serde_json::from_value(text).unwrap()
}

/// In every column, the polymer begins at the height that the surface has at the time of the frame.
#[test]
fn every_frame_of_a_run_shows_the_surface_at_its_time() {
    let scenario = scenario();
    let run = stickslip_tip::run(&scenario).unwrap();
    let document = run_document(&scenario, &run.trajectory);
    let initial = scenario.initial_surface().unwrap();
    let surface = Surface::new(&scenario.model, &initial, &run.trajectory);
    let shot = Shot { times: Some([40.0, 58.0]), ..Shot::default() };
    for format in FORMATS {
        let mut scene = scene_of(&document, &shot).unwrap();
        let still = scene.still();
        let bytes = animate(&mut *scene, format, &film()).unwrap();
        let frames = seen(&bytes, format);
        let times = film().times([40.0, 58.0]);
        assert_eq!(frames.len(), times.len());
        let sheet = Sheet::of(&still, SIZE);
        let axes = sheet.frames()[0];
        let mut judged = 0;
        for (frame, (t, milliseconds)) in frames.iter().zip(times) {
            assert_eq!(frame.milliseconds, milliseconds);
            let tip = axes.place((run.trajectory.x0(t), 0.0)).unwrap().0;
            let support = axes.place((t, 0.0)).unwrap().0;
            let columns = axes.at.left as usize + 3..axes.at.right as usize - 3;
            let x_of = |column: f64| {
                let part = (column - axes.at.left) / axes.at.width();
                axes.x.low + part * (axes.x.high - axes.x.low)
            };
            for column in columns {
                let middle = column as f64 + 0.5;
                // Tip, spring and support stand before the surface.
                if middle > tip.min(support) - 14.0 && middle < tip.max(support) + 14.0 {
                    continue;
                }
                let x = [x_of(middle - 0.5), x_of(middle), x_of(middle + 0.5)];
                let u = surface.heights(t, &x).unwrap();
                let y: Vec<f64> =
                    x.iter().zip(&u).map(|(x, u)| axes.place((*x, *u)).unwrap().1).collect();
                let (high, low) = (y[0].min(y[1]).min(y[2]), y[0].max(y[1]).max(y[2]));
                // Half of the line, whose slope makes it higher, and a pixel for its soft edge.
                let margin = 0.5 * LINE * 1_f64.hypot(low - high) + 1.0;
                let is_polymer = |row: usize| close(frame.at(column, row), [0xF3, 0xE3, 0xC3], 12);
                let bottom = axes.at.bottom as usize - 3;
                for row in (low + margin).ceil() as usize..bottom {
                    assert!(is_polymer(row), "{format:?} t = {t}, {column} {row}: {high} {low}");
                }
                for row in axes.at.top as usize + 2..(high - margin).floor() as usize {
                    assert!(!is_polymer(row), "{format:?} t = {t}, {column} {row}: {high} {low}");
                }
                let line = frame.at(column, y[1] as usize);
                assert!(
                    line[2] > line[0].saturating_add(40),
                    "no line at {column} {}: {line:?}",
                    y[1]
                );
                judged += 1;
            }
        }
        assert!(judged > 150 * frames.len(), "{judged}");
    }
}

#[test]
fn equal_scenes_give_equal_bytes() {
    let scenario = scenario();
    let run = stickslip_tip::run(&scenario).unwrap();
    let document = run_document(&scenario, &run.trajectory);
    let film = Film::new(Some(0.5), Some(4.0), Some(Width::Pixels(300.0))).unwrap();
    for format in FORMATS {
        let bytes = || animate(&mut *scene_of(&document, &Shot::default()).unwrap(), format, &film);
        assert!(bytes().unwrap() == bytes().unwrap(), "{format:?}");
    }
}

#[test]
fn a_scene_in_nanometres_has_its_tip_and_times_there_too() {
    let scenario = scenario();
    let run = stickslip_tip::run(&scenario).unwrap();
    let document = run_document(&scenario, &run.trajectory);
    let scales = KnownScales { length: Some(30e-9), time: Some(0.5), height: None, force: None };
    let shot = Shot { times: Some([20.0, 29.0]), scales: Some(scales) };
    let mut scene = scene_of(&document, &shot).unwrap();
    assert!((scene.times()[0] - 20.0).abs() < 1e-9 && (scene.times()[1] - 29.0).abs() < 1e-9);
    let moment = scene.moment(25.0).unwrap();
    assert!((moment.tip.0 - 30.0 * run.trajectory.x0(50.0)).abs() < 1e-9, "{:?}", moment.tip);
    assert!((moment.support.unwrap().0 - 30.0 * 50.0).abs() < 1e-9 && moment.unit == "s");
    assert!(moment.panels[0].x_label == "x (nm)" && moment.panels[0].y_label == "u (kσ²/a)");
    let nothing = Shot { times: Some([900.0, 901.0]), scales: Some(scales) };
    let error = scene_of(&document, &nothing).map(|_| ()).unwrap_err();
    assert!(matches!(error, FigureError::Still(_)), "{error}");
}

/// A run in the plane that swings across its line; the tip has not been where x > 44.
fn swinging() -> RunDocument {
    let parameters = serde_json::json!({
        "alpha": 1.3, "r": 1.0, "kick": 0.05, "until": 42.0, "tolerance": 1e-7, "stiffness_across": 0.25,
        "kick_across": 0.6,
    });
    let question: Run = serde_json::from_value(parameters).unwrap();
    question.ask(&Context::default()).unwrap()
}

/// The heights of a scene against those under the tip that its equation of motion has: with Γ = 1,
/// `R - x0 = x0' + ∂u/∂x` and `-κ_y y0 = y0' + ∂u/∂y`. The tip is in its pit, and the support on its line.
#[test]
fn a_run_in_the_plane_has_the_surface_that_pulls_on_its_tip() {
    let document = swinging();
    let (_, trajectory) = document.trajectory_across().unwrap();
    let shot = Shot { times: Some([24.0, 40.0]), ..Shot::default() };
    let mut scene = scene_of(&document, &shot).unwrap();
    // Not in order: a scene can be shown again.
    for t in [40.0, 24.0, 31.7, 36.2] {
        let moment = scene.moment(t).unwrap();
        let (x0, y0) = (trajectory.x0(t), trajectory.y0(t));
        assert_eq!((moment.tip, moment.support), ((x0, y0), Some((t, 0.0))));
        let map = moment.panels[0].map.as_ref().unwrap();
        let (i, j) =
            (map.x.partition_point(|x| *x < x0) - 1, map.y.partition_point(|y| *y < y0) - 1);
        let (h, k) = (map.x[1] - map.x[0], map.y[1] - map.y[0]);
        // Quadratic in both coordinates around the nearest point of the map.
        let (a, b) = ((x0 - map.x[i]) / h, (y0 - map.y[j]) / k);
        let along = |row: &[f64]| {
            (row[i + 1] - row[i - 1]) / (2.0 * h) + a * (row[i + 1] - 2.0 * row[i] + row[i - 1]) / h
        };
        let slope = (1.0 - b) * along(&map.z[j]) + b * along(&map.z[j + 1]);
        let force = trajectory.lag(t) - trajectory.velocity(t)[0];
        assert!((force - slope).abs() < 5e-3, "t = {t}: {force} {slope}");
        let across = |i: usize| {
            (map.z[j + 1][i] - map.z[j - 1][i]) / (2.0 * k)
                + b * (map.z[j + 1][i] - 2.0 * map.z[j][i] + map.z[j - 1][i]) / k
        };
        let slope = (1.0 - a) * across(i) + a * across(i + 1);
        let force = -0.25 * y0 - trajectory.velocity(t)[1];
        assert!((force - slope).abs() < 5e-3, "t = {t}: {force} {slope}");
        let swing = moment.panels[2].curves[1].y[0].unwrap();
        assert!(moment.panels.len() == 3 && (swing - y0).abs() < 1e-12);
    }
}

/// The first frame shows the end of the motion: nothing of it remains where the tip has not yet been.
#[test]
fn no_trace_of_the_end_remains_at_the_beginning() {
    let document = swinging();
    let film = Film::new(Some(0.5), Some(10.0), Some(Width::Pixels(SIZE))).unwrap();
    let shot = Shot { times: Some([24.0, 40.0]), ..Shot::default() };
    for format in FORMATS {
        let mut scene = scene_of(&document, &shot).unwrap();
        let still = scene.still();
        let frames = seen(&animate(&mut *scene, format, &film).unwrap(), format);
        let sheet = Sheet::of(&still, SIZE);
        let axes = sheet.frames()[0];
        // Below the time, and beyond the reach of the tip at t = 24.
        let columns = axes.place((33.0, 0.0)).unwrap().0 as usize..axes.at.right as usize - 3;
        let rows = (axes.at.top + 0.75 * axes.at.height()) as usize..axes.at.bottom as usize - 3;
        let colours = |frame: &Seen| -> std::collections::BTreeSet<[u8; 3]> {
            let at = |row| columns.clone().map(move |column| frame.at(column, row));
            rows.clone().flat_map(at).collect()
        };
        assert!(colours(&frames[0]).len() > 10, "{format:?}");
        assert_eq!(colours(&frames[1]).len(), 1, "{format:?}");
    }
}

/// A raster of eight lines of length 14; of a free tip with this stiffness.
fn question(path: PathName, healing_time: Option<f64>, stiffness: Option<f64>) -> Raster {
    let values = json!({
        "tip": Tip(TipFunction::gaussian(1.0).unwrap()), "alpha": 0.6, "r": 1.0, "width_y": 1.3, "path": path,
        "healing_time": healing_time, "pitch": 0.7, "lines": 8, "length": 14.0,
        "stiffness_across": stiffness, "kick_across": stiffness.map(|_| 0.4),
    });
    serde_json::from_value(values).unwrap()
}

fn scanned(question: &Raster) -> (Plan, Vec<Line>, RasterDocument) {
    let plan = question.plan().unwrap();
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    let document = question.clone().document(&plan, &lines, &[]);
    (plan, lines, document)
}

/// The heights of a scene against those by the transform of all lines, at the end of each line and within a line.
#[test]
fn a_growing_raster_has_the_surface_of_its_lines() {
    for (path, healing_time, stiffness) in [
        (PathName::OneWay, None, None),
        (PathName::Zigzag, None, None),
        (PathName::Zigzag, Some(40.0), None),
        (PathName::OneWay, None, Some(0.5)),
        (PathName::Zigzag, Some(40.0), Some(0.5)),
    ] {
        let (plan, lines, document) = scanned(&question(path, healing_time, stiffness));
        let mut scene = scene_of(&document, &Shot::default()).unwrap();
        let mut judge = |t: f64, lines: &[Line]| {
            let moment = scene.moment(t).unwrap();
            let map = moment.panels[0].map.as_ref().unwrap();
            let wanted = Scanned::new(&plan, lines).heights(&map.x, &map.y);
            let off = map.z.iter().flatten().zip(&wanted).map(|(a, b)| (a - b).abs());
            let off = off.fold(0.0, f64::max);
            assert!(
                off < 1e-10 && (map.z.len() == 8 || stiffness.is_some()),
                "{path:?} {healing_time:?} {t}: {off:e}"
            );
        };
        // Not in order: a scene can be shown again.
        for n in [8, 1, 5, 3] {
            judge(14.0 * f64::from(n) - 1e-12, &lines[..n as usize]);
        }
        if healing_time.is_none() && stiffness.is_none() {
            let steps = lines[4].trajectory().steps();
            let some = steps[..steps.len() / 2].to_vec();
            let t = 4.0 * 14.0 + some[some.len() - 1].end();
            let part = Line::new(lines[4].track(), &plan.law.model, some, lines[4].work());
            let all: Vec<Line> = lines[..4].iter().cloned().chain([part]).collect();
            judge(t, &all);
        }
        let moment = scene.moment(14.0 * 3.5).unwrap();
        assert!((moment.tip.1 - lines[3].y0(7.0)).abs() < 1e-9, "{:?}", moment.tip);
    }
}

/// In each frame the map has the colours of the heights at its time, where these vary little.
#[test]
fn every_frame_of_a_raster_shows_the_heights_at_its_time() {
    let (_, _, document) = scanned(&question(PathName::Zigzag, None, None));
    let film = Film::new(Some(0.5), Some(10.0), Some(Width::Pixels(SIZE))).unwrap();
    for format in FORMATS {
        let mut scene = scene_of(&document, &Shot::default()).unwrap();
        let (still, times) = (scene.still(), film.times(scene.times()));
        let bytes = animate(&mut *scene, format, &film).unwrap();
        let frames = seen(&bytes, format);
        let sheet = Sheet::of(&still, SIZE);
        let axes = sheet.frames()[0];
        let (mut judged, mut colours_seen) = (0, std::collections::BTreeSet::new());
        for (frame, (t, _)) in frames.iter().zip(times) {
            let moment = scene.moment(t).unwrap();
            let map = moment.panels[0].map.as_ref().unwrap();
            let [low, high] = map.z_range.unwrap();
            let colour = |z: f64| colours::at(map.colours, (z - low) / (high - low));
            let tip = axes.place(moment.tip).unwrap();
            let support = axes.place(moment.support.unwrap()).unwrap();
            for (row, y) in map.z.iter().zip(&map.y).skip(1).take(5) {
                for i in 1..map.x.len() - 1 {
                    let at = axes.place((map.x[i], *y)).unwrap();
                    let hidden = (at.1 - tip.1).abs() < 12.0
                        && at.0 > tip.0.min(support.0) - 12.0
                        && at.0 < tip.0.max(support.0) + 12.0;
                    let around = [row[i - 1], row[i + 1]].map(colour);
                    if hidden || !close(around[0], around[1], 10) {
                        continue;
                    }
                    let found = frame.at(at.0 as usize, at.1 as usize);
                    assert!(
                        close(found, colour(row[i]), 14),
                        "{format:?} t = {t}, {at:?}: {found:?} {:?}",
                        colour(row[i])
                    );
                    judged += 1;
                    colours_seen.insert(found);
                }
            }
        }
        assert!(judged > 400 && colours_seen.len() > 20, "{judged} {}", colours_seen.len());
    }
}

#[test]
fn what_does_not_move_is_refused_with_what_does() {
    let figure = stickslip::FigureDocument::new("still", "", vec![], vec![]);
    let error = scene_of(&figure, &Shot::default()).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("run or raster") && error.contains(".png"), "{error}");
    let name = crate::FigureFormat::of(std::path::Path::new("a/b.gif")).unwrap_err().to_string();
    assert!(name.contains("stickslip plot RUN.json -o b.gif"), "{name}");
}
