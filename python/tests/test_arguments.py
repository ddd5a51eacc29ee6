"""Arguments as people give them: of any type of number, with units, masked, empty; taken as they are meant or refused."""

from __future__ import annotations

import copy
import pickle
import warnings
from fractions import Fraction

import numpy as np
import pytest

import equipoise as eq
from conftest import studies

ONE_BALL = dict(
    rotor=dict(eccentricity=0.01, damping=0.5),
    balancer=dict(balls=1, mass=0.05, drag=0.05),
    speed=dict(profile="constant", speed=2.4),
)


@pytest.fixture(scope="module")
def machine():
    return eq.Study.from_file(studies / "examples" / "washing-machine.toml")


@pytest.mark.parametrize(
    "call",
    [
        eq.basin, eq.simulate, eq.attractors, eq.explain, eq.certify, eq.map, eq.sweep, eq.capacity, eq.Model, eq.Mapper,
        lambda given: eq.compare(given, given), lambda given: eq.follow(given, "speed.final", 2, 3, 1),
    ],
)
@pytest.mark.parametrize("given", ["machine.toml", ONE_BALL, None])
def test_what_is_no_study_is_told_how_to_become_one(call, given):
    with pytest.raises(TypeError, match="must be an equipoise.Study.*from_file"):
        call(given)


def test_a_path_in_place_of_tables_is_told_of_from_file():
    with pytest.raises(TypeError, match="from_file"):
        eq.Study("machine.toml")
    with pytest.raises(TypeError, match="dictionary"):
        eq.Study(ONE_BALL).replace("speed.final=3")


def test_starts_in_any_order_of_memory_and_type_are_the_same_starts(study, answer):
    phi, mapper = answer.phi[:40], eq.Mapper(study)  # one search for all
    locked = phi.copy()
    locked.setflags(write=False)
    for same in (np.asfortranarray(phi), np.repeat(phi, 2, axis=0)[::2], locked, phi.astype(">f8"), phi.tolist(),
                 np.ma.array(phi), phi[::-1][::-1]):
        np.testing.assert_array_equal(eq.basin(study, initial=same, attractors=mapper).labels, answer.labels[:40])
    single = phi.astype(np.float32)
    np.testing.assert_array_equal(eq.basin(study, initial=single, attractors=mapper).phi, single.astype(float))


@pytest.mark.parametrize(
    ("initial", "message"),
    [
        (np.zeros((0, 2)), "one start or more"),  # not the study's own starts in their place
        (np.ma.array([[1.0, 2.0]], mask=[[False, True]]), "masked"),
        ([[1.0, 2.0], [3.0]], "different lengths"),
        ([[1.0 + 0j, 2.0]], "dtype complex"),
    ],
)
def test_starts_that_are_none_are_refused(study, initial, message):
    with pytest.raises(eq.StudyError, match=message) as error:
        eq.basin(study, initial=initial)
    assert error.value.key in ("initial", "")


def test_a_number_of_starts_beside_ones_own_is_refused(study):
    with pytest.raises(eq.StudyError, match="initial gives the starts"):
        eq.basin(study, 20, initial=[[1.0, 4.0]])


def test_whole_numbers_are_taken_of_every_type_and_nothing_else(easy):
    study = easy
    for starts in (30, 3e1, np.int64(30), np.float32(30), np.uint8(30)):
        assert eq.basin(study, starts, threads=np.int64(1)).starts == 30
    for wrong in (0, -1, 2.5, "30", True, 10**20, float("nan")):
        with pytest.raises(eq.StudyError, match="starts = .*whole number from 1"):
            eq.basin(study, wrong)
    for threads in (-1, 1.5, "all", None, True, 10**6):  # a million of them used to end the interpreter
        with pytest.raises(eq.StudyError, match="threads"):
            eq.basin(study, 10, threads=threads)


