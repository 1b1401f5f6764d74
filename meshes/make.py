#!/usr/bin/env python3
"""Gear meshes made by Gmsh, for ale-gear's tests and scenes.

    python3 make.py all                      writes every mesh of README.md
    python3 make.py coarse_hex8_pinion.msh   writes that one
    python3 make.py custom --teeth 24 --helix-deg 15 --kind hex20 --out gear.msh

Needs the Python packages gmsh, numpy and scipy. Gmsh does the meshing: geo kernel, twist-extruded section,
transfinite quadrilaterals for hexahedra and wedges, Delaunay for tetrahedra. Afterwards nodes are put where the
exact surface is (mid-side nodes sit on chords, splines are splines), and what was saved is read back and measured.
"""

import argparse
import sys
from dataclasses import dataclass, replace
from math import pi, radians
from pathlib import Path

import gmsh
import numpy as np
from scipy.spatial import cKDTree

from section import Gear, split_at_slope, xy

HERE = Path(__file__).resolve().parent
KINDS = {  # kind: order, incomplete second order, section recombined to quadrilaterals
    "hex8": (1, 0, True),
    "hex20": (2, 1, True),
    "hex27": (2, 0, True),
    "wedge6": (1, 0, False),
    "wedge15": (2, 1, False),
    "tet4": (1, 0, False),
    "tet10": (2, 0, False),
}


