#!/usr/bin/env python3
"""The numbers of README.md, from the files that `./dev validate --json` and `./dev bench --json` write.

    readme_numbers.py SOURCE [--renew]

Each stands between `<!-- number NAME -->` and `<!-- end -->`. Says which differ from the files and exits with 1; --renew
writes them anew.
"""
import json
import pathlib
import re
import sys

NUMBER = re.compile(r"(<!-- number (\S+) -->)(.*?)(<!-- end -->)", re.DOTALL)
ROW = "table-2-omega-2.4"  # the README's first command


def grouped(count):
    return f"{count:,}".replace(",", " ")


def of_validation(told):
    """What the paper's tables came to: told is what `./dev validate --json` prints."""
    tables = told["tables"]
    cells = {key: sum(table[key] for table in tables) for key in ("agrees", "differs", "not_comparable")}
    row = next(row for table in tables for row in table["rows"] if row["study"] == f"{ROW}.toml")
    cell = next(cell for cell in row["cells"] if cell["attractor"] == "balanced")
    computed = cell["computed"]
    half = 50.0 * (computed["high"] - computed["low"])
    return {
        "row-share": f"{100 * computed['share']:.2f} ± {half:.2f} %",
        "row-starts": grouped(row["published_law"]["starts"]),
        "row-printed": f"{float(cell['printed']):.2f} %",
        "cells-agree": f"{cells['agrees']} of {cells['agrees'] + cells['differs']}",
        "cells-not-comparable": str(cells["not_comparable"]),
        "starts-validated": f"{told['starts'] / 1e6:.1f} million",
    }


def of_benchmark(told):
    """How fast: told is what `./dev bench --json FILE` writes."""
    machine, works = told["machine"], told["works"]
    row = next(row for row in works["decided"]["rows"] if row["study"] == ROW and row["decide"] == "validated")
    slower = {engine["name"]: engine["equipoise_times_faster"]["median"] for engine in works["full"]["engines"]}
    return {
        "row-seconds": f"{row['wall_s']['median']:.1f} s",
        "machine": f"{machine['cores']} cores of an {machine['processor']}, {machine['instruction_set']}",
        "times-odeint": f"{slower['Odeint dopri5']:.0f}",
        "times-sundials": f"{min(times for name, times in slower.items() if name.startswith('SUNDIALS')):.0f}",
        "times-scipy": grouped(int(round(min(times for name, times in slower.items() if name.startswith("SciPy")), -1))),
    }


def main():
    source = pathlib.Path(sys.argv[1])
    evidence = source / "docs/evidence"
    numbers = of_validation(json.loads((evidence / "validation.json").read_text()))
    numbers |= of_benchmark(json.loads((evidence / "benchmark-avx2.json").read_text()))
    page = source / "README.md"
    text = page.read_text()
    named = [match[2] for match in NUMBER.finditer(text)]
    if unknown := sorted(set(named) - set(numbers)):
        sys.exit(f"README.md: no number is called {', '.join(unknown)}; there are {', '.join(numbers)}")
    if "--renew" in sys.argv:
        page.write_text(NUMBER.sub(lambda match: match[1] + numbers[match[2]] + match[4], text))
        return
    stale = [f"README.md says {match[3]}, the files say {numbers[match[2]]} ({match[2]})"
             for match in NUMBER.finditer(text) if match[3] != numbers[match[2]]]
    print(*stale, sep="\n")
    if stale or not named:
        sys.exit("README.md: no number is marked" if not named else "docs/figures/readme_numbers.py . --renew writes them anew")


if __name__ == "__main__":
    main()
