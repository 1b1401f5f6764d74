//! Pages: templates, scripts, and what a page is made of, so that it can be made again.

mod chart_page;
mod closing;
mod motion_page;
mod part;
mod rendered;
mod run_page;
pub mod scripts;
mod static_page;
mod template;

pub(crate) use chart_page::write_chart_page;
pub use closing::closing_text;
pub use motion_page::{render_run, write_motion_report, write_sweep_report};
pub use part::{Cell, Content, Grid, Line, Page, Part, again, cost_part};
pub use rendered::{Rendered, report_again, report_from};
pub use run_page::RunPage;
pub use static_page::{static_charts, write_report};
pub use template::{render, render_own};
