//! All keys of a gearbox file: type, range, default, meaning; and the raw, unchecked values of a file. Checks take
//! ranges and defaults from here, and so does the JSON Schema.

use crate::{
    Integration, Sense,
    schema::{Boundary, GEARBOX_ACCURACY, RawGearboxAccuracy},
    table::INF,
};

table! {
    /// The whole file.
    GEARBOX, RawGearbox: "A gearbox of ale-gear: shafts, bearings, gears and the pairs that mesh. Every key has its unit in its name", needed ["shaft", "gear", "mesh", "input"]; {
        name: text(), "title; default: the file's name";
        shaft: list(SHAFT: RawShaft);
        bearing: list(BEARING: RawBearing);
        gear: list(GEAR: RawGear);
        mesh: list(MESH: RawMesh);
        input: table(INPUT: RawInput);
        torque: list(TORQUE: RawTorque);
        planets: list(PLANETS: RawPlanets);
        housing: table(HOUSING: RawHousing);
        accuracy: table(GEARBOX_ACCURACY: RawGearboxAccuracy);
        rating: table(GEARBOX_RATING: RawGearboxRating);
        analysis: always(ANALYSIS: RawAnalysis);
        vibration: table(VIBRATION: RawVibration);
        modes: table(GEARBOX_MODES: RawGearboxModes);
        motion: table(MOTION: RawMotion);
        output: always(OUTPUT: RawOutput);
    }
}

table! {
    /// `[[shaft]]`
    SHAFT, RawShaft: "a shaft along +z", needed ["name"]; {
        name: text(), "what bearings, gears and loads call it by; no two alike";
        origin_mm: numbers(), "where its z = 0 lies: x, y, z, up to 1e6; default: 0, 0, 0. Distances of axes are those of the pairs that mesh; a `centre_distance_mm` that a pair states is held against them";
        section: list(SECTION: RawSection);
        rexs: text(), "path of a REXS file that has its sections and its steel, in place of `[[shaft.section]]`. XML, components of the versions 1.0 to 1.4; cones become steps, as many as keep their bending to half a per cent; z = 0 is where the first section begins, along the shaft's own u";
        rexs_shaft: text(), "number or name of the shaft in that file; default: the only one";
        young_mpa: bare(1.0, 1e12), "Young's modulus, MPa; default: 206000, or the REXS file's";
        poisson: bare(0.0, 0.499), "Poisson's ratio; default: 0.3, or the REXS file's";
        density_kg_m3: bare(1e-9, 1e5), "density, kg/m^3, for vibration and motion; next to nothing where gears have all mass; default: 7850, or the REXS file's";
        held: switch(false), "whether it is rigid in rigid bearings. It turns about its axis and does nothing else; a pair alone is two of these";
        stands: switch(false), "whether it does not turn: a carrier seen from itself, or its pin. One of its bearings holds its turn (`turn_stiffness_nm_per_rad`), or with a `fixed` shaft the meshes do";
        fixed: switch(false), "whether it does not turn in space, while the carrier does: the ring of most stages. One of its bearings holds its turn (`turn_stiffness_nm_per_rad`). The carrier, which stands in its own frame, is then an input or an output. Speeds and rotations of input and loads are those in space";
    }
}

table! {
    /// `[[shaft.section]]`
    SECTION, RawSection: "a length of shaft of one section, from z = 0 on; at least one where there is no `rexs`", needed ["length_mm", "outer_diameter_mm"]; {
        length_mm: must(1e-3, 1e6), "length, mm";
        outer_diameter_mm: must(1e-3, 1e6), "outer diameter, mm";
        inner_diameter_mm: number(0.0, 1e6, 0.0), "inner diameter, mm, below the outer one; 0: solid";
    }
}

choices! {
    /// Kind of a rolling bearing.
    pub enum RollingKind {
        /// Balls in deep grooves.
        DeepGrooveBall = "deep-groove-ball",
        /// Balls with a contact angle.
        AngularContactBall = "angular-contact-ball",
        /// Cylindrical rollers between rings without ribs for thrust.
        CylindricalRoller = "cylindrical-roller",
        /// Tapered rollers.
        TaperedRoller = "tapered-roller",
    }
}

