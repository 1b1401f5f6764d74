//! Style and scripts of the pages, for a page that is not one file.
//!
//! In a page they stand in this order: [`UPLOT`], [`CHARTS`], [`THREE`], [`VIEW`] or [`GEARBOX`].

/// Style sheet of the pages, light and dark.
pub const STYLE: &str = include_str!("style.css");
/// How uPlot's charts look.
pub const UPLOT_STYLE: &str = include_str!("../../assets/uPlot.min.css");
/// uPlot 1.6.32, MIT.
pub const UPLOT: &str =
    concat!("/*\n", include_str!("../../assets/uPlot.LICENSE"), "*/\n", include_str!("../../assets/uPlot.iife.min.js"));
/// Charts and maps: `report.put(figure, plot, isMap)` makes one and hands back what puts other numbers into it.
pub const CHARTS: &str = include_str!("../charts/charts.js");
/// Tables whose headings sort their rows.
pub const SORT: &str = include_str!("sort.js");
/// three.js 0.187.0, MIT.
pub const THREE: &str =
    concat!("/*\n", include_str!("../../assets/three.LICENSE"), "*/\n", include_str!("../../assets/three.min.js"));
/// The gears in space, in the part `view.html`: `report.open(view, stage)`, then `report.view.show(view)`.
pub const VIEW: &str = concat!(include_str!("space.js"), include_str!("view.js"));
/// A gearbox in space, in the part `gearbox_view.html`.
pub const GEARBOX: &str = concat!(include_str!("space.js"), include_str!("gearbox.js"));
