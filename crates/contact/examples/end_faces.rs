//! Study: how a free end face softens a line contact, resolved in 3-D.
//!
//! A layer of depth 1 on rigid ground, pressed along a line that ends at a free face; the line load q(s) that gives the
//! same dent everywhere is compared with that far from the face. The face leans by the base helix angle against the
//! line's normal plane: acute at one end of a helical tooth, obtuse at the other. Run with `cargo run --release -p
//! contact --example end_faces`.
#![allow(clippy::print_stdout, reason = "a study prints")]

use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix};
use mesh::{ElementBlock, ElementKind, Mesh};

const LENGTH: f64 = 6.0;

/// Ends and middles of elements growing from `first` at 0 to `end`.
fn graded(first: f64, end: f64, growth: f64, largest: f64) -> Vec<f64> {
    let (mut ends, mut step) = (vec![0.0f64], first);
    while ends[ends.len() - 1] < end {
        ends.push(ends[ends.len() - 1] + step);
        step = (step * growth).min(largest);
    }
    let scale = end / ends[ends.len() - 1];
    let mut all = Vec::new();
    for w in ends.windows(2) {
        all.extend([scale * w[0], 0.5 * scale * (w[0] + w[1])]);
    }
    all.push(end);
    all
}

/// Integrals of the quadratic shape functions times a weight along a lattice line: a matrix nodes x weights.
fn integrals(x: &[f64], weight: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut f = vec![0.0; x.len()];
    let n = 400;
    for e in (0..x.len() - 1).step_by(2) {
        let length = x[e + 2] - x[e];
        for g in 0..n {
            let xi = -1.0 + 2.0 * (f64::from(g) + 0.5) / f64::from(n);
            let at = x[e] + 0.5 * length * (xi + 1.0);
            let w = weight(at) * length / f64::from(n);
            for (i, s) in [0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)].iter().enumerate() {
                f[e + i] += w * s;
            }
        }
    }
    f
}

