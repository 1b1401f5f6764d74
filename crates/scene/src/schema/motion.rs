//! Motion in time: bodies, bearings, torques, modes, integration, analyses.

use integrate::Scheme;

fields! { ; BearingScene: is_none }

table! {
    /// `[pinion.body]`
    BODY, RawBody => BodyScene Default: "rigid body of the gear (analyses in time); of a mesh with a part of the teeth, mass and inertia are taken times teeth over meshed teeth"; {
        mass_kg: bare(1e-9, 1e9), "mass, kg; default: of the mesh";
        transverse_inertia_kg_m2: bare(1e-15, 1e12), "inertia about an axis across the gear's own, through its centre at mid-face, kg m^2; default: of the mesh";
        polar_inertia_kg_m2: bare(1e-15, 1e12), "inertia about the gear's own axis, kg m^2; default: of the mesh";
        added_inertia_kg_m2: number(0.0, 1e12, 0.0), "inertia of engine, load or shaft on the same axis, kg m^2";
        free: words(Axis), "coordinates that are free beside the turn: displacements of the centre, tilts about x and y; default: none. The driven gear's turn is always free, the driver's when a torque drives it";
    }
}

choices! {
    /// A rigid coordinate of a gear's centre.
    pub enum Axis {
        /// Along the line of centres.
        X = "x",
        /// Across it.
        Y = "y",
        /// Along the axis.
        Z = "z",
        /// Tilt about x.
        Rx = "rx",
        /// Tilt about y.
        Ry = "ry",
    }
}

impl Axis {
    /// All axes, in the order of the coordinates.
    pub const ALL: [Self; 5] = [Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry];

    /// Index of the coordinate.
    pub fn number(self) -> usize {
        self as usize
    }
}

table! {
    /// `[pinion.bearing]`
    BEARING, RawBearing => BearingScene Default: "what holds the gear's centre (analyses in time); every free coordinate needs a stiffness"; {
        stiffness_x_n_per_mm: bare(1e-6, 1e15), "stiffness along the line of centres, N/mm";
        stiffness_y_n_per_mm: bare(1e-6, 1e15), "stiffness across it, N/mm";
        stiffness_z_n_per_mm: bare(1e-6, 1e15), "stiffness along the axis, N/mm";
        stiffness_rx_nmm_per_rad: bare(1e-6, 1e15), "stiffness against tilt about x, N mm/rad";
        stiffness_ry_nmm_per_rad: bare(1e-6, 1e15), "stiffness against tilt about y, N mm/rad";
        stiffness_rz_nmm_per_rad: bare(1e-6, 1e15), "stiffness against the turn off the nominal one, N mm/rad, as of a motor (lumped8, lumped12); default: nothing holds it. With friction one gear needs it, or both drift";
        damping_ratio: number(0.0, 10.0, 0.02) => Some, "damping ratio of every free direction without damping of its own: c = 2 zeta sqrt(k m)";
        damping_x_ns_per_mm: bare(0.0, 1e15), "damping along x, N s/mm";
        damping_y_ns_per_mm: bare(0.0, 1e15), "damping along y, N s/mm";
        damping_z_ns_per_mm: bare(0.0, 1e15), "damping along z, N s/mm";
        damping_rx_nmms_per_rad: bare(0.0, 1e15), "damping of the tilt about x, N mm s/rad";
        damping_ry_nmms_per_rad: bare(0.0, 1e15), "damping of the tilt about y, N mm s/rad";
        damping_rz_nmms_per_rad: bare(0.0, 1e15), "damping of the turn off the nominal one, N mm s/rad (lumped8)";
        stiffness_matrix_n_mm_rad: rows(5) => {Option<[[f64; 5]; 5]>}, "in place of single stiffnesses: five rows of five, symmetric, order x, y, z, rx, ry; N/mm, N/rad, N mm/rad";
        damping_matrix_ns_mm_rad: rows(5) => {Option<[[f64; 5]; 5]>}, "in place of single dampings: N s/mm, N s/rad, N mm s/rad";
    }
}

