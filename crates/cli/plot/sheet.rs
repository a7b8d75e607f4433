//! Panels one below the other under a title, as one SVG document.

use super::panel::Panel;
use super::style::{TITLE_SIZE, WIDTH, text_width};
use kuva::backend::svg::SvgBackend;
use kuva::render::render::{Primitive, Scene, TextAnchor};

const TITLE_LINE: f64 = 1.4 * TITLE_SIZE as f64;

/// Draws the panels with their axes aligned.
pub(super) fn sheet(title: &str, panels: &[Panel]) -> String {
    let title = wrapped(title);
    let head = if title.is_empty() { 0.0 } else { 8.0 + TITLE_LINE * title.len() as f64 };
    let height = head + panels.iter().map(|p| p.height).sum::<f64>();
    let left = panels.iter().map(Panel::margin_left).fold(0.0, f64::max);
    let right = WIDTH - panels.iter().map(Panel::margin_right).fold(0.0, f64::max);

    let mut scene = Scene::new(WIDTH, height);
    for (i, line) in title.into_iter().enumerate() {
        scene.add(title_line(i, line));
    }
    let mut top = head;
    let mut images = String::new();
    for (i, panel) in panels.iter().enumerate() {
        place(panel.draw((left, right)), i, top, &mut scene);
        images.extend(panel.image((left, right), top));
        top += panel.height;
    }
    let svg = SvgBackend::new().render_scene(&scene);
    // kuva has no pictures.
    let svg = svg.replacen("</svg>", &format!("{images}</svg>"), 1);
    // kuva gives no viewBox, without which a browser crops the figure instead of scaling it.
    svg.replacen("<svg ", &format!("<svg viewBox=\"0 0 {WIDTH} {height}\" "), 1)
}

/// Moves a panel into the sheet. kuva numbers its clip paths through the life of the process;
/// numbered through the sheet, they are the same in every run.
fn place(panel: Scene, index: usize, top: f64, scene: &mut Scene) {
    let clip = format!("panel-{index}");
    let mut defs = panel.defs;
    scene.font_family = panel.font_family;
    scene.text_color = panel.text_color;
    scene.add(Primitive::GroupStart {
        transform: Some(format!("translate(0 {top})")),
        title: None,
        extra_attrs: None,
    });
    for element in panel.elements {
        if let Primitive::ClipStart { x, y, width, height, id } = element {
            let (old, new) = (format!("\"{id}\""), format!("\"{clip}\""));
            defs.iter_mut().for_each(|def| *def = def.replace(&old, &new));
            scene.add(Primitive::ClipStart { x, y, width, height, id: clip.clone() });
        } else {
            scene.add(element);
        }
    }
    scene.add(Primitive::GroupEnd);
    scene.defs.extend(defs);
}

fn title_line(index: usize, content: String) -> Primitive {
    Primitive::Text {
        x: 0.5 * WIDTH,
        y: 8.0 + TITLE_LINE * (index as f64 + 0.75),
        content,
        size: TITLE_SIZE,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: None,
    }
}

/// Breaks a text between words into lines that fit the sheet.
fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(line, TITLE_SIZE) + text_width(word, TITLE_SIZE) < 840.0 => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
