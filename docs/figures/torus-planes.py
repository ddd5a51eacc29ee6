"""torus-planes.svg: the torus V2 of the paper's rotor at 2.4, planes that touch it, and a state beside it.

Left a real trajectory: around, the mean angle of the balls; in the section, r and the angle between them less half a turn. As in the
program a plane is spanned by the flow and the direction to a neighbour on another winding. Right a cell, drawn by hand.
"""

import math

from drawn_page import DARK, INK, QUIET, Page, simulate

W, H = 860, 430
STEP, SETTLED = 0.1, 800.0
ACROSS, UP, TILT = 5.2, 0.19, math.radians(36)
BLUE, PALE_BLUE = "#00507d", "#8cc3e3"
PLANES = 14

rows = [row for row in simulate(2500, STEP, "initial.phi=[5.656553517113243,0.3271445205442355]") if row["t"] > SETTLED]
mean_r = sum(row["radial"] for row in rows) / len(rows)


def place(row):
    around = 0.5 * (row["phi_1"] + row["phi_2"])
    apart = (row["phi_1"] - row["phi_2"]) % (2 * math.pi) - math.pi
    ring = 1.0 + ACROSS * (row["radial"] - mean_r)
    return ring * math.cos(around), ring * math.sin(around), UP * apart


def at(p):
    x, y, z = p
    return 282 + 188 * x, 226 - 188 * (y * math.sin(TILT) + z * math.cos(TILT)), y * math.cos(TILT) - z * math.sin(TILT)


def less(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


cloud = [place(row) for row in rows]
page = Page(W, H, "Planes that touch a torus")
shown = sorted((at(p) for p in cloud[::2]), key=lambda p: -p[2])
for k, shade in enumerate(("#f6e3d6", "#f2d2bc", "#eec0a2", "#e9ac85")):
    part = shown[k * len(shown) // 4:(k + 1) * len(shown) // 4]
    page.cloud([(x, y) for x, y, _ in part], shade, 2.4)
page.line([at(p)[:2] for p in cloud[:300]], DARK["drifting apart (V2)"], 1.1, opacity=0.75)


def corners(k, size=0.13):
    """Of a piece of the plane that touches at state k of the cloud."""
    here = cloud[k]
    flow = unit(less(cloud[k + 1], cloud[k - 1]))

    def beside(p):
        d = less(p, here)
        along = dot(d, flow)
        across = [x - along * f for x, f in zip(d, flow)]
        return math.hypot(along, 0.0), math.sqrt(dot(across, across)), across

    near = [b for b in map(beside, cloud) if b[0] < 0.03 and 0.03 < b[1] < 0.09]
    across = unit(min(near, key=lambda b: b[0])[2])
    return [[h + size * (s * f + t * a) for h, f, a in zip(here, flow, across)] for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


# Places in front, well apart in the picture.
chosen = []
for k in sorted(range(1, len(cloud) - 1), key=lambda k: at(cloud[k])[2]):
    x, y, _ = at(cloud[k])
    if all(math.hypot(x - a, y - b) > 66 for _, a, b in chosen):
        chosen.append((k, x, y))
    if len(chosen) == PLANES:
        break
for k, x, y in chosen:
    page.line([at(p)[:2] for p in corners(k)], BLUE, 1.2, fill=PALE_BLUE, opacity=0.72, closed=True)
    page.dot(x, y, 2.6, BLUE)
page.text(28, 34, "The torus V2 and a few of its planes", 15, bold=True)

# A cell from the side.
X, Y = 574, 230
page.text(X, 34, "One cell, from the side", 15, bold=True)
page.box(X, 52, 236, 262, fill="#ffffff", stroke="#b8bfc7")


def arc(s):
    return X + 236 * s, Y - 150 * s * (1.12 - s) + 20


page.line([arc(k / 60) for k in range(61)], DARK["drifting apart (V2)"], 2.4)
for s, reach in ((0.26, 0.23), (0.74, 0.23)):
    (x, y), (xa, ya), (xb, yb) = arc(s), arc(s - 0.01), arc(s + 0.01)
    slope = (yb - ya) / (xb - xa)
    page.line([(x - 236 * reach, y - slope * 236 * reach), (x + 236 * reach, y + slope * 236 * reach)], BLUE, 2)
    page.dot(x, y, 4, BLUE)
(x, y), (xa, ya), (xb, yb) = arc(0.26), arc(0.25), arc(0.27)
slope = (yb - ya) / (xb - xa)
px, py = X + 72, 104
t = ((px - x) + slope * (py - y)) / (1 + slope * slope)
fx, fy = x + t, y + slope * t
page.line([(px, py), (fx, fy)], INK, 1.4, dash="4 3")
page.dot(px, py, 5.5, "#ffffff", INK, 2)
page.text(px + 12, py + 2, "a state", 14)
page.text((px + fx) / 2 + 10, (py + fy) / 2 + 10, "d", 15, italic=True)
page.text(X + 222, Y - 30, "planes", 14, BLUE, "end")
page.text(X + 14, Y + 38, "torus", 14, DARK["drifting apart (V2)"])
page.text(X, 342, "V = d², to the cell’s nearest plane.\nWhere the torus bends away from\nthe planes, the cell gets another.", 14, QUIET)
page.write(__file__)
