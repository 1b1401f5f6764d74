//! The answer about accuracy against cost: models of a pair, methods of integration, models over speed.

mod methods;
mod resonance;
mod rows;
mod tables;
mod work_precision;

pub use methods::methods_chart;
pub use resonance::resonance_chart;
pub use work_precision::work_precision_chart;

use analysis::{
    accuracy_chart::{ResonancePrecision, WorkPrecision},
    motion::MotionPrecision,
};
use answer::{Answer, Cost, Table};
use scene::Scene;
use serde::Serialize;
use serde_json::{Value, json};

use crate::{
    ReportError, Written,
    answer_files::Object,
    charts::write_picture,
    page::{Content, Page, Part, again, cost_part},
    write_result,
};
use store::folder::ResultDirectory;

described::described! {
    /// Headline of a chart.
    #[derive(Debug, Default, Serialize)]
    struct ChartHeadline {
        /// points that were run
        points: usize,
        /// points that could not be run
        points_not_run: usize,
        /// mean static transmission error of the reference; of models at rest
        #[serde(skip_serializing_if = "Option::is_none")]
        reference_mean_ste_um: Option<f64>,
        /// mesh frequency over mesh resonance; with `--methods`
        #[serde(skip_serializing_if = "Option::is_none")]
        mesh_over_resonance: Option<f64>,
        /// largest peak to peak of the dynamic transmission error of the reference; with `--resonance`
        #[serde(skip_serializing_if = "Option::is_none")]
        reference_largest_peak_to_peak_dte_um: Option<f64>,
    }
}

/// The headline with its keys.
pub(crate) const OBJECT: Object = ("headline, a chart", ChartHeadline::KEYS);

/// Tables of charts, for `docs/outputs.md`.
pub(crate) fn documented(models: &WorkPrecision, methods: &MotionPrecision, speeds: &ResonancePrecision) -> Vec<Table> {
    [rows::rows(models), methods::rows(methods)].into_iter().chain(resonance::documented(speeds)).collect()
}

/// A chart that is drawn.
#[derive(Debug)]
pub struct Chart {
    /// Subject of the chart, in words.
    subtitle: String,
    /// Rows of all points.
    tables: Vec<Table>,
    /// The numbers that most people want.
    headline: Value,
    /// Names of files and pictures.
    pictures: Vec<(&'static str, Result<String, String>)>,
    /// Errors and times as tables of a document.
    pub markdown: String,
    /// The command that makes it again.
    command: String,
}

/// Writes a chart of a scene: tables, pictures, page, summary; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or a picture was not drawn.
pub fn write_chart(scene: &Scene, chart: Chart, cost: Cost, results: &ResultDirectory) -> Result<Written, ReportError> {
    let answer = Answer {
        kind: "chart",
        name: scene.name.clone(),
        inputs: json!(scene),
        tables: chart.tables,
        headline: chart.headline,
        cost,
        ..Answer::default()
    };
    let pictures = chart.pictures.into_iter().map(|(stem, drawn)| write_picture(stem, drawn, results));
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    let figures = pictures.into_iter().map(|svg| format!("<figure class=\"chart\">{svg}</figure>"));
    let mut page = Page::of(&answer, chart.subtitle);
    page.push(Part::more().figures(figures));
    page.push(Part::new("Accuracy and cost").closing().with(Content::Markdown(chart.markdown)));
    page.push(cost_part(&answer.cost));
    page.push(again(&chart.command));
    write_result(answer, &page, scene.output.parquet, results)
}
