//! A planet on its rollers, which press the bore of its elastic body.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::Arc;

use fem::Material;
use gearbox::{
    Bearing, Disc, ExactMesh, GearMesh, GearboxError, GearboxPosition, MeshElement, Operation, Shaft, StaticGearbox,
    Structure, Torque,
    rolling_bearing::{AxialSetting, RollerGeometry, RollerProfile, RollingBearing, RollingElements, Row},
};
use geometry::{Gear, GearData, GearPair, Sense};
use mesh::{BoreCoupling, Extent, StructuredOptions};
use reduction::ElasticGear;
use testing::Case;

use crate::{
    pairs::{bearing, operation, options, shaft},
    rolling::{MIDDLE, PLAYLESS, balls_209, made},
};

/// Torque of the output, N mm.
const TORQUE: f64 = 3e5;
/// Teeth of pinion, gear between, and wheel; module 3 mm, face width 20 mm.
const TEETH: [u32; 3] = [20, 31, 23];

const SECTOR: StructuredOptions = StructuredOptions {
    order: 1,
    elements_profile: 2,
    elements_fillet: 2,
    elements_thickness: 2,
    elements_face: 4,
    elements_rim: 2,
    extent: Extent::Periodic,
};

/// Rollers that fill the bore of the gear between.
fn rollers(bore: f64, profile: RollerProfile) -> RollerGeometry {
    let (elements, diameter) = (16, 8.0);
    RollerGeometry { elements, diameter, length: 16.0, pitch_diameter: bore - diameter, contact_angle: 0.0, profile }
}

#[derive(Clone, Copy)]
struct Setting {
    /// Radial play of the rollers, mm.
    clearance: f64,
    profile: RollerProfile,
    /// Bore of the gear between over its reference diameter.
    bore: f64,
    helix_deg: f64,
    coupling: BoreCoupling,
    /// Young's modulus of the gear between over that of steel.
    stiff: f64,
    in_bore: bool,
}

const SETTING: Setting = Setting {
    clearance: 0.01,
    profile: RollerProfile::Straight,
    bore: 0.7,
    helix_deg: 0.0,
    coupling: BoreCoupling::Distributing,
    stiff: 1.0,
    in_bore: true,
};

impl Setting {
    fn bore_mm(self) -> f64 {
        self.bore * 3.0 * f64::from(TEETH[1]) / self.helix_deg.to_radians().cos()
    }

    /// Pairs of pinion and gear, gear and wheel.
    fn pairs(self) -> [GearPair; 2] {
        let gear = |i: usize| {
            let helix = [1.0, -1.0, 1.0][i] * self.helix_deg.to_radians();
            let z = f64::from(TEETH[i]);
            let bore_diameter = if i == 1 { self.bore_mm() } else { 0.55 * 3.0 * z / helix.cos() };
            Gear::new(GearData {
                teeth: TEETH[i],
                helix_angle: helix,
                bore_diameter,
                face_width: 20.0,
                ..GearData::default()
            })
            .unwrap()
        };
        [[0, 1], [1, 2]].map(|[a, b]| GearPair::new(gear(a), gear(b), None).unwrap())
    }

    fn law(self) -> RollingBearing {
        let own = RollingElements::Rollers(rollers(self.bore_mm(), self.profile));
        made(own, &[Row { position: 0.0, thrust: 1.0 }], self.clearance, AxialSetting::Clearance(0.0))
    }

    /// Three gears in a row, the outer ones held; the one between stands on rollers, whose inner race does not move. Discs: the
    /// gears, input, output.
    fn parts(self) -> (Structure, Vec<GearMesh>, Operation) {
        let pairs = self.pairs();
        let [a, b] = [0, 1].map(|i| pairs[i].centre_distance());
        let between = |name: &str, x: f64| Shaft {
            name: name.into(),
            origin: [x, 0.0, 0.0],
            pieces: Vec::new(),
            longest_element: 1.0,
        };
        let outer = |name: &str, x: f64| shaft(name, [x, 0.0, -50.0], 100.0, 30.0);
        let both = |s: usize| [(20.0, 1e5), (80.0, 0.0)].map(|(z, axial)| bearing(&format!("{s} at {z}"), s, z, axial));
        let rolls = Bearing::rolling("rollers", 1, 0.0, self.law());
        // Needles along the axis, which rollers do not hold.
        let thrust = Bearing::diagonal("thrust", 1, 0.0, [0.0, 0.0, 1e5, 0.0, 0.0, 0.0]);
        let mut bearings: Vec<Bearing> = both(0).into();
        bearings.push(if self.in_bore { rolls.in_bore_of(1) } else { rolls });
        bearings.push(thrust);
        bearings.extend(both(2));
        let disc = |name: &str, s: usize, z: f64| Disc::ring(name, s, z, [60.0, 30.0], 20.0, 7.85e-9);
        let structure = Structure {
            shafts: vec![outer("in", 0.0), between("between", a), outer("out", a + b)],
            discs: vec![
                disc("pinion", 0, 50.0),
                disc("gear", 1, 0.0),
                disc("wheel", 2, 50.0),
                disc("input", 0, 0.0),
                disc("output", 2, 100.0),
            ],
            bearings,
            ..Structure::default()
        };
        let mut run = operation(&structure, 3, Sense::Ccw, vec![Torque { disc: 4, torque: -TORQUE }]);
        run.held = vec![0, 2];
        let mesh = |(discs, pair): ([usize; 2], GearPair)| GearMesh { name: format!("{discs:?}"), discs, pair };
        (structure, [[0, 1], [1, 2]].into_iter().zip(pairs).map(mesh).collect(), run)
    }

