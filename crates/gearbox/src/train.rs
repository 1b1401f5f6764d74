//! Kinematics of the train: sense, speed and driver of all gears, and the phases of their meshes. Theory (82).

use std::f64::consts::TAU;

use geometry::{Driver, Gear, GearPair, Sense, Side};

use crate::{GearboxError, SeatError, Structure};

/// A mesh: two gears, their seats on the shafts, and their geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct GearMesh {
    /// Name for messages and tables.
    pub name: String,
    /// Discs of gear 1 and gear 2, whichever drives.
    pub discs: [usize; 2],
    /// Geometry of both gears; gear 1 is the pair's pinion.
    pub pair: GearPair,
}

/// An error of a mesh, with its name; that of a pair is the only one.
pub(crate) fn at_mesh(mesh: &GearMesh, source: GearboxError) -> GearboxError {
    if mesh.name.is_empty() {
        return source;
    }
    GearboxError::AtMesh { mesh: mesh.name.clone(), source: Box::new(source) }
}

/// Running of one mesh: driver, sense, flanks, direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meshing {
    /// Sense of rotation of gear 1.
    pub sense: Sense,
    /// Driving gear: the one nearer to the input.
    pub driver: Driver,
    /// Direction from gear 1's axis to the contact, rad from +x towards +y: towards gear 2's axis; for a ring, away
    /// from it.
    pub direction: f64,
    /// Angle of tooth 0 of gear 1 with the input at 0, rad from +x.
    pub start: f64,
    /// Rotations of gear 1 per rotation of the input shaft; negative if opposite.
    pub ratio: f64,
    /// Rotation by which gear 2 must be set relative to its key so that its flanks touch, rad, at most half a pitch. It
    /// is 0 unless the train has a closed loop (idlers, power splits), whose last gear meets teeth that are already
    /// placed.
    pub timing: f64,
}

/// Nominal motion of the whole train from one input: rigid, with unloaded flanks in contact at every mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Train {
    meshes: Vec<Meshing>,
    middles: Vec<[f64; 2]>,
    ratios: Vec<f64>,
    in_space: Vec<f64>,
    counted: Vec<[f64; 2]>,
    frame: f64,
}

/// Relative difference of distances, ratios and angles that is round-off of their input.
const SAME: f64 = 1e-9;