choices! {
    /// Relief of rollers.
    pub enum RollerProfile {
        /// To their ends as in ISO/TS 16281.
        Logarithmic = "logarithmic",
        /// None.
        Straight = "straight",
    }
}

choices! {
    /// Which thrust of the shaft a bearing takes.
    pub enum Thrust {
        /// Either way.
        Both = "both",
        /// None.
        None = "none",
        /// Towards +z alone.
        Up = "+z",
        /// Towards -z alone.
        Down = "-z",
    }
}

choices! {
    /// How two rows with a contact angle are set.
    pub enum Arrangement {
        /// Lines of contact meet the axis outside of the rows.
        BackToBack = "back-to-back",
        /// They meet it between the rows.
        FaceToFace = "face-to-face",
        /// Both rows take thrust the same way.
        Tandem = "tandem",
    }
}

table! {
    /// `[[bearing]]`
    BEARING, RawBearing: "a bearing between a shaft and the housing, or another shaft: single values, a matrix, or the `type` or `designation` of a rolling bearing", needed ["shaft", "position_mm"]; {
        name: text(), "name for tables; default: its place";
        shaft: text(), "name of its shaft";
        position_mm: must(0.0, INF), "where its middle is, mm from the shaft's z = 0, up to its length";
        in_shaft: text(), "name of the shaft that its seat is part of: a shaft of the same axis, or one that stands, as a carrier; default: the housing";
        in_bore_of: text(), "of cylindrical rollers: name of a gear on its shaft, at whose `position_mm` it is. The gear's bore is the outer race, the inner one is on the seat. At rest the rollers press the bore, whose `coupling` is distributing; in motion rings are rigid. Default: rigid rings, the inner one on the shaft";
        seat_offset_um: numbers(), "how far its seat stands off along x, y and z, um, up to 10000 either way: an error of a bore; default: 0, 0, 0";
        stiffness_n_per_mm: numbers(), "stiffness along x, y and z, N/mm, 0 .. 1e15 each; needed where there is no matrix and no `type`";
        tilt_stiffness_nm_per_rad: numbers(), "stiffness of the turns about x and y, N m/rad, 0 .. 1e15 each; default: 0, 0";
        turn_stiffness_nm_per_rad: bare(0.0, 1e15), "stiffness of the turn about z, N m/rad, of a shaft that stands or is fixed; default: 0";
        matrix_n_mm_rad: rows(0), "5 or 6 rows for x, y, z and the turns about x, y (and z): N/mm, N/rad and N mm/mm, N mm/rad; symmetric, no negative stiffness";
        damping_n_s_per_mm: numbers(), "damping along x, y and z, N s/mm, 0 .. 1e12 each, for vibration and motion; default: 0, 0, 0";
        r#type: bare_word(RollingKind), "what rolls in it; default: a bearing of a stiffness. Needle rollers are cylindrical ones; there is no law of spherical, toroidal, self-aligning, thrust, four-point contact and plain bearings: give their stiffness";
        designation: text(), "in place of `type`, `bore_mm`, `outer_diameter_mm` and `contact_angle_deg`: the basic designation of a bearing of one row, as \"6206\", \"61810\", \"7206B\", \"NU206\", \"32206\", \"32006X\", with the dimensions of ISO 15 and ISO 355. Rolling elements and ratings that are not stated are estimated from these dimensions: ratings are within a fifth of catalogue values, of cylindrical rollers up to 27 % below them; no stiffness of a catalogue stands behind the estimate";
        bore_mm: bare(1e-2, 1e5), "bore, mm. With outer diameter and static rating in place of what rolls, which is then estimated";
        outer_diameter_mm: bare(1e-2, 1e5), "outer diameter, mm, of a bearing that is estimated";
        static_rating_kn: bare(1e-6, 1e9), "C_0 of the whole bearing, kN, ISO 76";
        dynamic_rating_kn: bare(1e-6, 1e9), "C of the whole bearing, kN, ISO 281: reports its life; needs `[rating]` of the gearbox; default: estimated of a bearing with a `designation`, else none";
        elements: bare_whole(3, 500), "rolling elements of one row";
        element_diameter_mm: bare(1e-2, 1e5), "their diameter, mm; of tapered rollers in the middle";
        element_length_mm: bare(1e-2, 1e5), "of rollers: the length that presses, mm";
        pitch_diameter_mm: bare(1e-2, 1e5), "diameter of the circle of their centres, mm; default: between bore and outer diameter";
        contact_angle_deg: bare(1.0, 75.0), "nominal contact angle, degrees: 5 .. 75 of balls, 1 .. 60 of tapered rollers; needed where there is one. Deep grooves get theirs from clearance and load";
        inner_conformity: number(0.502, 0.7, 0.52), "groove radius of the inner ring over the ball's diameter. The default is that of ISO 76 and ISO 281";
        outer_conformity: number(0.502, 0.7, 0.53), "groove radius of the outer ring over the ball's diameter. The default is that of ISO 76 and ISO 281";
        profile: word(RollerProfile), "relief of rollers to their ends. logarithmic: as in ISO/TS 16281; straight: none";
        radial_clearance_um: number(-1e3, 1e4, 0.0), "of deep grooves and cylindrical rollers: radial play from one side to the other, um; below 0: pressed";
        axial_clearance_um: number(-1e3, 1e4, 0.0), "of angular contact and tapered rows: way of the shaft into a row's thrust until it touches, um; below 0: pressed";
        preload_n: bare(0.0, 1e9), "in place of the axial clearance: force along the axis that presses each row before any load, N";
        takes_thrust: bare_word(Thrust), "which thrust of the shaft it takes; default: both, cylindrical rollers none; needed of single and tandem rows with a contact angle. Of these +z or -z, the way in which the shaft may press: of a pair face to face -z at the lower z and +z at the higher one, back to back the other way round. Of the others how the outer ring sits: none floats along z and finds its place there, +z and -z have a shoulder on one side. Cylindrical rollers take none";
        rows: whole(1, 2, 1), "rows of rolling elements";
        row_distance_mm: bare(1e-3, 1e5), "of two rows: distance of their middles, mm; `position_mm` is between them";
        arrangement: bare_word(Arrangement), "how two angular contact or tapered rows are set";
    }
}

