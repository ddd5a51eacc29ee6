"""The equations, handed to others."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import equipoise as eq
from conftest import studies

scipy_integrate = pytest.importorskip("scipy.integrate")


def solved(model: eq.Model, until: float) -> np.ndarray:
    """SciPy's way through all pieces of a study's time."""
    state, begin = model.array(0.0, model.initial_state), 0.0
    for number, (_, end, _) in enumerate(model.pieces):
        stop = min(end, until)
        if stop > begin:
            run = scipy_integrate.solve_ivp(
                lambda t, y: model.rhs(t, y, number), (begin, stop), state, method="DOP853", rtol=1e-11, atol=1e-13
            )
            state, begin = run.y[:, -1], stop
        if end >= until:
            return state
        state = model.array(end, model.cross(number, state), number + 1)
    return state


@pytest.mark.parametrize(
    "name, changes",
    [
        ("paper/table-2-omega-2.4.toml", {"initial.phi": [1.0, 4.0]}),
        ("paper/table-3-t0-25.toml", {"initial.phi": [1.0, 4.0]}),
        ("paper-rotor-with-motor.toml", {"initial.phi": [1.0, 4.0]}),
        ("examples/washing-machine.toml", {"balancer.contact": False}),
    ],
)
def test_scipy_integrates_the_equations_to_what_simulate_says(name, changes):
    study = eq.Study.from_file(studies / name).replace(changes)
    model = eq.Model(study, frame="inertial")
    until = model.release_time + 20.0 if np.isfinite(model.release_time) else 20.0
    run = eq.simulate(study, [until])
    motion = model.motion(until, solved(model, until))
    # Both integrate to 1e-11 a step; errors grow by less than e^(0.5 t) near the saddle that balls may pass: 1e-6.
    scale = max(1.0, np.abs(run.phi).max())
    np.testing.assert_allclose(motion.phi, run.phi[0], atol=1e-6 * scale)
    for name in ("x", "y", "x_dot", "y_dot", "psi_dot"):
        assert getattr(motion, name) == pytest.approx(getattr(run, name)[0], abs=1e-6), name


def test_the_jacobian_is_the_derivative(study):
    model = eq.Model(study, frame="inertial")
    rng = np.random.default_rng(5)
    states = rng.normal(size=(7, model.dimension))
    matrix = model.jacobian(0.3, states)
    assert matrix.shape == (7, model.dimension, model.dimension)
    h = 1e-5  # error of central differences h^2, of rounding 1e-16 / h
    for k in range(model.dimension):
        step = np.zeros(model.dimension)
        step[k] = h
        column = (model.rhs(0.3, states + step) - model.rhs(0.3, states - step)) / (2 * h)
        np.testing.assert_allclose(matrix[:, :, k], column, atol=1e-7)


def test_energy_changes_by_the_powers(study):
    model = eq.Model(study, frame="inertial")
    state = np.random.default_rng(6).normal(size=model.dimension)
    h = 1e-4
    run = scipy_integrate.solve_ivp(model.rhs, (0, h), state, rtol=1e-12, atol=1e-14, t_eval=[0, h / 2, h])
    drive, supports, balls = model.powers(h / 2, run.y[:, 1])
    slope = (model.energy(h, run.y[:, 2]) - model.energy(0, run.y[:, 0])) / h
    assert slope == pytest.approx(drive - supports - balls, abs=1e-5)  # h^2 of the third derivative, about 1e3


def test_arrays_of_any_shape_go_in_and_out(study):
    model = eq.Model(study, frame="inertial")
    states = np.random.default_rng(7).normal(size=(3, 4, model.dimension))
    together = model.rhs(0.0, states)
    assert together.shape == states.shape and model.energy(0.0, states).shape == (3, 4)
    np.testing.assert_array_equal(together[1, 2], model.rhs(0.0, states[1, 2]))
    assert model.names[:4] == ["x", "y", "u", "v"] and len(model.names) == model.dimension
    for wrong in (np.zeros(3), np.zeros((2, model.dimension + 1)), 1.0):
        with pytest.raises(eq.StudyError, match="shape"):
            model.rhs(0.0, wrong)
    with pytest.raises(eq.StudyError, match="one time"):
        model.rhs(np.zeros(5), states)
    again = pickle.loads(pickle.dumps(model))
    assert again.names == model.names
    np.testing.assert_array_equal(again.rhs(0.0, states), together)


def test_components_come_first_for_vectorised_integrators(study):
    rows, columns = eq.Model(study, frame="inertial"), eq.Model(study, frame="inertial", axis=0)
    square = np.random.default_rng(8).normal(size=(rows.dimension, rows.dimension))
    np.testing.assert_array_equal(columns.rhs(0.3, square), rows.rhs(0.3, square.T).T)
    np.testing.assert_array_equal(columns.rhs(0.3, square[:, 0]), rows.rhs(0.3, square[:, 0]))
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(columns)).rhs(0.3, square), columns.rhs(0.3, square))
    begin = rows.array(0.0, rows.initial_state)
    one, many = (
        scipy_integrate.solve_ivp(model.rhs, (0, 5), begin, method="BDF", vectorized=vectorised)
        for model, vectorised in ((rows, False), (columns, True))
    )
    np.testing.assert_array_equal(one.y, many.y)
    assert columns.state(many.t, many.y).shape == many.t.shape
    with pytest.raises(eq.StudyError, match="axis"):
        eq.Model(study, axis=1)


def test_contact_needs_events(study):
    with pytest.raises(eq.StudyError, match="event"):
        eq.Model(study.replace({"balancer.contact_angle": 0.3}))


def test_a_run_becomes_tables_and_files(study, tmp_path):
    xarray = pytest.importorskip("xarray")
    run = eq.simulate(study, np.linspace(0, 30, 61))
    assert run.status == "done" and run.phi.shape == (61, 2)
    np.testing.assert_allclose(np.hypot(run.X, run.Y), run.radial, atol=1e-15)
    run.save(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc") as stored:
        np.testing.assert_array_equal(stored.radial.values, run.radial)
    run.save(tmp_path / "run.csv")
    import pandas

    csv = pandas.read_csv(tmp_path / "run.csv", comment="#", index_col="t", float_precision="round_trip")
    pandas.testing.assert_frame_equal(csv, run.to_pandas(), check_exact=True)
    assert run.to_xarray().radial.long_name.endswith("in race radii")
    again = pickle.loads(pickle.dumps(run))
    np.testing.assert_array_equal(again.phi, run.phi)
    with pytest.raises(eq.StudyError):
        eq.simulate(study, [3.0, 1.0])
    assert eq.simulate(study, 10.0).t[-1] == 10.0


def test_a_rotor_that_tilts_has_its_slopes_in_every_form(tmp_path):
    study = eq.Study.from_file(studies / "long-rotor.toml")
    assert study.parameters["tilt"]["transverse_inertia"] == study["rotor.tilt"]["transverse_inertia"] == 3.25
    assert eq.Study.from_file(studies / "paper" / "table-2-omega-2.4.toml").parameters["tilt"] is None
    run = eq.simulate(study, t=np.linspace(0.0, 20.0, 11))
    assert np.abs(run.tilt_x).max() > 1e-4
    dataset = run.to_xarray()
    assert {"tilt_x", "tilt_y", "tilt_x_dot", "tilt_y_dot"} <= set(dataset) & set(run.to_pandas().columns)
    run.save(tmp_path / "run.csv")
    assert (tmp_path / "run.csv").read_text().startswith("t,psi,psi_dot,x,y,x_dot,y_dot,tilt_x,")
    flat = eq.simulate(eq.paper_study("table-2-omega-2.4"), t=1.0)
    assert not hasattr(flat, "tilt_x") and "tilt_x" not in flat.to_xarray()


def test_a_study_with_bearings_has_displacement_and_force_at_each(tmp_path):
    study = eq.Study.from_file(studies / "tilting-washer.toml")
    run = eq.simulate(study, t=np.linspace(0.0, 20.0, 11))
    assert run.bearing_radial.shape == (11, 2)
    # Nothing has moved the shaft yet: it rests under its weight.
    np.testing.assert_allclose(run.bearing_radial[0], 0.0, atol=1e-15)
    assert (run.bearing_radial[-1] > 1e-4).all()
    # And the bearings share the weight, in which nothing else acts.
    np.testing.assert_allclose(run.bearing_force[0].sum(), np.hypot(run.bearing_x[0], run.bearing_y[0]), rtol=1e-12)
    dataset = run.to_xarray()
    assert dataset.bearing_radial.dims == dataset.bearing_force.dims == ("t", "bearing") and list(dataset.bearing) == [1, 2]
    assert {"bearing_radial_1", "bearing_radial_2"} <= set(run.to_pandas().columns)
    run.save(tmp_path / "run.csv")
    titles = (tmp_path / "run.csv").read_text().splitlines()[0].split(",")
    force = "M R omega_c^2"
    assert titles[-4:] == ["bearing_radial_1 (R)", "bearing_radial_2 (R)", f"bearing_force_1 ({force})", f"bearing_force_2 ({force})"]
    run.save(tmp_path / "run.nc")
    import xarray

    with xarray.open_dataset(tmp_path / "run.nc") as kept:
        np.testing.assert_array_equal(kept.bearing_radial, run.bearing_radial)
    assert "bearing_radial" not in eq.simulate(eq.Study.from_file(studies / "long-rotor.toml"), t=1.0).to_xarray()


@pytest.mark.parametrize("wrong", [
    lambda y: y + 1j,
    lambda y: np.ma.array(y, mask=[True] + [False] * (len(y) - 1)),
    lambda y: y.astype("datetime64[s]"),
    lambda y: [None, *y[1:]],
    lambda y: y > 0.0,
    lambda y: y.astype(str),
])
@pytest.mark.parametrize("frame", ["inertial", "rotating"])
def test_rates_are_of_numbers_alone(wrong, frame):
    """NumPy would drop an imaginary part or a mask, and read a date as a number."""
    model = eq.Model(eq.Study.from_file(studies / "paper/table-2-omega-2.4.toml"))
    state = model.array(0.0, model.initial_state)
    for compute in (model.rhs, model.jacobian, model.energy):
        with pytest.raises(eq.StudyError, match="state"):
            compute(0.0, wrong(state), frame=frame)
        with pytest.raises(eq.StudyError, match="t"):
            compute(wrong(np.zeros(1)), state, frame=frame)
    np.testing.assert_array_equal(model.rhs(0, state.tolist(), frame=frame), model.rhs(0.0, state, frame=frame))
