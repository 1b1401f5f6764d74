#!/usr/bin/env python3
"""Nodal stress in the root fillets under given nodal forces, by CalculiX: the numbers in ../root_stress.rs.

    apt-get install calculix-ccx; pip install gmsh numpy
    python3 root_stress_ccx.py [FOLDER]         prints one JSON object; writes decks and results into FOLDER

The same load goes onto both programs, so contact plays no part: 1000 N along (0.3, -0.9, 0.3)/|.|, in equal shares on the
nodes of `flank_left_0` whose radius is 47.0 .. 48.5 mm; bore held; the sectors' cuts free; E 206000 MPa, nu 0.3.
Read from the .frd file: nodal stress, which CalculiX extrapolates from the Gauss points and averages over the elements of
a node. Fillet nodes: on boundary faces other than bore, end faces, cuts; root radius - 0.06 mm <= r <= 45.0349 mm, where the
fillet's tangent makes 20 deg with the tooth's centre line; on no flank.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import gmsh
import numpy as np

MESHES = Path(__file__).resolve().parents[3] / "meshes"
CASES = [  # mesh, element of CalculiX
    ("reference/ref_qcoarse_hex20_g1.msh", "C3D20R"),
    ("reference/ref_qcoarse_hex20_g1.msh", "C3D20"),
    ("reference/ref_coarse_hex8_g1.msh", "C3D8I"),
    ("sector3_tet10.msh", "C3D10"),
    ("sector3_tet4.msh", "C3D4"),
]
UPPER_RADIUS, ROOT_RADIUS, TWIST = 45.0349, 44.1381, np.tan(np.radians(20)) / 47.88799976
BAND, FORCE = (47.0, 48.5), 1000.0 * np.array([0.3, -0.9, 0.3]) / np.linalg.norm([0.3, -0.9, 0.3])
ORDER = {  # Gmsh type: (nodes in CalculiX's order, corners of the faces)
    5: (list(range(8)), [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]),
    17: (list(range(8)) + [8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
         [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]),
    4: (list(range(4)), [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)]),
    11: (list(range(4)) + [4, 5, 6, 7, 9, 8], [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)]),
}


def read(path):
    """Nodes by tag, elements, their Gmsh type, and the nodes of each surface group."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    nodes = dict(zip((int(t) for t in tags), xyz.reshape(-1, 3)))
    (kind,), _, (connectivity,) = gmsh.model.mesh.getElements(3)
    count = gmsh.model.mesh.getElementProperties(kind)[3]
    elements = connectivity.reshape(-1, count).astype(int)
    groups = {}
    for dim, tag in gmsh.model.getPhysicalGroups(2):
        of = set(int(t) for t in gmsh.model.mesh.getNodesForPhysicalGroup(dim, tag)[0])
        groups[gmsh.model.getPhysicalName(dim, tag)] = of
    gmsh.finalize()
    return nodes, elements, kind, groups


def fillet_nodes(nodes, elements, kind, groups):
    """Nodes of the left and right fillet of tooth 0."""
    order, faces = ORDER[kind]
    seen = {}
    for element in elements:
        for face in faces:
            key = tuple(sorted(element[list(face)]))
            seen[key] = seen.get(key, 0) + 1
    corners = set()
    away = [groups[name] for name in groups if name == "bore" or name.startswith(("side", "cut"))]
    for key in (k for k, n in seen.items() if n == 1):
        if not any(all(n in group for n in key) for group in away):
            corners.update(key)
    # A mid-side node is on the surface when its edge is: taken by radius, end planes and inner nodes have been left out.
    flank = set().union(*(groups[n] for n in groups if n.startswith("flank")))
    surface = {"left": [], "right": []}
    edge_nodes = set()
    corner_count = {5: 8, 17: 8, 4: 4, 11: 4}[kind]
    if len(order) > corner_count:
        pairs = {17: [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)],
                 11: [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]}[kind]
        boundary_edges = set()
        for key, n in seen.items():
            if n == 1 and not any(all(c in group for c in key) for group in away):
                boundary_edges.update((a, b) for a in key for b in key if a < b)
        for element in elements:
            for k, (a, b) in enumerate(pairs):
                if tuple(sorted((element[a], element[b]))) in boundary_edges:
                    edge_nodes.add(int(element[corner_count + k]))
    for tag in (corners | edge_nodes) - flank:
        x, y, z = nodes[tag]
        if not ROOT_RADIUS - 0.06 <= np.hypot(x, y) <= UPPER_RADIUS + 3e-4:
            continue
        off = (np.arctan2(y, x) - TWIST * z) / (2 * np.pi / 30)
        if abs(off) <= 0.5 + 1e-6:
            surface["left" if off > 0 else "right"].append(int(tag))
    return surface


