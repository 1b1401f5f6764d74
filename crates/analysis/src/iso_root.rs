//! The nominal tooth root stress of ISO 6336-3 for a scene's pair, for comparison with finite elements.

use geometry::Gear;
use lumped::{
    LumpedError,
    iso::{IsoRoot, IsoRootPair},
};
use serde::Serialize;

use crate::loaded_pair::LoadedPair;

/// Where the numbers come from; said wherever they are handed on.
const METHOD: &str = "ISO 6336-3:2019 method B, nominal: without load factors K, worst load of the virtual spur gear, Y_DT of tolerance class 5 and above";

described::described! {
    /// Nominal root stresses of pinion and wheel; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct IsoRootStress {
        /// standard, and what is left out
        pub method: &'static str,
        /// nominal root stress of the pinion
        pub pinion: IsoGearRoot,
        /// nominal root stress of the wheel
        pub wheel: IsoGearRoot,
    }
}

described::described! {
    /// Nominal root stress of one gear and what it is made of.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct IsoGearRoot {
        /// sigma_F0
        pub nominal_root_stress_mpa: f64,
        /// Y_F, f_eps included
        pub form_factor: f64,
        /// Y_S
        pub stress_correction_factor: f64,
        /// Y_beta
        pub helix_factor: f64,
        /// Y_B
        pub rim_thickness_factor: f64,
        /// Y_DT
        pub deep_tooth_factor: f64,
        /// s_Fn of the virtual spur gear
        pub root_chord_mm: f64,
        /// h_Fe of the virtual spur gear
        pub bending_lever_mm: f64,
        /// rho_F of the virtual spur gear
        pub fillet_radius_mm: f64,
        /// rim between bore and root circle over tooth height; the standard ends at 0.5, of rings at 1.75 modules
        pub rim_over_tooth_height: f64,
    }
}

/// Says why there is no nominal root stress, to those who asked for root stress.
pub(crate) fn remark(loaded: &LoadedPair<'_>) -> Option<answer::Remark> {
    root_stress(loaded).err().map(|e| crate::remark::no_iso_root_stress(e.to_string()))
}

/// As the standard has it, with the torque of the scene.
///
/// # Errors
/// [`LumpedError`] where the standard has no value.
pub(crate) fn root_stress(loaded: &LoadedPair<'_>) -> Result<IsoRootStress, LumpedError> {
    let pair = loaded.pair;
    let ratios =
        IsoRootPair { eps_alpha: pair.transverse_contact_ratio(), eps_beta: pair.overlap_ratio(), fine: false };
    let tangential = loaded.tangential_force();
    let one = |gear: &Gear| -> Result<IsoGearRoot, LumpedError> {
        let root = IsoRoot::new(gear, ratios)?;
        Ok(IsoGearRoot {
            nominal_root_stress_mpa: root.nominal_stress(tangential, pair.face_width(), gear.data().normal_module),
            form_factor: root.y_form,
            stress_correction_factor: root.y_stress,
            helix_factor: root.y_helix,
            rim_thickness_factor: root.y_rim,
            deep_tooth_factor: root.y_deep_tooth,
            root_chord_mm: root.root_chord,
            bending_lever_mm: root.lever,
            fillet_radius_mm: root.fillet_radius,
            rim_over_tooth_height: root.rim_ratio,
        })
    };
    Ok(IsoRootStress { method: METHOD, pinion: one(&pair.pinion)?, wheel: one(&pair.wheel)? })
}