@pytest.mark.parametrize(
    ("name", "call"),
    [
        ("half_width", lambda s: eq.basin(s, half_width="0.1")),
        ("half_width", lambda s: eq.sweep(s, {"speed.final": [2.4]}, half_width=0)),
        ("half_width", lambda s: eq.sweep(s, {"speed.final": [2.4]}, half_width=-1)),
        ("seed", lambda s: eq.basin(s, seed=2**63)),
        ("sensitivity", lambda s: eq.basin(s, sensitivity=-1)),
        ("transients", lambda s: eq.basin(s, transients="no")),
        ("cpu", lambda s: eq.basin(s, cpu=3)),
        ("cpu", lambda s: eq.basin(s, cpu="AVX-1024")),
        ("boxes", lambda s: eq.chart(s, size=4, x_range=(1, 2), y_range=(0.01, 0.02), boxes=-1)),
        ("undecided", lambda s: eq.chart(s, size=4, x_range=(1, 2), y_range=(0.01, 0.02), undecided=200)),
        ("cycles", lambda s: eq.chart(s, size=4, x_range=(1, 2), y_range=(0.01, 0.02), cycles="yes")),
        ("step", lambda s: eq.follow(s, "speed.final", 3, 2, 0.1)),
        ("high", lambda s: eq.follow(s, "speed.final", 2, float("inf"), 0.1)),
        ("starts", lambda s: eq.attractors(s, -1)),
        ("states", lambda s: eq.attractors(s, 20, states=np.ma.masked_all((1, 8)))),
        ("starts", lambda s: eq.follow(s, "speed.final", 2, 3, 1, starts=-1)),
        ("size", lambda s: eq.map(s, size="4x3")),
        ("size", lambda s: eq.map(s, size=(4, 3, 2))),
        ("size", lambda s: eq.map(s, size=10**6)),
        ("x_range", lambda s: eq.map(s, size=3, x_range=(0, 1, 2))),
        ("x", lambda s: eq.map(s, 3, size=3)),
        ("over", lambda s: eq.sweep(s, [("speed.final", [2.4])])),
        ("of", lambda s: eq.capacity(s, 3)),
        ("at_least", lambda s: eq.capacity(s, at_least="most")),
        ("between", lambda s: eq.capacity(s, between=(1, 2, 3))),
        ("t", lambda s: eq.simulate(s, "5 s")),
        ("t", lambda s: eq.simulate(s, [3.0, 2.0])),
        ("t", lambda s: eq.simulate(s, [0.0, np.nan])),
        ("t", lambda s: eq.simulate(s, [[0.0, 1.0]])),
        ("t", lambda s: eq.simulate(s, np.ma.array([1.0, 2.0], mask=[True, False]))),
        ("every", lambda s: eq.simulate(s, 5, every="x")),
        ("every", lambda s: eq.simulate(s, [0.0, 1.0], every=0.1)),
        ("map_pixels", lambda s: eq.reproduce("table-7", starts=5, map_pixels=0)),
        ("state", lambda s: eq.Mapper(s)([[1.0, 4.0], [2.0, 3.0]])),
    ],
)
def test_what_cannot_be_used_is_refused_by_the_arguments_name(study, name, call):
    with pytest.raises(eq.StudyError) as error:
        call(study)
    assert error.value.key == name and str(error.value).startswith(f"{name} = ") and error.value.allowed


def test_a_map_takes_sizes_of_numpy_and_names_the_balls_there_are(study):
    assert eq.map(study, size=np.int64(3)).outcome.shape == eq.map(study, size=np.array([3, 3])).outcome.shape == (3, 3)
    with pytest.raises(eq.StudyError, match=r"its one ball.*initial\.phi_dot_1"):
        eq.map(eq.Study(ONE_BALL), size=3)
    single = eq.map(eq.Study(ONE_BALL), y="initial.phi_dot_1", y_range=(-1, 1), size=3)
    assert single.outcome.shape == (3, 3)


