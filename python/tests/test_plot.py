"""Pictures show what the results say: their artists are compared with the results' own numbers."""

from __future__ import annotations

import json
import subprocess
import sys
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import animation  # noqa: E402
from matplotlib.colors import same_color, to_rgb  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402

import equipoise as eq  # noqa: E402
from equipoise import _core  # noqa: E402
from equipoise.branches import Event  # noqa: E402

ROUNDING = 1e-9  # of sums of a few doubles; what is drawn is what was given


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def study():
    """The paper's rotor at 2.4 times the critical speed: balanced, V1 and V2."""
    return eq.paper_study("table-2-omega-2.4")


@pytest.fixture(scope="module")
def machine():
    """A machine in physical units that limits its displacement."""
    return eq.Study(
        rotor={"mass": "12 kg", "stiffness": "48 kN/m", "damping_ratio": 0.25, "unbalance": "300 g mm"},
        balancer={"balls": 2, "race_radius": "30 mm", "mass": "500 g", "drag": "0.002 N m s"},
        speed={"profile": "ramp", "final": "1500 rpm", "duration": "1 s"},
        release={"time": "0 s"},
        limits={"displacement": "1 mm", "settled": "0.1 mm"},
    )


@pytest.fixture(scope="module")
def ensemble(study):
    return eq.basin(study, starts=600, transients=True)


@pytest.fixture(scope="module")
def attractors(study):
    return eq.attractors(study, starts=600)


@pytest.fixture(scope="module")
def spin_up():
    """Past the critical speed in a ramp, then on; the balls are let go at its end."""
    ramp = eq.Study(
        rotor={"eccentricity": 0.01, "damping": 0.5},
        balancer={"balls": 2, "mass": 0.05, "drag": 0.05},
        speed={"profile": "ramp", "final": 2.4, "duration": 60.0},
        initial={"phi": [1.0, 4.0]},
    )
    return eq.simulate(ramp, np.linspace(0.0, 160.0, 1601))


