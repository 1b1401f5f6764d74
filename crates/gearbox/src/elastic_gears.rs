//! Elastic modes of all gears in mesh.

use std::sync::Arc;

use reduction::{ElasticGear, GearModes, GearReducer, ReductionError, ReductionWay};

use crate::{GearMesh, GearboxError, Structure};

/// Modes of the gear on every disc of a structure; `None` for a disc without a mesh. A gear with several meshes gets
/// its modes from the first of them. `reduced` has the reduced gears of each mesh.
///
/// # Errors
/// [`GearboxError::NoModes`] for meshes of only part of a gear, for gears that are not reduced, and for a gear whose
/// meshes differ between two scenes; [`GearboxError::GearModes`] as for `modes`.
pub fn elastic_gears(
    structure: &Structure,
    meshes: &[GearMesh],
    reduced: &[Arc<[ElasticGear; 2]>],
    mut modes: impl FnMut(&GearReducer) -> Result<GearModes, ReductionError>,
) -> Result<Vec<Option<Arc<GearModes>>>, GearboxError> {
    let mut known: Vec<Option<(&GearReducer, Arc<GearModes>)>> = vec![None; structure.discs.len()];
    for (own, gears) in meshes.iter().zip(reduced) {
        structure.has_discs(&own.name, own.discs)?;
        for (disc, gear) in own.discs.into_iter().zip(gears.iter()) {
            let name = &structure.discs[disc].name;
            let no_modes = |said| GearboxError::NoModes { gear: name.clone(), said };
            let ElasticGear::Reduced(reducer) = gear else { return Err(no_modes("it is not reduced")) };
            let failed = |source| GearboxError::GearModes { gear: name.clone(), source };
            if reducer.way() == ReductionWay::General && !reducer.gear().is_whole_gear() {
                return Err(no_modes("some of its teeth alone are meshed"));
            }
            match &known[disc] {
                Some((first, _)) if !reducer.has_body_of(first).map_err(failed)? => {
                    return Err(no_modes("it is meshed otherwise in two scenes"));
                }
                Some(_) => {}
                None => known[disc] = Some((reducer, Arc::new(modes(reducer).map_err(failed)?))),
            }
        }
    }
    Ok(known.into_iter().map(|own| own.map(|(_, modes)| modes)).collect())
}
