//! The format of a figure, chosen by the name of its file.

use crate::error::FigureError;
use std::path::Path;

/// Storage formats of figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureFormat {
    /// Vector graphics for the web.
    Svg,
    /// Pixels.
    #[cfg(feature = "png")]
    Png,
    /// Vector graphics for print; texts are outlines.
    #[cfg(feature = "pdf")]
    Pdf,
}

impl FigureFormat {
    /// The format by the extension of `path`, in any case. A build without this format returns an error here, before
    /// the computation.
    ///
    /// # Errors
    ///
    /// The extension is unknown, or this build lacks the format.
    pub fn of(path: &Path) -> Result<Self, FigureError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Self::Png),
            #[cfg(not(feature = "png"))]
            Some("png") => Err(FigureError::Missing("PNG", "png")),
            #[cfg(feature = "pdf")]
            Some("pdf") => Ok(Self::Pdf),
            #[cfg(not(feature = "pdf"))]
            Some("pdf") => Err(FigureError::Missing("PDF", "pdf")),
            Some("gif" | "webp" | "apng") => {
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                Err(FigureError::Animated(name))
            }
            _ => Err(FigureError::Extension),
        }
    }
}

/// Storage formats of animations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimationFormat {
    /// At most 256 colours; shown everywhere.
    Gif,
    /// All colours, without loss.
    Webp,
    /// At most 256 colours, smaller than a GIF; viewers without animation show its first frame.
    Apng,
}

impl AnimationFormat {
    /// The format by the extension of `path`, in any case; `None` for any other than .gif, .webp and .apng.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("gif") => Some(Self::Gif),
            Some("webp") => Some(Self::Webp),
            Some("apng") => Some(Self::Apng),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides_in_either_case() {
        assert_eq!(FigureFormat::of(Path::new("a/b.svg")).unwrap(), FigureFormat::Svg);
        assert_eq!(FigureFormat::of(Path::new("b.SVG")).unwrap(), FigureFormat::Svg);
        #[cfg(feature = "png")]
        assert_eq!(FigureFormat::of(Path::new("c.png")).unwrap(), FigureFormat::Png);
        #[cfg(feature = "pdf")]
        assert_eq!(FigureFormat::of(Path::new("c.Pdf")).unwrap(), FigureFormat::Pdf);
    }

    #[cfg(not(feature = "png"))]
    #[test]
    fn png_without_its_feature_is_refused_with_a_way_out() {
        let message = FigureFormat::of(Path::new("c.png")).unwrap_err().to_string();
        assert!(message.contains("--features png"), "{message}");
    }

    #[test]
    fn an_unknown_extension_is_refused_with_those_that_work() {
        for name in ["figure.jpg", "figure", "png"] {
            let message = FigureFormat::of(Path::new(name)).unwrap_err().to_string();
            assert!(message.contains(".svg, .png or .pdf"), "{message}");
        }
    }
}
