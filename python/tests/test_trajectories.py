"""Trajectories of many starts: shapes, agreement with one, files, and errors that name the argument."""

import pickle

import numpy as np
import pytest

import equipoise as eq

TIMES = np.linspace(0.0, 40.0, 9)


@pytest.fixture(scope="module")
def study():
    return eq.paper_study("table-2-omega-2.4")


@pytest.fixture(scope="module")
def many(study):
    phi = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, (7, 2))
    return eq.simulate(study, TIMES, initial=eq.State(phi=phi, x_dot=0.0, y_dot=0.0))


def test_each_run_is_that_of_its_start_alone(study, many):
    for i in (0, 3, 6):
        alone = eq.simulate(study, TIMES, initial=many.states[i, 0])
        assert isinstance(alone, eq.Trajectory)
        for name in ("x", "y_dot", "phi", "phi_dot", "radial", "bearing_x"):  # both to 1e-12 a step
            np.testing.assert_allclose(getattr(many, name)[i], getattr(alone, name), rtol=0, atol=1e-9)


def test_shapes_and_tables(many):
    assert len(many) == 7 and many.x.shape == (7, 9) and many.phi.shape == (7, 9, 2) and many.status == ["done"] * 7
    data = many.to_xarray()
    assert dict(data.sizes) == {"start": 7, "t": 9, "ball": 2}
    assert data.radial.attrs["long_name"] and data.t.attrs["units"] == "1"
    np.testing.assert_allclose(np.hypot(many.X, many.Y), many.radial, atol=1e-14)
    table = many.to_pandas()
    assert table.index.names == ["start", "t"] and len(table) == 63
    assert table.loc[(3, TIMES[4]), "phi_2"] == many.phi[3, 4, 1]
    assert "7 starts (7 done), 9 times" in repr(many)


def test_pickled_they_are_the_same(many, tmp_path):
    again = pickle.loads(pickle.dumps(many))
    assert again.status == many.status and again.study.name == many.study.name
    np.testing.assert_array_equal(again.phi, many.phi)
    np.testing.assert_array_equal(again.t, many.t)
    for runs in (again, many):
        runs.save(tmp_path / f"{id(runs)}.csv")
    assert (tmp_path / f"{id(again)}.csv").read_text() == (tmp_path / f"{id(many)}.csv").read_text()


def test_the_starts_of_a_study_are_those_of_basin(study):
    runs = eq.simulate(study, [0.0, 1.0], starts=5, seed=9)
    np.testing.assert_array_equal(runs.phi[:, 0], eq.basin(study, starts=5, seed=9).phi)


def test_files_hold_the_same(study, many, tmp_path):
    xarray = pytest.importorskip("xarray")
    many.save(tmp_path / "many.nc")
    with xarray.open_dataset(tmp_path / "many.nc") as data:
        for name, values in many.to_xarray().data_vars.items():
            assert data[name].dims == values.dims and data[name].attrs["long_name"] == values.attrs["long_name"]
            np.testing.assert_array_equal(data[name], values)
    many.save(tmp_path / "many.csv")
    rows = (tmp_path / "many.csv").read_text().splitlines()
    assert rows[0].startswith("start,t,psi") and len(rows) == 64
    assert float(rows[1 + 3 * 9 + 4].split(",")[4]) == many.x[3, 4]


def test_many_starts_of_a_rotor_with_uncertain_values_have_its_medians(study):
    uncertain = study.replace({"rotor.eccentricity": {"uniform": [0.008, 0.012]}})
    runs = eq.simulate(uncertain, [0.0, 5.0], starts=3)
    np.testing.assert_allclose(runs.x, eq.simulate(study, [0.0, 5.0], starts=3).x, rtol=0, atol=1e-12)


def test_one_state_makes_one_trajectory(study):
    run = eq.simulate(study, 10.0, initial=eq.State(phi=[1.0, 4.0], x_dot=0.0, y_dot=0.0))
    assert run.phi[0].tolist() == [1.0, 4.0] and run.status == "done"


@pytest.mark.parametrize(
    ("settings", "argument"),
    [
        (dict(initial=np.zeros((0, 2))), "initial"),
        (dict(initial=np.zeros((3, 1))), "initial"),
        (dict(initial=[[0.0, np.nan]]), "initial"),
        (dict(initial=[[0.0, 1.0]], starts=2), "starts"),
        (dict(starts=0), "starts"),
        (dict(seed=3), "seed"),
    ],
)
def test_errors_name_the_argument(study, settings, argument):
    with pytest.raises(eq.StudyError, match=argument):
        eq.simulate(study, 1.0, **settings)
