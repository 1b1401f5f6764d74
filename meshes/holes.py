#!/usr/bin/env python3
"""A wheel with a web and round holes, from the mesh of a whole gear: elements are left out.

    ale-gear mesh generate SCENE.toml --gear wheel -o solid.msh
    python3 holes.py solid.msh holes.msh --holes 6

Rim (14 mm below the tips) and hub (10 mm around the bore) keep their width; the web between them has 36 % of it, and round
holes with 72 % of its height. Bore and flanks keep their names. Needs the Python packages gmsh and numpy.
"""

import argparse
import sys

try:
    import gmsh
    import numpy as np
except ImportError as missing:
    sys.exit(f"holes.py: {missing}\nhint: python3 -m venv v && v/bin/pip install gmsh numpy, then v/bin/python holes.py ...")


def elements(dimension):
    """Entity, kind and node tags (elements x nodes) of every block."""
    for _, entity in gmsh.model.getEntities(dimension):
        for kind, _, tags in zip(*gmsh.model.mesh.getElements(dimension, entity)):
            yield entity, kind, tags.reshape(-1, gmsh.model.mesh.getElementProperties(kind)[3]).astype(int)


def names():
    """Physical names of surfaces by entity, bore and flanks alone."""
    found = {}
    for dimension, group in gmsh.model.getPhysicalGroups(2):
        name = gmsh.model.getPhysicalName(dimension, group)
        if name == "bore" or name.startswith("flank"):
            found.update({int(entity): name for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, group)})
    return found


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("solid")
    words.add_argument("out")
    words.add_argument("--holes", type=int, default=6)
    words.add_argument("--rim", type=float, default=14.0, help="from tip circle to web, mm")
    words.add_argument("--hub", type=float, default=10.0, help="from bore to web, mm")
    given = words.parse_args()
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(given.solid)
    tags, points, _ = gmsh.model.mesh.getNodes()
    points = points.reshape(-1, 3)
    row = np.zeros(int(tags.max()) + 1, int)
    row[tags.astype(int)] = np.arange(len(tags))
    radius = np.hypot(points[:, 0], points[:, 1])
    low, high, half = radius.min() + given.hub, radius.max() - given.rim, np.abs(points[:, 2]).max()

    def is_left(connectivity):
        x, y, z = points[row[connectivity[:, :8]]].mean(axis=1).T
        r, angle = np.hypot(x, y), 2 * np.pi * np.arange(given.holes) / given.holes
        middle = 0.5 * (low + high)
        away = np.hypot(x[:, None] - middle * np.cos(angle), y[:, None] - middle * np.sin(angle)).min(axis=1)
        between = (r > low) & (r < high)
        return ~between | ((np.abs(z) < 0.36 * half) & (away > 0.36 * (high - low)))

    volumes = [(kind, c[is_left(c)]) for _, kind, c in elements(3)]
    used = np.unique(np.concatenate([c.ravel() for _, c in volumes]))
    number = np.zeros(int(tags.max()) + 1, int)
    number[used] = np.arange(1, len(used) + 1)
    named = names()
    faces = [(named[e], kind, c[np.isin(c, used).all(axis=1)]) for e, kind, c in elements(2) if e in named]

    gmsh.model.add("holes")
    gmsh.model.addDiscreteEntity(3, 1)
    gmsh.model.mesh.addNodes(3, 1, np.arange(1, len(used) + 1), points[row[used]].ravel())
    count = 1
    for kind, c in volumes:
        gmsh.model.mesh.addElementsByType(1, kind, np.arange(count, count + len(c)), number[c].ravel())
        count += len(c)
    gmsh.model.addPhysicalGroup(3, [1], name="gear")
    for surface, (name, kind, c) in enumerate(faces, start=1):
        gmsh.model.addDiscreteEntity(2, surface)
        gmsh.model.mesh.addElementsByType(surface, kind, np.arange(count, count + len(c)), number[c].ravel())
        gmsh.model.addPhysicalGroup(2, [surface], name=name)
        count += len(c)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(given.out)
    print(f"{given.out}: {len(used)} nodes, {sum(len(c) for _, c in volumes)} elements")


if __name__ == "__main__":
    main()
