"""Capacities under kills, requests to stop, full disks and dead processes of a job: trials that were made stay made, and
the file ends up as if nothing had happened."""
from harness import Undisturbed, kept_through_kills_and_full_disks, same_for_any_number_of_processes


def undisturbed(bench, over=None, starts=None):
    # Short searches for attractors: of three trials in the quick form, of two cells in the long one.
    asked = ("balancer.drag=0.2", "0.08:0.14", 0.1, 100) if bench.quick else ("balancer.drag=0.2,0.25", "0.02:0.14", 0.01, 2000)
    usual, between, precision, few = asked
    starts = starts or few
    return Undisturbed(bench, f"undisturbed-{starts}.nc", "capacity", bench.study, "--set", "speed.speed=5", "--over", over or usual,
                       "--at-least", 0.9, "--between", between, "--precision", precision, "--starts", starts, "--quiet")


def capacity_faults(bench):
    return kept_through_kills_and_full_disks(bench, undisturbed(bench), 2 if bench.quick else 30)


def capacity_processes(bench):
    """Processes of one job: of several cells each has some, of one all decide starts of its trials; one of them killed."""
    cells = undisturbed(bench, over="balancer.drag=0.2,0.22,0.25")
    one = undisturbed(bench, over="balancer.drag=0.2", starts=20000)
    return same_for_any_number_of_processes(bench, ((2, cells, ()), (4, one, ()), (3, cells, ("--threads", "2")))[:2 if bench.quick else 3],
                                            1 if bench.quick else 6)


CASES = [capacity_faults, capacity_processes]
