//! The file itself, and the tables for pair, load, contact, analysis and output.

use super::accuracy::{ACCURACY, RawAccuracy};
use super::gear::{GEAR, MATERIAL, RawGear, RawMaterial, WHEEL};
use super::models::{
    IMPACT, LUMPED8, LUMPED12, MESH, RawImpact, RawLumped8, RawLumped12, RawMesh, RawShaft18, SHAFT18,
};
use super::motion::{DRIVE, LOAD, MODES, MOTION, RawDrive, RawLoad, RawModes, RawMotion};
use super::rating::{RATING, RawRating};
use crate::table::INF;
use geometry::{Driver, Sense};

fields! { ; MisalignmentScene: is_none }

table! {
    /// The whole file.
    SCENE, RawScene: "A scene of ale-gear: a pair of helical gears, its load, and what is computed. Every key has its unit in its name", needed ["pinion", "wheel", "pair", "operation"]; {
        name: text(), "title of the case; default: the file's name";
        pinion: always(GEAR: RawGear);
        wheel: always(WHEEL: RawGear);
        pair: always(PAIR: RawPair);
        material: always(MATERIAL: RawMaterial);
        operation: always(OPERATION: RawOperation);
        contact: always(CONTACT: RawContact);
        drive: table(DRIVE: RawDrive);
        load: table(LOAD: RawLoad);
        analysis: always(ANALYSIS: RawAnalysis);
        accuracy: table(ACCURACY: RawAccuracy);
        modes: table(MODES: RawModes);
        motion: table(MOTION: RawMotion);
        mesh: table(MESH: RawMesh);
        lumped8: table(LUMPED8: RawLumped8);
        lumped12: table(LUMPED12: RawLumped12);
        impact: table(IMPACT: RawImpact);
        shaft18: table(SHAFT18: RawShaft18);
        rating: table(RATING: RawRating);
        output: always(OUTPUT: RawOutput);
    }
}

table! {
    /// `[pair]`
    PAIR, RawPair => PairScene Copy: "what both gears share", needed ["normal_module_mm"]; {
        normal_module_mm: must(0.01, 200.0), "normal module, mm";
        normal_pressure_angle_deg: number(5.0, 40.0, 20.0), "normal pressure angle, degrees";
        face_width_mm: bare(0.01, 1e4) => {f64}, "face width of gears that state none of their own, mm; left out where both do";
        mid_face_offset_mm: bare(-1e4, 1e4), "height of the wheel's mid-face over the pinion's along +z, mm; default: 0, in a gearbox where the shafts have the gears. The faces must overlap";
        centre_distance_mm: bare(0.01, 1e5) => {Option<f64>}, "working centre distance, mm, with an internal gear negative or without sign; default: the one that follows from the profile shifts";
        addendum_coefficient: number(0.1, 2.0, 1.0), "addendum of the basic rack over the normal module";
        dedendum_coefficient: number(0.1, 2.5, 1.25), "dedendum of the basic rack over the normal module";
        root_radius_coefficient: number(0.0, 1.0, 0.38), "tip radius of the basic rack over the normal module. Where it is not stated and the rack has no room for 0.38, the largest that fits is taken (0.3178 at 25 degrees)";
        misalignment: table(MISALIGNMENT: RawMisalignment) => (MisalignmentScene);
    }
}

table! {
    /// `[pair.misalignment]`
    MISALIGNMENT, RawMisalignment => MisalignmentScene Copy Default: "deviation of the wheel's axis against the pinion's over the common face width, turned about the wheel's mid-face; the parts add up, each at most 10 um a mm of the narrower face width"; {
        deviation_um: number(-INF, INF, 0.0), "f_Sigma_beta: deviation of the wheel's axis across the plane of axes, um over the face width. Positive where the wheel's axis leans towards +y as z grows";
        inclination_um: number(-INF, INF, 0.0), "f_Sigma_delta: deviation of the wheel's axis in the plane of axes, um over the face width. Positive where the distance of the axes grows with z";
        in_plane_of_action_um: number(-INF, INF, 0.0), "deviation in the plane of action of the driving flanks, um over the face width. Positive where the gap opens as z grows; of a spur pair it acts as a lead slope of this amount, of a helical pair it opens the gap along the contact lines";
        across_plane_of_action_um: number(-INF, INF, 0.0), "deviation across the plane of action, um over the face width. Has next to no effect";
    }
}

