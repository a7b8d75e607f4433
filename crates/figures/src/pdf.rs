//! A drawing as a page of PDF. Texts are outlines.

use crate::drawing::{Drawing, Element, Paint, Path, Rect, Step};
use crate::letters::Letters;
use crate::picture::Picture;
use crate::style::{Colour, INK};
use crate::thin::Point;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Ref};

/// Compression level of zlib, a compromise of size and time.
const LEVEL: u8 = 6;
/// Points per unit.
const POINT: f64 = 0.5;
/// Handles of the four arcs of a circle over its radius.
const ARC: f64 = 0.552_284_75;

/// A page of this width and height, in units, without a background.
pub(crate) fn pdf(drawing: &Drawing, (width, height): (f64, f64)) -> Vec<u8> {
    let letters = Letters::new();
    let mut page = Page { height, content: Content::new(), opacities: vec![], images: vec![] };
    for element in &drawing.elements {
        match element {
            Element::Path(path, paint) => page.path(path, paint),
            Element::Rect(at, paint) => page.path(&Path(vec![Step::Rect(*at)]), paint),
            Element::Text(text) => page.path(&letters.outline(text), &Paint::fill(INK)),
            Element::Image(at, picture) => page.image(*at, picture),
            Element::Clip(within) => {
                page.content.save_state();
                page.outline(&Path(vec![Step::Rect(*within)]));
                page.content.clip_nonzero().end_path();
            }
            Element::Unclip => {
                page.content.restore_state();
            }
        }
    }
    page.file(width)
}

struct Page<'a> {
    /// Height, in units.
    height: f64,
    content: Content,
    /// Opacities in use.
    opacities: Vec<f64>,
    images: Vec<&'a Picture>,
}

impl<'a> Page<'a> {
    /// A place in points. PDF counts upward from the foot of the page.
    fn place(&self, (x, y): Point) -> (f32, f32) {
        ((POINT * x) as f32, (POINT * (self.height - y)) as f32)
    }

    fn path(&mut self, path: &Path, paint: &Paint) {
        if let Some(fill) = paint.fill {
            self.with_opacity(paint.fill_opacity.unwrap_or(1.0), |page| {
                let [red, green, blue] = rgb(fill);
                page.content.set_fill_rgb(red, green, blue);
                page.outline(path);
                page.content.fill_nonzero();
            });
        }
        if let Some(stroke) = paint.stroke {
            let [red, green, blue] = rgb(stroke);
            self.content.set_stroke_rgb(red, green, blue);
            self.content.set_line_width((POINT * paint.width) as f32);
            self.content.set_line_join(LineJoinStyle::RoundJoin);
            self.content.set_dash_pattern(paint.dashes.iter().map(|d| (POINT * d) as f32), 0.0);
            self.outline(path);
            self.content.stroke();
        }
    }

    fn outline(&mut self, path: &Path) {
        for step in &path.0 {
            match *step {
                Step::Move(to) => {
                    let (x, y) = self.place(to);
                    self.content.move_to(x, y);
                }
                Step::Line(to) => {
                    let (x, y) = self.place(to);
                    self.content.line_to(x, y);
                }
                Step::Curve(a, b, to) => self.curve([a, b, to]),
                Step::Rect(at) => {
                    let (x, y) = self.place((at.left, at.bottom));
                    self.content.rect(
                        x,
                        y,
                        (POINT * at.width()) as f32,
                        (POINT * at.height()) as f32,
                    );
                }
                Step::Disc(centre, radius) => self.disc(centre, radius),
                Step::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    fn curve(&mut self, points: [Point; 3]) {
        let [a, b, to] = points.map(|point| self.place(point));
        self.content.cubic_to(a.0, a.1, b.0, b.1, to.0, to.1);
    }

    /// A circle as four arcs.
    fn disc(&mut self, (x, y): Point, radius: f64) {
        let at = |across: f64, down: f64| (x + radius * across, y + radius * down);
        let (left, bottom) = self.place(at(-1.0, 0.0));
        self.content.move_to(left, bottom);
        self.curve([at(-1.0, ARC), at(-ARC, 1.0), at(0.0, 1.0)]);
        self.curve([at(ARC, 1.0), at(1.0, ARC), at(1.0, 0.0)]);
        self.curve([at(1.0, -ARC), at(ARC, -1.0), at(0.0, -1.0)]);
        self.curve([at(-ARC, -1.0), at(-1.0, -ARC), at(-1.0, 0.0)]);
        self.content.close_path();
    }

    /// Calls `draw` with this opacity.
    fn with_opacity(&mut self, opacity: f64, draw: impl FnOnce(&mut Self)) {
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

    fn image(&mut self, at: Rect, picture: &'a Picture) {
        // A picture of PDF is a unit square that stands on its foot.
        let (x, y) = self.place((at.left, at.bottom));
        let (width, height) = ((POINT * at.width()) as f32, (POINT * at.height()) as f32);
        self.content.save_state();
        self.content.transform([width, 0.0, 0.0, height, x, y]);
        self.content.x_object(Name(format!("i{}", self.images.len()).as_bytes()));
        self.content.restore_state();
        self.images.push(picture);
    }

    fn file(self, width: f64) -> Vec<u8> {
        let [catalog, pages, page, contents] = [1, 2, 3, 4].map(Ref::new);
        let object = |index: usize| Ref::new(5 + index as i32);
        let (width, height) = ((POINT * width) as f32, (POINT * self.height) as f32);
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let mut written = pdf.page(page);
        let media = pdf_writer::Rect::new(0.0, 0.0, width, height);
        written.parent(pages).media_box(media).contents(contents);
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
            state.non_stroking_alpha(*opacity as f32).stroking_alpha(*opacity as f32);
        }
        for (index, picture) in self.images.iter().enumerate() {
            let packed = compress_to_vec_zlib(&picture.pixels, LEVEL);
            let mut image = pdf.image_xobject(object(self.opacities.len() + index), &packed);
            image.filter(Filter::FlateDecode);
            image.width(picture.size.0 as i32).height(picture.size.1 as i32).bits_per_component(8);
            image.color_space().device_rgb();
        }
        pdf.finish()
    }
}

fn rgb(colour: Colour) -> [f32; 3] {
    colour.map(|part| f32::from(part) / 255.0)
}
