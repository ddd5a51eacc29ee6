"""Threads, progress, Ctrl-C, memory."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import equipoise as eq


def test_progress_is_told_and_may_be_a_bar(easy, capsys):
    study, heard = easy, []
    eq.basin(study, starts=200, progress=lambda done, total, what: heard.append((done, total, what)))
    assert heard[-1][0] == heard[-1][1] == 200 and heard[-1][2] == "starts"
    eq.basin(study, starts=200, progress=True)
    assert "200/200" in capsys.readouterr().err
    with pytest.raises(TypeError, match="progress"):
        eq.basin(study, starts=10, progress="yes")


def test_what_a_callback_throws_comes_out(easy):
    study = easy

    def refuse(done, total, what):
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine"):
        eq.basin(study, starts=200, progress=refuse)
    eq.basin(study, starts=20)  # and the next call works


def test_threads_do_not_matter_and_calls_may_overlap(easy):
    answer, results = eq.basin(easy), {}

    def work(place):
        results[place] = eq.basin(easy, threads=1 + place % 2)

    workers = [threading.Thread(target=work, args=(k,)) for k in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    for place in range(3):
        np.testing.assert_array_equal(results[place].labels, answer.labels)
        np.testing.assert_array_equal(results[place].decision_time, answer.decision_time)
    with pytest.raises(ValueError, match="threads"):
        eq.basin(easy, threads=-1)


def test_other_threads_run_meanwhile(study):
    """The interpreter's lock is given up: a thread of Python goes on counting while an ensemble is computed."""
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    eq.basin(study, starts=3000, threads=1)
    done.set()
    counter.join()
    assert counted[0] > 20  # with the lock held it would be one


@pytest.mark.slow
def test_the_target_is_chosen_by_argument(easy):
    study = easy
    slow = eq.basin(study, starts=50, cpu="scalar")
    assert slow.data["cpu_target"] == "scalar"
    assert eq.cpu_targets()[-1] == "scalar" and eq.basin(study, starts=20).data["cpu_target"] == eq.cpu_targets()[0]
    with pytest.raises(eq.StudyError, match="AVX-9"):
        eq.basin(study, starts=50, cpu="AVX-9")


def cpu_of(pid):
    """CPU seconds of a running process. Other programs hardly stretch them, unlike seconds on the clock."""
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        user, system = file.read().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("progress", ["False", "lambda done, total, what: None"])
def test_ctrl_c_ends_a_call_soon_and_keeps_what_is_done(progress):
    script = textwrap.dedent(
        f"""
        import time, equipoise as eq
        study = eq.paper_study("table-2-omega-2.4").replace({{"balancer.drag": 0.25}})  # a quick search
        print("go", flush=True)
        try:
            eq.basin(study, starts=1_000_000_000, keep=False, progress={progress})
        except eq.Interrupted as stopped:
            print(time.process_time(), stopped.result.starts, stopped.result.partial, flush=True)
        """
    )
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None and child.stdout.readline() == "go\n"
    time.sleep(2.0)  # past the search for attractors
    sent = cpu_of(child.pid)
    os.kill(child.pid, signal.SIGINT)
    at, starts, partial = child.communicate(timeout=60)[0].split()
    assert child.returncode == 0 and partial == "True" and int(starts) > 0
    assert float(at) - sent < 2.0  # a tenth of that


@pytest.mark.parametrize(
    "call",
    [
        lambda s: eq.basin(s, starts=100_000_000, keep=False, within=1),
        lambda s: eq.attractors(s, starts=100_000_000, within="1s"),
        lambda s: eq.map(s, size=2000, within=1.0),
        lambda s: eq.sweep(s, {"speed.final": [2.0 + 0.01 * k for k in range(300)]}, within=1),
        lambda s: eq.capacity(s, starts=10_000_000, within=1),
        lambda s: eq.compare(s, s.replace(**{"balancer.drag": 0.3}), starts=100_000_000, within=1),
        lambda s: eq.follow(s, "speed.final", 1.4, 6.5, 0.005, within=1),
    ],
)
def test_a_call_returns_what_it_has_when_its_time_is_over(easy, call):
    begin = time.process_time()
    result = call(easy)  # does not raise: nobody interrupted it
    assert result.partial
    assert time.process_time() - begin < os.cpu_count() + 2.0  # of every core a second
    assert "PARTIAL" in result.text


def test_curves_and_planes_whose_time_is_over_say_so(study):
    ranges = dict(x_range=(0.5, 6.0), y_range=(0.01, 0.1))
    curves = eq.chart(study, size=1000, boxes=0, **ranges, within=0.5)
    assert curves.partial and "partial" in repr(curves) and pickle.loads(pickle.dumps(curves)).partial
    plane = eq.stability(study, size=2000, **ranges, within=0.5)
    assert plane.partial and "computed (PARTIAL)" in plane.answer
    assert sum(plane.shares.values()) == pytest.approx(1.0) and plane.shares["not computed"] > 0.0


def test_a_call_that_ends_in_time_is_whole(easy):
    done = eq.basin(easy, starts=100, within="1h")
    assert not done.partial and done.text.count("PARTIAL") == 0


def test_a_trajectory_ends_when_its_time_is_over(study):
    run = eq.simulate(study, 1e9, every=1e6, within=1)
    assert run.status == "stopped" and 0 < len(run.t) < 1000


@pytest.mark.parametrize("within", [0, -1, "5x", "", float("nan"), True, [1]])
def test_a_time_that_is_none_is_refused(study, within):
    with pytest.raises(eq.StudyError, match="within.*10000 h"):
        eq.basin(study, starts=100, within=within)


