#!/usr/bin/env python3
"""Ways to search the same design with the same budget of trajectories: the optimiser's and those that do not learn.

    docs/figures/design-methods.py PROGRAM [SEEDS [TRAJECTORIES [METHODS]]]

SEEDS: "10", the first ten, or "11-20". Writes design-methods.csv (by method and seed: the chosen design's share on starts that its
search did not see) in this folder, and says how often the optimiser is at least as good.
"""
import csv
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
STUDY = os.path.join(HERE, "..", "..", "studies", "designs", "quick-spin-up.toml")
METHODS = ("cmaes", "random", "latin", "grid")


def main():
    program, words = sys.argv[1], (sys.argv[2] if len(sys.argv) > 2 else "10").split("-")
    seeds = range(int(words[0]) if len(words) > 1 else 1, int(words[-1]) + 1)
    budget = sys.argv[3] if len(sys.argv) > 3 else "150000"
    methods = sys.argv[4].split(",") if len(sys.argv) > 4 else METHODS
    shares = {}
    with open(os.path.join(HERE, "design-methods.csv"), "w", encoding="utf-8") as table:
        rows = csv.writer(table, lineterminator="\n")
        rows.writerow(["method", "seed", "balanced", "low", "high", "starts", "trajectories"])
        for seed in seeds:
            for method in methods:
                done = subprocess.run([program, "design", STUDY, "--trajectories", budget, "--json", "--quiet", "--set",
                                       f"design.method={method}", "--set", f"design.seed={seed}"], check=True, capture_output=True)
                told = json.loads(done.stdout)
                share = told["chosen"]["objectives"]["balanced"]
                shares[method, seed] = share["value"]
                rows.writerow([method, seed, share["value"], share["low"], share["high"], told["chosen"]["starts"], told["trajectories"]])
    for other in methods[1:]:
        wins = sum(shares[methods[0], s] >= shares[other, s] for s in seeds)
        print(f"{methods[0]} is at least as good as {other} with {wins} of {len(seeds)} seeds")


if __name__ == "__main__":
    main()
