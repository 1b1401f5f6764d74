//! The same picture in pixels.

use std::sync::Arc;

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree, fontdb::Database},
};

use crate::{ReportError, ResultFiles};

/// Pixels of the picture over those of the drawing: sharp on a dense screen and in print.
const SCALE: f32 = 2.0;

/// An SVG drawing as PNG. Letters come from a typeface inside the program: a machine may have none, and the picture is
/// the same everywhere.
///
/// # Errors
/// What the drawing or the encoder complains of.
pub fn svg_to_png(svg: &str) -> Result<Vec<u8>, String> {
    let mut fonts = Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    let options = Options { fontdb: Arc::new(fonts), font_family: "Ubuntu".into(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|e| e.to_string())?;
    let size = tree.size().to_int_size().scale_by(SCALE).ok_or("a drawing without size")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or("a drawing without size")?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| e.to_string())
}

/// A drawn picture as `STEM.svg` and `STEM.png`; for pages it comes back as SVG.
///
/// # Errors
/// When the system refuses, or the picture was not drawn.
pub(crate) fn write_picture(
    stem: &'static str,
    drawn: Result<String, String>,
    results: &dyn ResultFiles,
) -> Result<String, ReportError> {
    let fault = |cause: String| ReportError::Page { file: stem, cause };
    let svg = drawn.map_err(fault)?;
    results.write(&format!("{stem}.svg"), svg.as_bytes())?;
    results.write(&format!("{stem}.png"), &svg_to_png(&svg).map_err(fault)?)?;
    Ok(svg)
}