table! {
    /// `[[gear]]`
    GEAR, RawGear: "a gear on a shaft; in motion its mass and inertia are those of its mesh, or what the scene of its pair states", needed ["name", "shaft", "position_mm"]; {
        name: text(), "what meshes call it by; no two alike";
        shaft: text(), "name of its shaft";
        position_mm: must(-1e6, 1e6), "where its mid-face is, mm from the shaft's z = 0; on the shaft where `seat_mm` is not stated. The difference of two gears in mesh is the offset of their mid-faces, with which what their scene states must agree";
        seat_mm: bare(0.0, INF), "cross-section that its bore moves with, mm from the shaft's z = 0; default: position_mm. Of a mesh of hub and shaft in one the end of its stub: the shaft of this file is what is not meshed, and the gear may be beyond its end. A bore that is held about another place is remarked on";
        key_deg: number(-360.0, 360.0, 0.0), "angle of its tooth 0 against the mark of its shaft, degrees: the phase of its mesh against others. The mark of the input's shaft is at 0; of any other shaft the first mesh that reaches it says where it is";
        mass_kg: bare(1e-9, 1e12), "mass, kg, for vibration; default: of the mesh of its first pair, rim and teeth from bore to tip. A gear that meshes with nothing must state it";
        transverse_inertia_kg_m2: bare(1e-15, 1e12), "inertia about an axis across its own, through the middle of its face, kg m^2; default: of its mesh";
        polar_inertia_kg_m2: bare(1e-15, 1e12), "inertia about its own axis, kg m^2; default: of its mesh";
    }
}

