"""Ensembles: the program's fates bit for bit, arrays, own starts, comparisons."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import equipoise as eq
from conftest import described_alike, studies

TWELVE = [
    ("paper/table-2-omega-2.4.toml", {}),
    ("paper/table-5-t0-100.toml", {}),
    ("paper-rotor-with-motor.toml", {}),
    ("paper/table-2-omega-2.4.toml", {"rotor.gravity": 0.002}),
    ("paper/table-2-omega-2.4.toml", {"balancer.contact_angle": 0.3, "balancer.restitution": 0.5}),
    ("paper/table-2-omega-2.4.toml", {"balancer.balls": 3, "balancer.mass": 0.03}),
    ("examples/optical-drive.toml", {}),
    *(
        pytest.param(f"{path}.toml", {}, marks=pytest.mark.slow)
        for path in (
            "paper/table-2-omega-2.0",
            "paper/table-2-omega-5.0",
            "paper/table-1-beta-0.01-omega-3.0",
            "paper/table-3-t0-25",
            "examples/washing-machine",
        )
    ),
]


@pytest.mark.parametrize(("path", "changes"), TWELVE)
def test_fates_are_the_programs_bit_for_bit(path, changes, program, tmp_path):
    xarray = pytest.importorskip("xarray")
    file = tmp_path / "result.nc"
    settings = [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    starts = 30 if "drive" in path else 60  # of so few no verdict is sought: its trials would follow many times as many
    told = program("basin", studies / path, "--starts", starts, "-o", file, "--quiet", *settings)
    assert told.returncode == 0, told.stderr
    answer = eq.basin(eq.Study.from_file(studies / path).replace(changes), starts=starts)
    with xarray.open_dataset(file) as stored:
        for name in ("outcome", "decision_time", "decided_by", "phi"):
            np.testing.assert_array_equal(answer.arrays[name], stored[name].values, name)
        for name, values in (answer.transients or {}).items():
            ended = np.isfinite(values)  # files mark the others as missing
            np.testing.assert_array_equal(values[ended], stored[name].values[ended], name)


def test_an_outcome_that_did_not_occur_has_no_share(answer):
    assert answer.shares["diverged"] == 0.0 and answer.counts["diverged"] == 0 and "diverged" not in answer.shares
    low, high = answer.errors["diverged"]
    # Wilson: z^2 / (n + z^2), z = 1.959964
    assert low == 0.0 and high == pytest.approx(3.841459 / 403.841459, rel=1e-6)
    again = pickle.loads(pickle.dumps(answer))
    assert again.shares == answer.shares and again.shares["failed"] == 0.0


def test_the_share_by_a_time_grows_to_the_share(answer):
    times = np.array([[0.0, 100.0], [1000.0, np.inf]])
    for name, given in (("balanced", "balanced"), ("co-drifting", "V1")):
        by = answer.share_by(times, given)
        of = answer.labels == {n: c for c, n in answer.names.items()}[name]
        for place in np.ndindex(2, 2):
            known = np.count_nonzero(of & (answer.decision_time <= times[place]))
            assert by.share[place] == known / 400 and by.low[place] <= by.share[place] <= by.high[place]
        assert by.share[1, 1] == answer.shares[name] and (by.low[1, 1], by.high[1, 1]) == answer.errors[name]
    assert answer.share_by(50.0, "diverged").share == 0.0
    weighted = eq.basin(answer.study, starts=200, method="grid")
    by = weighted.share_by([np.inf])
    assert by.share[0] == pytest.approx(weighted.shares["balanced"], abs=1e-12)


def test_a_sensitivity_needs_no_ensemble_of_default_size(study):
    uncertain = study.replace({"rotor.eccentricity": {"uniform": [0.009, 0.011]}})
    assert eq.basin(uncertain, sensitivity=64).starts == 64
    assert eq.basin(uncertain, 100, sensitivity=64).starts == 100


def test_shares_errors_counts_and_labels_tell_the_same(answer):
    assert answer.starts == 400 and not answer.partial
    assert sum(answer.shares.values()) == pytest.approx(1.0, abs=1e-12)
    for attractor in answer.attractors:
        assert np.count_nonzero(answer.labels == attractor.id) == attractor.count == answer.counts[attractor.name]
        low, high = answer.errors[attractor.name]
        assert low <= attractor.share <= high and (low, high) == (attractor.low, attractor.high)
    assert answer.phi.shape == (400, 2) and answer.phi.min() >= 0 and answer.phi.max() < 2 * np.pi
    assert answer.decision_time.shape == (400,) and answer.decision_time.min() > 0
    assert set(answer.labels) <= set(answer.names)


@pytest.mark.slow
def test_a_brute_force_reference_in_numpy_finds_the_same_starts_balanced(study):
    """Newton's equations of rotor and balls, written down anew, by Runge-Kutta's classical method with fixed steps."""
    balls, eccentricity, damping, mass, drag, omega = 2, 0.01, 0.5, 0.05, 0.05, 2.4
    answer = eq.basin(study.replace({"speed.final": omega}), starts=60)  # balanced, two balls drifting together, apart
    total = 1.0 + balls * mass

    def rates(state):
        # x, y, rates (rotating frame), angles, rates: forces on the rotor and along the race, solved for accelerations.
        x, y, vx, vy = state[:4]
        phi, q = state[4 : 4 + balls], state[4 + balls :]
        c, s = np.cos(phi), np.sin(phi)
        # Along the race: phi'' = -drag q + sin (ax) - cos (ay), (ax, ay): the centre's acceleration in the rotor's axes.
        # On the rotor: total a = centrifugal of the rotor's mass and of the balls - mass (phi'' e) - spring - damper.
        damper_x, damper_y = damping * (vx - omega * y), damping * (vy + omega * x)
        fx = eccentricity * omega**2 - x - damper_x
        fy = -y - damper_y
        m11, m12, m22 = np.full_like(x, total), np.zeros_like(x), np.full_like(x, total)
        for k in range(balls):
            spin = (omega + q[k]) ** 2
            fx = fx + mass * (spin * c[k] + s[k] * (-drag * q[k]))
            fy = fy + mass * (spin * s[k] - c[k] * (-drag * q[k]))
            m11 = m11 - mass * s[k] * s[k]
            m12 = m12 + mass * s[k] * c[k]
            m22 = m22 - mass * c[k] * c[k]
        determinant = m11 * m22 - m12 * m12
        ax, ay = (m22 * fx - m12 * fy) / determinant, (m11 * fy - m12 * fx) / determinant
        q_dot = -drag * q + s * ax - c * ay
        return np.concatenate(
            [[vx, vy, ax + 2 * omega * vy + omega**2 * x, ay - 2 * omega * vx + omega**2 * y], q, q_dot]
        )

    state = np.zeros((4 + 2 * balls, answer.starts))
    state[4:6] = answer.phi.T
    step, until = 0.05, 800.0  # error a step about (2.4 * 0.05)^5 / 120 = 2e-7: far below what a fate depends on
    for _ in range(int(until / step)):
        k1 = rates(state)
        k2 = rates(state + 0.5 * step * k1)
        k3 = rates(state + 0.5 * step * k2)
        k4 = rates(state + step * k3)
        state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    balanced = np.hypot(state[0], state[1]) < 1e-4  # the next motion shakes a hundred times as much
    # A start on the very edge of a basin may come to the other side; of sixty, one is allowed.
    assert np.count_nonzero(balanced != (answer.labels == 1)) <= 1
    assert 5 < np.count_nonzero(balanced) < 55  # both happen


def test_starts_of_ones_own_come_to_what_drawn_ones_do(study, answer):
    own = eq.basin(study, initial=answer.phi[:100])
    np.testing.assert_array_equal(own.labels, answer.labels[:100])
    np.testing.assert_array_equal(own.decision_time, answer.decision_time[:100])
    whole = np.zeros((100, 8))
    whole[:, 4:6] = answer.phi[:100]
    np.testing.assert_array_equal(eq.basin(study, initial=whole, frame="rotating").labels, answer.labels[:100])
    whole[:, 0] = 0.2
    assert np.any(eq.basin(study, initial=whole, frame="rotating").labels != answer.labels[:100])


@pytest.mark.parametrize(
    ("initial", "message"),
    [
        (np.zeros((5, 3)), r"rows of 2 \(ball angles\) or 8"),
        (np.zeros(4), "shape"),
        (np.array([["a", "b"]]), "dtype"),
        (np.array([[0.0, np.nan]]), "row 0"),
    ],
)
def test_own_starts_of_another_shape_are_refused(study, initial, message):
    with pytest.raises(eq.StudyError, match=message):
        eq.basin(study, initial=initial)


def test_a_mapper_classifies_as_basin_does(study, answer):
    mapper = eq.Mapper(study)
    np.testing.assert_array_equal(mapper.labels(answer.phi[:50]), answer.labels[:50])
    for k in range(5):
        known = mapper(answer.phi[k])
        assert known is not None and known.id == answer.labels[k]
        assert known.name == answer.names[answer.labels[k]]
    assert mapper.attractors[1].name == "balanced" and mapper.attractors[1].r_max < 1e-12
    with pytest.raises(eq.StudyError):
        mapper([1.0, 2.0, 3.0])


def test_half_width_and_method_are_the_programs(study, program):
    path = studies / "paper" / "table-2-omega-2.4.toml"
    answer = eq.basin(eq.Study.from_file(path), half_width=0.02, method="sobol")
    import json

    told = json.loads(program("basin", path, "--half-width", 0.02, "--set", "sampling.method=sobol", "--json").stdout)
    assert answer.starts == told["starts"]
    assert answer.shares["balanced"] == told["outcomes"][0]["share"]
    assert max(high - low for low, high in answer.errors.values()) <= 2 * 0.02
    with pytest.raises(eq.StudyError, match="half_width"):
        eq.basin(study, half_width=2)


def test_transients_are_gathered_by_start(study):
    answer = eq.basin(study, starts=50, transients=True)
    assert answer.transients is not None
    peak = answer.transients["peak_radial"]
    assert peak.shape == (50,) and peak.min() > 0
    assert eq.basin(study, starts=50).transients is None


def test_the_rotor_without_balls_stands_beside_it(study):
    answer = eq.basin(study, starts=50, transients=True)
    bare, held = answer.without_balls["no_balls"], answer.without_balls["balls_held"]
    assert bare["runs"] == 1 and held["runs"] == 50
    assert bare["figures"]["peak_radial"]["value"] > 0.0
    assert set(bare["figures"]) == set(held["figures"]) < set(answer.transients)
    assert eq.basin(study, starts=50).without_balls is None


def test_starts_within_limits_are_counted(study):
    assert eq.basin(study, starts=50, transients=True).within_limits == {}
    answer = eq.basin(study.replace({"limits.displacement": 0.02}), starts=50)
    within = answer.within_limits
    assert set(within) == {"at_end", "on_the_way", "both"}
    assert within["on_the_way"]["count"] == np.sum(answer.transients["peak_radial"].astype(float) <= 0.02)


def test_a_rotor_without_balls_has_no_starts(study):
    answer = eq.basin(study.replace({"balancer.balls": 0}))
    assert answer.starts == 0 and answer.without_balls["no_balls"]["one_for_all"]
    with pytest.raises(eq.StudyError, match="leaves nothing to balance with"):
        eq.attractors(study.replace({"balancer.balls": 0}))


def test_results_become_tables_and_files(answer, tmp_path):
    xarray = pytest.importorskip("xarray")
    table = answer.to_pandas()
    assert list(table.columns[:4]) == ["phi_1", "phi_2", "outcome", "decision_time"]
    assert (table.outcome == "balanced").sum() == answer.counts["balanced"]
    dataset = answer.to_xarray()
    assert dataset.decision_time.long_name.endswith("in 1/omega_c") and dataset.sizes == {"start": 400, "ball": 2}
    answer.save(tmp_path / "saved.nc")
    with xarray.open_dataset(tmp_path / "saved.nc", mask_and_scale=False) as stored:
        np.testing.assert_array_equal(stored.outcome.values, answer.labels)
        described_alike(dataset, stored)
    again = pickle.loads(pickle.dumps(answer))
    assert again.shares == answer.shares and again.text == answer.text and again.study == answer.study
    np.testing.assert_array_equal(again.labels, answer.labels)
    with pytest.raises(eq.RunError, match="pickle"):
        again.save(tmp_path / "again.nc")


def test_what_dry_friction_leaves_is_known_by_start(study):
    pytest.importorskip("xarray")
    sticking = study.replace({"balancer.rolling": 1e-3, "balancer.stiction": 2e-3, "sampling.starts": 40})
    answer = eq.basin(sticking)
    left = answer.arrays["left_unbalance"]
    assert np.isfinite(left[answer.labels == 1]).all() and (answer.labels == 1).any()
    assert answer.to_xarray()["left_unbalance"].long_name.split(";")[0].endswith("in M R")
    np.testing.assert_array_equal(answer.to_pandas()["left_unbalance"], left)
    assert eq.basin(study, starts=8).arrays["left_unbalance"] is None


def test_seaborn_takes_the_table(answer):
    seaborn = pytest.importorskip("seaborn")
    axes = seaborn.histplot(answer.to_pandas(), x="decision_time", hue="outcome")
    assert len(axes.patches) > 0


def test_results_show_themselves(answer):
    assert "balanced" in repr(answer) and "400 starts" in repr(answer)
    assert "<table>" in answer._repr_html_() and "balanced" in str(answer)


def test_undecided_starts_are_warned_of(study):
    with pytest.warns(eq.UndecidedWarning, match=r"^\d{1,3}\.\d % of the starts are undecided"):
        short = eq.basin(study.replace({"numerics.horizon": 1.0}), starts=50)
    assert short.undecided > 0.01 and short.shares["undecided"] == short.undecided


def test_comparison_of_two_studies(study):
    both = eq.compare(study, study.replace({"speed.final": 5.0}), starts=200)
    balance = next(d for d in both.differences if d.name == "balanced")
    assert balance.low <= balance.difference <= balance.high
    assert balance.difference == pytest.approx(balance.second - balance.first)
    assert both.changed > 0 and both.verdict in str(both.text)
    assert "balanced" in both._repr_html_() and len(both.to_pandas()) == len(both.differences)
