//! Two cylinders in line contact, by the contact code that runs the gears, against Hertz's closed form.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! Source: Hertz 1882; p0 = sqrt(q E* / (pi R)), a = 2 q / (pi p0), 1/R = 1/R1 + 1/R2, 1/E* = sum (1 - nu^2)/E.
//! Tolerance: 3 % in p0 and half-width at eight hex8 elements a half-width, 6 x 6 points a face as in a run; pressure
//! is the nodal one.

use contact::{
    Condensed, ContactError, Pose, complementarity,
    complementarity::{Balance, Law},
    flank::{Candidates, Cylinder, FlankPatch, GapSource, contact_points},
    line::{hertz, nodal_pressures},
    nodal::{LinePoints, Scene, closest_points},
};
use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix};
use mesh::{ElementBlock, ElementKind, Face, FaceKind, Mesh};

const RADIUS: [f64; 2] = [10.0, 14.0];
const LINE_LOAD: f64 = 200.0;
const THICKNESS: f64 = 1.0;
/// Blocks reach this far from the contact, mm: forty half-widths.
const EXTENT: f64 = 5.0;

/// Positions from 0 outwards: steps of `h` up to `fine`, then growing by a third, the last one at `end`.
fn graded(h: f64, fine: f64, end: f64) -> Vec<f64> {
    let (mut at, mut step) = (vec![0.0], h);
    let mut last = 0.0;
    while last + step < end {
        last += step;
        at.push(last);
        if last > fine {
            step *= 1.33;
        }
    }
    if end - last < 0.5 * step {
        at.pop();
    }
    at.push(end);
    at
}

struct Body {
    mesh: Mesh,
    top: Vec<Face>,
    bottom: Vec<u32>,
}

/// A block of hex8, one element thick, its upper face on the cylinder whose top is at the origin; material below (`up`
/// = 1) or, for the mirrored body, above it (`up` = -1).
fn block(radius: f64, up: f64, h: f64, fine: f64, shift: f64) -> Body {
    let half = graded(h, fine, EXTENT);
    let mut xs: Vec<f64> = half.iter().rev().map(|x| -x).collect();
    xs.extend(&half[1..]);
    let ends = [xs[0], xs[xs.len() - 1]];
    xs.iter_mut().filter(|x| !ends.contains(x)).for_each(|x| *x += shift);
    let depths = graded(h, fine, EXTENT);
    let (nx, ny) = (xs.len(), depths.len());
    let mut nodes = Vec::new();
    for z in [0.0, THICKNESS] {
        for depth in &depths {
            for x in &xs {
                let arc = (radius * radius - x * x).sqrt() - radius;
                nodes.push([*x, up * (arc * (1.0 - depth / EXTENT) - depth), z]);
            }
        }
    }
    let node = |i: usize, j: usize, k: usize| ((k * ny + j) * nx + i) as u32;
    let (mut connectivity, mut top) = (Vec::new(), Vec::new());
    for j in 0..ny - 1 {
        for i in 0..nx - 1 {
            let lower = [node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0)];
            let upper = lower.map(|n| n + (nx * ny) as u32);
            // Depth runs along -y for the lower body, so its z runs the other way round.
            let (a, b) = if up > 0.0 { (upper, lower) } else { (lower, upper) };
            connectivity.extend(a.into_iter().chain(b));
            if j == 0 && xs[i].abs().max(xs[i + 1].abs()) < fine {
                top.push(Face::new(
                    FaceKind::Quad4,
                    &[node(i, 0, 0), node(i + 1, 0, 0), node(i + 1, 0, 1), node(i, 0, 1)],
                ));
            }
        }
    }
    let tags = (1..=(connectivity.len() / 8) as u64).collect();
    let bottom = (0..nx).flat_map(|i| [node(i, ny - 1, 0), node(i, ny - 1, 1)]).collect();
    let node_tags = (1..=nodes.len() as u64).collect();
    let blocks = vec![ElementBlock { kind: ElementKind::Hex8, connectivity, tags }];
    Body { mesh: Mesh { nodes, node_tags, blocks, ..Mesh::default() }, top, bottom }
}

/// Plane strain: compliance of the top nodes with all u_z held, three coordinates a node.
fn plane_strain_compliance(body: &Body, nodes: &[u32]) -> Mat<f64> {
    let mut bottom = body.bottom.clone();
    bottom.sort_unstable();
    let dofs = DofMap::new(body.mesh.nodes.len(), &bottom);
    let steel = Material::new(206e3, 0.3, 7.85e-9).unwrap();
    let k = fem::assemble_stiffness(&body.mesh, &steel, &dofs, &ElementOptions::default()).unwrap();
    let number: Vec<Option<usize>> = (0..k.n()).map(|dof| (dof % 3 != 2).then_some(dof / 3 * 2 + dof % 3)).collect();
    let n = k.n() / 3 * 2;
    let kept: Vec<_> = k.entries().filter_map(|(i, j, v)| Some((number[i]?, number[j]?, v))).collect();
    let plane = SymmetricMatrix::from_triplets(n, &kept).unwrap();
    let boundary: Vec<usize> =
        nodes.iter().flat_map(|&node| [0, 1].map(|axis| number[dofs.dof(node, axis).unwrap()].unwrap())).collect();
    let c = BoundaryLastFactor::new(&plane, &boundary).unwrap().compliance();
    Mat::from_fn(3 * nodes.len(), 3 * nodes.len(), |i, j| {
        if i % 3 == 2 || j % 3 == 2 { 0.0 } else { c[(i / 3 * 2 + i % 3, j / 3 * 2 + j % 3)] }
    })
}