table! {
    /// `[[mesh]]`
    MESH, RawMesh: "two gears in mesh; torque, driver and rotation of the scene are those of a run by itself, its misalignment is added to what shafts and bearings make", needed ["scene", "pinion", "wheel"]; {
        name: text(), "name for tables; default: those of its gears";
        scene: document(SCENE), "path of the scene of the pair, or its tables, as `[mesh.scene.pinion]` and so on";
        set: texts(), "keys of that scene that are otherwise here, as after --set";
        pinion: text(), "name of the gear that is the scene's pinion; either may drive";
        wheel: text(), "name of the gear that is the scene's wheel";
        timing: word(MeshTiming), "how its gears are set on their shafts where the train closes a ring (power splits, planets). touching: against their keys, so that the flanks touch, as gears that are timed at assembly; keyed: as `key_deg` says, so that places of shafts and keys leave gaps or overlaps, which share the load unevenly";
    }
}

table! {
    /// `[input]`
    INPUT, RawInput: "where the turn is given; the torque there is a result, but in a motion that it drives", needed ["shaft", "position_mm"]; {
        shaft: text(), "name of its shaft";
        position_mm: must(0.0, INF), "where it is, mm from the shaft's z = 0, up to its length";
        rotation: word(Sense), "sense, seen from +z. All others follow by the teeth";
        amplitude_nm: bare(0.0, 1e12), "in a motion that a torque drives: amplitude of a harmonic part T cos(2 pi f t + phase) beside `input_torque_nm`, N m";
        frequency_hz: bare(1e-9, 1e9), "its frequency, Hz";
        phase_deg: number(-360.0, 360.0, 0.0), "phase of its cosine at t = 0, degrees";
        table_s_nm: rows(2), "in such a motion in place of the others and of `input_torque_nm`: rows of time, s, ascending, and torque, N m; straight lines between, held before and after";
        inertia_kg_m2: number(0.0, 1e12, 0.0), "inertia of the machine there about its axis, kg m^2, for vibration and motion. It turns with the shaft and does not tilt with it";
    }
}

table! {
    /// `[[torque]]`
    TORQUE, RawTorque: "a load on a shaft, one for each output", needed ["shaft", "position_mm", "torque_nm"]; {
        shaft: text(), "name of its shaft";
        position_mm: must(0.0, INF), "where it acts, mm from the shaft's z = 0, up to its length";
        torque_nm: must(0.0, 1e12), "torque against the rotation of its shaft, N m; in motion the mean of a torque with a harmonic part. Where a torque over time is negative it presses the coast flanks: meshes then need both flanks";
        amplitude_nm: bare(0.0, 1e12), "in motion: amplitude of a harmonic part T cos(2 pi f t + phase), N m";
        frequency_hz: bare(1e-9, 1e9), "its frequency, Hz";
        phase_deg: number(-360.0, 360.0, 0.0), "phase of its cosine at t = 0, degrees";
        table_s_nm: rows(2), "in motion the whole torque, in place of `torque_nm` and of the others: rows of time, s, ascending, and torque, N m; straight lines between, held before and after";
        inertia_kg_m2: number(0.0, 1e12, 0.0), "inertia of the machine there about its axis, kg m^2, as at the input";
    }
}

table! {
    /// `[[planets]]`
    PLANETS, RawPlanets: "planets of a stage, seen from their carrier: the shafts of the first one with their bearings and gears, and the meshes of these, are written once and stand for all. Copies have a number behind their names: \"planet 1\", \"planet 2\"", needed ["shafts", "around", "count"]; {
        shafts: texts(), "names of the shafts of the first planet: its own, and its pin where that is one";
        around: text(), "name of the shaft whose axis they stand around: carrier, sun or ring";
        count: bare_whole(2, 24), "how many there are";
        angles_deg: numbers(), "angle of each from the first one about +z, degrees, which is 0; default: evenly spaced. Teeth must go in: multiples of 360/(z_sun + z_ring) where a planet has one set of teeth";
        tangential_errors_um: numbers(), "how far the pin of each stands off along the circle, about +z, um; default: 0. They move the seats of its bearings, and share the load unevenly";
        radial_errors_um: numbers(), "how far the pin of each stands off away from the middle, um; default: 0";
    }
}

