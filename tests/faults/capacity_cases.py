"""Capacities under kills, requests to stop and full disks: trials that were made stay made, and the file ends up as if
nothing had happened."""
import os
import signal
import time

from harness import Undisturbed, ended, expect, limited, refused


def undisturbed(bench):
    # Short searches for attractors: of three trials in the quick form, of two cells in the long one.
    asked = ("balancer.drag=0.2", "0.08:0.14", 0.1, 100) if bench.quick else ("balancer.drag=0.2,0.25", "0.02:0.14", 0.01, 2000)
    over, between, precision, starts = asked
    return Undisturbed(bench, "undisturbed.nc", "capacity", bench.study, "--set", "speed.speed=5", "--over", over,
                       "--at-least", 0.9, "--between", between, "--precision", precision, "--starts", starts, "--quiet")


def capacity_faults(bench):
    """kill -9 and requests to stop at random moments, over and over at one file; then a file that may not grow."""
    capacity = undisturbed(bench)
    path = bench.path("killed.nc")
    rounds, kept = 2 if bench.quick else 30, 0
    for k in range(rounds):
        process = bench.start(*capacity.arguments, "--threads", 1 + k % 2, "-o", path)
        time.sleep(bench.random.uniform(0.4, 0.8) * capacity.seconds)
        process.send_signal((signal.SIGKILL, signal.SIGTERM)[k % 2])
        ended(process)
        for left in filter(os.path.exists, (path, path + ".part")):
            inspected = bench.run("inspect", left)
            expect(inspected.code == 0, f"{inspected}: damage after a kill")
        kept += os.path.exists(path + ".part") or os.path.exists(path)
    capacity.finish(bench, path, "after every kill")
    expect(kept > 0, "no kill came while something was kept")
    for part in (0.05, 0.95):
        path = bench.path(f"full-{part}.nc")
        done = bench.run(*capacity.arguments, "-o", path, preexec_fn=limited(int(part * len(capacity.content))))
        refused(done, 1, words=("cannot be written",))
        capacity.finish(bench, path, f"a disk full at {part}")
    return f"{rounds} kills"


CASES = [capacity_faults]
