//! scratch
use dynamics::*;
use fem::*;
use geometry::*;
use mesh::*;
use reduction::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let n: Vec<u32> = args[1].split(',').map(|s| s.parse().unwrap()).collect();
    let order: u32 = args[2].parse().unwrap();
    let reduced = args[3] == "r";
    let slices: usize = args[4].parse().unwrap();
    let positions: usize = args[5].parse().unwrap();
    let teeth: u32 = args[6].parse().unwrap();
    let data = GearData::default();
    let wheel = GearData { helix_angle: -data.helix_angle, ..data.clone() };
    let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let o = StructuredOptions {
        order,
        elements_profile: n[0],
        elements_fillet: n[1],
        elements_thickness: n[2],
        elements_face: n[3],
        elements_rim: n[4],
        extent: if teeth == 0 { Extent::Whole } else { Extent::Sector(teeth) },
    };
    let meshes = [&pair.pinion, &pair.wheel]
        .map(|g| GearMesh::from_groups(generate(g, &o).unwrap(), &GroupNames::default(), g.teeth()).unwrap());
    let mut so = StaticOptions::new(150e3, &pair);
    so.slices = slices;
    let elements = ElementOptions {
        integration: if reduced { Integration::Reduced } else { Integration::Full },
        ..ElementOptions::default()
    };
    let t = std::time::Instant::now();
    let first = StaticModel::first_teeth(&pair, &so).unwrap();
    let grid: Option<[usize; 2]> = args.get(7).filter(|a| a.contains('x')).map(|a| {
        let v: Vec<usize> = a.split('x').map(|x| x.parse().unwrap()).collect();
        [v[0], v[1]]
    });
    if args.len() > 7 && grid.is_none() {
        so.method = Method::Nodal;
    }
    let gears = [0, 1].map(|i| {
        let ro = ReductionOptions {
            sides: so.sides(),
            window: StaticModel::window_teeth(&pair, &so),
            first: first[i],
            elements,
        };
        let mat = Material::new(2.06e5, 0.3, 7.85e-9).unwrap();
        let g = meshes[i].clone();
        match grid {
            Some(c) => {
                let geo = [&pair.pinion, &pair.wheel][i];
                let z = g.tooth_count();
                let teeth_: Vec<u32> = (0..ro.window as u32).map(|k| (ro.first + k) % z).collect();
                let (sides, tolerance) = (so.sides(), so.surface_tolerance);
                let grids = |mesh: &GearMesh| flank_grids(mesh, geo, &teeth_, &sides, c, tolerance);
                ElasticGear::Reduced(GearReducer::on_grids(g, mat, ro, false, grids).unwrap())
            }
            None => ElasticGear::Reduced(GearReducer::new(g, mat, ro).unwrap()),
        }
    });
    let mut m = StaticModel::new(pair, gears, so).unwrap();
    let t1 = t.elapsed();
    let t = std::time::Instant::now();
    let h = m.run(positions, 1, |_, _, _| ()).unwrap();
    let s: Vec<f64> = h.positions.iter().map(|p| 1e3 * p.transmission_error).collect();
    let mean = s.iter().sum::<f64>() / s.len() as f64;
    let (lo, hi) = s.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
    println!(
        "{n:?} o{order} {} slices {slices}: mean {mean:.4} pp {:.4}  [{:.3} {:.3} {:.3}] reduce {t1:.1?} solve {:.1?} dof {}",
        args[3],
        hi - lo,
        s[0],
        s[positions / 4],
        s[positions / 2],
        t.elapsed(),
        meshes[0].mesh().nodes.len() * 3
    );
}
