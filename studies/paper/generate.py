#!/usr/bin/env python3
# Writes one study file for every published share or row of shares of Wright and Peng (2019), from published/*.csv.
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

STARTS = {"1": 300000, "2": 300000, "3": 100000, "4": 100000, "5": 100000, "6": 300000, "7": 300000}

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


def published(table, row, cells):
    """The comment that states the published shares; `cells` maps outcome to printed number."""
    parts = []
    for outcome, printed in cells.items():
        if (table, row, outcome) in PRINTED_AS_FRACTION:
            percent = plain(Decimal(printed) * 100)
            parts.append(f"{outcome} {percent} (printed as the fraction {plain(printed)})")
        else:
            parts.append(f"{outcome} {plain(printed)}")
    text = f"# Published shares in percent: {', '.join(parts)}.\n"
    if (table, row) in PRINTED_SUM:
        text += f"# The printed row sums to {PRINTED_SUM[table, row]}: one of its cells is misprinted.\n"
    return text


def study(table, title, shares, profile, release=None, drag="0.05", note=""):
    text = f"# Wright and Peng (2019), table {table}, {title}.\n{shares}{note}# Written by generate.py.\n"
    text += "\n[rotor]\neccentricity = 0.01\ndamping = 0.5\n"
    text += f"\n[balancer]\nballs = 2\nmass = 0.05\ndrag = {drag}\n"
    text += f"\n[speed]\n{profile}"
    if release:
        text += f"\n[release]\nspeed = {with_point(release)}\n"
    text += f"\n[sampling]\nstarts = {STARTS[table]}\nseed = 1\n"
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


def shares_of(row):
    return {outcome: row[outcome] for outcome in ("balanced", "V1", "V2", "V3", "V4") if outcome in row}


def rows(table):
    with open(HERE / "published" / f"table-{table}.csv", newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def studies():
    """Yields (file name, text) of every study."""
    for row in rows("1"):
        omega = with_point(row["Omega"])
        for beta in ("0.01", "0.05", "0.1", "0.25"):
            shares = published("1", omega, {"balanced": row[f"balanced_beta_{beta}"]})
            title = f"Omega = {omega}, beta = {beta}: constant speed, balls free from the start"
            yield f"table-1-beta-{beta}-omega-{omega}", study("1", title, shares, constant(omega), drag=beta)
    for row in rows("2"):
        omega = with_point(row["Omega"])
        title = f"Omega = {omega}: constant speed, balls free from the start"
        yield f"table-2-omega-{omega}", study("2", title, published("2", omega, shares_of(row)), constant(omega))
    for row in rows("3"):
        t0 = plain(row["T0"])
        title = f"T0 = {t0}: ramp 0 to 2.4, balls released at 2.4"
        yield f"table-3-t0-{t0}", study("3", title, published("3", t0, shares_of(row)), ramp("2.4", t0), "2.4")
    for row in rows("4"):
        omega = with_point(row["Omega_f"])
        title = f"Omega_f = {omega}: ramp 0 to {omega} in T0 = 500, balls released at {omega}"
        shares = published("4", omega, shares_of(row))
        yield f"table-4-omega-{omega}", study("4", title, shares, ramp(omega, "500"), omega)
    for row in rows("5"):
        t0 = plain(row["T0"])
        title = f"T0 = {t0}: ramp 0 to 2.4, balls released at 2.2"
        yield f"table-5-t0-{t0}", study("5", title, published("5", t0, shares_of(row)), ramp("2.4", t0), "2.2")
    for row in rows("6"):
        t0 = plain(row["T0"])
        for release in ("2", "3"):
            shares = published("6", t0, {"balanced": row[f"balanced_Omega_r_{release}"]})
            title = f"T0 = {t0}, Omega_r = {release}: ramp 0 to 5, balls released at {release}"
            yield f"table-6-release-{release}-t0-{t0}", study("6", title, shares, ramp("5", t0), release)
    for row in rows("7"):
        t0, t1, t2 = (plain(row[key]) for key in ("T0", "T1", "T2"))
        title = f"T0 = {t0}, T1 = {t1}, T2 = {t2}: trapezoid 0 to 3 to 2"
        yield f"table-7-t0-{t0}-t1-{t1}-t2-{t2}", study(
            "7", title, published("7", t0, shares_of(row)), trapezoid(t0, t1, t2), "3", note=TABLE_7_NOTE)


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
