//! Which way gears turn, how fast, which of them drive, and at which phase their meshes are. Theory (82).

use std::f64::consts::TAU;

use geometry::{Driver, GearPair, Sense, Side};

use crate::{GearboxError, Structure};

/// A mesh: two gears, seats on their shafts, and what shape they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Name for messages and tables.
    pub name: String,
    /// Discs of gear 1 and gear 2, whichever drives.
    pub discs: [usize; 2],
    /// Their shapes; gear 1 is the pair's pinion.
    pub pair: GearPair,
}

/// How one mesh runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meshing {
    /// Sense in which gear 1 turns.
    pub sense: Sense,
    /// Which gear drives: the one that is nearer to the input.
    pub driver: Driver,
    /// Direction from gear 1's axis to gear 2's, rad from +x towards +y.
    pub direction: f64,
    /// Angle of gear 1's tooth 0 with the input at 0, rad from +x.
    pub start: f64,
    /// Turns of gear 1 a turn of the input shaft, negative against it.
    pub ratio: f64,
    /// Turn by which gear 2 has to be set against its key so that its flanks touch, rad, at most half a pitch: 0 but where the train
    /// closes a ring (idlers, power splits), whose last gear meets teeth that are already placed.
    pub timing: f64,
}

/// Nominal motion of the whole train from one input: rigid, unloaded flanks in touch at every mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Train {
    meshes: Vec<Meshing>,
    middles: Vec<[f64; 2]>,
    ratios: Vec<f64>,
}

/// Relative difference of distances, ratios and angles that is round-off of their input.
const SAME: f64 = 1e-9;

impl Train {
    /// Follows the meshes from the shaft of disc `input`, which turns in `sense`.
    ///
    /// ```text
    /// omega_2 = -omega_1 z_1/z_2,   theta_2 = theta_w(theta_1 - phi) + phi
    /// ```
    /// phi: direction of the mesh, theta_w: angle of the wheel whose flanks touch ([`GearPair::wheel_angle`]). `keys[i]`
    /// is the angle of tooth 0 of disc i against the mark of its shaft, rad; the mark of the input shaft is at 0, and
    /// those of the others follow from the first mesh that reaches them.
    ///
    /// # Errors
    /// [`GearboxError`]: distances of axes that the pairs were not made for, gears beside each other, rings whose ratios
    /// disagree, shafts that nothing drives.
    pub fn new(
        structure: &Structure,
        meshes: &[Mesh],
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
        let mut directions = Vec::with_capacity(meshes.len());
        for mesh in meshes {
            directions.push(direction(structure, mesh)?);
        }
        let shafts = structure.shafts.len();
        let mut ratios: Vec<Option<f64>> = vec![None; shafts];
        let mut marks = vec![0.0; shafts];
        ratios[structure.discs[input].shaft] = Some(1.0);
        let mut found: Vec<Option<Meshing>> = vec![None; meshes.len()];
        let mut middles = vec![[0.0; 2]; meshes.len()];
        // Every round follows the meshes of one more step from the input, in their order.
        loop {
            let known = ratios.clone();
            let mut grown = false;
            for (i, mesh) in meshes.iter().enumerate().filter(|(i, _)| found[*i].is_none()).collect::<Vec<_>>() {
                let on = mesh.discs.map(|d| structure.discs[d].shaft);
                let Some(from) = [0, 1].into_iter().find(|g| known[on[*g]].is_some()) else { continue };
                let to = 1 - from;
                let own = known[on[from]].unwrap_or_default();
                let teeth = [&mesh.pair.pinion, &mesh.pair.wheel].map(|g| f64::from(g.teeth()));
                let follows = -own * teeth[from] / teeth[to];
                let ratio_1 = if from == 0 { own } else { follows };
                let turning = if (ratio_1 > 0.0) == (sense == Sense::Ccw) { Sense::Ccw } else { Sense::Cw };
                let driver = [Driver::Pinion, Driver::Wheel][from];
                let side = driver.loaded_side(turning);
                let angles = mesh.discs.map(|d| marks[structure.discs[d].shaft] + keys[d]);
                let start =
                    if from == 0 { angles[0] } else { pinion_angle(&mesh.pair, side, angles[1], directions[i]) };
                let meets = [start, wheel_angle(&mesh.pair, side, start, directions[i])][to];
                let mut timing = 0.0;
                match ratios[on[to]] {
                    None => {
                        ratios[on[to]] = Some(follows);
                        marks[on[to]] = meets - keys[mesh.discs[to]];
                    }
                    Some(other) if (other - follows).abs() > SAME * other.abs() => {
                        let shaft = structure.shafts[on[to]].name.clone();
                        return Err(GearboxError::Ratios { shaft, ratios: [other, follows] });
                    }
                    Some(_) => {
                        let pitch = TAU / teeth[to];
                        let apart = meets - angles[to];
                        timing = apart - (apart / pitch).round() * pitch;
                    }
                }
                let pitch = mesh.pair.pinion.pitch_angle();
                middles[i] = [mesh.pair.middle_angle(side), pitch];
                found[i] =
                    Some(Meshing { sense: turning, driver, direction: directions[i], start, ratio: ratio_1, timing });
                grown = true;
            }
            if !grown {
                break;
            }
        }
        let ratio = |(shaft, r): (&crate::Shaft, Option<f64>)| {
            r.ok_or_else(|| GearboxError::NotDriven { shaft: shaft.name.clone() })
        };
        let ratios = structure.shafts.iter().zip(ratios).map(ratio).collect::<Result<Vec<_>, _>>()?;
        // A mesh that no round has reached is between shafts that nothing drives.
        let meshes = found.into_iter().flatten().collect();
        Ok(Self { meshes, middles, ratios })
    }

    /// How each mesh runs.
    pub fn meshing(&self) -> &[Meshing] {
        &self.meshes
    }

    /// Turns of each shaft a turn of the input shaft, negative against it.
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// Mesh cycles of each mesh with the input shaft turned by `angle` (rad about +z) from its start: whole cycles count the
    /// teeth of gear 1 in its sense, from where its tooth 0 is in the middle of the path of contact at 1/2.
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

impl Meshing {
    /// The flanks of gear 1 that carry the load.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.sense)
    }
}

/// Direction of a mesh's line of centres, where its gears stand as the pair was made to.
fn direction(structure: &Structure, mesh: &Mesh) -> Result<f64, GearboxError> {
    structure.has_discs(&mesh.name, mesh.discs)?;
    let centre = |disc: usize| {
        let disc = &structure.discs[disc];
        let [x, y, z] = structure.shafts[disc.shaft].origin;
        [x, y, z + disc.position]
    };
    let [a, b] = mesh.discs.map(centre);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let (distance_mm, wanted_mm) = (dx.hypot(dy), mesh.pair.centre_distance());
    if (distance_mm - wanted_mm).abs() > SAME * wanted_mm {
        return Err(GearboxError::Distance { mesh: mesh.name.clone(), distance_mm, wanted_mm });
    }
    let offset_mm = b[2] - a[2];
    if offset_mm.abs() > SAME * wanted_mm {
        return Err(GearboxError::Beside { mesh: mesh.name.clone(), offset_mm });
    }
    Ok(dy.atan2(dx))
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
