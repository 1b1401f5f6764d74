#!/usr/bin/env python3
"""Meshes of other programs for the bounds of headline numbers: the pairs of `tests/data/foreign_pairs.json` by Gmsh.

    python3 foreign_meshes.py FOLDER [FIRST [COUNT]]

Writes, for every pair and gear, hexahedra (`hex8`, one periodic tooth) and tetrahedra (`tet10`, an open sector of five
teeth), coarse and refined in Gmsh: `0_hex8_coarse_pinion.msh` and so on. `check_foreign_meshes` runs them.
Needs the Python packages gmsh, numpy and scipy; `meshes/make.py` does the meshing.
"""

import json
import sys
from math import radians
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "meshes"))

import gmsh  # noqa: E402
import make  # noqa: E402

# Elements along flank, fillet, across the tooth, along the face, from the fillet to the bore; twice as many refined.
HEXAHEDRA = {"coarse": (4, 2, 4, 4, 3), "fine": (8, 4, 8, 8, 6)}
# Size of tetrahedra at the teeth over the module.
TETRAHEDRA = {"coarse": 0.85, "fine": 0.6}
SECTOR = 5


def plans(pair, which):
    """File name without the gear, and plan, of one gear of a pair."""
    hand = 1 if which == 0 else -1
    gear = make.Gear(
        pair["teeth"][which], pair["module"], radians(20.0), radians(hand * pair["helix"]), pair["width"],
        pair["bore"][which], pair["shift"][which], 0.02 * pair["module"], 1.0, 1.25, 0.38,
    )
    for name, (profile, fillet, thickness, face, rim) in HEXAHEDRA.items():
        yield f"hex8_{name}", make.Plan(gear, "hex8", profile, fillet, thickness, face, rim, sector=1, version=4.1)
    for name, size in TETRAHEDRA.items():
        yield f"tet10_{name}", make.Plan(gear, "tet10", sector=SECTOR, size=size * pair["module"], version=4.1)


def main(args):
    if not args or args[0] in ("-h", "--help"):
        print(__doc__)
        return
    folder, first, count = Path(args[0]), *(int(a) for a in [*args[1:], *[0, 1000][len(args) - 1 :]][:2])
    folder.mkdir(parents=True, exist_ok=True)
    pairs = json.loads((HERE.parent / "data" / "foreign_pairs.json").read_text())
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for number, pair in list(enumerate(pairs))[first : first + count]:
        for which, gear in enumerate(("pinion", "wheel")):
            for name, plan in plans(pair, which):
                path = folder / f"{number}_{name}_{gear}.msh"
                make.generate(plan)
                make.save(plan, path)
                told = make.measure(plan, path)
                print(f"{path.name}: {told['nodes']} nodes, least quality {told['quality']:.2f}", flush=True)
    gmsh.finalize()


if __name__ == "__main__":
    main(sys.argv[1:])
