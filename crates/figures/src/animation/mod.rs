//! Animations: a scene drawn at equal steps of time, and stored as GIF, WebP or APNG.
//!
//! The first frame shows the end of the motion, and stays for a while: it is all that a viewer without animation
//! shows. Every other frame stores the rectangle in which it differs from the one before.

mod apng;
mod film;
mod gif;
mod palette;
mod patch;
mod stage;
#[cfg(test)]
mod tests;
mod webp;

use crate::error::FigureError;
use crate::format::AnimationFormat;
use crate::scene::Scene;
use apng::Apng;
pub use film::Film;
use gif::Gif;
use palette::Palette;
use patch::{NEAR, Patch, Writer};
use stage::Stage;
use webp::Webp;

/// Approximate number of frames from which the palette is made, besides the first one.
const LOOKS: usize = 6;

/// Draws an animation. Equal scenes give equal bytes.
///
/// # Errors
/// The document is damaged, or the picture is too large.
pub fn animate(
    scene: &mut dyn Scene,
    format: AnimationFormat,
    film: &Film,
) -> Result<Vec<u8>, FigureError> {
    let still = scene.still();
    let stage = Stage::of(&still, scene.times(), film)?;
    let times = film.times(scene.times());
    let mut palette = palette(scene, &stage, &times)?;
    let mut writer: Box<dyn Writer> = match format {
        AnimationFormat::Webp => Box::new(Webp::new(stage.size())),
        AnimationFormat::Gif => Box::new(Gif::new(stage.size(), palette.clone())?),
        AnimationFormat::Apng => Box::new(Apng::new(stage.size(), palette.clone())),
    };
    let mut shown = vec![0; stage.size().0 * stage.size().1];
    let mut before: Option<Vec<u8>> = None;
    for (i, (t, milliseconds)) in times.into_iter().enumerate() {
        let now = stage.draw(scene, t)?;
        let mut patch = Patch::between(before.as_deref(), &now, stage.size());
        // From the end of the motion, which the first frame shows, to its beginning: no trace of the end may remain.
        let near = if i == 1 { 0 } else { NEAR };
        patch.reduce(&mut palette, &mut shown, stage.size().0, near);
        writer.frame(&patch, milliseconds)?;
        before = Some(now);
    }
    writer.finish()
}

/// The colours of the first frame and of some others.
fn palette(
    scene: &mut dyn Scene,
    stage: &Stage,
    times: &[(f64, u32)],
) -> Result<Palette, FigureError> {
    let every = (times.len() / LOOKS).max(1);
    let some = times.iter().skip(1).step_by(every).chain(times.first());
    let frames = some.map(|(t, _)| stage.draw(scene, *t)).collect::<Result<Vec<_>, _>>()?;
    Ok(Palette::of(&frames))
}
