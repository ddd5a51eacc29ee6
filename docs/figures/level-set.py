#!/usr/bin/env python3
"""Draws level-set.svg for docs/explanation/proof.md: V along two starts of the paper's rotor, and the level that is proved.

    docs/figures/level-set.py PROGRAM

PROGRAM: build/release/equipoise. Nothing but Python is needed besides.
"""
import csv
import io
import json
import subprocess
import sys
from math import atan2, cos, log10, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).resolve().parent
STUDY = HERE.parents[1] / "studies/paper/table-2-omega-2.4.toml"
STARTS = {"balanced": (-1.4, -3.0), "never": (0.2, 0.9)}
UNTIL = 260.0
INK, FAINT, BLUE, ORANGE = "#7b818a", "#9aa0a8", "#2f86cc", "#d9641a"  # legible on white and on dark

parts = []


def add(text):
    parts.append("  " + text)


def run(*command):
    return subprocess.run([*map(str, command)], check=True, capture_output=True, text=True).stdout


def whole_turns_off(angle):
    return (angle + pi) % (2 * pi) - pi


def deviations(rows, phi):
    """From the balanced state in the order of P, and of its exchange copy."""
    for row in rows:
        v = {key: float(value) for key, value in row.items()}
        w = v["psi_dot"]
        centre = [v["x"], v["y"], v["x_dot"] - w * v["y"], v["y_dot"] + w * v["x"]]
        own = [whole_turns_off(v["phi_1"] - phi[0]), whole_turns_off(v["phi_2"] - phi[1]), v["phi_dot_1"], v["phi_dot_2"]]
        copy = [whole_turns_off(v["phi_2"] - phi[0]), whole_turns_off(v["phi_1"] - phi[1]), v["phi_dot_2"], v["phi_dot_1"]]
        yield v["t"], centre + own, centre + copy


def followed(program, state, start):
    rows = csv.DictReader(io.StringIO(run(program, "simulate", STUDY, "--set", f"initial.phi=[{start[0]}, {start[1]}]",
                                          "--every", 0.25, "--until", UNTIL)))
    form, level = state["form"], state["level"]

    def share(d):
        return sum(a * p * b for a, line in zip(d, form) for p, b in zip(line, d)) / level

    out = []
    for t, own, copy in deviations(rows, state["phi"]):
        d = min(own, copy, key=share)
        out.append((t, share(d), d[4:6]))
    return out


def solved(matrix, right):
    """matrix^-1 right, by elimination; matrix symmetric positive definite."""
    a = [[*row, *more] for row, more in zip(matrix, right)]
    n = len(a)
    for k in range(n):
        for i in range(n):
            if i != k:
                factor = a[i][k] / a[k][k]
                a[i] = [x - factor * y for x, y in zip(a[i], a[k])]
    return [[x / a[k][k] for x in a[k][n:]] for k in range(n)]


def shadow(state):
    """The outline of the ball angles of V <= c: delta^T S^-1 delta = c, S the block of P^-1."""
    form = state["form"]
    unit = [[float(i == 4), float(i == 5)] for i in range(len(form))]
    s = [row for row in solved(form, unit)[4:6]]
    mean, half, off = 0.5 * (s[0][0] + s[1][1]), 0.5 * (s[0][0] - s[1][1]), s[0][1]
    turn, spread = 0.5 * atan2(off, half), sqrt(half * half + off * off)
    long, short = sqrt(state["level"] * (mean + spread)), sqrt(state["level"] * (mean - spread))
    points = []
    for k in range(181):
        a, b = long * cos(2 * pi * k / 180), short * sin(2 * pi * k / 180)
        points.append((a * cos(turn) - b * sin(turn), a * sin(turn) + b * cos(turn)))
    return points