table! {
    /// `[drive]`
    DRIVE, RawDrive: "what drives the driver (analyses in time)"; {
        by: bare_word(DriveBy), "what is given of the driver; default: its torque, with the models impact, lumped8, lumped12 and shaft18 its speed. torque: both gears turn freely against each other, and both inertias carry the mesh resonance; speed: the driver's angle is prescribed, as by a motor or flywheel much heavier than the gears, and the driven gear alone carries it. Lumped gears are always free; rigid ones (impact) lose speed to friction where a torque drives";
        torque_nm: bare(-1e9, 1e9), "torque of the driver in the running sense, N m; default: in balance with the load at every instant, which holds the mean speed. One that is stated acts as it is, and the speed, which begins at `speed_rpm`, follows (steady and span only)";
        amplitude_nm: bare(0.0, 1e9), "amplitude of a harmonic part T cos(2 pi f t + phase), N m";
        frequency_hz: bare(1e-9, 1e9), "its frequency, Hz";
        phase_deg: number(-360.0, 360.0, 0.0), "phase of its cosine at t = 0, degrees";
        table_s_nm: rows(2), "in place of the others: rows of time, s, ascending, and torque, N m; straight lines between, held before and after";
    }
}

choices! {
    /// What is given of the driver.
    pub enum DriveBy {
        /// The driver's torque; it starts at `speed_rpm`.
        Torque = "torque",
        /// The driver's speed.
        Speed = "speed",
    }
}

table! {
    /// `[load]`
    LOAD, RawLoad: "torque on the driven gear over time: a harmonic part beside its mean, or the whole of it by a table (analyses in time); where it is negative it presses the coast flanks"; {
        amplitude_nm: bare(0.0, 1e9), "amplitude of a harmonic part T cos(2 pi f t + phase), N m";
        frequency_hz: bare(1e-9, 1e9), "its frequency, Hz";
        phase_deg: number(-360.0, 360.0, 0.0), "phase of its cosine at t = 0, degrees";
        table_s_nm: rows(2), "the whole torque, in place of `torque_nm` in [operation] and of the others: rows of time, s, ascending, and torque, N m; straight lines between, held before and after";
    }
}

table! {
    /// `[modes]`
    MODES, RawModes => ModesScene Copy; defaults: "which normal modes of the gears move beside the rigid bodies (model reduced+modes); what is not kept stays quasi-static"; {
        count: whole(1, 1000, 12) => Some, "the lowest so many modes of each gear. Modes of one frequency stay together, so there may be one more";
        below_hz: bare(1.0, 1e9), "in place of count: all modes of each gear up to this frequency, Hz";
        boundary: word(Boundary), "whether the flanks have inertia of their own. massless: modes of the whole mesh, the rest of the flanks' compliance without inertia; consistent: modes of the Craig-Bampton model, with the flanks' consistent mass";
        fixed_modes: whole(0, 100, 2) => Some, "modes with the flanks held behind a consistent boundary: of every harmonic of a cyclic gear, in all of any other one";
        damping_ratio: number(0.0, 1.0, 0.01), "damping ratio of every mode. Steel alone has a thousandth";
    }
}

choices! {
    /// Inertia of the flanks.
    pub enum Boundary {
        /// None but what the modes carry: modes of the whole mesh, what they leave of the compliance answers at once.
        Massless = "massless",
        /// The mesh's own, condensed to the flanks (Craig and Bampton).
        Consistent = "consistent",
    }
}

