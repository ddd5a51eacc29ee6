"""The numbers of publications as equipoise has them: functions of a study that give a number and its error, dimensionless.

Times are in units of the study, 1/omega_c; deflections of a rotor that tilts are means over two places of its shaft, its
bearings or else one race radius to either side.
"""

import functools

import numpy as np

import equipoise as eq

LOOK = 0.05  # steps at which a trajectory is looked at: a sixtieth of a turn at the speeds of these studies
FOLLOWED = 1e-8  # relative error of a trajectory's numbers: of its steps, if nothing grows


# Trajectories


def follow(study, begin, end):
    """The study's trajectory between two times."""
    looks = int(np.ceil((end - begin) / LOOK))
    run = eq.simulate(study, begin + (end - begin) * np.arange(looks + 1) / looks)
    if run.status != "done":
        raise ArithmeticError(f"{study.name}: the trajectory could not be followed")
    return run


def places_of(study):
    tilt = study.parameters["tilt"]
    return (tilt["bearings_at"] or [1.0, -1.0]) if tilt else None


def deflections(study, run):
    """Deflections at both places, a row each; of a rotor that does not tilt, one row."""
    places = places_of(study)
    if places is None:
        return run.radial[None]
    return np.array([np.hypot(run.x + z * run.tilt_x, run.y + z * run.tilt_y) for z in places])


def with_missed(study, value):
    """With the part of a maximum that may be missed: half a look off the top of a curve no faster than rotor and supports."""
    speed = study["speed"].get("final", study["speed"].get("speed"))
    return value, abs(value) * (FOLLOWED + 0.5 * (0.5 * LOOK * (1.0 + abs(speed))) ** 2)


def highest(study, begin, end):
    """Largest deflection between two times."""
    return with_missed(study, deflections(study, follow(study, begin, end)).mean(axis=0).max())


def largest_at_bearings(study, begin, end):
    """Mean of the largest deflections at both bearings."""
    return with_missed(study, deflections(study, follow(study, begin, end)).max(axis=1).mean())


def highest_of_irregular(study, begin, end, runs=8, apart=1e-3):
    """The largest deflection over runs whose first ball starts up to 1e-3 rad off: mean, and twice the standard deviation.

    For motions that do not forget where they began.
    """
    first, *others = study["initial.phi"]
    moved = (study.replace({"initial.phi": [first + apart * k / runs, *others]}) for k in range(runs))
    values = [highest(one, begin, end)[0] for one in moved]
    return np.mean(values), 2.0 * np.std(values, ddof=1)


def settled_without_balls(study):
    """Deflection of the rotor without balls when all else has died out."""
    alone = study.replace({"balancer.balls": 0})
    settled = 2.0 * 23.0 / min(alone.parameters["damping"])  # free vibration has fallen to e^-23
    value = deflections(alone, follow(alone, settled, settled + 10.0)).mean(axis=0)[-1]
    return value, FOLLOWED * value


def settled_speed(study, end):
    """Mean speed over the last tenth of a trajectory of a driven rotor; the error is half its range."""
    speed = follow(study, 0.9 * end, end).psi_dot
    return speed.mean(), 0.5 * np.ptp(speed) + FOLLOWED


def least_ball_rate(study, end):
    """Least rate of any ball until this time; negative if it lags."""
    return with_missed(study, min(0.0, follow(study, 0.0, end).phi_dot.min()))


def last_angle(study, ball, end):
    """Angle of a ball in the end; balls are counted from 0."""
    return follow(study, end - 1.0, end).phi[-1, int(ball)], FOLLOWED


def last_speed(run, balls):
    """The rotor's speed when `balls` was last true of a ball."""
    return run.psi_dot[balls.any(axis=1)].max(initial=run.psi_dot[0]), run.psi_dot[1] - run.psi_dot[0] + FOLLOWED