@dataclass(frozen=True)
class Plan:
    """What to mesh. Counts are elements: flank, fillet (form circle to middle of the space), across the tooth,
    along the face, from the fillet to the bore. `sector` 0: whole gear, k: k teeth with cut faces."""

    gear: Gear = Gear()
    kind: str = "hex8"
    profile: int = 4
    fillet: int = 2
    thickness: int = 4
    face: int = 6
    rim: int = 3
    sector: int = 0
    size: float = 1.5  # of tetrahedra at the teeth, mm; in the fillets 0.6, at the bore 3 times that
    version: float = 2.2
    binary: bool = True

    @property
    def free(self):
        return self.kind.startswith("tet")

    def teeth(self):
        """Numbers of the meshed teeth; a sector lies about tooth 0, clockwise ones count down from 0."""
        if self.sector == 0:
            return range(self.gear.teeth)
        first = -((self.sector - 1) // 2)
        return range(first, first + self.sector)


class Outline:
    """Gmsh points and curves of the section at z = -b/2, each made once."""

    def __init__(self, plan):
        self.plan, self.geo = plan, gmsh.model.geo
        self.points, self.curves = {}, {}
        self.centre = self.geo.addPoint(0.0, 0.0, -plan.gear.width / 2)

    def point(self, key, radius, angle, size=0.0):
        if key not in self.points:
            turned = angle - self.plan.gear.twist * self.plan.gear.width / 2
            x, y = radius * np.cos(turned), radius * np.sin(turned)
            self.points[key] = self.geo.addPoint(x, y, -self.plan.gear.width / 2, size)
        return self.points[key]

    def line(self, a, b):
        return self._curve(a, b, lambda: self.geo.addLine(self.points[a], self.points[b]))

    def arc(self, a, b):
        return self._curve(a, b, lambda: self.geo.addCircleArc(self.points[a], self.centre, self.points[b]))

    def spline(self, a, b, polar):
        """Spline from a to b through the polar points strictly between."""
        def make():
            turn = -self.plan.gear.twist * self.plan.gear.width / 2
            inner = [
                self.geo.addPoint(r * np.cos(t + turn), r * np.sin(t + turn), -self.plan.gear.width / 2)
                for r, t in polar
            ]
            return self.geo.addSpline([self.points[a], *inner, self.points[b]])
        return self._curve(a, b, make)

    def _curve(self, a, b, make):
        if (b, a) in self.curves:
            return -self.curves[b, a]
        if (a, b) not in self.curves:
            self.curves[a, b] = make()
        return self.curves[a, b]


def section_points(outline, number, sizes=(0.0, 0.0)):
    """Key points and flank splines of one tooth; returns its curves by name and side."""
    plan = outline.plan
    gear, centre = plan.gear, number * plan.gear.pitch
    last_space = number if plan.sector else number % gear.teeth
    active, below = gear.half_profile()
    split = split_at_slope(below)
    root = lambda side: ("root", (2 * last_space + side) % (2 * gear.teeth) if not plan.sector else 2 * last_space + side)
    hub = lambda side: ("hub", root(side)[1])
    curves = {}
    for side in (1, -1):
        mirror = lambda polar: [(r, centre + side * a) for r, a in polar]
        tip, form, neck, foot = ("tip", number, side), ("form", number, side), ("neck", number, side), ("foot", number, side)
        fine, coarse = sizes
        tight = 0.6 * fine  # a fillet of one quadratic triangle around its bend would turn the tetrahedron inside out
        outline.point(tip, gear.tip_radius, centre + side * active[0, 1], fine)
        outline.point(form, active[-1, 0], centre + side * active[-1, 1], fine)
        outline.point(neck, below[split, 0], centre + side * below[split, 1], tight)
        outline.point(foot, gear.bore_radius, centre + side * below[split, 1], coarse)
        outline.point(root(side), gear.root_radius, centre + side * gear.pitch / 2, tight)
        outline.point(hub(side), gear.bore_radius, centre + side * gear.pitch / 2, coarse)
        curves["flank", side] = outline.spline(tip, form, mirror(active[1:-1:4]))
        curves["throat", side] = outline.spline(form, neck, mirror(below[2 : split - 1 : 2]))
        curves["fillet", side] = outline.spline(neck, root(side), mirror(below[split + 2 : -2 : 2]))
    return curves, root, hub


def structured_section(plan):
    """Six transfinite patches a tooth: tooth, throat, core, and the rim under each fillet."""
    outline, geo = Outline(plan), gmsh.model.geo
    upper = plan.fillet // 2 or 1
    lower = max(plan.fillet - upper, 1)
    surfaces = []
    for number in plan.teeth():
        curves, root, hub = section_points(outline, number)
        at = lambda name, side: (name, number, side)
        spoke = {side: outline.line(at("neck", side), at("foot", side)) for side in (1, -1)}
        cut = {side: outline.line(root(side), hub(side)) for side in (1, -1)}
        tip = outline.arc(at("tip", -1), at("tip", 1))
        middle = outline.line(at("form", -1), at("form", 1))
        waist = outline.line(at("neck", -1), at("neck", 1))
        base = outline.arc(at("foot", -1), at("foot", 1))
        heel = {side: outline.arc(at("foot", side), hub(side)) for side in (1, -1)}
        patches = [
            [tip, curves["flank", 1], -middle, -curves["flank", -1]],
            [middle, curves["throat", 1], -waist, -curves["throat", -1]],
            [waist, spoke[1], -base, -spoke[-1]],
            [curves["fillet", 1], cut[1], -heel[1], -spoke[1]],
            [spoke[-1], heel[-1], -cut[-1], -curves["fillet", -1]],
        ]
        for c in (tip, middle, waist, base):
            geo.mesh.setTransfiniteCurve(abs(c), plan.thickness + 1)
        for side in (1, -1):
            geo.mesh.setTransfiniteCurve(abs(curves["flank", side]), plan.profile + 1)
            geo.mesh.setTransfiniteCurve(abs(curves["throat", side]), upper + 1)
            geo.mesh.setTransfiniteCurve(abs(curves["fillet", side]), lower + 1)
            geo.mesh.setTransfiniteCurve(abs(heel[side]), lower + 1)
            for c in (spoke[side], cut[side]):
                # a cut is shared by two teeth and always runs from the root to the bore
                geo.mesh.setTransfiniteCurve(abs(c), plan.rim + 1, "Progression", 1.25)
        for patch in patches:
            surface = geo.addPlaneSurface([geo.addCurveLoop(patch)])
            geo.mesh.setTransfiniteSurface(surface, "Alternate" if not KINDS[plan.kind][2] else "Left")
            if KINDS[plan.kind][2]:
                geo.mesh.setRecombine(2, surface)
            surfaces.append(surface)
    return surfaces


def free_section(plan):
    """One plane surface bounded by all teeth, the bore and, for a sector, the two cuts."""
    outline, geo = Outline(plan), gmsh.model.geo
    loop, hubs = [], []
    for number in plan.teeth():
        curves, root, hub = section_points(outline, number, (plan.size, 3.0 * plan.size))
        tip = outline.arc(("tip", number, -1), ("tip", number, 1))
        loop += [-curves[name, -1] for name in ("fillet", "throat", "flank")] + [tip]
        loop += [curves[name, 1] for name in ("flank", "throat", "fillet")]
        hubs.append(outline.arc(hub(-1), hub(1)))
        ends = (root, hub) if number == plan.teeth()[0] else ends
    if plan.sector == 0:
        return [geo.addPlaneSurface([geo.addCurveLoop(loop), geo.addCurveLoop(hubs)])]
    first, last = outline.line(ends[0](-1), ends[1](-1)), outline.line(root(1), hub(1))
    return [geo.addPlaneSurface([geo.addCurveLoop([*loop, last, *[-h for h in reversed(hubs)], -first])])]


class Frame:
    """Nodes in the twisted frame: radius, angle with the twist taken out, z."""

    def __init__(self, gear):
        self.gear = gear

    def untwisted(self, points):
        r = np.hypot(points[:, 0], points[:, 1])
        return r, np.arctan2(points[:, 1], points[:, 0]) - self.gear.twist * points[:, 2], points[:, 2]

    def placed(self, r, angle, z):
        turned = angle + self.gear.twist * z
        return np.column_stack([r * np.cos(turned), r * np.sin(turned), z])

    def folded(self, angle):
        """Tooth number and angle from that tooth's centre line; the cut belongs to the next tooth."""
        pitch = self.gear.pitch
        tooth = np.floor((angle + pitch / 2) / pitch + 1e-4)  # Gmsh puts nodes on curves to about 1e-5
        return tooth.astype(int), angle - tooth * pitch

    def flank_deviation(self, points, side):
        """Distance from the exact helicoid, normal to it, mm (first order)."""
        r, angle, _ = self.untwisted(points)
        _, local = self.folded(angle)
        error = np.abs(local) - self.gear.flank_angle(r)
        if np.any(np.sign(local) != side):
            raise AssertionError("a flank node lies on the wrong side")
        normal = np.cos(np.arcsin(np.sin(self.gear.helix) * np.cos(self.gear.pressure_angle)))
        return self.gear.base_radius * normal * error


def all_nodes():
    """Nodes of volume elements; arc centres and spline points are nodes to Gmsh as well."""
    tags, points, _ = gmsh.model.mesh.getNodes()
    used = np.isin(tags, np.unique(np.concatenate(gmsh.model.mesh.getElements(3)[2])))
    return tags[used], points.reshape(-1, 3)[used]


def surface_nodes(surface):
    tags, points, _ = gmsh.model.mesh.getNodes(2, surface, includeBoundary=True)
    return tags, points.reshape(-1, 3)


def classify(plan):
    """Name of each outer surface from where its nodes lie: {name: [surface, ...]}."""
    gear, frame = plan.gear, Frame(plan.gear)
    half, near = gear.width / 2, 0.02 * gear.module
    groups = {}
    volumes = gmsh.model.getEntities(3)
    first, last = min(plan.teeth()), max(plan.teeth())
    form = gear.half_profile()[0][-1, 0]
    for _, surface in gmsh.model.getBoundary(volumes, combined=True, oriented=False):
        _, points = surface_nodes(surface)
        r, angle, z = frame.untwisted(points)
        middle = angle[0] + np.mean((angle - angle[0] + pi) % (2 * pi) - pi)  # tooth z/2 lies across the cut of arctan2
        if np.all(np.abs(z - half) < 1e-6):
            name = "side_front"
        elif np.all(np.abs(z + half) < 1e-6):
            name = "side_back"
        elif np.all(np.abs(r - gear.bore_radius) < near):
            name = "bore"
        elif plan.sector and np.all(np.abs(angle - (first - 0.5) * gear.pitch) < 1e-4):
            name = "cut_0"
        elif plan.sector and np.all(np.abs(angle - (last + 0.5) * gear.pitch) < 1e-4):
            name = "cut_1"
        else:
            tooth, local = frame.folded(np.array([middle]))
            on_flank = np.abs(np.abs(frame.folded(angle)[1]) - gear.flank_angle(r)) * r < near
            if not (np.all(on_flank) and r.min() > form - near and np.ptp(r) > near):
                continue
            number = tooth[0] if plan.sector else tooth[0] % gear.teeth
            name = f"flank_{'left' if local[0] > 0 else 'right'}_{number}"
        groups.setdefault(name, []).append(surface)
    expected = 2 * len(plan.teeth()) + 3 + (2 if plan.sector else 0)
    if len(groups) != expected:
        raise AssertionError(f"{len(groups)} surface groups instead of {expected}: {sorted(groups)}")
    return groups


def snap_structured(plan, groups):
    """Puts every node on the twisted copy of ONE tooth's section, whose flank nodes are on the involute."""
    gear, frame = plan.gear, Frame(plan.gear)
    tags, points = all_nodes()
    r, angle, z = frame.untwisted(points)
    tooth, local = frame.folded(angle)
    # the pattern: nodes of the back face of tooth 0; its far cut folds onto the next tooth's near one
    pattern = (tooth == 0) & (np.abs(z + gear.width / 2) < 1e-6)
    pr, pa = r[pattern].copy(), local[pattern].copy()
    on_cut = np.abs(pa + gear.pitch / 2) < 1e-4 * gear.pitch
    pa[on_cut] = -gear.pitch / 2
    pattern_tags = tags[pattern]
    for name, surfaces in groups.items():
        mine = np.isin(pattern_tags, np.concatenate([surface_nodes(s)[0] for s in surfaces]))
        if name == "bore":
            pr[mine] = gear.bore_radius
        elif name.startswith("flank") and name.endswith("_0"):
            top = np.abs(pr - gear.tip_radius) < 1e-6
            pr[mine & top] = gear.tip_radius
            pa[mine] = np.sign(pa[mine]) * gear.flank_angle(pr[mine])
    on_tip = np.abs(pr - gear.tip_radius) < 2e-2 * gear.module
    on_tip &= np.abs(pa) < float(gear.flank_angle(gear.tip_radius)) + 1e-6
    # tip mid-side nodes sit on the circle already (arc); take out the last digits
    pr[on_tip & (np.abs(pr - gear.tip_radius) < 1e-6)] = gear.tip_radius
    tree = cKDTree(np.column_stack([pr * np.cos(pa), pr * np.sin(pa)]))
    distance, which = tree.query(np.column_stack([r * np.cos(local), r * np.sin(local)]))
    if distance.max() > 0.05 * gear.module:
        raise AssertionError(f"a node is {distance.max():.3g} mm from the section's pattern")
    layers = plan.face * KINDS[plan.kind][0]
    level = np.round((z / gear.width + 0.5) * layers)
    astray = np.abs(level / layers - 0.5 - z / gear.width).max() * layers
    if astray > 0.05:
        raise AssertionError(f"a node lies {astray:.3g} layers from the nearest layer")
    exact = frame.placed(pr[which], pa[which] + tooth * gear.pitch, (level / layers - 0.5) * gear.width)
    for tag, point in zip(tags, exact):
        gmsh.model.mesh.setNode(tag, point, [])


def snap_free(plan, groups):
    """Puts the nodes of flanks on the helicoid and those of the bore on its cylinder."""
    gear, frame = plan.gear, Frame(plan.gear)
    form = gear.half_profile()[0][-1, 0]
    for name, surfaces in groups.items():
        for surface in surfaces:
            tags, points = surface_nodes(surface)
            r, angle, z = frame.untwisted(points)
            if name == "bore":
                r = np.full_like(r, gear.bore_radius)
            elif name.startswith("flank"):
                for edge in (gear.tip_radius, form):
                    r[np.abs(r - edge) < 1e-2] = edge
                tooth, local = frame.folded(angle)
                angle = tooth * gear.pitch + np.sign(local) * gear.flank_angle(r)
            else:
                continue
            for tag, point in zip(tags, frame.placed(r, angle, z)):
                gmsh.model.mesh.setNode(tag, point, [])


def generate(plan):
    """Meshes the plan in the current Gmsh model."""
    gear = plan.gear
    order, incomplete, recombine = KINDS[plan.kind]
    gmsh.clear()
    gmsh.model.add("gear")
    option = gmsh.option.setNumber
    option("Mesh.SecondOrderIncomplete", incomplete)
    option("Mesh.ElementOrder", 1)
    option("Mesh.MeshSizeExtendFromBoundary", 1)
    option("Mesh.Algorithm", 6)
    option("Mesh.Algorithm3D", 1)
    option("Mesh.Optimize", 1)
    option("Mesh.HighOrderThresholdMin", 0.25)
    turn = gear.twist * gear.width
    if plan.free:
        surfaces = free_section(plan)
        gmsh.model.geo.twist([(2, s) for s in surfaces], 0, 0, 0, 0, 0, gear.width, 0, 0, 1, turn)
    else:
        surfaces = structured_section(plan)
        gmsh.model.geo.twist(
            [(2, s) for s in surfaces], 0, 0, 0, 0, 0, gear.width, 0, 0, 1, turn, [plan.face], [1.0], True
        )
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    if plan.free:
        gmsh.model.mesh.optimize("Netgen")
    if order == 2:
        gmsh.model.mesh.setOrder(2)
        if plan.free:
            gmsh.model.mesh.optimize("HighOrder")
    groups = classify(plan)
    (snap_free if plan.free else snap_structured)(plan, groups)
    for name in sorted(groups):
        gmsh.model.addPhysicalGroup(2, groups[name], name=name)
    gmsh.model.addPhysicalGroup(3, [v for _, v in gmsh.model.getEntities(3)], name="gear")
    gmsh.model.mesh.renumberNodes()
    gmsh.model.mesh.renumberElements()


def save(plan, path):
    gmsh.option.setNumber("Mesh.MshFileVersion", plan.version)
    gmsh.option.setNumber("Mesh.Binary", int(plan.binary))
    gmsh.option.setNumber("Mesh.SaveAll", 0)
    gmsh.write(str(path))


def measure(plan, path):
    """Reads the file back: sizes, worst quality, flank deviation and how exactly cyclic it is."""
    gmsh.clear()
    gmsh.open(str(path))
    frame = Frame(plan.gear)
    tags, points = all_nodes()
    kinds, elements, _ = gmsh.model.mesh.getElements(3)
    names = [gmsh.model.mesh.getElementProperties(k)[0] for k in kinds]
    quality = np.concatenate([gmsh.model.mesh.getElementQualities(e, "minSJ") for e in elements])
    if plan.free:  # a straight tetrahedron has one Jacobian, always 1 in scale: judge its shape
        quality = np.minimum(quality, np.concatenate([gmsh.model.mesh.getElementQualities(e, "minSICN") for e in elements]))
    volume = np.concatenate([gmsh.model.mesh.getElementQualities(e, "volume") for e in elements]).sum()
    worst = 0.0
    for dim, group in gmsh.model.getPhysicalGroups(2):
        name = gmsh.model.getPhysicalName(dim, group)
        if name.startswith("flank"):
            _, xyz = gmsh.model.mesh.getNodesForPhysicalGroup(dim, group)
            side = 1 if "left" in name else -1
            worst = max(worst, np.abs(frame.flank_deviation(xyz.reshape(-1, 3), side)).max())
    cyclic = None
    if plan.sector == 0 and not plan.free:
        c, s = np.cos(plan.gear.pitch), np.sin(plan.gear.pitch)
        cyclic = cKDTree(points).query(points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T)[0].max()
    return {
        "file": path.name, "kind": "/".join(names), "nodes": len(tags), "elements": sum(map(len, elements)),
        "dof": 3 * len(tags), "quality": quality.min(), "flank_um": 1e3 * worst, "cyclic_mm": cyclic,
        "volume_mm3": volume, "bytes": path.stat().st_size,
    }


def presets():
    """Every mesh of README.md by file name."""
    pinion = Plan()
    left = lambda plan: replace(plan, gear=replace(plan.gear, helix=-plan.gear.helix))
    coarse = replace(pinion, profile=5, fillet=2, thickness=4, face=6, rim=3)
    medium = replace(pinion, profile=8, fillet=2, thickness=5, face=8, rim=4)
    quadratic = replace(pinion, kind="hex20", profile=4, fillet=2, thickness=4, face=5, rim=3)
    tiny = replace(pinion, profile=2, thickness=2, face=2, rim=2, sector=3)
    plans = {}
    for name, plan in (("coarse_hex8", coarse), ("medium_hex8", medium), ("coarse_hex20", quadratic)):
        plans[f"{name}_pinion.msh"], plans[f"{name}_wheel.msh"] = plan, left(plan)
    plans["periodic_hex20.msh"] = replace(quadratic, sector=1, version=4.1)
    plans["periodic_hex8.msh"] = replace(coarse, sector=1, version=4.1)
    plans["free_tet10_pinion.msh"] = replace(pinion, kind="tet10", size=2.3)
    for degrees in (10, 15, 20, 25):  # scenes/seeds/000: pairs that differ in the helix angle alone
        wider = replace(pinion.gear, helix=radians(degrees), width=22.0)
        tooth = replace(quadratic, gear=wider, sector=1)
        name = f"seed000_beta{degrees}"
        plans[f"{name}_pinion.msh"], plans[f"{name}_wheel.msh"] = tooth, left(tooth)
    for version in (2.2, 4.1):
        for binary in (False, True):
            flavour = f"v{str(version).replace('.', '')}_{'binary' if binary else 'ascii'}"
            plans[f"sector3_hex8_{flavour}.msh"] = replace(tiny, version=version, binary=binary)
    for kind in ("hex20", "hex27", "wedge6", "wedge15", "tet4", "tet10"):
        plans[f"sector3_{kind}.msh"] = replace(tiny, kind=kind, size=2.5, version=4.1)
    return plans


def custom(args):
    """Plan from command-line options."""
    p = argparse.ArgumentParser(prog="make.py custom")
    for name, default in (("teeth", 30), ("profile", 4), ("fillet", 2), ("thickness", 4), ("face", 6), ("rim", 3)):
        p.add_argument(f"--{name}", type=int, default=default)
    p.add_argument("--sector", type=int, default=0, help="0: whole gear; k: k teeth with cut faces")
    for name, default in (
        ("module-mm", 3.0), ("pressure-angle-deg", 20.0), ("helix-deg", 20.0), ("width-mm", 20.0), ("bore-mm", 60.0),
        ("shift", 0.0), ("thinning-mm", 0.05), ("addendum", 1.0), ("dedendum", 1.25), ("tip-round", 0.38),
        ("size-mm", 1.5),
    ):
        p.add_argument(f"--{name}", type=float, default=default)
    p.add_argument("--hand", choices=("right", "left"), default="right")
    p.add_argument("--kind", choices=sorted(KINDS), default="hex8")
    p.add_argument("--version", type=float, choices=(2.2, 4.1), default=2.2)
    p.add_argument("--ascii", action="store_true")
    p.add_argument("--out", type=Path, required=True)
    a = p.parse_args(args)
    helix = radians(a.helix_deg) * (1 if a.hand == "right" else -1)
    gear = Gear(
        a.teeth, a.module_mm, radians(a.pressure_angle_deg), helix, a.width_mm, a.bore_mm, a.shift, a.thinning_mm,
        a.addendum, a.dedendum, a.tip_round,
    )
    plan = Plan(
        gear, a.kind, a.profile, a.fillet, a.thickness, a.face, a.rim, a.sector, a.size_mm, a.version, not a.ascii
    )
    return a.out, plan


def main(args):
    if not args or args[0] in ("-h", "--help"):
        print(__doc__)
        return
    plans = presets()
    if args[0] == "custom":
        wanted = [custom(args[1:])]
    elif args[0] == "all":
        wanted = [(HERE / name, plan) for name, plan in plans.items()]
    else:
        wanted = [(HERE / name, plans[name]) for name in args]
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    print("| file | elements | nodes | elements | DOF | least quality | flank off, um | cyclic to, mm | volume, mm3 | kB |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for path, plan in wanted:
        generate(plan)
        save(plan, path)
        m = measure(plan, path)
        cyclic = "" if m["cyclic_mm"] is None else f"{m['cyclic_mm']:.0e}"
        print(
            f"| `{m['file']}` | {m['kind']} | {m['nodes']} | {m['elements']} | {m['dof']} | {m['quality']:.3f} |"
            f" {m['flank_um']:.1e} | {cyclic} | {m['volume_mm3']:.3f} | {m['bytes'] / 1000:.0f} |", flush=True,
        )
    gmsh.finalize()


if __name__ == "__main__":
    main(sys.argv[1:])
