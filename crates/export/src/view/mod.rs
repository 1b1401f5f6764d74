//! Both gears in space for the report: what its script draws and turns through a mesh cycle.
//!
//! | module | what it does |
//! |---|---|
//! | `sector` | one tooth of a gear from its exact geometry, for all teeth that carry nothing |
//! | `piece` | the part of a mesh about the window's teeth |
//! | `record` | what a solved position has to be remembered by |
//! | `fields` | displacement and root stress on the pieces, position by position |
//! | `packed` | numbers as text, two bytes each |

mod fields;
mod packed;
mod piece;
mod record;
mod sector;

use std::f64::consts::PI;

use geometry::{Gear, GearPair};
use ltca::StaticHistory;
use serde::Serialize;

use answer::Numbers;
pub use packed::Packed;
use packed::triangles;
use scene::Scene;
use sector::Surface;

pub use record::ViewRecorder;
use record::bands;
pub use sector::outline;

/// Positions of a mesh cycle at most.
const FRAMES: usize = 16;
/// Digits of places on the flanks and of pressures.
const DIGITS: usize = 5;
/// Digits of angles: a millionth of a turn is less than a pixel.
const ANGLE_DIGITS: usize = 7;

/// Both gears at some positions of a mesh cycle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct View {
    gears: [GearView; 2],
    frames: Vec<Frame>,
    /// What is drawn, in words.
    note: String,
}

/// One gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct GearView {
    name: &'static str,
    teeth: u32,
    /// x and z of its centre, at mid-face, mm.
    centre: [f64; 2],
    /// r_b (mm), half tooth angle at the base circle (rad), twist (rad/mm): the helicoid of [`geometry::Flank`].
    flank: [f64; 3],
    /// Tooth 0, from the middle of one space to that of the next.
    sector: Shape,
    /// Teeth with fields; `None` where all are drawn alike.
    window: Option<WindowView>,
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shape {
    /// Points, mm.
    points: Packed,
    /// Two bytes a corner, low byte first, as base64.
    triangles: String,
}

impl Shape {
    /// Tooth 0 of a gear, nominal, in the frame of its centre, mm.
    pub fn of_tooth(gear: &Gear) -> Self {
        let Surface { points, triangles: corners } = Surface::of_tooth(gear);
        Self { points: Packed::new([points.as_flattened()]), triangles: triangles(&corners) }
    }
}

/// The mesh about the window's teeth, in the frame of the matrices.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct WindowView {
    shape: Shape,
    /// Teeth of the window, as that frame numbers them.
    teeth: Vec<u32>,
    /// Displacement of the points, frame by frame, um.
    displacement: Packed,
    /// First principal stress at the points below the upper end of the fillets, frame by frame, MPa.
    stress: Packed,
    /// Pressure at the points, frame by frame, MPa; nothing where bands show it.
    pressure: Packed,
}

/// One position.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Frame {
    phase: f64,
    /// Both gears' angles about +z, rad.
    angles: Numbers,
    /// Pitches by which the pieces' frames are ahead of the gears' own.
    shift: [u32; 2],
    bands: Vec<Band>,
}

/// The contact band of a tooth pair: slices along its contact line.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Band {
    teeth: [u32; 2],
    /// +1 on left flanks, -1 on right ones.
    side: f64,
    /// Height on both gears, mm.
    z: [Numbers; 2],
    /// Roll angle on both gears, rad.
    roll: [Numbers; 2],
    /// Half-width, mm.
    half_width: Numbers,
    /// MPa.
    pressure: Numbers,
}

impl View {
    /// The gears alone, from exact geometry, through one mesh cycle.
    pub fn of_geometry(scene: &Scene, pair: &GearPair) -> Self {
        let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
        let frames = (0..FRAMES).map(|i| {
            let phase = i as f64 / FRAMES as f64;
            Frame { phase, angles: angles(scene, pair, (phase - 0.5) * pitch), shift: [0; 2], bands: Vec::new() }
        });
        Self {
            gears: [0, 1].map(|i| GearView::new(pair, i, None)),
            frames: frames.collect(),
            note: "The gears from their exact geometry, nominal flanks; this model has no fields on them.".into(),
        }
    }
}

impl View {
    /// The gears alone with the contact bands of solved positions, at most as many as a mesh cycle shows.
    pub fn of_history(scene: &Scene, pair: &GearPair, history: &StaticHistory) -> Self {
        let per_cycle = (scene.analysis.positions_per_cycle as usize).min(history.positions.len());
        let shown = history.positions[..per_cycle].iter().step_by(per_cycle.div_ceil(FRAMES).max(1));
        let frames = shown.map(|p| Frame {
            phase: p.mesh_phase,
            angles: angles(scene, pair, p.pinion_angle),
            shift: [0; 2],
            bands: bands(p),
        });
        Self {
            gears: [0, 1].map(|i| GearView::new(pair, i, None)),
            frames: frames.collect(),
            note: "The gears from their exact geometry, nominal flanks. Contact bands are drawn wide enough to be seen, and \
                   shine through the teeth until the wheel is drawn aside."
                .into(),
        }
    }
}

impl View {
    /// This view as that of a motion: what it is drawn from is not the motion itself.
    pub fn quasi_static(mut self) -> Self {
        self.note =
            format!("The quasi-static mesh cycle under the mean load, which the motion goes about. {}", self.note);
        self
    }
}

impl GearView {
    fn new(pair: &GearPair, i: usize, window: Option<WindowView>) -> Self {
        let gear: &Gear = [&pair.pinion, &pair.wheel][i];
        Self {
            name: ["pinion", "wheel"][i],
            teeth: gear.teeth(),
            centre: [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][i],
            flank: [gear.base_radius(), gear.profile().base_half_angle(), gear.twist()],
            sector: Shape::of_tooth(gear),
            window,
        }
    }
}

/// Angles of both gears when the pinion has turned by `turned` (rad, in the sense of rotation) from the middle position
/// of pair 0.
fn angles(scene: &Scene, pair: &GearPair, turned: f64) -> Numbers {
    let side = scene.side();
    let pinion = pair.middle_angle(side) + scene.operation.rotation.sign() as f64 * turned;
    Numbers(vec![pinion, pair.wheel_angle(side, pinion)], ANGLE_DIGITS)
}
