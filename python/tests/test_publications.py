"""studies/publications: its tables, its verdicts, its page, and its numbers next to those of other programs."""

from __future__ import annotations

import csv
import functools
import io
import math
import sys

import pytest

from conftest import root, studies

folder = studies / "publications"
sys.path.insert(0, str(folder))
import judge  # noqa: E402
import measures  # noqa: E402

SOURCES = {source["publication"]: source for source in judge.table("sources")}
ROWS = [row for source in SOURCES.values() for row in judge.numbers(source)]
CHEAP = {"settled_without_balls", "least_mass", "critical_speed", "rate_near_balance", "vibration_without_balls", "boundary"}


@functools.cache
def result(k):
    return judge.judged(ROWS[k])


def in_rows(text):
    """The page's table without the column of our numbers, whose last digits belong to a processor."""
    return [row[:6] + row[7:] for row in csv.reader(io.StringIO(text))]


@functools.cache
def page_rows():
    return in_rows((root / "docs" / "evidence" / "publications.csv").read_text(encoding="utf-8"))


def is_cheap(row):
    return not row["measure"] or row["measure"].split()[0] in CHEAP


def rows(wanted):
    return [
        pytest.param(k, id=f"{k}-{row['publication']}", marks=() if is_cheap(row) else pytest.mark.slow)
        for k, row in enumerate(ROWS)
        if wanted(row)
    ]


def test_tables_are_whole():
    assert len(ROWS) == len(judge.table("numbers"))
    assert {symbol["publication"] for symbol in judge.table("symbols")} == set(SOURCES)
    for row in ROWS:
        name = row["measure"].split()[0] if row["measure"] else None
        assert hasattr(measures, name) if name else row["reason"], row
        assert (row["error"] > 0.0) == (row["known_by"] != "formula"), row
        assert bool(row["other"]) == bool(row["other_error"]), row
        judge.unit_of(judge.study_of(row), row["unit"])


@pytest.mark.parametrize(
    "published, error, computed, computed_error, reason, verdict",
    [
        (1.0, 0.1, 1.25, 0.16, "", "agrees"),
        (1.0, 0.1, 1.25, 0.14, "", "differs"),
        (1.0, 0.1, 0.75, 0.14, "", "differs"),
        (1.0, 0.1, 0.75, 0.14, "known", "differs as known"),
        (1.0, 0.1, 1.05, 0.0, "known", "agrees"),
        (1.0, 0.1, None, None, "known", "not computed"),
    ],
)
def test_verdicts_follow_from_both_errors(published, error, computed, computed_error, reason, verdict):
    row = dict(published=published, error=error, computed=computed, computed_error=computed_error, reason=reason)
    assert judge.verdict(row) == verdict


def test_the_tally_counts_verdicts():
    def of(*verdicts):
        return judge.tally([{"verdict": verdict} for verdict in verdicts])

    assert of("agrees", "not computed") == "1 of 1 numbers agree, 0 differ; 1 not computed."
    assert of("differs as known") == "0 of 1 numbers agree, 1 differ, each for a reason that is known; 0 not computed."
    some = "0 of 2 numbers agree, 2 differ, 1 of them for a reason that is known; 0 not computed."
    assert of("differs", "differs as known") == some


def jeffcott(p, speed):
    return p["eccentricity"] * speed**2 / math.hypot(p["stiffness"][0] - speed**2, p["damping"][0] * speed)


def formula(row):
    """What the formula of a row gives, and what it must be: zero where torques balance."""
    study = judge.study_of(row)
    p = study.parameters
    if row["publication"] == "jeffcott-1919":
        return row["published"], jeffcott(p, study["speed.speed"])
    if row["publication"] == "sommerfeld-1902":
        motor, speed = study["speed.torque"], row["published"]
        vibration = p["damping"][0] * speed * jeffcott(p, speed) ** 2
        return motor["stall"] * (1.0 - speed / motor["no_load_speed"]), vibration
    if row["place"] == "(22)":
        return row["published"], p["eccentricity"] / 2.0
    tilt = p["tilt"]
    return row["published"], math.sqrt(tilt["stiffness"][1] / (tilt["transverse_inertia"] - tilt["polar_inertia"]))


@pytest.mark.parametrize("k", rows(lambda row: row["known_by"] == "formula"))
def test_formulas_give_what_the_table_has(k):
    has, is_so = formula(ROWS[k])
    assert has == pytest.approx(is_so, rel=1e-12)  # a dozen roundings, magnified near the resonance


@pytest.mark.parametrize("k", rows(lambda row: row["other"]))
def test_numbers_are_those_of_other_programs(k):
    assert result(k)["computed"] == pytest.approx(float(ROWS[k]["other"]), abs=float(ROWS[k]["other_error"]))


@pytest.mark.parametrize("k", rows(is_cheap))
def test_the_page_has_what_is_found(k):
    row = [ROWS[k]["publication"], *judge.shown(result(k))]
    assert row[:6] + row[7:] in page_rows()


@pytest.mark.slow
def test_the_page_is_made_by_the_script():
    results = [(s, [result(k) for k, row in enumerate(ROWS) if row["publication"] == name]) for name, s in SOURCES.items()]
    page = (root / "docs" / "evidence" / "publications.md").read_text(encoding="utf-8")
    assert "\n".join(judge.markdown(results)) + "\n" == page
    assert in_rows(judge.rows_of(results)) == page_rows()


def test_the_script_prints_tables_and_refuses_other_names(capsys):
    assert judge.main(["jeffcott-1919", "--csv"]) == 0
    read = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [row["verdict"] for row in read] == ["agrees"] * 6
    assert judge.main(["jeffcott-1919"]) == 0
    assert capsys.readouterr().out.endswith("6 of 6 numbers agree, 0 differ; 0 not computed.\n")
    with pytest.raises(SystemExit):
        judge.main(["nobody-1900"])
    assert "unknown publication nobody-1900; must be among jeffcott-1919" in capsys.readouterr().err
