#!/usr/bin/env python3
"""Faults that are tried at every change: kills, signals, full disks, two writers, damaged files, lost outputs.

    faults.py PROGRAM STUDIES [--quick] [--seed N] [--only CASE,...]

Prints a line a case. Exit 1 if the program did what it must not: died by a signal, hung, kept silent, lost results.
"""
import argparse
import os
import struct
import sys
import tempfile
import time

import capacity_cases
import design_cases
import file_cases
import program_cases
import sweep_cases
from harness import Bench, Finding


def main():
    cases = {case.__name__: case for case in file_cases.CASES + program_cases.CASES + sweep_cases.CASES + capacity_cases.CASES +
             design_cases.CASES}
    parser = argparse.ArgumentParser(description="Tries faults on the program.")
    parser.add_argument("program")
    parser.add_argument("studies")
    parser.add_argument("--quick", action="store_true", help="under a minute of CPU time")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="cases, separated by commas: " + ", ".join(cases))
    options = parser.parse_args()
    chosen = options.only.split(",") if options.only else list(cases)
    if unknown := [name for name in chosen if name not in cases]:
        parser.error(f"no such case: {', '.join(unknown)}")
    bad = 0
    for name in chosen:
        begin = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="equipoise-faults-") as folder:
            bench = Bench(os.path.abspath(options.program), os.path.abspath(options.studies), folder,
                          f"{options.seed} {name}", options.quick)
            try:
                said = cases[name](bench)
                verdict = "ok"
            except (Finding, ValueError, LookupError, OSError, struct.error) as finding:  # or a file is invalid
                said, verdict, bad = f"{type(finding).__name__}: {finding}", "FAULT", bad + 1
        print(f"{verdict:6} {name:20} {time.monotonic() - begin:6.1f} s  {said}", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
