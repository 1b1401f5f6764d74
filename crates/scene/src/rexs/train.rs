//! Shafts, stages and loads of a REXS file: speeds, and the torque of a stage. No losses.

use std::collections::BTreeMap;

use super::{
    RexsError,
    document::{Model, Part, reference},
    planetary::Planetary,
};

/// Shafts, stages and loads at the most.
const MOST: usize = 1000;

/// Shafts with gears, the stages between them and their loads. Of a planetary stage the first planet alone is there, and what
/// stands in the frame of the carrier comes behind the shafts with gears.
pub(super) struct Train<'m, 'a> {
    pub planetary: Option<Planetary<'m, 'a>>,
    pub shafts: Vec<Part<'m, 'a>>,
    /// Shaft of each gear.
    pub gears: BTreeMap<&'a str, usize>,
    pub stages: Vec<Link<'a>>,
    pub loads: Vec<Load<'m, 'a>>,
    /// Speed of each shaft about the u axis of the first one, 1/min.
    pub speeds: Vec<Option<f64>>,
    /// +1 or -1: whether the u axis of each shaft points as that of the first one.
    pub signs: Vec<f64>,
}

/// A cylindrical stage between two shafts.
pub(super) struct Link<'a> {
    /// Number of the stage's component, where it has one.
    pub stage: Option<&'a str>,
    /// Its place among the cylindrical stages of the file.
    pub number: usize,
    pub gears: [&'a str; 2],
    pub shafts: [usize; 2],
    /// omega_2 / omega_1.
    ratio: f64,
}

/// A load that passes on torque.
pub(super) struct Load<'m, 'a> {
    pub part: Part<'m, 'a>,
    pub shaft: usize,
    /// About the u axis of the first shaft, N m; `None`: it follows from the others.
    pub torque: Option<f64>,
}

/// What a stage carries.
pub(super) struct StageLoad {
    /// Which of its gears drives, 0 or 1.
    pub driver: usize,
    /// On the driven gear, N m.
    pub torque: f64,
    /// Speed of the gear that drives, 1/min, with its sign about the u axis of the first shaft.
    pub driver_speed: f64,
}

impl<'m, 'a> Train<'m, 'a> {
    pub(super) fn of(model: &'m Model<'a>) -> Result<Self, RexsError> {
        let planetary = Planetary::of(model)?;
        let is_copy = |id: &str| planetary.as_ref().is_some_and(|own| own.is_copy(id));
        let mut shafts: Vec<Part<'m, 'a>> = Vec::new();
        let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
        let mut gears = BTreeMap::new();
        for relation in model.assemblies().filter(|r| model.refers(*r, "assembly", "shaft")) {
            let is_gear = ["cylindrical_gear", "ring_gear"].iter().any(|kind| model.refers(relation, "part", kind));
            let (Some(id), Some(gear)) = (reference(relation, "assembly"), reference(relation, "part")) else {
                continue;
            };
            if let Some(shaft) = model.part("shaft", id).filter(|_| is_gear && !is_copy(id)) {
                let number = *numbers.entry(shaft.id).or_insert_with(|| {
                    shafts.push(shaft);
                    shafts.len() - 1
                });
                if let Some(part) = model.part("gear", gear) {
                    gears.entry(part.id).or_insert(number);
                }
            }
        }
        for own in planetary.iter().flat_map(|own| &own.standing) {
            numbers.entry(own.id).or_insert_with(|| {
                shafts.push(*own);
                shafts.len() - 1
            });
        }
        let signs = signs(&shafts)?;
        let stages = model.relations("stage").filter(|r| model.refers(*r, "stage", "cylindrical_stage"));
        let stages: Vec<Link<'a>> = stages.enumerate().filter_map(|(i, r)| link(model, (i, r), &gears)).collect();
        let loads = loads(model, &numbers, &signs)?;
        let most = [shafts.len(), stages.len(), loads.len()].into_iter().max().unwrap_or(0);
        if most > MOST {
            let (part, what) = ("the file".into(), format!("has {most} shafts, stages or loads"));
            return Err(RexsError::Unfit { part, what, hint: format!("export {MOST} of a kind at the most") });
        }
        let mut train = Self { planetary, speeds: vec![None; shafts.len()], shafts, gears, stages, loads, signs };
        train.find_speeds()?;
        Ok(train)
    }

