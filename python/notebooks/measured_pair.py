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
# # A pair that was measured
#
# G. W. Blankenship and A. Kahraman measured the torsional vibration of a spur pair with 50 and 50 teeth (J. Sound Vib. 185,
# 1995). What they saw: the resonance softens, since flanks lose contact, so that on the way up the pair jumps to large motions below
# its resonance, and where that happens moves up with the torque. Their rig turned heavier inertias than the discs of this
# scene, and its damping is assumed; so it is the shape that is compared, not digits (docs/validation.md).

# %%
import numpy as np

import ale_gear

tables = {
    "name": "spur 50/50",
    "pinion": {"teeth": 50, "helix_angle_deg": 0.0, "bore_diameter_mm": 50.0, "thickness_allowance_mm": 0.05,
               "mesher": {"order": 1, "sector_teeth": 1}},
    "wheel": {"teeth": 50, "bore_diameter_mm": 50.0, "thickness_allowance_mm": 0.05,
              "mesher": {"order": 1, "sector_teeth": 1}},
    "pair": {"normal_module_mm": 3.0, "face_width_mm": 20.0},
    "operation": {"torque_nm": 340.0},
    "analysis": {"kind": "dynamic", "model": "mapped", "positions_per_cycle": 16},
    "motion": {"mesh_damping_ratio": 0.02},
}
pair = ale_gear.Pair(ale_gear.Scene(tables))

# %% [markdown]
# The curves at the lowest and at the highest torque of the measurements, from below the resonance on.

# %%
jumps = {}
for torque in (85.0, 340.0):
    curve = pair.curve(3000.0, 4600.0, set={
        "operation.torque_nm": torque, "motion.continuation.motions": 80, "motion.continuation.time_points": 1,
    })
    speed, swing = curve[curve.keys()[0]], curve["peak_to_peak_dte_um"]
    mesh_hz = 50 * speed / 60
    back = np.flatnonzero(np.diff(speed) < 0)
    assert len(back), f"the curve at {torque} N m has no fold"
    jumps[torque] = mesh_hz[back[0]]
    print(f"{torque:5.0f} N m: jumps up at {jumps[torque]:.0f} Hz, largest motion {swing.max():.1f} um")

# %% [markdown]
# As measured: softening (the curve turns back towards lower speeds), and more torque moves the jump up.

# %%
assert jumps[340.0] > jumps[85.0], jumps
