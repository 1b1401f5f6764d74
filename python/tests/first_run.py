"""What a wheel is tried with in a clean environment: no package but NumPy is there."""

import subprocess
import sys
import time

begun = time.perf_counter()
import ale_gear  # noqa: E402

took = time.perf_counter() - begun
scene = ale_gear.Scene(
    pinion={"teeth": 24, "helix_angle_deg": 15.0, "mesher": {"order": 1, "sector_teeth": 1}},
    wheel={"teeth": 31, "mesher": {"order": 1, "sector_teeth": 1}},
    pair={"normal_module_mm": 3.0, "face_width_mm": 20.0},
    operation={"torque_nm": 120.0},
    analysis={"positions_per_cycle": 8},
)
result = ale_gear.Pair(scene).reduce().static()
assert result.holds and len(result["ste_um"]) == 8
try:
    scene.set({"pair.face_widht_mm": 20.0})
except ale_gear.SceneError as error:
    assert error.hint == "did you mean `face_width_mm`?"
# The second import reads what the first has compiled.
quick = "import time; t = time.perf_counter(); import ale_gear; print(time.perf_counter() - t)"
again = float(subprocess.run([sys.executable, "-c", quick], capture_output=True, text=True, check=True).stdout)
print(
    f"Python {sys.version.split()[0]}: mean STE {result.headline['mean_ste_um']:.4f} um,"
    f" imported in {took:.3f} s, again in {again:.3f} s"
)