@pytest.mark.slow
def test_a_budgeted_ensemble_goes_on_to_the_bits_of_one_that_was_never_stopped(study, tmp_path):
    path, within = tmp_path / "parts.nc", 0.5
    while eq.basin(study, starts=60_000, output=path, within=within).partial:
        within *= 1.5  # a busy machine may not come to the first start in time
    parts = eq.basin(study, starts=60_000, output=path)
    whole = eq.basin(study, starts=60_000)
    assert (parts.labels == whole.labels).all() and (parts.decision_time == whole.decision_time).all()


def test_the_search_of_a_mapper_serves_an_ensemble_with_the_same_bits(study):
    mapper = eq.Mapper(study)
    stages: list[str] = []
    again = eq.basin(study, attractors=mapper, progress=lambda done, total, what: stages.append(what))
    assert set(stages) == {"starts"}  # no search
    alone = eq.basin(study)
    assert (again.labels == alone.labels).all() and (again.decision_time == alone.decision_time).all()
    for key in ("outcomes", "undecided"):
        assert again.data[key] == alone.data[key]
    # What a search does not depend on may differ: how the final speed is reached.
    ramp = study.replace(speed={"profile": "ramp", "final": 2.4, "duration": 100.0})
    assert (eq.basin(ramp, attractors=mapper).labels == eq.basin(ramp).labels).all()
    limited = study.replace(**{"limits.displacement": 0.1})
    assert (eq.basin(limited, attractors=mapper).labels == alone.labels).all()


def test_the_search_of_another_rotor_is_refused_with_the_key_that_differs(study):
    mapper = eq.Mapper(study)
    with pytest.raises(eq.StudyError, match=r"attractors.*balancer.drag is .*0.05.* there and .*0.06.* here"):
        eq.basin(study.replace(**{"balancer.drag": 0.06}), attractors=mapper)
    with pytest.raises(eq.StudyError, match="attractors.*a Mapper"):
        eq.basin(study, attractors="r.nc")  # type: ignore[arg-type]
    if "scalar" in eq.cpu_targets()[1:]:
        with pytest.raises(eq.StudyError, match="attractors.*must be the same cpu"):
            eq.basin(study, attractors=mapper, cpu="scalar")


INNER_LOOPS = {
    "a path": ("motion = eq.attractors(study, starts=100)[-1]", 0.3, "motion.path(1e5, 500_000)", "len(result.t) < 500_001"),
    # Of its starts many end in motions that nothing listed explains.
    "a capacity": ("", 4.0, "eq.capacity(study, at_least=0.6)", "True"),
}


@pytest.mark.slow
@pytest.mark.parametrize("call", INNER_LOOPS)
def test_ctrl_c_ends_what_a_call_is_following(call):
    before, after, text, holds = INNER_LOOPS[call]
    script = textwrap.dedent(
        f"""
        import signal, time, equipoise as eq
        signal.signal(signal.SIGINT, signal.default_int_handler)  # what starts the tests may ignore it
        study = eq.paper_study("table-2-omega-2.4")
        {before}
        print("go", flush=True)
        try:
            {text}
        except eq.Interrupted as stopped:
            result = stopped.result
            print(time.process_time(), {holds}, flush=True)
        """
    )
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None and child.stdout.readline() == "go\n"
    time.sleep(after)
    sent = cpu_of(child.pid)
    os.kill(child.pid, signal.SIGINT)
    at, holds = child.communicate(timeout=60)[0].split()
    assert child.returncode == 0 and holds == "True"
    assert float(at) - sent < 1.0  # 0.1 s; 1 to 3 s when what is followed is followed to its end


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_calls_leave_nothing_behind(study):
    """Resident memory is flat over hundreds of calls of every cheap kind."""
    model = eq.Model(study)
    state = model.initial_state

    def round_of_calls():
        for _ in range(250):
            model.rhs(0.0, state)
            eq.explain(study).data
            eq.simulate(study, [0.0, 5.0]).to_pandas()
            study.replace({"speed.final": 2.5}).to_toml()
            with pytest.raises(eq.StudyError):
                study.replace({"rotor.damping": -1})

    round_of_calls()
    before = resident()
    round_of_calls()
    round_of_calls()
    # A megabyte is 2 kB a call: less than any result here holds.
    assert resident() - before < 1 << 20


@pytest.mark.slow
def test_a_thousand_ensembles_leave_nothing_behind():
    """The same of ensembles, searches and threads included; EQUIPOISE_ENSEMBLES says how many, 60 in the quick run."""
    fan = eq.Study(
        rotor=dict(mass="12 kg", stiffness="48 kN/m", damping="380 N s/m", unbalance="2.4 kg mm"),
        balancer=dict(balls=2, race_radius="60 mm", mass="60 g", drag="2e-3 N m s"),
        speed=dict(profile="constant", speed="1450 rpm"),
    )
    calls = int(os.environ.get("EQUIPOISE_ENSEMBLES", "60"))
    warm = max(25, calls // 4)  # pools of threads and memory fill in the first few dozens
    for k in range(calls):
        if k == warm:
            before = resident()
        assert eq.basin(fan, starts=20, seed=k).starts == 20
    # What one answer holds is a hundred times as much a call.
    assert resident() - before < max(1 << 20, 1000 * (calls - warm))


@pytest.mark.parametrize("package", ["pandas", "xarray"])
def test_a_package_that_is_not_installed_is_named(study, monkeypatch, package):
    run = eq.simulate(study.replace({"initial.phi": [1.0, 4.0]}), [0.0, 1.0])
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"^this needs {package}, which is not installed: pip install {package}, or .*equipoise\[all\]$"):
        getattr(run, f"to_{package}")()