impl Train {
    /// Follows the meshes from the shaft of disc `input`, which rotates in `sense`.
    ///
    /// ```text
    /// omega_2 = -omega_1 z_1/z_2 (z_2 < 0 of a ring),   theta_2 = theta_w(theta_1 - phi) + phi
    /// ```
    /// phi is the direction of the mesh, theta_w the angle of the wheel at which flanks touch
    /// ([`GearPair::wheel_angle`]). `keys[i]` is the angle of tooth 0 of disc i relative to the mark of its shaft, rad.
    /// The mark of the input shaft is at 0; those of the other shafts follow from the first mesh that reaches them.
    ///
    /// If a shaft is fixed in space ([`Structure::fixed`]), the frame of the carrier rotates. Ratios are rotations in
    /// that frame per rotation of the input in space (Willis):
    ///
    /// ```text
    /// n_i - n_c = r_i/(r_in - r_f) n_in,   n_c = -r_f/(r_in - r_f) n_in      r: by the teeth, carrier at rest (r_c = 0)
    /// ```
    /// Meshes are followed from the input. They are followed from the fixed shaft instead if the input is on a part
    /// that does not rotate in that frame, or takes power from the meshes in it.
    ///
    /// # Errors
    /// [`GearboxError`]: axis distances and mid-face offsets that do not match the pairs, closed loops with
    /// contradicting ratios, shafts that nothing drives.
    pub fn new(
        structure: &Structure,
        meshes: &[GearMesh],
        keys: &[f64],
        input: usize,
        sense: Sense,
    ) -> Result<Self, GearboxError> {
        structure.check()?;
        structure.has_discs("the input", [input; 2])?;
        if keys.len() != structure.discs.len() {
            return Err(GearboxError::Count { what: "keys", found: keys.len(), wanted: structure.discs.len() });
        }
        if let Some((disc, &value)) = structure.discs.iter().zip(keys).find(|(_, k)| !k.is_finite()) {
            return Err(GearboxError::OutOfRange { part: disc.name.clone(), quantity: "key, rad", value });
        }
        structure.turns_in_space("the input", input)?;
        let on = structure.discs[input].shaft;
        let ratios_from = |shaft: usize, ratio: f64| {
            let mut walk = Walk::new(structure, meshes, (keys, sense))?;
            walk.ratios[shaft] = Some(ratio);
            while walk.goes_on()? {}
            let ratio = |(i, (shaft, r)): (usize, (&crate::Shaft, &Option<f64>))| {
                let at_rest = structure.stands(i).then_some(0.0);
                r.or(at_rest).ok_or_else(|| GearboxError::NotDriven { shaft: shaft.name.clone() })
            };
            let all = structure.shafts.iter().zip(&walk.ratios).enumerate().map(ratio);
            Ok::<_, GearboxError>((all.collect::<Result<Vec<_>, _>>()?, walk))
        };
        let (ratios, walk, carrier) = match structure.fixed {
            None => {
                let (ratios, walk) = ratios_from(on, 1.0)?;
                (ratios, walk, 0.0)
            }
            Some(fixed) => {
                let (by_teeth, _) = ratios_from(fixed, 1.0)?;
                let against = by_teeth[on] - 1.0;
                if against.abs() < SAME {
                    let [input, fixed] = [on, fixed].map(|shaft| structure.shafts[shaft].name.clone());
                    return Err(SeatError::Locked { input, fixed }.into());
                }
                // The input has power for the meshes where it turns in one sense in both frames.
                let from = if by_teeth[on] / against > 0.0 { on } else { fixed };
                let (ratios, walk) = ratios_from(from, by_teeth[from] / against)?;
                (ratios, walk, -1.0 / against)
            }
        };
        let in_space =
            ratios.iter().enumerate().map(|(i, r)| if structure.fixed == Some(i) { 0.0 } else { r + carrier });
        let in_space = in_space.collect();
        let marks = walk.marks.clone();
        // Where every shaft is driven, every mesh has been reached.
        let meshing: Vec<Meshing> = walk.found.into_iter().flatten().collect();
        let middle =
            |(mesh, own): (&GearMesh, &Meshing)| [mesh.pair.middle_angle(own.side()), mesh.pair.pinion.pitch_angle()];
        let middles = meshes.iter().zip(&meshing).map(middle).collect();
        let counted = |(mesh, own): (&GearMesh, &Meshing)| {
            let angles = own.gear_angles(&mesh.pair);
            let gears = [&mesh.pair.pinion, &mesh.pair.wheel];
            std::array::from_fn(|g| {
                let (disc, pitch) = (mesh.discs[g], TAU / f64::from(gears[g].teeth()));
                let off = angles[g] - (marks[structure.discs[disc].shaft] + keys[disc]);
                (off / pitch).round() * pitch
            })
        };
        let counted = meshes.iter().zip(&meshing).map(counted).collect();
        Ok(Self { meshes: meshing, middles, ratios, in_space, counted, frame: carrier })
    }

    /// Running of each mesh, in their order.
    pub fn meshing(&self) -> &[Meshing] {
        &self.meshes
    }

    /// Angle from tooth 0 of gear 1 and of gear 2 to the tooth from which a mesh counts theirs, rad, whole pitches: in the
    /// meshes that close a loop teeth are counted from another one on.
    pub fn counted_from(&self, mesh: usize) -> [f64; 2] {
        self.counted[mesh]
    }

