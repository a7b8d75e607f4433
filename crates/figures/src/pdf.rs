//! SVG to PDF: its shapes, one by one. Texts are outlines.

use crate::error::FigureError;
use crate::vector::tree;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};
use resvg::tiny_skia::{PathSegment, Pixmap, Transform};
use resvg::usvg::{ClipPath, Fill, Group, ImageKind, LineCap, LineJoin, Node, Paint, Path, Stroke};

/// Compression level of zlib, a compromise of size and time.
const LEVEL: u8 = 6;
/// Points per unit.
const POINT: f32 = 0.5;

/// A page of the size of `svg`, without a background.
pub(crate) fn pdf(svg: &str) -> Result<Vec<u8>, FigureError> {
    let tree = tree(svg)?;
    let (width, height) = (POINT * tree.size().width(), POINT * tree.size().height());
    // PDF counts upward from the foot of the page.
    let page = Transform::from_row(POINT, 0.0, 0.0, -POINT, 0.0, height);
    let mut drawing = Drawing { content: Content::new(), opacities: vec![], images: vec![] };
    drawing.images(tree.root(), page);
    drawing.group(tree.root(), page);
    Ok(drawing.file(width, height))
}

struct Drawing {
    content: Content,
    /// Opacities in use.
    opacities: Vec<f32>,
    /// Width, height and pixels of each image.
    images: Vec<(i32, i32, Vec<u8>)>,
}

