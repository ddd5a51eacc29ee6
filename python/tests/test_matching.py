"""Attractors of neighbouring answers: which is which."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import equipoise as eq
from equipoise import matching

pytest.importorskip("scipy")

#: Found by attractors() for the paper's rotor: identifier, name, kind, smallest, mean and largest displacement, rate of both balls.
PAIRS_AT_1_4 = (
    (6, "pair drift", "periodic", 0.0094, 0.0505, 0.0761, -0.272), (8, "pair drift (2)", "periodic", 0.0, 0.0115, 0.0354, -0.007),
)
PAIRS_AT_1_5 = (
    (6, "pair drift", "quasi-periodic", 0.0, 0.0221, 0.0434, -0.078), (8, "pair drift, chaotic", "chaotic", 0.0, 0.0554, 0.1116, -0.320),
)

THREE_BALLS = eq.Study(
    rotor=dict(eccentricity=0.05, damping=0.5), balancer=dict(balls=3, mass=0.05, drag=0.05), speed=dict(profile="constant", speed=2.4)
)


def made(study, number, name, kind="periodic", low=0.0, mean=0.1, high=0.2, rates=0.0, phi=(0.0, 0.0), centre=(0.0, 0.0)):
    """An attractor as an answer lists it."""
    balls = study.balls
    data = {
        "id": number, "name": name, "alias": "", "kind": kind, "radial": {"min": low, "mean": mean, "max": high},
        "drift": list(np.broadcast_to(rates, balls)), "state": [*centre, 0.0, 0.0, *np.resize(phi, balls), *[0.0] * balls],
    }
    return eq.Attractor(data, study)


@pytest.fixture(scope="module")
def mappers(study):
    """The paper's rotor at three speeds: balance, V1 and V2 exist at each of them."""
    return [eq.Mapper(study.replace({"speed.final": speed}), threads=1) for speed in (2.2, 2.3, 2.4)]


@pytest.mark.parametrize("by", ["position", "features", "name"])
def test_v1_and_v2_stay_themselves_across_speeds_in_both_directions(mappers, by):
    for before, after in zip(mappers, mappers[1:]):
        there, back = eq.match(before, after, by=by), eq.match(after, before, by=by)
        assert there.same == back.same == {1: 1, 2: 2, 3: 3} and not there.gone + there.new + back.gone + back.new
        assert there.distance == back.distance and max(there.distance.values()) < 0.1
    for answers in (mappers, mappers[::-1]):
        tracks = eq.match_along(answers, by=by)
        assert [[a.alias for a in track.values()] for track in tracks] == [[""] * 3, ["V1"] * 3, ["V2"] * 3]
        assert [list(track) for track in tracks] == [[0, 1, 2]] * 3


def test_the_attractors_of_a_mapper_are_those_of_a_search(mappers):
    """A mapper does not have the mean rates; they are measured on the motion, whose other starts differ in phase."""
    found = eq.attractors(mappers[-1].study, 300, threads=1)
    matching_of_both = eq.match(mappers[-1], found)
    assert matching_of_both.same == {1: 1, 2: 2, 3: 3}
    assert max(matching_of_both.distance.values()) < 0.01  # of the rates one turn in 1000 units is 0.006, over a speed of 2.4


def test_names_would_exchange_two_pair_drifts(study):
    """Between speeds of 1.4 and 1.5 the small one of two takes the name of the large one, which becomes chaotic."""
    slow, fast = ([made(study, *row) for row in rows] for rows in (PAIRS_AT_1_4, PAIRS_AT_1_5))
    for by in ("position", "features"):
        assert eq.match(slow, fast, by=by, threshold=0.4).same == {6: 8, 8: 6} == eq.match(fast, slow, by=by, threshold=0.4).same
        assert eq.match(slow, fast, by=by).same == {8: 6}  # the chaotic motion is larger by a third
    assert eq.match(slow, fast, by="name").same == {6: 6}


def test_the_pairs_have_the_least_sum_of_distances_not_the_nearest_first(study):
    before = [made(study, number, f"{number}", low=r, mean=r, high=0.2) for number, r in ((1, 0.100), (2, 0.140))]
    after = [made(study, number, f"{number}", low=r, mean=r, high=0.2) for number, r in ((3, 0.130), (4, 0.160))]
    assert eq.match(before, after).same == {1: 3, 2: 4}
    assert eq.match(before, after, threshold=0.1).same == {2: 3}  # 1 and 3 are 0.21 apart, 2 and 3 0.07, 2 and 4 0.14
    assert eq.match(before, after, threshold=0.1).gone == [1] and eq.match(before, after, threshold=0.1).new == [4]


def test_distances_are_symmetric_and_have_no_scale(study):
    random = np.random.default_rng(3)

    def motions(studied, factor):
        return [matching._described(made(studied, k, "", "chaotic", *(factor * np.sort(values[:3])), -values[3:5]), "features")
                for k, values in enumerate(random.uniform(0.1, 1.0, (5, 5)))]

    one, two = motions(study, 1.0), motions(study, 1.0)
    distances = matching._distances(one, two, "features")
    np.testing.assert_array_equal(distances, matching._distances(two, one, "features").T)
    assert np.all(np.diag(matching._distances(one, one, "features")) == 0.0)
    random = np.random.default_rng(3)
    smaller = study.replace({"rotor.eccentricity": 0.001, "balancer.mass": 0.005})
    np.testing.assert_allclose(matching._distances(motions(smaller, 0.1), motions(smaller, 0.1), "features"), distances, rtol=1e-12)