    /// Rotations of each shaft in the frame of the carrier per rotation of the input shaft, negative if opposite; 0 for
    /// stationary shafts.
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// Rotations of each shaft in space per rotation of the input shaft, negative if opposite: [`Train::ratios`] plus
    /// the rotation of the carrier.
    pub fn ratios_in_space(&self) -> &[f64] {
        &self.in_space
    }

    /// Rotations of the frame of the carrier in space per rotation of the input shaft; 0 if no shaft is fixed in space.
    pub fn frame_ratio(&self) -> f64 {
        self.frame
    }

    /// Mesh cycles of each mesh with the input shaft rotated by `angle` (rad about +z) from its start. Whole cycles
    /// count the teeth of gear 1 in its sense of rotation; at 1/2 its tooth 0 is in the middle of the path of contact.
    ///
    /// ```text
    /// c = sign (theta_1 - phi - theta_m) z_1/(2 pi) + 1/2,   theta_1 = start + ratio angle
    /// ```
    pub fn cycles(&self, angle: f64) -> Vec<f64> {
        let of = |(mesh, [middle, pitch]): (&Meshing, &[f64; 2])| {
            let turned = mesh.start + mesh.ratio * angle - mesh.direction - middle;
            mesh.sense.sign() as f64 * turned / pitch + 0.5
        };
        self.meshes.iter().zip(&self.middles).map(of).collect()
    }
}

/// The way through the train so far.
struct Walk<'a> {
    structure: &'a Structure,
    meshes: &'a [GearMesh],
    keys: &'a [f64],
    sense: Sense,
    directions: Vec<f64>,
    /// Rotations of each shaft that has been reached per rotation of the input.
    ratios: Vec<Option<f64>>,
    /// Angle of the mark of each shaft that has been reached with the input at 0, rad.
    marks: Vec<f64>,
    found: Vec<Option<Meshing>>,
}

impl<'a> Walk<'a> {
    fn new(
        structure: &'a Structure,
        meshes: &'a [GearMesh],
        (keys, sense): (&'a [f64], Sense),
    ) -> Result<Self, GearboxError> {
        let directions = meshes.iter().map(|mesh| direction(structure, mesh)).collect::<Result<_, _>>()?;
        let shafts = structure.shafts.len();
        let (ratios, marks, found) = (vec![None; shafts], vec![0.0; shafts], vec![None; meshes.len()]);
        Ok(Self { structure, meshes, keys, sense, directions, ratios, marks, found })
    }

    /// Follows the meshes of the shafts that are reached, in their order; whether there was one.
    fn goes_on(&mut self) -> Result<bool, GearboxError> {
        let known = self.ratios.clone();
        let mut grown = false;
        for (i, mesh) in self.meshes.iter().enumerate() {
            let on = mesh.discs.map(|d| self.structure.discs[d].shaft);
            let from = [0, 1].into_iter().find_map(|g| Some((g, known[on[g]]?)));
            if let (None, Some((from, ratio))) = (&self.found[i], from) {
                self.found[i] = Some(self.follow(i, from, ratio)?);
                grown = true;
            }
        }
        Ok(grown)
    }

    /// Follows mesh i from its gear `from`, whose shaft turns `ratio` times a turn of the input.
    fn follow(&mut self, i: usize, from: usize, ratio: f64) -> Result<Meshing, GearboxError> {
        let (mesh, direction, to) = (&self.meshes[i], self.directions[i], 1 - from);
        let teeth = [&mesh.pair.pinion, &mesh.pair.wheel].map(Gear::signed_teeth);
        let follows = -ratio * teeth[from] / teeth[to];
        let ratio_1 = [ratio, follows][from];
        let sense = if ratio_1 > 0.0 { self.sense } else { self.sense.opposite() };
        let driver = [Driver::Pinion, Driver::Wheel][from];
        let side = driver.loaded_side(sense);
        let angles = mesh.discs.map(|d| self.marks[self.structure.discs[d].shaft] + self.keys[d]);
        let start = if from == 0 { angles[0] } else { pinion_angle(&mesh.pair, side, angles[1], direction) };
        let meets = [start, wheel_angle(&mesh.pair, side, start, direction)][to];
        let apart = self.reach(mesh.discs[to], follows, meets, TAU / teeth[to])?;
        // Gear 2 may make up for gear 1.
        let timing = if to == 0 { apart * teeth[0] / teeth[1] } else { apart };
        Ok(Meshing { sense, driver, direction, start, ratio: ratio_1, timing })
    }

    /// Reaches the shaft of a gear that turns `ratio` times a turn of the input and has to stand at `angle` (rad), or at
    /// a whole number of pitches from there: by how much it has to be set against its key, rad.
    fn reach(&mut self, disc: usize, ratio: f64, angle: f64, pitch: f64) -> Result<f64, GearboxError> {
        let shaft = self.structure.discs[disc].shaft;
        match self.ratios[shaft] {
            None => {
                self.ratios[shaft] = Some(ratio);
                self.marks[shaft] = angle - self.keys[disc];
                Ok(0.0)
            }
            Some(other) if (other - ratio).abs() > SAME * other.abs() => {
                let shaft = self.structure.shafts[shaft].name.clone();
                Err(GearboxError::Ratios { shaft, ratios: [other, ratio] })
            }
            Some(_) => {
                let apart = angle - (self.marks[shaft] + self.keys[disc]);
                Ok(apart - (apart / pitch).round() * pitch)
            }
        }
    }
}

impl Meshing {
    /// The flanks of gear 1 that carry the load.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.sense)
    }

