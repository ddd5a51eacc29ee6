#!/usr/bin/env python3
"""Computes the balanced share of published table rows and judges each by the errors of both samples.

    compare_with_published.py PROGRAM STUDIES [--tables 1,2] [--only TEXT] [--starts N] [--threads T] [--json FILE]

PROGRAM: the equipoise program; STUDIES: the folder studies/paper. Without --starts every row is computed with as many
starts as the paper used. Exit code 3 if a row disagrees at a joint confidence of 99 % over all rows compared.

The published share rests on as many random starts as ours (studies/paper/README of the data), so the two counts are
compared as two binomial samples: normal approximation with pooled variance where both expect ten or more of each kind,
else the exact conditional test. Published digits end at 0.01 %, so half a unit of the last digit is granted first.
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

ROUNDING = 0.00005  # half of the last printed digit, 0.01 %
STARTS = {1: 300000, 2: 300000, 3: 100000, 4: 100000, 5: 100000, 6: 300000, 7: 300000}


def number(text):
    """A file name's spelling of a number."""
    value = format(decimal.Decimal(text), "f")
    return value.rstrip("0").rstrip(".") if "." in value else value


def rows(folder, table):
    """(study file, published share) of every row of a table."""
    with open(os.path.join(folder, "published", f"table-{table}.csv"), encoding="utf-8") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for line in lines:
        if table == 1:
            for column in [c for c in line if c.startswith("balanced_beta_")]:
                beta = column.removeprefix("balanced_beta_")
                yield f"table-1-beta-{beta}-omega-{line['Omega']}.toml", float(line[column]) / 100
        elif table == 2:
            yield f"table-2-omega-{line['Omega']}.toml", float(line["balanced"]) / 100
        elif table == 4:
            yield f"table-4-omega-{line['Omega_f']}.toml", float(line["balanced"]) / 100
        elif table in (3, 5):
            yield f"table-{table}-t0-{number(line['T0'])}.toml", float(line["balanced"]) / 100
        elif table == 6:
            for release in (2, 3):
                name = f"table-6-release-{release}-t0-{number(line['T0'])}.toml"
                yield name, float(line[f"balanced_Omega_r_{release}"]) / 100
        else:
            t0, t1, t2 = (number(line[k]) for k in ("T0", "T1", "T2"))
            yield f"table-7-t0-{t0}-t1-{t1}-t2-{t2}.toml", float(line["balanced"]) / 100


def log_binomial(n, k):
    return math.lgamma(n + 1) - math.lgamma(k + 1) - math.lgamma(n - k + 1)


def rare_p_value(k1, n1, k2, n2):
    """Two-sided exact test that two rare counts have one rate, given their sum."""
    k, p = k1 + k2, n1 / (n1 + n2)
    if k == 0:
        return 1.0
    probability = [math.exp(log_binomial(k, j) + j * math.log(p) + (k - j) * math.log1p(-p)) for j in range(k + 1)]
    return min(1.0, sum(q for q in probability if q <= probability[k1] * (1 + 1e-9)))


def p_value(count, starts, published, published_starts):
    """Chance of a difference at least this large if both samples have one share."""
    share = count / starts
    target = min(max(share, published - ROUNDING), published + ROUNDING)  # the printed value nearest to ours
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

    print(f"{'study':44} {'published':>9} {'computed':>9}  {'95 % interval':>17} {'undecided':>9} {'starts':>7} "
          f"{'p':>7} {'CPU s':>6}")
    results = []
    for table in (int(t) for t in options.tables.split(",")):
        for name, published in rows(options.studies, table):
            if not re.search(options.only, name):
                continue
            answer = compute(options.program, os.path.join(options.studies, name), options.starts, options.threads)
            balanced = answer["outcomes"][0]
            p = p_value(balanced["count"], answer["starts"], published, STARTS[table])
            results.append({"study": name, "published": published, "share": balanced["share"], "p": p, **{
                k: answer[k] for k in ("starts", "cpu_seconds", "seconds")}, "undecided": answer["undecided"]["share"]})
            print(f"{name:44} {100 * published:9.2f} {100 * balanced['share']:9.3f}  "
                  f"{100 * balanced['low']:8.3f}-{100 * balanced['high']:8.3f} {100 * answer['undecided']['share']:9.4f} "
                  f"{answer['starts']:7} {p:7.3f} {answer['cpu_seconds']:6.1f}", flush=True)
    if not results:
        sys.exit("no row matches")
    limit = 0.01 / len(results)  # Bonferroni: 99 % jointly
    apart = [r["study"] for r in results if r["p"] < limit]
    single = sum(r["p"] < 0.01 for r in results)
    print(f"{len(results)} rows; {single} outside their own joint 99 % interval ({0.01 * len(results):.1f} expected by chance); "
          f"{len(apart)} outside at 99 % over all rows; CPU {sum(r['cpu_seconds'] for r in results):.0f} s, "
          f"wall {sum(r['seconds'] for r in results):.0f} s")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    for study in apart:
        print(f"DISAGREES: {study}")
    return 3 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