table! {
    /// `[housing]`
    HOUSING, RawHousing: "stiffness between the bearing seats, foundation included; left out: rigid"; {
        matrix_n_mm_rad: rows(0), "six rows a bearing in the housing, in their order; symmetric";
        file: text(), "path of the file of another program that has it, in N and mm, condensed to the seats alone. `.mtx`: the substructure matrix of CalculiX; all others: `DMIG` entries as Nastran punches them, real, square or symmetric";
        matrix: text(), "name of the DMIG matrix in that file; default: the first one";
        nodes: wholes(), "with a file: node of the seat of each bearing in the housing, in their order";
        turn_nodes: wholes(), "nodes whose directions 1 to 3 are the turns, in CalculiX those after `ROT NODE`; default: directions 4 to 6 of nodes";
    }
}

table! {
    /// `[rating]`
    GEARBOX_RATING, RawGearboxRating: "load capacity at rest: of every mesh whose scene has `[rating]`, under the torque and at the speed that it has here, the life of every bearing with `dynamic_rating_kn` or a `designation` after ISO/TS 16281, and what meshes and bearings lose", needed ["speed_rpm"]; {
        speed_rpm: must(1e-3, 1e6), "speed of the input, 1/min";
        viscosity_mm2_per_s: bare(1e-3, 1e6), "kinematic viscosity of the oil in the bearings at their temperature, mm^2/s: what rolling bearings lose, and with `contamination_factor` how long they last";
        contamination_factor: bare(1e-3, 1.0), "e_C of ISO 281, what dirt leaves of the fatigue limit: modified lives beside the basic ones. 1 extreme cleanliness, 0.8 .. 0.6 filtered and sealed for life, 0.6 .. 0.5 sealed, 0.5 .. 0.3 slight dirt. Needs `viscosity_mm2_per_s`";
        spectrum: text(), "file of loads over the life, with commas and a heading: `torque_nm` of the first `[[torque]]`, others in proportion, `speed_rpm` of the input, and one of `share`, `duration_s`, `duration_h`. The gearbox is solved under each: Miner's sums of the meshes with the K_Hbeta of each load, lives of the bearings beside those under the torques of this file. Loads without torque or speed do no damage";
    }
}

table! {
    /// `[analysis]`
    ANALYSIS, RawAnalysis: "positions at rest"; {
        positions_per_cycle: whole(1, 10_000, 32), "positions of the input in a cycle of the first mesh";
        cycles: whole(1, 10_000, 1), "cycles of the first mesh, from where the keys put it. The other meshes go on by the teeth, and their cycles end elsewhere";
        shaft_elements: whole(1, 1000, 16), "elements along every shaft, at least. At rest they are exact, and draw its line; natural frequencies go with them";
    }
}

choices! {
    /// How the input turns in a vibration.
    pub enum InputTurn {
        /// Freely, with its machine.
        Free = "free",
        /// As it is given.
        Held = "held",
    }
}

table! {
    /// `[vibration]`
    VIBRATION, RawVibration: "vibration about the equilibrium, order by order of every mesh; left out: none", needed ["from_rpm", "to_rpm"]; {
        from_rpm: must(1e-3, 1e6), "lowest speed of the input, 1/min";
        to_rpm: must(1e-3, 1e6), "highest speed of the input, 1/min";
        speeds: whole(2, 2000, 101), "number of speeds, evenly spaced. The Campbell diagram has up to 21";
        orders: whole(1, 50, 5), "orders of each mesh. Its cycle is solved at `positions_per_cycle` places, and at 16, or four times as many as the orders, at least";
        damping_ratio: number(1e-6, 1.0, 0.02), "share of critical damping of every mode, which limits the peaks at resonance";
        modes: whole(1, 500, 20), "natural frequencies in the results";
        input: word(InputTurn), "whether the input turns freely with its machine, or its turn is given. held: as by a machine of any inertia";
    }
}

