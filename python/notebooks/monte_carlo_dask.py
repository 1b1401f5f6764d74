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
# # Monte Carlo on Dask
#
# Gears are never ground as drawn. Each worker holds the pair, reduced once, and solves chunks of samples; what comes back
# is a distribution of the transmission error. On a cluster the same lines run with the address of its scheduler.

# %%
import sys

import numpy as np

import ale_gear

try:
    from dask.distributed import Client, LocalCluster
except ImportError as missing:
    print(f"Dask is not to be had here: {missing}")
    sys.exit(0)

TABLES = {
    "name": "scatter",
    "pinion": {"teeth": 24, "helix_angle_deg": 15.0, "mesher": {"order": 1, "sector_teeth": 1}},
    "wheel": {"teeth": 31, "mesher": {"order": 1, "sector_teeth": 1}},
    "pair": {"normal_module_mm": 3.0, "face_width_mm": 20.0},
    "operation": {"torque_nm": 120.0},
    "analysis": {"positions_per_cycle": 8},
}
HELD: dict = {}


def chunk(tables, samples):
    """Peak-to-peak STE of some samples, um; the pair stays with the worker."""
    if "pair" not in HELD:
        HELD["pair"] = ale_gear.Pair(ale_gear.Scene(tables)).reduce()
    found = []
    for slope, crowning, inclination in samples:
        result = HELD["pair"].static(set={
            "pinion.modification.drive.profile_slope_um": float(slope),
            "pinion.modification.drive.lead_crowning_um": float(crowning),
            "pair.misalignment.inclination_um": float(inclination),
        })
        found.append(result.headline["peak_to_peak_ste_um"])
    return found


# %%
if __name__ == "__main__":
    random = np.random.default_rng(1)
    samples = np.column_stack([random.normal(0, 2, 40), random.uniform(2, 8, 40), random.normal(0, 8, 40)])
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None)
    with Client(cluster) as client:
        tasks = [client.submit(chunk, TABLES, part) for part in np.array_split(samples, 4)]
        errors = np.array([error for task in tasks for error in task.result()])
    cluster.close()
    low, median, high = np.quantile(errors, [0.1, 0.5, 0.9])
    print(f"peak-to-peak STE {low:.3f} .. {median:.3f} .. {high:.3f} um (10, 50, 90 %) of {len(errors)} gears")
    # The order of the workers changes nothing.
    assert chunk(TABLES, samples[:1])[0] == errors[0]
