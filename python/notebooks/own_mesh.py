# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     name: python3
# ---

# %% [markdown]
# # A mesh of your own from Gmsh, without a file
#
# The gear is drawn and meshed by Gmsh's Python API; its nodes, elements and named faces go to the solver as arrays. What
# the mesh must be is what is asked of files (docs/tutorials/own_mesh.md): mm, the axis on z, tooth 0 on +x, names for the
# bore and for the flanks of each tooth. Here a whole spur wheel, one section swept along the face.

# %%
import sys
from math import atan, atan2, cos, hypot, pi, radians, sin, sqrt, tan

try:
    import gmsh
except (ImportError, OSError) as missing:  # without its graphics libraries it does not load
    print(f"Gmsh is not to be had here: {missing}")
    sys.exit(0)

import ale_gear

TEETH, MODULE, WIDTH, BORE = 20, 3.0, 12.0, 30.0
ALPHA, DEDENDUM, ROUND = radians(20.0), 1.25 * MODULE, 0.38 * MODULE

# %% [markdown]
# One side of a tooth: the fillet that the rounded tip of the basic rack leaves, then the involute; each point by its radius
# and its angle from the centre line of the tooth.

# %%
pitch = MODULE * TEETH / 2
base = pitch * cos(ALPHA)
tip = pitch + MODULE
half = pi / (2 * TEETH) + tan(ALPHA) - ALPHA
form = tan(ALPHA) - (DEDENDUM - ROUND * (1 - sin(ALPHA))) / (base * sin(ALPHA))


def fillet(part: float) -> tuple[float, float]:
    phi = part * (pi / 2 - ALPHA)
    depth = DEDENDUM - ROUND + ROUND * cos(phi)
    along = pi * MODULE / 4 - (DEDENDUM - ROUND) * tan(ALPHA) - ROUND / cos(ALPHA) + ROUND * sin(phi)
    ahead = depth * tan(phi)
    return hypot(pitch - depth, ahead), pi / TEETH - (along - ahead) / pitch - atan2(ahead, pitch - depth)


def involute(part: float) -> tuple[float, float]:
    roll = form + part * (sqrt((tip / base) ** 2 - 1) - form)
    return base * sqrt(1 + roll**2), half - (roll - atan(roll))


STEPS = 6
foot = [fillet(i / STEPS) for i in range(STEPS + 1)]
flank = [involute(i / STEPS) for i in range(STEPS + 1)]

# %% [markdown]
# The section in Gmsh, and its sweep.

# %%
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
geo = gmsh.model.geo
centre = geo.addPoint(0, 0, -WIDTH / 2)


def point(radius: float, angle: float) -> int:
    return geo.addPoint(radius * cos(angle), radius * sin(angle), -WIDTH / 2)


outer: list[int] = []
flanks: list[tuple[str, int]] = []
first = last = None
for k in range(TEETH):
    middle = 2 * pi * k / TEETH
    right = [point(r, middle - a) for r, a in foot + flank[1:]]
    left = [point(r, middle + a) for r, a in foot + flank[1:]]
    if last is not None:
        outer.append(geo.addCircleArc(last, centre, right[0]))
        geo.mesh.setTransfiniteCurve(outer[-1], 2)
    curves = [
        (geo.addSpline(right[: STEPS + 1]), 4, None),
        (geo.addSpline(right[STEPS:]), 5, f"flank_right_{k}"),
        (geo.addCircleArc(right[-1], centre, left[-1]), 4, None),
        (geo.addSpline(left[: STEPS - 1 : -1]), 5, f"flank_left_{k}"),
        (geo.addSpline(left[STEPS::-1]), 4, None),
    ]
    for curve, nodes, name in curves:
        geo.mesh.setTransfiniteCurve(curve, nodes)
        outer.append(curve)
        if name is not None:
            flanks.append((name, len(outer) - 1))
    first, last = (right[0] if first is None else first), left[0]
outer.append(geo.addCircleArc(last, centre, first))
geo.mesh.setTransfiniteCurve(outer[-1], 2)
quarters = [point(BORE / 2, i * pi / 2) for i in range(4)]
hub = [geo.addCircleArc(quarters[i], centre, quarters[(i + 1) % 4]) for i in range(4)]
for curve in hub:
    geo.mesh.setTransfiniteCurve(curve, 9)
section = geo.addPlaneSurface([geo.addCurveLoop(outer), geo.addCurveLoop(hub)])
geo.mesh.setRecombine(2, section)
swept = geo.extrude([(2, section)], 0, 0, WIDTH, numElements=[4], recombine=True)
geo.synchronize()
# Far end, volume, then one surface a curve, in the order of the loops.
sides = [tag for _, tag in swept[2:]]
for name, place in flanks:
    gmsh.model.addPhysicalGroup(2, [sides[place]], name=name)
gmsh.model.addPhysicalGroup(2, sides[len(outer) :], name="bore")
gmsh.model.mesh.generate(3)

# %%
mesh = ale_gear.Mesh.from_gmsh(gmsh)
gmsh.finalize()
print(mesh, "bore and", len(mesh.groups) - 1, "flanks")

# %% [markdown]
# The pair runs on it: two of the same wheel. Contact takes its gaps from the exact involute, only the compliance is the
# mesh's.

# %%
scene = ale_gear.Scene(
    name="own mesh",
    pinion={"teeth": TEETH, "helix_angle_deg": 0.0, "bore_diameter_mm": BORE, "thickness_allowance_mm": 0.02},
    wheel={"teeth": TEETH, "bore_diameter_mm": BORE, "thickness_allowance_mm": 0.02},
    pair={"normal_module_mm": MODULE, "face_width_mm": WIDTH},
    operation={"torque_nm": 60.0},
    analysis={"positions_per_cycle": 8},
)
pair = ale_gear.Pair(scene, meshes=(mesh, mesh)).reduce()
result = pair.static()
print(f"mean STE {result.headline['mean_ste_um']:.3f} um on {len(mesh.nodes)} nodes a gear")
# A spur pair: one pair of teeth carries all in the middle, two at the ends.
assert set(result["pairs_in_contact"]) <= {1.0, 2.0}, result["pairs_in_contact"]