/// Places s along the line (element ends) and q(s) over its value far from the face, for a face that leans by `lean`
/// rad (positive: acute).
fn line_load(nu: f64, lean: f64, band: f64) -> (Vec<f64>, Vec<f64>) {
    let across = graded(band / 3.0, 4.0, 1.4, 0.8);
    let deep = graded(band / 3.0, 1.0, 1.35, 0.2);
    let along = graded(0.02, LENGTH, 1.35, 0.4);
    let (nx, ny, nz) = (across.len(), deep.len(), along.len());
    let mut number = vec![u32::MAX; nx * ny * nz];
    let (mut nodes, mut lattice) = (Vec::new(), Vec::new());
    let index = |i: usize, j: usize, k: usize| (k * ny + j) * nx + i;
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                if i % 2 + j % 2 + k % 2 <= 1 {
                    number[index(i, j, k)] = nodes.len() as u32;
                    // The face leans most at the end and not at all where the line goes on.
                    let s = along[k] + lean.tan() * deep[j] * (1.0 - along[k] / LENGTH);
                    nodes.push([across[i], -deep[j], s]);
                    lattice.push([i, j, k]);
                }
            }
        }
    }
    let mut connectivity = Vec::new();
    for k in (0..nz - 1).step_by(2) {
        for j in (0..ny - 1).step_by(2) {
            for i in (0..nx - 1).step_by(2) {
                for xi in ElementKind::Hex20.reference_nodes() {
                    // x, s, depth is a left-handed triple of (x, -depth, s): swap two.
                    let step = |c: f64| (c + 1.0) as usize;
                    connectivity.push(number[index(i + step(xi[0]), j + 2 - step(xi[1]), k + step(xi[2]))]);
                }
            }
        }
    }
    let tags = (1..=(connectivity.len() / 20) as u64).collect();
    let count = nodes.len();
    let mesh = Mesh {
        node_tags: (1..=count as u64).collect(),
        nodes,
        blocks: vec![ElementBlock { kind: ElementKind::Hex20, connectivity, tags }],
        ..Mesh::default()
    };
    let material = Material::new(1.0, nu, 1.0).expect("material");
    let dofs = DofMap::new(count, &[]);
    let k = fem::assemble_stiffness(&mesh, &material, &dofs, &ElementOptions::default()).expect("stiffness");
    let mut row = vec![None; 3 * count];
    let mut free = 0;
    for (n, &[i, j, k]) in lattice.iter().enumerate() {
        for axis in 0..3 {
            let held = j == ny - 1 || i == nx - 1 || (axis == 0 && i == 0) || (axis == 2 && k == nz - 1);
            if !held {
                row[3 * n + axis] = Some(free);
                free += 1;
            }
        }
    }
    let kept: Vec<_> = k.entries().filter_map(|(a, b, v)| Some((row[a]?, row[b]?, v))).collect();
    let factor =
        BoundaryLastFactor::new(&SymmetricMatrix::from_triplets(free, &kept).expect("matrix"), &[]).expect("factor");
    // Half of a Hertzian band across, hat functions of the element ends along.
    let shape = integrals(&across, |x| (1.0 - (x / band).powi(2)).max(0.0).sqrt());
    let total: f64 = shape.iter().sum();
    let ends: Vec<f64> = along.iter().copied().step_by(2).collect();
    let hat = |e: usize, s: f64| {
        let side = |o: f64| if o == ends[e] { 1.0 } else { (s - o) / (ends[e] - o) };
        let (low, high) = (ends[e.saturating_sub(1)], ends[(e + 1).min(ends.len() - 1)]);
        if s < low || s > high {
            0.0
        } else if s <= ends[e] {
            side(low)
        } else {
            side(high)
        }
    };
    let mut loads = Mat::<f64>::zeros(free, ends.len());
    let mut lengths = vec![0.0; ends.len()];
    for e in 0..ends.len() {
        let line = integrals(&along, |s| hat(e, s));
        lengths[e] = line.iter().sum();
        for i in 0..nx {
            for (k, l) in line.iter().enumerate() {
                // A face of a serendipity element has no middle node: its share goes to the neighbours of the same
                // face.
                let force = 0.5 * shape[i] / total * l;
                if i % 2 + k % 2 <= 1 {
                    if let Some(r) = row[3 * number[index(i, 0, k)] as usize + 1] {
                        loads[(r, e)] -= force;
                    }
                } else {
                    // N_8-node = N_9-node + shares of the bubble: -1/4 to corners, 1/2 to middles.
                    for (di, dk, share) in [
                        (0, 0, -0.25),
                        (0, 2, -0.25),
                        (2, 0, -0.25),
                        (2, 2, -0.25),
                        (1, 0, 0.5),
                        (0, 1, 0.5),
                        (1, 2, 0.5),
                        (2, 1, 0.5),
                    ] {
                        let node = number[index(i + di - 1, 0, k + dk - 1)];
                        if let Some(r) = row[3 * node as usize + 1] {
                            loads[(r, e)] -= share * force;
                        }
                    }
                }
            }
        }
    }
    let mut answer = loads.clone();
    factor.solve(answer.as_mut()).expect("solve");
    let compliance = loads.transpose() * &answer;
    // Mean dent of each hat's stretch under the same load everywhere.
    let far = ends.iter().position(|&s| s > 4.0).unwrap_or(ends.len() - 1);
    let uniform: Vec<f64> =
        (0..ends.len()).map(|e| (0..ends.len()).map(|f| compliance[(e, f)]).sum::<f64>() * 2.0 / lengths[e]).collect();
    let k = 2.0 * (1.0 - nu * nu) / std::f64::consts::PI;
    let extra = (0..ends.len()).map(|e| (uniform[e] - uniform[far]) / k).collect();
    println!(
        "   far: {:.4} against {:.4}",
        uniform[far] / k,
        (2.0 / band).ln() + 0.25 + contact::local::layer_constant(nu)
    );
    (ends, extra)
}

fn main() {
    println!("bracket near a free end face less that far from it, by distance in depths");
    for nu in [0.0, 0.2, 0.3, 0.4, 0.45] {
        for lean_deg in [-40.0f64, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0] {
            let (s, extra) = line_load(nu, lean_deg.to_radians(), 0.05);
            let shown: Vec<String> =
                (0..s.len()).filter(|&i| s[i] < 3.2).map(|i| format!("{:.3}:{:.4}", s[i], extra[i])).collect();
            println!("nu {nu} lean {lean_deg:>4}: {}", shown.join(" "));
        }
    }
}
