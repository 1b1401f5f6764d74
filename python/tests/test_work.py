"""Runs leave the interpreter to others, tell how far they are, and end when the user says so."""

import _thread
import threading
import time

import pytest

from ale_gear import ArgumentError, Pair, Scene
from conftest import TABLES

# More positions than anybody waits for.
LONG = {"analysis.positions_per_cycle": 1000, "analysis.cycles": 100}


def test_others_run_python_while_a_pair_is_solved(scene):
    counted, over = [0], threading.Event()

    def count():
        while not over.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    Pair(scene).static(positions=64)
    after = counted[0]
    over.set()
    thread.join()
    assert after - before > 100, "the interpreter was held"


def test_two_threads_ask_one_pair_at_once(pair):
    alone = {torque: pair.static(torque)["ste_um"].tobytes() for torque in (50.0, 90.0)}
    found = {}

    def ask(torque):
        found[torque] = pair.static(torque)["ste_um"].tobytes()

    threads = [threading.Thread(target=ask, args=(torque,)) for torque in alone]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == alone


def test_a_question_on_one_core_has_the_same_bits(scene, pair):
    alone = Pair(scene, threads=1).static(75.0)
    assert alone.summary["cost"]["threads"] == 1
    shared = pair.static(75.0)
    for name in shared:
        assert alone[name].tobytes() == shared[name].tobytes(), name


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "2", 10**6, 10**30])
def test_threads_that_cannot_be_are_refused(scene, threads):
    with pytest.raises(ArgumentError, match="threads"):
        Pair(scene, threads=threads)


@pytest.mark.parametrize("ask", [
    lambda pair: pair.static(set=LONG),
    lambda pair: pair.static([50.0, 60.0], set=LONG),
    lambda pair: pair.motion(set={"analysis.cycles": 100_000, "motion.run": "span", "motion.mesh_damping_ratio": 0.05}),
    lambda pair: pair.vary({"operation.torque_nm": "50:150:100000"}, "mean_ste_um"),
])
def test_ctrl_c_ends_a_run(pair, ask):
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    begun = time.perf_counter()
    try:
        with pytest.raises(KeyboardInterrupt):
            ask(pair)
    finally:
        timer.cancel()
    waited = time.perf_counter() - begun
    # The run would take hours; how fast the machine is does not matter to that.
    assert waited < 60.0, f"{waited} s"
    # The pair is as it was.
    assert pair.static().holds


def test_progress_tells_every_phase(pair):
    told = []
    pair.static(set={"analysis.positions_per_cycle": 200},
                progress=lambda phase, done, total, message: told.append((phase, done, total)))
    assert told and told[-1][0] in ("solve", "change"), told
    assert all(total is None or done <= total for _, done, total in told)


def test_an_error_of_the_callback_ends_the_run(pair):
    def fail(*_):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        pair.static(set=LONG, progress=fail)


def test_a_bar_is_drawn_where_there_is_tqdm(capfd):
    pytest.importorskip("tqdm")
    Pair(Scene(TABLES)).static(positions=400, progress=True)
    assert "solve" in capfd.readouterr().err