    fn gearbox(self) -> StaticGearbox {
        self.meshed(Extent::Periodic)
    }

    /// The gear between as one sector, or whole and condensed in one factor.
    fn meshed(self, extent: Extent) -> StaticGearbox {
        self.of(self.parts().0, extent).unwrap_or_else(|e| panic!("{e}"))
    }

    /// The same of another structure.
    fn of(self, structure: Structure, extent: Extent) -> Result<StaticGearbox, GearboxError> {
        let (_, meshes, run) = self.parts();
        let made = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
            let own = options(&mesh.pair, meshing, TORQUE);
            let mut case = Case::meshed(mesh.pair.clone(), &StructuredOptions { extent, ..SECTOR }, TORQUE);
            let between = 1 - i;
            case.meshes[between] = case.meshes[between].clone().coupled(self.coupling);
            let gears = Arc::new(self.reduced(&case, &own, (between, extent == Extent::Whole)));
            Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, own)?) as Box<dyn MeshElement>)
        });
        made.map(StaticGearbox::joined)
    }

    /// Both gears, the one between of another stiffness; `general`: in one factor each.
    fn reduced(self, case: &Case, own: &ltca::StaticOptions, (between, general): (usize, bool)) -> [ElasticGear; 2] {
        let steel = Material::STEEL;
        let stiff = Material::new(steel.young_mpa() * self.stiff, steel.poisson(), 7.85e-9).unwrap();
        case.reduced_gears_of(own, std::array::from_fn(|i| if i == between { stiff } else { steel }), general)
    }
}

fn solve(gearbox: &mut StaticGearbox, angle: f64) -> GearboxPosition {
    let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
    let certificate = &found.certificate;
    println!("  {angle} rad: {certificate:?}");
    assert!(certificate.body_balance < 1e-9 && certificate.iterations < 40, "{certificate:?}");
    found
}

/// Rollers bear what the meshes press the gear with: the sum of their forces along their radii is the force of the bearing,
/// and that of both meshes.
#[test]
fn rollers_in_a_bore_bear_what_both_meshes_press_with() {
    for setting in
        [SETTING, Setting { helix_deg: 12.0, clearance: 0.03, profile: RollerProfile::Logarithmic, ..SETTING }]
    {
        let mut gearbox = setting.gearbox();
        let found = solve(&mut gearbox, 0.1);
        let zone = setting.law().zone_of(&found.laminae[2]);
        let sum = |of: fn(f64) -> f64| -> f64 { zone.iter().map(|own| own.force * of(own.angle)).sum() };
        let sum = [sum(f64::cos), sum(f64::sin)];
        let bears = found.bearings[2].force;
        let meshes: [f64; 2] = std::array::from_fn(|k| found.meshes[0].force[1][k] + found.meshes[1].force[0][k]);
        let size = bears[0].hypot(bears[1]);
        for k in 0..2 {
            assert!((sum[k] - bears[k]).abs() < 1e-9 * size, "rollers {sum:?} N, bearing {bears:?} N");
            assert!((meshes[k] + bears[k]).abs() < 1e-9 * size, "meshes {meshes:?} N, bearing {bears:?} N");
        }
        let loaded: Vec<f64> = zone.iter().map(|own| own.force.round()).collect();
        println!("{size:.0} N on {loaded:?}");
        assert!(zone.iter().filter(|own| own.force > 0.0).count() > 3, "{loaded:?}");
    }
}

/// The stiffer the gear, the nearer are its rollers to those of rigid rings, as the inverse of its modulus; and a thin one of
/// steel has another load zone.
#[test]
fn a_stiff_gear_is_a_rigid_ring_on_its_rollers() {
    let mut rigid = Setting { in_bore: false, ..SETTING };
    rigid.stiff = 1e6;
    let zone_of = |setting: Setting| {
        let mut gearbox = setting.gearbox();
        let found = solve(&mut gearbox, 0.1);
        let zone: Vec<f64> = match setting.in_bore {
            true => setting.law().zone_of(&found.laminae[2]).iter().map(|own| own.force).collect(),
            false => {
                // As an inner ring: elements are on the other side.
                let own = found.rolling[2].unwrap().displacement.fixed_rows::<5>(0).into_owned();
                let zone = setting.law().load_zone(&own);
                (0..16).map(|j| zone[(j + 8) % 16].force).collect()
            }
        };
        (zone, found.output_lags[0])
    };
    let (wanted, _) = zone_of(rigid);
    let largest = wanted.iter().copied().fold(0.0, f64::max);
    let off = [1.0, 1e3, 1e5].map(|stiff| {
        let (zone, _) = zone_of(Setting { stiff, ..SETTING });
        println!("{stiff:.0e} times steel: {:?}", zone.iter().map(|f| f.round()).collect::<Vec<_>>());
        zone.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
    });
    println!("rigid: {:?}; off by {off:?}", wanted.iter().map(|f| f.round()).collect::<Vec<_>>());
    assert!(off[0] > 0.1, "{off:?}");
    assert!(off[1] < 2e-3 * off[0] * 1e3 && off[2] < 1e-4, "{off:?}");
}

