//! What the user says of shafts, gears on them and meshes between them.

use dynamics::RigidBody;
use fem::{
    Material,
    beam::{BeamPiece, BeamSection, coincidence},
};
use serde::{Deserialize, Serialize};

use super::MeshGeometry;
use crate::{
    Fourier, LumpedError, MeshCycle,
    error::{finite, not_negative, positive},
};

/// A length of shaft with one section, from the shaft's beginning at z = 0 on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// Length, mm.
    pub length: f64,
    /// Outer diameter, mm.
    pub outer_diameter: f64,
    /// Inner diameter, mm; 0: solid.
    pub inner_diameter: f64,
    /// Young's modulus, MPa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, t/mm^3; 0 is allowed, for a shaft whose mass is given at its stations.
    pub density: f64,
}

/// A place where mass is put: a gear, a coupling, the end of a shaft.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// Position on the shaft, mm from its beginning.
    pub position: f64,
    /// Mass of what sits there, t; the shaft's own is added by the model.
    pub mass: f64,
    /// Moment of inertia of the mass about the shaft's axis, t mm^2.
    pub polar_inertia: f64,
    /// Moment of inertia of the mass about an axis across, t mm^2.
    pub transverse_inertia: f64,
    /// Which of displacements x, y, z and turns about x, y, z remain coordinates of the model; the others follow
    /// statically.
    pub kept: [bool; 6],
}

/// A bearing, or a coupling to what does not vibrate.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// Position on the shaft, mm from its beginning.
    pub position: f64,
    /// Stiffness along x, y, z (N/mm) and about x, y, z (N mm); about z it holds against the nominal turn.
    pub stiffness: [f64; 6],
    /// Damping of the same: N s/mm and N mm s.
    pub damping: [f64; 6],
}

/// A shaft parallel to z.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Shaft {
    /// Segments of the shaft, one after the other.
    pub segments: Vec<Segment>,
    /// Stations, at which masses are put.
    pub stations: Vec<Station>,
    /// Supports of the shaft.
    pub supports: Vec<Support>,
}

/// A station of a shaft, by numbers from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShaftStation {
    /// Shaft.
    pub shaft: usize,
    /// Station on it.
    pub station: usize,
}

/// A gear whose teeth run out of true with its shaft.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct RunOut {
    /// Eccentricity of the base circle, mm.
    pub eccentricity: f64,
    /// Angle of the eccentricity at t = 0 before the line of action, rad.
    pub phase: f64,
}

/// A mesh of two gears.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Stations that bear gear 1 and gear 2.
    pub gears: [ShaftStation; 2],
    /// Teeth and where the gears stand to each other.
    pub geometry: MeshGeometry,
    /// Stiffness along the normal of the flanks, N/mm, over the phase of the mesh, 2 pi a tooth.
    pub stiffness: Fourier,
    /// Damping ratio xi of the two gears turning against each other: c = 2 xi sqrt(k_s / (1/m_1 + 1/m_2)); 0.03 to 0.1.
    pub damping_ratio: f64,
    /// Half of the backlash, b_n, mm along the normal.
    pub half_backlash: f64,
    /// Excess of material along the normal, mm, over the phase of the mesh: presses the flanks together where positive.
    pub error: Fourier,
    /// Run-out of gear 1 and gear 2.
    pub run_out: [RunOut; 2],
}

/// A torque on a station.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftTorque {
    /// Station that the torque acts on.
    pub place: ShaftStation,
    /// Torque about +z, N mm.
    pub torque: f64,
}

/// Shafts, the meshes between them, and what they run with.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ShaftSystem {
    /// Shafts.
    pub shafts: Vec<Shaft>,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Torques.
    pub torques: Vec<ShaftTorque>,
    /// Speed of shaft 0 about +z, rad/s; the others follow from the teeth.
    pub speed: f64,
    /// Damping of the shafts in proportion to mass, 1/s.
    pub mass_damping: f64,
    /// Damping of the shafts and their supports in proportion to stiffness, s.
    pub stiffness_damping: f64,
    /// Acceleration of gravity along x, y, z, mm/s^2.
    pub gravity: [f64; 3],
}

/// Density that stands for none, t/mm^3: elastic formulas need not know.
const NO_DENSITY: f64 = 1e-30;

