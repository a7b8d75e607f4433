//! The format of a figure, chosen by the name of its file.

use super::error::PlotError;
use std::path::Path;

/// How a figure is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlotFormat {
    /// Vector graphics.
    Svg,
    /// Pixels, two for each unit of the SVG.
    #[cfg(feature = "png")]
    Png,
}

impl PlotFormat {
    /// By the extension of `path`, in letters of either case. A build without PNG says so here,
    /// before the work, rather than when the figure is there.
    pub(crate) fn of(path: &Path) -> Result<Self, PlotError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Self::Png),
            #[cfg(not(feature = "png"))]
            Some("png") => Err(PlotError::NoPng),
            _ => Err(PlotError::Extension),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides_in_either_case() {
        assert_eq!(PlotFormat::of(Path::new("a/b.svg")).unwrap(), PlotFormat::Svg);
        assert_eq!(PlotFormat::of(Path::new("b.SVG")).unwrap(), PlotFormat::Svg);
        #[cfg(feature = "png")]
        assert_eq!(PlotFormat::of(Path::new("c.png")).unwrap(), PlotFormat::Png);
    }

    #[cfg(not(feature = "png"))]
    #[test]
    fn png_without_its_feature_is_refused_with_a_way_out() {
        let message = PlotFormat::of(Path::new("c.png")).unwrap_err().to_string();
        assert!(message.contains("--features png"), "{message}");
    }

    #[test]
    fn an_unknown_extension_is_refused_with_those_that_work() {
        for name in ["figure.pdf", "figure", "png"] {
            let message = PlotFormat::of(Path::new(name)).unwrap_err().to_string();
            assert!(message.contains(".svg or .png"), "{message}");
        }
    }
}
