//! Rating of the pair: `[rating]`.

use rating::{Lubricants, Materials, Spectrum};

fields! { RatedGearScene; }

table! {
    /// `[rating]`
    RATING, RawRating => RatingScene: "load capacity of the pair at rest after ISO 6336: safeties against pitting and tooth root breakage at `torque_nm` and `speed_rpm`. Nothing is assumed: what is missing is asked for", needed ["life_h", "application_factor", "tolerance_class", "lubricant", "pinion", "wheel"]; {
        edition: word(RatingEdition), "edition of ISO 6336-1, -2, -3. Here they differ in the form factor (the load share f_eps of 2019) and in the helix angle factor";
        life_h: must(1e-3, 1e8), "required life, h";
        application_factor: must(0.1, 100.0), "K_A, application factor: by how much the machines raise the nominal torque";
        face_load_factor: bare(1.0, 100.0), "K_Hbeta, face load factor; default: that of the solved load distribution, which models with slices have";
        dynamic_factor: bare(0.5, 100.0), "K_V, dynamic factor; default: that of ISO 6336-1, method B";
        transverse_load_factor: bare(1.0, 100.0), "K_Halpha and K_Falpha, transverse load factors; default: those of ISO 6336-1, method B";
        tolerance_class: bare_whole(1, 11) => must, "ISO 1328-1:2013 tolerance class of both gears: deviations that are not stated, and whether relief counts in K_V (class 5 and better)";
        base_pitch_deviation_um: bare(0.0, 1e4), "f_pb, larger transverse base pitch deviation of both gears, um; default: single pitch tolerance times cos(alpha_t)";
        profile_form_deviation_um: bare(0.0, 1e4), "f_falpha, larger profile form deviation of both gears, um; default: profile form tolerance";
        tip_relief_um: bare(0.0, 1e4), "C_a, tip relief that counts in K_V of tolerance class 5 and better, um; default: what running-in leaves, 1.5 um + (sigma_Hlim/97 - 18.45)^2/18";
        gear_blank_factor: number(0.1, 1.0, 1.0), "C_R of ISO 6336-1: stiffness of teeth on webs and thin rims over that on solid discs";
        limited_pitting: switch(false), "whether some pits are allowed, which gives steels longer lines of life";
        long_life_factor: number(0.85, 1.0, 0.85), "Z_NT and Y_NT at 1e10 load cycles. 0.85: usual; up to 1: with the best lubrication, material, manufacturing and experience";
        spectrum: text() => [Spectrum], "file of loads over the life, with commas and a heading: `torque_nm` on the driven gear, `speed_rpm` of the driver, and one of `share`, `duration_s`, `duration_h`; Miner's sums beside the safeties. `application_factor` raises each of them: 1 where the spectrum is measured";
        lubricant: text(), "name in the table of lubricants";
        lubricants: text() => [Lubricants], "file that replaces the table of lubricants; default: the program's, `crates/rating/data/lubricants.toml`";
        materials: text() => [Materials], "file that replaces the table of materials; default: the program's, `crates/rating/data/materials.toml`";
        oil_temperature_c: bare(-50.0, 250.0), "theta_oil, temperature of the oil before the mesh, C. With it the friction of the oil gives the losses of the mesh (models with slices); `scuffing` and `micropitting` need it";
        lubrication: bare_word(LubricationScene) => Some, "how oil gets to the flanks, for `scuffing` and `micropitting`. dip: gears dip into the oil; spray: oil is sprayed into the mesh; submerged: the mesh runs in the oil";
        scuffing: switch(false), "whether scuffing is rated after ISO/TS 6336-20 and -21, and from the solved pressures. Needs `oil_temperature_c`, `lubrication`, `structural_factor`, both `flank_roughness_ra_um`, of the lubricant `scuffing_load_stage`, of the materials `thermal_conductivity_w_per_m_k` and `specific_heat_j_per_kg_k`";
        structural_factor: bare(0.1, 10.0), "X_W of ISO/TS 6336-20 and -21: how the structure of both flanks bears scuffing, 1 for through-hardened steel and case-hardened steel with usual retained austenite; `scuffing` asks for it";
        micropitting: switch(false), "whether micropitting is rated after ISO/TS 6336-22, by the standard (method B) and from the solved pressures (models with slices). Needs what `scuffing` needs without `structural_factor` and the scuffing test, and of the lubricant `micropitting_load_stage` with `material_factor`, or `permissible_specific_film_thickness`";
        material_factor: bare(0.1, 10.0), "W_W of ISO/TS 6336-22: what the material makes of the micropitting test, 1 for case-hardened steel; `micropitting` asks for it";
        permissible_specific_film_thickness: bare(1e-4, 100.0), "lambda_GFP, film thickness over R_a that is enough; default: method B of ISO/TS 6336-22, from the lubricant's `micropitting_load_stage` and `material_factor`";
        pinion: table(RATED_GEAR: RawRatedGear) => (RatedGearScene);
        wheel: table(RATED_GEAR: RawRatedGear) => (RatedGearScene);
    }
}

choices! {
    /// Edition of ISO 6336.
    pub enum RatingEdition {
        /// ISO 6336:2019.
        Iso2019 = "iso-2019",
        /// ISO 6336:2006.
        Iso2006 = "iso-2006",
    }
}

choices! {
    /// How oil gets to the flanks.
    pub enum LubricationScene {
        /// Gears dip into the oil.
        Dip = "dip",
        /// Oil is sprayed into the mesh.
        Spray = "spray",
        /// The mesh runs in the oil.
        Submerged = "submerged",
    }
}

table! {
    /// `[rating.pinion]`
    RATED_GEAR, RawRatedGear => RatedGearScene: "what is rated of a gear", needed ["material", "flank_roughness_rz_um", "root_roughness_rz_um"]; {
        material: text(), "name in the table of materials";
        flank_roughness_rz_um: must(0.01, 200.0), "R_z of the flanks as run in, um";
        flank_roughness_ra_um: bare(1e-3, 50.0), "R_a of the flanks as run in, um; `oil_temperature_c` of `[rating]` asks for it";
        root_roughness_rz_um: must(0.01, 500.0), "R_z of the roots, um";
        reversed_load_ratio: bare(0.0, 1.0), "load on the flank that is loaded less over that of the other, 0: one flank works, 1: idlers and planets; default: 0. In a gearbox by the loads of all meshes of the gear";
        meshes_per_turn: bare_whole(1, 100), "times that a flank is loaded in a turn of the gear; default: 1. In a gearbox by all meshes of the gear";
    }
}