def legend_texts(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def an_ensemble(**changed):
    """What pictures read of an ensemble, with outcomes that a real one seldom has."""
    share = {"balanced": 0.5, "co-drifting": 0.25, "undecided": 0.125, "diverged": 0.125}
    fields = {
        "names": {0: "undecided", 1: "balanced", 2: "co-drifting", -1: "diverged", -2: "failed", -3: "stalled"},
        "shares": share,
        "errors": {name: (value - 0.05, value + 0.05) for name, value in share.items()},
        "counts": {name: int(8 * value) for name, value in share.items()},
        "attractors": [
            SimpleNamespace(id=1, name="balanced", alias="", share=0.5, low=0.45, high=0.55),
            SimpleNamespace(id=2, name="co-drifting", alias="V1", share=0.25, low=0.2, high=0.3),
        ],
        "labels": np.array([1, 1, 1, 1, 2, 2, 0, -1], dtype=np.int16),
        "transients": {"settling_time": np.array([1.0, 2.0, 3.0, 4.0, np.inf, np.inf, 9.0, np.nan])},
        "arrays": {},
        "partial": False,
        "study": eq.paper_study("table-2-omega-2.4").replace(limits={"settled": 0.001}),
    }
    return SimpleNamespace(**{**fields, **changed})


# --- shares -----------------------------------------------------------------------------------------------------------


def test_shares_are_bars_of_their_length_and_colour(ensemble):
    ax = eq.plot.shares(ensemble)
    listed = [a for a in ensemble.attractors]
    assert len(ax.patches) == len(ensemble.shares)
    for bar, attractor in zip(ax.patches, listed):
        assert bar.get_width() == pytest.approx(100.0 * attractor.share, rel=ROUNDING)
        assert same_color(bar.get_facecolor(), _core.colour_of(attractor.id))
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert names[0] == "balanced" and "V1: co-drifting" in names


def test_whiskers_of_shares_are_the_intervals(ensemble):
    ax = eq.plot.shares(ensemble)
    segments = [c.get_segments()[0] for c in ax.collections if c.get_segments()]
    for row, attractor in enumerate(ensemble.attractors):
        low, high = ensemble.errors[attractor.name]
        mine = [s for s in segments if s[0][1] == row]
        assert mine, attractor.name
        for segment in mine:
            assert segment[:, 0] == pytest.approx([100.0 * low, 100.0 * high], abs=1e-9)


def test_undecided_comes_last_among_shares():
    ax = eq.plot.shares(an_ensemble())
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert names == ["balanced", "V1: co-drifting", "diverged", "undecided"]
    assert same_color(ax.patches[-1].get_facecolor(), _core.colour_of(0))
    low, high = ax.get_ylim()
    assert low > high  # the first is on top


def test_a_partial_ensemble_says_so():
    assert "PARTIAL" in eq.plot.shares(an_ensemble(partial=True)).get_xlabel()
    assert "PARTIAL" not in eq.plot.shares(an_ensemble()).get_xlabel()


# --- transients -------------------------------------------------------------------------------------------------------


def test_transients_add_up_to_all_starts(ensemble):
    ax = eq.plot.transients(ensemble, "peak_radial", bins=17)
    finite = np.isfinite(ensemble.transients["peak_radial"])
    assert sum(bar.get_height() for bar in ax.patches) == pytest.approx(100.0 * finite.mean(), rel=ROUNDING)
    for container in ax.containers:
        shown = container[0].get_facecolor()
        code = next(int(c) for c in np.unique(ensemble.labels) if same_color(shown, _core.colour_of(int(c))))
        mine = 100.0 * np.count_nonzero(finite & (ensemble.labels == code)) / finite.size
        assert sum(bar.get_height() for bar in container) == pytest.approx(mine, rel=ROUNDING)
        assert len(container) == 17


def test_bars_of_transients_do_not_overlap(ensemble):
    ax = eq.plot.transients(ensemble, bins=9)
    for column in range(9):
        stack = sorted((c[column] for c in ax.containers), key=lambda bar: bar.get_y())
        for lower, upper in zip(stack, stack[1:]):
            assert upper.get_y() == pytest.approx(lower.get_y() + lower.get_height(), abs=1e-9)


def test_times_that_go_on_are_told():
    ax = eq.plot.transients(an_ensemble(), "settling_time", bins=4)
    assert any(text.startswith("37.5 % without") for text in legend_texts(ax))
    assert sum(bar.get_height() for bar in ax.patches) == pytest.approx(62.5)


def test_cells_of_a_grid_count_for_what_they_stand_for():
    weight = np.array([5.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    ax = eq.plot.transients(an_ensemble(arrays={"weight": weight}), "settling_time", bins=8)
    assert ax.patches[0].get_height() == pytest.approx(100.0 * 5.0 / 12.0)
    assert any(text.startswith("25 % without") for text in legend_texts(ax))


def test_transients_of_a_machine_are_in_its_units_beside_its_limit(machine):
    result = eq.basin(machine, starts=100)
    ax = eq.plot.transients(result, bins=10)
    assert ax.get_xlabel() == "peak displacement (mm)"
    peaks = 30.0 * np.asarray(result.transients["peak_radial"], dtype=float)  # race radius: 30 mm
    assert ax.patches[0].get_x() == pytest.approx(peaks.min(), rel=1e-6)
    (limit,) = ax.get_lines()
    assert limit.get_xdata() == pytest.approx([1.0, 1.0], rel=1e-6)
    beyond = 100.0 * np.mean(peaks > 1.0)
    assert f"limit 1 mm: {beyond:.3g} % beyond" in legend_texts(ax)
    assert eq.plot.transients(result, limit=0.5).get_lines()[0].get_xdata()[0] == 0.5


def test_figures_far_below_a_limit_are_still_seen(ensemble):
    ax = eq.plot.transients(ensemble, limit=100.0)
    assert min(bar.get_width() for bar in ax.patches) > 0.9  # of the hundred that the axis shows
    assert sum(bar.get_height() for bar in ax.patches) == pytest.approx(100.0)


# --- sweep ------------------------------------------------------------------------------------------------------------


def a_sweep(over, cells):
    """A result of the shape that the engine gives; a cell: its place, and share by outcome."""
    written = []
    for place, shares in cells.items():
        cell = {"at": {key: over[key][k] for key, k in zip(over, place)}, "starts": 100, "outcomes": []}
        for name, share in shares.items():
            told = {"share": share, "low": share - 0.02, "high": share + 0.01}
            if name in ("undecided", "diverged", "stalled"):
                cell[name] = told
            else:
                alias, code = {"balanced": (None, 1), "co-drifting": ("V1", 2)}[name]
                cell["outcomes"].append({"id": code, "name": name, "alias": alias, "count": 1, **told})
        cell.setdefault("undecided", {"share": 0.0, "low": 0.0, "high": 0.03})
        written.append(cell)
    keys = [{"key": key, "unit": "", "values": values} for key, values in over.items()]
    data = {"over": keys, "zipped": False, "partial": False, "cells": written}
    core = SimpleNamespace(json=lambda: json.dumps(data), text=lambda: "")
    return eq.SweepResult(core, eq.paper_study("table-2-omega-2.4"))


def areas_of(ax):
    return [c for c in ax.collections if type(c).__name__ == "PolyCollection"]


def heights_at(area, x):
    corners = area.get_paths()[0].vertices
    heights = corners[np.isclose(corners[:, 0], x), 1]
    return heights.min(), heights.max()


def test_a_sweep_over_one_parameter_stacks_its_shares(study):
    result = eq.sweep(study, over={"speed.final": [2.4, 2.6, 3.4]}, starts=300)
    ax = eq.plot.sweep(result)
    base = np.zeros(3)
    assert [a.get_label() for a in areas_of(ax)][:3] == ["balanced", "V1: co-drifting", "V2: drifting apart"]
    for area in areas_of(ax):
        code = next(c for c, name in result.names.items() if area.get_label().endswith(name))
        assert same_color(area.get_facecolor()[0], (*to_rgb(_core.colour_of(code)), 0.9))
        top = base + 100.0 * result.shares[result.names[code]]
        for x, low, high in zip(result.axes["speed.final"], base, top):
            assert heights_at(area, x) == pytest.approx((low, high), abs=1e-9)
        base = top
    assert base == pytest.approx(100.0 * (1.0 - result.undecided), abs=1e-6)


def test_what_came_to_no_attractor_lies_on_top_of_a_sweep():
    cells = {(0,): {"balanced": 0.5, "stalled": 0.4, "undecided": 0.1}, (1,): {"balanced": 1.0, "diverged": 0.0}}
    ax = eq.plot.sweep(a_sweep({"speed.final": [2.0, 3.0]}, cells))
    assert [(a.get_label(), *heights_at(a, 2.0)) for a in areas_of(ax)] == [
        ("balanced", 0.0, 50.0), ("stalled", 50.0, pytest.approx(90.0)), ("undecided", pytest.approx(90.0), 100.0),
    ]
    assert same_color(areas_of(ax)[1].get_facecolor()[0], (*to_rgb(_core.colour_of(-3)), 0.9))


def test_a_sweep_shows_the_interval_of_balance():
    ax = eq.plot.sweep(a_sweep({"speed.final": [2.0, 3.0]}, {(0,): {"balanced": 0.5}, (1,): {"balanced": 0.75}}))
    (bars,) = [c for c in ax.collections if type(c).__name__ == "LineCollection"]
    assert [list(s[:, 1]) for s in bars.get_segments()] == [pytest.approx([48.0, 51.0]), pytest.approx([73.0, 76.0])]


def test_a_sweep_over_two_parameters_is_a_heat_map_of_balance():
    shares = {(0, 0): 0.1, (0, 1): 0.2, (0, 2): 0.3, (1, 0): 0.4, (1, 1): 0.5}  # one cell is missing
    over = {"speed.final": [2.0, 3.0], "balancer.drag": [0.01, 0.05, 0.1]}
    result = a_sweep(over, {place: {"balanced": share} for place, share in shares.items()})
    ax = eq.plot.sweep(result)
    expected = np.array([[10.0, 20.0, 30.0], [40.0, 50.0, np.nan]])
    assert ax.collections[0].get_array().reshape(2, 3).filled(np.nan) == pytest.approx(expected, nan_ok=True)
    assert [t.get_text() for t in ax.texts] == ["10", "20", "30", "40", "50"]
    assert ax.get_xlabel() == _core.axis_label("balancer.drag")
    turned = eq.plot.sweep(result, x="speed.final").collections[0].get_array().reshape(3, 2).filled(np.nan)
    assert turned == pytest.approx(expected.T, nan_ok=True)
    # Uneven values stand side by side, each with its number.
    assert [t.get_text() for t in ax.get_xticklabels()] == ["0.01", "0.05", "0.1"]


def test_sweeps_refuse_what_they_cannot_show():
    three = a_sweep({"a": [1], "b": [1], "c": [1]}, {(0, 0, 0): {"balanced": 1.0}})
    with pytest.raises(ValueError, match="3 parameters .* allowed: 1 or 2"):
        eq.plot.sweep(three)
    with pytest.raises(ValueError, match="'d'; allowed: 'a', 'b', 'c'"):
        eq.plot.sweep(three, x="d")


# --- map --------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def plane(study):
    return eq.map(study, size=(40, 32))


def test_a_map_has_the_colour_of_each_outcome(plane):
    ax = eq.plot.map(plane, shade=False)
    picture = ax.get_images()[0].get_array()
    assert picture.shape == (32, 40, 3)
    for code in np.unique(plane.outcome):
        assert np.allclose(picture[plane.outcome == code], to_rgb(_core.colour_of(int(code))))
    assert ax.get_images()[0].origin == "lower"
    assert ax.get_images()[0].get_extent() == pytest.approx([0.0, 2.0 * np.pi, 0.0, 2.0 * np.pi])


def test_a_map_is_the_darker_the_later_it_was_decided(plane):
    picture = np.asarray(eq.plot.map(plane).get_images()[0].get_array())
    for code in np.unique(plane.outcome[plane.outcome > 0]):
        mine = plane.outcome == code
        brightness = picture[mine].sum(axis=1) / sum(to_rgb(_core.colour_of(int(code))))
        order = np.argsort(plane.time[mine], kind="stable")
        assert np.all(np.diff(brightness[order]) <= 1e-12)
        assert brightness.max() == pytest.approx(1.0) and brightness.min() >= 0.5


def test_a_map_says_its_shares_and_angles(plane):
    ax = eq.plot.map(plane)
    titles = ["balanced", "V1: co-drifting", "V2: drifting apart"]
    for title, code, text in zip(titles, (1, 2, 3), legend_texts(ax)):
        assert text == f"{title}, {100.0 * plane.shares[plane.names[code]]:.1f} %"
    ax.figure.canvas.draw()
    inside = [t.get_text() for t, at in zip(ax.get_xticklabels(), ax.get_xticks()) if 0.0 <= at <= 6.3]
    assert inside == ["0", "π/2", "π", "3π/2", "2π"]


def test_pixels_without_an_outcome_are_white():
    from equipoise.plot.plane import coloured

    picture = coloured(np.array([[1, -32768, 0]]), np.array([[3.0, np.nan, np.nan]]))
    assert np.allclose(picture[0], [to_rgb(_core.colour_of(1)), (1, 1, 1), to_rgb(_core.colour_of(0))])


def some_branches():
    value = np.array([2.0, 2.1, 2.2, 2.3, 2.7, 2.8])
    lost = SimpleNamespace(
        change="stability lost", cause="pitchfork", low=2.16, high=2.18, place=2.17, r_min=0.03, r_mean=0.06,
        r_max=0.15,
    )
    end = SimpleNamespace(
        change="death", cause="fold", low=2.33, high=2.35, place=2.34, r_min=0.04, r_mean=0.07, r_max=0.2
    )
    branch = SimpleNamespace(
        id=2, name="co-drifting", alias="V1", value=value, r_min=value / 100, r_mean=value / 50, r_max=value / 20,
        stable=np.array([True, True, False, False, True, True]), events=[lost, end],
    )

    class Branches(list):
        parameter, values = "speed.final", np.array([2.0, 2.1, 2.2, 2.3, 2.4, 2.5, 2.6, 2.7, 2.8])
        study = eq.paper_study("table-2-omega-2.4")

    return Branches([branch])


def test_branches_are_solid_where_they_attract_and_dashed_elsewhere():
    ax = eq.plot.branches(some_branches(), events=False)
    drawn = [(line.get_linestyle(), line.get_xdata(), line.get_ydata()) for line in ax.get_lines()]
    assert [style for style, _, _ in drawn] == ["-", "--", "-"]
    # Stability is lost at 2.17, not at a value of the parameter; the branch ends at 2.34, and there is another part.
    assert drawn[0][1] == pytest.approx([2.0, 2.1, 2.17, 2.17])
    assert drawn[1][1] == pytest.approx([2.17, 2.2, 2.3, 2.34])
    assert drawn[2][1] == pytest.approx([2.7, 2.8])
    assert drawn[0][2] == pytest.approx([2.0 / 20, 2.1 / 20, 0.15, 0.15])
    assert drawn[1][2] == pytest.approx([0.15, 2.2 / 20, 2.3 / 20, 0.2])
    assert all(same_color(line.get_color(), _core.colour_of(2)) for line in ax.get_lines())
    assert legend_texts(ax) == ["V1: co-drifting", "dashed: unstable"]


def test_events_of_branches_are_marked_where_they_happen():
    ax = eq.plot.branches(some_branches(), y="r_mean")
    marks = [line for line in ax.get_lines() if line.get_linestyle() == "None"]
    placed = [(mark.get_marker(), mark.get_xdata()[0], mark.get_ydata()[0]) for mark in marks]
    assert placed == [("^", pytest.approx(2.17), 0.06), ("o", pytest.approx(2.34), 0.07)]
    assert {"pitchfork", "fold"} <= set(legend_texts(ax))


def test_a_branch_that_was_not_followed_further_is_drawn_as_far_as_it_was_seen():
    seen = Event("last seen", "not followed further", 2.33, 2.35, 0.04, 0.07, 0.2)
    assert (seen.place, Event("first seen", "not followed further", 2.33, 2.35, 0, 0, 0).place) == (2.33, 2.35)
    branches = some_branches()
    branches[0].events[1] = seen
    ax = eq.plot.branches(branches)
    lines = [line for line in ax.get_lines() if line.get_linestyle() == "--"]
    assert lines[0].get_xdata() == pytest.approx([2.17, 2.2, 2.3, 2.33])
    assert "not followed further" in legend_texts(ax)


def test_a_range_of_branches_reaches_from_smallest_to_largest():
    ax = eq.plot.branches(some_branches(), y="range", events=False)
    corners = ax.collections[0].get_paths()[0].vertices
    at = corners[np.isclose(corners[:, 0], 2.1), 1]
    assert (at.min(), at.max()) == pytest.approx((0.021, 0.105))


# --- trajectory -------------------------------------------------------------------------------------------------------


def test_a_trajectory_is_its_displacement_over_time(spin_up):
    ax = eq.plot.trajectory(spin_up)
    line = ax.get_lines()[0]
    assert line.get_xdata() == pytest.approx(spin_up.t) and line.get_ydata() == pytest.approx(spin_up.radial)


def test_a_trajectory_marks_ramp_critical_speed_and_release(spin_up):
    ax = eq.plot.trajectory(spin_up)
    ramp = ax.patches[0].get_xy()
    step = 0.1  # of the trajectory's times
    assert ramp[:, 0].min() == 0.0 and ramp[:, 0].max() == pytest.approx(60.0, abs=step)
    upright = {line.get_label(): line.get_xdata()[0] for line in ax.get_lines()[1:]}
    assert upright["critical speed"] == pytest.approx(60.0 / 2.4, rel=1e-6)  # linear in time: exact
    assert upright["balls released"] == pytest.approx(60.0, abs=step)


def test_ball_angles_stand_below(spin_up):
    upper, lower = eq.plot.trajectory(spin_up, balls=True)
    for ball in range(2):
        assert lower.get_lines()[ball].get_ydata() == pytest.approx(spin_up.phi[:, ball])
    figure, pair = plt.subplots(2, 1)
    assert eq.plot.trajectory(spin_up, ax=pair)[1] is pair[1]
    with pytest.raises(TypeError, match="allowed: None, axes of matplotlib, or a pair"):
        eq.plot.trajectory(spin_up, ax=plt.subplots(3, 1)[1])


def test_a_machine_s_trajectory_is_in_its_units(machine):
    run = eq.simulate(machine)
    ax = eq.plot.trajectory(run)
    assert ax.get_ylabel() == "displacement (mm)" and ax.get_xlabel() == "time (s)"
    assert ax.get_lines()[0].get_ydata() == pytest.approx(30.0 * run.radial, rel=1e-9)
    assert any(line.get_ydata()[0] == pytest.approx(1.0) for line in ax.get_lines()[1:])
    assert "limit 1 mm" in legend_texts(ax)
    assert "limit 2 mm" in legend_texts(eq.plot.trajectory(run, limit=2.0))


def test_constant_speed_has_no_ramp(study):
    run = eq.simulate(study.replace(**{"initial.phi": [1.0, 4.0]}), 20.0)
    assert not eq.plot.trajectory(run).patches


# --- disc -------------------------------------------------------------------------------------------------------------


def circles(ax):
    """The race and the balls."""
    found = [p for p in ax.patches if isinstance(p, Circle)]
    return found[0], found[1:]


@pytest.mark.parametrize("frame", ["rotor", "room"])
def test_balls_lie_in_the_race_where_the_trajectory_says(spin_up, frame):
    ax = eq.plot.disc(spin_up, at=700, frame=frame, magnify=10.0)
    race, balls = circles(ax)
    turn = np.exp(1j * spin_up.psi[700]) if frame == "room" else 1.0
    centre = 10.0 * (spin_up.x[700] + 1j * spin_up.y[700]) * turn
    assert complex(*race.center) == pytest.approx(centre, abs=1e-12)
    for ball, phi in zip(balls, spin_up.phi[700]):
        assert complex(*ball.center) == pytest.approx(centre + np.exp(1j * phi) * turn, abs=1e-9)
    mass = next(line for line in ax.get_lines() if line.get_label() == "centre of mass")
    assert complex(mass.get_xdata()[0], mass.get_ydata()[0]) == pytest.approx(centre + 10.0 * 0.01 * turn, abs=1e-12)
    way = next(line for line in ax.get_lines() if line.get_label().startswith("way"))
    assert len(way.get_xdata()) == 701
    assert [t.get_text() for t in ax.texts] == ["1", "2"]


def test_displacements_are_made_large_enough_to_be_seen_and_said_so(spin_up):
    ax = eq.plot.disc(spin_up)
    way = next(line for line in ax.get_lines() if line.get_label().startswith("way"))
    reach = np.hypot(way.get_xdata(), way.get_ydata()).max()
    large = reach / spin_up.radial.max()
    assert 0.1 < reach < 0.5 and f"{large:g}" in ax.get_xlabel()


def test_a_limit_is_a_circle(spin_up):
    ax = eq.plot.disc(spin_up, limit=0.02, magnify=10.0)
    assert any(isinstance(p, Circle) and p.radius == pytest.approx(0.2) for p in ax.patches)
    far = eq.plot.disc(spin_up, limit=0.2, magnify=10)
    assert not any(isinstance(p, Circle) and p.radius > 1.0 for p in far.patches)
    assert "limit 0.2 $R$, outside" in legend_texts(far)


def test_an_attractor_has_its_name_and_colour(attractors):
    drifting = next(a for a in attractors if a.id == 2)
    ax = eq.plot.disc(drifting)
    assert ax.get_title() == "V1: co-drifting"
    way = next(line for line in ax.get_lines() if line.get_label().startswith("way"))
    assert same_color(way.get_color(), _core.colour_of(2))
    arrows = [p for p in ax.patches if type(p).__name__ == "FancyArrowPatch"]
    assert len(arrows) == 2  # both balls run around the race


def test_uncertain_values_in_units_are_drawn_at_their_medians(machine):
    uncertain = machine.replace({"rotor.unbalance": {"uniform": ["200 g mm", "400 g mm"]}})
    run = eq.simulate(uncertain, np.linspace(0.0, 50.0, 51))
    ax = eq.plot.disc(run, magnify=10.0)
    mass = next(line for line in ax.get_lines() if line.get_label() == "centre of mass")
    centre = 10.0 * complex(run.x[-1], run.y[-1])
    offset = 10.0 * 300.0 / (12000.0 * 30.0)  # unbalance over mass and race radius
    assert complex(mass.get_xdata()[0], mass.get_ydata()[0]) == pytest.approx(centre + offset, abs=1e-9)
    assert "critical speed" in legend_texts(eq.plot.trajectory(run))


# --- animate ----------------------------------------------------------------------------------------------------------


def test_a_film_has_the_pictures_that_were_asked_for(spin_up, tmp_path):
    from PIL import Image

    path = eq.plot.animate(spin_up, tmp_path / "spin-up.gif", fps=5, seconds=1, frame="rotor", dpi=40)
    with Image.open(path) as film:
        assert film.n_frames == 5


@pytest.mark.skipif(not animation.writers.is_available("ffmpeg"), reason="ffmpeg is not installed")
def test_a_film_may_be_mp4(spin_up, tmp_path):
    path = eq.plot.animate(spin_up, tmp_path / "spin-up.mp4", fps=10, seconds=0.5, frame="rotor", dpi=41)
    described = subprocess.run(
        ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", str(path)],
        capture_output=True, check=True, text=True,
    )
    (stream,) = json.loads(described.stdout)["streams"]
    assert int(stream["nb_read_frames"]) == 5 and stream["pix_fmt"] == "yuv420p"


def test_a_film_that_would_seem_to_stand_warns(spin_up, tmp_path):
    with pytest.warns(UserWarning, match="turns from one picture to the next"):
        eq.plot.animate(spin_up, tmp_path / "fast.gif", fps=2, seconds=1, frame="room", dpi=30)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"path": "film.avi"}, "ends in .mp4 or .gif"),
        ({"path": "film.gif", "fps": 0}, "fps = 0"),
        ({"path": "film.gif", "seconds": -1.0}, "seconds = -1.0"),
        ({"path": "film.gif", "frame": "moon"}, "'moon'; allowed: 'rotor', 'room'"),
        ({"path": "film.gif", "magnify": -2.0}, "magnify = -2.0"),
    ],
)
def test_films_refuse_what_they_cannot_be(spin_up, tmp_path, arguments, message):
    path = tmp_path / arguments.pop("path")
    with pytest.raises(ValueError, match=message):
        eq.plot.animate(spin_up, path, **arguments)
    assert not path.exists()


