//! Pages: templates, scripts, and what a page is made of, so that it can be made again.

mod chart_page;
mod closing;
mod part;
mod rendered;
pub mod scripts;
mod template;

pub(crate) use chart_page::write_chart_page;
pub use closing::closing_text;
pub use part::{Cell, Content, Grid, Line, Page, Part, again, cost_part};
pub use rendered::{Rendered, report_again, report_from};
pub use template::{render, render_own};
