//! Cheaper models of the same pair.

use crate::table::INF;

fields! { ; Vec<DiscScene>: is_empty, Vec<SupportScene>: is_empty }

table! {
    /// `[mesh]`
    MESH, RawMesh => MeshScene: "mesh of a model that has a stiffness instead of flanks (lumped8, lumped12, shaft18)"; {
        stiffness_from: bare_word(StiffnessFrom), "where the stiffness over the mesh cycle comes from; default: series where that is given, else reduced. series: the numbers below; reduced: the quasi-static cycle of the reduced model of the same scene (its tangent stiffness, contact-line length and error); iso: the mean of the model iso (ISO 6336-1 and the bending of the bodies) in proportion to the contact lines";
        stiffness_n_per_um: bare(1e-6, 1e9), "mean stiffness along the flanks' normal, N/um";
        stiffness_cos_n_per_um: numbers() => {Vec<f64>}, "cosine amplitudes of the mesh orders 1, 2, ..., N/um, up to 200";
        stiffness_sin_n_per_um: numbers() => {Vec<f64>}, "sine amplitudes of the mesh orders, N/um, up to 200";
        error_cos_um: numbers() => {Vec<f64>}, "unloaded transmission error on the transverse line of action: cosine amplitudes, um, up to 200. Positive when the driven gear lags; not for reduced, which has its own";
        error_sin_um: numbers() => {Vec<f64>}, "sine amplitudes of the unloaded transmission error, um, up to 200";
        half_backlash_um: bare(0.0, 1e5), "half of the backlash along the normal, um; 0: a linear mesh that pulls as well; default: of the geometry. Of lumped8 and shaft18";
        line_sharing: word(Sharing) => Some, "how friction weighs the contact lines (lumped8, lumped12). length: by their length; line: every line alike";
    }
}

choices! {
    /// Where the stiffness over the mesh cycle comes from.
    pub enum StiffnessFrom {
        /// The quasi-static cycle of the reduced model of the same scene, its error with it.
        Reduced = "reduced",
        /// The series in the scene.
        Series = "series",
        /// ISO 6336-1's mean, in proportion to the length of the contact lines.
        Iso = "iso",
    }
}

choices! {
    /// How friction weighs the contact lines.
    pub enum Sharing {
        /// By their length.
        Length = "length",
        /// Every line alike.
        Line = "line",
    }
}

table! {
    /// `[lumped8]`
    LUMPED8, RawLumped8 => Lumped8Scene Copy: "the model with eight coordinates"; {
        law: word(Law), "one spring along the normal, or two with projected stiffness. The latter falls short of the axial force";
        speed_fluctuation_rpm: number(0.0, 1e7, 0.0), "amplitude of the driver's speed about its mean, 1/min";
        speed_fluctuation_hz: bare(1e-6, 1e7), "its frequency, Hz";
    }
}

choices! {
    /// How mesh stiffness becomes transverse and axial force.
    pub enum Law {
        /// One spring along the normal.
        Normal = "normal",
        /// Two with projected stiffness, as seed 004 prints.
        Projected = "projected",
    }
}

table! {
    /// `[lumped12]`
    LUMPED12, RawLumped12 => Lumped12Scene Copy: "the model with twelve coordinates"; {
        orientation_deg: bare(-360.0, 360.0), "direction from the driver's centre to the driven gear's, degrees; default: 0, or 180 where the wheel drives";
        damping_ratio: number(0.0, 10.0, 0.03), "Rayleigh damping at both frequencies";
        damping_from_hz: number(1e-6, 1e7, 100.0), "the lower frequency of Rayleigh damping, Hz";
        damping_to_hz: number(1e-6, 1e7, 10_000.0), "the higher frequency of Rayleigh damping, Hz";
    }
}

table! {
    /// `[impact]`
    IMPACT, RawImpact => ImpactScene Copy: "rigid gears on true flanks, force by overlap"; {
        stiffness_n_per_mm_to_exponent: bare(1e-6, 1e15), "K of K delta^e of a pair that touches over its whole face width, N/mm^e; default: 4/3 sqrt(R) E*, which belongs to the exponent 1.5";
        exponent: number(1.0, 10.0, 1.5), "exponent e of K delta^e";
        damping_ns_per_mm: number(0.0, 1e9, 50.0), "largest damping, N s/mm";
        damping_depth_mm: number(1e-9, 1e3, 0.1), "overlap from which damping is whole, mm";
        static_friction: number(0.0, 1.0, 0.0), "coefficient of friction at the static speed";
        dynamic_friction: number(0.0, 1.0, 0.0), "the same from the dynamic speed on";
        static_speed_mm_per_s: number(1e-9, 1e6, 0.1), "sliding speed up to which flanks creep, mm/s";
        dynamic_speed_mm_per_s: number(1e-9, 1e6, 10.0), "sliding speed from which on they slip, mm/s";
    }
}

