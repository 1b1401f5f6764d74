"""What all tests share: the repository, the command, and a scene that is solved at once."""

import os
import signal
import subprocess
from pathlib import Path

import pytest

import ale_gear

TOP = Path(__file__).resolve().parents[2]
# Gears of one sector each, few elements: tenths of a second.
TABLES = {
    "name": "quick",
    "pinion": {"teeth": 24, "helix_angle_deg": 15.0, "mesher": {"order": 1, "sector_teeth": 1}},
    "wheel": {"teeth": 31, "mesher": {"order": 1, "sector_teeth": 1}},
    "pair": {"normal_module_mm": 3.0, "face_width_mm": 20.0},
    "operation": {"torque_nm": 120.0},
    "analysis": {"positions_per_cycle": 8},
}


@pytest.fixture(scope="session", autouse=True)
def ctrl_c_is_heard() -> None:
    """Shells start what runs behind them deaf to it."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def top() -> Path:
    return TOP


@pytest.fixture
def scene() -> ale_gear.Scene:
    return ale_gear.Scene(TABLES)


@pytest.fixture(scope="session")
def pair() -> ale_gear.Pair:
    return ale_gear.Pair(ale_gear.Scene(TABLES)).reduce()


@pytest.fixture(scope="session")
def program() -> Path:
    """The command, built before these tests."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target"))
    found = Path(os.environ.get("ALE_GEAR", target / "debug" / "ale-gear"))
    if not found.is_file():
        pytest.skip(f"the command is not built: {found}")
    return found


@pytest.fixture
def command(program, tmp_path):
    """Runs the command and gives its result folder; or its complaint where it refuses."""

    def run(*words: object, status: int = 0):
        out = tmp_path / "command"
        done = subprocess.run(
            [str(program), "--quiet", *map(str, words), "--out", str(out), "--no-cache"],
            capture_output=True,
            text=True,
            cwd=TOP,
        )
        assert done.returncode == status, done.stderr
        return out if status == 0 else done.stderr

    return run
