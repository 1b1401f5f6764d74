#!/usr/bin/env python3
"""A pinion cut into the overhung end of its shaft, one solid, against a wheel on a rigid bore, by CalculiX: the numbers in
crates/analysis/tests/data/overhung_pinion.json, and the mesh of hub and shaft in one that the same test reads.

    apt-get install calculix-ccx; pip install gmsh numpy
    python3 overhung_pinion_ccx.py ALE_GEAR FOLDER [--helix 0] [--turn 0.0052] [--profile 28] [--face 16]

ALE_GEAR makes the meshes of single teeth (`ale-gear mesh generate`); all else is made here. z along the shaft, 0 at
mid-face:

     input   far bearing                         near bearing   stub     face
    -185        -165            (160 mm)             -45        -30   -15 .. 15          outer 45, inner 16 mm

* Pinion: all teeth, each a copy of one sector; loaded ones with fine layers along the profile and towards the flank. Rim
  and shaft are one mesh from the bearing side of the face to its free end; at z = -30 a coarser shaft goes on.
* Bearings: area-weighted mean displacements of a section, on springs of 1e6 N/mm along x and y; the far one holds z.
* Input: the area-weighted mean turn of the end section about z is given; its torque is read.
* Wheel: five teeth, bore held, cut faces free.
* Contact: surface to surface, frictionless, 1e7 MPa/mm; every layer of elements along the face is a contact pair of
  its own, so that CalculiX itself sums the force of each strip.

Results: JSON with torque, force of each strip, mean displacement and turn (area-weighted least squares) of the section at
z = -30 and of the hub (the circle of the shaft's diameter under the teeth).
"""

import argparse
import json
import subprocess
from pathlib import Path

import gmsh
import numpy as np

TEETH, MODULE, FACE = (21, 32), 3.0, 30.0
SHAFT, HOLE, WHEEL_BORE = 45.0, 16.0, 70.0
INPUT, FAR, NEAR, STUB = -185.0, -165.0, -45.0, -30.0
RADII, AROUND = [0.5 * HOLE, 0.5 * HOLE + 7.0, 0.5 * SHAFT], 24
BEARING, PENALTY, YOUNG, POISSON = 1e6, 1e7, 206000.0, 0.3
# Gmsh's hex20 in CalculiX's order; its faces S1 .. S6 by corners.
ORDER = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]
CCX_FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
EDGES = {(0, 1): 8, (0, 3): 9, (0, 4): 10, (1, 2): 11, (1, 5): 12, (2, 3): 13, (2, 6): 14, (3, 7): 15, (4, 5): 16,
         (4, 7): 17, (5, 6): 18, (6, 7): 19}

SCENE = """
[pinion]
teeth = {z1}
helix_angle_deg = {helix}
bore_diameter_mm = {shaft}
[pinion.mesher]
elements_profile = {profile}
elements_fillet = 2
elements_thickness = 4
elements_face = {face}
elements_rim = 2
sector_teeth = 1
[wheel]
teeth = {z2}
bore_diameter_mm = {bore}
[wheel.mesher]
elements_profile = {profile}
elements_fillet = 2
elements_thickness = 4
elements_face = {face}
elements_rim = 2
sector_teeth = 1
[pair]
normal_module_mm = {module}
face_width_mm = {width}
[operation]
torque_nm = 300.0
"""


def mid(a, b):
    """Local number of the node between two corners of a hex20."""
    return EDGES[(min(a, b), max(a, b))]


def sector(ale_gear, folder, which, profile, face, helix):
    """Nodes and hex20 (Gmsh's order) of one tooth, and its surface groups as sets of nodes."""
    scene, mesh = folder / f"tooth_{profile}.toml", folder / f"{which}_{profile}.msh"
    scene.write_text(SCENE.format(z1=TEETH[0], z2=TEETH[1], helix=helix, shaft=SHAFT, bore=WHEEL_BORE, profile=profile,
                                  face=face, module=MODULE, width=FACE))
    subprocess.run([ale_gear, "mesh", "generate", scene, "--gear", which, "-o", mesh], check=True, capture_output=True)
    return read(mesh)


