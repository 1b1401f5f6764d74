"""The columns are those of the command, to the last bit, and so are the files."""

import json
import struct
from pathlib import Path

import pytest

from ale_gear import Pair, Scene

# Scenes of the repository, and what is set in them so that each takes a second at the most.
FEW = {"analysis.positions_per_cycle": 4}
SECTOR = {f"{gear}.mesher.{key}": 1 for gear in ("pinion", "wheel") for key in ("order", "sector_teeth")}
DYNAMIC = {"analysis.kind": "dynamic", "analysis.positions_per_cycle": 8, "motion.run": "span",
           "analysis.cycles": 2, "motion.mesh_damping_ratio": 0.05}
CASES = [
    ("coarse", FEW),
    ("coarse", {**FEW, "operation.torque_nm": 20.0}),
    ("coarse", {**FEW, "operation.torque_nm": 0.0}),
    ("coarse", {**FEW, "operation.rotation": "cw"}),
    ("coarse", {**FEW, "operation.driver": "wheel"}),
    ("coarse", {**FEW, "contact.friction": 0.05}),
    ("coarse", {**FEW, "contact.method": "nodal"}),
    ("coarse", {**FEW, "output.contact_lines": True}),
    ("coarse", {**FEW, "output.root_stress": True}),
    ("coarse", {**FEW, "pair.misalignment.inclination_um": 12.0}),
    ("coarse", {**FEW, "pinion.modification.drive.lead_crowning_um": 8.0}),
    ("coarse", {**FEW, "analysis.cycles": 2}),
    ("coarse", {**FEW, "output.derivatives": ["pair.misalignment.inclination_um"]}),
    ("iso", {}),
    ("iso", {"operation.torque_nm": 400.0}),
    ("spur", {**FEW, **SECTOR}),
    ("spur", {**FEW, **SECTOR, "operation.torque_nm": 40.0}),
    ("generated", {**FEW, **SECTOR}),
    ("modified", FEW),
    ("seeds/004", {}),
    ("seeds/002", {"operation.torque_nm": 20.0}),
    ("coarse", {**DYNAMIC}),
]


def bits(number: float) -> bytes:
    return b"nan" if number != number else struct.pack("<d", number)


def rows_of(file: Path) -> tuple[list[str], list[list[float]]]:
    lines = file.read_text().splitlines()
    return lines[0].split(","), [[float(field) for field in line.split(",")] for line in lines[1:]]


def words(value) -> str:
    """A value of a scene as `--set` has it."""
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else repr(value)


def without_times(summary: dict) -> dict:
    """What does not depend on who ran it, and how fast."""
    kept = {key: value for key, value in summary.items() if key not in ("cost", "files", "first_result_s")}
    model = dict(kept)
    model.pop("wall_time_s", None)
    return model


@pytest.mark.parametrize(("name", "settings"), CASES, ids=[f"{i}-{name}" for i, (name, _) in enumerate(CASES)])
def test_every_column_has_the_bits_of_the_command(name, settings, top, command, tmp_path):
    file = top / "scenes" / f"{name}.toml"
    set_words = [word for key, value in settings.items() for word in ("--set", f"{key}={words(value)}")]
    theirs = command("run", file, *set_words)
    result = Pair(Scene.read(file, set=settings)).run()
    names, rows = rows_of(theirs / "history.csv")
    assert result.keys() == names
    for k, column in enumerate(names):
        own, their = result[column], [row[k] for row in rows]
        assert len(own) == len(their)
        for i, (a, b) in enumerate(zip(own, their)):
            assert bits(a) == bits(b), f"{column}, row {i}: {a!r} here, {b!r} by the command"
    own = tmp_path / "own"
    result.save(own)
    assert sorted(p.name for p in own.iterdir()) == sorted(p.name for p in theirs.iterdir())
    for path in sorted(theirs.glob("*.csv")):
        assert (own / path.name).read_text() == path.read_text(), path.name
    mine, other = (json.loads((folder / "summary.json").read_text()) for folder in (own, theirs))
    mine, other = without_times(mine), without_times(other)
    assert mine.keys() == other.keys()
    for key in other:
        assert mine[key] == other[key] or key == "inputs", key
    assert result.headline == mine["headline"]


def test_a_held_pair_gives_the_bits_of_a_new_one(pair, scene):
    """Whatever was asked before."""
    pair.static(300.0)
    pair.static(set={"pinion.modification.drive.tip_relief_um": 10.0,
                     "pinion.modification.drive.tip_relief_start_roll_deg": 24.0})
    held, alone = pair.static(75.0), Pair(scene.set({"operation.torque_nm": 75.0})).static()
    for name in alone:
        assert held[name].tobytes() == alone[name].tobytes(), name


def test_many_torques_are_each_by_itself(pair):
    torques = [20.0, 80.0, 140.0]
    together = pair.static(torques)
    assert [result.headline["mean_normal_force_n"] > 0 for result in together] == [True] * 3
    for torque, result in zip(torques, together):
        assert result["ste_um"].tobytes() == pair.static(torque)["ste_um"].tobytes(), torque
    mean = [result.headline["mean_ste_um"] for result in together]
    assert mean == sorted(mean), "more torque, more lag"


def test_cases_of_a_plan_are_those_of_the_command(top, command):
    words = ["--vary", "operation.torque_nm=50:150:3", "--output", "peak_to_peak_ste_um", "--set",
             "analysis.positions_per_cycle=4"]
    theirs = command("vary", top / "scenes/coarse.toml", *words)
    scene = Scene.read(top / "scenes/coarse.toml", set=FEW)
    result = Pair(scene).vary({"operation.torque_nm": "50:150:3"}, "peak_to_peak_ste_um")
    names, rows = (theirs / "cases.csv").read_text().splitlines()[0].split(","), result.rows
    assert (result.keys(), rows) == (names, 3)
    assert result["status"] == ["solved"] * 3
    listed = Pair(scene).vary({"operation.torque_nm": [50, 100, 150]}, ["peak_to_peak_ste_um"])
    assert listed["peak_to_peak_ste_um"].tobytes() == result["peak_to_peak_ste_um"].tobytes()
    for i, line in enumerate((theirs / "cases.csv").read_text().splitlines()[1:]):
        assert bits(float(line.split(",")[2])) == bits(result["peak_to_peak_ste_um"][i])


def test_a_relief_within_bounds_makes_the_pair_quieter(top, tmp_path):
    pair = Pair(Scene.read(top / "scenes/coarse.toml", set=FEW))
    found = pair.optimise({"pinion.modification.drive.lead_crowning_um": (0.0, 10.0)}, evaluations=3)
    assert found.headline["goal_optimum_um"] <= found.headline["goal_start_um"]
    found.save(tmp_path / "optimum")
    assert Scene.read(tmp_path / "optimum/optimum.toml").validate() is not None
    assert found.read("harris.csv")
