//! Whether the pair will hold: `[rating]`.

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

table! {
    /// `[rating.pinion]`
    RATED_GEAR, RawRatedGear => RatedGearScene: "what is rated of a gear", needed ["material", "flank_roughness_rz_um", "root_roughness_rz_um"]; {
        material: text(), "name in the table of materials";
        flank_roughness_rz_um: must(0.01, 200.0), "R_z of the flanks as run in, um";
        root_roughness_rz_um: must(0.01, 500.0), "R_z of the roots, um";
        reversed_load_ratio: number(0.0, 1.0, 0.0), "load on the flank that is loaded less over that of the other. 0: one flank works; 1: idlers and planets";
        meshes_per_turn: whole(1, 100, 1), "times that each tooth is loaded in a turn of the gear";
    }
}
