#!/usr/bin/env python3
"""Writes first inputs for the readers of meshes: one to eight elements of each kind, in all four flavours of `.msh`.

usage: fuzz/seeds.py FOLDER
"""
import math
import struct
import sys
from pathlib import Path

# Gmsh's element types with corners, edges and faces in its order of nodes.
HEX = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
       [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)],
       [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)])
TET = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3)], [])
WEDGE = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
         [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5)], [])
KINDS = {"hex8": (5, HEX, 0), "hex20": (17, HEX, 1), "hex27": (12, HEX, 2), "tet4": (4, TET, 0), "tet10": (11, TET, 1),
         "wedge6": (6, WEDGE, 0), "wedge15": (18, WEDGE, 1)}


def middle(points):
    return tuple(sum(p[k] for p in points) / len(points) for k in range(3))


def single(kind):
    """One element and, of a tetrahedron or wedge, a face of three corners; of a hexahedron one of four."""
    code, (corners, edges, faces), order = KINDS[kind]
    nodes = [tuple(10 + x for x in c) for c in corners]
    corners = list(nodes)
    if order:
        nodes += [middle([corners[i] for i in e]) for e in edges]
    if order == 2:
        nodes += [middle([corners[i] for i in f]) for f in faces] + [middle(corners)]
    face = (3, [1, 4, 3, 2]) if len(corners) == 8 else (2, [1, 3, 2])
    surfaces = {} if order else {"bore": [face]}
    return nodes, [(code, list(range(1, len(nodes) + 1)))], surfaces


def sector(around=2):
    """A third of a ring with the groups of one tooth."""
    nodes, at = [], {}
    for i in range(around + 1):
        angle = math.radians(-60 + 120 * i / around)
        for j, r in enumerate((5, 10)):
            for k, z in enumerate((-1, 1)):
                nodes.append((round(r * math.cos(angle), 3), round(r * math.sin(angle), 3), z))
                at[i, j, k] = len(nodes)
    cells, groups = [], {name: [] for name in ("bore", "cut_0", "cut_1", "flank_left_0", "flank_right_0")}
    for i in range(around):
        cells.append((5, [at[a, b, c] for c in (0, 1) for a, b in ((i, 0), (i, 1), (i + 1, 1), (i + 1, 0))]))
        groups["bore"].append((3, [at[i, 0, 0], at[i + 1, 0, 0], at[i + 1, 0, 1], at[i, 0, 1]]))
        side = "flank_right_0" if i < around / 2 else "flank_left_0"
        groups[side].append((3, [at[i, 1, 0], at[i + 1, 1, 0], at[i + 1, 1, 1], at[i, 1, 1]]))
    for name, i in (("cut_0", 0), ("cut_1", around)):
        groups[name].append((3, [at[i, 0, 0], at[i, 1, 0], at[i, 1, 1], at[i, 0, 1]]))
    return nodes, cells, groups


def names(groups):
    all_names = [(2, i + 1, name) for i, name in enumerate(groups)] + [(3, len(groups) + 1, "gear")]
    rows = "".join(f'{d} {t} "{n}"\n' for d, t, n in all_names)
    return f"$PhysicalNames\n{len(all_names)}\n{rows}$EndPhysicalNames\n".encode()


def head(version, binary):
    one = struct.pack("<i", 1) + b"\n" if binary else b""
    return f"$MeshFormat\n{version} {int(binary)} 8\n".encode() + one + b"$EndMeshFormat\n"


def v2(mesh, binary):
    nodes, cells, groups = mesh
    runs = [(cells, len(groups) + 1)] + [(faces, i + 1) for i, faces in enumerate(groups.values())]
    out = head("2.2", binary) + names(groups) + f"$Nodes\n{len(nodes)}\n".encode()
    for tag, x in enumerate(nodes, 1):
        out += struct.pack("<i3d", tag, *x) if binary else f"{tag} {x[0]} {x[1]} {x[2]}\n".encode()
    out += b"$EndNodes\n$Elements\n" + f"{sum(len(r) for r, _ in runs)}\n".encode()
    tag = 0
    for run, group in runs:
        if binary and run:
            out += struct.pack("<3i", run[0][0], len(run), 2)
        for code, of in run:
            tag += 1
            words = [tag, group, group] + of
            out += struct.pack(f"<{len(words)}i", *words) if binary else \
                f"{tag} {code} 2 {group} {group} {' '.join(map(str, of))}\n".encode()
    return out + b"$EndElements\n"


def v4(mesh, binary):
    nodes, cells, groups = mesh
    out = head("4.1", binary) + names(groups) + b"$Entities\n"
    ints = lambda *w: struct.pack(f"<{len(w)}i", *w) if binary else (" ".join(map(str, w)) + " ").encode()
    sizes = lambda *w: struct.pack(f"<{len(w)}Q", *w) if binary else (" ".join(map(str, w)) + " ").encode()
    reals = lambda *w: struct.pack(f"<{len(w)}d", *w) if binary else (" ".join(map(str, w)) + " ").encode()
    end = b"" if binary else b"\n"
    out += sizes(0, 0, len(groups), 1) + end
    for i in range(len(groups)):
        out += ints(i + 1) + reals(0, 0, 0, 1, 1, 1) + sizes(1) + ints(i + 1) + sizes(0) + end
    out += ints(1) + reals(0, 0, 0, 1, 1, 1) + sizes(1) + ints(len(groups) + 1) + sizes(1) + ints(1) + end
    out += b"$EndEntities\n$Nodes\n" + sizes(1, len(nodes), 1, len(nodes)) + end
    out += ints(3, 1, 0) + sizes(len(nodes)) + end
    out += b"".join(sizes(t) + end for t in range(1, len(nodes) + 1))
    out += b"".join(reals(*x) + end for x in nodes) + b"$EndNodes\n$Elements\n"
    runs = [(3, 1, cells)] + [(2, i + 1, faces) for i, faces in enumerate(groups.values()) if faces]
    total = sum(len(r) for _, _, r in runs)
    out += sizes(len(runs), total, 1, total) + end
    tag = 0
    for dimension, entity, run in runs:
        out += ints(dimension, entity, run[0][0]) + sizes(len(run)) + end
        for _, of in run:
            tag += 1
            out += sizes(tag, *of) + end
    return out + b"$EndElements\n"


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    meshes = {kind: single(kind) for kind in KINDS} | {"sector": sector(), "sector8": sector(8)}
    for name, mesh in meshes.items():
        for flavour, write in (("v2", v2), ("v4", v4)):
            for binary in (False, True):
                file = folder / f"{name}_{flavour}_{'binary' if binary else 'text'}.msh"
                file.write_bytes(write(mesh, binary))


main()
