"""A scene says the same however it is written, and is complained of in the command's words."""

from pathlib import Path

import pytest

import ale_gear
from ale_gear import ArgumentError, InputError, Pair, Scene, SceneError
from conftest import TABLES

TEXT = """
name = "quick"

[pinion]
teeth = 24
helix_angle_deg = 15.0

[pinion.mesher]
order = 1
sector_teeth = 1

[wheel]
teeth = 31

[wheel.mesher]
order = 1
sector_teeth = 1

[pair]
normal_module_mm = 3.0
face_width_mm = 20.0

[operation]
torque_nm = 120.0

[analysis]
positions_per_cycle = 8
"""


def test_tables_keywords_text_and_file_say_the_same(tmp_path):
    file = tmp_path / "quick.toml"
    file.write_text(TEXT)
    by_keywords = Scene(**TABLES)
    by_dots = Scene({"pinion.teeth": 24}, **{k: v for k, v in TABLES.items() if k != "pinion"},
                    **{"pinion.helix_angle_deg": 15.0, "pinion.mesher": {"order": 1, "sector_teeth": 1}})
    for other in (by_keywords, by_dots, Scene.from_toml(TEXT), Scene.read(file), Scene.read(str(file))):
        assert other == Scene(TABLES), other.to_toml()
    assert Scene(TABLES)["wheel.teeth"] == 31
    assert Scene(TABLES).to_dict()["wheel"]["helix_angle_deg"] == -15.0


def test_numbers_of_numpy_and_paths_are_values():
    np = pytest.importorskip("numpy")
    own = Scene(TABLES).set({"operation": {"torque_nm": np.float32(75), "speed_rpm": np.int64(900)},
                             "pinion": {"pitch_errors_um": np.zeros(24)}})
    assert (own["operation.torque_nm"], own["operation.speed_rpm"]) == (75.0, 900.0)
    with pytest.raises(SceneError, match="there is no file"):
        Scene({**TABLES, "pinion": {"teeth": 24, "helix_angle_deg": 15.0, "mesh": Path("nowhere.msh")}})


def test_a_complaint_has_the_words_of_the_command_and_the_line(tmp_path, command):
    for wrong, line, key in [
        (TEXT.replace("face_width_mm", "face_widht_mm"), 21, "face_widht_mm"),
        (TEXT.replace("teeth = 31", "teeth = 3"), 13, "teeth"),
        (TEXT.replace("torque_nm = 120.0", 'torque_nm = "much"'), 24, "torque_nm"),
        (TEXT.replace("[pair]", "[pair"), 19, None),
    ]:
        file = tmp_path / "wrong.toml"
        file.write_text(wrong)
        with pytest.raises(SceneError) as caught:
            Scene.read(file)
        error = caught.value
        assert f"ale-gear: {error.message}" == command("run", file, status=2).splitlines()[0]
        assert (error.line, error.key, error.file) == (line, key, str(file))
        assert error.hint and error.excerpt and str(error).endswith(f"hint: {error.hint}")
    with pytest.raises(SceneError) as caught:
        Scene({**TABLES, "pair": {"normal_module_mm": 3.0, "face_widht_mm": 20.0}})
    assert caught.value.key == "pair.face_widht_mm"
    assert caught.value.hint == "did you mean `face_width_mm`?"


def test_what_is_missing_is_named():
    with pytest.raises(SceneError, match="missing") as caught:
        Scene(pinion={"teeth": 24})
    assert caught.value.hint and caught.value.key


def test_a_pair_that_cannot_run_is_refused_by_validate():
    with pytest.raises((SceneError, InputError)) as caught:
        Scene(TABLES).set({"pair.centre_distance_mm": 200.0}).validate()
    assert caught.value.hint
    assert Scene(TABLES).validate() == []
    told = Scene(TABLES).set({"pinion.teeth": 12, "pinion.mesher.order": 2}).validate()
    assert [said.code for said in told] == ["undercut"], told
    assert told[0].values["gear"] == "pinion" and "profile_shift" in told[0].hint
    assert str(told[0]) == f"{told[0].text}; {told[0].hint}"


def test_a_scene_with_another_load_leaves_the_first_one_alone(scene):
    other = scene.set({"operation.torque_nm": 5.0})
    assert (scene["operation.torque_nm"], other["operation.torque_nm"]) == (120.0, 5.0)
    with pytest.raises(ArgumentError, match="no number of this scene"):
        scene["operation.torqe_nm"]


def test_the_default_scene_is_that_of_the_repository(top):
    assert Scene.default().to_toml() == Scene.read(top / "scenes/default.toml").to_toml()
    assert Scene.default(set={"operation": {"torque_nm": 300}})["operation.torque_nm"] == 300


def test_a_pair_comes_from_rexs(tmp_path, program):
    import subprocess

    file = tmp_path / "pair.rexs"
    scene = tmp_path / "scene.toml"
    scene.write_text(TEXT)
    told = subprocess.run([str(program), "geometry", str(scene), "--rexs", str(file)], capture_output=True, text=True)
    if told.returncode != 0:
        pytest.skip(f"no REXS from the command: {told.stderr}")
    own = Scene.from_rexs(file, set={"operation.torque_nm": 120.0})
    assert [own["pinion.teeth"], own["wheel.teeth"], own["pair.normal_module_mm"]] == [24, 31, 3]
    assert own["operation.torque_nm"] == 120.0
    with pytest.raises(InputError, match="stage 2 is wanted") as caught:
        Scene.from_rexs(file, stage=2)
    assert caught.value.hint


def test_every_key_has_a_place_in_the_schema():
    assert "operation.torque_nm" in Scene.keys()
    assert Scene.schema()["$defs"]["pair"]["properties"]["operation"]["properties"]["torque_nm"]["minimum"] == 0.0


def test_a_pair_wants_a_scene():
    with pytest.raises(ArgumentError) as caught:
        Pair("scene.toml")
    assert caught.value.key == "scene" and caught.value.hint
    assert isinstance(caught.value, ale_gear.AleGearError)
