"""Whatever is given is taken, or refused with the key and a hint: nothing panics."""

import enum
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ale_gear import AleGearError, Mesh, Pair, Scene
from conftest import TABLES


class Odd:
    def __repr__(self):
        raise ValueError("no picture")


class Listed(enum.Enum):
    ONE = 1


ENDLESS: list = []
ENDLESS.append(ENDLESS)
DEEP: dict = {}
for _ in range(2000):
    DEEP = {"a": DEEP}

plain = (
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary(max_size=20) | st.complex_numbers()
    | st.sampled_from([Listed.ONE, np.array([]), np.zeros((2, 2)), np.float32(1), np.datetime64(0, "s"),
                       10**400, -(2**70), math.nan, math.inf, "\ud800", "a\0b", "x\ny = 1", "[", object, len, range(3), {1, 2}])
)
anything = st.recursive(plain, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8) | st.integers(), inner, max_size=3),
                        max_leaves=6)
keys = st.sampled_from([*Scene.keys(), "operation", "pinion", "motion.ramp", "", ".", "a.b", "operation.torque_nm.x", "pinion.mesher"]) | st.text(max_size=12)
many = settings(max_examples=100, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)


def refused_or_taken(call, *, hinted: bool = True):
    try:
        return call()
    except AleGearError as error:
        assert error.message and "\n" not in error.message.strip("\n")[:1]
        assert not hinted or error.hint or error.key, repr(error)
        return None


@many
@given(key=keys, value=anything)
def test_any_value_of_any_key(key, value):
    refused_or_taken(lambda: Scene(TABLES).set({key: value}))


@many
@given(tables=anything)
def test_any_tables(tables):
    refused_or_taken(lambda: Scene(tables))


@many
@given(text=st.text(max_size=200) | anything)
def test_any_text(text):
    refused_or_taken(lambda: Scene.from_toml(text))


@many
@given(which=st.sampled_from(["torque_nm", "positions", "fields", "set", "progress"]), value=anything)
def test_any_argument_of_a_static_run(pair, which, value):
    def call():
        if which == "positions" and isinstance(value, int) and value > 50:
            return None
        if which == "set" and isinstance(value, dict) and value:
            return None
        return pair.static(**{which: value})

    refused_or_taken(call)


@many
@given(which=st.sampled_from(["vary", "outputs", "samples", "design", "seed", "progress"]), value=anything)
def test_any_argument_of_a_plan(pair, which, value):
    words = {"vary": {"operation.torque_nm": [50.0]}, "outputs": "no_such_number", which: value}
    refused_or_taken(lambda: pair.vary(words.pop("vary"), words.pop("outputs"), **words))


@many
@given(which=st.sampled_from(["torques_nm", "measure", "max_pressure_mpa", "front"]), value=anything)
def test_any_argument_of_an_optimisation(pair, which, value):
    words = {"evaluations": 1, which: value}
    refused_or_taken(lambda: pair.optimise({"operation.torque_nm": (1.0, 2.0)}, **words))


@many
@given(value=anything)
def test_any_argument_of_the_others(pair, scene_of_module, tmp_file, value):
    scene = scene_of_module
    for call in (
        lambda: Pair(value), lambda: Pair(scene, meshes=value), lambda: Pair(scene, cache=value if not isinstance(value, str) else None),
        lambda: Scene.read(value), lambda: Scene.from_rexs(value), lambda: Scene.from_rexs(tmp_file, stage=value),
        lambda: Scene.from_toml("", file=value), lambda: Scene(TABLES, folder=value), lambda: scene[value],
        lambda: Mesh(value, np.zeros((1, 8), int), {}), lambda: Mesh(np.zeros((8, 3)), value, {}),
        lambda: Mesh(np.zeros((8, 3)), np.arange(8).reshape(1, 8), value), lambda: Mesh.read(value),
        lambda: pair.curve(value, 2.0), lambda: pair.curve(1.0, 2.0, key=value, set={"analysis.model": "nothing"}),
        # A motion that is sound would be solved: nothing sets a key back to its default.
        lambda: pair.motion(set={"motion.run": value}) if value is not None and value != "steady" else None,
    ):
        refused_or_taken(call)


@pytest.mark.parametrize("value", [Odd(), ENDLESS, DEEP, {"a": ENDLESS}, [DEEP]], ids=range(5))
def test_values_without_end_or_picture_are_refused(pair, value):
    """Hypothesis would want to show them."""
    for call in (lambda: Scene(TABLES).set({"operation.torque_nm": value}), lambda: Scene(value), lambda: pair.static(value),
                 lambda: pair.vary(value, "mean_ste_um"), lambda: Mesh(value, value, value), lambda: Pair(value)):
        with pytest.raises(AleGearError) as caught:
            call()
        assert caught.value.hint


@pytest.fixture(scope="module")
def scene_of_module():
    return Scene(TABLES)


@pytest.fixture(scope="module")
def tmp_file(tmp_path_factory):
    file = tmp_path_factory.mktemp("rexs") / "x.rexs"
    file.write_text("<model/>")
    return file


@many
@given(name=anything)
def test_any_name_of_a_column(solved, name):
    for call in (lambda: solved[name], lambda: solved.address(name), lambda: solved.read(name), lambda: solved.to_pyvista(name)):
        try:
            refused_or_taken(call, hinted=False)
        except KeyError as error:
            assert "no column" in str(error)
    assert (name in solved) == (isinstance(name, str) and name in solved.keys())


@pytest.fixture(scope="module")
def solved(pair):
    return pair.static()


def test_a_folder_with_other_files_is_left_alone(solved, tmp_path):
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(AleGearError, match="thesis.tex") as caught:
        solved.save(tmp_path)
    assert caught.value.hint and [p.name for p in tmp_path.iterdir()] == ["thesis.tex"]
