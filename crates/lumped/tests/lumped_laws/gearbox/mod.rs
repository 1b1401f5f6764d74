//! The transmission of seed 002 as far as it is given.

use geometry::Side;
use lumped::Fourier;
use lumped::shaft18::{
    Mesh, MeshGeometry, RunOut, Segment, Shaft, ShaftStation, ShaftSystem, ShaftTorque, Station, Support,
};

pub const ALL: [bool; 6] = [true; 6];
/// What a coupled end keeps: x, y and turn.
pub const END: [bool; 6] = [true, true, false, false, false, true];

pub fn steel(length: f64, outer_diameter: f64) -> Segment {
    Segment { length, outer_diameter, inner_diameter: 0.0, young: 2.06e5, poisson: 0.3, density: 7.85e-9 }
}

/// A place where the shaft's own mass is put, and which follows statically.
pub fn follower(position: f64) -> Station {
    Station { position, ..Station::default() }
}

/// A solid disc of given mass (t) and width (mm) of steel.
pub fn disc(position: f64, mass: f64, width: f64, kept: [bool; 6]) -> Station {
    let radius = (mass / (7.85e-9 * std::f64::consts::PI * width)).sqrt();
    let polar_inertia = 0.5 * mass * radius * radius;
    let transverse_inertia = 0.5 * polar_inertia + mass * width * width / 12.0;
    Station { position, mass, polar_inertia, transverse_inertia, kept }
}

fn bearing(position: f64, [x, y, z]: [f64; 3]) -> Support {
    Support { position, stiffness: [x, y, z, 0.0, 0.0, 0.0], damping: [0.5, 0.5, 0.5, 0.0, 0.0, 0.0] }
}

/// Two shafts of two segments each with the gear where they join (Table 1 of the seed: lengths, diameters, masses of
/// gears); bearings at all ends, softer in y than in x.
///
/// Not in the seed, chosen for it: teeth 30/46, m_n 2.75 mm, 20 deg, beta 30 deg, b 30 mm (solid discs of these
/// diameters have the seed's masses), bearings, coupled inertias, mesh stiffness after ISO 6336, torque 100 N m.
pub fn gearbox(speed: f64, half_backlash: f64) -> ShaftSystem {
    let teeth = [30, 46];
    let (m_n, beta) = (2.75, 30f64.to_radians());
    let centre_distance = 0.5 * m_n * f64::from(teeth[0] + teeth[1]) / beta.cos();
    let [p, g] = [ShaftStation { shaft: 0, station: 1 }, ShaftStation { shaft: 1, station: 0 }];
    let torque = 1e5;
    ShaftSystem {
        shafts: vec![
            Shaft {
                segments: vec![steel(113.8, 38.5), steel(96.6, 25.77)],
                stations: vec![
                    disc(0.0, 0.8e-3, 10.0, END),
                    disc(113.8, 1.66e-3, 30.0, ALL),
                    follower(37.9),
                    follower(75.9),
                    follower(162.1),
                    follower(210.4),
                ],
                supports: vec![bearing(0.0, [2e5, 1.5e5, 1e5]), bearing(210.4, [1.6e5, 1.2e5, 0.0])],
            },
            Shaft {
                segments: vec![steel(113.8, 30.48), steel(117.1, 36.79)],
                stations: vec![
                    disc(113.8, 3.94e-3, 30.0, ALL),
                    disc(230.9, 1.2e-3, 10.0, END),
                    follower(0.0),
                    follower(56.9),
                    follower(152.8),
                    follower(191.9),
                ],
                supports: vec![bearing(0.0, [1.6e5, 1.2e5, 0.0]), bearing(230.9, [2e5, 1.5e5, 1e5])],
            },
        ],
        meshes: vec![Mesh {
            gears: [p, g],
            geometry: MeshGeometry {
                teeth,
                normal_module: m_n,
                normal_pressure_angle: 20f64.to_radians(),
                helix_angle: beta,
                centre_distance,
                direction: 0.0,
                middle: [0.0; 2],
                side: Side::Left,
            },
            stiffness: Fourier { mean: 4.5e5, cosine: vec![0.6e5, 0.15e5], sine: vec![0.0, 0.1e5] },
            damping_ratio: 0.05,
            half_backlash,
            error: Fourier::default(),
            run_out: [RunOut::default(); 2],
        }],
        torques: vec![
            ShaftTorque { place: ShaftStation { shaft: 0, station: 0 }, torque },
            // The driven gear turns the other way; its load resists.
            ShaftTorque { place: ShaftStation { shaft: 1, station: 1 }, torque: torque * 46.0 / 30.0 },
        ],
        speed,
        mass_damping: 20.0,
        stiffness_damping: 2e-7,
        gravity: [0.0, -9810.0, 0.0],
    }
}

/// The gearbox with little load, a transmission error of 5 um and a drive that holds the mean turn: teeth separate.
/// `half_backlash` in mm.
pub fn light(speed: f64, half_backlash: f64) -> ShaftSystem {
    let mut system = gearbox(speed, half_backlash);
    for (t, torque) in system.torques.iter_mut().zip([2e4, 2e4 * 46.0 / 30.0]) {
        t.torque = torque;
    }
    let mesh = &mut system.meshes[0];
    mesh.stiffness = Fourier::first_order(4.5e5, 0.9e5, 0.0);
    mesh.error = Fourier::first_order(0.0, 0.005, 0.0);
    mesh.damping_ratio = 0.03;
    let drive = &mut system.shafts[0].supports[0];
    (drive.stiffness[5], drive.damping[5]) = (1e7, 2e3);
    system
}
