"""The rotor without balls against an independent integration of its equations in fixed axes."""

from __future__ import annotations

import numpy as np
import pytest

import equipoise as eq

BALANCER = {"balls": 2, "mass": 0.05, "drag": 0.05}
RAMP = {"profile": "ramp", "final": 3.0, "duration": 60.0}
PLAIN = {"eccentricity": 0.01, "damping": 0.5}
HEAVY = {"eccentricity": 0.01, "damping": [0.3, 0.2], "stiffness": [1.3, 0.8], "gravity": 0.05}
DRIVEN = {"eccentricity": 0.02, "damping": 0.2, "inertia": 0.5}


def torque(constant, slope):
    return {"profile": "torque", "torque": {"constant": constant, "slope": slope}}


def by_scipy(rotor, speed, until):
    """Largest displacement and bearing force; mean speed and largest displacement over the last tenth."""
    integrate = pytest.importorskip("scipy.integrate")
    unbalance, weight = rotor["eccentricity"], rotor.get("gravity", 0.0)
    damping = np.broadcast_to(rotor["damping"], 2)
    stiffness = np.broadcast_to(rotor.get("stiffness", 1.0), 2)
    driven = speed["profile"] == "torque"

    def rates(t, y):
        x, y_force = damping * y[2:4] + stiffness * y[:2]
        cos, sin, w = np.cos(y[4]), np.sin(y[4]), y[5]
        if driven:  # about the centre of mass, on which the supports' forces have the eccentricity as arm
            motor = speed["torque"]["constant"] + speed["torque"]["slope"] * w
            a = (motor - unbalance * (x * sin - y_force * cos)) / rotor["inertia"]
        else:
            rising = t < speed["duration"]
            w = speed["final"] * min(t / speed["duration"], 1.0)
            a = speed["final"] / speed["duration"] if rising else 0.0
        return [y[2], y[3], unbalance * (w * w * cos + a * sin) - x,
                unbalance * (w * w * sin - a * cos) - y_force - weight, w, a]

    rest = -weight / stiffness[1]
    times = np.linspace(0.0, until, int(until * 200) + 1)
    corner = [speed["duration"], until] if not driven else [until]
    state, pieces, begin = [0.0, rest, 0.0, 0.0, 0.0, 0.0], [], 0.0
    for end in corner:
        within = times[(times >= begin) & (times <= end)]
        run = integrate.solve_ivp(rates, (begin, end), state, "DOP853", within, rtol=1e-10, atol=1e-13)
        pieces.append(run.y)
        state, begin = run.y[:, -1], end
    y = np.concatenate(pieces, axis=1)
    radial = np.hypot(y[0], y[1] - rest)
    force = np.hypot(*(damping[:, None] * y[2:4] + stiffness[:, None] * y[:2]))
    last = y.shape[1] // 10
    return radial.max(), force.max(), y[5][-last:].mean(), radial[-last:].max()


@pytest.mark.parametrize(
    ("rotor", "speed", "until"),
    [
        (PLAIN, RAMP, 150.0),
        (HEAVY, RAMP, 200.0),
        (DRIVEN, torque(0.12, -0.04), 300.0),  # passes its resonance
        pytest.param(DRIVEN, torque(0.0012, -0.0003), 4000.0, marks=pytest.mark.slow),  # stalls in it
    ],
)
def test_figures_are_those_of_an_independent_integration(rotor, speed, until):
    study = eq.Study({"rotor": rotor, "balancer": BALANCER, "speed": speed})
    bare = eq.basin(study, starts=8, transients=True).without_balls["no_balls"]
    peak, force, mean_speed, end = by_scipy(rotor, speed, until)
    # 200 samples in a unit of time miss up to (3/200)^2 / 8 = 3e-5 of a peak.
    assert bare["figures"]["peak_radial"]["value"] == pytest.approx(peak, rel=1e-4)
    assert bare["figures"]["peak_force"]["value"] == pytest.approx(force, rel=1e-4)
    assert bare["figures"]["peak_radial_at_end"]["value"] == pytest.approx(end, rel=2e-4)
    if speed["profile"] == "torque":
        assert bare["mean_speed"] == pytest.approx(mean_speed, rel=1e-4)
        assert bare["stalled"] == (mean_speed < 1.0)
