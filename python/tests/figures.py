"""What the package is asked for in figures, measured on this machine: `python python/tests/figures.py`.

Not a test: it depends on how fast the machine is, and wants one that does nothing else.
"""

import _thread
import statistics
import subprocess
import sys
import threading
import time

import ale_gear

POSITIONS = 64
SCENE = ale_gear.Scene(
    pinion={"teeth": 24, "helix_angle_deg": 15.0, "mesher": {"order": 2, "sector_teeth": 1}},
    wheel={"teeth": 31, "mesher": {"order": 2, "sector_teeth": 1}},
    pair={"normal_module_mm": 3.0, "face_width_mm": 20.0},
    operation={"torque_nm": 120.0},
    analysis={"positions_per_cycle": POSITIONS},
)
TRIES = 9


def timed(work) -> float:
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


def second_cycle(pair) -> None:
    """A static cycle of a held pair, beside what the Rust code in it takes by its own clock."""
    ratios, walls = [], []
    for k in range(TRIES):
        begun = time.perf_counter()
        result = pair.static(100.0 + k)
        wall = time.perf_counter() - begun
        walls.append(wall)
        ratios.append(wall / result.summary["cost"]["wall_s"])
    print(f"second static cycle: {1e3 * statistics.median(walls):.1f} ms, {statistics.median(ratios):.3f} times Rust's")


def two_threads(pair) -> None:
    """The same work by one thread of Python, and by two, each question on one core."""

    def work(count):
        for k in range(count):
            pair.static(100.0 + k)

    def both():
        threads = [threading.Thread(target=work, args=(4,)) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    one, two = (statistics.median(timed(task) for _ in range(3)) for task in (lambda: work(8), both))
    print(f"two threads: {one / two:.2f} times one")


def ctrl_c(pair) -> None:
    waits = []
    for _ in range(TRIES):
        at = []
        timer = threading.Timer(0.3, lambda: (at.append(time.perf_counter()), _thread.interrupt_main()))
        timer.start()
        try:
            pair.static(set={"analysis.positions_per_cycle": 1000, "analysis.cycles": 100})
        except KeyboardInterrupt:
            waits.append(time.perf_counter() - at[0])
    print(f"Ctrl-C: {1e3 * max(waits):.0f} ms at the most, of {len(waits)}")


def imported() -> None:
    quick = "import time; t = time.perf_counter(); import ale_gear; print(time.perf_counter() - t)"
    bare = quick.replace("ale_gear", "numpy")
    for name, code in (("import", quick), ("of that NumPy", bare)):
        runs = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
                for _ in range(5)]
        print(f"{name}: {1e3 * statistics.median(runs):.0f} ms")


if __name__ == "__main__":
    held = ale_gear.Pair(SCENE).reduce()
    held.static()
    second_cycle(held)
    two_threads(ale_gear.Pair(SCENE, threads=1).reduce())
    ctrl_c(held)
    imported()
