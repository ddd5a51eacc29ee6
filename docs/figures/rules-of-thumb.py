"""How often the rules of thumb of `explain` are right, over drawn rotors: prints the shares that docs/explanation/rules-of-thumb.md states.

Writes rules-of-thumb.png in this folder. From the repository's root:

    ./dev python docs/figures/rules-of-thumb.py [ROTORS [CAPTURES [MOTORS]]]
"""

import sys
from pathlib import Path

import numpy as np

import equipoise as eq

HERE = Path(__file__).parent
ROTORS, CAPTURES, MOTORS = ([int(a) for a in sys.argv[1:]] + [3000, 14, 200][len(sys.argv) - 1:])


def log_uniform(draw, low, high):
    return float(np.exp(draw.uniform(np.log(low), np.log(high))))


def rotor(draw, **speed):
    """One of all that a designer may have in mind: the ranges stand in docs/explanation/rules-of-thumb.md."""
    balls = int(draw.integers(2, 6))
    unbalance = log_uniform(draw, 1e-3, 0.1)
    return dict(
        rotor=dict(eccentricity=unbalance, damping=log_uniform(draw, 0.02, 2.0)),
        balancer=dict(balls=balls, mass=unbalance / draw.uniform(0.15, 0.95) / balls, drag=log_uniform(draw, 0.003, 3.0),
                      rolls=bool(draw.integers(2))),
        speed=speed or dict(profile="constant", speed=draw.uniform(1.2, 6.0)),
    )


def rules(study):
    return {name: (r["kept"], {f["name"]: f["dimensionless"] for f in r["figures"]}) for name, r in eq.explain(study).advice.items()}


def share(name, right, of):
    right, of = int(np.sum(right)), int(np.size(of))
    p = right / max(of, 1)
    print(f"{name}: {100 * p:.1f} % of {of} (standard error {100 * np.sqrt(p * (1 - p) / max(of, 1)):.1f})")


def near_balance(count):
    """Settling time, drag and running speed against the linearised equations."""
    draw = np.random.default_rng(1)
    rows = []
    for _ in range(count):
        tables = rotor(draw)
        said = rules(eq.Study(**tables))
        settling, drag = said["settling"][1], said["drag"][1]
        rows.append(dict(
            speed=tables["speed"]["speed"], balls=tables["balancer"]["balls"], damping=tables["rotor"]["damping"],
            drag=tables["balancer"]["drag"], above=said["critical_speed"][0], stable="by linear theory" in settling,
            rule=settling.get("by the rule", np.nan), exact=settling.get("by linear theory", np.nan),
            drag_from=drag["from"], drag_to=drag["to"], exact_from=drag.get("from, by linear theory", np.nan),
            exact_best=drag.get("fastest, by linear theory", np.nan), exact_to=drag.get("to, by linear theory", np.nan)))
    table = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    stable, above = table["stable"].astype(bool), table["above"].astype(bool)
    share("balance stable", stable, stable)
    share("stable of those above sqrt(2) critical speeds", stable[above], stable[above])
    share("stable of those below", stable[~above], stable[~above])
    ratio = table["rule"][stable] / table["exact"][stable]
    for factor in (1.25, 1.5, 2.0):
        share(f"settling time within a factor of {factor}", (ratio < factor) & (ratio > 1 / factor), ratio)
    best = np.sqrt(table["drag_from"] * table["drag_to"])  # beta_s, of beta_s/2 and 2 beta_s
    there = np.isfinite(table["exact_best"])
    share("some drag makes balance stable", there, there)
    inside = (best >= table["exact_from"]) & (best <= table["exact_to"])
    share("beta_s settles at a quarter of the fastest rate or more", inside[there], inside[there])
    for end in ("drag_from", "drag_to"):
        held = (table[end] >= table["exact_from"]) & (table[end] <= table["exact_to"])
        share(f"so does {end}", held[there], held[there])
    return table, stable