table! {
    /// `[modes]` of a gearbox
    GEARBOX_MODES, RawGearboxModes: "which normal modes of the gears move beside their rigid motion (with [vibration], or with [motion] and the mesh exact); what is not kept stays quasi-static. Left out: gears are rigid beside their teeth"; {
        count: whole(1, 1000, 12), "the lowest so many modes of each gear that meshes, bore held and flanks free. Modes of one frequency stay together, so there may be one more";
        below_hz: bare(1.0, 1e9), "in place of count: all modes of each gear up to this frequency, Hz";
        boundary: word(Boundary), "whether the flanks have inertia of their own. massless: modes of the whole mesh, the rest of the flanks' compliance without inertia; consistent: modes of the Craig-Bampton model, with the flanks' consistent mass";
        fixed_modes: whole(0, 100, 2), "modes with the flanks held behind a consistent boundary: of every harmonic of a cyclic gear, in all of any other one";
        damping_ratio: number(0.0, 1.0, 0.01), "damping ratio of every mode of the gears in a motion, beside those of its shafts (modal_damping_ratio). Steel alone has a thousandth";
    }
}

choices! {
    /// What turns the input.
    pub enum GearboxDrive {
        /// It keeps its speed.
        Speed = "speed",
        /// The turn of the whole train keeps its speed.
        Balanced = "balanced",
        /// A torque acts on it.
        Torque = "torque",
    }
}

choices! {
    /// How the gears of a mesh are set on their shafts where the train closes a ring.
    pub enum MeshTiming {
        /// So that the flanks touch, whatever their keys say.
        Touching = "touching",
        /// As their keys say.
        Keyed = "keyed",
    }
}

choices! {
    /// What stands for the meshes.
    pub enum MeshModel {
        /// A map of the exact contact.
        Mapped = "mapped",
        /// A spring over the phase, by the exact contact about its mean.
        Spring = "spring",
        /// The exact contact at every step.
        Exact = "exact",
    }
}

choices! {
    /// What is run.
    pub enum GearboxRun {
        /// All cycles from the equilibrium on.
        Span = "span",
        /// All cycles from where the motion repeats itself.
        Steady = "steady",
        /// All cycles of the periodic motion that Newton's method finds on the common period of the meshes.
        Shooting = "shooting",
        /// Periodic motions along the speed of the input, stable and unstable.
        Continuation = "continuation",
    }
}

