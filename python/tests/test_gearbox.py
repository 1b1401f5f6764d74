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
