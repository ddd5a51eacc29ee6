#!/usr/bin/env python3
"""Computes the balanced share of published table rows and judges each by the errors of both samples.

    compare_with_published.py PROGRAM STUDIES [--tables 1,2] [--only TEXT] [--starts N] [--threads T] [--json FILE]

PROGRAM: the equipoise program; STUDIES: the folder studies/paper. Without --starts every row is computed with as many
starts as the paper used. Every printed cell is judged: of table 2 all five columns. Exit code 3 if a cell differs at a
joint confidence of 99 % over its table.

The published share rests on as many random starts as ours (studies/paper/README of the data), so the two counts are
compared as two binomial samples: normal approximation with pooled variance where both expect ten or more of each kind,
else the exact conditional test. Half a unit of the last printed digit is granted first.
"""
import argparse
import csv
import decimal
import json
import math
import os
import re
import subprocess
import sys

# Rows whose printed numbers do not sum to 100: their cells are shown but not judged.
SLIPS = {"table-3-t0-25.toml": "the printed row sums to 100.07", "table-5-t0-700.toml": "the printed row sums to 100.46"}
STARTS = {1: 300000, 2: 300000, 3: 100000, 4: 100000, 5: 100000, 6: 300000, 7: 300000}


def number(text):
    """A file name's spelling of a number."""
    value = format(decimal.Decimal(text), "f")
    return value.rstrip("0").rstrip(".") if "." in value else value


def share_of_percentage(text):
    """A printed cell as (share, half of its last digit). Entries written as 3e-06 cannot be percentages, since one start
    of 300 000 is already 3.3e-4 %: they are fractions (docs/equations.md)."""
    value = decimal.Decimal(text)
    fraction = 0 < value < decimal.Decimal("1e-4")
    last_digit = decimal.Decimal(1).scaleb(value.as_tuple().exponent) if 0 < value < decimal.Decimal("0.01") \
        else decimal.Decimal("0.01")
    scale = 1 if fraction else 100
    return float(value) / scale, float(last_digit) / scale / 2


def rows(folder, table):
    """(study file, {attractor: printed cell}) of every row of a table; attractors are "balanced" and V1 to V4."""
    with open(os.path.join(folder, "published", f"table-{table}.csv"), encoding="utf-8") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for line in lines:
        if table == 1:
            for column in [c for c in line if c.startswith("balanced_beta_")]:
                beta = column.removeprefix("balanced_beta_")
                yield f"table-1-beta-{beta}-omega-{line['Omega']}.toml", {"balanced": line[column]}
        elif table == 2:
            yield f"table-2-omega-{line['Omega']}.toml", {k: v for k, v in line.items() if k != "Omega"}
        elif table == 4:
            yield f"table-4-omega-{line['Omega_f']}.toml", {"balanced": line["balanced"]}
        elif table in (3, 5):
            yield f"table-{table}-t0-{number(line['T0'])}.toml", {"balanced": line["balanced"]}
        elif table == 6:
            for release in (2, 3):
                name = f"table-6-release-{release}-t0-{number(line['T0'])}.toml"
                yield name, {"balanced": line[f"balanced_Omega_r_{release}"]}
        else:
            t0, t1, t2 = (number(line[k]) for k in ("T0", "T1", "T2"))
            yield f"table-7-t0-{t0}-t1-{t1}-t2-{t2}.toml", {"balanced": line["balanced"]}


def log_binomial(n, k):
    return math.lgamma(n + 1) - math.lgamma(k + 1) - math.lgamma(n - k + 1)


def rare_p_value(k1, n1, k2, n2):
    """Two-sided exact test that two rare counts have one rate, given their sum."""
    k, p = k1 + k2, n1 / (n1 + n2)
    if k == 0:
        return 1.0
    probability = [math.exp(log_binomial(k, j) + j * math.log(p) + (k - j) * math.log1p(-p)) for j in range(k + 1)]
    return min(1.0, sum(q for q in probability if q <= probability[k1] * (1 + 1e-9)))