# --- what is given wrongly, and what is missing -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "wanted"),
    [
        ("shares", "a BasinResult"), ("transients", "a BasinResult"), ("sweep", "a SweepResult"),
        ("map", "a MapResult"), ("branches", "a BranchesResult"), ("trajectory", "a Trajectory"),
        ("disc", "a Trajectory"),
    ],
)
def test_pictures_say_what_they_draw(study, function, wanted):
    with pytest.raises(TypeError, match=rf"plot\.{function}\(\) draws {wanted}.*given: Study"):
        getattr(eq.plot, function)(study)
    assert not plt.get_fignums()  # nothing was begun


def test_words_and_numbers_out_of_range_are_named(ensemble, spin_up):
    with pytest.raises(ValueError, match="column = 'peak'; allowed: 'peak_radial'"):
        eq.plot.transients(ensemble, "peak")
    with pytest.raises(ValueError, match="bins = 0; allowed: 1 or more"):
        eq.plot.transients(ensemble, bins=0)
    with pytest.raises(ValueError, match="settling_time was not watched; allowed: of a study with limits.settled"):
        eq.plot.transients(ensemble, "settling_time")
    with pytest.raises(ValueError, match="energy was not watched; allowed: of a motor"):
        eq.plot.transients(an_ensemble(transients={"energy": np.full(8, np.nan)}), "energy")
    with pytest.raises(ValueError, match="gathered no transients"):
        eq.plot.transients(an_ensemble(transients=None))
    with pytest.raises(ValueError, match="y = 'r'; allowed: 'r_min'"):
        eq.plot.branches(some_branches(), y="r")
    with pytest.raises(IndexError, match="at = 1601; allowed: -1601 to 1600"):
        eq.plot.disc(spin_up, at=1601)
    with pytest.raises(ValueError, match="magnify = 0"):
        eq.plot.disc(spin_up, magnify=0)


