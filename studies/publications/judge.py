#!/usr/bin/env python3
"""Numbers that other groups published, computed again with equipoise and judged.

    judge.py [PUBLICATION...] [--csv | --markdown | --rows]

PUBLICATION is a name in sources.csv (default: all). A verdict is

    agrees             the numbers are as near as both errors together allow
    differs            they are farther apart (exit code 3)
    differs as known   they are farther apart, and `reason` says why
    not computed       `reason` says why

docs/evidence/publications.md is what --markdown prints, publications.csv next to it what --rows prints. Everything takes about a
minute of one core.

sources.csv has a line per publication, symbols.csv what its symbols are in a study, numbers.csv its numbers:

    known_by           printed; read off a plot; by a formula; or by the code run that was published with it
    published, error   the number, and how far it may be off
    study, settings    a study in this folder (default: the publication's in sources.csv), and overrides, "key=TOML; ..."
    measure            a function of measures.py with its arguments; empty if the number is not computed
    other, other_error the same number from another program with the same equations (SciPy's DOP853, eigenvalues, a Magnus
                       series over half a turn, Newton's method on the period), and how far that may be off
"""

import argparse
import csv
import io
import math
import pathlib
import sys
import tomllib

import equipoise as eq
import measures

here = pathlib.Path(__file__).resolve().parent
VERDICTS = "agrees", "differs", "differs as known", "not computed"
HEADINGS = "where", "quantity", "settings", "published", "by", "here", "verdict"
NOTE = (
    "A number agrees if it lies as near to the publication's as both errors together allow. A published error is half a unit of "
    "the last digit, or what a plot can be read to. For time histories that is 2 % of the axis, for charts 0.01 in the speed and "
    "0.02 decades. An error here is what the computation leaves open: a sample's 95 % interval, the spread of irregular motions, steps of "
    "a search. [publications.csv](publications.csv) has every number with its settings."
)


def table(name):
    with open(here / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def study_of(row):
    settings = (part.split("=", 1) for part in row["settings"].split("; ") if part)
    return eq.Study.from_file(here / f"{row['study']}.toml").replace(
        {key: tomllib.loads(f"value = {value}")["value"] for key, value in settings}
    )


def unit_of(study, unit):
    """What a dimensionless 1 is in this unit."""
    scales = study.scales
    return {
        "": lambda: 1.0,
        "%": lambda: 100.0,
        "um": lambda: scales["length"] * 1e6,
        "mm": lambda: scales["length"] * 1e3,
        "1/s": lambda: 1.0 / scales["time"],
        "rad/s": lambda: 1.0 / scales["time"],
        "rpm": lambda: 30.0 / math.pi / scales["time"],
    }[unit]()


def argument(text):
    try:
        return float(text)
    except ValueError:
        return text


def verdict(row):
    if row["computed"] is None:
        return "not computed"
    if abs(row["published"] - row["computed"]) <= row["error"] + row["computed_error"]:
        return "agrees"
    return "differs as known" if row["reason"] else "differs"


def numbers(publication):
    """Its rows of numbers.csv."""
    rows = [row for row in table("numbers") if row["publication"] == publication["publication"]]
    for row in rows:
        row.update(published=float(row["published"]), error=float(row["error"]))
        row["elsewhere"], row["study"] = row["study"], row["study"] or publication["study"]
    return rows


def judged(row):
    """The row with `computed`, `computed_error` and `verdict`."""
    computed = error = None
    if row["measure"]:
        name, *arguments = row["measure"].split()
        study = study_of(row)
        found = getattr(measures, name)(study, *map(argument, arguments))
        computed, error = (unit_of(study, row["unit"]) * float(number) for number in found)
    row = {**row, "computed": computed, "computed_error": error}
    return {**row, "verdict": verdict(row)}


def with_error(value, error, unit):
    if value is None:
        return ""
    digits = ".0f" if error >= 100.0 else ".1g" if error < 1.0 else ".2g"
    return f"{value:.5g}" + f" ± {error:{digits}}" * (error > 0.0) + f" {unit}" * bool(unit)


def shown(row):
    """The row as its page has it, under HEADINGS."""
    settings = ": ".join(part for part in (row["elsewhere"], row["settings"].replace("; ", ", ")) if part)
    because = f": {row['reason']}" if row["verdict"] in VERDICTS[2:] else ""
    return [
        row["place"], row["quantity"], settings, with_error(row["published"], row["error"], row["unit"]), row["known_by"],
        with_error(row["computed"], row["computed_error"], row["unit"]), row["verdict"] + because,
    ]


def tally(rows):
    agree, differ, known, missing = (sum(row["verdict"] == v for row in rows) for v in VERDICTS)
    why = "" if not known else f", {'each' if not differ else f'{known} of them'} for a reason that is known"
    return f"{agree} of {len(rows) - missing} numbers agree, {differ + known} differ{why}; {missing} not computed."


def escaped(text):
    return text.replace("|", r"\|").replace("_", r"\_")


def markdown(results):
    """The page's lines: numbers are counted, those that differ by their reason."""
    yield "# Other publications, computed again\n"
    yield f"> {tally([row for _, rows in results for row in rows])}\n\n{NOTE}"
    for publication, rows in results:
        yield f"\n## {publication['title']}\n\n{publication['citation']}.\n"
        yield f"Read: {escaped(publication['read'])}.\n"
        yield f"{tally(rows)} Study: studies/publications/{publication['study']}.toml"
        others = [row for row in rows if row["verdict"] != "agrees"]
        for reason in dict.fromkeys(row["reason"] for row in others):
            because = [row for row in others if row["reason"] == reason]
            places = ", ".join(dict.fromkeys(row["place"] for row in because))
            words = f"{because[0]['verdict'].capitalize()}, {len(because)} of {len(rows)} ({places}): {reason}."
            yield "\n" + escaped(words)
    yield "\nMade by `studies/publications/judge.py`, a script for the [Python package](../reference/python.md)."


def rows_of(results):
    """The lines of publications.csv: every number as it is shown."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("publication", *HEADINGS))
    writer.writerows([publication["publication"], *shown(row)] for publication, rows in results for row in rows)
    return text.getvalue()


def main(arguments=None):
    sources = {source["publication"]: source for source in table("sources")}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("publication", nargs="*", default=list(sources), metavar="PUBLICATION", help=", ".join(sources))
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--csv", action="store_true", help="print numbers.csv with what was computed, and the verdicts")
    form.add_argument("--markdown", action="store_true", help="print the page")
    form.add_argument("--rows", action="store_true", help="print every number as the page's table has it, as CSV")
    options = parser.parse_args(arguments)
    if unknown := set(options.publication) - set(sources):
        parser.error(f"unknown publication {min(unknown)}; must be among {', '.join(sources)}")

    results = []
    for name in options.publication:
        rows = []
        for row in numbers(sources[name]):
            rows.append(judged(row))
            if not (options.csv or options.markdown or options.rows):
                where, what, settings, published, by, computed, said = shown(rows[-1])
                print(f"{name}, {where}: {what}" + f" ({settings})" * bool(settings))
                print(f"    {by} {published}" + f", here {computed}" * bool(computed) + f": {said}", flush=True)
        results.append((sources[name], rows))
    everything = [row for _, rows in results for row in rows]
    if options.markdown:
        print("\n".join(markdown(results)))
    elif options.rows:
        print(rows_of(results), end="")
    elif options.csv:
        writer = csv.DictWriter(sys.stdout, everything[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(everything)
    else:
        print(tally(everything))
    return 3 if any(row["verdict"] == "differs" for row in everything) else 0


if __name__ == "__main__":
    sys.exit(main())
