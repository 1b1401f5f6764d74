//! A wheel with holes, whose teeth are all different: windows are selections of the columns of teeth.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex},
};

use faer::Mat;
use fem::Material;
use geometry::{Gear, Side};
use mesh::{BoreCoupling, Extent, GroupNames, MeshedGear, StructuredOptions};
use reduction::{GearReducer, PartFault, PartStore, ReducedGear, ReductionWay, ToothColumns, record_key};
use testing::with_holes;

use crate::common::{gear, options};

const TEETH: u32 = 14;

/// Two holes, neither alike nor opposite.
fn wheel() -> (Gear, MeshedGear) {
    let gear = gear(TEETH, 12.0);
    let shape = StructuredOptions {
        order: 1,
        elements_profile: 2,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 2,
        elements_rim: 4,
        extent: Extent::Whole,
    };
    let mesh = mesh::generate(&gear, &shape).unwrap();
    let (hub, rim) = (0.5 * gear.data().bore_diameter + 1.0, gear.root_radius() - 1.0);
    let is_hole = |[x, y, _]: [f64; 3]| {
        let (r, angle) = (x.hypot(y), y.atan2(x));
        (hub..rim).contains(&r) && ((0.3..1.2).contains(&angle) || (-2.6..-2.2).contains(&angle))
    };
    let holed = with_holes(&mesh, is_hole);
    assert!(holed.nodes.len() < mesh.nodes.len());
    let mesh = MeshedGear::from_groups(holed, &GroupNames::default(), TEETH).unwrap();
    (gear, mesh)
}

fn reducer(mesh: &MeshedGear, sides: &[Side], window: usize, first: u32) -> GearReducer {
    let reducer = GearReducer::new(mesh.clone(), Material::STEEL, options(sides, window, first)).unwrap();
    assert_eq!((reducer.way(), reducer.is_cyclic()), (ReductionWay::General, false));
    reducer
}

/// Largest difference of two matrices over the largest number in the second.
fn difference(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    let numbers = || b.col_iter().flat_map(|c| c.iter());
    let largest = numbers().fold(0.0, |most: f64, v| most.max(v.abs()));
    let mine = a.col_iter().flat_map(|c| c.iter());
    mine.zip(numbers()).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / largest
}

fn bits(window: &ReducedGear) -> Vec<u64> {
    window.compliance().col_iter().flat_map(|c| c.iter().map(|v| v.to_bits())).collect()
}

/// Every window around the gear, made of columns of teeth, is that window reduced alone; the matrix is symmetric to the
/// bit, and no two teeth are alike.
#[test]
fn a_window_of_columns_is_that_window_alone() {
    let (_, mesh) = wheel();
    let mut largest: f64 = 0.0;
    for (sides, window, coupling) in [
        (&[Side::Left][..], 3, BoreCoupling::Kinematic),
        (&[Side::Left, Side::Right][..], 4, BoreCoupling::Kinematic),
        (&[Side::Right][..], 3, BoreCoupling::Distributing),
    ] {
        let mesh = mesh.clone().coupled(coupling);
        let whole = reducer(&mesh, sides, window, 2);
        for first in [0, 3, 5, 9, 12, 13] {
            let own = whole.window(first).unwrap().reduced;
            let alone = reducer(&mesh, sides, window, first).window(first).unwrap().reduced;
            assert_eq!((&own.teeth, &own.nodes), (&alone.teeth, &alone.nodes));
            largest = largest.max(difference(own.compliance(), alone.compliance()));
            let n = own.compliance().nrows();
            assert!((0..n).all(|i| (0..i).all(|j| own.compliance()[(i, j)] == own.compliance()[(j, i)])));
        }
        let [a, b] = [4, 8].map(|first| whole.window(first).unwrap().reduced.compliance().norm_max());
        assert!((a / b - 1.0).abs() > 1e-3, "the holes are not felt");
    }
    assert!(largest < 1e-10, "{largest:e}");
}