impl Segment {
    /// The section of the segment.
    ///
    /// # Errors
    /// [`LumpedError::Beam`] when diameters or material have no meaning.
    pub fn section(&self) -> Result<BeamSection, LumpedError> {
        let density = if self.density == 0.0 { NO_DENSITY } else { self.density };
        let material = Material::new(self.young, self.poisson, density)?;
        Ok(BeamSection::new(self.outer_diameter, self.inner_diameter, material)?)
    }
}

impl Station {
    /// Station with mass and inertia of a gear as another model has them.
    #[must_use]
    pub fn bearing(self, body: &RigidBody) -> Self {
        Self { mass: body.mass, polar_inertia: body.polar_inertia, transverse_inertia: body.transverse_inertia, ..self }
    }
}

impl Shaft {
    /// Segments as pieces of a beam.
    ///
    /// # Errors
    /// [`LumpedError`] when one has no meaning.
    pub fn pieces(&self) -> Result<Vec<BeamPiece>, LumpedError> {
        let piece = |s: &Segment| {
            positive("length of a shaft's segment, mm", s.length)?;
            Ok(BeamPiece { length: s.length, section: s.section()? })
        };
        self.segments.iter().map(piece).collect()
    }

    /// Length of the shaft, mm.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }

    /// Distance up to which two places on it are one, mm ([`coincidence`]).
    pub fn coincidence(&self) -> f64 {
        let thinnest = self.segments.iter().map(|s| s.outer_diameter).fold(f64::INFINITY, f64::min);
        coincidence(self.length(), thinnest)
    }

    /// How the shaft can move as a whole, apart from its turn, against all that holds it; `None` where nothing is left.
    /// Supports are springs along and about the axes, so that the answer follows from where they are:
    ///
    /// ```text
    /// x: some k_x;   tilt about y: some k_ry, or k_x at two places;   y and the tilt about x alike;   z: some k_z
    /// ```
    /// `thrust`: whether anything pushes along z; a shaft that nothing pushes needs nothing to hold it there.
    pub fn loose_motion(&self, thrust: bool) -> Option<&'static str> {
        let near = self.coincidence();
        let holding = |axis: usize| self.supports.iter().filter(move |s| s.stiffness[axis] > 0.0);
        let tilts = |shift: usize, turn: usize| {
            let places = || holding(shift).map(|s| s.position);
            let span = places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min);
            holding(turn).next().is_none() && span <= near
        };
        let free = |axis: usize| holding(axis).next().is_none();
        [
            (free(0), "along x"),
            (free(1), "along y"),
            (thrust && free(2), "along z"),
            (tilts(1, 3), "tilting about x"),
            (tilts(0, 4), "tilting about y"),
        ]
        .into_iter()
        .find_map(|(is_free, motion)| is_free.then_some(motion))
    }

    pub(super) fn check(&self) -> Result<(), LumpedError> {
        let length = self.length();
        positive("length of a shaft, mm", length)?;
        let on_shaft = |position: f64| {
            let near = 1e-9 * length;
            if (-near..=length + near).contains(&position) {
                Ok(())
            } else {
                Err(LumpedError::OffShaft { position_mm: position, length_mm: length })
            }
        };
        for s in &self.stations {
            on_shaft(s.position)?;
            not_negative("mass of a station, t", s.mass)?;
            not_negative("polar inertia of a station, t mm^2", s.polar_inertia)?;
            not_negative("transverse inertia of a station, t mm^2", s.transverse_inertia)?;
        }
        for s in &self.supports {
            on_shaft(s.position)?;
            for i in 0..6 {
                not_negative("stiffness of a support", s.stiffness[i])?;
                not_negative("damping of a support", s.damping[i])?;
            }
        }
        Ok(())
    }
}

impl Mesh {
    /// Excitation of another model of the same pair instead of the given one.
    ///
    /// ```text
    /// k_n = k / cos^2 b_b,   excess = -e cos b_b
    /// ```
    /// The cycle is stated on the transverse line of action, where e > 0 lets the driven gear lag; here along the
    /// normal, where an excess presses.
    ///
    /// # Errors
    /// Those of [`MeshGeometry::line`].
    pub fn fed(self, cycle: &MeshCycle) -> Result<Self, LumpedError> {
        let cos = self.geometry.line()?.cos_base_helix;
        Ok(Self { stiffness: cycle.stiffness.scaled(1.0 / (cos * cos)), error: cycle.error.scaled(-cos), ..self })
    }

