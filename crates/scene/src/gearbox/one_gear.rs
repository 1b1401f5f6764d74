//! Checks that a gear with several meshes is described equally in the scenes of all of them.

use geometry::GearData;
use toml::Spanned;

use super::{
    file::{GearboxGear, GearboxMesh},
    schema::RawMesh,
    values::Checked,
};
use crate::{
    Source,
    gear_pair::data,
    units::{plain, shown},
};

/// Difference that is round-off, relative.
const ROUND: f64 = 1e-9;

/// What a scene says of the shape of a gear: keys, and numbers in their units; none of what it leaves to the program.
fn shape(data: &GearData) -> [(&'static str, Option<f64>); 13] {
    [
        ("teeth", Some(f64::from(data.teeth))),
        ("normal_module_mm", Some(data.normal_module)),
        ("normal_pressure_angle_deg", Some(data.normal_pressure_angle.to_degrees())),
        ("helix_angle_deg", Some(data.helix_angle.to_degrees())),
        ("face_width_mm", Some(data.face_width)),
        ("profile_shift", Some(data.profile_shift)),
        ("thickness_allowance_mm", Some(data.thickness_allowance)),
        ("addendum_coefficient", Some(data.addendum_coefficient)),
        ("dedendum_coefficient", Some(data.dedendum_coefficient)),
        ("root_radius_coefficient", Some(data.root_radius_coefficient)),
        ("tip_diameter_mm", data.tip_diameter),
        ("tip_edge_radius_mm", Some(data.tip_edge_radius)),
        ("bore_diameter_mm", Some(data.bore_diameter)),
    ]
}

/// Refuses gears that two scenes give two shapes.
pub(super) fn one_shape(
    s: &Source<'_>,
    tables: &[Spanned<RawMesh>],
    (meshes, gears): (&[GearboxMesh], &[GearboxGear]),
) -> Checked<()> {
    let mut known: Vec<Option<(usize, GearData)>> = vec![None; gears.len()];
    for (i, mesh) in meshes.iter().enumerate() {
        for (&gear, own) in mesh.gears.iter().zip(mesh.scene.gears()) {
            let now = data(&mesh.scene, own);
            let Some((first, before)) = &known[gear] else {
                known[gear] = Some((i, now));
                continue;
            };
            let unlike = |(a, b): (Option<f64>, Option<f64>)| match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() > ROUND * a.abs().max(b.abs()),
                (a, b) => a.is_some() != b.is_some(),
            };
            let differs = shape(before).into_iter().zip(shape(&now)).find(|(a, b)| unlike((a.1, b.1)));
            let Some(((key, one), (_, other))) = differs else { continue };
            // As few digits as tell both apart.
            let few = one.map(shown) != other.map(shown);
            let digits = if few { shown } else { plain };
            let told = |value: Option<f64>| value.map_or_else(|| "its default".to_owned(), digits);
            let said = format!(
                "gear \"{}\" has `{key}` {} in mesh \"{}\" and {} in mesh \"{}\"",
                gears[gear].name,
                told(one),
                meshes[*first].name,
                told(other),
                mesh.name
            );
            return Err(s.conflict(&tables[i].span(), said, "it is one gear: both scenes say the same of it"));
        }
    }
    Ok(())
}