def test_axes_that_are_given_are_drawn_into(ensemble, plane, spin_up):
    for function, result in (("shares", ensemble), ("transients", ensemble), ("map", plane), ("disc", spin_up)):
        ax = plt.figure().add_subplot()
        assert getattr(eq.plot, function)(result, ax=ax) is ax


def run_python(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_matplotlib_is_imported_by_the_first_picture_only():
    done = run_python("import sys, equipoise as eq; eq.plot.shares; print('matplotlib' in sys.modules)")
    assert done.stdout.strip() == "False", done.stderr


def test_a_missing_matplotlib_is_named_with_its_remedy():
    done = run_python(
        "import sys; sys.modules['matplotlib'] = None\n"
        "import equipoise as eq\n"
        "run = eq.simulate(eq.paper_study('table-2-omega-2.4'), 1.0)\n"
        "try: eq.plot.trajectory(run)\n"
        "except ImportError as error: print(error)"
    )
    assert "pip install matplotlib" in done.stdout, done.stderr


def test_pictures_warn_of_nothing(ensemble, plane, spin_up):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        eq.plot.shares(ensemble).figure.canvas.draw()
        eq.plot.map(plane).figure.canvas.draw()
        eq.plot.disc(spin_up).figure.canvas.draw()
        eq.plot.trajectory(spin_up, balls=True)[0].figure.canvas.draw()


PLANE = dict(x_range=(0.5, 6.0), y_range=(0.01, 0.25))


@pytest.fixture(scope="module")
def bifurcations(study):
    return eq.chart(study, size=24, boxes=2000, **PLANE)


def test_a_chart_shows_how_balance_is_lost_what_is_proved_and_regions(bifurcations):
    ax = eq.plot.chart(bifurcations)
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert {"balance is lost softly", "balance is lost abruptly", "two locked states merge", "balance proved stable"} <= set(words)
    assert "A: balance" in words and "C: nothing" in words
    for line in ax.get_lines():
        # The first Lyapunov coefficient decides between the two, point by point.
        if line.get_label() in ("balance is lost softly", "balance is lost abruptly"):
            (curve,) = [c for c in bifurcations.curves if c.of == "balance" and line.get_xdata()[1] in c.x]
            inner = np.isin(curve.x, line.get_xdata()[1:-1])
            assert np.all((curve.lyapunov[inner] < 0.0) == (line.get_label() == "balance is lost softly"))
    for curve in bifurcations.curves:  # no point is left out
        drawn = np.concatenate([line.get_xdata() for line in ax.get_lines()])
        assert np.isin(curve.x, drawn).all()
    boxes = sum(len(collection.get_paths()) for collection in ax.collections)
    assert boxes == np.sum(bifurcations.box_kind >= 0)
    assert ax.get_xlim() == PLANE["x_range"] and ax.get_ylim() == PLANE["y_range"]
    assert not [text for text in eq.plot.chart(bifurcations, regions=False).texts if text.get_text() == "A"]


@pytest.mark.parametrize("log", ["x", "y", "xy"])
def test_planes_and_charts_have_logarithmic_axes(study, bifurcations, log):
    plane = eq.stability(study, size=(30, 20), **PLANE)
    along = eq.map(study, "speed.final", "balancer.drag", (6, 4), x_range=(2.0, 3.0), y_range=(0.1, 0.3))
    for ax in (eq.plot.stability(plane, log=log), eq.plot.map(along, log=log), eq.plot.chart(bifurcations, log=log)):
        assert (ax.get_xscale(), ax.get_yscale()) == tuple("log" if name in log else "linear" for name in "xy")
        ax.figure.canvas.draw()
        assert "0.2" in [text.get_text() for text in ax.get_yticklabels()] or "y" not in log
    even, uneven = eq.plot.stability(plane), eq.plot.stability(plane, log=log)
    mesh = uneven.collections[0]
    uneven.figure.canvas.draw()
    np.testing.assert_allclose(mesh.get_facecolors()[:, :3], even.images[0].get_array().reshape(-1, 3))
    np.testing.assert_allclose(mesh.get_coordinates()[0, :, 0], np.linspace(0.5, 6.0, 31))
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], np.linspace(0.01, 0.25, 21))


def test_axes_that_reach_zero_have_no_logarithm(plane, bifurcations):
    with pytest.raises(ValueError, match="x goes from 0 to .*; allowed: from above 0"):
        eq.plot.map(plane, log="x")
    with pytest.raises(ValueError, match="log = 'z'; allowed: '', 'x', 'y', 'xy'"):
        eq.plot.chart(bifurcations, log="z")
    with pytest.raises(TypeError, match="draws a ChartResult"):
        eq.plot.chart(plane)