    fn check(&self) -> Result<(), LumpedError> {
        self.stiffness.check_positive("mesh stiffness, N/mm")?;
        self.error.check("mesh error, mm")?;
        not_negative("mesh damping ratio", self.damping_ratio)?;
        not_negative("half of the backlash, mm", self.half_backlash)?;
        for r in self.run_out {
            not_negative("run-out, mm", r.eccentricity)?;
            finite("phase of the run-out, rad", r.phase)?;
        }
        Ok(())
    }
}

impl ShaftSystem {
    /// The station at a place, if there is one.
    pub fn station(&self, place: ShaftStation) -> Result<&Station, LumpedError> {
        let shaft = self.shafts.get(place.shaft);
        shaft
            .and_then(|s| s.stations.get(place.station))
            .ok_or(LumpedError::NoStation { shaft: place.shaft, station: place.station })
    }

    pub(super) fn check(&self) -> Result<(), LumpedError> {
        if self.shafts.is_empty() {
            return Err(LumpedError::Empty { quantity: "shafts" });
        }
        self.shafts.iter().try_for_each(Shaft::check)?;
        for mesh in &self.meshes {
            mesh.check()?;
            mesh.gears.iter().try_for_each(|&g| self.station(g).map(|_| ()))?;
        }
        for t in &self.torques {
            self.station(t.place)?;
            finite("torque on a shaft, N mm", t.torque)?;
        }
        finite("speed, rad/s", self.speed)?;
        not_negative("damping in proportion to mass, 1/s", self.mass_damping)?;
        not_negative("damping in proportion to stiffness, s", self.stiffness_damping)?;
        self.gravity.iter().try_for_each(|&g| finite("gravity, mm/s^2", g))
    }

    /// Whether supports hold every shaft against every motion as a whole but its turn; along z only where a helical mesh or
    /// gravity pushes it. Meshes hold nothing: they open.
    ///
    /// # Errors
    /// [`LumpedError::Loose`].
    pub fn check_held(&self) -> Result<(), LumpedError> {
        for (shaft, own) in self.shafts.iter().enumerate() {
            let meshes = self.meshes.iter().filter(|m| m.gears.iter().any(|g| g.shaft == shaft));
            let thrust = self.gravity[2] != 0.0 || meshes.into_iter().any(|m| m.geometry.helix_angle != 0.0);
            if let Some(motion) = own.loose_motion(thrust) {
                return Err(LumpedError::Loose { shaft, motion });
            }
        }
        Ok(())
    }

    /// Speed of each shaft about +z, rad/s: by the teeth of the meshes, from shaft 0 on.
    ///
    /// # Errors
    /// [`LumpedError::NotConnected`] when a shaft is in no chain of meshes with shaft 0, [`LumpedError::Ratios`] when
    /// two chains disagree.
    pub fn speeds(&self) -> Result<Vec<f64>, LumpedError> {
        let mut ratios: Vec<Option<f64>> = vec![None; self.shafts.len()];
        if let Some(first) = ratios.first_mut() {
            *first = Some(1.0);
        }
        for _ in 0..self.shafts.len() {
            for mesh in &self.meshes {
                let [a, b] = mesh.gears.map(|g| g.shaft);
                let [z1, z2] = mesh.geometry.teeth.map(f64::from);
                for (from, to, ratio) in [(a, b, z1 / z2), (b, a, z2 / z1)] {
                    let (Some(&Some(known)), Some(slot)) = (ratios.get(from), ratios.get(to)) else { continue };
                    let follows = -known * ratio;
                    match *slot {
                        None => ratios[to] = Some(follows),
                        Some(r) if (r - follows).abs() > 1e-9 * r.abs() => {
                            return Err(LumpedError::Ratios { shaft: to, ratios: [r, follows] });
                        }
                        Some(_) => {}
                    }
                }
            }
        }
        let speed =
            |(shaft, r): (usize, Option<f64>)| r.map(|r| r * self.speed).ok_or(LumpedError::NotConnected { shaft });
        ratios.into_iter().enumerate().map(speed).collect()
    }
}
