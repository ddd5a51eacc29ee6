"""What the program answers, Python answers: to the byte, but for how long it took."""

from __future__ import annotations

import json
import pickle
import re

import numpy as np
import pytest

import equipoise as eq
from conftest import studies

PAPER = studies / "paper" / "table-2-omega-2.4.toml"
MACHINE = studies / "examples" / "washing-machine.toml"

# Spin-ups to one speed share their attractor search: an ensemble costs only its starts.
DESIGN = """
[design]
objective = ["balanced"]
method = "latin"
starts = 100
trajectories = 4000
[design.vary]
speed = { points = 1, until = 200.0, range = [0.0, 5.0], slope = 0.05 }
"release.time" = [0.0, 150.0]
"""


def timeless(text):
    """Without how long it took and on how many threads."""
    return re.sub(r'"(cpu_|check_)?(seconds|threads|starts_per_second)": ?[^,}\n]+', "", text)


def told(program, *arguments, code=0):
    run = program(*arguments, "--json")
    assert run.returncode == code, run.stderr
    return run.stdout


def test_every_command_has_a_call(program):
    commands = re.findall(r"^  ([a-z]+) {2,}", program("--help").stdout, re.MULTILINE)
    assert len(commands) == 18
    assert [name for name in commands if not callable(getattr(eq, name, None))] == []


@pytest.fixture(scope="module")
def designed(tmp_path_factory):
    path = tmp_path_factory.mktemp("design") / "study.toml"
    path.write_text(PAPER.read_text() + DESIGN)
    return path, eq.design(eq.Study.from_file(path))


def test_a_design(designed, program, tmp_path):
    path, found = designed
    files = {name: tmp_path / name for name in ("front.csv", "page.html", "best.toml")}
    said = told(program, "design", path, "--quiet", "--csv", files["front.csv"], "--report", files["page.html"], "--best",
                files["best.toml"])
    assert timeless(found._core.json()) == timeless(said)
    assert found.feasible and found.chosen["variables"].keys() == {"release.time", "speed"}
    assert found.before is not None
    assert found.margins.keys() == {"release.time", "speed.speeds[1]", "speed.times[1]", "speed.times[2]"}
    assert found.best == eq.Study.from_file(files["best.toml"]) and found.best != found.study
    found.save(tmp_path / "own.csv")
    assert (tmp_path / "own.csv").read_bytes() == files["front.csv"].read_bytes()
    assert len(found.to_pandas()) == len(found.front) and "balanced" in found.to_pandas()
    found.report(tmp_path / "own.html")
    assert (tmp_path / "own.html").stat().st_size > 10000
    assert "release.time" in repr(found) and "<table" in found._repr_html_()
    again = pickle.loads(pickle.dumps(found))
    assert again.text == found.text and again.best == found.best
    with pytest.raises(eq.RunError, match="pickle"):
        again.report(tmp_path / "again.html")


def test_what_no_design_can_be_is_refused(study):
    with pytest.raises(eq.StudyError, match="trajectories = 10"):
        eq.design(study, trajectories=10)
    with pytest.raises(eq.StudyError, match="design"):
        eq.design(study.replace({"design.objective": ["nothing"]}))


def test_a_design_within_a_time_is_partial(designed):
    # Half of a hundredth of a second is over before the first candidate is judged.
    found = eq.design(designed[1].study.replace({"design.trajectories": 200000}), within=0.01)
    assert found.partial and found.data["trajectories"] < 200000


@pytest.mark.slow
def test_a_machine_is_judged_as_by_the_program(program):
    answer = eq.basin(eq.Study.from_file(MACHINE), 60, changes=True)
    assert timeless(answer._core.json()) == timeless(told(program, "basin", MACHINE, "--starts", 60, "--quiet"))
    assert answer.verdict["decision"] == "change" and len(answer.verdict["tried"]) > 1
    untried = eq.basin(eq.Study.from_file(MACHINE), 200)
    assert timeless(untried._core.json()) == timeless(
        told(program, "basin", MACHINE, "--starts", 200, "--quiet", "--no-changes")
    )
    assert "tried" not in untried.verdict
    assert eq.basin(eq.Study.from_file(MACHINE), 200, transients=False).verdict is None