def captures(count):
    """Whether any motion with all balls left behind exists, by drag over the rule's."""
    draw = np.random.default_rng(2)
    found = []
    while len(found) < count:
        tables = rotor(draw, profile="constant", speed=draw.uniform(1.5, 5.0))
        against = rules(eq.Study(**tables))["drag"][1]["below it balls may lag at the critical speed"]
        factor = log_uniform(draw, 0.1, 10.0)
        tables["balancer"]["drag"] = factor * against
        if not 1e-3 < factor * against < 3.0:
            continue
        listed = eq.attractors(eq.Study(**tables), starts=200)
        behind = any(max(a["drift"]) < -0.1 for a in listed.data["attractors"])
        found.append((factor, behind))
    factor, behind = np.array(found).T
    behind = behind.astype(bool)
    share("all balls may lag, below the rule's drag", behind[factor < 1], behind[factor < 1])
    share("none of these motions above it", ~behind[factor > 1], behind[factor > 1])
    share("none of them above twice it", ~behind[factor > 2], behind[factor > 2])
    return factor, behind


def motors(count):
    """Whether a motor of given torque at the critical speed comes through, from rest, its balls free."""
    draw = np.random.default_rng(3)
    passed = {True: [], False: [], None: []}
    while sum(map(len, passed.values())) < count:
        tables = rotor(draw)
        no_load = draw.uniform(2.0, 4.0)
        tables["rotor"].update(inertia=log_uniform(draw, 0.1, 10.0), damping=log_uniform(draw, 0.02, 0.5))
        tables["speed"] = dict(profile="torque", torque=dict(stall=1.0, no_load_speed=no_load))
        need = rules(eq.Study(**tables))["torque"][1]["taken at resonance with all balls on the heavy side"]
        stall = log_uniform(draw, 0.05, 5.0) * need / (1.0 - 1.0 / no_load)
        tables["speed"]["torque"]["stall"] = stall
        tables["initial"] = dict(phi=list(draw.uniform(0.0, 2 * np.pi, tables["balancer"]["balls"])))
        study = eq.Study(**tables)
        end = 500.0 + 10.0 * tables["rotor"]["inertia"] * no_load / stall
        if end > 1e5:  # weaker than any that is asked to speed this rotor up
            continue
        run = eq.simulate(study, [0.0, 0.95 * end, end])
        passed[rules(study)["torque"][0]].append(run.psi_dot[-2:].min() > 1.2)
    share("came through, of motors that keep the rule", passed[True], passed[True])
    share("came through, of motors below what the rotor's own unbalance takes", passed[False], passed[False])
    share("came through, of motors between the two", passed[None], passed[None])


def draw_picture(table, stable):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.6))
    left.loglog(table["exact"][stable], table["rule"][stable], ".", ms=3, alpha=0.5)
    ends = [4.0, 3e4]
    left.loglog(ends, ends, "k-", lw=1)
    for factor in (0.5, 2.0):
        left.loglog(ends, [factor * e for e in ends], "k:", lw=1)
    left.set(xlabel="settling time by linear theory, 1/ω_c", ylabel="by the rule of thumb", xlim=ends, ylim=ends)
    beta_s = np.sqrt(table["drag_from"] * table["drag_to"])
    for key, colour, words in (("exact_from", "C0", "least"), ("exact_best", "C2", "fastest"), ("exact_to", "C1", "most")):
        ratio = np.sort((table[key] / beta_s)[np.isfinite(table[key])])
        right.semilogx(ratio, np.arange(1, len(ratio) + 1) / len(ratio), color=colour, label=f"{words} drag")
    for at in (0.5, 1.0, 2.0):
        right.axvline(at, color="k", ls=":" if at != 1.0 else "-", lw=1)
    right.set(xlabel="drag by linear theory over the rule's β_s (dotted: its range)", ylabel="share of drawn rotors", xlim=(1e-3, 1e2), ylim=(0, 1))
    right.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, frameon=False, columnspacing=1.0)
    figure.tight_layout()
    figure.savefig(HERE / "rules-of-thumb.png", dpi=110)


table, stable = near_balance(ROTORS)
draw_picture(table, stable)
if CAPTURES:
    captures(CAPTURES)
if MOTORS:
    motors(MOTORS)
