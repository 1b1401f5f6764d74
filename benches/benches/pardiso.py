"""Factors the matrix that `factor.rs` has written with PARDISO (PyPI: pypardiso) on one core.

Prints seconds to order, seconds to factor (the fastest of the runs) and the answer to the load.
"""

import os
import sys
import time

os.environ["MKL_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402
import scipy.sparse as sp  # noqa: E402
from pypardiso import PyPardisoSolver  # noqa: E402

ORDER, FACTOR, SOLVE = 11, 22, 33
POSITIVE_DEFINITE = 2

path, runs = sys.argv[1], int(sys.argv[2])
data = np.fromfile(path, dtype=np.uint64)
n, stored = int(data[0]), int(data[1])
starts = data[2 : n + 3].astype(np.int32)
rows = data[n + 3 : n + 3 + stored].astype(np.int32)
reals = data[n + 3 + stored :].view(np.float64)
# Columns of the lower triangle are rows of the upper one.
upper = sp.csr_matrix((reals[:stored].copy(), rows, starts), shape=(n, n))
load = reals[stored:].copy()

order = factor = float("inf")
for _ in range(runs):
    solver = PyPardisoSolver(mtype=POSITIVE_DEFINITE)
    times = []
    for phase in (ORDER, FACTOR):
        solver.set_phase(phase)
        begun = time.perf_counter()
        solver._call_pardiso(upper, load)
        times.append(time.perf_counter() - begun)
    order, factor = min(order, times[0]), min(factor, times[1])
    solver.set_phase(SOLVE)
    answer = solver._call_pardiso(upper, load)
    solver.free_memory(everything=True)
print(order, factor)
np.savetxt(sys.stdout, np.ravel(answer))
