//! The table of vibration of a gearbox file.

use toml::Spanned;

use super::{
    file::GearboxVibration,
    schema::{InputTurn, RawVibration, VIBRATION},
    values::{Checked, needed_of, row},
};
use crate::Source;

/// Numbers in the answer at the most: speeds, orders and meshes times bearings and meshes.
const MOST: f64 = 2e6;

/// The table, of a gearbox with so many meshes and bearings.
pub(super) fn vibration(
    s: &Source<'_>,
    table: &Spanned<RawVibration>,
    [meshes, bearings]: [usize; 2],
) -> Checked<GearboxVibration> {
    let raw = table.get_ref();
    let speed = |key: &str, value| needed_of(s, (table, "[vibration]"), &VIBRATION, key, value);
    let speeds_rpm = [speed("from_rpm", &raw.from_rpm)?, speed("to_rpm", &raw.to_rpm)?];
    if speeds_rpm[1] <= speeds_rpm[0] {
        let said = format!("speeds from {} to {} 1/min", speeds_rpm[0], speeds_rpm[1]);
        return Err(s.conflict(&table.span(), said, "`to_rpm` is the higher one"));
    }
    let speeds = row!(s, VIBRATION, raw.speeds)?;
    let orders = row!(s, VIBRATION, raw.orders)?;
    let numbers = f64::from(speeds) * f64::from(orders) * (meshes * (meshes + bearings)) as f64;
    if numbers > MOST {
        let said = format!("an answer of {numbers:.0} forces over speed, order and part");
        return Err(s.conflict(
            &table.span(),
            said,
            format!("ask for fewer `speeds` or `orders`: {MOST:.0} at the most"),
        ));
    }
    Ok(GearboxVibration {
        speeds_rpm,
        speeds,
        orders,
        damping_ratio: row!(s, VIBRATION, raw.damping_ratio)?,
        modes: row!(s, VIBRATION, raw.modes)?,
        held_input: s.choice_of::<InputTurn>("input", &raw.input)? == InputTurn::Held,
    })
}
