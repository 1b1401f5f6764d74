"""Makes the small meshes beside it with Gmsh itself: every element kind in every flavour, and the traps.

Run in this folder with the Python package gmsh (4.15.2 made the files in the repository).
"""

import gmsh

FLAVOURS = {"a41": (4.1, 0), "b41": (4.1, 1), "a22": (2.2, 0), "b22": (2.2, 1)}


def start(**options):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, value in options.items():
        gmsh.option.setNumber("Mesh." + name, value)


def save(stem, flavours=FLAVOURS):
    for flavour in flavours:
        version, binary = FLAVOURS[flavour]
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(f"{stem}_{flavour}.msh")


def brick(x=0.0, width=2.0, structured=True, recombine=True):
    """A block with three named faces, one of them turned, and a line group; two divisions along x."""
    tag = gmsh.model.occ.addBox(x, 0, 0, width, 1.1, 1.3)
    gmsh.model.occ.synchronize()
    if structured:
        for _, curve in gmsh.model.getEntities(1):
            long = gmsh.model.occ.getMass(1, curve) > 1.5
            gmsh.model.mesh.setTransfiniteCurve(curve, 3 if long else 2)
        for _, surface in gmsh.model.getEntities(2):
            gmsh.model.mesh.setTransfiniteSurface(surface)
            if recombine:
                gmsh.model.mesh.setRecombine(2, surface)
        gmsh.model.mesh.setTransfiniteVolume(tag)
    return tag


def groups(volume):
    gmsh.model.addPhysicalGroup(3, [volume], name="gear")
    gmsh.model.addPhysicalGroup(2, [1], name="bore")
    gmsh.model.addPhysicalGroup(2, [2], name="flank left 0")
    gmsh.model.addPhysicalGroup(2, [-3, -4], name="flank right 0")
    gmsh.model.addPhysicalGroup(1, [1, 2], name="an edge")


def wedges():
    """A triangulated square swept upwards in two layers of wedges."""
    base = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1.2)
    gmsh.model.occ.extrude([(2, base)], 0, 0, 1.4, numElements=[2], recombine=True)
    gmsh.model.occ.synchronize()
    for _, curve in gmsh.model.getEntities(1):
        gmsh.model.mesh.setTransfiniteCurve(curve, 2)


KINDS = {
    "hex8": (1, 1, "hex"), "hex20": (2, 1, "hex"), "hex27": (2, 0, "hex"),
    "tet4": (1, 1, "tet"), "tet10": (2, 1, "tet"),
    "wedge6": (1, 1, "wedge"), "wedge15": (2, 1, "wedge"),
}
for kind, (order, incomplete, shape) in KINDS.items():
    start(SecondOrderIncomplete=incomplete, MeshSizeMin=1.5)
    if shape == "wedge":
        wedges()
        groups(1)
    else:
        groups(brick(recombine=shape == "hex"))
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    save(kind)
    gmsh.finalize()

# Two blocks side by side; the first in two physical volumes, its face in two physical surfaces.
for stem, both, everything in [("overlap", True, 0), ("strays", False, 1)]:
    start(SaveAll=everything)
    one = brick()
    two = brick(x=5.0)
    gmsh.model.addPhysicalGroup(3, [one, two] if both else [one], name="gear")
    gmsh.model.addPhysicalGroup(3, [one], name="part")
    gmsh.model.addPhysicalGroup(2, [1], name="bore")
    gmsh.model.addPhysicalGroup(2, [1, 2], name="bore and more")
    gmsh.model.mesh.generate(3)
    save(stem)
    gmsh.finalize()

# No groups at all.
start()
brick()
gmsh.model.mesh.generate(3)
save("plain")
gmsh.finalize()

# Parametric coordinates beside the nodes.
start(SaveParametric=1)
groups(brick())
gmsh.model.mesh.generate(3)
save("parametric")
gmsh.finalize()

# Cut into three partitions, with ghost cells: groups move to $PartitionedEntities.
start(PartitionCreateGhostCells=1, PartitionCreateTopology=1)
one = brick(width=4.0)
for _, curve in gmsh.model.getEntities(1):
    gmsh.model.mesh.setTransfiniteCurve(curve, 4 if gmsh.model.occ.getMass(1, curve) > 1.5 else 2)
groups(one)
gmsh.model.mesh.generate(3)
save("whole", ["a41"])
gmsh.model.mesh.partition(3)
save("partitioned")
gmsh.finalize()

# Version 4.0, which is refused.
start(MshFileVersion=4.0)
groups(brick())
gmsh.model.mesh.generate(3)
gmsh.write("version_40.msh")
gmsh.finalize()
