#!/usr/bin/env python3
"""Reads files of ale-gear with the programs that others use and prints one JSON object.

    python3 other_readers.py parquet RESULT_FOLDER     pyarrow: history.parquet against history.csv, bit by bit
    python3 other_readers.py mesh FILE.msh             meshio and the Gmsh SDK: nodes, elements, names, least Jacobian determinant
"""
import csv
import json
import math
import pathlib
import struct
import sys


def parquet(folder):
    import pyarrow.parquet

    table = pyarrow.parquet.read_table(folder / "history.parquet")
    with open(folder / "history.csv", newline="") as file:
        names, *rows = csv.reader(file)

    def same(a, b):
        return struct.pack("d", a) == struct.pack("d", b) or (math.isnan(a) and math.isnan(b))

    different = sum(
        not same(float(value), float(rows[i][j]))
        for j, name in enumerate(names)
        for i, value in enumerate(table[name].to_pylist())
    )
    return {"same_names": table.column_names == names, "rows": [table.num_rows, len(rows)], "different": different}


def mesh(file):
    import gmsh
    import meshio

    one = meshio.read(file)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(file))
    solids = gmsh.model.mesh.getElements(3)
    names = [gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()]
    found = {
        "nodes": [len(one.points), len(gmsh.model.mesh.getNodes()[0])],
        "hexahedra": [sum(len(c.data) for c in one.cells if c.type.startswith("hexahedron")), sum(len(t) for t in solids[1])],
        "same_names": sorted(one.field_data) == sorted(names),
        "names": sorted(names),
        "least_det_j": min(min(gmsh.model.mesh.getElementQualities(list(t), "minDetJac")) for t in solids[1]),
        "half_width": max(one.points[:, 2]),
    }
    gmsh.finalize()
    return found


if __name__ == "__main__":
    print(json.dumps({"parquet": parquet, "mesh": mesh}[sys.argv[1]](pathlib.Path(sys.argv[2]))))
