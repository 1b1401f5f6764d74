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
# # Harris map and the quietest relief
#
# How much should be ground off the tips? S. L. Harris (Proc. IMechE 172, 1958) drew the answer as a map: peak-to-peak
# transmission error over the load, one curve for each relief. Here the map of a spur pair, and then the relief that an
# optimisation finds for a range of loads.

# %%
import numpy as np

import ale_gear

LONG = {"tip_relief_um": 0.0, "tip_relief_start_diameter_mm": 92.0}
QUICK = {"order": 1, "sector_teeth": 1}
scene = ale_gear.Scene(
    name="spur pair",
    pinion={"teeth": 30, "helix_angle_deg": 0.0, "thickness_allowance_mm": 0.05,
            "modification": {"drive": LONG}, "mesher": QUICK},
    wheel={"teeth": 30, "thickness_allowance_mm": 0.05, "modification": {"drive": LONG}, "mesher": QUICK},
    pair={"normal_module_mm": 3.0, "face_width_mm": 20.0},
    operation={"torque_nm": 150.0},
    analysis={"positions_per_cycle": 16},
)
pair = ale_gear.Pair(scene).reduce()
RELIEFS = [f"{gear}.modification.drive.tip_relief_um" for gear in ("pinion", "wheel")]

# %% [markdown]
# The gears are condensed once: relief and torque change neither matrices nor contact tables.

# %%
torques = np.array([30.0, 75.0, 150.0, 240.0])
harris = {}
for relief in (0.0, 6.0, 12.0):
    found = pair.static(torques, set={key: relief for key in RELIEFS})
    harris[relief] = np.array([result.headline["peak_to_peak_ste_um"] for result in found])
    print(f"{relief:4.0f} um:", "  ".join(f"{torque:.0f} N m {error:5.2f} um" for torque, error in zip(torques, harris[relief])))

# Every relief has a load of its own at which the error is smallest: the more is ground off, the higher.
best = [torques[np.argmin(errors)] for errors in harris.values()]
assert best == sorted(best), best

# %% [markdown]
# The same as a table of cases, a row a case.

# %%
cases = pair.vary(
    {"operation.torque_nm": torques, RELIEFS[0]: [0.0, 6.0, 12.0]}, ["peak_to_peak_ste_um", "max_pressure_mpa"]
)
print(cases.rows, "cases, columns", ", ".join(cases.keys()))

# %% [markdown]
# The relief for 75 to 225 N m, by exact derivatives.

# %%
optimum = pair.optimise(
    {key: (0.0, 20.0) for key in RELIEFS}, torques_nm=[75.0, 150.0, 225.0], measure="rms", evaluations=6
)
numbers = optimum.headline
print(f"goal {numbers['goal_start_um']:.3f} um at the start, {numbers['goal_optimum_um']:.3f} um at the optimum")
assert numbers["goal_optimum_um"] <= numbers["goal_start_um"]
optimum.save("out/harris_optimum")
