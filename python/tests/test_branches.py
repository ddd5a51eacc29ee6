"""One motion followed along a parameter: arrays along the curve, folds passed, errors that name the argument."""

import numpy as np
import pytest

import equipoise as eq


@pytest.fixture(scope="module")
def study():
    return eq.paper_study("table-2-omega-2.4")


@pytest.fixture(scope="module")
def found(study):
    return eq.attractors(study, 1000)


@pytest.fixture(scope="module")
def both_ways(found):
    return found["V1"].follow("speed.final", 1.0, 5.5)


def test_folds_are_passed_in_the_order_of_the_curve(both_ways):
    assert both_ways.alias == "V1" and both_ways.ends == ("the range ends", "the range ends")
    assert both_ways.value[0] == 1.0 and both_ways.value[-1] == 5.5
    folds = [event.low for event in both_ways.events if event.cause == "fold"]
    np.testing.assert_allclose(folds, [5.036239, 4.2576], atol=1e-4)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(both_ways.value))))
    assert len(turns) == 2  # the parameter turns back at the folds and nowhere else
    assert "pitchfork at 4.416" in repr(both_ways)


def test_arrays_have_a_row_per_point(both_ways):
    n = len(both_ways.value)
    assert both_ways.drift.shape == (n, 2) and both_ways.spectrum.shape == (n, 8) and both_ways.state.phi.shape == (n, 2)
    # V1 turns once a period, both balls at one rate.
    np.testing.assert_allclose(np.abs(both_ways.drift) * both_ways.period[:, None], 2 * np.pi, rtol=1e-9)
    largest = np.abs(both_ways.spectrum[:, 1:]).max(axis=1)
    np.testing.assert_allclose(largest, both_ways.multiplier, rtol=1e-6)
    np.testing.assert_array_equal(both_ways.stable, largest < 1.0)
    data = both_ways.to_xarray()
    assert data.sizes["point"] == n and data.period.attrs["units"] == "1/omega_c"
    assert list(both_ways.to_pandas().columns[:2]) == ["speed.final", "kind"]


def test_its_motion_is_the_one_that_a_search_finds_there(study, both_ways):
    at = int(np.argmin(np.abs(both_ways.value[: np.argmax(both_ways.value)] - 3.0)))
    searched = eq.attractors(study.replace({"speed.speed": float(both_ways.value[at])}), 400)["V1"]
    np.testing.assert_allclose(both_ways.period[at], searched.period, rtol=1e-7)
    np.testing.assert_allclose(both_ways.r_max[at], searched.r_max, rtol=1e-5)


def test_balance_has_hopf_points(found):
    branch = found["balanced"].follow("speed.final", 1.0, 2.4)
    assert [event.cause for event in branch.events] == ["Hopf"] * 3
    assert [event.change for event in branch.events] == ["stability gained", "stability lost", "stability gained"]
    assert np.isnan(branch.period).all() and branch.ends == ("the range ends", "the range ends")


@pytest.mark.parametrize(
    ("motion", "arguments", "says"),
    [
        ("V1", ("speed.final", 2.5, 3.0), "low = 2.5: must be at most"),
        ("V1", ("speed.final", 1.0, 2.0), "high = 2.0: must be at least"),
        ("V1", ("speed.final", 2.0, "x"), "high"),
        ("V2", ("speed.final", 2.4, 3.0), "quasi-periodic"),
    ],
)
def test_errors_say_what_is_wrong(found, motion, arguments, says):
    with pytest.raises(eq.StudyError, match=says):
        found[motion].follow(*arguments)


def test_gravity_is_refused(study):
    heavy = eq.attractors(study.replace({"rotor.gravity": 0.01}), 200)
    with pytest.raises(eq.StudyError, match="the rotor's angle matters"):
        next(iter(heavy)).follow("speed.final", 2.4, 2.6)