    /// Angles of tooth 0 of gear 1 and of gear 2 with touching flanks and the input at 0, rad from +x.
    pub fn gear_angles(&self, pair: &GearPair) -> [f64; 2] {
        [self.start, wheel_angle(pair, self.side(), self.start, self.direction)]
    }
}

/// Direction from gear 1's axis to the contact, where the gears of a mesh stand as the pair was made to.
fn direction(structure: &Structure, mesh: &GearMesh) -> Result<f64, GearboxError> {
    structure.has_discs(&mesh.name, mesh.discs)?;
    mesh.discs.iter().try_for_each(|disc| structure.turns(&structure.discs[*disc].name, *disc))?;
    let centre = |disc: usize| {
        let disc = &structure.discs[disc];
        let [x, y, z] = structure.shafts[disc.shaft].origin;
        [x, y, z + disc.position]
    };
    let [a, b] = mesh.discs.map(centre);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    // The axis of a ring is on the other side of the contact.
    let sign = mesh.pair.centre_distance().signum();
    let (distance_mm, wanted_mm) = (dx.hypot(dy), mesh.pair.centre_distance().abs());
    if (distance_mm - wanted_mm).abs() > SAME * wanted_mm {
        return Err(GearboxError::Distance { mesh: mesh.name.clone(), distance_mm, wanted_mm });
    }
    let offset_mm = b[2] - a[2];
    let pair_mm = mesh.pair.mid_face_offset();
    if (offset_mm - pair_mm).abs() > SAME * wanted_mm {
        return Err(GearboxError::Beside { mesh: mesh.name.clone(), offset_mm, pair_mm });
    }
    Ok((sign * dy).atan2(sign * dx))
}

/// Angle of gear 2's tooth 0 where it touches that of gear 1 at `start`, both from +x, rad.
fn wheel_angle(pair: &GearPair, side: Side, start: f64, direction: f64) -> f64 {
    pair.wheel_angle(side, start - direction) + direction
}

/// The other way round.
fn pinion_angle(pair: &GearPair, side: Side, wheel: f64, direction: f64) -> f64 {
    let ratio = pair.wheel.base_radius() / pair.pinion.base_radius();
    (pair.wheel_angle(side, 0.0) - (wheel - direction)) * ratio + direction
}
