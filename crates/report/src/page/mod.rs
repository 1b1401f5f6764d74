//! Pages: templates, scripts, and what a page is made of, so that it can be made again.

mod rendered;
mod template;

pub use rendered::{Rendered, report_again};
pub use template::render;