def test_a_page(program, tmp_path):
    page = eq.report(eq.Study.from_file(MACHINE), 200, changes=False)
    said = program("report", MACHINE, "--starts", 200, "--quiet", "--no-changes", "-o", tmp_path / "theirs.html")
    assert said.returncode == 0, said.stderr
    assert page.sentences.split() == said.stdout.split()  # the program fills lines of 80 columns
    page.save(tmp_path / "own.html")
    strip = re.compile(r"\d+(\.\d+)? (s|ms)\b|on \d+ threads?|\d+ starts/s")
    own, theirs = ((tmp_path / name).read_text() for name in ("own.html", "theirs.html"))
    assert strip.sub("", own) == strip.sub("", theirs)
    assert page.html == own and page.verdict["decision"] == "change" and "Change the design" in repr(page)
    assert pickle.loads(pickle.dumps(page)).html == own


def test_a_start_alone(answer, study):
    for index in (0, 7):
        alone = eq.replay(study, index)
        assert alone.outcome == answer.names[int(answer.labels[index])]
        assert alone.decision_time == answer.decision_time[index]
        assert alone.decided_by == answer.decided_by_names[int(answer.decided_by[index])]
        np.testing.assert_array_equal(alone.state.phi, answer.phi[index])
    assert alone.transients == {} and alone.mean_speed is None and alone.drawn == {}
    other = eq.basin(study, 20, seed=2)
    for alone in (eq.replay(study, 17, seed=2), eq.replay(other, 17)):
        assert alone.seed == 2
        np.testing.assert_array_equal(alone.state.phi, other.phi[17])
    assert eq.replay(study, 17).seed == 1
    with pytest.raises(eq.StudyError, match="was given its starts"):
        eq.replay(eq.basin(study, initial=[[1.0, 4.0]]), 0)
    assert eq.replay(study, 7, transients=True).transients["peak_radial"] > 0
    with pytest.raises(eq.StudyError, match="index"):
        eq.replay(study, -1)


def test_files_of_results(program, study, tmp_path):
    path = tmp_path / "kept.nc"
    kept = eq.basin(study, output=path)
    held = eq.inspect(path)
    assert held._core.json() == told(program, "inspect", path) and held.text == program("inspect", path).stdout
    assert held.sound and held.complete and held.kind == "basin"
    assert held.study["rotor.eccentricity"] == kept.study["rotor.eccentricity"] == 0.01
    assert held.facts["start"] == "400" and str(path) in repr(held)
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    (tmp_path / "damaged.nc").write_bytes(content)
    broken = eq.inspect(tmp_path / "damaged.nc")
    assert not broken.sound and "DAMAGED" in repr(broken)
    assert broken._core.json() == told(program, "inspect", tmp_path / "damaged.nc", code=3)
    with pytest.raises(eq.StudyError):
        eq.inspect(PAPER)


def test_a_sweep_in_parts(program, study, tmp_path):
    over = {"speed.final": [2.2, 2.4, 2.6]}
    whole = eq.sweep(study, over, starts=100)
    for part in (1, 2):
        eq.sweep(study, over, starts=100, shard=(part, 2), output=tmp_path / f"{part}.nc")
    merged = eq.merge([tmp_path / "1.nc", tmp_path / "2.nc"], tmp_path / "own.nc")
    said = told(program, "merge", tmp_path / "1.nc", tmp_path / "2.nc", "-o", tmp_path / "theirs.nc")
    assert timeless(merged._core.json()) == timeless(said)
    assert (tmp_path / "own.nc").read_bytes() == (tmp_path / "theirs.nc").read_bytes()
    np.testing.assert_array_equal(merged.shares["balanced"], whole.shares["balanced"])
    assert merged.study == whole.study and not merged.partial
    merged.report(tmp_path / "page.html")
    assert "<html" in (tmp_path / "page.html").read_text()
    with pytest.raises(eq.StudyError, match="output"):
        eq.sweep(study, over, shard=(1, 2))
    with pytest.raises(eq.StudyError, match="shard"):
        eq.sweep(study, over, shard=(3, 2), output=tmp_path / "3.nc")
    with pytest.raises(eq.StudyError, match="files"):
        eq.merge(tmp_path / "1.nc", tmp_path / "x.nc")
    with pytest.raises(eq.StudyError):
        eq.merge([PAPER], tmp_path / "x.nc")
    with pytest.raises(eq.StudyError, match=r"gone\.nc: no such file$"):
        eq.merge([tmp_path / "1.nc", tmp_path / "gone.nc"], tmp_path / "x.nc")


