"""The cases of a plan as programs of HyperQueue: on this machine, or on a server that is running.

    python hyperqueue_cases.py plan.toml out                              # two workers on this machine
    python hyperqueue_cases.py plan.toml out --server ~/.hq-server        # workers that share this folder

Each task is one call of `ale-gear vary --cases`. A task that was killed is submitted again: the call may be made any number of
times. At the end the parts are merged.
"""

import argparse
import subprocess
from pathlib import Path

from hyperqueue import Client, Job, LocalCluster
from hyperqueue.client import FailedJobsException
from hyperqueue.cluster import WorkerConfig


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("plan", type=Path)
    words.add_argument("out", type=Path)
    words.add_argument("--chunk", type=int, default=100, help="cases a task")
    words.add_argument("--server", type=Path, help="folder of a running server")
    words.add_argument("--workers", type=int, default=2, help="local workers, where there is no server")
    words.add_argument("--program", default="ale-gear")
    words.add_argument("--tries", type=int, default=5)
    words = words.parse_args()

    listed = subprocess.run([words.program, "vary", words.plan, "--list", str(words.chunk)], check=True, text=True,
                            stdout=subprocess.PIPE)
    parts = words.out.with_name(words.out.name + ".parts").absolute()
    parts.mkdir(parents=True, exist_ok=True)
    part_of = {cases: parts / f"{cases}.csv" for cases in listed.stdout.split()}

    def submit(client):
        for _ in range(words.tries):
            # What is there is whole: a part appears under its name when it is complete.
            missing = {cases: part for cases, part in part_of.items() if not part.exists()}
            if not missing:
                return
            job = Job()
            for cases, part in missing.items():
                # What a task says stays with its part, not in the folder that this was called from.
                job.program([words.program, "--quiet", "-j", "1", "vary", str(words.plan.absolute()), "--cases", cases,
                             "--out", str(part)], name=cases,
                            stdout=parts / f"{cases}.stdout", stderr=parts / f"{cases}.stderr")
            print("tasks", len(missing), flush=True)
            try:
                client.wait_for_jobs([client.submit(job)])
            except FailedJobsException as failed:
                print("again:", str(failed).splitlines()[0], flush=True)

    if words.server:
        submit(Client(words.server))
    else:
        with LocalCluster() as cluster:
            for _ in range(words.workers):
                cluster.start_worker(WorkerConfig(cores=1))
            submit(cluster.client())
    subprocess.run([words.program, "merge", words.plan, *part_of.values(), "--out", words.out], check=True)


if __name__ == "__main__":
    main()
