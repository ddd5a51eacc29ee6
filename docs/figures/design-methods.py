#!/usr/bin/env python3
"""Ways to search the same design with the same budget of trajectories: the optimiser's and Latin hypercubes, which do not learn.

    docs/figures/design-methods.py PROGRAM [STUDY [SEEDS [TRAJECTORIES [METHODS]]]]

STUDY: quick-spin-up (the default) or gentle-spin-up, of studies/designs, or another whose design has one objective. SEEDS: "10", the
first ten, or "11-20". Writes design-methods.csv, of another study design-methods-STUDY.csv (by method and seed: the chosen design's
objective on starts that its search did not see, and whether it kept its requirements there), in this folder, and says how often the
optimiser is at least as good. A design that misses a requirement is worse than any that misses none.
"""
import csv
import json
import os
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
DESIGNS = os.path.join(HERE, "..", "..", "studies", "designs")
METHODS = ("cmaes", "latin")
MORE_IS_BETTER = ("balanced", "passed")


def chosen_by(program, study, budget, method, seed):
    done = subprocess.run([program, "design", os.path.join(DESIGNS, study + ".toml"), "--trajectories", budget, "--json", "--quiet",
                           "--set", f"design.method={method}", "--set", f"design.seed={seed}"], check=True, capture_output=True)
    told = json.loads(done.stdout)
    (name, objective), = told["chosen"]["objectives"].items()
    kept = all(limit["kept"] for limit in told["chosen"]["constraints"].values())
    return name, objective, kept, told


def main():
    arguments = sys.argv[1:] + [None] * 5
    program, study = arguments[0], arguments[1] or "quick-spin-up"
    words = (arguments[2] or "10").split("-")
    seeds = range(int(words[0]) if len(words) > 1 else 1, int(words[-1]) + 1)
    budget = arguments[3] or "150000"
    methods = arguments[4].split(",") if arguments[4] else METHODS
    ranks = {}
    values = {method: [] for method in methods}
    suffix = "" if study == "quick-spin-up" else "-" + study
    with open(os.path.join(HERE, f"design-methods{suffix}.csv"), "w", encoding="utf-8") as table:
        rows = csv.writer(table, lineterminator="\n")
        for seed in seeds:
            for method in methods:
                name, objective, kept, told = chosen_by(program, study, budget, method, seed)
                if not ranks:
                    rows.writerow(["method", "seed", name, "low", "high", "kept", "starts", "trajectories", "candidates", "cpu_seconds"])
                ranks[method, seed] = (kept, objective["value"] if name in MORE_IS_BETTER else -objective["value"])
                values[method].append(objective["value"])
                rows.writerow([method, seed, objective["value"], objective["low"], objective["high"], "yes" if kept else "no",
                               told["chosen"]["starts"], told["trajectories"], told["candidates"], f"{told['cpu_seconds']:.1f}"])
                table.flush()
    for method in methods:
        kept = sum(ranks[method, s][0] for s in seeds)
        print(f"{method}: {min(values[method]):.6g} to {max(values[method]):.6g}, median {statistics.median(values[method]):.6g}; "
              f"requirements kept with {kept} of {len(seeds)} seeds")
    for other in methods[1:]:
        wins = sum(ranks[methods[0], s] >= ranks[other, s] for s in seeds)
        print(f"{methods[0]} is at least as good as {other} with {wins} of {len(seeds)} seeds")


if __name__ == "__main__":
    main()