table! {
    /// `[operation]`
    OPERATION, RawOperation => Operation Copy: "load and motion", needed ["torque_nm"]; {
        driver: word(Driver), "the gear that drives";
        rotation: word(Sense), "sense of rotation of the pinion, seen from +z";
        torque_nm: must(0.0, 1e9), "torque on the driven gear, N m, against its motion; `driver` and `rotation` say which flanks it presses";
        speed_rpm: number(1e-6, 1e7, 1000.0), "speed of the driver, 1/min. At rest for the time column alone; a motion runs at it, or begins at it where a torque drives; ramps and sweeps have speeds of their own";
    }
}

/// Slices of a pair that asks for no more, and of models that do not ask.
pub(crate) const LEAST_SLICES: u32 = 32;

table! {
    /// `[contact]`
    CONTACT, RawContact => ContactScene Copy: "how flanks press on each other"; {
        method: word(Method), "contact unknowns: one line load an axial slice, or pressed points of the flank mesh. slice: local compliance in closed form, hardly dependent on the mesh; nodal: pressures at quadrature points";
        slices: bare_whole(4, 1000), "slices over the face width (method slice); default: as width, helix, load, micro-geometry and misalignment ask for (theory, equation 21c), 32 to 384; models that are not cut have 32. A number that is too small for the pair is remarked on, with the one that would do";
        penalty_mpa_per_mm: bare(1.0, 1e15), "pressure a mm of penetration, MPa/mm, in place of exact contact (method nodal)";
        gap: word(Gap) => Some, "surface that the gaps come from (method nodal). smooth: the exact involute; facet: the flat faces of the mesh, to show what facets do, not for engineering";
        points_per_face_edge: whole(1, 20, 6) => Some, "quadrature points along each edge of a flank face (method nodal)";
        flanks: bare_word(Flanks), "which flanks may touch; default: driving, in time both";
        friction: number(0.0, 1.0, 0.0), "Coulomb's coefficient of friction (reduced, mapped, lumped8, lumped12)";
        corner_contact: switch(true) => Some, "whether tip edges may press off the line of action, as deflected teeth do (method slice). false is for study: the transmission error then has steps under load";
    }
}

choices! {
    /// Where the contact unknowns sit.
    pub enum Method {
        /// One line load an axial slice.
        Slice = "slice",
        /// Quadrature points of the flank mesh.
        Nodal = "nodal",
    }
}

choices! {
    /// Which surface gives the gaps.
    pub enum Gap {
        /// The exact involute helicoid.
        Smooth = "smooth",
        /// The faces of the mesh: for showing what facets do to the transmission error, not for engineering.
        Facet = "facet",
    }
}

choices! {
    /// Which flanks may touch.
    pub enum Flanks {
        /// Those that the torque presses together.
        Driving = "driving",
        /// Both sides.
        Both = "both",
    }
}

table! {
    /// `[analysis]`
    ANALYSIS, RawAnalysis => Analysis Copy Eq: "what is computed"; {
        kind: bare_word(Kind), "equilibrium at every position, or motion in time; default: static, for models of motion (mapped, lumped8, lumped12, shaft18, impact) dynamic. Of models with meshes, reduced and reduced+modes with the method slice move";
        model: word(Model), "which model of the pair. reduced: flanks of the tooth window; auto: the cheapest that is as exact as `[accuracy]` asks (the default with that table); reduced+modes: with normal modes of both gears, in motion; mapped: a map of the contact of reduced, for motion a hundred times faster; full: every degree of freedom; iso: ISO 6336-1 without a mesh; lumped8, lumped12, shaft18, impact: cheaper models of motion";
        reduction: word(Reduction) => Some, "how gears are condensed, with the same result (reduced, reduced+modes, mapped). auto: one sector where the gear is cyclic (a periodic sector, the built-in mesher, a whole mesh that a turn by one pitch leaves the same to round-off), else one factor of the whole gear; general: always the whole gear, to compare";
        positions_per_cycle: whole(1, 100_000, 32), "positions in one mesh cycle, evenly spaced, its end left out. In motion: of the quasi-static cycle that it starts from and that its mean stiffness is taken from";
        cycles: bare_whole(1, 100_000_000) => {u32} as written_cycles, "mesh cycles; default: 1, in time 8. In time those that are written, after the motion has settled";
        turn: bare_word(Turn) => Some, "in place of `cycles`: as many mesh cycles as one turn takes, for flanks and pitch errors by tooth. pinion: of the pinion; wheel: of the wheel; hunting: until the same teeth meet again";
        window_teeth: bare_whole(1, 25), "teeth whose flanks are kept; default: floor(eps_gamma) + 1, at least 3, and one more, with a warning, as often as the load asks for it. A given number is never changed";
    }
}

