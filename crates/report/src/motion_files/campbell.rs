//! `campbell.csv` of a reduced pair.

use analysis::motion::CampbellDiagram;
use study::Columns;

use crate::columns_to_csv;

/// `campbell.csv`: one row a speed.
pub fn campbell_csv(of: &CampbellDiagram) -> String {
    let CampbellDiagram { diagram, orders, names } = of;
    let column = |name: &String| name.replace(' ', "_") + "_hz";
    let mut rows =
        Columns::named(std::iter::once("speed_rpm".to_owned()).chain(names.iter().chain(orders).map(column)));
    for (s, &speed) in diagram.speeds.iter().enumerate() {
        let modes = diagram.frequencies.iter().map(|m| m[s]);
        let lines = diagram.orders.iter().map(|o| o * speed);
        rows.push(std::iter::once(60.0 * speed).chain(modes).chain(lines));
    }
    columns_to_csv(&rows)
}
