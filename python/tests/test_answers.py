"""Attractors, branches, proofs, maps, sweeps, capacities, explanations: what they hold, and that the program says the same."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pytest

import equipoise as eq
from conftest import described_alike, studies

PAPER = studies / "paper" / "table-2-omega-2.4.toml"


def without_times(data):
    """What two runs must agree in: no seconds, no threads, no names of files."""
    if isinstance(data, dict):
        away = ("seconds", "cpu_seconds", "check_seconds", "threads", "study_name")
        return {key: without_times(value) for key, value in data.items() if key not in away}
    return [without_times(entry) for entry in data] if isinstance(data, list) else data


def told(program, *arguments):
    run = program(*arguments, "--json")
    assert run.returncode in (0, 3), run.stderr
    return json.loads(run.stdout)


@pytest.fixture(scope="module")
def found(study):
    return eq.attractors(study, 500)


def test_attractors(found, program):
    assert without_times(found.data)["attractors"] == without_times(
        told(program, "attractors", PAPER, "--starts", 500, "--quiet")
    )["attractors"]
    balanced, v2 = found["balanced"], found["V2"]
    assert balanced.kind == "equilibrium" and balanced.r_max < 1e-12 and balanced.spectrum.real.max() < 0
    assert (balanced.spectrum_kind, found["V1"].spectrum_kind, v2.spectrum_kind) == ("eigenvalues", "multipliers", "")
    assert [a.id for a in found] == [a.id for a in found.attractors] and len(found) == len(found.to_pandas())
    with pytest.raises(KeyError):
        found["V9"]
    path = v2.path(points=300)
    assert path.X.shape == path.t.shape == path.radial.shape == (301,) and path.phi.shape == (301, 2)
    assert v2.r_min - 1e-6 < path.radial.min() and path.radial.max() < v2.r_max + 1e-6  # the path's tolerance
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again["V2"].path(points=300).X, path.X)
    assert "V2" in found._repr_html_() and "balanced" in repr(found)


def test_an_equilibrium_on_unequal_supports_has_multipliers(study):
    balanced = eq.attractors(study.replace({"rotor.stiffness": [1.0, 1.05]}), 50)["balanced"]
    assert balanced.kind == "equilibrium" and balanced.spectrum_kind == "multipliers"
    assert 0.5 < abs(balanced.spectrum).max() < 1.0


def test_states_of_the_wrong_shape_are_refused(study):
    with pytest.raises(eq.StudyError, match=r"\(n, 8\)"):
        eq.attractors(study, 100, states=[[1.0, 2.0]])


def test_branches(program, tmp_path):
    study = eq.Study.from_file(PAPER)
    branches = eq.follow(study, "speed.final", 2.9, 2.95, 0.05, starts=300)
    same = told(program, "attractors", PAPER, "--along", "speed.final=2.9:2.95:0.05", "--starts", 300, "--quiet")
    assert without_times(branches.data)["branches"] == without_times(same)["branches"]
    balanced = branches["balanced"]
    np.testing.assert_allclose(balanced.value, [2.9, 2.95])
    assert balanced.stable.all() and balanced.growth_rate.max() < 0
    assert branches.parameter == "speed.final" and len(branches.to_pandas()) == sum(len(b.value) for b in branches)
    assert pickle.loads(pickle.dumps(branches))["balanced"].stable.all()
    with pytest.raises(eq.StudyError, match=r"\(n, 8\)"):
        eq.follow(study, "speed.final", 2.9, 2.95, 0.05, states=[[1.0, 2.0]])
    branches.save(tmp_path / "branches.nc")
    assert (tmp_path / "branches.nc").stat().st_size > 1000


def test_certificates(study, program, tmp_path):
    proof = eq.certify(study)
    assert proof.proved and proof.states[0]["level"] > 0 and "proved" in repr(proof)
    proof.save(tmp_path / "proof.json")
    checked = program("certify", "--check", tmp_path / "proof.json")
    assert checked.returncode == 0, checked.stdout
    none = eq.certify(study.replace({"speed.final": 0.5}))  # below the critical speed balance is unstable
    assert not none.proved
    with pytest.raises(eq.RunError, match="nothing is proved"):
        none.save(tmp_path / "none.json")
    with pytest.raises(eq.StudyError):
        eq.certify(study.replace({"rotor.gravity": 0.002}))


@pytest.mark.slow
def test_maps(program, tmp_path):
    xarray = pytest.importorskip("xarray")
    study = eq.Study.from_file(PAPER)
    file = tmp_path / "map.nc"
    run = program("map", PAPER, "--size", "40x30", "-o", file, "--quiet")
    assert run.returncode == 0, run.stderr
    made = eq.map(study, size=(40, 30))
    with xarray.open_dataset(file) as stored:
        np.testing.assert_array_equal(made.outcome, stored.outcome.values)
        np.testing.assert_array_equal(made.x, stored[stored.outcome.dims[1]].values)
    assert made.outcome.shape == (30, 40) and made.x_key == "initial.phi_1" and made.x_edges == (0.0, 2 * np.pi)
    for code, name in made.names.items():
        assert np.mean(made.outcome == code) == pytest.approx(made.shares[name], abs=1e-12)
    assert made.left_out == 0 and all(len(e) == 3 for e in made.figures["local_exponents"])
    assert set(made.figures) >= {"box_dimension", "uncertainty_exponent", "basin_entropy"}
    assert made.figures["tolerance_flips"] is None  # too few pixels
    assert made.to_xarray().outcome.shape == (30, 40) and made.to_pandas().shape == (30, 40)
    again = pickle.loads(pickle.dumps(made))
    np.testing.assert_array_equal(again.time, made.time)
    assert "balanced" in repr(made) and "<table>" in made._repr_html_()
    made.save(tmp_path / "again.nc")
    with xarray.open_dataset(tmp_path / "again.nc", mask_and_scale=False) as stored:
        np.testing.assert_array_equal(made.outcome, stored.outcome.values)
        described_alike(made.to_xarray(), stored)
    diagonal = eq.map(study, "initial.phi_1", "speed.final", 3, y_range=(2.0, 3.0), tie="phi_2=phi_1+pi")
    assert diagonal.outcome.shape == (3, 3)
    for wrong in (dict(x="initial.phi_9"), dict(size=(0, 5)), dict(x_range=(1.0, 1.0))):
        with pytest.raises(eq.StudyError):
            eq.map(study, **{"size": 4, **wrong})


def test_stability(program, tmp_path):
    xarray = pytest.importorskip("xarray")
    study = eq.Study.from_file(PAPER)
    file = tmp_path / "stability.nc"
    ranges = ("--x-range", "0.5:6", "--y-range", "0.01:0.3", "--size", "40x30")
    run = program("stability", PAPER, *ranges, "-o", file, "--quiet")
    assert run.returncode == 0, run.stderr
    made = eq.stability(study, size=(40, 30), x_range=(0.5, 6.0), y_range=(0.01, 0.3))
    with xarray.open_dataset(file) as stored:
        for name in ("kind", "unstable", "growth", "frequency", "margin"):
            np.testing.assert_array_equal(getattr(made, name), stored[name].values)
    assert made.kind.shape == (30, 40) and made.x_key == "speed.final" and made.y_edges == (0.01, 0.3)
    assert ((made.growth < 0) == (made.kind == 1)).all() and sum(made.shares.values()) == pytest.approx(1.0)
    assert made.own == (2.4, 0.05)
    assert made.text.replace("\n", " ").split()[1:4] == made.answer.split()[:3]
    assert without_times(made.data) == without_times(told(program, "stability", PAPER, *ranges))
    assert made.to_xarray().growth.shape == (30, 40) and set(np.unique(made.to_pandas())) == set(made.shares)
    again = pickle.loads(pickle.dumps(made))
    np.testing.assert_array_equal(again.growth, made.growth)
    assert "balance is stable in" in made._repr_html_() and "stable" in repr(made)
    made.save(tmp_path / "again.nc")
    for wrong in (dict(x="initial.phi_1"), dict(y_range=(-1.0, 1.0)), dict(size=(0, 5)), dict(x_range=(1.0, 1.0))):
        with pytest.raises(eq.StudyError):
            eq.stability(study, **{"size": 4, "x_range": (1.0, 2.0), "y_range": (0.1, 0.2), **wrong})


def test_chart(program, tmp_path):
    xarray = pytest.importorskip("xarray")
    study = eq.Study.from_file(PAPER)
    file = tmp_path / "chart.nc"
    axes = ("--x", "speed.final=0.5:6", "--y", "balancer.drag=0.01:0.3", "--size", "24x24", "--undecided", "2")
    same = told(program, "chart", PAPER, *axes, "-o", file, "--quiet")
    ranges = dict(x_range=(0.5, 6.0), y_range=(0.01, 0.3))
    made = eq.chart(study, size=24, undecided=2.0, **ranges)
    with xarray.open_dataset(file) as stored:
        np.testing.assert_array_equal(np.concatenate([c.x for c in made.curves]), stored.point_x.values)
        np.testing.assert_array_equal(np.concatenate([c.lyapunov for c in made.curves]), stored.lyapunov.values)
        np.testing.assert_array_equal(made.box_kind, stored.box_kind.values)
    assert without_times(made.data) == without_times(same)
    assert sum(made.proved.values()) == pytest.approx(1.0) and made.proved["open"] <= 0.02
    curves = eq.chart(study, size=24, boxes=0, **ranges).curves
    assert [c.kind for c in curves] == [c.kind for c in made.curves]
    assert [c.kind for c in curves if c.of == "balance"] == ["hopf"] * sum(c.of == "balance" for c in curves)
    assert any(c.of != "balance" for c in curves) and made.region_of.shape == (24, 24)
    assert sum(r["part"] for r in made.regions) == pytest.approx(1.0) and "balance stable" in made.regions[0]["states"]
    point = curves[0]
    k = len(point.x) // 2
    for side, kind in ((1.0 - 1e-6, 2), (1.0 + 1e-6, 1)):  # below the curve of that drag unstable, above it stable
        if point.others[k] == 0:
            there = eq.stability(study, size=1, x_range=(point.x[k] - 1e-9, point.x[k] + 1e-9),
                                 y_range=(side * point.y[k] - 1e-9, side * point.y[k] + 1e-9))
            assert there.kind[0, 0] == kind
    again = pickle.loads(pickle.dumps(made))
    assert again.answer == made.answer and "balance is stable" in again._repr_html_() and "curves" in repr(made)
    made.save(tmp_path / "again.nc")
    for wrong, where in (
        (dict(x="initial.phi_1"), "x: initial.phi_1"),
        (dict(y_range=(-1.0, 1.0)), "y: balancer.drag"),
        (dict(y="speed.final"), "x: speed.final"),
        (dict(size=(0, 5)), ""),
        (dict(x_range=(1.0, 1.0)), "x_range"),
    ):
        settings = {"size": 4, "x_range": (1.0, 2.0), "y_range": (0.1, 0.2), **wrong}
        for refused in (eq.stability, eq.chart):
            with pytest.raises(eq.StudyError, match="^" + where):
                refused(study, **settings)


def test_planes_of_three_balls_tell_of_the_continuum():
    study = eq.Study.from_file(PAPER).replace({"balancer.balls": 3, "balancer.mass": [0.04, 0.05, 0.06]})
    made = eq.stability(study, size=3, x_range=(1.0, 2.0), y_range=(0.1, 0.2))
    assert made.continuum["drawn"] == 1024 and 0 <= made.continuum["stable"] <= 1024
    assert "with the balls spread evenly" in made.answer and "1024 balanced states" in made.answer
    assert eq.stability(eq.Study.from_file(PAPER), size=3, x_range=(1.0, 2.0), y_range=(0.1, 0.2)).continuum is None


def test_sweeps(program, tmp_path):
    study = eq.Study.from_file(PAPER)
    over = {"speed.final": [2.0, 2.4], "balancer.drag": "0.05,0.1"}
    swept = eq.sweep(study, over, starts=100)
    same = told(program, "sweep", PAPER, "--over", "speed.final=2.0,2.4", "--over", "balancer.drag=0.05,0.1",
                "--starts", 100, "--quiet")
    assert without_times(swept.data)["cells"] == without_times(same)["cells"]
    balanced = swept.shares["balanced"]
    assert balanced.shape == swept.shape == (2, 2) and list(swept.axes) == ["speed.final", "balancer.drag"]
    alone = eq.basin(study.replace({"speed.final": 2.4, "balancer.drag": 0.1}), starts=100)
    assert balanced[1, 1] == alone.shares["balanced"]
    assert np.all(swept.low["balanced"] <= balanced) and np.all(balanced <= swept.high["balanced"])
    assert swept.undecided.shape == (2, 2)
    tidy = swept.to_pandas()
    assert {"speed.final", "balancer.drag", "name", "share", "low", "high"} <= set(tidy.columns)
    cube = swept.to_xarray()
    assert float(cube.share.sel(outcome="balanced", **{"speed.final": 2.4, "balancer.drag": 0.1})) == balanced[1, 1]
    swept.save(tmp_path / "sweep.nc")
    assert program("inspect", tmp_path / "sweep.nc").returncode == 0
    assert pickle.loads(pickle.dumps(swept)).shares["balanced"][0, 0] == balanced[0, 0]
    zipped = eq.sweep(study, {"speed.final": [2.0, 2.4], "balancer.drag": [0.05, 0.1]}, zip=True, starts=100)
    assert zipped.shares["balanced"].tolist() == [balanced[0, 0], balanced[1, 1]]
    with pytest.raises(eq.StudyError, match="speed.fnal"):
        eq.sweep(study, {"speed.fnal": [1.0, 2.0]})


def test_capacities(study, program, tmp_path):
    question = dict(between=(0.02, 0.2), at_least=0.1, precision=0.1, starts=100)
    found = eq.capacity(study, **question, output=tmp_path / "capacity.nc")
    assert program("inspect", tmp_path / "capacity.nc").returncode == 0
    assert without_times(eq.capacity(study, **question, output=tmp_path / "capacity.nc").data)["cells"] == found.cells
    same = told(program, "capacity", PAPER, "--between", "0.02:0.2", "--at-least", 0.1, "--precision", 0.1, "--starts", 100,
                "--quiet")
    assert without_times(found.data)["cells"] == without_times(same)["cells"]
    assert found.low[0] <= found.high[0] and found.of == "rotor.eccentricity"
    assert len(found.to_pandas()) == 1 and "rotor.eccentricity" in repr(found)
    with pytest.raises(eq.StudyError, match="LOW:HIGH"):
        eq.capacity(study, between=(0.2, 0.02))


def test_explanations(program):
    machine = eq.Study.from_file(studies / "examples" / "washing-machine.toml")
    said = eq.explain(machine)
    assert without_times(said.data) == without_times(told(program, "explain", studies / "examples" / "washing-machine.toml"))
    assert said.text == program("explain", studies / "examples" / "washing-machine.toml", "--wide").stdout
    assert list(said.advice) == ["ball_mass", "critical_speed", "room", "drag", "settling", "torque"]
    assert said.advice["ball_mass"]["kept"] is True and said.advice["drag"]["source"].startswith("Rules of thumb")
    assert isinstance(said.warnings, list) and "<pre>" in said._repr_html_()


def test_the_paper_again(tmp_path):
    made = eq.reproduce("table-7", starts=20, law="published")
    assert [t["table"] for t in made.tables] == [7] and "table 7" in repr(made)
    assert pickle.loads(pickle.dumps(made)).tables == made.tables
    made.report(tmp_path / "paper.html", explorer="web/index.html")
    page = (tmp_path / "paper.html").read_text(encoding="utf-8")
    assert "Made by: equipoise.reproduce('table-7', starts=20, law='published')" in page
    assert page.count('href="web/index.html#study=table-7-') == 4 and "<script" not in page
    with pytest.raises(eq.RunError, match="pickle"):
        pickle.loads(pickle.dumps(made)).report(tmp_path / "again.html")
    with pytest.raises(ValueError, match="table-1"):
        eq.reproduce()
    with pytest.raises(eq.StudyError, match="table-9"):
        eq.reproduce("table-9")