def solve(nodes, elements, kind, groups, element_type, folder):
    """Nodal stress (xx, yy, zz, xy, yz, zx) by tag."""
    loaded = [t for t in groups["flank_left_0"] if BAND[0] <= np.hypot(*nodes[t][:2]) <= BAND[1]]
    # CalculiX reads at most 20 characters a number.
    deck = ["*NODE, NSET=ALL"] + [f"{t}, {x:.12e}, {y:.12e}, {z:.12e}" for t, (x, y, z) in nodes.items()]
    deck += [f"*ELEMENT, TYPE={element_type}, ELSET=GEAR"]
    for number, element in enumerate(elements, 1):
        words = [str(number)] + [str(t) for t in element[ORDER[kind][0]]]
        deck += [", ".join(words[:11]) + ("," if len(words) > 11 else "")]
        if len(words) > 11:
            deck += [", ".join(words[11:])]
    deck += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "206000., 0.3", "*SOLID SECTION, ELSET=GEAR, MATERIAL=STEEL"]
    deck += ["*BOUNDARY"] + [f"{t}, 1, 3, 0." for t in sorted(groups["bore"])]
    deck += ["*STEP", "*STATIC", "*CLOAD"]
    deck += [f"{t}, {k + 1}, {FORCE[k] / len(loaded):.12e}" for t in sorted(loaded) for k in range(3)]
    deck += ["*NODE FILE", "U", "*EL FILE", "S", "*END STEP", ""]
    (folder / "deck.inp").write_text("\n".join(deck))
    # The exit status is no measure: 2.20 ends with 201 after warnings.
    said = subprocess.run(["ccx", "deck"], cwd=folder, check=False, capture_output=True, text=True).stdout
    if "Job finished" not in said:
        raise RuntimeError(said[-2000:])
    stress, inside = {}, False
    for line in (folder / "deck.frd").read_text().splitlines():
        if line.startswith(" -4  STRESS"):
            inside = True
        elif inside and line.startswith(" -1"):
            stress[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(6)]
        elif inside and line.startswith(" -3"):
            break
    return stress, len(loaded)


def main():
    result = []
    for mesh, element_type in CASES:
        nodes, elements, kind, groups = read(MESHES / mesh)
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(sys.argv[1]) / element_type if len(sys.argv) > 1 else Path(scratch)
            folder.mkdir(parents=True, exist_ok=True)
            stress, loaded = solve(nodes, elements, kind, groups, element_type, folder)
        case = {"mesh": mesh, "element": element_type, "loaded_nodes": loaded}
        for side, tags in fillet_nodes(nodes, elements, kind, groups).items():
            tensors = {t: stress[t] for t in sorted(tags)}
            full = {t: np.array([[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]]) for t, s in tensors.items()}
            principal = {t: np.linalg.eigvalsh(m) for t, m in full.items()}
            mises = {t: np.sqrt(1.5 * ((m - np.trace(m) / 3 * np.eye(3)) ** 2).sum()) for t, m in full.items()}
            top = max(principal, key=lambda t: principal[t][2])
            low = min(principal, key=lambda t: principal[t][0])
            most = max(mises, key=mises.get)
            case[side] = {
                "nodes": len(tags),
                "max_principal": [round(float(principal[top][2]), 4), top],
                "min_principal": [round(float(principal[low][0]), 4), low],
                "von_mises": [round(float(mises[most]), 4), most],
            }
        result.append(case)
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