def read(mesh):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(mesh))
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    number = {int(t): i for i, t in enumerate(tags)}
    (kind,), _, (connectivity,) = gmsh.model.mesh.getElements(3)
    assert kind == 17, "hex20"
    elements = np.array([number[int(t)] for t in connectivity]).reshape(-1, 20)
    groups = {}
    for dim, tag in gmsh.model.getPhysicalGroups(2):
        of = gmsh.model.mesh.getNodesForPhysicalGroup(dim, tag)[0]
        groups[gmsh.model.getPhysicalName(dim, tag)] = {number[int(t)] for t in of}
    gmsh.finalize()
    return xyz.reshape(-1, 3).copy(), elements, groups


def turned(xyz, angle):
    """Positions turned about z by an angle, or by one a node."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = xyz.T
    return np.column_stack([c * x - s * y, s * x + c * y, z])


def twist(z, which, helix):
    """Angle by which a section of the pinion or wheel is turned against that at mid-face."""
    reference = 0.5 * MODULE / np.cos(np.radians(helix)) * TEETH[which]
    sense = 1.0 if which == 0 else -1.0
    return sense * np.clip(z, -0.5 * FACE, 0.5 * FACE) * np.tan(np.radians(helix)) / reference


def towards_left_flank(xyz, groups, which, helix):
    """Moves the inner lines of a tooth towards its left flank, between form circle and tip; flanks and root stay."""
    angle = twist(xyz[:, 2], which, helix)
    flat = turned(xyz, -angle)
    on_flank = np.array(sorted(groups["flank_left_0"]))
    radii = np.hypot(flat[:, 0], flat[:, 1])
    low, high = radii[on_flank].min(), radii[on_flank].max()
    line = flat[on_flank[np.abs(flat[on_flank, 2] - flat[on_flank, 2].min()) < 1e-6]]
    line = line[np.argsort(line[:, 0])]
    half = np.interp(flat[:, 0], line[:, 0], line[:, 1])
    # Inside of the tooth, above the lowest point of the flank.
    inside = (flat[:, 0] > line[0, 0] + 1e-9) & (np.abs(flat[:, 1]) < half * (1 + 1e-9))
    rise = np.clip((flat[:, 0] - line[0, 0]) / (0.3 * (high - low)), 0.0, 1.0)
    amount = 0.42 * rise**2 * (3 - 2 * rise)
    corners = np.linspace(-1, 1, 5)
    s = np.where(inside, flat[:, 1] / np.maximum(half, 1e-9), 0.0)
    k = np.clip(np.floor((s + 1) / 0.5).astype(int), 0, 3)
    g = lambda at: at + amount * (1 - at**2)
    part = (s - corners[k]) / 0.5
    new = (1 - part) * g(corners[k]) + part * g(corners[k + 1])
    flat[inside, 1] = (new * half)[inside]
    return turned(flat, angle)


class Body:
    """Nodes and hex20 elements, nodes at one place made one."""

    def __init__(self):
        self.parts, self.elements, self.count, self.tooth_of = [], [], 0, []

    def add(self, xyz, elements, label):
        self.parts.append(xyz)
        self.elements.append(elements + self.count)
        self.tooth_of += [label] * len(elements)
        self.count += len(xyz)

    def close(self):
        xyz, elements = np.vstack(self.parts), np.vstack(self.elements)
        # Two roundings, so that nodes on the edge of a cell of one are inside of a cell of the other.
        parent = np.arange(len(xyz))
        for shift in (0.0, 0.5):
            _, first, inverse = np.unique(np.floor(xyz / 2e-4 + shift).astype(np.int64), axis=0, return_index=True,
                                          return_inverse=True)
            parent = np.minimum(parent, first[inverse.ravel()])
        while True:
            further = parent[parent]
            if (further == parent).all():
                break
            parent = further
        kept, number = np.unique(parent, return_inverse=True)
        elements = number[elements]
        used = np.unique(elements)
        renumber = np.full(len(kept), -1)
        renumber[used] = np.arange(len(used))
        self.xyz, self.hexes, self.labels = xyz[kept][used], renumber[elements], np.array(self.tooth_of)
        return self

    def faces(self, wanted):
        """Element, CalculiX's number and the eight nodes of each face whose four corners are all wanted."""
        found = []
        for number, corners in enumerate(CCX_FACES, 1):
            of = self.hexes[:, list(corners)]
            for element in np.nonzero(wanted[of].all(axis=1))[0]:
                middles = [mid(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
                found.append((int(element), number, self.hexes[element][list(corners) + middles]))
        return found


def grid(angles, radii, heights, turn):
    """Hex20 between cylinders; the lists have the middles of the elements too; angles close on themselves, or not."""
    closed = np.isclose(angles[-1] - angles[0], 2 * np.pi)
    na, nr, nz = len(angles) - (1 if closed else 0), len(radii), len(heights)
    at = lambda i, j, k: (k * nr + j) * na + (i % na if closed else i)
    a, r, z = np.array(angles[:na]), np.array(radii), np.array(heights)
    zz, rr, aa = np.meshgrid(z, r, a, indexing="ij")
    aa = aa + turn(zz)
    xyz = np.column_stack([(rr * np.cos(aa)).ravel(), (rr * np.sin(aa)).ravel(), zz.ravel()])
    # Corners counter-clockwise seen against the third direction (radius, angle, z: right-handed).
    corner = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    place = corner + [None] * 12
    for (p, q), local in EDGES.items():
        place[local] = tuple((u + v) // 2 for u, v in zip(corner[p], corner[q]))
    elements = [[at(i + di, j + dj, k + dk) for dj, di, dk in place]
                for k in range(0, nz - 1, 2) for j in range(0, nr - 1, 2) for i in range(0, len(angles) - 1, 2)]
    return xyz, np.array(elements)


def middles(ends):
    """A list of ends with the middles between them."""
    out = [ends[0]]
    for a, b in zip(ends, ends[1:]):
        out += [0.5 * (a + b), b]
    return out


def pinion(ale_gear, folder, args, coarse):
    """The whole pinion with its stub."""
    body = Body()
    plain = sector(ale_gear, folder, "pinion", coarse, args.face, args.helix)
    fine = sector(ale_gear, folder, "pinion", args.profile, args.face, args.helix)
    fine_xyz = towards_left_flank(fine[0], fine[2], 0, args.helix)
    pitch = 2 * np.pi / TEETH[0]
    for tooth in range(TEETH[0]):
        loaded = tooth in args.teeth or tooth - TEETH[0] in args.teeth
        xyz, elements = (fine_xyz, fine[1]) if loaded else plain[:2]
        body.add(turned(xyz, tooth * pitch), elements, tooth if 2 * tooth < TEETH[0] else tooth - TEETH[0])
    xyz, elements = core(plain, args, whole=True)
    body.add(xyz, elements, 1000)
    return body.close()


def core(plain, args, whole):
    """Shaft under the teeth and the stub to z = -30, of all teeth or of one."""
    xyz, _, groups = plain
    bore = xyz[sorted(groups["bore"])]
    ring = bore[np.abs(bore[:, 2]) == np.abs(bore[:, 2]).min()]
    own = np.sort(np.arctan2(ring[:, 1], ring[:, 0]) - twist(ring[:, 2], 0, args.helix))
    pitch = 2 * np.pi / TEETH[0]
    teeth = TEETH[0] if whole else 1
    assert abs(own[-1] - own[0] - pitch) < 1e-9, (own[-1] - own[0], pitch)
    angles = np.concatenate([own[:-1] + k * pitch for k in range(teeth)] + [[own[-1] + (teeth - 1) * pitch]])
    face = list(np.linspace(-0.5 * FACE, 0.5 * FACE, 2 * args.face + 1))
    heights = middles([STUB, -26.0, -21.5, -17.5, -0.5 * FACE])[:-1] + face
    radii = middles(RADII)
    return grid(angles, radii, heights, lambda z: twist(z, 0, args.helix))


def wheel(ale_gear, folder, args, coarse):
    """Five teeth of the wheel."""
    body = Body()
    plain = sector(ale_gear, folder, "wheel", coarse, args.face, args.helix)
    fine = sector(ale_gear, folder, "wheel", args.profile, args.face, args.helix)
    fine_xyz = towards_left_flank(fine[0], fine[2], 1, args.helix)
    for tooth in range(-2, 3):
        xyz, elements = (fine_xyz, fine[1]) if -tooth in args.teeth else plain[:2]
        body.add(turned(xyz, tooth * 2 * np.pi / TEETH[1]), elements, tooth)
    return body.close()


def on_left_flank(body, tooth, which, helix):
    """Which nodes are on the left flank of a tooth: on the involute, between form and tip circle."""
    gear = turned(body.xyz, -twist(body.xyz[:, 2], which, helix) - tooth * 2 * np.pi / TEETH[which])
    mt = MODULE / np.cos(np.radians(helix))
    at = np.arctan(np.tan(np.radians(20)) / np.cos(np.radians(helix)))
    base = 0.5 * mt * TEETH[which] * np.cos(at)
    r = np.hypot(gear[:, 0], gear[:, 1])
    u = np.sqrt(np.maximum((r / base) ** 2 - 1, 0))
    sigma = np.pi / (2 * TEETH[which]) + np.tan(at) - at
    off = r * (np.arctan2(gear[:, 1], gear[:, 0]) - (sigma - (u - np.arctan(u))))
    return (np.abs(off) < 2e-6) & (r > base)


def shape(a, b):
    """Shape functions of an eight-node quadrilateral and their slopes."""
    pa, pb = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    n, da, db = np.zeros(8), np.zeros(8), np.zeros(8)
    for i in range(4):
        x, y = 1 + a * pa[i], 1 + b * pb[i]
        t = a * pa[i] + b * pb[i] - 1
        n[i] = 0.25 * x * y * t
        da[i] = 0.25 * pa[i] * y * (t + x)
        db[i] = 0.25 * pb[i] * x * (t + y)
    for i, (qa, qb) in enumerate([(0, -1), (1, 0), (0, 1), (-1, 0)], 4):
        if qa == 0:
            n[i], da[i], db[i] = 0.5 * (1 - a * a) * (1 + b * qb), -a * (1 + b * qb), 0.5 * (1 - a * a) * qb
        else:
            n[i], da[i], db[i] = 0.5 * (1 + a * qa) * (1 - b * b), 0.5 * qa * (1 - b * b), -b * (1 + a * qa)
    return n, da, db


def weights(xyz, faces):
    """Integral of the shape functions over faces, by node."""
    of, gauss = {}, [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]
    for _, _, nodes in faces:
        x = xyz[nodes]
        for a, wa in gauss:
            for b, wb in gauss:
                n, da, db = shape(a, b)
                area = np.linalg.norm(np.cross(da @ x, db @ x)) * wa * wb
                for node, value in zip(nodes, n * area):
                    of[int(node)] = of.get(int(node), 0.0) + value
    return of


def mean_motion(xyz, of, u):
    """Area-weighted least squares of a rigid motion: mean displacement and turn at the mean place, and that place."""
    nodes = np.array(sorted(of))
    w = np.array([of[n] for n in nodes])
    x, v = xyz[nodes], u[nodes]
    centre = (w @ x) / w.sum()
    d = x - centre
    mean = (w @ v) / w.sum()
    moment = (w[:, None] * np.cross(d, v)).sum(axis=0)
    inertia = (w * (d**2).sum(axis=1)).sum() * np.eye(3) - np.einsum("i,ij,ik->jk", w, d, d)
    return centre, mean, np.linalg.solve(inertia, moment)


def write_lines(out, head, numbers):
    out.append(head)
    for i in range(0, len(numbers), 15):
        out.append(", ".join(str(n) for n in numbers[i:i + 15]) + ",")


def equation(out, terms):
    """sum of coefficient times displacement = 0; the largest one first, which CalculiX eliminates."""
    first = max(range(len(terms)), key=lambda i: abs(terms[i][2]) if terms[i][0] < FIRST_OWN[0] else 0.0)
    terms = [terms[first]] + terms[:first] + terms[first + 1:]
    out += ["*EQUATION", str(len(terms))]
    words = [f"{n}, {axis}, {c:.10e}" for n, axis, c in terms]
    out += [", ".join(words[i:i + 4]) for i in range(0, len(words), 4)]


def joined(xyz, faces, coarse):
    """For each node of some faces in the plane z = STUB: nodes of the coarser section and their shape functions."""
    lines, rings = np.linspace(0, 2 * np.pi, AROUND + 1), np.array(RADII)
    at_place = {}
    for n in np.nonzero(np.abs(coarse[:, 2] - STUB) < 1e-6)[0]:
        half = round(np.arctan2(coarse[n, 1], coarse[n, 0]) / (np.pi / AROUND)) % (2 * AROUND)
        at_place[(half, round(float(np.hypot(*coarse[n, :2])), 4))] = int(n)
    found = {}
    for n in sorted({int(n) for face in faces for n in face[2]}):
        angle, radius = np.arctan2(xyz[n, 1], xyz[n, 0]) % (2 * np.pi), np.hypot(*xyz[n, :2])
        i = min(int(angle / lines[1]), AROUND - 1)
        j = min(max(int(np.searchsorted(rings, radius - 1e-9)) - 1, 0), len(rings) - 2)
        low, high = rings[j], rings[j + 1]
        a, b = 2 * (angle - lines[i]) / lines[1] - 1, 2 * (radius - low) / (high - low) - 1
        middle = round(0.5 * (low + high), 4)
        half, low, high = 2 * i, round(low, 4), round(high, 4)
        keys = [(half, low), (half + 2, low), (half + 2, high), (half, high),
                (half + 1, low), (half + 2, middle), (half + 1, high), (half, middle)]
        terms = zip([at_place[(k % (2 * AROUND), r)] for k, r in keys], shape(a, b)[0])
        found[n] = [(m, w) for m, w in terms if abs(w) > 1e-14]
    return found


def write_sector(ale_gear, folder, args, path):
    """One tooth of the pinion with its part of shaft and stub, as a periodic sector whose bore is the stub's end."""
    plain = sector(ale_gear, folder, "pinion", args.profile, args.face, args.helix)
    body = Body()
    body.add(plain[0], plain[1], 0)
    body.add(*core(plain, args, whole=False), 1000)
    body.close()
    flat = turned(body.xyz, -twist(body.xyz[:, 2], 0, args.helix))
    radius, angle = np.hypot(flat[:, 0], flat[:, 1]), np.arctan2(flat[:, 1], flat[:, 0])
    owners = {}
    for number in range(len(CCX_FACES)):
        for element, nodes in enumerate(body.hexes[:, list(CCX_FACES[number])]):
            owners.setdefault(tuple(sorted(nodes)), []).append((element, number))
    half = np.pi / TEETH[0]
    masks = {"bore": np.abs(body.xyz[:, 2] - STUB) < 1e-6, "cut_0": np.abs(angle + half) * radius < 1e-5,
             "cut_1": np.abs(angle - half) * radius < 1e-5, "flank_left_0": on_left_flank(body, 0, 0, args.helix)}
    mirror = Body()
    mirror.xyz, mirror.hexes = body.xyz * [1, -1, 1], body.hexes
    masks["flank_right_0"] = on_left_flank(mirror, 0, 0, -args.helix)
    groups = {}
    for name, mask in masks.items():
        faces = []
        for element, number, nodes in body.faces(mask):
            if len(owners[tuple(sorted(nodes[:4]))]) == 1:
                faces.append(nodes)
        groups[name] = faces
    out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups) + 1)]
    out += [f'2 {k} "{name}"' for k, name in enumerate(groups, 1)] + ['3 99 "gear"', "$EndPhysicalNames"]
    out += ["$Nodes", str(len(body.xyz))] + [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(body.xyz.tolist(), 1)]
    out += ["$EndNodes", "$Elements", str(len(body.hexes) + sum(map(len, groups.values())))]
    number = 1
    for k, faces in enumerate(groups.values(), 1):
        for nodes in faces:
            out.append(f"{number} 16 2 {k} {k} " + " ".join(str(n + 1) for n in nodes))
            number += 1
    for nodes in body.hexes:
        out.append(f"{number} 17 2 99 1 " + " ".join(str(n + 1) for n in nodes))
        number += 1
    text = path.with_suffix(".txt.msh")
    text.write_text("\n".join(out + ["$EndElements", ""]))
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.open(str(text))
    gmsh.write(str(path))
    gmsh.finalize()
    text.unlink()
    print(json.dumps({"nodes": len(body.xyz), "elements": len(body.hexes), **{k: len(v) for k, v in groups.items()}}))