def test_rows_of_a_map_go_upwards(study):
    plane = eq.map(study, size=(5, 3))
    states = [(x, y) for y in plane.y for x in plane.x]
    assert plane.y[0] < plane.y[-1]
    np.testing.assert_array_equal(eq.Mapper(study).labels(states).reshape(3, 5), plane.outcome)


def test_three_axes_in_any_order_are_in_their_places(study):
    over = {"speed.final": [2.6, 2.4], "balancer.drag": np.float32([0.125, 0.0625]), "rotor.damping": [0.5]}
    swept = eq.sweep(study, over, starts=40)
    assert swept.shape == (2, 2, 1) and swept.axes["speed.final"].tolist() == [2.6, 2.4]
    for place in np.ndindex(swept.shape):
        at = {key: float(values[k]) for (key, values), k in zip(swept.axes.items(), place)}
        alone = eq.basin(study.replace(at), starts=40)
        assert alone.shares["balanced"] == swept.shares["balanced"][place]


def test_quantities_keep_their_units(study, machine):
    units = pytest.importorskip("pint").UnitRegistry()
    own = np.array([[90.0, 180.0]]) * units.degree
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # pint warns where NumPy takes a unit away
        np.testing.assert_allclose(eq.basin(study, initial=own).phi, [[np.pi / 2, np.pi]], rtol=1e-15)
        in_seconds = eq.simulate(machine, [100, 2000] * units.millisecond)
        speeds = eq.sweep(machine, {"speed.final": [800, 900] * units.rpm}, starts=4)
    np.testing.assert_allclose(in_seconds.t * machine.scales["time"], [0.1, 2.0], rtol=1e-14)
    as_text = eq.sweep(machine, {"speed.final": ["800 rpm", "900 rpm"]}, starts=4)
    assert (speeds.units, as_text.units) == ({"speed.final": "rad/s"}, {"speed.final": "rpm"})
    assert as_text.to_xarray()["speed.final"].units == as_text.to_pandas().attrs["units"]["speed.final"] == "rpm"
    np.testing.assert_allclose(speeds.axes["speed.final"], as_text.axes["speed.final"] * np.pi / 30, rtol=1e-12)
    assert machine.replace({"initial.phi": [10.0] * machine.balls * units.degree})["initial.phi"][0] == pytest.approx(np.pi / 18)
    with pytest.raises(eq.StudyError, match="no angle"):
        eq.basin(study, initial=np.ones((1, 2)) * units.kilogram)
    with pytest.raises(eq.StudyError, match="dimensionless"):
        eq.simulate(study, 2 * units.second)


def test_values_of_a_study_are_refused_by_key_not_as_text(study):
    for value in (None, {1.0, 2.0}, object(), 1j, 10**30, np.ma.array([1.0, 2.0], mask=[False, True])):
        with pytest.raises(eq.StudyError, match="^initial.phi = ") as error:
            study.replace({"initial.phi": value})
        assert error.value.key == "initial.phi" and error.value.wrong.startswith(("is a value of type", "is too large"))
    with pytest.raises(eq.StudyError, match="^rotor.damping = -1: must be"):  # no word of --set, which nobody wrote here
        study.replace({"rotor.damping": -1})
    assert study.replace({"rotor.damping": Fraction(1, 4)})["rotor.damping"] == [0.25, 0.25]
    assert study.replace({"initial.phi": range(2)})["initial.phi"] == [0, 1]


def test_a_study_lists_its_keys(study):
    assert "rotor.eccentricity" in study and "rotor.wheels" not in study and 3 not in study
    assert all(key in study for key in study) and "sampling.seed" in list(study)
    with pytest.raises(KeyError):
        study[3]


