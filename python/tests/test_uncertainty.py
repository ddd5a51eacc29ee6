"""The uncertainty exponent: pairs of starts, their fit, and what the tolerance flips."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import equipoise as eq
from equipoise import _power_law, uncertainty

SCALES = np.geomspace(1e-3, 1e-1, 5)


@pytest.fixture(scope="module")
def found(study):
    return eq.uncertainty_exponent(study, SCALES, pairs=2000, threads=1)


def test_shares_are_those_of_pairs_decided_by_a_mapper(study, found):
    random, mapper = np.random.default_rng(study["sampling.seed"]), eq.Mapper(study, threads=1)
    for k, scale in enumerate(SCALES):
        first, second = uncertainty._pairs(random, scale, 2000, study, [0, 1])
        np.testing.assert_allclose(np.linalg.norm(second - first, axis=1), scale, rtol=1e-12 / scale)
        assert found.different[k] == np.sum(mapper.labels(first) != mapper.labels(second))
        assert found.low[k] < found.share[k] == found.different[k] / found.pairs[k] < found.high[k]
    np.testing.assert_array_equal(found.pairs, 2000)
    assert found.undecided == 0 and found.balls == (1, 2)


def test_shares_are_those_of_pixels_of_a_map_as_far_apart(study):
    """One ball displaced by whole pixels: a map's rows, which wrap around, hold such pairs also."""
    plane = eq.map(study, size=256)
    steps = np.array([1, 2, 4, 8])
    pixels = np.array([np.mean(plane.outcome != np.roll(plane.outcome, step, axis=1)) for step in steps])
    found = eq.uncertainty_exponent(study, 2.0 * np.pi / 256 * steps, pairs=10000, balls=1)
    error = np.sqrt(found.share * (1.0 - found.share) * (1 / 10000 + 1 / plane.outcome.size))  # as if pixels were random
    assert np.all(np.abs(found.share - pixels) < 4.0 * error)
    value, low, high = plane.figures["uncertainty_exponent"]
    assert found.interval[0] < high and low < found.interval[1] and abs(found.exponent - value) < 0.1


def test_one_ball_may_be_displaced_alone(study):
    first, second = uncertainty._pairs(np.random.default_rng(1), 0.01, 1000, study, [1])
    np.testing.assert_array_equal(first[:, 0], second[:, 0])
    np.testing.assert_allclose(np.abs(first[:, 1] - second[:, 1]), 0.01, rtol=1e-10)
    assert 400 < np.sum(second[:, 1] > first[:, 1]) < 600  # 6 standard errors
    alone = eq.uncertainty_exponent(study, [1e-2, 1e-1], pairs=1000, balls=2)
    assert alone.balls == (2,) and 0.2 < alone.exponent < 0.7


def test_the_tolerance_flips_as_many_starts_as_two_mappers_show(study):
    coarse = study.replace({"numerics.tolerance": 1e-2})
    found = eq.uncertainty_exponent(coarse, SCALES, pairs=4000)
    first, _ = uncertainty._pairs(np.random.default_rng(study["sampling.seed"]), SCALES[0], 4000, study, [0, 1])
    one, other = (eq.Mapper(study.replace({"numerics.tolerance": t})).labels(first) for t in (1e-2, 1e-5))
    assert found.flips == np.mean(one != other) > 0.0 and found.flips_low < found.flips < found.flips_high
    assert found.smallest_scale == pytest.approx((found.flips_high / found.coefficient) ** (1.0 / found.exponent))
    finer = eq.uncertainty_exponent(study, SCALES, pairs=4000)
    assert finer.flips <= found.flips and finer.smallest_scale < SCALES[0]


def test_scales_at_which_the_tolerance_decides_warn(study):
    scales = [1e-6, 1e-5, 1e-2, 1e-1]
    with pytest.warns(UserWarning, match="the tolerance alone flips") as warned:
        found = eq.uncertainty_exponent(study.replace({"numerics.tolerance": 1e-2}), scales, pairs=1000)
    assert warned[0].filename == __file__
    assert found.smallest_scale > scales[0] and "depend on the tolerance" in repr(found)


