"""windows.svg: how windows of time tell a motion, on start 16 of the paper's rotor at 2.4, which comes to V2.

Above: short windows of 16 time units that overlap by half, and a box around the windows of the motion (here: of the same trajectory,
later, a tenth wider). Below: long windows that end at 100, 200, 400, 800. Only three features are drawn: least, largest and rms r.
"""

import math

from drawn_page import DARK, INK, PALE, QUIET, RULE, Page, simulate

W, H = 860, 560
LEFT, RIGHT = 74, 766
PHI = [0.514656743798563, 5.873829031179518]
R1 = 0.16
GREEN, AMBER = DARK["balanced"], "#b8bfc7"

rows = simulate(3200, 0.1, f"initial.phi={PHI}")


def window(begin, end):
    r = [row["radial"] for row in rows if begin <= row["t"] <= end]
    return min(r), max(r), math.sqrt(sum(v * v for v in r) / len(r))


def frame(top, bottom, until, ticks):
    def at(t, r):
        return LEFT + t / until * (RIGHT - LEFT), bottom - min(r, R1) / R1 * (bottom - top)

    page.box(LEFT, top, RIGHT - LEFT, bottom - top, fill="#ffffff", stroke=RULE)
    for r in (0.0, 0.05, 0.1, 0.15):
        page.text(LEFT - 8, at(0, r)[1] + 5, f"{r:g}", 13, QUIET, "end")
    for t in ticks:
        page.text(at(t, 0)[0], bottom + 18, f"{t:g}", 13, QUIET, "middle")
    page.text(22, (top + bottom) / 2, "r / race radius", 14, INK, "middle", turned=True)
    return at


page = Page(W, H, "Windows of time by which a motion is recognised")

# Short windows and a box.
page.text(LEFT, 28, "Short windows: several in a row inside one motion’s box", 15, bold=True)
TOP, BOTTOM, UNTIL = 96, 262, 128
at = frame(TOP, BOTTOM, UNTIL, range(0, UNTIL + 1, 16))
late = [window(t, t + 16) for t in range(1600, 3180, 8)]
low = [min(w[k] for w in late) for k in range(3)]
high = [max(w[k] for w in late) for k in range(3)]
box = [(lo - 0.1 * (hi - lo), hi + 0.1 * (hi - lo)) for lo, hi in zip(low, high)]
for k, words in ((0, "least r"), (2, "rms r"), (1, "largest r")):
    (_, upper), (_, lower) = at(0, box[k][1]), at(0, max(box[k][0], 0.0))
    page.box(LEFT, upper, RIGHT - LEFT, lower - upper, fill="#f9d9c3", opacity=0.75)
    page.text(RIGHT + 8, (upper + lower) / 2 + 4.5, words, 13, DARK["drifting apart (V2)"])
page.line([at(row["t"], row["radial"]) for row in rows if row["t"] <= UNTIL], INK, 1.1)
in_a_row = 0
for k in range(UNTIL // 8 - 1):
    w = window(8 * k, 8 * k + 16)
    inside = all(lo <= v <= hi for v, (lo, hi) in zip(w, box))
    in_a_row = in_a_row + 1 if inside else 0
    x, y = at(8 * k, 0)[0], 42 + 22 * (k % 2)
    page.box(x + 1, y, at(16, 0)[0] - LEFT - 2, 18, fill=GREEN if inside else AMBER, corner=3)
    page.text(x + (at(16, 0)[0] - LEFT) / 2, y + 14, f"{in_a_row} in a row" if inside else "outside", 12,
              "#ffffff" if inside else INK, "middle")
page.text((LEFT + RIGHT) / 2, BOTTOM + 36, "time", 14, INK, "middle")

# Long windows.
page.text(LEFT, 336, "Long windows: each compared with the one before", 15, bold=True)
TOP, BOTTOM, UNTIL = 350, 490, 800
at = frame(TOP, BOTTOM, UNTIL, (0, 100, 200, 400, 800))
page.line([at(row["t"], row["radial"]) for row in rows[::3] if row["t"] <= UNTIL], "#a9b1ba", 0.5)
before = None
for begin, end in ((0, 100), (100, 200), (200, 400), (400, 800)):
    w = window(begin, end)
    (x0, y0), (x1, y1) = at(begin, w[1]), at(end, w[0])
    worst = None if before is None else max(abs(w[0] - before[0]) / 2, abs(w[1] - before[1]), abs(w[2] - before[2])) / max(w[1], before[1])
    same = worst is not None and worst <= 0.02
    print(begin, end, w, worst)
    colour = GREEN if same else QUIET
    page.box(x0 + 1.5, y0, x1 - x0 - 3, y1 - y0, fill="none", stroke=colour, line=2.2)
    page.line([(x0 + 1.5, at(0, w[2])[1]), (x1 - 1.5, at(0, w[2])[1])], colour, 2.2, dash="7 4")
    if worst is not None:
        page.text((x0 + x1) / 2, TOP + 15, ("repeats" if same else "differs"), 13, colour, "middle", bold=True)
    before = w
page.text((LEFT + RIGHT) / 2, BOTTOM + 36, "time", 14, INK, "middle")
page.text(LEFT, H - 14, "Frames reach from the least to the largest r of a window; dashes are its rms r. Two repeats: stationary.", 13, QUIET)
page.write(__file__)