    /// Speeds of all shafts from that of the one that defines it.
    fn find_speeds(&mut self) -> Result<(), RexsError> {
        let mut stated = Vec::new();
        for (i, shaft) in self.shafts.iter().enumerate() {
            if let Some(speed) = shaft.number("rotational_speed", "1 / min")?.filter(|n| *n != 0.0) {
                stated.push((shaft.text("defines_speed") != Some("true"), i, self.signs[i] * speed));
            }
        }
        let Some(&(_, first, speed)) = stated.iter().min_by_key(|s| (s.0, s.1)) else { return Ok(()) };
        if self.planetary.is_some() {
            self.find_speeds_in_space(first, speed);
            return Ok(());
        }
        self.speeds[first] = Some(speed);
        for i in self.beyond(first, None) {
            for link in &self.stages {
                let [a, b] = link.shafts;
                match (self.speeds[a], self.speeds[b]) {
                    (Some(own), None) if a == i => self.speeds[b] = Some(own * link.ratio),
                    (None, Some(own)) if b == i => self.speeds[a] = Some(own / link.ratio),
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Speeds in space by that of one shaft, of shafts that turn against a carrier by their teeth.
    ///
    /// ```text
    /// n_i = k (r_i - r_f)      r: by the teeth with the carrier at rest, r_c = 0; f: the fixed member
    /// ```
    fn find_speeds_in_space(&mut self, stated: usize, speed: f64) {
        let Some(planetary) = &self.planetary else { return };
        let mut by_teeth: Vec<Option<f64>> =
            self.shafts.iter().map(|s| planetary.stands(s.id).then_some(0.0)).collect();
        let Some(link) = self.stages.first() else { return };
        let first = link.shafts[0];
        by_teeth[first] = Some(1.0);
        for i in self.beyond(first, None) {
            for link in &self.stages {
                let [a, b] = link.shafts;
                match (by_teeth[a], by_teeth[b]) {
                    (Some(own), None) if a == i => by_teeth[b] = Some(own * link.ratio),
                    (None, Some(own)) if b == i => by_teeth[a] = Some(own / link.ratio),
                    _ => {}
                }
            }
        }
        let fixed = planetary.fixed.and_then(|id| self.shafts.iter().position(|s| s.id == id));
        let of_fixed = fixed.map_or(Some(0.0), |f| by_teeth[f]);
        let (Some(of_fixed), Some(own)) = (of_fixed, by_teeth[stated]) else { return };
        let times = speed / (own - of_fixed);
        if times.is_finite() {
            self.speeds = by_teeth.into_iter().map(|r| r.map(|r| times * (r - of_fixed))).collect();
        }
    }

    /// Torque of each mesh of a planet, N m on the second gear of its stage, where a load of the train is known.
    ///
    /// ```text
    /// T_s + T_r + T_c = 0,   T_r = T_s z_r/z_s,   T_2 = T_s z_2/(z_s N)
    /// ```
    fn of_planet(&self, stage: usize) -> Option<f64> {
        let planetary = self.planetary.as_ref()?;
        let first = self.stages.first()?;
        // Turns by teeth stand for their inverse numbers.
        let ratio_to = |shaft: usize| -> Option<f64> {
            if shaft == first.shafts[0] {
                return Some(1.0);
            }
            let one = first.ratio;
            if shaft == first.shafts[1] {
                return Some(one);
            }
            let link = self.stages.iter().find(|l| l.shafts[1] == shaft && l.shafts[0] == first.shafts[1])?;
            Some(one * link.ratio)
        };
        let ring = self.stages.iter().map(|l| l.shafts[1]).find(|s| *s != first.shafts[1]);
        let to_ring = ring.and_then(ratio_to).map(|r| (1.0 / r).abs());
        let of_load = |load: &Load<'_, '_>| {
            let torque = load.torque?.abs();
            if load.shaft == first.shafts[0] {
                Some(torque)
            } else if planetary.stands(self.shafts[load.shaft].id) {
                Some(torque / (1.0 + to_ring?))
            } else {
                Some(torque / to_ring?)
            }
        };
        let of_first = self.loads.iter().find_map(of_load)?;
        let second = ratio_to(self.stages.get(stage)?.shafts[1])?;
        Some(of_first / second.abs() / planetary.planets.len() as f64)
    }

    /// Shafts that are reached from one, itself first, by all stages but one.
    fn beyond(&self, from: usize, without: Option<usize>) -> Vec<usize> {
        let mut reached = vec![false; self.shafts.len()];
        let mut all = vec![from];
        reached[from] = true;
        let mut at = 0;
        while let Some(&shaft) = all.get(at) {
            for link in self.stages.iter().enumerate().filter(|(k, _)| Some(*k) != without).map(|(_, link)| link) {
                let [a, b] = link.shafts;
                for (from, to) in [(a, b), (b, a)] {
                    if from == shaft && !reached[to] {
                        reached[to] = true;
                        all.push(to);
                    }
                }
            }
            at += 1;
        }
        all
    }

    /// Power of all loads of some shafts, N m/min; `None` where one of them is unknown or there are none.
    fn power(&self, shafts: &[usize]) -> Option<f64> {
        let own: Vec<_> = self.loads.iter().filter(|l| shafts.contains(&l.shaft)).collect();
        let each = own.iter().map(|l| Some(l.torque? * self.speeds[l.shaft]?)).collect::<Option<Vec<f64>>>()?;
        Some(each.iter().sum::<f64>()).filter(|p| *p != 0.0)
    }

    /// What a stage carries, where loads on one of its sides are known.
    pub(super) fn carried(&self, stage: usize) -> Option<StageLoad> {
        let link = self.stages.get(stage)?;
        if self.planetary.is_some() {
            let driver_speed = self.speeds[link.shafts[0]].unwrap_or(0.0);
            return Some(StageLoad { driver: 0, torque: self.of_planet(stage)?, driver_speed });
        }
        let [first, second] = link.shafts.map(|s| self.beyond(s, Some(stage)));
        if second.contains(&link.shafts[0]) {
            return None;
        }
        // What goes from gear 1 to gear 2.
        let power = self.power(&second).map(|p| -p).or_else(|| self.power(&first))?;
        let driver = usize::from(power < 0.0);
        let driven_speed = self.speeds[link.shafts[1 - driver]]?;
        let driver_speed = self.speeds[link.shafts[driver]]?;
        Some(StageLoad { driver, torque: (power / driven_speed).abs(), driver_speed })
    }

    /// Fills in the one load that follows from all others.
    pub(super) fn balance(&mut self) {
        let open: Vec<usize> = (0..self.loads.len()).filter(|&i| self.loads[i].torque.is_none()).collect();
        let [one] = open[..] else { return };
        let power = |l: &Load<'_, '_>| Some(l.torque? * self.speeds[l.shaft]?);
        let known = self.loads.iter().enumerate().filter(|(i, _)| *i != one).map(|(_, l)| power(l));
        let sum = known.collect::<Option<Vec<f64>>>().map(|all| all.iter().sum::<f64>());
        let own = sum.zip(self.speeds[self.loads[one].shaft]).map(|(sum, speed)| -sum / speed);
        self.loads[one].torque = own;
    }
}

/// Whether each shaft's u axis points as that of the first one; those that state none are taken to.
fn signs(shafts: &[Part<'_, '_>]) -> Result<Vec<f64>, RexsError> {
    let axes = shafts.iter().map(|s| s.vector("u_axis_vector")).collect::<Result<Vec<_>, _>>()?;
    let first = axes.iter().flatten().next().copied();
    let along = |axis: &Option<[f64; 3]>| {
        let dot = axis.zip(first).map_or(1.0, |(a, b)| (0..3).map(|k| a[k] * b[k]).sum::<f64>());
        if dot < 0.0 { -1.0 } else { 1.0 }
    };
    Ok(axes.iter().map(along).collect())
}

fn link<'a>(
    model: &Model<'a>,
    (number, relation): (usize, roxmltree::Node<'a, 'a>),
    gears: &BTreeMap<&'a str, usize>,
) -> Option<Link<'a>> {
    let mut ids = [reference(relation, "gear_1")?, reference(relation, "gear_2")?];
    let teeth = ids.map(|id| {
        let gear = model.part("gear", id)?;
        let value = gear.number("number_of_teeth", "").ok().flatten().filter(|z| *z != 0.0)?;
        Some(if gear.component() == "ring_gear" { -value.abs() } else { value })
    });
    let mut teeth = [teeth[0]?, teeth[1]?];
    // A ring is the second of its pair.
    if teeth[0] < 0.0 {
        ids.reverse();
        teeth.reverse();
    }
    let shafts = [*gears.get(ids[0])?, *gears.get(ids[1])?];
    let ratio = -teeth[0] / teeth[1];
    Some(Link { stage: reference(relation, "stage"), number, gears: ids, shafts, ratio })
}

/// Loads on the shafts that pass on torque.
fn loads<'m, 'a>(
    model: &'m Model<'a>,
    shafts: &BTreeMap<&str, usize>,
    signs: &[f64],
) -> Result<Vec<Load<'m, 'a>>, RexsError> {
    let mut all = Vec::new();
    for relation in model.assemblies().filter(|r| model.refers(*r, "part", "external_load")) {
        let shaft = reference(relation, "assembly").and_then(|id| shafts.get(id));
        let part = reference(relation, "part").and_then(|id| model.part("load", id));
        let (Some(&shaft), Some(part)) = (shaft, part) else { continue };
        let transmits = part.text("transmits_torque");
        let is_given = part.text("defines_torque") == Some("true");
        // Programs write 0 for what they have not computed yet.
        let stated = part.number("torque_around_u_axis", "N m")?.filter(|t| *t != 0.0 || is_given);
        let torque = stated.map(|t| signs[shaft] * t);
        if torque.is_some() || transmits == Some("true") {
            all.push(Load { part, shaft, torque });
        }
    }
    Ok(all)
}

/// Shafts of the train that a relation stands between, and on which side of it they are; none where it is of another planet
/// than the first.
pub(super) fn sides(relation: roxmltree::Node<'_, '_>, train: &Train<'_, '_>) -> Vec<(usize, Side)> {
    let roles =
        [("inner_part", Side::Inner), ("outer_part", Side::Outer), ("side_1", Side::Inner), ("side_2", Side::Outer)];
    let ids = || roles.iter().filter_map(|(role, side)| Some((reference(relation, role)?, *side)));
    if train.planetary.as_ref().is_some_and(|own| ids().any(|(id, _)| own.is_copy(id))) {
        return Vec::new();
    }
    ids().filter_map(|(id, side)| Some((train.shafts.iter().position(|s| s.id == id)?, side))).collect()
}

/// Side of a bearing or coupling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Inner,
    Outer,
}

impl Side {
    /// Attribute that has the place of a bearing on the shaft of this side.
    pub(super) fn coordinate(self) -> &'static str {
        match self {
            Self::Inner => "u_coordinate_on_shaft_inner_side",
            Self::Outer => "u_coordinate_on_shaft_outer_side",
        }
    }
}