FIRST_OWN = [0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ale_gear")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--helix", type=float, default=0.0)
    parser.add_argument("--turn", type=float, default=0.0052)
    parser.add_argument("--profile", type=int, default=28)
    parser.add_argument("--face", type=int, default=16)
    parser.add_argument("--coarse", type=int, default=2)
    parser.add_argument("--teeth", type=lambda t: [int(k) for k in t.split(",")], default=[0])
    parser.add_argument("--element", default="C3D20R")
    parser.add_argument("--sector", type=Path, help="write the mesh of one tooth with its part of the shaft, no more")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    if args.sector:
        write_sector(args.ale_gear, args.folder, args, args.sector)
        return
    bodies = [pinion(args.ale_gear, args.folder, args, args.coarse), wheel(args.ale_gear, args.folder, args, args.coarse)]
    shaft = Body()
    ends = [STUB, -35.0, -40.0, NEAR] + list(np.linspace(NEAR, FAR, 16)[1:]) + [-172.0, -178.0, INPUT]
    shaft.add(*grid(np.linspace(0, 2 * np.pi, 2 * AROUND + 1), middles(RADII),
                    middles(ends[::-1]), lambda z: 0 * z), 2000)
    shaft.close()
    flank = [on_left_flank(b, 0, i, args.helix) for i, b in enumerate(bodies)]
    mt = MODULE / np.cos(np.radians(args.helix))
    distance = 0.5 * mt * sum(TEETH)
    # Both left flanks meet in the pitch point.
    angle = [-0.5 * np.pi / TEETH[0], np.pi - 0.5 * np.pi / TEETH[1]]
    place = [lambda x: turned(x, angle[0]), lambda x: turned(x, angle[1]) + [distance, 0, 0]]
    stations = [place[0](bodies[0].xyz), place[1](bodies[1].xyz), place[0](shaft.xyz)]
    counts = [len(s) for s in stations]
    start = [1, 1 + counts[0], 1 + counts[0] + counts[1]]
    own = 1 + sum(counts)
    FIRST_OWN[0] = own
    out = ["*NODE, NSET=ALL"]
    for first, xyz in zip(start, stations):
        out += [f"{first + i}, {x:.12e}, {y:.12e}, {z:.12e}" for i, (x, y, z) in enumerate(xyz)]
    names = ["pinion", "wheel", "shaft"]
    numbers, element = [], 1
    for name, first, body in zip(names, start, bodies + [shaft]):
        numbers.append(element)
        out.append(f"*ELEMENT, TYPE={args.element}, ELSET={name}")
        for nodes in body.hexes:
            words = [str(element)] + [str(first + n) for n in nodes[ORDER]]
            out += [", ".join(words[:11]) + ",", ", ".join(words[11:])]
            element += 1
    # 1, 2: springs of near and far bearing; 3: turn of the input.
    near, far, turn = own, own + 1, own + 2
    out += ["*NODE, NSET=OWN"] + [f"{n}, 0., 0., {z}" for n, z in [(near, NEAR), (far, FAR), (turn, INPUT)]]
    for k, (node, axis) in enumerate([(near, 1), (near, 2), (far, 1), (far, 2)]):
        out += [f"*ELEMENT, TYPE=SPRING1, ELSET=spring{k}", f"{element}, {node}", f"*SPRING, ELSET=spring{k}", f"{axis}",
                f"{BEARING:.6e}"]
        element += 1
    out += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG}, {POISSON}"]
    out += [f"*SOLID SECTION, ELSET={name}, MATERIAL=STEEL" for name in names]
    # Sections of the shaft.
    section = {}
    for name, z in [("near", NEAR), ("far", FAR), ("input", INPUT)]:
        wanted = np.abs(shaft.xyz[:, 2] - z) < 1e-6
        by_plane = {}
        for face in shaft.faces(wanted):
            by_plane[tuple(sorted(face[2]))] = face
        section[name] = weights(stations[2], by_plane.values())
    for name, node in [("near", near), ("far", far)]:
        area = sum(section[name].values())
        for axis in (1, 2):
            terms = [(start[2] + n, axis, w / area) for n, w in section[name].items()]
            equation(out, terms + [(node, axis, -1.0)])
    area = sum(section["far"].values())
    equation(out, [(start[2] + n, 3, w / area) for n, w in section["far"].items()] + [(far, 3, -1.0)])
    of = section["input"]
    polar = sum(w * (stations[2][n, :2] ** 2).sum() for n, w in of.items())
    terms = [(start[2] + n, 1, -w * stations[2][n, 1] / polar) for n, w in of.items()]
    terms += [(start[2] + n, 2, w * stations[2][n, 0] / polar) for n, w in of.items()]
    equation(out, [t for t in terms if t[2] != 0.0] + [(turn, 1, -1.0)])
    # The two meshes of the shaft at z = -30: the finer one's nodes go with the faces of the coarser one.
    stub = bodies[0].faces(np.abs(bodies[0].xyz[:, 2] - STUB) < 1e-6)
    section["stub"] = weights(stations[0], stub)
    for node, terms in joined(bodies[0].xyz, stub, shaft.xyz).items():
        for axis in (1, 2, 3):
            out += ["*EQUATION", str(1 + len(terms))]
            words = [f"{1 + node}, {axis}, 1."] + [f"{start[2] + n}, {axis}, {-w:.12e}" for n, w in terms]
            out += [", ".join(words[i:i + 4]) for i in range(0, len(words), 4)]
    hub = bodies[0].faces((np.abs(np.hypot(*bodies[0].xyz[:, :2].T) - 0.5 * SHAFT) < 1e-6)
                          & (np.abs(bodies[0].xyz[:, 2]) < 0.5 * FACE + 1e-6))
    by_nodes = {tuple(sorted(f[2])): f for f in hub}
    section["hub"] = weights(stations[0], by_nodes.values())
    # Flanks: the wheel's strips on the pinion's whole flank.
    strips = []
    out += ["*SURFACE INTERACTION, NAME=flanks", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY:.6e}"]
    for tooth in args.teeth:
        flanks = [on_left_flank(b, t, i, args.helix) for i, (b, t) in enumerate(zip(bodies, [tooth, -tooth]))]
        name = f"master{tooth}".replace("-", "m")
        out.append(f"*SURFACE, NAME={name}, TYPE=ELEMENT")
        out += [f"{numbers[0] + e}, S{s}" for e, s, _ in bodies[0].faces(flanks[0])]
        faces = bodies[1].faces(flanks[1])
        layer = {}
        for e, s, nodes in faces:
            z = bodies[1].xyz[nodes, 2].mean()
            layer.setdefault(int(np.floor((z + 0.5 * FACE) / FACE * args.face)), []).append((e, s))
        assert sorted(layer) == list(range(args.face)), sorted(layer)
        for k in range(args.face):
            slave = f"strip{tooth}_{k}".replace("-", "m")
            out.append(f"*SURFACE, NAME={slave}, TYPE=ELEMENT")
            out += [f"{numbers[1] + e}, S{s}" for e, s in layer[k]]
            out += ["*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE", f"{slave}, {name}"]
            strips.append((slave, name, tooth, k))
    radius = np.hypot(bodies[1].xyz[:, 0], bodies[1].xyz[:, 1])
    bore = np.nonzero(np.abs(radius - 0.5 * WHEEL_BORE) < 1e-6)[0]
    write_lines(out, "*NSET, NSET=bore", [start[1] + int(n) for n in bore])
    out += ["*BOUNDARY", "bore, 1, 3", f"{near}, 3, 3", f"{far}, 3, 3", f"{turn}, 2, 3"]
    out += ["*STEP, INC=50", "*STATIC", "1., 1.", "*BOUNDARY", f"{turn}, 1, 1, {args.turn:.9e}"]
    out += ["*NODE PRINT, NSET=ALL, FREQUENCY=100", "U", "*NODE PRINT, NSET=OWN, FREQUENCY=100", "U, RF"]
    for slave, master, _, _ in strips:
        out += [f"*CONTACT PRINT, SLAVE={slave}, MASTER={master}, FREQUENCY=100", "CF"]
    out += ["*END STEP", ""]
    (args.folder / "deck.inp").write_text("\n".join(out))
    np.savez(args.folder / "model.npz", stations0=stations[0], start=start, own=own,
             **{f"{k}_n": np.array(sorted(v)) for k, v in section.items()},
             **{f"{k}_w": np.array([v[n] for n in sorted(v)]) for k, v in section.items()})
    print(json.dumps({"nodes": counts, "elements": [len(b.hexes) for b in bodies + [shaft]]}), flush=True)
    # The exit status is no measure: 2.20 ends with 201 after warnings.
    said = subprocess.run(["ccx", "deck"], cwd=args.folder, check=False, capture_output=True, text=True).stdout
    (args.folder / "said.txt").write_text(said)
    if "Job finished" not in said:
        raise RuntimeError(said[-2000:])
    print(json.dumps(results(args, stations, section, start, strips), indent=1))


