//! The deck of one position, and where CalculiX is installed what it makes of it.
#![allow(clippy::print_stdout, reason = "what CalculiX found, or why it was not asked")]

use fem::Material;
use geometry::{Gear, GearData, GearPair, Side};
use mesh::{Extent, GearMesh, GroupNames, StructuredOptions, generate};
use study::calculix::{Body, Calculix, CalculixError, Deck};

const TORQUE: f64 = 150e3;
const PAIRS: [[u32; 2]; 3] = [[29, 1], [0, 0], [1, 29]];

struct Pair {
    pair: GearPair,
    gears: [GearMesh; 2],
}

fn pair(order: u32) -> Pair {
    let data = GearData::default();
    let wheel = GearData { helix_angle: -data.helix_angle, ..data.clone() };
    let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let options = StructuredOptions {
        order,
        elements_profile: 3,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 3,
        elements_rim: 1,
        extent: Extent::Sector(5),
    };
    let gears = [&pair.pinion, &pair.wheel].map(|gear| {
        GearMesh::from_groups(generate(gear, &options).unwrap(), &GroupNames::default(), gear.teeth()).unwrap()
    });
    Pair { pair, gears }
}

impl Pair {
    /// Pair 0 in the middle of its path.
    fn deck(&self) -> Deck<'_> {
        let Self { pair, gears } = self;
        let angle = pair.middle_angle(Side::Left);
        let turned = [angle, pair.wheel_angle(Side::Left, angle)];
        let body = |i: usize| Body {
            gear: &gears[i],
            material: &Material::STEEL,
            angle: turned[i],
            centre_x: [0.0, pair.centre_distance()][i],
        };
        Deck {
            bodies: [body(0), body(1)],
            driven: 1,
            side: Side::Left,
            pairs: &PAIRS,
            torque: TORQUE,
            closing: 5e-3 / pair.wheel.base_radius(),
            penalty: 1e7,
        }
    }
}

/// Lines of every block of the deck that begins with `keyword`, up to the next keyword.
fn block_lines(text: &str, keyword: &str) -> usize {
    let mut inside = false;
    text.lines()
        .filter(|l| {
            let is_keyword = l.starts_with('*');
            if is_keyword {
                inside = l.starts_with(keyword);
            }
            inside && !is_keyword
        })
        .count()
}

#[test]
fn a_deck_has_every_node_element_and_face() {
    for order in [1, 2] {
        let model = pair(order);
        let text = model.deck().text().unwrap();
        let sum = |count: fn(&GearMesh) -> usize| model.gears.iter().map(count).sum::<usize>();
        let nodes = sum(|g| g.mesh().nodes.len());
        // Two more for the rigid bore and its rotation.
        assert_eq!(block_lines(&text, "*NODE, NSET="), nodes + 2, "order {order}");
        let lines = if order == 1 { 1 } else { 2 };
        assert_eq!(block_lines(&text, "*ELEMENT"), lines * sum(|g| g.mesh().element_count()), "order {order}");
        let faces: usize = (0..2)
            .flat_map(|i| PAIRS.iter().map(move |teeth| (i, teeth[i])))
            .map(|(i, tooth)| model.gears[i].flank(tooth, Side::Left).unwrap().len())
            .sum();
        assert_eq!(block_lines(&text, "*SURFACE, NAME"), faces, "order {order}");
        assert_eq!(block_lines(&text, "*NSET, NSET=bore"), sum(|g| g.bore_nodes().len()));
        let long = text.lines().flat_map(|l| l.split(',')).map(|word| word.trim().len()).max();
        assert!(long <= Some(60), "a word of {long:?} characters");
    }
}

#[test]
fn a_deck_without_sense_is_refused() {
    let model = pair(1);
    let deck = model.deck();
    for wrong in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        for deck in [Deck { torque: wrong, ..deck }, Deck { closing: wrong, ..deck }, Deck { penalty: wrong, ..deck }] {
            assert!(matches!(deck.text(), Err(CalculixError::OutOfRange { .. })), "{wrong}");
        }
    }
    let missing = Deck { pairs: &[[15, 0]], ..deck };
    assert!(matches!(missing.text(), Err(CalculixError::MissingFlank { gear: "pinion", tooth: 15, .. })));
    assert!(matches!(Calculix::at("no/such/program".as_ref(), 1), Err(CalculixError::NotInstalled { .. })));
}

/// The forces of the pairs balance the torque, and the rotation does not depend on how far the gears were closed beforehand.
#[test]
fn calculix_balances_the_torque() {
    let calculix = match Calculix::find(1) {
        Ok(c) => c,
        Err(e) => return println!("skipped: {e}"),
    };
    let model = pair(2);
    let scratch = tempfile::tempdir().unwrap();
    let deck = model.deck();
    let run = calculix.run(&deck, scratch.path()).unwrap_or_else(|e| panic!("{e}"));
    let radius = model.pair.wheel.base_radius();
    let te = 1e3 * radius * run.result.rotation;
    let sizes: Vec<f64> = run.result.pairs.iter().map(|p| p.size()).collect();
    println!(
        "{:?}: TE {te:.4} um, pairs {sizes:.1?} N, {:.1} s, {:?} MB",
        calculix.version(),
        run.wall_s,
        run.peak_memory_mb
    );
    assert!((5.0..20.0).contains(&te), "TE {te} um");
    // About the wheel's axis: the moment about the origin less that of the force at the axis.
    let a = model.pair.centre_distance();
    let torque: f64 = run.result.pairs.iter().map(|p| p.moment[2] - a * p.force[1]).sum();
    assert!((torque.abs() / TORQUE - 1.0).abs() < 2e-3, "{torque} N mm about the wheel's axis");
    let normal = TORQUE / radius / model.pair.base_helix_angle().cos();
    let sum: f64 = sizes.iter().sum();
    assert!((sum / normal - 1.0).abs() < 0.01, "{sum} N on the flanks, {normal} N by the torque");
    let other = calculix.run(&Deck { closing: 2.0 * deck.closing, ..deck }, scratch.path()).unwrap();
    let off = other.result.rotation / run.result.rotation - 1.0;
    assert!(off.abs() < 1e-3, "closed twice as far: rotation {off:e} off");
}
