"""States: which velocity is which, everywhere."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import equipoise as eq
from conftest import studies


def drawn(study: eq.Study, n: int, seed: int = 3) -> np.ndarray:
    """Rows of x, y, two velocities, ball angles, ball rates, as large as this rotor's own."""
    random = np.random.default_rng(seed)
    rows = random.uniform(-0.3, 0.3, (n, 4 + 2 * study.balls))
    rows[:, 4 : 4 + study.balls] = random.uniform(0, 2 * np.pi, (n, study.balls))
    return rows


@pytest.fixture(scope="module")
def mapper(study):
    return eq.Mapper(study)


def test_velocities_are_turned_into_the_other_frame_and_back(study):
    rows = drawn(study, 9)
    state = eq.State.from_array(rows, frame="rotating", study=study, psi_dot=2.4)
    assert state.frame == "rotating" and state.shape == (9,) and len(state) == 9
    np.testing.assert_allclose(state.u, rows[:, 2] - 2.4 * rows[:, 1], rtol=1e-15)
    np.testing.assert_allclose(state.v, rows[:, 3] + 2.4 * rows[:, 0], rtol=1e-15)
    there = state.to("inertial")
    assert there.frame == "inertial" and there.to("inertial") is there
    np.testing.assert_allclose(there.to("rotating").array(), rows, atol=1e-15)  # two roundings
    np.testing.assert_array_equal(there.array()[:, 4:], rows[:, 4:])
    same = eq.State(x=rows[:, 0], y=rows[:, 1], u=there.u, v=there.v, phi=rows[:, 4:6], phi_dot=rows[:, 6:])
    np.testing.assert_array_equal(same.array("inertial"), there.array())
    np.testing.assert_array_equal([one.array() for one in state], rows)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(state)).array("inertial"), there.array())
    assert "x_dot" in repr(state[0]) and "shape (9,)" in repr(state)


def test_a_trajectory_tells_its_states_in_both_frames():
    # The velocity in the room is the rate of the centre's place there, here by central differences (error h^2).
    study = eq.Study.from_file(studies / "paper/table-3-t0-25.toml").replace({"initial.phi": [1.0, 4.0]})
    h = 1e-4
    run = eq.simulate(study, [20.0 - h, 20.0, 20.0 + h])
    state = run.states[1]
    room = np.array([run.X[2] - run.X[0], run.Y[2] - run.Y[0]]) / (2 * h)
    turn = np.array([[np.cos(run.psi[1]), np.sin(run.psi[1])], [-np.sin(run.psi[1]), np.cos(run.psi[1])]])
    np.testing.assert_allclose([state.u, state.v], turn @ room, atol=1e-6)
    np.testing.assert_allclose(state.x_dot, (run.x[2] - run.x[0]) / (2 * h), atol=1e-6)
    # As the equations say: of a trajectory, at its time.
    model = eq.Model(study)
    np.testing.assert_allclose(model.motion(20.0, state).array(), state.array("rotating"), atol=1e-15)
    np.testing.assert_allclose(model.rhs(20.0, state)[4:6], run.phi_dot[1], atol=1e-15)


def test_a_state_means_the_same_however_it_is_given(study, mapper):
    rows = drawn(study, 200)
    state = eq.State.from_array(rows, frame="rotating", study=study, psi_dot=2.4)
    inertial = state.array("inertial")
    labels = mapper.labels(state)
    for same in (mapper.labels(state.to("inertial")), mapper.labels(rows, frame="rotating"),
                 mapper.labels(inertial, frame="inertial"), eq.basin(study, initial=state, attractors=mapper).labels,
                 eq.basin(study, initial=inertial, frame="inertial", attractors=mapper).labels,
                 eq.basin(study, initial=rows, frame="rotating", attractors=mapper).labels):
        # Turning and turning back rounds: a start on the very edge of a basin may come to the other side; one is allowed.
        assert np.count_nonzero(same != labels) <= 1
    # Taken for the other kind of velocity, more of them than that are other states with other ends.
    assert np.count_nonzero(mapper.labels(rows, frame="inertial") != labels) > 10
    answer = eq.basin(study, initial=state, attractors=mapper)
    np.testing.assert_array_equal(answer.initial.array("rotating"), rows)
    for one, label in zip(state[:3], labels[:3]):
        assert mapper(one).id == label and mapper(one.array("inertial"), frame="inertial").id == label


