"""The cases of a plan on Dask workers: local ones, or those of a scheduler that is running.

    python dask_cases.py plan.toml out                                    # two workers on this machine
    python dask_cases.py plan.toml out --scheduler tcp://head:8786        # workers that share this folder

Each task is one call of `ale-gear vary --cases`, which may be made again without harm: a worker that dies costs the chunk that
it was at, and Dask gives that to another one. At the end the parts are merged.
"""

import argparse
import os
import subprocess
from pathlib import Path

from dask.distributed import Client, LocalCluster, as_completed


def solve(program, plan, cases, part):
    done = subprocess.run([program, "--quiet", "-j", "1", "vary", plan, "--cases", cases, "--out", part], text=True,
                          stderr=subprocess.PIPE)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return cases


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("plan", type=Path)
    words.add_argument("out", type=Path)
    words.add_argument("--chunk", type=int, default=100, help="cases a task")
    words.add_argument("--scheduler", help="address of a running scheduler")
    words.add_argument("--workers", type=int, default=2, help="local workers, where there is no scheduler")
    words.add_argument("--program", default="ale-gear")
    words = words.parse_args()

    listed = subprocess.run([words.program, "vary", words.plan, "--list", str(words.chunk)], check=True, text=True,
                            stdout=subprocess.PIPE)
    ranges = listed.stdout.split()
    parts = words.out.with_name(words.out.name + ".parts").absolute()
    parts.mkdir(parents=True, exist_ok=True)
    part_of = {cases: str(parts / f"{cases}.csv") for cases in ranges}

    cluster = words.scheduler or LocalCluster(n_workers=words.workers, threads_per_worker=1, host="127.0.0.1",
                                              dashboard_address=None)
    with Client(cluster) as client:
        print("scheduler", client.scheduler.address, "process", os.getpid(), flush=True)
        tasks = [client.submit(solve, words.program, str(words.plan.absolute()), cases, part_of[cases], retries=3)
                 for cases in ranges]
        for done in as_completed(tasks):
            print("done", done.result(), flush=True)
    subprocess.run([words.program, "merge", words.plan, *part_of.values(), "--out", words.out], check=True)


if __name__ == "__main__":
    main()