table! {
    /// `[shaft18]`
    SHAFT18, RawShaft18 => Shaft18Scene Copy: "both shafts of the model of shafts, with Rayleigh damping"; {
        mass_damping_per_s: number(0.0, 1e9, 20.0), "damping in proportion to mass, 1/s";
        stiffness_damping_s: number(0.0, 1.0, 2e-7), "damping in proportion to stiffness, s";
        gravity_m_per_s2: numbers() => {[f64; 3]}, "acceleration of gravity along x, y, z, m/s^2";
    }
}

table! {
    /// `[pinion.shaft]`
    SHAFT, RawShaft => ShaftScene: "the shaft the gear sits on (model shaft18), of the gear's material; places are mm from the beginning of its first segment", needed ["segments_mm", "gear_at_mm"]; {
        segments_mm: rows(3) => {Vec<[f64; 3]>}, "length, outer and inner diameter of each segment, one after the other, mm";
        gear_at_mm: must(0.0, INF), "place of the gear, mm";
        torque_at_mm: bare(0.0, INF) => {f64}, "where drive or load acts, mm; default: at the gear";
        nodes_mm: numbers() => {Vec<f64>}, "further places at which the shaft's own mass is put, mm";
        run_out_um: number(0.0, 1e4, 0.0), "eccentricity of the gear's teeth, um: sidebands at the shaft's frequency";
        run_out_phase_deg: number(-360.0, 360.0, 0.0), "its angle before the line of action at the start, degrees";
        discs: list(DISC: RawDisc) => {Vec<DiscScene>};
        supports: list(SUPPORT: RawSupport) => {Vec<SupportScene>};
    }
}

table! {
    /// `[[pinion.shaft.discs]]`
    DISC, RawDisc => DiscScene: "couplings and wheels on the shaft", needed ["at_mm"]; {
        at_mm: must(0.0, INF), "place, mm";
        mass_kg: number(0.0, 1e9, 0.0), "mass, kg";
        polar_inertia_kg_m2: number(0.0, 1e12, 0.0), "inertia about the shaft's axis, kg m^2";
        transverse_inertia_kg_m2: number(0.0, 1e12, 0.0), "inertia about an axis across, kg m^2";
        keeps: words(ShaftCoordinate), "coordinates that remain; default: x, y, rz. The others follow statically";
    }
}

choices! {
    /// A coordinate of a station on a shaft.
    pub enum ShaftCoordinate {
        /// Along x.
        X = "x",
        /// Along y.
        Y = "y",
        /// Along the axis.
        Z = "z",
        /// Tilt about x.
        Rx = "rx",
        /// Tilt about y.
        Ry = "ry",
        /// Turn about the axis.
        Rz = "rz",
    }
}

table! {
    /// `[[pinion.shaft.supports]]`
    SUPPORT, RawSupport => SupportScene Copy: "bearings of the shaft; what is 0 does not hold; together they hold it along x and y at two places each (or at one that holds against tilting), and along z where helical teeth or gravity push", needed ["at_mm"]; {
        at_mm: must(0.0, INF), "place, mm";
        stiffness_x_n_per_mm: number(0.0, 1e15, 0.0), "stiffness along x, N/mm";
        stiffness_y_n_per_mm: number(0.0, 1e15, 0.0), "stiffness along y, N/mm";
        stiffness_z_n_per_mm: number(0.0, 1e15, 0.0), "stiffness along the axis, N/mm";
        stiffness_rx_nmm_per_rad: number(0.0, 1e15, 0.0), "stiffness against tilt about x, N mm/rad";
        stiffness_ry_nmm_per_rad: number(0.0, 1e15, 0.0), "stiffness against tilt about y, N mm/rad";
        stiffness_rz_nmm_per_rad: number(0.0, 1e15, 0.0), "stiffness against turning, N mm/rad";
        damping_x_ns_per_mm: number(0.0, 1e15, 0.0), "damping along x, N s/mm";
        damping_y_ns_per_mm: number(0.0, 1e15, 0.0), "damping along y, N s/mm";
        damping_z_ns_per_mm: number(0.0, 1e15, 0.0), "damping along the axis, N s/mm";
        damping_rx_nmms_per_rad: number(0.0, 1e15, 0.0), "damping of the tilt about x, N mm s/rad";
        damping_ry_nmms_per_rad: number(0.0, 1e15, 0.0), "damping of the tilt about y, N mm s/rad";
        damping_rz_nmms_per_rad: number(0.0, 1e15, 0.0), "damping of turning, N mm s/rad";
    }
}
