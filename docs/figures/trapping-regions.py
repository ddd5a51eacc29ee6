"""trapping-regions.svg: level set, torus and orbit of the paper's rotor at 2.4, and trajectories that end in them.

The plane is that of the unbalance |U| and the mean rate of the balls. The green patch is the shadow of the level set that `equipoise
certify` proves, with U linearised in the ball angles; the cloud is V2, the curve V1, its tube drawn by hand.
"""

import cmath
import json
import math

from drawn_page import COLOURS, DARK, INK, PALE, QUIET, RULE, STUDY, Page, fate, program, simulate

W, H = 860, 500
LEFT, RIGHT, TOP, BOTTOM = 74, 836, 30, 442
U0, U1, Q0, Q1 = 0.0, 0.116, -1.9, 0.45
ECCENTRICITY, MASS = 0.01, 0.05
STARTS = {"balanced": 0, "drifting apart (V2)": 2, "co-drifting (V1)": 7}


def at(u, q):
    return LEFT + (u - U0) / (U1 - U0) * (RIGHT - LEFT), BOTTOM - (q - Q0) / (Q1 - Q0) * (BOTTOM - TOP)


def of(row):
    u = abs(ECCENTRICITY + MASS * (cmath.exp(1j * row["phi_1"]) + cmath.exp(1j * row["phi_2"])))
    return at(u, 0.5 * (row["phi_dot_1"] + row["phi_dot_2"]))


def path(one, until, every):
    return simulate(f"{until:.6f}", every, f"initial.phi={one['phi']}")


def inverse(a):
    n = len(a)
    m = [row[:] + [float(i == j) for j in range(n)] for i, row in enumerate(a)]
    for i in range(n):
        m[i] = [v / m[i][i] for v in m[i]]
        for k in range(n):
            if k != i:
                m[k] = [v - m[k][i] * w for v, w in zip(m[k], m[i])]
    return [row[n:] for row in m]


def shadow(state):
    """Greatest mean rate in the level set at each |U|: of all ellipses in (U along a direction, mean rate)."""
    spread = inverse(state["form"])
    turned = [1j * MASS * cmath.exp(1j * phi) for phi in state["phi"]]
    rate = [0.0] * 6 + [0.5, 0.5]
    best = {}
    for k in range(180):
        along = [0.0] * 4 + [(z * cmath.exp(-1j * k * math.pi / 180)).real for z in turned] + [0.0, 0.0]

        def product(a, b):
            return state["level"] * sum(a[i] * spread[i][j] * b[j] for i in range(8) for j in range(8))

        a, b, c = product(along, along), product(along, rate), product(rate, rate)
        for step in range(200):
            u = 0.0005 * step
            if u * u < a:
                half = math.sqrt((c - b * b / a) * (1 - u * u / a))
                best[u] = max(best.get(u, 0.0), abs(b / a * u) + half)
    edge = sorted(best.items())
    return edge + [(u, -q) for u, q in reversed(edge)]


page = Page(W, H, "Trapping regions around the attractors of the paper's rotor at 2.4")
page.box(LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP, fill="#ffffff", stroke=RULE)
for q in (-1.5, -1.0, -0.5, 0.0):
    page.line([at(U0, q), at(U1, q)], PALE, 1)
    page.text(LEFT - 8, at(0, q)[1] + 5, f"{q:g}".replace("-", "−"), 13, QUIET, "end")
for u in (0.0, 0.02, 0.04, 0.06, 0.08, 0.1):
    page.text(at(u, 0)[0], BOTTOM + 20, f"{u:g}", 13, QUIET, "middle")
page.text((LEFT + RIGHT) / 2, BOTTOM + 44, "unbalance |U| of rotor and balls", 14, INK, "middle")
page.text(22, (TOP + BOTTOM) / 2, "mean rate of the balls in the rotating frame", 14, INK, "middle", turned=True)

fates = {name: fate(start, "--decide", "proof") for name, start in STARTS.items()}
page.cloud([of(row) for row in path(fates["drifting apart (V2)"], 2200, 0.7)[700:]], "#f6c9a9", 3.6)
orbit = [of(row) for row in path(fates["co-drifting (V1)"], 404, 0.1)[-41:]]
page.line(orbit, COLOURS["co-drifting (V1)"], 26, opacity=0.22, closed=True)
page.line(orbit, DARK["co-drifting (V1)"], 2.2, closed=True)
proof = json.loads(program("certify", STUDY, "--json"))["states"][0]
edge = shadow(proof)
page.line([at(*p) for p in edge], DARK["balanced"], 1.5, fill="#bfe6d9", closed=True)
ways = {}
for name, one in fates.items():
    assert one["outcome"] == name.split(" (")[0], one
    ways[name] = path(one, one["time"], 0.1)
    points = [of(row) for row in ways[name]]
    page.line(points, COLOURS[name], 1.3)
    page.dot(*points[0], 4.5, "#ffffff", INK)
    page.dot(*points[-1], 5.5, DARK[name], "#ffffff")

# The level set, magnified.
LX, LY, WIDE, HIGH = 96, 338, 262, 92
page.box(LX, LY, WIDE, HIGH, fill="#ffffff", stroke=QUIET)


def magnified(point):
    (x, y), (x0, y0) = point, at(0, 0)
    return LX + 4.6 * (x - x0), LY + HIGH / 2 + 7 * (y - y0)


page.line([magnified(at(*p)) for p in edge], DARK["balanced"], 1.5, fill="#bfe6d9", closed=True)
last = [magnified(of(row)) for row in ways["balanced"]]
inside = [LX < x < LX + WIDE and LY < y < LY + HIGH for x, y in last]
page.line(last[len(last) - inside[::-1].index(False):], COLOURS["balanced"], 1.3)
page.dot(*last[-1], 5.5, DARK["balanced"], "#ffffff")
page.line([at(0.0035, -0.02), (LX + 60, LY)], QUIET, 1, dash="4 3")
page.text(LX + WIDE + 8, LY + HIGH - 6, "magnified", 13, QUIET)

page.text(*at(0.008, 0.09), "level set around balance", 15, DARK["balanced"], bold=True)
page.text(*at(0.094, -0.98), "torus V2", 15, DARK["drifting apart (V2)"], bold=True)
page.text(*at(0.113, -1.77), "tube around the orbit V1", 15, DARK["co-drifting (V1)"], "end", bold=True)
page.dot(*at(0.0755, 0.33), 4.5, "#ffffff", INK)
page.text(at(0.0755, 0)[0] + 12, at(0, 0.33)[1] + 5, "a start", 14)
page.dot(*at(0.09, 0.33), 5.5, QUIET, "#ffffff")
page.text(at(0.09, 0)[0] + 12, at(0, 0.33)[1] + 5, "its outcome is known", 14)
page.write(__file__)