/// A window one tooth on takes the columns of the oncoming tooth alone, in either direction; the numbers of the teeth
/// that stay are the same to the bit, whatever was asked before and however many threads there are.
#[test]
fn windows_share_the_columns_of_their_teeth() {
    let (_, mesh) = wheel();
    let (mut by_way, window) = (Vec::new(), 3);
    for (threads, way) in [(1, 1), (2, TEETH - 1), (7, 1)] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let windows = pool.install(|| {
            let gear = reducer(&mesh, &[Side::Left], window, 2);
            let mut windows: BTreeMap<u32, Vec<u64>> = BTreeMap::new();
            let mut before = gear.window(2).unwrap().reduced;
            for on in 1..TEETH {
                let first = (2 + on * way) % TEETH;
                let next = gear.window(first).unwrap().reduced;
                // As far as the other side of the gear; from there the first teeth come again.
                if on < (TEETH - window as u32) / 2 {
                    assert_eq!(gear.teeth_solved(), on as usize, "{on} teeth on");
                }
                let shared: Vec<(usize, usize)> =
                    next.nodes.iter().enumerate().filter_map(|(i, &n)| Some((i, before.position(n)?))).collect();
                assert_eq!(3 * shared.len(), 2 * next.nodes.len(), "two of three teeth stay");
                for (&(i, i0), &(j, j0)) in shared.iter().flat_map(|a| shared.iter().map(move |b| (a, b))) {
                    for axis in 0..3 {
                        let at = |w: &ReducedGear, i: usize, j: usize| w.compliance()[(3 * i + axis, 3 * j)].to_bits();
                        assert_eq!(at(&next, i, j), at(&before, i0, j0), "window {first}");
                    }
                }
                windows.insert(first, bits(&next));
                before = next;
            }
            assert_eq!(gear.teeth_solved(), TEETH as usize - window, "every tooth once");
            windows
        });
        by_way.push(windows);
    }
    assert!(by_way.windows(2).all(|w| w[0] == w[1]), "bits depend on direction or threads");
}

/// Columns in files, less the disk.
#[derive(Debug, Default)]
struct Files(Mutex<BTreeMap<u32, ToothColumns>>);

impl PartStore for Files {
    fn load(&self, tooth: u32) -> Result<Option<ToothColumns>, PartFault> {
        Ok(self.0.lock().unwrap().get(&tooth).cloned())
    }

    fn save(&self, columns: &ToothColumns) -> Result<(), PartFault> {
        self.0.lock().unwrap().insert(columns.tooth, columns.clone());
        Ok(())
    }
}

/// Nothing can be read or written.
#[derive(Debug)]
struct Broken;

impl PartStore for Broken {
    fn load(&self, tooth: u32) -> Result<Option<ToothColumns>, PartFault> {
        Err(PartFault { file: format!("{tooth}.columns"), what: "is damaged".into(), writing: false })
    }

    fn save(&self, columns: &ToothColumns) -> Result<(), PartFault> {
        Err(PartFault { file: format!("{}.columns", columns.tooth), what: "disk full".into(), writing: true })
    }
}

/// A gear that is dropped without a word, as by a kill, has left its columns; the next one solves for the others alone,
/// and has the same bits. Columns of other teeth are not taken, and a store that fails costs time alone.
#[test]
fn columns_are_kept_as_soon_as_they_are_made() {
    let (_, mesh) = wheel();
    let gear = |store: Arc<dyn PartStore>| reducer(&mesh, &[Side::Left], 3, 2).with_parts(store);
    let files = Arc::new(Files::default());
    let wanted = |gear: &GearReducer| [3, 4, 5, 6].map(|first| bits(&gear.window(first).unwrap().reduced));
    let whole = wanted(&reducer(&mesh, &[Side::Left], 3, 2));
    {
        let stopped = gear(files.clone());
        stopped.window(3).unwrap();
        stopped.window(4).unwrap();
        assert_eq!(stopped.teeth_solved(), 2);
    }
    let next = gear(files.clone());
    assert_eq!(wanted(&next), whole, "bits of a run that went on");
    assert_eq!(next.teeth_solved(), 2, "of four teeth two were there");
    // Those of one tooth under the name of another.
    let wrong = files.0.lock().unwrap()[&5].clone();
    files.0.lock().unwrap().insert(6, wrong);
    let again = gear(files);
    assert_eq!(wanted(&again), whole);
    assert_eq!(again.teeth_solved(), 1);
    let broken = gear(Arc::new(Broken));
    assert_eq!(wanted(&broken), whole);
    let faults = broken.part_faults();
    assert_eq!((faults.len(), faults.iter().filter(|f| f.writing).count()), (8, 4), "{faults:?}");
    assert!(broken.part_faults().is_empty(), "told once");
}

