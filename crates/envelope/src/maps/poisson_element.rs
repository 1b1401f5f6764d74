//! Poisson's ratio over the kind of element.

use fem::{ElementOptions, locks_from};
use mesh::ElementKind;

use super::{Cell, EnvelopeMap, Outcome, judge};
use crate::pieces::block::{Test, compliance};

/// Parts of its compliance that a pressed cube may lose by its elements, %: what 4 x 4 x 4 of them lose at 0.3 but for the
/// linear ones that are warned of.
const MOST: f64 = 25.0;

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "d",
    name: "Poisson's ratio over element type",
    file: "",
    judged: "Compliance of a cube of 4 x 4 x 4 cells, a quarter of its top pressed, against 8 x 8 x 8 hex20: solved within 25 %, warned where the program says that the kind locks.",
    columns: ("Poisson's ratio", &["0", "0.3", "0.4", "0.45", "0.48", "0.49", "0.499"]),
    rows: ("kind", &["hex8", "hex20", "hex27", "tet4", "tet10", "wedge6", "wedge15"]),
    layers: &[""],
    cell,
};

fn cell(_: &str, kind: &str, poisson: &str) -> Cell {
    let empty = Cell::new(Outcome::None, &[]);
    let found = ElementKind::ALL.into_iter().find(|k| k.name() == kind);
    let (Some(kind), Ok(nu)) = (found, poisson.parse::<f64>()) else { return empty };
    let options = ElementOptions::default();
    let pressed = |kind, cells: usize| compliance(Test::Pressed, kind, [cells; 3], nu, &options);
    let coarse = match pressed(kind, 4) {
        Ok(coarse) => coarse,
        Err(error) => return Cell { outcome: Outcome::Refused, ..empty }.saying(error),
    };
    let finer = || pressed(ElementKind::Hex20, 8).ok().map(|fine| [fine, 0.0]);
    let Some([fine, _]) = judge::reference("cube", &[poisson.to_owned()], finer) else {
        return Cell { outcome: Outcome::Refused, ..empty }.saying("the finer cube has no answer");
    };
    let off = 100.0 * (coarse / fine - 1.0);
    let linear = matches!(kind, ElementKind::Tet4 | ElementKind::Wedge6);
    let warned = linear || locks_from(kind).is_some_and(|from| nu >= from);
    let outcome = match (off.abs() <= MOST, warned) {
        (_, true) => Outcome::Warned,
        (true, false) => Outcome::Solved,
        (false, false) => Outcome::Wrong,
    };
    let said = warned.then(|| format!("the mesh has {} elements, which are too stiff", kind.name()));
    Cell { outcome, off_percent: Some(off), bound_percent: Some(MOST), said, ..empty }
}