table! {
    /// `[motion]`
    MOTION, RawMotion => MotionScene; defaults: "integration and analysis in time"; {
        run: word(Run), "what is run. steady: until the motion repeats itself, then `cycles` mesh cycles are written; shooting: the same, the periodic state found directly; span: `cycles` or `duration_s` from the quasi-static start; ramp: run-up or run-down; sweep: steady states at many speeds; continuation: periodic motions along a key, stable and unstable; basins: to which motion the pair settles from each state of a plane";
        method: word(Integration), "method of integration. The last two are explicit, Dormand-Prince 5(4) and Runge-Kutta's of fourth order: steps of equal length beyond the stability limit are refused, `error_tolerance` chooses them";
        spectral_radius: number(0.0, 1.0, 0.9) => Some, "spectral radius at infinite frequency (generalised-alpha). 1 keeps high frequencies, 0 takes them away in one step";
        steps_per_mesh_cycle: whole(8, 100_000, 64), "rows of the results in a mesh cycle, and least number of steps";
        steps_per_resonance: whole(0, 100_000, 16), "least number of steps in a period of the mesh resonance; 0: rows are the steps. Where rows are farther apart, several steps are taken from row to row; with reduced+modes the highest kept mode counts where it is faster";
        error_tolerance: bare(1e-12, 0.1), "local error of a step over the static deflection; default: steps of equal length. Steps are as long as it allows, rows as before; a run whose rows take 30,000 steps and more, each below a thousandth of the largest, is refused";
        stop_at_events: switch(false), "ends a step wherever contact is lost or gained";
        mesh_damping_ratio: number(0.0, 10.0, 0.05) => Some, "damping ratio of the mesh: both gears turning against each other on the mean stiffness of their teeth. Shared over the contact lines, never a pull";
        mesh_damping_ns_per_mm2: bare(0.0, 1e9), "in its place: damping of a mm of contact line, N s/mm^2";
        periodic_tolerance: number(1e-12, 0.5, 1e-6) => Some, "difference of coordinates and velocities after a period over their peak to peak (1 to 8 mesh cycles, or as many times the cycles until the same teeth meet, where they differ) that counts as none (steady, shooting, sweep, basins; continuation: of motions in time)";
        warm_up_cycles: whole(0, 100_000_000, 1000) => Some, "mesh cycles to wait for the periodic state at the most (the same). mapped, lumped8, lumped12 and shaft18 are taken there by Newton's method once they nearly repeat themselves (theory, section 16): most wait some ten cycles";
        duration_s: bare(1e-9, 1e9), "length of a span, s, in place of cycles; in whole mesh cycles";
        checkpoint_every_cycles: whole(0, 100_000_000, 0) => Some, "a checkpoint every so many mesh cycles; 0: none (steady, span, ramp)";
        ramp: table(RAMP: RawRamp) => {Option<RampScene>};
        sweep: table(SWEEP: RawSweep) => {Option<SweepScene>};
        continuation: table(CONTINUATION: RawContinuation) => {Option<ContinuationScene>};
        basins: table(BASINS: RawBasins) => {Option<BasinScene>};
    }
}

choices! {
    /// An analysis in time.
    pub enum Run {
        /// At constant speed until the motion repeats itself, then the cycles asked for.
        Steady = "steady",
        /// Steady motion whose periodic state is found directly.
        Shooting = "shooting",
        /// So many cycles or seconds from the quasi-static start.
        Span = "span",
        /// Run-up or run-down.
        Ramp = "ramp",
        /// Steady states at many speeds.
        Sweep = "sweep",
        /// Periodic motions along a key, stable and unstable.
        Continuation = "continuation",
        /// To which motion the pair settles from each state of a plane.
        Basins = "basins",
    }
}

choices! {
    /// Method of integration.
    pub enum Integration {
        /// Implicit midpoint rule with a discrete gradient.
        Energy = "energy",
        /// Generalised-alpha.
        GeneralisedAlpha = "generalised-alpha",
        /// Newmark's constant average acceleration.
        Newmark = "newmark",
        /// Dormand-Prince 5(4), explicit.
        DormandPrince = "dormand-prince",
        /// Runge-Kutta's classical method of fourth order, explicit.
        RungeKutta4 = "rk4",
    }
}

impl Integration {
    /// The method; for generalised-alpha with a spectral radius at infinite frequency (default 0.9).
    pub fn scheme(self, spectral_radius: Option<f64>) -> Scheme {
        match self {
            Self::Energy => Scheme::Energy,
            Self::GeneralisedAlpha => Scheme::GeneralisedAlpha { rho: spectral_radius.unwrap_or(0.9) },
            Self::Newmark => Scheme::Newmark,
            Self::DormandPrince => Scheme::DormandPrince,
            Self::RungeKutta4 => Scheme::RungeKutta4,
        }
    }
}

table! {
    /// `[motion.ramp]`
    RAMP, RawRamp => RampScene Copy: "run-up or run-down: the driver's speed changes by the smooth step 3 x^2 - 2 x^3", needed ["from_rpm", "to_rpm", "duration_s"]; {
        from_rpm: must(0.0, 1e7), "speed at first, 1/min; 0: from rest";
        to_rpm: must(1e-3, 1e7), "speed in the end, 1/min; the motion ends with the mesh cycle in which it is reached";
        duration_s: must(1e-6, 1e6), "how long the change takes, s";
        before_s: number(0.0, 1e6, 0.0), "time at the first speed before, s";
        after_s: number(0.0, 1e6, 0.0), "time at the last speed afterwards, s";
        waterfall_cycles: whole(4, 100_000, 16), "mesh cycles of one spectrum of the waterfall";
    }
}

