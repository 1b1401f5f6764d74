"""Meshes of meshio and of Gmsh's Python API as those of this package, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._frames import _needs
from ._native import Mesh
from .errors import InputError

# vtk[k] = gmsh[order[k]]: meshio numbers nodes as VTK does.
_VTK = {
    "hexahedron20": [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
    "hexahedron27": [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26],
    "tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
    "wedge15": [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
}
_VOLUMES = ("hexahedron", "hexahedron20", "hexahedron27", "tetra", "tetra10", "wedge", "wedge15")
_FACES = ("triangle", "triangle6", "quad", "quad8", "quad9")
_GMSH_VOLUMES = {4: 4, 5: 8, 6: 6, 11: 10, 12: 27, 17: 20, 18: 15}
_GMSH_FACES = {2: 3, 3: 4, 9: 6, 10: 9, 16: 8}


def _of_vtk(kind: str, rows: Any) -> Any:
    order = _VTK.get(kind)
    if order is None:
        return rows
    turned = np.empty_like(rows)
    turned[:, order] = rows
    return turned


def from_meshio(mesh: Any) -> Mesh:
    """Physical groups of Gmsh (`gmsh:physical` with `field_data`), or the sets of cells."""
    if not (hasattr(mesh, "points") and hasattr(mesh, "cells")):
        raise InputError(
            f"{type(mesh).__name__} is no mesh of meshio", key="mesh", hint="give what `meshio.read` gives"
        )
    nodes = np.zeros((len(mesh.points), 3))
    nodes[:, : np.shape(mesh.points)[1]] = mesh.points
    cells = [_of_vtk(block.type, np.asarray(block.data)) for block in mesh.cells if block.type in _VOLUMES]
    groups: dict[str, list[Any]] = {}
    tags = mesh.cell_data.get("gmsh:physical", [])
    names = {int(value[0]): name for name, value in mesh.field_data.items() if int(value[1]) == 2}
    for block, own in zip(mesh.cells, tags):
        if block.type in _FACES:
            for tag in np.unique(own):
                faces = np.asarray(block.data)[np.asarray(own) == tag]
                groups.setdefault(names.get(int(tag), str(int(tag))), []).append(faces)
    if not tags:
        for name, sets in mesh.cell_sets.items():
            for block, own in zip(mesh.cells, sets):
                if block.type in _FACES and own is not None and len(own) > 0:
                    groups.setdefault(name, []).append(np.asarray(block.data)[np.asarray(own)])
    return Mesh(nodes, cells, groups)


def to_meshio(mesh: Mesh) -> Any:
    meshio = _needs("meshio", "mesh")
    blocks: list[tuple[str, Any]] = []
    for kind, rows in mesh.cells.items():
        order = _VTK.get(kind)
        blocks.append((kind, rows if order is None else rows[:, order]))
    sets: dict[str, list[Any]] = {name: [[]] * len(blocks) for name in mesh.groups}
    for name, tables in mesh.groups.items():
        for faces in tables:
            kind = {3: "triangle", 6: "triangle6", 4: "quad", 8: "quad8", 9: "quad9"}[faces.shape[1]]
            blocks.append((kind, faces))
            for other, entries in sets.items():
                entries.append(np.arange(len(faces)) if other == name else [])
    arrays = {name: [np.asarray(entry, dtype=np.int64) for entry in entries] for name, entries in sets.items()}
    return meshio.Mesh(np.asarray(mesh.nodes), blocks, cell_sets=arrays)


def from_gmsh(gmsh: Any) -> Mesh:
    """The mesh of the current model, with its physical groups of dimension 2."""
    try:
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
    except Exception as error:
        raise InputError(
            f"Gmsh has no model at hand: {error}", key="gmsh", hint="after `gmsh.initialize()` and a mesh"
        ) from error
    row = np.full(int(tags.max(initial=0)) + 1, -1, dtype=np.int64)
    row[tags] = np.arange(len(tags))

    def tables(dimension: int, entity: int, sizes: dict[int, int]) -> list[Any]:
        kinds, _, nodes = gmsh.model.mesh.getElements(dimension, entity)
        known = [(sizes[kind], own) for kind, own in zip(kinds, nodes) if kind in sizes]
        return [row[np.asarray(own, dtype=np.int64)].reshape(-1, size) for size, own in known]

    solid = [tag for _, tag in gmsh.model.getEntities(3)]
    cells = [rows for tag in solid for rows in tables(3, tag, _GMSH_VOLUMES)]
    groups: dict[str, list[Any]] = {}
    for dimension, tag in gmsh.model.getPhysicalGroups(2):
        name = gmsh.model.getPhysicalName(dimension, tag) or str(tag)
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            groups.setdefault(name, []).extend(tables(2, entity, _GMSH_FACES))
    return Mesh(coordinates.reshape(-1, 3), cells, groups)
