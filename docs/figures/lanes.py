"""lanes.svg: which start is in which lane of a batch, as starts finish and others take their lanes.

Starts 0 to 59 of the paper's rotor at 2.4, by `equipoise basin --start-index`, eight lanes. Steps are drawn as equally long in study time;
really each lane has its own.
"""

from drawn_page import COLOURS, INK, PALE, QUIET, Page, fate

W, H = 860, 410
LEFT, TOP, ROW, LANES, STARTS = 86, 62, 34, 8, 60
UNITS = 395.0
SCALE = (W - 24 - LEFT) / UNITS
NAMES = {"balanced": "balanced", "co-drifting": "co-drifting (V1)", "drifting apart": "drifting apart (V2)"}
WHITE = 0.8  # a start shorter than this, in study time, is a tick

page = Page(W, H, "Lanes of a batch, refilled as starts finish")
x = LEFT
page.text(LEFT, 32, "A lane’s start is", 14, QUIET)
x = LEFT + 122
for name, colour in COLOURS.items():
    page.box(x, 20, 16, 16, fill=colour, corner=3)
    page.text(x + 23, 32, name, 14)
    x += 60 + 7.6 * len(name)

free = [0.0] * LANES
for lane in range(LANES):
    y = TOP + lane * ROW
    page.box(LEFT, y, W - 24 - LEFT, ROW - 8, fill=PALE, corner=3)
    page.text(LEFT - 12, y + 18, f"lane {lane + 1}", 14, INK, "end")
for start in range(STARTS):
    lane = min(range(LANES), key=lambda k: free[k])
    begin = free[lane]
    if begin >= UNITS:
        break
    one = fate(start)
    end = begin + max(one["time"], WHITE)
    free[lane] = end
    left, right, y = LEFT + begin * SCALE, LEFT + min(end, UNITS) * SCALE, TOP + lane * ROW
    page.box(left + 0.6, y, max(right - left - 1.2, 1.0), ROW - 8, fill=COLOURS[NAMES[one["outcome"]]], corner=2)
    if right - left > 18:
        page.text((left + right) / 2, y + 18, str(start), 13, "#ffffff", "middle", bold=True)
bottom = TOP + LANES * ROW + 4
page.line([(LEFT, bottom), (W - 24, bottom)], INK, 1.2, arrow=True)
page.text((LEFT + W - 24) / 2, bottom + 22, "time", 14, INK, "middle")
page.text(LEFT, bottom + 44, "A number is that of a start. Once its outcome is known the next start takes the lane,\nat its own time 0 and with "
          "its own step. Thin bars are starts that begin in a trapping region.", 13, QUIET)
page.write(__file__)
