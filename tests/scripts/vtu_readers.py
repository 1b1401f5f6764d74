#!/usr/bin/env python3
"""Reads the ParaView files of a result folder with meshio and with PyVista and compares them with history.csv and summary.json.

    python3 vtu_readers.py RESULT_FOLDER         prints one JSON object: largest differences, in the units of the keys

What the files hold is where every node stands and how far it is displaced. From points less displacements follow the angles of both gears
(a rigid turn about each centre), from these the transmission error r_b1*theta_1 - r_b2*theta_2 against the first position, and the centre distance.
"""
import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

import meshio
import numpy as np
import pyvista


def turn(first, points):
    """Angle in the plane, rad, by which `points` are `first` turned about their common centre (least squares)."""
    a, b = first - first.mean(axis=0), points - points.mean(axis=0)
    return math.atan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]).sum())


def main(folder):
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "history.csv", newline="") as file:
        history = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    datasets = xml.etree.ElementTree.parse(folder / "gears.pvd").getroot().iter("DataSet")
    files = {}
    for entry in datasets:
        files.setdefault(float(entry.get("timestep")), {})[int(entry.get("part"))] = entry.get("file")
    assert len(files) == len(history), f"{len(files)} times in gears.pvd, {len(history)} rows in history.csv"
    rb = summary["geometry"]["base_radius_mm"]
    driver = 0 if summary["inputs"]["operation"]["driver"] == "pinion" else 1
    sense = 1.0 if summary["inputs"]["operation"]["rotation"] == "ccw" else -1.0
    worst = {"time_s": 0.0, "pinion_angle_deg": 0.0, "te_um": 0.0, "centre_distance_mm": 0.0, "readers": 0.0}
    first, fields = None, set()
    for (time, parts), row in zip(sorted(files.items()), history):
        worst["time_s"] = max(worst["time_s"], abs(time - row["time_s"]))
        stands = []
        for part in (0, 1):
            path = folder / parts[part]
            mesh, grid = meshio.read(path), pyvista.read(path)
            assert set(mesh.point_data) == set(grid.point_data.keys()), f"{path}: readers see other fields"
            fields |= set(mesh.point_data)
            worst["readers"] = max(worst["readers"], float(np.abs(mesh.points - grid.points).max()))
            for name, values in mesh.point_data.items():
                assert np.isfinite(values).all(), f"{path}: {name} has a value that is not a number"
                worst["readers"] = max(worst["readers"], float(np.abs(np.ravel(values) - np.ravel(grid.point_data[name])).max()))
            assert sum(len(c.data) for c in mesh.cells) == grid.n_cells, f"{path}: readers see other cells"
            # Nodes are written where the turned gear has them; the displacement is beside them, for `Warp By Vector`.
            stands.append(mesh.points)
        if first is None:
            first = stands
        angles = [turn(first[i], stands[i]) for i in (0, 1)]
        turned = math.degrees(sense * angles[0])
        worst["pinion_angle_deg"] = max(
            worst["pinion_angle_deg"], abs(turned - (row["pinion_angle_deg"] - history[0]["pinion_angle_deg"]))
        )
        # Both angles in the driving sense: the wheel turns against the pinion. Positive when the driven gear lags.
        lag = sense * (rb[0] * angles[0] + rb[1] * angles[1]) * (1.0 if driver == 0 else -1.0)
        worst["te_um"] = max(worst["te_um"], abs(1e3 * lag - (row["ste_um"] - history[0]["ste_um"])))
        centres = [points.mean(axis=0) for points in stands]
        distance = math.hypot(centres[1][0] - centres[0][0], centres[1][1] - centres[0][1])
        worst["centre_distance_mm"] = max(
            worst["centre_distance_mm"], abs(distance - summary["geometry"]["centre_distance_mm"])
        )
    print(json.dumps({"positions": len(history), "fields": sorted(fields), "worst": worst}))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