choices! {
    /// Turn that the mesh cycles make up.
    pub enum Turn {
        /// Of the pinion.
        Pinion = "pinion",
        /// Of the wheel.
        Wheel = "wheel",
        /// Until the same teeth meet again.
        Hunting = "hunting",
    }
}

choices! {
    /// Quasi-static or in time.
    pub enum Kind {
        /// Equilibrium at every position.
        Static = "static",
        /// Motion in time.
        Dynamic = "dynamic",
    }
}

choices! {
    /// A model of the pair.
    pub enum Model {
        /// Flanks of the tooth window.
        Reduced = "reduced",
        /// The cheapest that is as exact as `[accuracy]` asks.
        Auto = "auto",
        /// Flanks of the tooth window with normal modes of both gears, in time.
        ReducedModes = "reduced+modes",
        /// A map of the contact of the reduced gears, in time.
        Mapped = "mapped",
        /// Every degree of freedom of both meshes.
        Full = "full",
        /// ISO 6336-1 stiffness and analytic contact lines; no mesh.
        Iso = "iso",
        /// Eight coordinates, mesh stiffness, backlash and friction.
        Lumped8 = "lumped8",
        /// Twelve coordinates.
        Lumped12 = "lumped12",
        /// Two lumped shafts with the mesh between them.
        Shaft18 = "shaft18",
        /// Rigid gears, force by overlap of their true flanks.
        Impact = "impact",
    }
}

choices! {
    /// Which way gears are condensed.
    pub enum Reduction {
        /// One sector where the gear is cyclic, else the whole gear.
        Auto = "auto",
        /// The whole gear in one factor.
        General = "general",
    }
}

table! {
    /// `[output]`
    OUTPUT, RawOutput => OutputScene Eq: "what is computed and written on request"; {
        root_stress: switch(false), "stress in the root fillets at every position or row (reduced and full at rest, reduced in motion, meshes of gearboxes at rest)";
        contact_lines: switch(false), "contact_lines.csv: every loaded slice of every position (method slice)";
        flank_orders: switch(false), "te_orders.csv and te_shares.csv: orders of the transmission error over all `cycles`, and what each wave and each tooth of topographies and pitch errors makes of them, to first order. Model reduced with slices at rest, under load; `turn` in `[analysis]` solves a whole turn";
        parquet: switch(false) as written_parquet, "every table column by column as well: history.parquet beside history.csv, for long runs";
        vtu: switch(false), "ParaView files, as `--vtu`: at rest, and of one motion of the model reduced without checkpoints";
        fields: words(FieldName), "fields of the ParaView files; default: all";
        vtu_every: whole(1, 1_000_000, 1), "one ParaView file every so many positions or rows";
        derivatives: texts(), "keys by which transmission error, stiffness, pressure and pair forces of history.csv are differentiated, as `--derivatives`. Keys of `[pinion.modification]`, `[wheel.modification]` and `[pair.misalignment]` with dots; model reduced with slices at rest, under load, without `[accuracy]`; of a modification of both flanks the pressed ones count";
    }
}

choices! {
    /// A field of the ParaView files.
    pub enum FieldName {
        /// Displacement of every node, mm.
        Displacement = "displacement",
        /// Contact pressure at flank nodes, MPa.
        Pressure = "pressure",
        /// Stress tensor and von Mises stress, MPa.
        Stress = "stress",
    }
}