def lags_until(study, begin, end):
    """Speed of the rotor when last between two times a ball lagged by more than a tenth of the unit."""
    run = follow(study, begin, end)
    return last_speed(run, run.phi_dot < -0.1)


def slow_until(study, below, begin, end):
    """Speed of the rotor when last between two times a ball itself ran slower than `below`."""
    run = follow(study, begin, end)
    return last_speed(run, run.psi_dot[:, None] + run.phi_dot < below)


def ball_speed(study, begin, end):
    """Mean speed of all balls between two times; the error is half the range of theirs."""
    run = follow(study, begin, end)
    means = run.psi_dot.mean() + run.phi_dot.mean(axis=0)
    return 0.5 * (means.min() + means.max()), 0.5 * np.ptp(means)


def balanced_share(study):
    """Share of the study's starts that end balanced, with Wilson's 95 % interval."""
    balanced = eq.basin(study).attractors[0]
    return balanced.share, max(balanced.high - balanced.share, balanced.share - balanced.low)


# Linear theory


def first_where(low, high, holds):
    """Where `holds` begins to be true."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


def balance(study):
    """The balanced state: its angles and eigenvalues, slowest first."""
    return eq.explain(study).data["balanced"]


def rate_near_balance(study, number):
    """Real part of the rate with this number, slowest first, at which deviations from balance grow."""
    return balance(study)["eigenvalues"][int(number)][0], 1e-9  # rounding of an eigenvalue, a thousandth of the largest


def boundary(study, low, high, *keys):
    """Value between two of a key at which balance changes between stable and unstable: the largest real part is zero.

    The key is the speed, unless there are others that all get the value, as in "rotor.eccentricity balancer.mass"; some of
    them multiplied, as in "rotor.damping=2 rotor.tilt.damping=0:18" (2 c; [0, 18 c]).
    """
    study = eq.Study(study.to_dict())  # plain numbers are dimensionless, also with physical units
    factors = {}
    for key, _, given in (text.partition("=") for text in keys or ("speed.speed",)):
        factors[key] = np.array([float(number) for number in given.split(":")]) if given else 1.0

    def stable(value):
        changed = study.replace({key: np.squeeze(factor * value) for key, factor in factors.items()})
        return balance(changed)["eigenvalues"][0][0] < 0.0

    above = stable(high)
    return first_where(low, high, lambda value: stable(value) == above), 1e-7  # rounding of multipliers over a turn


def least_mass(study):
    """Mass of each ball, all alike, from which on balls can cancel the unbalance."""
    def can_balance(mass):
        return eq.explain(study.replace({"balancer.mass": mass})).data["can_balance"]

    return first_where(0.0, 1.0, can_balance), 1e-12


def critical_speed(study, number):
    """Undamped critical speed of the rotor without balls, which whirls as it spins; lowest first, from 0."""
    whirl = eq.explain(study).data["tilt"]["whirl"]
    speeds = sorted(speed["dimensionless"] for kind in whirl.values() for speed in kind)
    return speeds[int(number)], 1e-12


def vibration_without_balls(study):
    """Steady motion of the rotor without balls: mean of the largest deflections at both places."""
    alone = study.replace({"balancer.balls": 0, "rotor.tilt.bearings_at": places_of(study)})
    at_places = eq.explain(alone).data["tilt"]["displacement_at_bearings"]
    return np.mean([place["dimensionless"] for place in at_places]), 0.0


def peak(study, low, high):
    """Speed between two at which the rotor vibrates most without balls."""
    step = 0.001
    speeds = np.arange(low, high, step)
    return speeds[np.argmax([vibration_without_balls(study.replace({"speed.speed": speed}))[0] for speed in speeds])], step


# Limit cycles


@functools.cache
def cycle(study, born, high, points=31):
    """The cycles born where balance changes its stability between two speeds, followed to the study's speed, first time.

    Their branch may pass folds. They are states at evenly spaced times of a period, along which trigonometric polynomials
    solve the equations (collocation); the branch is followed by its arc length. Gives the states, a row each, and the period.
    """

    def model(speed):
        return eq.Model(study.replace({"speed.speed": speed}), frame="inertial")

    hopf = boundary(study, born, high)[0]
    rest = np.zeros(model(hopf).dimension)
    rest[4 : 4 + study.balls] = balance(model(hopf).study)["angles"]
    rates, vectors = np.linalg.eig(model(hopf).jacobian(0.0, rest))
    pair = np.argmax(np.where(rates.imag > 0.0, rates.real, -np.inf))
    turn = np.exp(2j * np.pi * np.arange(points) / points)[:, None] * vectors[:, pair]
    apart = np.subtract.outer(np.arange(points), np.arange(points))
    slope = 0.5 * (-1.0) ** apart / np.sin(np.pi * apart / points + np.eye(points)) * (apart != 0)  # d/d(2 pi t/period)
    size = points * len(rest)
    weight = np.array([1.0 / points] * size + [1.0, 1.0])  # of unknowns: the states, log of the period, the speed

    def states(x):
        return x[:size].reshape(points, -1)

    def solved(x, shift, row, value):
        """By Newton's method, with row . x = value; time is not shifted along `shift`. None if it does not converge."""
        begin, step = x, 1e-5
        for _ in range(8):
            z, pace, speed = states(x), 2.0 * np.pi * np.exp(-x[size]), x[size + 1]
            along, flow = pace * slope @ z, model(speed)
            matrix = np.zeros((size + 2, size + 2))
            matrix[:size, :size] = pace * np.kron(slope, np.eye(len(rest)))
            for k, block in enumerate(flow.jacobian(0.0, z)):
                part = slice(k * len(rest), (k + 1) * len(rest))
                matrix[part, part] -= block
            matrix[:size, size] = -along.ravel()
            matrix[:size, size + 1] = (model(speed - step).rhs(0.0, z) - model(speed + step).rhs(0.0, z)).ravel() / (2.0 * step)
            matrix[size, :size], matrix[size + 1] = shift, row
            left = [*(along - flow.rhs(0.0, z)).ravel(), shift @ (x - begin)[:size], row @ x - value]
            change = np.linalg.solve(matrix, left)
            x = x - change
            if np.sqrt(weight @ change**2) < 1e-10:
                return x
        return None

    target = study["speed.speed"]
    x = np.array([*np.tile(rest, points), np.log(2.0 * np.pi / rates[pair].imag), hopf])
    tangent, shift, length = np.array([*turn.real.ravel(), 0.0, 0.0]), -turn.imag.ravel(), 0.02
    for _ in range(400):
        tangent /= np.sqrt(weight @ tangent**2)
        row = weight * tangent
        following = solved(x + length * tangent, shift, row, row @ x + length)
        if following is None:
            length *= 0.5
            continue
        tangent, before, x = following - x, x, following
        if (before[-1] - target) * (x[-1] - target) <= 0.0:
            guess = before + (target - before[-1]) / tangent[-1] * tangent
            x = solved(guess, shift, np.eye(size + 2)[-1], target)
            return states(x), np.exp(x[size])
        shift, length = (slope @ states(x)).ravel(), min(1.5 * length, 0.1)
    raise ArithmeticError(f"{study.name}: the cycles could not be followed to the study's speed")


def cycle_period(study, born, high):
    """Period of the cycle at the study's speed: see cycle()."""
    return cycle(study, born, high)[1], 1e-8


def cycle_extent(study, born, high, axis, looks=400):
    """How far apart the ends of the cycle are along "x" or "y", for the rotor's centre."""
    states, _ = cycle(study, born, high)
    waves = np.fft.rfft(states[:, "xy".index(axis)])
    extent = np.ptp(np.fft.irfft(waves, looks)) * looks / len(states)
    return extent, 1e-3 * extent  # may be missed between two looks, of a wave with a tenth as many