table! {
    /// `[motion.sweep]`
    SWEEP, RawSweep => SweepScene: "steady states at many speeds of the driver; ways, and speeds apart, run side by side on all cores", needed ["from_rpm", "to_rpm"]; {
        from_rpm: must(1e-3, 1e7), "lowest speed, 1/min";
        to_rpm: must(1e-3, 1e7), "highest speed, 1/min";
        speeds: whole(2, 100_000, 41), "how many speeds, evenly spaced";
        ways: words(SweepWay), "which way they are gone through; default: up and down. up, down: the state at the end of one speed begins the next, so that of coexisting motions each way keeps its own; apart: each speed from its own quasi-static start";
        steady_by: word(SteadyBy), "how each steady state is found: by waiting, or by shooting";
    }
}

choices! {
    /// Which way a sweep goes.
    pub enum SweepWay {
        /// Each speed from its own quasi-static start.
        Apart = "apart",
        /// Upwards, the state carried from speed to speed.
        Up = "up",
        /// Downwards.
        Down = "down",
    }
}

choices! {
    /// How a steady state is found.
    pub enum SteadyBy {
        /// By waiting.
        Running = "running",
        /// By shooting.
        Shooting = "shooting",
    }
}

table! {
    /// `[motion.continuation]`
    CONTINUATION, RawContinuation => ContinuationScene Copy: "periodic motions along a key, stable and unstable, by harmonic balance", needed ["from", "to"]; {
        key: word(ContinuationKey), "the key that changes. The torque not with a stiffness that the reduced model feeds, the damping not of lumped12, the backlash of lumped8 and shaft18";
        from: must(0.0, 1e9), "its value where the branch begins, in the unit of the key. The branch begins with the motion that a start from rest settles to there";
        to: must(0.0, 1e9), "its value where the branch ends; it may be the smaller one, and the branch may turn back on its way";
        period_cycles: whole(1, 64, 1), "mesh cycles after which the motion comes back; 2 for what a period doubling leads to";
        harmonics: whole(1, 500, 12), "harmonics of the period to begin with";
        most_harmonics: whole(1, 500, 96), "the largest number of them";
        tail: number(1e-9, 0.1, 1e-4), "largest share of the vibration that harmonics left out may have; more are added until it is kept";
        phases: whole(64, 65_536, 512), "least number of phases of a period at which forces are evaluated; loss of contact asks for many";
        longest_step: number(1e-4, 1.0, 0.05), "longest step along the branch, in ranges of the key and static deflections";
        motions: whole(2, 100_000, 1000), "largest number of motions";
        time_points: whole(0, 1000, 8), "stable motions that are run in time as well: until they repeat themselves, as a steady run";
    }
}

choices! {
    /// A key along which periodic motions are followed.
    pub enum ContinuationKey {
        /// Speed of the driver, 1/min.
        Speed = "operation.speed_rpm",
        /// Torque on the driven gear, N m.
        Torque = "operation.torque_nm",
        /// Damping ratio of the mesh.
        Damping = "motion.mesh_damping_ratio",
        /// Half of the backlash of a lumped mesh, um.
        HalfBacklash = "mesh.half_backlash_um",
    }
}

table! {
    /// `[motion.basins]`
    BASINS, RawBasins => BasinScene Copy: "to which motion the pair settles from each state of a plane", needed ["from_um", "to_um", "from_mm_s", "to_mm_s"]; {
        from_um: must(-1e5, 1e5), "lowest initial transmission error beside that of rest, um";
        to_um: must(-1e5, 1e5), "highest initial transmission error beside that of rest, um";
        from_mm_s: must(-1e6, 1e6), "lowest initial rate of the transmission error beside that of rest, mm/s";
        to_mm_s: must(-1e6, 1e6), "highest initial rate of the transmission error beside that of rest, mm/s";
        columns: whole(1, 2000, 41), "initial transmission errors, evenly spaced";
        rows: whole(1, 2000, 41), "initial rates, evenly spaced";
    }
}