def results(args, stations, section, start, strips):
    """What the deck's results say."""
    lines = (args.folder / "deck.dat").read_text().splitlines()
    u = np.zeros((sum(len(s) for s in stations), 3))
    forces, moment, at = {}, 0.0, 0
    while at < len(lines):
        if lines[at].startswith(" displacements") and " set ALL " in lines[at]:
            at += 2
            while lines[at].strip():
                word = lines[at].split()
                if int(word[0]) <= len(u):
                    u[int(word[0]) - 1] = [float(x) for x in word[1:4]]
                at += 1
        elif "total surface force" in lines[at]:
            total = [float(x) for x in lines[at + 2].split()]
            slave = strips[len(forces)]
            forces[slave[2:]] = np.linalg.norm(total[:3]) if total[:3] != [0.0] * 3 else 0.0
            moment += total[5]
            at += 2
        at += 1
    out = {"helix_angle_deg": args.helix, "input_turn_rad": args.turn, "torque_nm": moment / 1000,
           "strip_forces_n": {str(t): [round(float(forces[(t, k)]), 3) for k in range(args.face)] for t in args.teeth}}
    strip = np.array([sum(forces[(t, k)] for t in args.teeth) for k in range(args.face)])
    out["largest_over_mean"] = float(strip.max() / strip.mean())
    for name, which in [("stub", 0), ("hub", 0), ("near", 2), ("far", 2), ("input", 2)]:
        first = start[which] - 1
        of = section[name]
        centre, mean, turn = mean_motion(stations[which], of, u[first:first + len(stations[which])])
        out[name] = {"z_mm": round(float(centre[2]), 6), "displacement_mm": [float(f"{x:.6e}") for x in mean],
                     "turn_rad": [float(f"{x:.6e}") for x in turn]}
    return out


if __name__ == "__main__":
    main()