def test_certificates_are_checked(program, study, tmp_path):
    path = tmp_path / "proof.json"
    eq.certify(study).save(path)
    checked = eq.check_certificates(path)
    assert timeless(checked._core.json()) == timeless(told(program, "certify", "--check", path))
    assert checked.proved and "proved" in repr(checked)
    level = re.search(r'"level": ?"?([^",\n]+)', path.read_text())
    path.write_text(path.read_text().replace(level[0], level[0].replace(level[1], "1e6")))
    weak = eq.check_certificates(path)
    assert not weak.proved and "NOT" in repr(weak)
    assert timeless(weak._core.json()) == timeless(told(program, "certify", "--check", path, code=3))
    with pytest.raises(eq.StudyError):
        eq.check_certificates(PAPER)


def test_what_was_understood(program):
    machine = eq.Study.from_file(MACHINE)
    checked = eq.check(machine)
    assert checked.text == program("check", MACHINE, "--wide").stdout == str(checked)
    assert checked.machine in checked.text.replace("\n", " ") and checked.assumed == checked.data["assumed"]
    heavier = eq.check(machine.replace({"rotor.mass": "60 kg"}))
    assert heavier.machine.startswith("60 kg") and checked.machine.startswith("40 kg")
    assert {checked.unbalance, checked.balls, checked.matters_most}.isdisjoint({""})


def test_studies_to_begin_with(program, tmp_path):
    listed = program("new", "--help").stdout.split("one of:")[1].split("\n\n")[0]
    assert eq.machines() == re.findall(r"[a-z-]+", listed)
    for machine in eq.machines():
        begun = eq.new(machine, tmp_path / f"{machine}.toml")
        assert (tmp_path / f"{machine}.toml").read_text() == program("new", machine).stdout
        assert begun == eq.new(machine)
    with pytest.raises(eq.StudyError, match="no study is overwritten"):
        eq.new("fan", tmp_path / "fan.toml")
    with pytest.raises(eq.StudyError, match="did you mean"):
        eq.new("fna")


def test_files_are_compared_as_studies_are(program, study, tmp_path):
    other = study.replace({"balancer.drag": 0.1})
    both = eq.compare(study, other)
    eq.basin(study, output=tmp_path / "first.nc")
    eq.basin(other, output=tmp_path / "second.nc")
    stored = eq.compare(tmp_path / "first.nc", str(tmp_path / "second.nc"))
    mixed = eq.compare(tmp_path / "first.nc", other)
    assert [d.difference for d in stored.differences] == [d.difference for d in both.differences]
    assert [d.difference for d in mixed.differences] == [d.difference for d in both.differences]
    assert stored.study["balancer.drag"] == study["balancer.drag"]
    assert timeless(stored._core.json()) == timeless(
        told(program, "compare", tmp_path / "first.nc", tmp_path / "second.nc", "--quiet")
    )
    with pytest.raises(eq.StudyError, match="starts"):
        eq.compare(tmp_path / "first.nc", tmp_path / "second.nc", 100)


def test_the_cost_of_an_answer(study):
    assert eq.explain(study).cost is None
    cost = eq.explain(study, cost=True, within="5s")
    assert cost.cost and cost.cost == json.loads(json.dumps(cost.data))["cost"]


def test_pages_of_results(study, tmp_path):
    plane = eq.map(study, size=(16, 16))
    much = eq.capacity(study, between=(0.005, 0.02), starts=50, precision=0.1)
    for result in (plane, much):
        result.report(tmp_path / "page.html")
        assert "<html" in (tmp_path / "page.html").read_text()
