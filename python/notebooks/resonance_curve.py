# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     name: python3
# ---

# %% [markdown]
# # A resonance curve around its folds
#
# Where the teeth lift off, a pair has two answers at one speed and a third one between them that no test bench shows. The
# curve is followed along the speed by harmonic balance, stable and unstable motions alike.

# %%
import numpy as np

import ale_gear

scene = ale_gear.Scene(
    name="light load",
    pinion={"teeth": 30, "helix_angle_deg": 0.0, "thickness_allowance_mm": 0.05, "mesher": {"order": 1, "sector_teeth": 1}},
    wheel={"teeth": 30, "thickness_allowance_mm": 0.05, "mesher": {"order": 1, "sector_teeth": 1}},
    pair={"normal_module_mm": 3.0, "face_width_mm": 20.0},
    operation={"torque_nm": 50.0},
    analysis={"kind": "dynamic", "model": "mapped", "positions_per_cycle": 16},
    motion={"mesh_damping_ratio": 0.03},
)
pair = ale_gear.Pair(scene)
curve = pair.curve(4500.0, 7000.0, set={"motion.continuation.motions": 120, "motion.continuation.time_points": 1})
print(curve)

# %%
speed, swing, stable = (curve[name] for name in (curve.keys()[0], "peak_to_peak_dte_um", "stable"))
top = int(np.argmax(swing))
print(f"{len(speed)} motions, {int((stable == 0).sum())} of them unstable")
print(f"the highest swings {swing[top]:.2f} um at {speed[top]:.0f}/min")
assert swing[top] > 1.5 * swing[0], "there is a resonance"

# %% [markdown]
# Where the curve turns back there is a fold: on the way up and on the way down the pair jumps at different speeds.

# %%
back = np.flatnonzero(np.diff(speed) < 0)
print(f"the curve turns back between {speed[back].min():.0f} and {speed[back].max():.0f}/min" if len(back) else "no fold")
curve.save("out/resonance_curve")