table! {
    /// `[motion]`
    MOTION, RawMotion: "motion in time from the equilibrium on, after the positions at rest; left out: none", needed ["speed_rpm"]; {
        run: word(GearboxRun), "what is run. span: from the equilibrium on; steady: from where the motion repeats itself; shooting: as steady, and taken there by Newton's method as soon as it nearly repeats itself, which is faster than to wait where little damps or the common period is short; continuation: no rows in time, but the branch of periodic motions over the speed from `speed_rpm` to `to_speed_rpm`, stable and unstable, through loss of contact and around its folds, of maps or springs and a common period of all meshes that is not too long";
        speed_rpm: must(1e-3, 1e7), "speed of the input, 1/min: always, or at the start; of a continuation where the branch begins, with the motion that Newton's method finds from the equilibrium";
        to_speed_rpm: bare(1e-3, 1e7), "speed of the input at the end of all cycles, 1/min, to which it goes by the smooth step 3 x^2 - 2 x^3 (drive speed and balanced); default: speed_rpm. Steps are then turns of the input that are alike. Of a continuation the speed where the branch ends, above or below";
        drive: word(GearboxDrive), "what drives. speed: the input keeps its speed, as of a machine of any inertia; balanced: the common turn of the whole train keeps it, every part is free to vibrate against the others, and the torque of the input is in balance with loads and losses at every instant; torque: a torque acts on the input from that speed on";
        input_torque_nm: bare(0.0, 1e12), "torque on the input, N m (drive torque); default: what balances the loads by the numbers of teeth";
        mesh: word(MeshModel), "what stands for the meshes. mapped: maps of the exact contact over phase, approach and tilt, some ten seconds each; spring: springs over the phase for approach and tilt, by the exact contact about the mean displacement at rest, with flanks on both sides (`map_excess` above 1: the tilt has changed the stiffness by more than half, and the rows hold no more); exact: the exact contact at every step, as a pair in motion has it, the one that takes flanks by tooth. mapped and exact have friction and, with `flanks = \"both\"` in the scene of the pair, flanks on both sides; else the driving flanks alone: a motion that goes through the backlash is refused";
        cycles: whole(1, 1_000_000, 50), "cycles of the fastest mesh";
        duration_s: bare(1e-9, 1e6), "in place of `cycles`: length of the motion, of a run-up from `speed_rpm` to `to_speed_rpm`, s; in whole cycles of the fastest mesh";
        steps_per_cycle: whole(8, 10_000, 64), "steps a cycle of the fastest mesh";
        steps_per_row: whole(1, 1_000_000, 1), "steps a row; up to 500000 rows";
        waterfall_cycles: whole(4, 100_000, 16), "cycles of the slowest mesh of one spectrum of the waterfall (to_speed_rpm), and of a point of the orders of the meshes over time or speed";
        method: word(Integration), "method of integration";
        spectral_radius: bare(0.0, 1.0), "of generalised-alpha: damping of the highest frequencies; default: 0.9";
        error_tolerance: bare(1e-12, 0.1), "local error of a step over the displacements at rest; default: steps of equal length. Steps are as short as that needs, and end at the rows";
        stop_at_events: switch(false), "ends a step wherever contact is lost or gained";
        periodic_tolerance: number(1e-12, 0.5, 1e-6), "difference after a common period of all meshes over the peak to peak that counts as none (steady, shooting; continuation: of motions in time)";
        warm_up_cycles: whole(1, 100_000_000, 1000), "cycles of the fastest mesh to wait for that at the most (the same)";
        mesh_damping_ratio: number(0.0, 10.0, 0.05), "damping ratio of both gears of a mesh turning against each other on the mean stiffness of its cycle at rest; the input's gear does not turn where its held shaft keeps the speed. Shared over the contact lines, never a pull";
        mesh_damping_ns_per_mm2: bare(0.0, 1e9), "in its place: damping of a mm of contact line, N s/mm^2";
        modal_damping_ratio: number(0.0, 1.0, 0.02), "damping ratio of every elastic mode about the equilibrium, beside that of bearings and meshes";
        highest_frequency_hz: bare(1.0, 1e7), "highest frequency that shafts must show, Hz; default: four times that of the fastest mesh. Modes with seats held are kept up to twice that, and more until natural frequencies up to it are off by half a per cent at the most";
        map_tolerance: number(1e-6, 0.5, 2e-3), "error of maps that is aimed at: of the approach over the mean approach, and of friction over the force";
        map_overload: number(1.0, 1000.0, 4.0), "largest force of maps over the mean at rest. Flanks on both sides have tilts of the gears up to there, of four times the mean at most";
        checkpoint_every_cycles: whole(0, 1_000_000, 0), "a checkpoint every so many cycles of the fastest mesh; 0: none";
        continuation: table(CONTINUATION: RawContinuation);
    }
}

table! {
    /// `[motion.continuation]`
    CONTINUATION, RawContinuation: "accuracy of a branch of periodic motions over the speed, by harmonic balance at the meshes; all keys have defaults"; {
        periods: whole(1, 16, 1), "common periods of all meshes after which the motion comes back; 2 for what a period doubling leads to";
        harmonics: whole(1, 500, 12), "harmonics of a cycle of the fastest mesh to begin with; those of the whole period are up to 1000";
        most_harmonics: whole(1, 500, 96), "the largest number of them";
        tail: number(1e-9, 0.1, 1e-4), "largest share of the vibration that harmonics left out may have; more are added until it is kept";
        phases: whole(64, 65_536, 512), "least number of phases of a cycle of the fastest mesh at which forces are evaluated; loss of contact asks for many";
        longest_step: number(1e-4, 1.0, 0.05), "longest step along the branch, in ranges of the speed and static deflections";
        motions: whole(2, 100_000, 1000), "largest number of motions";
        time_points: whole(0, 1000, 4), "stable motions that are run in time as well: until they repeat themselves, as a steady run";
    }
}

table! {
    /// `[output]`
    OUTPUT, RawOutput: "files on request"; {
        parquet: switch(false), "every table column by column as well: positions.parquet, motion.parquet and so on";
    }
}

/// Every table with its keys, as messages look them up.
pub(crate) fn tables() -> Vec<(String, Vec<&'static str>)> {
    GEARBOX.names()
}
