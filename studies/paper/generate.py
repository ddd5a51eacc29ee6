#!/usr/bin/env python3
# Writes one study file for every published share or row of shares of Wright and Peng (2019), from published/rows.csv.
"""Usage: generate.py [--check] [DIRECTORY]

Writes the studies into DIRECTORY (default: the folder of this script). With --check it writes nothing and exits with 1
if a study there is missing, differs or has no row in the tables. Needs the standard library only.
"""

import argparse
import csv
import sys
from decimal import Decimal
from pathlib import Path

HERE = Path(__file__).resolve().parent

# Cells that the paper prints as fractions of one in a table of percentages: (table, row, column).
PRINTED_AS_FRACTION = {("2", "3.2", "V1"), ("2", "4.4", "V4"), ("4", "4.4", "V4")}
# Rows whose printed shares do not sum to 100 within rounding, and their sum.
PRINTED_SUM = {("3", "25"): "100.07", ("5", "700"): "100.46"}

PUBLISHED_LAW = 'law = "published"  # psi = t Omega(t) on each branch: docs/explanation/equations.md\n'
TABLE_7_NOTE = """\
# The printed share is not reproducible from the paper's text: with the balls released at 3, the share is another under
# either speed law. docs/explanation/equations.md, "The tables' speed law", has the evidence.
"""


def plain(number):
    """A decimal without exponent or idle zeros: 1e-06 -> 0.000001, 100.0 -> 100."""
    text = format(Decimal(number), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def with_point(number):
    """A decimal with at least one place, which is a float in TOML: 2 -> 2.0."""
    text = plain(number)
    return text if "." in text else text + ".0"


def published(row):
    """The comment that states the published shares."""
    parts = []
    for outcome in ("balanced", "V1", "V2", "V3", "V4"):
        printed = row[outcome]
        if (row["table"], row["parameter"], outcome) in PRINTED_AS_FRACTION:
            percent = plain(Decimal(printed) * 100)
            parts.append(f"{outcome} {percent} (printed as the fraction {plain(printed)})")
        elif printed:
            parts.append(f"{outcome} {plain(printed)}")
    text = f"# Published shares in percent: {', '.join(parts)}.\n"
    if (row["table"], row["parameter"]) in PRINTED_SUM:
        text += f"# The printed row sums to {PRINTED_SUM[row['table'], row['parameter']]}: one of its cells is misprinted.\n"
    return text


def constant(omega):
    return f'profile = "constant"\nspeed = {with_point(omega)}\n'


def ramp(final, duration):
    return (f'profile = "ramp"\ninitial = 0.0\nfinal = {with_point(final)}\nduration = {with_point(duration)}\n'
            + PUBLISHED_LAW)


def trapezoid(t0, t1, t2):
    return ('profile = "trapezoid"\ninitial = 0.0\npeak = 3.0\nfinal = 2.0\n'
            f"rise_until = {with_point(t0)}\nhold_until = {with_point(t1)}\nfall_until = {with_point(t2)}\n"
            + PUBLISHED_LAW)


def study(row):
    """The text of a row's study."""
    table, label, at, other = row["table"], row["label"], row["parameter"], row["series"].split(" ")[-1]
    drag, release, note = "0.05", None, ""
    if table in ("1", "2"):
        title, profile, drag = f"{label}: constant speed, balls free from the start", constant(at), other or drag
    elif table in ("3", "5"):
        release = "2.4" if table == "3" else "2.2"
        title, profile = f"{label}: ramp 0 to 2.4, balls released at {release}", ramp("2.4", at)
    elif table == "4":
        release = at
        title, profile = f"{label}: ramp 0 to {at} in T0 = 500, balls released at {at}", ramp(at, "500")
    elif table == "6":
        release = other
        title, profile = f"T0 = {at}, Omega_r = {other}: ramp 0 to 5, balls released at {other}", ramp("5", at)
    else:
        t0, t1, t2 = label.split(", ")
        release, note = "3", TABLE_7_NOTE
        title, profile = f"T0 = {t0}, T1 = {t1}, T2 = {t2}: trapezoid 0 to 3 to 2", trapezoid(t0, t1, t2)
    text = f"# Wright and Peng (2019), table {table}, {title}.\n{published(row)}{note}# Written by generate.py.\n"
    text += "\n[rotor]\neccentricity = 0.01\ndamping = 0.5\n"
    text += f"\n[balancer]\nballs = 2\nmass = 0.05\ndrag = {drag}\n"
    text += f"\n[speed]\n{profile}"
    if release:
        text += f"\n[release]\nspeed = {with_point(release)}\n"
    return text + f"\n[sampling]\nstarts = {row['starts']}\nseed = 1\n"


def studies():
    """Yields (file name, text) of every study."""
    with open(HERE / "published" / "rows.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            yield row["study"], study(row)


def differences(directory, wanted):
    """What keeps `directory` from holding exactly the studies `wanted`."""
    there = {path.name: path.read_bytes() for path in directory.glob("table-*.toml")}
    yield from (f"{name}: missing" for name in sorted(wanted.keys() - there.keys()))
    yield from (f"{name}: has no row in the tables" for name in sorted(there.keys() - wanted.keys()))
    yield from (f"{name}: differs" for name in sorted(wanted.keys() & there.keys()) if wanted[name] != there[name])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("directory", nargs="?", type=Path, default=HERE)
    arguments = parser.parse_args()
    wanted = {f"{name}.toml": text.encode() for name, text in studies()}
    if arguments.check:
        found = list(differences(arguments.directory, wanted))
        print("\n".join(found) or f"{len(wanted)} studies as generated")
        return 1 if found else 0
    arguments.directory.mkdir(parents=True, exist_ok=True)
    for name, text in wanted.items():
        (arguments.directory / name).write_bytes(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
