//! Measured gears that are made.

use geometry::{Gear, GearData, Side};
use metrology::{GearHeader, MeasuredGear, Pitch, Trace, TraceKind};

pub fn gear() -> Gear {
    Gear::new(GearData::default()).unwrap()
}

pub fn header(gear: &Gear) -> GearHeader {
    let data = gear.data();
    let (form, tip) = (2.0 * gear.form_radius(), 2.0 * gear.tip_radius());
    let half = 0.5 * data.face_width;
    GearHeader {
        teeth: data.teeth,
        normal_module: data.normal_module,
        helix_angle: data.helix_angle,
        pressure_angle: data.normal_pressure_angle,
        profile_shift: Some(data.profile_shift),
        face_width: Some(data.face_width),
        profile_evaluation: Some([form + 0.8, tip - 0.6]),
        profile_measured: Some([form + 0.1, tip - 0.1]),
        helix_evaluation: Some([-0.8 * half, 0.8 * half]),
        helix_measured: Some([-0.95 * half, 0.95 * half]),
    }
}

/// A trace whose values (um) follow from its places: roll lengths of a profile, heights of a helix.
pub fn trace(header: &GearHeader, kind: TraceKind, (tooth, side): (u32, Side), of: impl Fn(f64) -> f64) -> Trace {
    let empty = Trace { kind, tooth, side, deviations_um: vec![None; 480] };
    let places = empty.places(header).unwrap();
    Trace { deviations_um: places.into_iter().map(|x| Some(of(x))).collect(), ..empty }
}

/// Profiles at mid-face of all teeth on the left side, and pitch of both sides.
pub fn measured(of: impl Fn(u32, f64) -> f64) -> MeasuredGear {
    let header = header(&gear());
    let of_tooth = |tooth| trace(&header, TraceKind::Profile(0.0), (tooth, Side::Left), |x| of(tooth, x));
    let pitch = |side: Side, first: f64| Pitch {
        side,
        index_um: (0..header.teeth).map(|k| first + (f64::from(k) * 0.7).sin() * 3.25).collect(),
    };
    MeasuredGear {
        traces: (0..header.teeth).map(of_tooth).collect(),
        pitch: vec![pitch(Side::Left, 0.0), pitch(Side::Right, 0.5)],
        header,
    }
}