/// A file of columns comes back to the bit, and no turned bit, cut end or other gear is taken for it.
#[test]
fn a_file_of_columns_is_believed_after_checks_alone() {
    let (geometry, mesh) = wheel();
    let files = Arc::new(Files::default());
    reducer(&mesh, &[Side::Left], 3, 2).with_parts(files.clone()).window(3).unwrap();
    let columns = files.0.lock().unwrap()[&5].clone();
    assert_eq!(columns.partners, [3, 4, 5]);
    let key = |first| record_key(&mesh, &geometry, &Material::STEEL, &options(&[Side::Left], 3, first), "auto");
    let bytes = columns.to_bytes(&key(2));
    assert_eq!(ToothColumns::from_bytes(&bytes, &key(2)).unwrap(), columns);
    assert!(ToothColumns::from_bytes(&bytes, &key(3)).is_err(), "another gear");
    let mut damaged = bytes.clone();
    for at in (0..160).chain((160..bytes.len()).step_by(997)) {
        damaged[at] ^= 4;
        assert!(ToothColumns::from_bytes(&damaged, &key(2)).is_err(), "byte {at}");
        damaged[at] = bytes[at];
    }
    for length in (0..200).chain([bytes.len() - 1]) {
        assert!(ToothColumns::from_bytes(&bytes[..length], &key(2)).is_err(), "{length} bytes");
    }
}

/// A field at some nodes is that of the whole gear, of the first window and of others, with the bore held either way.
#[test]
fn fields_at_some_nodes_are_those_of_the_whole() {
    let (_, mesh) = wheel();
    for coupling in [BoreCoupling::Kinematic, BoreCoupling::Distributing] {
        let gear = reducer(&mesh.clone().coupled(coupling), &[Side::Left], 3, 2);
        // All over the gear, held ones of the bore among them.
        let nodes: Vec<u32> = (0..gear.gear().mesh().nodes.len() as u32).step_by(7).rev().collect();
        for first in [2, 4, 9] {
            let window = gear.window(first).unwrap();
            let force = |j: usize| (0..window.reduced.coordinates()).map(move |i| (0.7 * i as f64 + j as f64).sin());
            let force = Mat::from_fn(window.reduced.coordinates(), 2, |i, j| force(j).nth(i).unwrap());
            let moved = window.reduced.compliance() * &force;
            let forces: Vec<&[f64]> = (0..2).map(|j| force.col_as_slice(j)).collect();
            let near = gear.expand_under(&window, &forces, &nodes).unwrap();
            for (column, near) in moved.col_iter().zip(&near) {
                let whole = gear.expand(&window, column.try_as_col_major().unwrap().as_slice()).unwrap();
                let largest = whole.iter().flatten().fold(0.0, |most: f64, u| most.max(u.abs()));
                for (&node, own) in nodes.iter().zip(near) {
                    let apart = [0, 1, 2].map(|axis| (own[axis] - whole[node as usize][axis]).abs());
                    assert!(apart.iter().all(|a| *a < 1e-11 * largest), "{coupling:?}, window {first}, node {node}");
                }
            }
            let beyond = gear.gear().mesh().nodes.len() as u32;
            assert!(gear.expand_under(&window, &forces, &[beyond]).is_err());
        }
    }
}
