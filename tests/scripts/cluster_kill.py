"""Cases of a plan on Dask and on HyperQueue, a worker killed on the way: none is lost, none is there twice.

    python cluster_kill.py PROGRAM [dask] [hyperqueue]
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
CASES, CHUNK = 2000, 100
# A model of a millisecond a case: it is the engines that are tried here.
PLAN = f"""
scene = "{REPOSITORY}/scenes/iso.toml"
set = ["analysis.positions_per_cycle=360"]
[vary]
keys = ["operation.torque_nm~50:200", "wheel.profile_shift~0.0:0.2"]
output = ["peak_to_peak_ste_um"]
samples = {CASES}
"""


def children(process):
    """Processes below one, with their command lines."""
    parents, lines = {}, {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parents[int(entry.name)] = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                lines[int(entry.name)] = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except (OSError, IndexError):
                pass
    below, found = {process}, {}
    for _ in range(8):
        for child, parent in parents.items():
            if parent in below and child not in below:
                below.add(child)
                found[child] = lines[child]
    return found


def killed_once(recipe, worker, folder, program):
    """Runs a recipe, kills one of its workers once a quarter of the parts is there, and waits for the rest."""
    out = folder / recipe
    run = subprocess.Popen([sys.executable, REPOSITORY / "docs/cluster" / f"{recipe}_cases.py", folder / "plan.toml", out,
                            "--chunk", str(CHUNK), "--program", program], stdout=subprocess.DEVNULL)
    killed, since = None, time.monotonic()
    while run.poll() is None:
        if time.monotonic() - since > 300:
            run.kill()
            sys.exit(f"{recipe}: not done after 300 s")
        parts = list(out.with_name(out.name + ".parts").glob("*.csv"))
        if killed is None and len(parts) >= CASES // CHUNK // 4:
            workers = [child for child, line in children(run.pid).items() if worker in line]
            if workers:
                killed = workers[0]
                os.kill(killed, signal.SIGKILL)
        time.sleep(0.02)
    if run.returncode != 0 or killed is None:
        sys.exit(f"{recipe}: status {run.returncode}, killed {killed}")
    return (out / "cases.csv").read_bytes()


def main():
    program = shutil.which(sys.argv[1]) or sys.argv[1]
    program = str(Path(program).resolve())
    engines = {"dask": "spawn_main", "hyperqueue": " vary "}
    wanted = sys.argv[2:] or list(engines)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "plan.toml").write_text(PLAN)
        subprocess.run([program, "--quiet", "vary", folder / "plan.toml", "--out", folder / "whole"], check=True)
        whole = (folder / "whole/cases.csv").read_bytes()
        assert whole.count(b"\n") == CASES + 1, "a row a case"
        for engine in wanted:
            found = killed_once(engine, engines[engine], folder, program)
            assert found == whole, f"{engine}: other rows than on one machine"
            print(f"{engine}: {CASES} cases, a worker killed on the way, the same bytes as on one machine")
        # The script of Slurm, its tasks one after the other.
        slurm = [REPOSITORY / "docs/cluster/slurm_cases.sh", folder / "plan.toml", folder / "slurm", str(CHUNK)]
        (folder / "slurm.parts").mkdir()
        for task in [*range(CASES // CHUNK), 3]:
            environment = dict(os.environ, ALE_GEAR=program, SLURM_ARRAY_TASK_ID=str(task))
            subprocess.run(slurm, check=True, env=environment)
        subprocess.run([*slurm, "merge"], check=True, env=dict(os.environ, ALE_GEAR=program),
                       stdout=subprocess.DEVNULL)
        assert (folder / "slurm/cases.csv").read_bytes() == whole, "Slurm's script: other rows than on one machine"
        print("Slurm's script, its tasks one after the other: the same bytes")


if __name__ == "__main__":
    main()
