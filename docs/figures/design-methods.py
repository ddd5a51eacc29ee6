#!/usr/bin/env python3
"""Ways to search the same design with the same budget of trajectories: the optimiser's and those that do not learn.

    docs/figures/design-methods.py PROGRAM [SEEDS [TRAJECTORIES]]

Writes design-methods.csv (by method and seed: the chosen design's share on starts that its search did not see) and
design-methods-curves.csv (the best so far over trajectories) in this folder, and says how often the optimiser is at
least as good.
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
    program, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10
    budget = sys.argv[3] if len(sys.argv) > 3 else "150000"
    shares = {}
    with open(os.path.join(HERE, "design-methods.csv"), "w", encoding="utf-8") as table, \
            open(os.path.join(HERE, "design-methods-curves.csv"), "w", encoding="utf-8") as lines:
        rows, curves = csv.writer(table, lineterminator="\n"), csv.writer(lines, lineterminator="\n")
        rows.writerow(["method", "seed", "balanced", "low", "high", "starts", "trajectories"])
        curves.writerow(["method", "seed", "trajectories", "balanced"])
        for seed in range(1, seeds + 1):
            for method in METHODS:
                done = subprocess.run([program, "design", STUDY, "--trajectories", budget, "--json", "--quiet", "--set",
                                       f"design.method={method}", "--set", f"design.seed={seed}"], check=True, capture_output=True)
                told = json.loads(done.stdout)
                share = told["chosen"]["objectives"]["balanced"]
                shares[method, seed] = share
                rows.writerow([method, seed, share["value"], share["low"], share["high"], told["chosen"]["starts"], told["trajectories"]])
                curves.writerows([method, seed, step["trajectories"], step["value"]] for step in told["history"])
    for other in METHODS[1:]:
        wins = sum(shares["cmaes", s]["value"] >= shares[other, s]["value"] for s in range(1, seeds + 1))
        sure = sum(shares["cmaes", s]["high"] >= shares[other, s]["low"] for s in range(1, seeds + 1))
        print(f"cmaes is at least as good as {other} with {wins} of {seeds} seeds, and not surely worse with {sure}")


if __name__ == "__main__":
    main()