def test_states_of_a_run_come_to_what_the_run_comes_to(study, mapper):
    run = eq.simulate(study.replace({"initial.phi": [1.0, 4.0]}), np.linspace(0.0, 40.0, 9))
    # The rotor's angle does not matter here: a state on the way is a start.
    assert set(mapper.labels(run.states)) == {mapper([1.0, 4.0]).id}


@pytest.mark.slow
def test_a_motions_state_is_on_the_motion(study, mapper):
    found = eq.attractors(study, 2000)
    for attractor in found:
        assert attractor.state.psi_dot == 2.4
        for frame in ("rotating", "inertial"):
            assert mapper(attractor.state.to(frame)).id == attractor.id
        assert np.hypot(attractor.state.x, attractor.state.y) == pytest.approx(attractor.r_mean, abs=attractor.r_max)
        known = mapper.attractors[attractor.id].state
        assert known.frame == "inertial" and known.psi_dot == 2.4
    v1 = found["V1"].state
    for given, frame in ((v1, None), (v1.to("rotating"), None), (v1.array("rotating")[None], "rotating"),
                         (v1.array("inertial")[None], "inertial")):
        assert "V1" in [a.alias for a in eq.attractors(study, 1, states=given, frame=frame)]
    assert len(eq.follow(study, "speed.final", 2.4, 2.42, 0.02, starts=100, states=v1)) >= 2


def test_of_a_driven_rotor_the_speed_is_part_of_the_state():
    study = eq.Study.from_file(studies / "paper-rotor-with-motor.toml")
    model = eq.Model(study)
    balanced = eq.attractors(study, 200)["balanced"].state
    assert balanced.psi_dot == pytest.approx(2.4, abs=1e-9)
    rates = model.rhs(0.0, balanced)
    assert rates[model.names.index("psi")] == balanced.psi_dot
    np.testing.assert_allclose(np.delete(rates, model.names.index("psi")), 0.0, atol=1e-9)  # Newton's residual
    begin = model.initial_state
    assert begin.psi_dot == 0.0 and model.array(0.0, begin).shape == (model.dimension,)
    rotating = np.concatenate((balanced.array("rotating"), [0.0, balanced.psi_dot]))
    np.testing.assert_allclose(model.rhs(0.0, rotating, frame="rotating"), rates, atol=1e-12)
    with pytest.raises(TypeError, match="at_speed"):
        model.rhs(0.0, eq.State(phi=[1.0, 4.0], u=0.0, v=0.0))
    with pytest.raises(eq.StudyError, match="speed with which the study begins, 0"):
        eq.basin(study, initial=balanced)


@pytest.mark.slow
def test_the_rotors_angle_goes_with_a_state_where_it_matters():
    study = eq.Study.from_file(studies / "paper-rotor-with-motor.toml").replace({"rotor.gravity": 0.02})
    state = eq.State(phi=[[1.0, 4.0]] * 2, x_dot=0.0, y_dot=0.0, psi=[0.0, 2.0])
    np.testing.assert_array_equal(eq.basin(study, initial=state).initial.psi, [0.0, 2.0])
    heavy = eq.Study.from_file(studies / "paper/table-2-omega-2.4.toml").replace({"rotor.gravity": 0.02})
    with pytest.raises(eq.StudyError, match="psi"):
        eq.basin(heavy, initial=state)
    # Motions are looked at where the rotor's angle is 0, and so is their state.
    mapper = eq.Mapper(heavy)
    for known in mapper.attractors.values():
        assert known.state.psi == 0.0 and mapper(known.state).id == known.id
    with pytest.raises(eq.StudyError, match="psi"):
        mapper(known.state._with(psi=1.0))


WHOLE = np.zeros((1, 8))