def test_copies_can_be_saved_and_mappers_and_models_pickled(study, answer, tmp_path):
    for made in (copy.copy(answer), copy.deepcopy(answer)):
        made.save(tmp_path / "copy.nc")
        np.testing.assert_array_equal(made.labels, answer.labels)
    mapper = pickle.loads(pickle.dumps(eq.Mapper(study)))
    np.testing.assert_array_equal(mapper.labels(answer.phi[:20]), answer.labels[:20])
    driven = eq.Study.from_file(studies / "paper-rotor-with-motor.toml").replace(release={"speed": 1.0})
    released = eq.Model(driven).released_at(30.0)
    assert pickle.loads(pickle.dumps(released)).pieces == released.pieces == [(0.0, 30.0, True), (30.0, np.inf, False)]
    stopped = pickle.loads(pickle.dumps(eq.Interrupted(answer)))
    assert stopped.result.shares == answer.shares and "interrupted" in str(stopped)


def test_a_mapper_of_a_coasting_rotor_lists_attractors_without_a_state():
    mapper = eq.Mapper(eq.Study(
        rotor=dict(eccentricity=0.01, damping=0.5, inertia=0.5), balancer=dict(balls=2, mass=0.05, drag=0.05),
        speed=dict(profile="torque", torque=dict(constant=0.1, until=30.0)),
    ))
    assert mapper.attractors[1].name == "balanced" and mapper.attractors[1].state is None
    assert mapper([1.0, 4.0]) == mapper.attractors[1]


def test_every_result_shows_itself_in_a_notebook(study):
    for result in (eq.simulate(study, 5.0), eq.simulate(study, []), eq.certify(study), eq.explain(study),
                   eq.follow(study, "speed.final", 2.4, 2.4, 0.1), eq.reproduce("table-7", starts=5, law="published")):
        assert result._repr_html_().startswith("<")
    named = eq.Study(ONE_BALL, name="<i>")
    assert "<i>" not in named._repr_html_() + eq.simulate(named, 1.0)._repr_html_()


def test_what_starts_drew_and_stand_for_is_in_their_tables(easy):
    study = easy
    pytest.importorskip("xarray")
    one = {"rotor.eccentricity": {"uniform": [0.005, 0.015]}}
    for changes in (one, {**one, "balancer.drag": {"uniform": [0.2, 0.3]}}):
        answer = eq.basin(study.replace(changes), 30)
        table, dataset = answer.to_pandas(), answer.to_xarray()
        assert answer.arrays["drawn"].shape == (30, len(changes)) and set(answer.study.uncertain) == set(changes)
        for key, distribution in changes.items():
            low, high = distribution["uniform"]
            assert table[key].between(low, high).all() and table[key].nunique() == 30
            np.testing.assert_array_equal(dataset.drawn.sel(uncertain_value=key), table[key])
    assert study.uncertain == {}
    grid = eq.basin(study, 50, method="grid")
    assert grid.to_pandas().weight.sum() == grid.arrays["weight"].sum() > grid.starts  # cells alike are followed once


def test_branches_become_a_dataset_with_names_and_units(study, tmp_path):
    pytest.importorskip("xarray")
    dataset = eq.follow(study, "speed.final", 2.9, 2.95, 0.05, starts=300).to_xarray()
    assert dataset.r_max.units == "R" and "balanced" in dataset.name.values and dataset.study
    dataset.to_netcdf(tmp_path / "branches.nc")


def test_paths_are_of_a_length_and_of_steps(study):
    motion = eq.attractors(study, 50)["balanced"]
    for wrong in (dict(duration=np.inf), dict(duration=0), dict(duration="x"), dict(points=0), dict(points=2.5)):
        with pytest.raises(eq.StudyError):  # an endless one used to hang, whatever was pressed
            motion.path(**wrong)
    assert motion.path(duration=5, points=np.int64(10)).X.shape == (11,)


def test_the_warning_names_the_line_that_asked(study):
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        eq.basin(study.replace({"numerics.horizon": 1.0}), 20)
    assert heard[0].filename == __file__


def test_the_package_lists_its_pictures_without_loading_them():
    assert "plot" in dir(eq)