def test_equilibria_are_compared_by_where_they_are(study):
    def locked(studied, number, phi, radius=0.1):
        return made(studied, number, "locked", "equilibrium", radius, radius, radius, phi=phi, centre=(radius, 0.0))

    here, opposite = locked(study, 7, (0.0, 0.0)), locked(study, 8, (0.0, np.pi))
    assert eq.match([here], [opposite], by="features").same == {7: 8}  # of one size
    assert eq.match([here], [opposite]).gone == [7]
    assert eq.match([locked(study, 7, (0.3, 2.0))], [locked(study, 9, (2.0, 0.3 + 2 * np.pi))]).distance[7] < 1e-12  # exchanged
    unlike = study.replace({"balancer.mass": [0.03, 0.07]})
    assert eq.match([locked(unlike, 7, (0.3, 2.0))], [locked(unlike, 9, (2.0, 0.3))]).gone == [7]
    # Balanced states of three balls are a continuum, and an answer gives any one of them.
    members = [
        made(THREE_BALLS, 1, "balanced", "equilibrium", 0.0, 0.0, 0.0, phi=phi)
        for phi in ((np.pi, 1.0, 1.0 + np.pi), (2.0, 2.0 + np.pi, np.pi))
    ]
    assert eq.match(members[:1], members[1:]).distance[1] < 1e-12


def test_equal_balls_may_exchange_their_rates_and_unlike_ones_not(study):
    def captured(studied, number, rates):
        return made(studied, number, "one captured", low=0.01, mean=0.07, high=0.1, rates=rates)

    assert eq.match([captured(study, 4, (-1.6, 0.0))], [captured(study, 4, (0.0, -1.6))]).distance == {4: 0.0}
    unlike = study.replace({"balancer.mass": [0.05, 0.06]})
    assert eq.match([captured(unlike, 4, (-1.6, 0.0))], [captured(unlike, 8, (0.0, -1.6))]).new == [8]


def test_one_that_an_answer_lacks_keeps_its_identity(study):
    rest = made(study, 1, "balanced", "equilibrium", 0.0, 0.0, 0.0)
    drift = [made(study, 3 + k, f"number {k}", "chaotic", 0.05, 0.1 + 0.004 * k, 0.2) for k in range(7)]
    large = [made(study, 20 + k, f"large {k}", "chaotic", 0.6, 0.7, 0.8) for k in range(7)]
    lists = [[rest, drift[0]], [rest], [drift[2], rest], [rest, large[3]], [large[4], rest, drift[4]], [rest], [rest, drift[6], large[6]]]
    identities = [{k: a.id for k, a in track.items()} for track in eq.match_along(lists)]
    assert identities == [dict.fromkeys(range(7), 1), {0: 3, 2: 5, 4: 7, 6: 9}, {3: 23, 4: 24, 6: 26}]
    backwards = [{6 - k: a.id for k, a in track.items()} for track in eq.match_along(lists[::-1])]
    assert sorted(map(sorted, (track.items() for track in backwards))) == sorted(map(sorted, (track.items() for track in identities)))
    assert eq.match_along([]) == [] and eq.match_along([[], [rest]])[0] == {1: rest}
    assert eq.match([], [rest]).new == [1] and eq.match([rest], []).gone == [1]


@pytest.mark.parametrize(
    ("name", "call"),
    [
        ("by", lambda a: eq.match([a], [a], by="basin")),
        ("threshold", lambda a: eq.match([a], [a], threshold=-1)),
        ("threshold", lambda a: eq.match_along([[a]], threshold="far")),
        ("before", lambda a: eq.match(a.study, [a])),
        ("after", lambda a: eq.match([a], 3)),
        ("after", lambda a: eq.match([a], [a, a])),
        ("answers[1]", lambda a: eq.match_along([[a], ["balanced"]])),
        ("by", lambda a: eq.match([a], [made(THREE_BALLS, 1, "balanced")])),
    ],
)
def test_what_cannot_be_matched_is_refused(study, name, call):
    with pytest.raises(eq.StudyError) as error:
        call(made(study, 1, "balanced"))
    assert error.value.key == name


def test_an_ensemble_lists_names_and_no_states(mappers, study):
    answer = eq.basin(study, 100, threads=1, attractors=mappers[-1])
    assert eq.match(mappers[-1], answer, by="name").same == {1: 1, 2: 2, 3: 3}
    with pytest.raises(eq.StudyError, match='must be "name"'):
        eq.match(mappers[-1], answer)


def test_scipy_is_named_if_it_is_not_installed(study, monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(ImportError, match="this needs scipy"):
        eq.match([made(study, 1, "balanced")], [made(study, 1, "balanced")])
