//! Pages: templates, scripts, and what a page is made of, so that it can be made again.

mod closing;
mod markdown;
mod part;
mod rendered;
pub mod scripts;
mod template;

pub use closing::closing_text;
pub use part::{Cell, Content, Grid, Line, Page, Part, again, cost_part, counted};
pub use rendered::{Rendered, report_again, report_from};
pub use template::{escaped, render, render_own};
