//! What is left of manufacturing deviations after running-in. ISO 6336-1, clauses 6 (y_p, y_f) and 8 (y_alpha).

use crate::{Material, MaterialGroup};

/// Deviations of a pair's teeth, um: of each the larger one of pinion and wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviations {
    /// f_pb, transverse base pitch deviation.
    pub base_pitch_um: f64,
    /// f_falpha, profile form deviation.
    pub profile_form_um: f64,
    /// Whether both gears are of ISO 1328-1 tolerance class 5 or better: only then profile relief counts in K_V.
    pub is_fine: bool,
}

/// Running-in allowances, um.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunningIn {
    /// y_p = y_alpha, of the base pitch.
    pub base_pitch_um: f64,
    /// y_f, of the profile form.
    pub profile_form_um: f64,
}

impl RunningIn {
    /// Running-in of a pair: the mean of both gears' allowances; `speed` v on the reference circle, m/s.
    ///
    /// ```text
    /// St, V, GGG:      y = 160 f / sigma_Hlim,   at most 12800/sigma_Hlim above 5 m/s, 6400/sigma_Hlim above 10 m/s
    /// GG:              y = 0.275 f,              at most 22 um above 5 m/s, 11 um above 10 m/s
    /// Eh, IF, NT, NV:  y = 0.075 f,              at most 3 um
    /// ```
    /// Source: ISO 6336-1, clause 8, running-in allowance y_alpha, method B.
    pub fn new(deviations: Deviations, materials: [&Material; 2], speed: f64) -> Self {
        let mean = |f: f64| 0.5 * materials.iter().map(|m| allowance(m, speed, f)).sum::<f64>();
        Self { base_pitch_um: mean(deviations.base_pitch_um), profile_form_um: mean(deviations.profile_form_um) }
    }
}

fn allowance(material: &Material, speed: f64, deviation: f64) -> f64 {
    let limited = |share: f64, medium: f64, fast: f64| {
        let most = if speed > 10.0 {
            fast
        } else if speed > 5.0 {
            medium
        } else {
            f64::INFINITY
        };
        (share * deviation).min(most)
    };
    let limit = material.contact_limit_mpa;
    match material.group {
        MaterialGroup::Structural | MaterialGroup::ThroughHardened | MaterialGroup::NodularIron => {
            limited(160.0 / limit, 12_800.0 / limit, 6_400.0 / limit)
        }
        MaterialGroup::CastIron => limited(0.275, 22.0, 11.0),
        _ => (0.075 * deviation).min(3.0),
    }
}
