"""Machines as a data sheet states them, drawn by number: what the checks of sentences are tried on."""

import copy
import math
import random

G = 9.81


class Machine:
    """A study in physical units, as tables of TOML; text() writes it."""

    def __init__(self, number, kind, tables):
        self.number, self.kind, self.tables = number, kind, tables

    def changed(self, changes):
        """The same with other keys: {"speed": {...}} replaces a table, {"rotor.mass": ...} a key, None removes it."""
        tables = copy.deepcopy(self.tables)
        for key, value in changes.items():
            table, _, name = key.partition(".")
            if not name:
                if value is None:
                    tables.pop(table, None)
                else:
                    tables[table] = value
            elif value is None:
                tables.get(table, {}).pop(name, None)
            else:
                tables.setdefault(table, {})[name] = value
        return Machine(self.number, self.kind, tables)

    def text(self):
        lines = []
        for table, keys in self.tables.items():
            lines.append(f"[{table}]")
            lines += [f"{key} = {toml(value)}" for key, value in keys.items()]
        return "\n".join(lines) + "\n"


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    return repr(value)


def rounded(value, digits=3):
    """Three digits: a machine that failed is read, and typed, by people."""
    return float(f"{value:.{digits}g}")


class Dice:
    def __init__(self, seed, number):
        self.bits = random.Random(seed * 1000003 + number)

    def even(self, low, high):
        return low + (high - low) * self.bits.random()

    def scale(self, low, high):
        return math.exp(self.even(math.log(low), math.log(high)))

    def whole(self, low, high):
        return self.bits.randint(low, high)

    def chance(self, p):
        return self.bits.random() < p


def ordinary(d, balls=None, speed=(1.6, 5.0), part=(1.1, 3.0), drag=(0.01, 0.3)):
    """A rotor whose balls weigh `part` times what they have to cancel, at `speed` critical speeds, with a relative drag
    (beta) within `drag`. Returns the tables and (mass, critical speed in rad/s)."""
    mass = d.scale(0.1, 40.0)
    hertz = d.scale(4.0, 60.0)
    critical = 2.0 * math.pi * hertz
    race = 0.06 * mass ** (1.0 / 3.0) * d.scale(0.6, 1.6)
    balls = balls or d.whole(2, 4)
    unbalance = mass * race * d.scale(0.002, 0.03)
    ball = unbalance / race * d.even(*part) / balls
    diameter = min((ball / 7800.0 * 6.0 / math.pi) ** (1.0 / 3.0), 0.9 * race * 2.0 * math.sin(math.pi / max(balls, 2)))
    ball = 7800.0 * math.pi / 6.0 * rounded(diameter * 1e3) ** 3 * 1e-9
    tables = {
        "rotor": {
            "mass": f"{rounded(mass)} kg",
            "stiffness": f"{rounded(mass * critical**2)} N/m",
            "damping_ratio": rounded(d.scale(0.02, 0.4)),
            "unbalance": f"{rounded(unbalance * 1e6)} g mm",
        },
        "balancer": {
            "balls": balls,
            "ball_diameter": f"{rounded(diameter * 1e3)} mm",
            "ball_density": "7800 kg/m3",
            "race_radius": f"{rounded(race * 1e3)} mm",
            "drag": f"{rounded(d.scale(*drag) * ball * race**2 * critical)} N m s",
        },
        "speed": {"profile": "constant", "speed": f"{rounded(d.even(*speed) * hertz * 60.0)} rpm"},
    }
    return tables, mass, critical, race


def constant(d):
    return ordinary(d)[0]


def slow(d):
    return ordinary(d, speed=(0.3, 0.85))[0]


def ramp(d):
    tables, _, critical, _ = ordinary(d)
    final = tables["speed"]["speed"]
    tables["speed"] = {"profile": "ramp", "initial": "0 rpm", "final": final,
                       "duration": f"{rounded(d.scale(20.0, 400.0) / critical)} s"}
    tables["release"] = {"time": "0 s"}
    return tables


def hardly_above(d):
    """Just above the critical speed, with little drag: balance is often unstable there."""
    return ordinary(d, balls=2, speed=(1.1, 1.8), drag=(0.003, 0.05))[0]


def thick_oil(d):
    return ordinary(d, balls=2, drag=(1.0, 6.0))[0]


def gravity(d):
    """A horizontal shaft whose balls weigh up to a tenth of their centrifugal force."""
    tables, _, critical, race = ordinary(d, balls=d.whole(1, 3))
    speed = float(tables["speed"]["speed"].split()[0]) * math.pi / 30.0
    tables["rotor"]["gravity"] = f"{rounded(min(G, d.scale(0.002, 0.1) * speed**2 * race))} m/s2"
    return tables


