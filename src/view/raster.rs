//! SVG to PNG: [`png()`].

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree, fontdb};

/// Name of the embedded font (Ubuntu Light), for `font-family`.
pub const FONT: &str = "Ubuntu";

/// Most pixels across or down that are drawn.
pub const MAX_SIDE: u32 = 16_384;

/// Why an SVG was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The text is no SVG.
    #[error("the text is no SVG: {0}")]
    Svg(String),
    /// No picture of this size.
    #[error("a picture of {width} x {height} pixels: each side must be 1 to {MAX_SIDE}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The picture could not be packed.
    #[error("the PNG could not be written: {0}")]
    Png(String),
}

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family(FONT);
    fonts.set_serif_family(FONT);
    fonts.set_monospace_family(FONT);
    Arc::new(fonts)
});

/// Draws an SVG on white, `width` pixels across and as high as its proportions ask, as PNG.
///
/// Every font family is drawn in the embedded one ([`FONT`]); images that the SVG refers to are
/// left out, so that nothing but the text decides what the picture is.
pub fn png(svg: &str, width: u32) -> Result<Vec<u8>, RasterError> {
    let tree =
        Tree::from_str(svg, &options()).map_err(|error| RasterError::Svg(error.to_string()))?;
    let scale = width as f32 / tree.size().width();
    let height = (tree.size().height() * scale).ceil() as u32;
    let refused = RasterError::Size { width, height };
    if width > MAX_SIDE || height > MAX_SIDE {
        return Err(refused);
    }
    let mut picture = Pixmap::new(width, height).ok_or(refused)?;
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    picture.encode_png().map_err(|error| RasterError::Png(error.to_string()))
}

fn options() -> Options<'static> {
    let nothing = ImageHrefResolver {
        resolve_data: Box::new(|_, _, _| None),
        resolve_string: Box::new(|_, _| None),
    };
    Options {
        font_family: FONT.to_owned(),
        fontdb: FONTS.clone(),
        image_href_resolver: nothing,
        ..Options::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOT: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10">
        <rect width="10" height="10" fill="#ff0000"/><text x="11" y="8" font-size="8">a</text>
        </svg>"##;

    #[test]
    fn a_drawing_has_its_proportions_and_its_colours() {
        let picture = Pixmap::decode_png(&png(DOT, 200).unwrap()).unwrap();
        assert_eq!((picture.width(), picture.height()), (200, 100));
        let red = picture.pixel(50, 50).unwrap();
        assert_eq!((red.red(), red.green(), red.blue()), (255, 0, 0));
    }

    #[test]
    fn text_is_drawn_without_fonts_of_the_system() {
        let picture = Pixmap::decode_png(&png(DOT, 200).unwrap()).unwrap();
        let dark = |x: u32, y: u32| picture.pixel(x, y).unwrap().red() < 128;
        assert!((110..200).any(|x| (0..100).any(|y| dark(x, y))));
    }

    #[test]
    fn same_input_same_bytes() {
        assert_eq!(png(DOT, 64).unwrap(), png(DOT, 64).unwrap());
    }

    #[test]
    fn what_is_no_svg_or_no_size_is_refused() {
        assert!(matches!(png("<p>", 10), Err(RasterError::Svg(_))));
        assert!(matches!(png(DOT, 0), Err(RasterError::Size { .. })));
        assert!(matches!(png(DOT, 20_000), Err(RasterError::Size { .. })));
    }
}