def test_attractors_that_two_searches_number_differently_are_matched(study):
    class Listed:
        def __init__(self, attractors):
            self.attractors = {a.id: a for a in attractors}

    pytest.importorskip("scipy")
    balanced, first, second = eq.Mapper(study).attractors.values()
    renumbered = [eq.Attractor({**a.data, "id": number}, study) for a, number in ((balanced, 1), (first, 3), (second, 2))]
    labels = np.array([1, 3, 2, 0, -1], dtype=np.int16)
    renamed = uncertainty._renamed(labels, Listed(renumbered), Listed([balanced, first, second]))
    np.testing.assert_array_equal(renamed, [1, 2, 3, 0, -1])
    lacking = uncertainty._renamed(labels, Listed(renumbered), Listed([balanced]))
    assert lacking[0] == 1 and not set(lacking[1:3]) & {1, 2, 3, 0, -1, -2, -3}


def counts(random, exponent, coefficient, pairs, scale=SCALES):
    return random.binomial(pairs, coefficient * scale**exponent)


def test_the_fit_is_the_most_likely_power(study):
    optimize = pytest.importorskip("scipy.optimize")
    pairs = np.array([4000, 3000, 2000, 1000, 500])
    different = counts(np.random.default_rng(3), 0.4, 0.8, pairs)

    def minus_likelihood(at):
        share = np.exp(np.minimum(at[0] + at[1] * np.log(SCALES), -1e-12))
        return -(different * np.log(share) + (pairs - different) * np.log1p(-share)).sum()

    best = optimize.minimize(minus_likelihood, [np.log(0.5), 0.5], method="Nelder-Mead", options=dict(xatol=1e-9, fatol=1e-10))
    exponent, (low, high), coefficient, deviance = _power_law.fitted(SCALES, pairs, different)
    assert (exponent, np.log(coefficient)) == pytest.approx((best.x[1], best.x[0]), abs=1e-5)
    assert 0.0 <= deviance < 12.0  # 3 degrees of freedom: above in 0.7 % of such draws
    for end in (low, high):  # twice the fall of the profile likelihood is chi squared's 3.84, or more if the deviance is above 3
        bounds = (-3.0, -np.max(end * np.log(SCALES)))
        at = optimize.minimize_scalar(
            lambda a, end=end: minus_likelihood((a, end)), bounds=bounds, method="bounded", options=dict(xatol=1e-10)
        )
        assert 2.0 * (at.fun - best.fun) == pytest.approx(3.8415 * max(1.0, deviance / 3.0), rel=1e-3)


def test_intervals_hold_the_exponent_as_often_as_they_promise():
    random = np.random.default_rng(7)
    fits = [_power_law.fitted(SCALES, np.full(5, 1000), counts(random, 0.4, 0.8, 1000)) for _ in range(100)]
    inside = sum(low < 0.4 < high for _, (low, high), _, _ in fits)
    assert inside >= 89  # 95 % of 100 less 3 standard errors; a wide deviance makes some wider
    assert np.mean([fit[0] for fit in fits]) == pytest.approx(0.4, abs=0.005)


def test_local_exponents_hold_the_exponent_as_often_as_they_promise():
    random = np.random.default_rng(8)
    pairs = np.full(5, 4000)
    local = [_power_law.neighbouring(SCALES, pairs, counts(random, 0.4, 0.8, 4000)) for _ in range(200)]
    inside = np.mean([(low < 0.4) & (0.4 < high) for _, low, high in local])
    assert 0.92 < inside < 0.98  # 800 intervals, 95 % expected: 3 standard errors are 2.3 %


def test_shares_that_follow_no_power_say_so():
    bent = np.array([4, 80, 600, 1500, 2000])
    exponent, (low, high), _, deviance = _power_law.fitted(SCALES, np.full(5, 4000), bent)
    straight = _power_law.fitted(SCALES, np.full(5, 4000), np.round(4000 * 0.8 * SCALES**0.4).astype(int))
    assert straight[3] < 0.1 and deviance > 100.0 and high - low > 3.0 * (straight[1][1] - straight[1][0])


