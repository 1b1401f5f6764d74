"""A gearbox file from Python: what it is made of, its rows, and what is wrong with one."""

from pathlib import Path

import numpy as np
import pytest

import ale_gear

SCENES = Path(__file__).parents[2] / "scenes" / "gearbox"


@pytest.fixture(scope="module")
def at_rest():
    """The two stages without what swings and moves."""
    text = (SCENES / "two_stages.toml").read_text().split("[vibration]")[0]
    return ale_gear.Gearbox.parse(text, SCENES / "two_stages.toml")


def test_rows_files_and_numbers_agree(at_rest):
    assert at_rest.shafts == ["fast", "middle", "slow"] and at_rest.meshes == ["first", "second"]
    assert len(at_rest.bearings) == 6 and "3 shafts" in repr(at_rest)
    phases = []
    result = at_rest.run(progress=lambda phase, *_: phases.append(phase))
    assert result.kind == "gearbox" and result.holds and result.rows == 8
    ste = result["mesh_2_ste_um"]
    assert not ste.flags.writeable
    assert result.headline["mean_ste_um"][1] == pytest.approx(float(np.mean(ste)), rel=1e-12)
    assert result.summary["certificate_checks"]["body_balance"]["value"] < 1e-9
    shafts = result.read("shafts.csv")
    assert set(shafts["shaft"]) == {"fast", "middle", "slow"}
    assert "solve" in phases
    assert (result["mesh_1_ste_um"] == at_rest.run(threads=1)["mesh_1_ste_um"]).all()


def test_a_wrong_file_is_refused_with_its_line(at_rest):
    text = (SCENES / "two_stages.toml").read_text().replace('pinion = "3"', 'pinion = "33"')
    with pytest.raises(ale_gear.SceneError) as error:
        ale_gear.Gearbox.parse(text, SCENES / "wrong.toml")
    assert error.value.line > 100 and error.value.hint
    with pytest.raises(ale_gear.AleGearError):
        ale_gear.Gearbox.read(SCENES / "none.toml")
    with pytest.raises(ale_gear.ArgumentError):
        ale_gear.Gearbox.read(3)


SLOPE = "mesh.0.scene.pinion.modification.lead_slope_um"


def test_it_is_varied_and_optimised(at_rest):
    rows = at_rest.vary({SLOPE: [0.0, 10.0], "bearing.4.stiffness_n_per_mm.0": "2e5,5e5"}, ["face_load_factor.0", "mean_bearing_force_n.4"])
    assert rows.kind == "plan" and rows.rows == 4 and set(rows["status"]) == {"solved"}
    assert rows["face_load_factor.0"][0] != rows["face_load_factor.0"][2]
    assert rows["face_load_factor.0"][1] == at_rest.run().headline["face_load_factor"][0]
    best = at_rest.optimise({SLOPE: (-60.0, 60.0)}, "face_load_factor.0", limits={"max_pressure_mpa.0": 5000.0}, evaluations=8)
    assert best.kind == "optimum" and best.headline["goal_optimum"] < 0.7 * best.headline["goal_start"]
    numbers = best.read("numbers.csv")
    assert numbers["after"][0] == best.headline["goal_optimum"] and numbers["limit"][1] == 5000.0
    with pytest.raises(ale_gear.AleGearError, match="face_load_factor"):
        at_rest.optimise({SLOPE: (-60.0, 60.0)}, "face_load_facto.0")
    with pytest.raises(ale_gear.SceneError, match="no mesh"):
        at_rest.vary({"mesh.7.scene.pair.face_width_mm": [20.0]}, "face_load_factor.0")
