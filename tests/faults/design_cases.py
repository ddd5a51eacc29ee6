"""Designs under kills, requests to stop, full disks and dead processes of a job: ensembles that were made stay made, and the
file ends up as if nothing had happened."""
from harness import Undisturbed, kept_through_kills_and_full_disks, same_for_any_number_of_processes

# Spin-ups to one speed: an ensemble costs only its starts, so many are made between two kills.
DESIGN = """
[design]
objective = ["balanced"]
method = "latin"
starts = 100
trajectories = {trajectories}
[design.vary]
speed = {{ points = 1, until = 200.0, range = [0.0, 5.0], slope = 0.05 }}
"release.time" = [0.0, 150.0]
"""


def undisturbed(bench):
    study = bench.path("design.toml")
    with open(bench.study, encoding="utf-8") as base, open(study, "w", encoding="utf-8") as file:
        file.write(base.read() + DESIGN.format(trajectories=60000 if bench.quick else 300000))
    return Undisturbed(bench, "undisturbed.nc", "design", study, "--quiet")


def design_faults(bench):
    # The first half of the time goes to attractors, of which nothing is kept.
    return kept_through_kills_and_full_disks(bench, undisturbed(bench), 2 if bench.quick else 30, moments=(0.65, 0.9))


def design_processes(bench):
    """Processes of one job share a search's candidates; one of them killed."""
    design = undisturbed(bench)
    return same_for_any_number_of_processes(bench, ((2, design, ()), (4, design, ()))[:1 if bench.quick else 2],
                                            1 if bench.quick else 6)


CASES = [design_faults, design_processes]