@pytest.mark.parametrize(
    "call",
    [
        lambda s: eq.basin(s, initial=WHOLE),
        lambda s: eq.Mapper(s)(WHOLE[0]),
        lambda s: eq.Mapper(s).labels(WHOLE),
        lambda s: eq.attractors(s, 10, states=WHOLE),
        lambda s: eq.follow(s, "speed.final", 2.4, 2.5, 0.1, states=WHOLE),
        lambda s: eq.Model(s).states_of(WHOLE),
        lambda s: eq.Model(s).rhs(0.0, WHOLE),
        lambda s: eq.Model(s).jacobian(0.0, WHOLE),
        lambda s: eq.Model(s).energy(0.0, WHOLE),
        lambda s: eq.Model(s).powers(0.0, WHOLE),
        lambda s: eq.Model(s).motion(0.0, WHOLE),
        lambda s: eq.Model(s).state(0.0, WHOLE),
        lambda s: eq.Model(s).cross(0, WHOLE[0]),
    ],
)
def test_an_array_that_could_be_either_is_refused(study, call):
    with pytest.raises(TypeError, match=r'pass frame="rotating" \(x_dot, y_dot\) or frame="inertial" \(u, v\)') as error:
        call(study)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("call", "kind", "message"),
    [
        (lambda s: eq.State(phi=[1.0, 2.0]), TypeError, "x_dot and y_dot"),
        (lambda s: eq.State(phi=[1.0, 2.0], u=0.0), TypeError, "one pair"),
        (lambda s: eq.State(phi=[1.0, 2.0], u=0.0, v=0.0, x_dot=0.0, y_dot=0.0), TypeError, "one pair"),
        (lambda s: eq.State(phi=1.0, u=0.0, v=0.0), eq.StudyError, "one per ball"),
        (lambda s: eq.State(phi=[1.0, 2.0], u=[0.0, 1.0, 2.0], v=0.0), eq.StudyError, r"of shape \(\)"),
        (lambda s: eq.State(phi=[1.0, 2j], u=0.0, v=0.0), eq.StudyError, "dtype complex"),
        (lambda s: eq.State(phi=[1.0, 2.0], x_dot=0.0, y_dot=0.0).u, TypeError, r"at_speed\(psi_dot\)"),
        (lambda s: np.asarray(eq.State(phi=[1.0, 2.0], u=0.0, v=0.0)), TypeError, r'array\("rotating"\)'),
        (lambda s: eq.State.from_array(np.zeros(7), frame="inertial"), eq.StudyError, "4 \\+ 2 balls"),
        (lambda s: eq.State.from_array(np.zeros(6), frame="inertial", study=s), eq.StudyError, r"\(\.\.\., 8\)"),
        (lambda s: eq.State.from_array(np.zeros(8), frame="fixed"), eq.StudyError, '"rotating"'),
        (lambda s: eq.basin(s, initial=eq.State(phi=[1.0], u=0.0, v=0.0)), eq.StudyError, "of 2, the study's"),
        (lambda s: eq.basin(s, initial=eq.State(phi=[1.0, 2.0], u=0.0, v=0.0), frame="inertial"), TypeError, "leave out"),
        (lambda s: eq.basin(s, initial=np.zeros((1, 9)), frame="rotating"), eq.StudyError, "9 numbers a row"),
    ],
)
def test_what_is_no_state_is_refused_in_one_line(study, call, kind, message):
    with pytest.raises(kind, match=message) as error:
        call(study)
    assert "\n" not in str(error.value)


def test_an_attractor_is_the_same_whichever_call_found_it(study):
    found = eq.attractors(study, 500)["V1"]
    counted = next(a for a in eq.basin(study, starts=100).attractors if a.alias == "V1")
    known = next(a for a in eq.Mapper(study).attractors.values() if a.alias == "V1")
    assert found == counted == known and len({found, counted, known}) == 1
    assert counted.count > 0 and counted.state is None and np.isnan(counted.r_max)
    assert known.r_max == pytest.approx(found.r_max, rel=1e-6) and np.isnan(known.share)
    np.testing.assert_allclose(known.path(10.0, 20).radial, found.path(10.0, 20).radial, atol=1e-6)
    with pytest.raises(ValueError, match="no state"):
        counted.path()
    other = eq.attractors(study.replace({"balancer.drag": 0.06}), 500)["V1"]
    assert other.id == found.id and other != found