def polyline(points, colour, width=2.2, fill="none", more=""):
    add('<polyline points="' + " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        + f'" fill="{fill}" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round" {more}/>')


def line(a, b, colour=INK, width=1.2, more=""):
    add(f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{colour}" stroke-width="{width}" {more}/>')


def dot(p, colour, radius=5.0):
    add(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius}" fill="{colour}"/>')


def text(p, words, colour=INK, anchor="middle", size=15, more=""):
    add(f'<text x="{p[0]:.1f}" y="{p[1]:.1f}" fill="{colour}" font-size="{size}" text-anchor="{anchor}" {more}>{words}</text>')


class Frame:
    def __init__(self, left, top, right, bottom, x, y):
        self.left, self.top, self.right, self.bottom, self.x, self.y = left, top, right, bottom, x, y

    def __call__(self, x, y):
        return (self.left + (self.right - self.left) * (x - self.x[0]) / (self.x[1] - self.x[0]),
                self.bottom - (self.bottom - self.top) * (y - self.y[0]) / (self.y[1] - self.y[0]))

    def holds(self, x, y):
        return self.x[0] <= x <= self.x[1] and self.y[0] <= y <= self.y[1]

    def axes(self, xs, ys, x_name, y_name, y_label=str):
        add(f'<rect x="{self.left}" y="{self.top}" width="{self.right - self.left}" height="{self.bottom - self.top}" '
            f'fill="none" stroke="{INK}" stroke-width="1.2"/>')
        for x in xs:
            p = self(x, self.y[0])
            line(p, (p[0], p[1] + 5))
            text((p[0], p[1] + 21), f"{x:g}".replace("-", "−"), size=14)
        for y in ys:
            p = self(self.x[0], y)
            line(p, (p[0] - 5, p[1]))
            text((p[0] - 9, p[1] + 5), y_label(y).replace("-", "−"), anchor="end", size=14)
        text((0.5 * (self.left + self.right), self.bottom + 44), x_name)
        middle = (self.left - 50, 0.5 * (self.top + self.bottom))
        text(middle, y_name, more=f'transform="rotate(-90 {middle[0]:.1f} {middle[1]:.1f})"')


def left_window(d):
    return max(map(abs, d)) < 0.7


def draw(state, runs):
    home, away = runs["balanced"], runs["never"]
    entry = next(k for k, (_, share, _) in enumerate(home) if share <= 1.0)
    assert all(b[1] < a[1] for a, b in zip(home[entry:], home[entry + 1:])), "V rises inside its level"

    # What is left of the way once the balls are near, and between the same two places.
    last = entry
    while left_window(home[last][2]) and max(abs(a - b) for a, b in zip(home[last][2], home[last - 1][2])) < 0.3:
        last -= 1

    left = Frame(76, 40, 376, 340, (-0.6, 0.6), (-0.6, 0.6))
    left.axes((-0.5, 0, 0.5), (-0.5, 0, 0.5), "ball 1 off its balanced place, rad", "ball 2 off its balanced place, rad")
    add(f'<clipPath id="left"><rect x="{left.left}" y="{left.top}" width="{left.right - left.left}" '
        f'height="{left.bottom - left.top}"/></clipPath>')
    polyline([left(*p) for p in shadow(state)], INK, 1.8, INK, 'fill-opacity="0.18"')
    polyline([left(*d) for _, _, d in home[last:]], BLUE, 2.4, more='clip-path="url(#left)"')
    dot(left(*home[entry][2]), BLUE, 5)
    dot(left(0.0, 0.0), INK, 4)
    text((left(0.58, 0)[0], left(0, -0.5)[1]), "all states with V ≤ c", anchor="end")
    text((left(0.58, 0)[0], left(0, -0.575)[1]), "lie over the grey area", anchor="end")

    right = Frame(476, 40, 836, 340, (0, UNTIL), (-2, 5))
    right.axes((0, 50, 100, 150, 200, 250), (-2, 0, 2, 4), "time", "V / c", lambda k: {0: "1", 2: "100", 4: "10⁴", -2: "0.01"}[k])
    add(f'<rect x="{right.left}" y="{right(0, 0)[1]:.1f}" width="{right.right - right.left}" '
        f'height="{right.bottom - right(0, 0)[1]:.1f}" fill="{INK}" fill-opacity="0.18"/>')
    line(right(0, 0), right(UNTIL, 0), INK, 1.8)
    polyline([right(t, log10(share)) for t, share, _ in away], ORANGE)
    polyline([right(t, log10(share)) for t, share, _ in home if share > 0.01], BLUE, 2.4)
    dot(right(home[entry][0], log10(home[entry][1])), BLUE)
    text((right(10, 0)[0], right(0, -0.55)[1]), "V ≤ c: proved to fall", anchor="start")
    p = right(home[entry][0], 0)
    text((p[0] + 10, p[1] - 12), "enters: balanced", BLUE, "start")
    text((right.right - 10, right(0, 4.35)[1]), "never enters", ORANGE, "end")
    text((right.right - 10, right(0, 2.5)[1]), "above c, V may rise", anchor="end")
    print(f"enters at t = {home[entry][0]:g}")


def main():
    program = sys.argv[1]
    state = json.loads(run(program, "certify", STUDY, "--json", "--quiet"))["states"][0]
    draw(state, {name: followed(program, state, start) for name, start in STARTS.items()})
    title = ("Left: the ball angles of the level set V <= c around the balanced state, and a trajectory that enters it. Right: V over "
             "time along that trajectory, which falls for ever once it is below c, and along another, which never enters")
    (HERE / "level-set.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 24 860 372" width="860" height="372" role="img" '
        f'font-family="DejaVu Sans, Verdana, sans-serif">\n  <title>{title.replace("<", "&lt;")}</title>\n' + "\n".join(parts) + "\n</svg>\n")


if __name__ == "__main__":
    main()
