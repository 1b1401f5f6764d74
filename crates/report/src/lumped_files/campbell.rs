//! `campbell.csv` of a linear model.

use analysis::lumped::LumpedCampbell;
use study::Columns;

use crate::columns_to_csv;

/// One row a speed of the driver: frequencies, and the lines of excitation.
pub fn lumped_campbell_csv(of: &LumpedCampbell) -> String {
    let diagram = &of.diagram;
    let modes = (1..=diagram.frequencies.len()).map(|m| format!("elastic_mode_{m}_hz"));
    let lines = of.names.iter().map(|n| n.replace([' ', '\''], "_") + "_hz");
    let mut rows = Columns::named(std::iter::once("speed_rpm".to_owned()).chain(modes).chain(lines));
    for (s, &speed) in diagram.speeds.iter().enumerate() {
        let modes = diagram.frequencies.iter().map(|m| m[s]);
        let lines = diagram.orders.iter().map(|o| o * speed);
        rows.push(std::iter::once(60.0 * speed).chain(modes).chain(lines));
    }
    columns_to_csv(&rows)
}
