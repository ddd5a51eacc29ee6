"""What the program says of a machine, sentence by sentence, held against trajectories of its own `simulate`.

Each check is a function of an Examination; it yields (claim, true or false, what was seen). A claim that a machine does
not call forth is not yielded.
"""

import csv
import itertools
import json
import math
import os
import re
import subprocess

import numpy as np
import xarray


class NoAnswer(Exception):
    """A command that takes too long: nothing false, and told apart."""


class Examination:
    """One machine, what `explain` says of it, and trajectories of it and its variants."""

    patience = 60.0  # seconds per command

    def __init__(self, program, machine, folder, starts):
        self.program, self.machine, self.folder, self.starts = program, machine, folder, starts
        self.path = self.write(machine, "")
        self.text = self.run("explain", self.path)
        self.said = json.loads(self.run("explain", self.path, "--json"))
        self.quantity = {row["name"]: row for row in self.said["quantities"]}
        self.unit = self.quantity["unit of time"]["si"]
        self.warnings = self.said["warnings"]
        self.critical = min(pair["dimensionless"] for pair in self.said["critical_speed_with_balls"])
        speed = self.said["final_speed"]
        self.speed = speed["dimensionless"] if speed else None
        self._bare = None

    def write(self, machine, suffix):
        path = os.path.join(self.folder, f"machine-{machine.number}{suffix}.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(machine.text())
        return path

    def run(self, *arguments, allowed=(0,)):
        try:
            done = subprocess.run([self.program, *arguments], capture_output=True, text=True, timeout=self.patience)
        except subprocess.TimeoutExpired as late:
            raise NoAnswer(f"equipoise {arguments[0]} {arguments[1]}: no answer in {self.patience:.0f} s") from late
        if done.returncode not in allowed:
            command = " ".join(word if len(word) < 80 else word[:60] + "..." for word in arguments)
            raise RuntimeError(f"equipoise {command}: exit {done.returncode}: {done.stderr.strip()[-300:]}")
        return done.stdout

    def simulate(self, machine, suffix, times, settings=()):
        """Columns by name, at dimensionless times. Tolerance: what is judged is seen to 1e-3 or worse."""
        path = self.write(machine, suffix)
        options = [word for setting in settings for word in ("--set", setting)]
        at = ",".join(f"{t:.12g} s" for t in np.asarray(times) * self.unit)
        rows = list(csv.reader(self.run("simulate", path, "--at", at, "--tolerance", "1e-10", *options).splitlines()))
        values = np.array(rows[1:], dtype=float)
        return {name.partition(" (")[0]: values[:, k] for k, name in enumerate(rows[0])}

    def at_speed(self, changes):
        """The machine at its final speed from the start, its balls free."""
        rpm = self.said["final_speed"]["si"] * 30.0 / math.pi
        return self.machine.changed({"speed": {"profile": "constant", "speed": f"{rpm!r} rpm"}, "release": {"time": "0 s"},
                                     "rotor.inertia": None, **changes})

    @property
    def decay(self):
        """Time in which vibrations on the supports fall to 1/e, at most."""
        return 2.0 * (1.0 + self.quantity["mass of all balls"]["dimensionless"]) / self.support_damping

    @property
    def support_damping(self):
        names = ["support damping"] if "support damping" in self.quantity else ["support damping, x", "support damping, y"]
        return min(self.quantity[name]["dimensionless"] for name in names)

    @property
    def balls(self):
        return int(self.quantity["balls"]["dimensionless"])

    @property
    def gravity(self):
        return self.quantity.get("gravity", {}).get("dimensionless", 0.0)

    def bare(self):
        """X and Y at the final speed, in fixed axes and over whole turns, of the rotor with next to no balls."""
        if self._bare is None:
            begin = 14.0 * 2.0 / self.support_damping
            turn = 2.0 * math.pi / abs(self.speed)
            race = self.machine.tables["balancer"]["race_radius"]
            drag = 1e-12 * (float(race.split()[0]) * 1e-3) ** 2 / self.unit  # beta = 1
            light = {"balls": 1, "race_radius": race, "mass": "1e-12 kg", "drag": f"{drag!r} N m s"}
            seen = self.simulate(self.at_speed({"balancer": light, "rotor.gravity": None}), "-bare",
                                 begin + turn * np.arange(0, 4, 1 / 128))
            self._bare = fixed(seen)
        return self._bare


def fixed(seen):
    c, s = np.cos(seen["psi"]), np.sin(seen["psi"])
    return seen["x"] * c - seen["y"] * s, seen["x"] * s + seen["y"] * c


def amplitude(values):
    return 0.5 * (values.max() - values.min())


def bare_vibration(e):
    """`without balls`: amplitude at the final speed."""
    if not e.said["without_balls"]:
        return
    seen = [amplitude(axis) for axis in e.bare()]
    told = [axis["dimensionless"] for axis in e.said["without_balls"]["displacement"]]
    # 128 samples per turn miss a peak by 3e-4; e^-14 of the start is left.
    yield "without balls", all(abs(a - b) <= 1e-3 * b for a, b in zip(seen, told)), f"{told} told, {seen} seen"


def static_sag(e):
    if e.gravity == 0.0 or not e.speed:
        return
    turn = 2.0 * math.pi / abs(e.speed)
    held = e.at_speed({"release": {"time": "1e6 s"}})
    whole = 14.0 * e.decay + turn * np.arange(0, 4, 1 / 128)
    seen = -np.mean(fixed(e.simulate(held, "-held", whole))[1])
    told = e.said["static_sag"]["dimensionless"]
    yield "static sag", abs(seen - told) <= 1e-3 * told, f"{told:.6g} told, {seen:.6g} seen"
    yield "warning of a large sag", told <= 1.0 or any("sags" in w for w in e.warnings), f"sag of {told:.3g} race radii"


def held_resonance(e):
    """`largest vibration, of held balls`: at that speed, not at others near it."""
    rule = next(rule for rule in e.said["advice"] if rule["id"] == "critical_speed")
    for figure in rule["figures"]:
        if not figure["name"].startswith("largest vibration") or e.support_damping > 0.3:
            continue
        axis = 1 if ", y" in figure["name"] else 0
        peaks = []
        for factor in (0.97, 1.0, 1.03):
            rpm = figure["si"] * factor * 30.0 / math.pi
            held = e.at_speed({"speed": {"profile": "constant", "speed": f"{rpm!r} rpm"}, "release": {"time": "1e6 s"},
                               "rotor.gravity": None})
            turn = 2.0 * math.pi / (figure["dimensionless"] * factor)
            angles = [f"initial.phi={list(np.arange(e.balls) * 0.5)}"] if e.balls > 1 else []
            seen = e.simulate(held, "-peak", 14.0 * e.decay + turn * np.arange(0, 4, 1 / 128), angles)
            peaks.append(amplitude(fixed(seen)[axis]))
        yield figure["name"], peaks[1] > max(peaks[0], peaks[2]), f"amplitudes {peaks} at 0.97, 1 and 1.03 of it"


def below_resonance(e):
    told = any("below the critical speed" in w for w in e.warnings)
    if e.speed is None or abs(e.speed) >= e.critical:
        yield "not below the critical speed", not told, "speed above it"
        return
    yield "below the critical speed", told, "speed below it"
    if e.gravity > 0.0:
        return
    end = 10.0 * e.decay + 60.0 / max(1e-3, min(drags(e)))
    seen = e.simulate(e.at_speed({}), "-below", end + np.arange(0, 50, 0.25), [spread(e)])
    bare = max(amplitude(axis) for axis in e.bare())
    yield "balls add to the unbalance below resonance", seen["radial"].min() > bare, \
        f"r {seen['radial'].min():.4g}, {bare:.4g} without balls"


def drags(e):
    return [row["dimensionless"] for row in e.said["quantities"] if row["symbol"].startswith("beta")]


def spread(e):
    """Balls all around the race, nowhere by symmetry."""
    return "initial.phi=" + str([round(0.3 + 2.0 * math.pi * k / e.balls + 0.1 * k / e.balls, 6) for k in range(e.balls)])


def deviation(seen, balls):
    """Of the rotor from its axis and of the balls from rest: what falls on the approach to balance, wherever in a continuum."""
    square = seen["radial"] ** 2 + seen["x_dot"] ** 2 + seen["y_dot"] ** 2
    for k in range(1, balls + 1):
        square = square + seen[f"phi_dot_{k}"] ** 2
    return np.sqrt(square)


def beside(motion):
    """Ball angles a thousandth of a radian from balance, each another way."""
    return [a + 1e-3 * math.cos(1.0 + 2.3 * k) for k, a in enumerate(motion["angles"])]


def stability(e):
    """`approach to balance`: stable or not, at the rate told, seen from a thousandth of a radian away."""
    motion = e.said["balanced"]
    told_unstable = any(w.startswith("balance is unstable") for w in e.warnings)
    if not motion:
        return
    rate = motion["eigenvalues"][0][0]
    yield "warning of instability", told_unstable == (not motion["stable"] and rate > 1e-9), f"rate {rate:.3g}"
    if motion["left_out"]:
        return
    longest = 4000.0
    if abs(rate) * longest < 3.0 or overlapping(e, motion["angles"]):
        return  # too slow to be distinguished from rest in reasonable time; or such balls cannot be placed there
    angles = beside(motion)
    span = min(longest, (5.0 if rate > 0.0 else 9.0) / abs(rate))
    times = np.arange(0.0, span, min(0.5, span / 400))
    seen = e.simulate(e.at_speed({}), "-near", times, [f"initial.phi={angles}"])
    d = deviation(seen, e.balls)
    if motion["displacement_left"] and e.gravity > 0.0:
        left = motion["displacement_left"]["dimensionless"]
        moved = max(np.abs(seen[f"phi_{k + 1}"] - a).max() for k, a in enumerate(angles))
        r = seen["radial"][-len(d) // 4:].max()
        # Samples may miss the largest displacement of a turn; e^-6 of the start's deviation is left.
        yield "what is left in balance", not motion["stable"] or 0.5 * left < r < 1.1 * left + 1e-5, \
            f"{left:.3g} told, {r:.3g} seen; balls moved by {moved:.3g}"
        return
    first, last = d[: len(d) // 4].max(), d[-len(d) // 4:].max()
    if rate > 0.0:
        # The slowest pair has only a part of the deviation: growth of e^3.7 between the quarters shows as 3.
        yield "balance is unstable", last > 3.0 * first, f"deviation {first:.3g}, then {last:.3g}; rate {rate:.3g}"
    else:
        yield "balance is stable", last < 0.1 * first, f"deviation {first:.3g}, then {last:.3g}; rate {rate:.3g}"


def overlapping(e, angles):
    width = widths(e)
    if not width:
        return False
    return any(abs(math.remainder(a - b, 2.0 * math.pi)) < width + 0.01 for a, b in itertools.combinations(angles, 2))


def widths(e):
    """The angle that a ball takes up, seen from the race's centre; 0 without a size."""
    balancer = e.machine.tables["balancer"]
    if "ball_diameter" not in balancer:
        return 0.0
    diameter, race = (float(balancer[key].split()[0]) for key in ("ball_diameter", "race_radius"))
    return 2.0 * math.asin(0.5 * diameter / race)


def more_or_less_drag(e):
    """Whether more drag settles the balls sooner: seen at 0.8 and 1.25 times the drag."""
    motion = e.said["balanced"]
    told = [w for w in e.warnings if "drag would settle" in w]
    if not motion or not motion["stable"] or e.gravity > 0.0 or not told or overlapping(e, motion["angles"]):
        return
    rate = abs(motion["eigenvalues"][0][0])
    if rate < 1e-3:
        return
    angles = beside(motion)
    times = np.linspace(2.0 / rate, 8.0 / rate, 600)
    seen = []
    drag, unit = e.machine.tables["balancer"]["drag"].split(" ", 1)
    for factor in (0.8, 1.25):
        changed = e.at_speed({"balancer.drag": f"{float(drag) * factor!r} {unit}"})
        d = deviation(e.simulate(changed, "-drag", times, [f"initial.phi={angles}"]), e.balls)
        seen.append(math.log(d[:200].max() / d[-200:].max()) / (times[-200] - times[0]))
    yield told[0], ("less drag" in told[0]) == (seen[0] > seen[1]), f"falls at {seen} with 0.8 and 1.25 of the drag"


def capacity(e):
    """`can balance` and what the balls cancel: against every order of balls side by side."""
    masses = [row["dimensionless"] for row in e.said["quantities"] if row["symbol"] in ("m, mu",) or
              re.match(r"m, mu_\d", row["symbol"])]
    masses = masses * e.balls if len(masses) == 1 else masses
    width, unbalance = widths(e), e.said["unbalance"]["dimensionless"]
    if width * e.balls > 2.0 * math.pi:
        return
    at = np.exp(1j * width * np.arange(e.balls))
    # Balls side by side cancel most only while they fill less than half of the race.
    if width * e.balls > math.pi:
        return
    most = max(abs(np.dot(order, at)) for order in set(itertools.permutations(masses)))
    told = e.said["largest_unbalance"]["dimensionless"]
    yield "most that the balls cancel", abs(told - most) <= 1e-9 * most, f"{told:.6g} told, {most:.6g} by hand"
    least = max(0.0, 2.0 * max(masses) - sum(masses))
    can = least <= unbalance <= most
    yield "can balance", can == e.said["can_balance"], f"unbalance {unbalance:.6g}, from {least:.6g} to {most:.6g}"


def run_up(e):
    """How long a motor takes to 95 % of the final speed, and whether the rotor's own unbalance stalls it: with two balls
    held opposite each other, which add nothing to it."""
    told = e.said["run_up"]
    if not told or e.balls != 2 or not told["without_losses"] or lasting_loss(e) > 0.05:
        return
    alone = told["without_losses"]["dimensionless"]
    shaken = told["with_own_unbalance"]["dimensionless"] if told["with_own_unbalance"] else None
    to = told["speed"]["dimensionless"]
    end = min(4.0 * (shaken or alone), 40000.0)
    times = np.linspace(0.0, end, 4000)
    held = e.machine.changed({"release": {"time": "1e9 s"}, "rotor.gravity": None})
    speed = e.simulate(held, "-run-up", times, [f"initial.phi={[0.3, 0.3 + math.pi]}"])["psi_dot"]
    there = np.argmax(speed >= to) if (speed >= to).any() else None
    reached = f"{to:.4g} reached at {times[there]:.5g}" if there is not None else f"only {speed.max():.4g} of {to:.4g} reached"
    if shaken is None:
        yield "the rotor stalls", there is None, reached
    elif shaken < end:
        # Losses are those of steady running at each speed: a quick passage absorbs less, and vibration rings on after
        # it.
        yield "run-up time", there is not None and 0.98 * alone <= times[there] <= 1.15 * shaken, \
            f"{reached}; told {alone:.5g} without losses, {shaken:.5g} with the unbalance's"


def lasting_loss(e):
    """What the rotor's own unbalance goes on to take at 95 % of the final speed, which balls that balance spare the motor,
    over what it gives there: a motor whose torque falls to nothing gives a twentieth of its stall torque."""
    speed, zeta = 0.95 * e.speed, e.support_damping
    mass = 1.0 + e.quantity["mass of all balls"]["dimensionless"]
    taken = zeta * (e.said["unbalance"]["dimensionless"] * speed**2) ** 2 * speed
    return taken / ((1.0 - mass * speed**2) ** 2 + (zeta * speed) ** 2) / \
        (0.05 * e.quantity["motor torque at rest"]["dimensionless"])


def late(e, start, begin, length, aside=0.0):
    """The run of a start, or of one `aside` of it in its balls' angles, seen for `length` from `begin` on."""
    # As many times as a command line takes, not at whole parts of a turn.
    count = int(min(2000, length / min(0.5, 2.0 * math.pi / abs(e.speed or 3.0) / 12.0)))
    angles = [float(a) + aside for a in np.atleast_1d(start.phi.values)]
    return e.simulate(e.machine, "", begin + length / count * np.arange(count), [f"initial.phi={angles}"])


def fates(e):
    """What `basin` says of an ensemble against each start's own trajectory: what balances, what does not, what passes the
    resonance."""
    path = os.path.join(e.folder, f"machine-{e.machine.number}.nc")
    if os.path.exists(path):
        os.remove(path)
    answer = json.loads(e.run("basin", e.path, "--starts", str(e.starts), "--json", "--quiet", "-o", path))
    balanced = next((o for o in answer["outcomes"] if o["name"].startswith("balanced")), {"count": 0})
    note = answer.get("note", "")
    yield "what cannot balance does not", e.said["can_balance"] or balanced["count"] == 0, f"{balanced['count']} starts balanced"
    motion = e.said["balanced"]
    if motion and not motion["stable"] and motion["eigenvalues"][0][0] > 1e-6 and e.gravity == 0.0 and widths(e) == 0.0:
        yield "what is unstable is not balanced", balanced["count"] == 0, f"{balanced['count']} starts balanced"
    bare = max(amplitude(axis) for axis in e.bare()) if e.speed else e.said["unbalance"]["dimensionless"]
    passed = quiet = undecided = 0
    slow = 8.0 / abs(motion["eigenvalues"][0][0]) if motion and motion["stable"] else 0.0
    with xarray.open_dataset(path) as file:
        for i in range(e.starts):
            start = file.isel(start=i)
            outcome, decided = int(start.outcome), float(start.decision_time)
            begin = min(decided, 20000.0) + max(LATER, min(slow, 2000.0))
            seen = late(e, start, begin, 60.0)
            r = seen["radial"].max()
            passed += np.mean(seen["psi_dot"]) > answer.get("passed", {"above": 0.0})["above"]
            if outcome > 0 and (r < 0.5 * bare) != (outcome == 1):
                # With chaos on the way, rounding may change the fate. Then starts a hair aside differ too, and nothing
                # is learnt about the sentence.
                aside = [late(e, start, begin, 60.0, d)["radial"].max() < 0.5 * bare for d in (-1e-8, 1e-8, 1e-7, 1e-6)]
                if len(set(aside)) > 1 or aside[0] != (r < 0.5 * bare):
                    continue
            name = f"start {i}: {outcome}"
            # Balanced motions under gravity or in an off-centre race vibrate a little: less than half as much as
            # without balls. Anything still on its way is followed further.
            if outcome == 1:
                yield f"{name}, balanced", r < 0.5 * bare, f"r reaches {r:.3g}, {bare:.3g} without balls"
            elif outcome == 0:  # chaos on the way may last longer here than there: judged together
                undecided += 1
                quiet += r < 0.02 * bare
            elif outcome == -3 or outcome > 1:
                yield f"{name}, not balanced", r > 0.02 * bare, f"r only reaches {r:.3g}, {bare:.3g} without balls; {note}"
    if "passed" in answer:
        told = answer["passed"]["count"]
        yield "came through the resonance", told <= passed <= told + undecided, \
            f"{told} told, {undecided} undecided, {passed} of {e.starts} seen"
    if undecided > 1:
        yield "undecided starts do not all balance", quiet < undecided, f"{quiet} of {undecided} are quiet; {note}"
    if not answer["balanced_stable"]:
        yield "note that none can balance", balanced["count"] == 0, note


LATER = 100.0  # time units after the decision within which it must show

CHECKS = [bare_vibration, static_sag, held_resonance, below_resonance, stability, more_or_less_drag, capacity, run_up,
          fates]