/// Rollers slide over the sectors of the gear: nothing jumps where one comes from one to the next, nor where a mesh changes its
/// teeth, and sectors and the whole gear in one factor say the same.
#[test]
fn nothing_jumps_where_a_roller_comes_to_another_sector() {
    let setting = Setting { helix_deg: 12.0, ..SETTING };
    let [mut sectors, mut whole] = [Extent::Periodic, Extent::Whole].map(|extent| setting.meshed(extent));
    let step = 1e-9;
    let zone = |found: &GearboxPosition| -> Vec<f64> {
        setting.law().zone_of(&found.laminae[2]).iter().map(|own| own.force).collect()
    };
    let largest = |a: &[f64], b: &[f64]| {
        let most = b.iter().copied().fold(0.0, f64::max);
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most
    };
    // A roller is at a cut when the gear has turned by where its first one is.
    let found = solve(&mut sectors, 0.0);
    let first = sectors.rollers_on_bore(2).unwrap().angle;
    let pitch = std::f64::consts::TAU / f64::from(TEETH[1]);
    let ratio = -f64::from(TEETH[1]) / f64::from(TEETH[0]);
    drop(found);
    for (roller, part) in [(0, 0.0), (3, 0.5), (5, 0.0)] {
        let at = (std::f64::consts::TAU / 16.0 * f64::from(roller) - first) / pitch;
        let angle = ((at - at.floor()) + part) * pitch * ratio;
        let [before, after] = [angle - step, angle + step].map(|angle| solve(&mut sectors, angle));
        let jump = largest(&zone(&after), &zone(&before));
        let other = solve(&mut whole, angle + step);
        let apart = largest(&zone(&other), &zone(&after));
        let lag = (other.output_lags[0] / after.output_lags[0] - 1.0).abs();
        println!(
            "roller {roller}: forces move by {jump:.1e}, the whole gear is off by {apart:.1e}, its lag by {lag:.1e}"
        );
        assert!(jump < 1e-6, "roller {roller}: forces jump by {jump:e} of the largest");
        assert!(apart < 1e-8 && lag < 1e-9, "roller {roller}: whole gear off by {apart:e}, {lag:e}");
    }
}

/// What does not fit into a bore is refused with its numbers and with what cures it.
#[test]
fn rollers_that_do_not_fit_a_bore_are_refused() {
    let solved = |setting: Setting, change: fn(&mut Structure, RollerGeometry)| {
        let (mut structure, ..) = setting.parts();
        change(&mut structure, rollers(setting.bore_mm(), setting.profile));
        let refused = setting.of(structure, Extent::Periodic).and_then(|mut gearbox| gearbox.solve(0.1)).unwrap_err();
        let hint = refused.hint().unwrap_or_default();
        println!("{refused}; {hint}");
        (refused.to_string(), hint)
    };
    for (change, said, cure) in [
        (
            (|structure, own| {
                let own = RollerGeometry { length: 24.0, ..own };
                let law = made(RollingElements::Rollers(own), &MIDDLE, 0.0, PLAYLESS);
                structure.bearings[2].law = Some(Arc::new(law));
            }) as fn(&mut Structure, RollerGeometry),
            "the rollers lie from -12.000 to 12.000 mm",
            "element_length_mm",
        ),
        (
            |structure, own| {
                let own = RollerGeometry { pitch_diameter: 0.9 * own.pitch_diameter, ..own };
                let law = made(RollingElements::Rollers(own), &MIDDLE, 0.0, PLAYLESS);
                structure.bearings[2].law = Some(Arc::new(law));
            },
            "the outer race of the rollers is",
            "pitch_diameter_mm",
        ),
        (
            |structure, _| {
                let law = made(RollingElements::Balls(balls_209()), &MIDDLE, 0.0, PLAYLESS);
                structure.bearings[2].law = Some(Arc::new(law));
            },
            "pressed by cylindrical rollers alone",
            "cylindrical-roller",
        ),
        (|structure, _| structure.bearings[2].bore_of = Some(2), "gear wheel is not on the shaft", "`in_shaft`"),
        (
            |structure, _| {
                let again = structure.bearings[2].clone();
                structure.bearings.push(again);
            },
            "another bearing is in the bore of gear gear",
            "`rows`",
        ),
    ] {
        let (refused, hint) = solved(SETTING, change);
        assert!(refused.contains(said) && hint.contains(cure), "{refused}: {hint}");
    }
    let rigid = Setting { coupling: BoreCoupling::Kinematic, ..SETTING };
    let (refused, hint) = solved(rigid, |_, _| ());
    assert!(refused.contains("`kinematic`") && hint.contains("distributing"), "{refused}: {hint}");
}