impl Drawing {
    fn group(&mut self, group: &Group, page: Transform) {
        self.content.save_state();
        if let Some(clip) = group.clip_path() {
            self.clip(clip, page.pre_concat(group.abs_transform()));
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, page),
                Node::Path(path) => self.path(path, page),
                Node::Text(text) => self.group(text.flattened(), page),
                Node::Image(_) => {}
            }
        }
        self.content.restore_state();
    }

    fn clip(&mut self, clip: &ClipPath, place: Transform) {
        let place = place.pre_concat(clip.transform());
        for node in clip.root().children() {
            if let Node::Path(path) = node {
                self.outline(path, place.pre_concat(path.abs_transform()));
            }
        }
        self.content.clip_nonzero().end_path();
    }

    fn path(&mut self, path: &Path, page: Transform) {
        let place = page.pre_concat(path.abs_transform());
        if let Some((fill, colour)) = path.fill().and_then(|f: &Fill| Some((f, rgb(f.paint())?))) {
            self.with_opacity(fill.opacity().get(), |drawing| {
                drawing.content.set_fill_rgb(colour[0], colour[1], colour[2]);
                drawing.outline(path, place);
                drawing.content.fill_nonzero();
            });
        }
        if let Some((stroke, colour)) =
            path.stroke().and_then(|s: &Stroke| Some((s, rgb(s.paint())?)))
        {
            self.with_opacity(stroke.opacity().get(), |drawing| {
                drawing.pen(stroke, colour, place.sx.hypot(place.ky));
                drawing.outline(path, place);
                drawing.content.stroke();
            });
        }
    }

    fn pen(&mut self, stroke: &Stroke, colour: [f32; 3], scale: f32) {
        let content = &mut self.content;
        content.set_stroke_rgb(colour[0], colour[1], colour[2]);
        content.set_line_width(scale * stroke.width().get());
        content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        content.set_line_join(match stroke.linejoin() {
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
        });
        let dashes = stroke.dasharray().unwrap_or(&[]).iter().map(|d| scale * d);
        content.set_dash_pattern(dashes, scale * stroke.dashoffset());
    }

    fn outline(&mut self, path: &Path, place: Transform) {
        let Some(data) = path.data().clone().transform(place) else { return };
        let mut last = (0.0, 0.0);
        for segment in data.segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    self.content.move_to(p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::LineTo(p) => {
                    self.content.line_to(p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::QuadTo(c, p) => {
                    // PDF has cubic arcs alone.
                    let toward = |from: f32, to: f32| from + (to - from) * 2.0 / 3.0;
                    let first = (toward(last.0, c.x), toward(last.1, c.y));
                    let second = (toward(p.x, c.x), toward(p.y, c.y));
                    self.content.cubic_to(first.0, first.1, second.0, second.1, p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                    last = (p.x, p.y);
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    /// Calls `draw` with this opacity.
    fn with_opacity(&mut self, opacity: f32, draw: impl FnOnce(&mut Self)) {
        if opacity >= 1.0 {
            return draw(self);
        }
        let known = self.opacities.iter().position(|o| (o - opacity).abs() < 1e-4);
        let index = known.unwrap_or_else(|| {
            self.opacities.push(opacity);
            self.opacities.len() - 1
        });
        self.content.save_state();
        self.content.set_parameters(Name(format!("o{index}").as_bytes()));
        draw(self);
        self.content.restore_state();
    }

    /// Draws all images, which are below everything else.
    fn images(&mut self, group: &Group, page: Transform) {
        for node in group.children() {
            match node {
                Node::Group(group) => self.images(group, page),
                Node::Image(image) => {
                    let ImageKind::PNG(bytes) = image.kind() else { continue };
                    let Ok(picture) = Pixmap::decode_png(bytes) else { continue };
                    let (width, height) = (picture.width(), picture.height());
                    // A picture of PDF is a unit square that stands on its foot.
                    let square = Transform::from_row(
                        width as f32,
                        0.0,
                        0.0,
                        -(height as f32),
                        0.0,
                        height as f32,
                    );
                    let place = page.pre_concat(image.abs_transform()).pre_concat(square);
                    let index = self.images.len();
                    let rgb = picture.data().chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
                    self.images.push((width as i32, height as i32, rgb));
                    self.content.save_state();
                    self.content
                        .transform([place.sx, place.ky, place.kx, place.sy, place.tx, place.ty]);
                    self.content.x_object(Name(format!("i{index}").as_bytes()));
                    self.content.restore_state();
                }
                _ => {}
            }
        }
    }

    fn file(self, width: f32, height: f32) -> Vec<u8> {
        let [catalog, pages, page, contents] = [1, 2, 3, 4].map(Ref::new);
        let object = |index: usize| Ref::new(5 + index as i32);
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let mut written = pdf.page(page);
        written.parent(pages).media_box(Rect::new(0.0, 0.0, width, height)).contents(contents);
        let mut resources = written.resources();
        let mut states = resources.ext_g_states();
        for index in 0..self.opacities.len() {
            states.pair(Name(format!("o{index}").as_bytes()), object(index));
        }
        states.finish();
        let mut objects = resources.x_objects();
        for index in 0..self.images.len() {
            let image = object(self.opacities.len() + index);
            objects.pair(Name(format!("i{index}").as_bytes()), image);
        }
        objects.finish();
        resources.finish();
        written.finish();
        let packed = compress_to_vec_zlib(&self.content.finish(), LEVEL);
        pdf.stream(contents, &packed).filter(Filter::FlateDecode);
        for (index, opacity) in self.opacities.iter().enumerate() {
            let mut state = pdf.ext_graphics(object(index));
            state.non_stroking_alpha(*opacity).stroking_alpha(*opacity);
        }
        for (index, (width, height, pixels)) in self.images.iter().enumerate() {
            let packed = compress_to_vec_zlib(pixels, LEVEL);
            let mut image = pdf.image_xobject(object(self.opacities.len() + index), &packed);
            image.filter(Filter::FlateDecode);
            image.width(*width).height(*height).bits_per_component(8);
            image.color_space().device_rgb();
        }
        pdf.finish()
    }
}

fn rgb(paint: &Paint) -> Option<[f32; 3]> {
    let Paint::Color(colour) = paint else { return None };
    Some([colour.red, colour.green, colour.blue].map(|c| f32::from(c) / 255.0))
}