def p_value(count, starts, published, rounding, published_starts):
    """Chance of a difference at least this large if both samples have one share."""
    share = count / starts
    target = min(max(share, published - rounding), published + rounding)  # the printed value nearest to ours
    published_count = target * published_starts
    pooled = (count + published_count) / (starts + published_starts)
    if min(pooled, 1 - pooled) * min(starts, published_starts) < 10:
        k1, k2 = count, round(published_count)
        if pooled > 0.5:
            k1, k2 = starts - k1, published_starts - k2
        return rare_p_value(k1, starts, k2, published_starts)
    deviation = math.sqrt(pooled * (1 - pooled) * (1 / starts + 1 / published_starts))
    return math.erfc(abs(share - target) / deviation / math.sqrt(2))


def compute(program, study, starts, threads):
    command = [program, "basin", study, "--json", "--quiet"]
    command += ["--starts", str(starts)] if starts else []
    command += ["--threads", str(threads)] if threads else []
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("studies")
    parser.add_argument("--tables", default="1,2,3,4,5,6")
    parser.add_argument("--only", default="", help="regular expression that a study's file name must match")
    parser.add_argument("--starts", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--json", default="")
    options = parser.parse_args()

    print(f"{'study':44} {'attractor':9} {'published':>9} {'computed':>9}  {'95 % interval':>17} {'undecided':>9} "
          f"{'starts':>7} {'p':>7} {'CPU s':>6}")
    results, times = [], []
    for table in (int(t) for t in options.tables.split(",")):
        for name, cells in rows(options.studies, table):
            if not re.search(options.only, name):
                continue
            answer = compute(options.program, os.path.join(options.studies, name), options.starts, options.threads)
            times.append((answer["cpu_seconds"], answer["seconds"]))
            by_name = {o["alias"] or o["name"]: o for o in answer["outcomes"]}
            for attractor, printed in cells.items():
                published, rounding = share_of_percentage(printed)
                found = by_name.get(attractor, {"count": 0, "share": 0.0, "low": 0.0, "high": 3.84 / answer["starts"]})
                p = p_value(found["count"], answer["starts"], published, rounding, STARTS[table])
                results.append({"table": table, "study": name, "attractor": attractor, "published": published,
                                "share": found["share"], "count": found["count"], "p": p, "starts": answer["starts"],
                                "undecided": answer["undecided"]["share"]})
                if found["count"] == 0 and published == 0:
                    continue  # nothing printed, nothing found: judged, but not worth a line
                print(f"{name:44} {attractor:9} {printed:>9} {100 * found['share']:9.4f}  "
                      f"{100 * found['low']:8.4f}-{100 * found['high']:8.4f} "
                      f"{100 * answer['undecided']['share']:9.4f} {answer['starts']:7} {p:7.4f} "
                      f"{answer['cpu_seconds']:6.1f}", flush=True)
    if not results:
        sys.exit("no row matches")
    apart = []
    for table in sorted({r["table"] for r in results}):
        cells = [r for r in results if r["table"] == table and r["study"] not in SLIPS]
        limit = 0.01 / len(cells)  # Bonferroni: 99 % jointly over the table
        differing = [r for r in cells if r["p"] < limit]
        apart += differing
        single = sum(r["p"] < 0.01 for r in cells)
        print(f"table {table}: {len(cells)} cells; {len(differing)} differ at a joint 99 %; {single} at 99 % each "
              f"({0.01 * len(cells):.1f} expected by chance)")
    print(f"CPU {sum(t[0] for t in times):.0f} s, wall {sum(t[1] for t in times):.0f} s")
    for name, why in SLIPS.items():
        if any(r["study"] == name for r in results):
            print(f"not judged: {name}: {why}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    for r in apart:
        print(f"DIFFERS: {r['study']} {r['attractor']}: p = {r['p']:.2g}")
    return 3 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
