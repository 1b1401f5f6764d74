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
# # A first pair
#
# Two meshed helical gears turn against each other under load. How much does the driven gear lag, how do the tooth pairs
# share the load? A scene says what the gears are and what presses on them; a pair holds the gears, reduced to their
# flanks; every question after that takes a fraction of a second.

# %%
import numpy as np

import ale_gear

scene = ale_gear.Scene(
    name="first pair",
    pinion={"teeth": 24, "helix_angle_deg": 18.0, "mesher": {"order": 1, "sector_teeth": 1}},
    wheel={"teeth": 31, "mesher": {"order": 1, "sector_teeth": 1}},
    pair={"normal_module_mm": 3.0, "face_width_mm": 20.0},
    operation={"torque_nm": 120.0, "speed_rpm": 1500.0},
    analysis={"positions_per_cycle": 16},
)
print(scene)
print(f"total contact ratio {scene.geometry()['eps_gamma']:.3f}")

# %% [markdown]
# A mistake is complained of with its key and a hint, as by the command.

# %%
try:
    scene.set({"pair.face_widht_mm": 22.0})
except ale_gear.SceneError as error:
    print(error)
    assert error.key == "pair.face_widht_mm"

# %% [markdown]
# The gears are meshed and reduced once.

# %%
pair = ale_gear.Pair(scene).reduce()
result = pair.static()
result

# %% [markdown]
# Columns are arrays in the solver's own memory: read-only, and none is copied.

# %%
ste = result["ste_um"]
print(f"STE {ste.mean():.3f} um in the mean, {np.ptp(ste):.3f} um peak to peak")
print(f"the hardest pressed tooth pair carries {result.headline['max_pair_force_n']:.0f} N")
assert not ste.flags.writeable

# %% [markdown]
# Many torques on the same reduction, side by side on all cores.

# %%
torques = [30.0, 60.0, 120.0, 240.0]
for torque, loaded in zip(torques, pair.static(torques)):
    numbers = loaded.headline
    print(f"{torque:6.0f} N m: mean STE {numbers['mean_ste_um']:7.3f} um, peak to peak {numbers['peak_to_peak_ste_um']:.3f} um")

# %% [markdown]
# The files are those that the command writes, the report among them.

# %%
result.save("out/first_pair")
print(", ".join(result.files))