def test_pairs_that_bound_no_exponent_say_so(easy):
    assert _power_law.fitted(np.array([0.01, 0.1]), np.array([50, 50]), np.array([0, 9]))[1][1] == np.inf
    nothing = eq.uncertainty_exponent(easy, [1e-2, 1e-1], pairs=50)
    assert np.isnan(nothing.exponent) and np.isnan(nothing.smallest_scale) and np.isnan(nothing.local).all()
    assert "not known, since no pairs differ" in repr(nothing) and nothing.one_power


def test_touching_balls_start_without_overlap():
    drum = eq.new("washing-machine")
    contact = drum.parameters["contact_angle"]
    assert contact > 0.0
    for phi in uncertainty._pairs(np.random.default_rng(2), 0.3, 500, drum, [0, 1, 2, 3]):
        gaps = np.abs(np.angle(np.exp(1j * (phi[:, :, None] - phi[:, None, :])))) + 10.0 * np.eye(4)
        assert gaps.min() > contact
    starts = uncertainty._drawn(np.random.default_rng(2), 20000, 4, contact)
    np.testing.assert_allclose(np.histogram(starts[:, 2], 4, (0.0, 2.0 * np.pi))[0] / 20000, 0.25, atol=0.01)  # 3 standard errors
    assert eq.uncertainty_exponent(drum, [1e-2, 1e-1], pairs=20).pairs.tolist() == [20, 20]


def test_undecided_pairs_are_left_out_with_a_warning(study):
    short = study.replace({"numerics.horizon": 20.0})
    with pytest.warns(eq.UndecidedWarning, match="are left out"):
        found = eq.uncertainty_exponent(short, [1e-2, 1e-1], pairs=200)
    assert found.undecided > 0 and found.undecided + found.pairs.sum() == 400


def test_tables_have_a_row_per_scale(found):
    pytest.importorskip("pandas")
    dataset, frame = found.to_xarray(), found.to_pandas()
    np.testing.assert_array_equal(dataset.scale, SCALES)
    np.testing.assert_array_equal(frame.index, SCALES)
    for table in (dataset, frame):
        np.testing.assert_array_equal(table["share"], found.share)
        np.testing.assert_array_equal(np.asarray(table["local"]), [*found.local, np.nan])
    assert all({"units", "long_name"} <= set(variable.attrs) for variable in dataset.variables.values())
    assert dataset.attrs["exponent"] == found.exponent and dataset.attrs["exponent_interval"] == list(found.interval)


def test_the_same_seed_gives_the_same_pairs_on_any_number_of_threads(study, found):
    again = eq.uncertainty_exponent(study, SCALES, pairs=2000, threads=2, seed=study["sampling.seed"])
    other = eq.uncertainty_exponent(study, SCALES, pairs=2000, seed=77)
    np.testing.assert_array_equal(again.different, found.different)
    assert repr(again) == repr(found) == repr(pickle.loads(pickle.dumps(found)))
    assert np.any(other.different != found.different)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("scales", dict(scales=0.1)), ("scales", dict(scales=[0.1])), ("scales", dict(scales=[0.1, 0.01])),
        ("scales", dict(scales=[0.0, 0.1])), ("scales", dict(scales=[0.1, 4.0])), ("scales", dict(scales=["a", "b"])),
        ("pairs", dict(pairs=0)), ("pairs", dict(pairs=1.5)), ("seed", dict(seed=-1)), ("balls", dict(balls=0)),
        ("balls", dict(balls=3)), ("balls", dict(balls=[1, 1])), ("balls", dict(balls=[])), ("cpu", dict(cpu="abacus")),
    ],
)
def test_unusable_arguments_are_refused(study, name, arguments):
    with pytest.raises(eq.StudyError) as error:
        eq.uncertainty_exponent(study, **arguments)
    assert error.value.key == name


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rotor.eccentricity": {"uniform": [0.005, 0.015]}}, "uncertain"),
        ({"numerics.tolerance": 1e-13}, "1e-11 or more"),
    ],
)
def test_studies_without_an_exponent_are_refused(study, change, message):
    with pytest.raises(eq.StudyError, match=message):
        eq.uncertainty_exponent(study.replace(change), pairs=10)
    with pytest.raises(TypeError, match="must be an equipoise.Study"):
        eq.uncertainty_exponent("study.toml")