fn nodes_of(faces: &[Face]) -> Vec<u32> {
    let mut nodes: Vec<u32> = faces.iter().flat_map(|f| f.nodes().to_vec()).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Largest pressure and half-width with `per_half_width` elements in a half-width of contact.
fn solve(per_half_width: f64, law: Law) -> Result<(f64, f64), ContactError> {
    let (p0, a) = closed_form();
    assert!(p0 > 0.0);
    let h = a / per_half_width;
    // The meshes do not match: the upper one is shifted by a good third of an element.
    let bodies = [block(RADIUS[0], 1.0, h, 2.0 * a, 0.0), block(RADIUS[1], -1.0, h, 2.5 * a, 0.37 * h)];
    let mut patches = Vec::new();
    let mut compliances = Vec::new();
    for (body, (radius, centre)) in bodies.iter().zip([(RADIUS[0], -RADIUS[0]), (RADIUS[1], RADIUS[1])]) {
        let nodes = nodes_of(&body.top);
        let number = |node: u32| nodes.binary_search(&node).ok().map(|i| i as u32);
        let surface = Box::new(Cylinder { centre: [0.0, centre], radius });
        patches.push(FlankPatch::new(0, surface, &body.mesh.nodes, &body.top, number, 1e-9)?);
        compliances.push(plane_strain_compliance(body, &nodes));
    }
    let points = [contact_points(&patches[0], 6, GapSource::Smooth)];
    let trees = [Candidates::new(&patches[..1]), Candidates::new(&patches[1..])];
    let scene = Scene {
        first: &patches[..1],
        points: &points,
        second: &patches[1..],
        first_tree: &trees[0],
        second_tree: &trees[1],
        source: GapSource::Smooth,
        line: &LinePoints::new(),
    };
    let mut rows = closest_points(&scene, &[Pose::identity(), Pose::identity()], 1.0);
    // The one rigid coordinate is the upper body's approach, so the "moment" is the load.
    for row in &mut rows {
        row.levers[0] = row.normal.y;
        row.torque_levers[0] = row.normal.y;
    }
    let mut elastic = Condensed::new(&rows, [compliances[0].as_ref(), compliances[1].as_ref()]);
    let load = -LINE_LOAD * THICKNESS;
    let solution = complementarity::solve(&mut elastic, &rows, 0, Balance::Moment(load), law, &vec![0.0; rows.len()])?;
    let pressures = nodal_pressures(&patches[..1], 0, &rows, &solution.forces);
    let pressure = pressures.values().copied().fold(0.0, f64::max);
    // The half-ellipse has the second moment a^2 / 4: a measure that does not jump from element to element.
    let total: f64 = solution.forces.iter().sum();
    let second: f64 = rows.iter().zip(&solution.forces).map(|(r, f)| f * r.position.x.powi(2)).sum();
    Ok((pressure, 2.0 * (second / total).sqrt()))
}

fn closed_form() -> (f64, f64) {
    let radius = 1.0 / (1.0 / RADIUS[0] + 1.0 / RADIUS[1]);
    let modulus = hertz::effective_modulus([(206e3, 0.3), (206e3, 0.3)]);
    (hertz::line_pressure(LINE_LOAD, radius, modulus), hertz::half_width(LINE_LOAD, radius, modulus))
}

#[test]
fn cylinders_press_as_hertz_says() {
    let (p0, a) = closed_form();
    let counts = [2.0, 4.0, 8.0, 16.0];
    let mut errors = Vec::new();
    for per in counts {
        let (pressure, width) = solve(per, Law::Exact).unwrap();
        println!(
            "{per:>4} elements a half-width: p0 {pressure:.2} MPa ({:+.3} %), a {width:.5} mm ({:+.3} %)",
            100.0 * (pressure / p0 - 1.0),
            100.0 * (width / a - 1.0)
        );
        errors.push(((pressure / p0 - 1.0).abs(), (width / a - 1.0).abs()));
    }
    println!("closed form: p0 {p0:.2} MPa, a {a:.5} mm");
    let order = (errors[0].1 / errors[2].1).log2() / 2.0;
    println!("observed order of the half-width from 2 to 8 elements: {order:.2}");
    assert!(errors[2].0 < 0.03 && errors[2].1 < 0.03, "{errors:?}");
    assert!(order > 0.9, "order {order}");
}

/// A stiff penalty tends to exact contact.
#[test]
fn penalty_tends_to_exact() {
    let (exact, _) = solve(4.0, Law::Exact).unwrap();
    let mut last = f64::INFINITY;
    for stiffness in [1e6, 1e7, 1e8, 1e9] {
        let (p, _) = solve(4.0, Law::Penalty(stiffness)).unwrap();
        let off = (p / exact - 1.0).abs();
        println!("penalty {stiffness:.0e} MPa/mm: p0 {p:.2} MPa, {:.3} % off", 100.0 * off);
        assert!(off < last, "penalty {stiffness:e}: {off} after {last}");
        last = off;
    }
    assert!(last < 5e-3, "{last}");
}