def soft_and_heavy(d):
    """Gravity as on earth on springs so soft that the rotor hangs far below where they are slack."""
    tables, mass, _, _ = ordinary(d, balls=2)
    hertz = d.scale(0.3, 1.5)
    tables["rotor"]["stiffness"] = f"{rounded(mass * (2.0 * math.pi * hertz) ** 2)} N/m"
    tables["rotor"]["gravity"] = f"{G} m/s2"
    tables["speed"]["speed"] = f"{rounded(d.even(1500.0, 4000.0))} rpm"
    return tables


def too_much(d):
    return ordinary(d, part=(0.4, 0.98))[0]


def touching(d):
    """Large balls that all lie side by side, near the most that they can cancel, and collide."""
    tables, mass, critical, race = ordinary(d, balls=d.whole(3, 6))
    diameter = rounded(race * d.even(0.2, 0.5), 2)
    tables["balancer"]["ball_diameter"] = f"{rounded(diameter * 1e3)} mm"
    ball = 7800.0 * math.pi / 6.0 * diameter**3
    tables["balancer"]["drag"] = f"{rounded(d.scale(0.05, 0.5) * ball * race**2 * critical)} N m s"
    heavier = max(1.0, 20.0 * ball / mass)
    tables["rotor"]["mass"] = f"{rounded(mass * heavier)} kg"
    tables["rotor"]["stiffness"] = f"{rounded(mass * heavier * critical**2)} N/m"
    half = math.asin(0.5 * diameter / race)
    most = ball * math.sin(tables["balancer"]["balls"] * half) / math.sin(half)
    tables["rotor"]["unbalance"] = f"{rounded(abs(most) * race * d.even(0.7, 1.15) * 1e6)} g mm"
    tables["balancer"]["contact"] = True
    return tables


def unequal_balls(d):
    tables, mass, _, race = ordinary(d, balls=2)
    del tables["balancer"]["ball_diameter"], tables["balancer"]["ball_density"]
    unbalance = float(tables["rotor"]["unbalance"].split()[0]) * 1e-6
    heavy = unbalance / race * d.even(0.6, 1.6)
    tables["balancer"]["mass"] = [f"{rounded(heavy * 1e3)} g", f"{rounded(heavy * d.even(0.4, 0.9) * 1e3)} g"]
    return tables


def one_ball(d):
    return ordinary(d, balls=1, part=(0.8, 1.3))[0]


def unequal_supports(d):
    tables, mass, critical, _ = ordinary(d, balls=2, speed=(1.8, 4.0))
    part = d.even(0.02, 0.2)
    stiffness = mass * critical**2
    tables["rotor"]["stiffness"] = [f"{rounded(stiffness * (1 - part))} N/m", f"{rounded(stiffness * (1 + part))} N/m"]
    return tables


def motor(d, strength):
    """A motor whose torque falls to nothing at 2 to 4 critical speeds; `strength`: of what shaking takes at resonance."""
    tables, mass, critical, race = ordinary(d, balls=2)
    unbalance = float(tables["rotor"]["unbalance"].split()[0]) * 1e-6 / (mass * race)
    zeta = 2.0 * tables["rotor"]["damping_ratio"]
    unit = mass * race**2 * critical**2
    no_load = d.even(2.0, 4.0)
    taken = (2.0 * unbalance) ** 2 / zeta
    inertia = d.scale(0.3, 2.0)
    # Strong enough for a run-up within some hundred units of time, whatever vibration takes.
    stall = max(strength * taken / (1.0 - 1.0 / no_load), inertia * no_load / d.scale(30.0, 300.0))
    tables["rotor"]["inertia"] = f"{rounded(inertia * mass * race**2, 4)} kg m2"
    tables["speed"] = {
        "profile": "torque",
        "torque": {"stall": f"{rounded(stall * unit)} N m",
                   "no_load_speed": f"{rounded(no_load * critical * 30.0 / math.pi)} rpm"},
        "initial": "0 rpm",
    }
    return tables


def strong_motor(d):
    return motor(d, d.even(3.0, 10.0))


def weak_motor(d):
    """Too weak to hold a speed at resonance: it hangs there, or passes by its momentum."""
    tables, mass, critical, race = ordinary(d, balls=2)
    tables = motor(d, 1.0)
    stall = float(tables["speed"]["torque"]["stall"].split()[0])
    tables["speed"]["torque"]["stall"] = f"{rounded(stall * d.scale(0.02, 0.5))} N m"
    return tables


KINDS = [constant, ramp, hardly_above, gravity, strong_motor, touching, slow, thick_oil, unequal_balls, too_much, weak_motor,
         one_ball, unequal_supports, soft_and_heavy, constant]


def draw(seed, number):
    """Machine `number` of `seed`; any len(KINDS) successive ones hold each kind."""
    kind = KINDS[number % len(KINDS)]
    return Machine(number, kind.__name__.replace("_", " "), kind(Dice(seed, number)))
