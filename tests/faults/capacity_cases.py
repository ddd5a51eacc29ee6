"""Capacities under kills, requests to stop and full disks: trials that were made stay made, and the file ends up as if
nothing had happened."""
from harness import Undisturbed, kept_through_kills_and_full_disks


def undisturbed(bench):
    # Short attractor searches: for three trials in the quick form, for two cells in the long one.
    asked = ("balancer.drag=0.2", "0.08:0.14", 0.1, 100) if bench.quick else ("balancer.drag=0.2,0.25", "0.02:0.14", 0.01, 2000)
    over, between, precision, starts = asked
    return Undisturbed(bench, "undisturbed.nc", "capacity", bench.study, "--set", "speed.speed=5", "--over", over,
                       "--at-least", 0.9, "--between", between, "--precision", precision, "--starts", starts, "--quiet")


def capacity_faults(bench):
    return kept_through_kills_and_full_disks(bench, undisturbed(bench), 2 if bench.quick else 30)


CASES = [capacity_faults]
