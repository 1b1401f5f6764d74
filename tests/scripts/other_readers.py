#!/usr/bin/env python3
"""Reads files of ale-gear with the programs that others use and prints one JSON object.

    python3 other_readers.py parquet RESULT_FOLDER     pyarrow: history.parquet against history.csv, bit by bit
    python3 other_readers.py mesh FILE.msh             meshio and the Gmsh SDK: nodes, elements, names, least Jacobian determinant
    python3 other_readers.py uff RESULT_FOLDER         pyuff: bearing_forces.uff against bearing_forces.csv, function by function
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


def uff(folder):
    import pyuff

    with open(folder / "bearing_forces.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    speeds = sorted({float(row["input_rpm"]) for row in rows})
    sets = pyuff.UFF(str(folder / "bearing_forces.uff")).read_sets()
    functions = [one for one in sets if one["type"] == 58]
    directions = ["force_x_n", "force_y_n", "force_z_n", "moment_x_nmm", "moment_y_nmm", "moment_z_nmm"]
    worst, worst_hz = 0.0, 0.0
    per_order = 6 * max(one["rsp_node"] for one in functions)
    for number, one in enumerate(functions):
        own = rows[number // per_order :: len(rows) // len(speeds)]
        column = "bearing_{}_housing_{}".format(one["rsp_node"], directions[one["rsp_dir"] - 1])
        phase = column.rsplit("_", 1)[0] + "_phase_deg"
        largest = max(float(row[column]) for row in own)
        for row, value, frequency in zip(own, one["data"], one["x"], strict=True):
            angle = math.radians(float(row[phase]))
            wanted = float(row[column]) * complex(math.cos(angle), math.sin(angle))
            worst = max(worst, abs(value - wanted) / largest if largest else abs(value))
            worst_hz = max(worst_hz, abs(frequency / float(row["frequency_hz"]) - 1))
    return {
        "types": [one["type"] for one in sets],
        "length_factor": sets[0]["length"],
        "functions": len(functions),
        "rows": [len(rows), len(speeds)],
        "kind": sorted({(one["func_type"], one["ord_data_type"], one["abscissa_spacing"]) for one in functions}),
        "units": sorted({(one["abscissa_axis_units_lab"].strip(), one["ordinate_axis_units_lab"].strip()) for one in functions}),
        "worst": worst,
        "worst_hz": worst_hz,
    }


if __name__ == "__main__":
    print(json.dumps({"parquet": parquet, "mesh": mesh, "uff": uff}[sys.argv[1]](pathlib.Path(sys.argv[2]))))
