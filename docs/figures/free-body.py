#!/usr/bin/env python3
"""Draws free-body.svg, the rotor and all symbols of docs/explanation/equations.md. No arguments; needs nothing but Python."""
from math import cos, radians, sin
from pathlib import Path

INK, FAINT, BLUE, ORANGE, GREEN = "#7b818a", "#9aa0a8", "#2f86cc", "#d9641a", "#1a9a70"  # legible on white and on dark
A = (430.0, 352.0)            # the axis of rotation, fixed
O = (476.0, 268.0)            # the shaft's centre, much displaced
RACE, DISC, BALL, ECCENTRICITY = 176.0, 214.0, 19.0, 92.0
PSI, PHI = 24.0, (98.0, -84.0)

parts = []


def add(text):
    parts.append("  " + text)


def at(centre, angle, radius):
    return centre[0] + radius * cos(radians(angle)), centre[1] - radius * sin(radians(angle))


def line(a, b, colour=INK, width=1.6, more=""):
    add(f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{colour}" stroke-width="{width}" {more}/>')


def arrow(a, b, colour=INK, width=1.6, more=""):
    line(a, b, colour, width, f'marker-end="url(#{colour[1:]})" {more}')


def arc(centre, radius, start, end, colour, width=1.8, head=True):
    a, b = at(centre, start, radius), at(centre, end, radius)
    long, sweep = int(abs(end - start) > 180), int(end < start)
    marker = f'marker-end="url(#{colour[1:]})"' if head else ""
    add(f'<path d="M {a[0]:.1f} {a[1]:.1f} A {radius} {radius} 0 {long} {sweep} {b[0]:.1f} {b[1]:.1f}" fill="none" '
        f'stroke="{colour}" stroke-width="{width}" {marker}/>')


def circle(centre, radius, colour=INK, width=1.6, fill="none", more=""):
    add(f'<circle cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius}" stroke="{colour}" stroke-width="{width}" fill="{fill}" {more}/>')


def text(place, words, colour=INK, anchor="middle", size=19):
    """A subscript after "_", and the name of a symbol in italics between "*"."""
    out = ""
    for k, piece in enumerate(words.split("*")):
        head, _, below = piece.partition("_")
        style = ' font-style="italic"' if k % 2 else ""
        out += f"<tspan{style}>{head}</tspan>"
        if below:
            out += f'<tspan dy="5" font-size="{0.72 * size:.1f}"{style}>{below}</tspan><tspan dy="-5">&#8203;</tspan>'
    add(f'<text x="{place[0]:.1f}" y="{place[1]:.1f}" fill="{colour}" font-size="{size}" text-anchor="{anchor}">{out}</text>')


def spring(start, end, across):
    """A zigzag from start to end, along x or y."""
    along = 0 if abs(end[0] - start[0]) > abs(end[1] - start[1]) else 1
    points, n = [start], 10
    for k in range(n + 1):
        p = [start[0], start[1]]
        p[along] += (end[along] - start[along]) * (0.15 + 0.7 * k / n)
        p[1 - along] += 0 if k in (0, n) else across * (1 if k % 2 else -1)
        points.append(tuple(p))
    points.append(end)
    add('<polyline points="' + " ".join(f"{x:.1f},{y:.1f}" for x, y in points) + f'" fill="none" stroke="{INK}" stroke-width="1.6"/>')


def damper(start, end, across):
    along = 0 if abs(end[0] - start[0]) > abs(end[1] - start[1]) else 1

    def point(share, side=0.0):
        p = [start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share]
        p[1 - along] += side
        return tuple(p)

    line(start, point(0.36))
    for side in (-across, across):
        line(point(0.36, side), point(0.66, side))
    line(point(0.36, -across), point(0.36, across))
    line(point(0.52, -0.72 * across), point(0.52, 0.72 * across), width=2.6)
    line(point(0.52), end)


def ground(a, b, outwards):
    line(a, b, width=2.2)
    n = 9
    for k in range(n):
        p = tuple(a[i] + (b[i] - a[i]) * (k + 0.5) / n for i in (0, 1))
        line(p, (p[0] + outwards[0], p[1] + outwards[1]), FAINT, 1.2)


def support():
    wall, bar = 62.0, 196.0
    ground((wall, O[1] - 62), (wall, O[1] + 62), (-13, 11))
    spring((wall, O[1] - 34), (bar, O[1] - 34), 11)
    damper((wall, O[1] + 34), (bar, O[1] + 34), 12)
    line((bar, O[1] - 34), (bar, O[1] + 34), width=2.2)
    line((bar, O[1]), O, FAINT, 2.2, 'stroke-dasharray="2 5" stroke-linecap="round"')
    text((0.5 * (wall + bar), O[1] - 54), "*k_X*")
    text((0.5 * (wall + bar), O[1] + 68), "*c_X*")
    floor, top = 650.0, 522.0
    ground((O[0] - 62, floor), (O[0] + 62, floor), (-11, 13))
    spring((O[0] - 34, floor), (O[0] - 34, top), 11)
    damper((O[0] + 34, floor), (O[0] + 34, top), 12)
    line((O[0] - 34, top), (O[0] + 34, top), width=2.2)
    line((O[0], top), O, FAINT, 2.2, 'stroke-dasharray="2 5" stroke-linecap="round"')
    text((O[0] - 66, 592), "*k_Y*")
    text((O[0] + 68, 592), "*c_Y*")


def draw():
    circle(O, DISC, INK, 2.2, INK, 'fill-opacity="0.09"')
    circle(O, RACE, INK, 24, "none", 'stroke-opacity="0.16"')
    circle(O, RACE, INK, 1.2, "none", 'stroke-dasharray="6 5"')
    support()
    # Fixed axes.
    arrow((A[0] - 24, A[1]), (744, A[1]), FAINT, 1.4)
    arrow((A[0], A[1] + 24), (A[0], 30), FAINT, 1.4)
    text((744, A[1] + 25), "*X*")
    text((A[0] - 16, 38), "*Y*")
    # Axes that turn with the rotor, through the axis of rotation; x and y of the shaft's centre.
    arrow(A, at(A, PSI, 322), BLUE, 1.6, 'stroke-dasharray="8 5"')
    arrow(A, at(A, PSI + 90, 150), BLUE, 1.6, 'stroke-dasharray="8 5"')
    dx, dy = O[0] - A[0], A[1] - O[1]
    x, y = dx * cos(radians(PSI)) + dy * sin(radians(PSI)), dy * cos(radians(PSI)) - dx * sin(radians(PSI))
    foot, side = at(A, PSI, x), at(A, PSI + 90, y)
    line(A, foot, BLUE, 4)
    line(A, side, BLUE, 4)
    line(foot, O, BLUE, 1.2, 'stroke-dasharray="2 4"')
    line(side, O, BLUE, 1.2, 'stroke-dasharray="2 4"')
    mid = at(A, PSI, 0.55 * x)
    text((mid[0] - 7, mid[1] - 9), "*x*", BLUE)
    mid = at(A, PSI + 90, 0.6 * y)
    text((mid[0] - 15, mid[1] + 2), "*y*", BLUE)
    arc(A, 214, 0, PSI, BLUE)
    place = at(A, 0.5 * PSI, 196)
    text((place[0], place[1] + 5), "*ψ*", BLUE, size=21)
    # From the shaft's centre: the centre of mass, the balls.
    centre = at(O, PSI, ECCENTRICITY)
    line(O, centre, ORANGE, 3)
    line(centre, at(O, PSI, RACE), BLUE, 1.2, 'stroke-dasharray="8 5"')
    place = at(O, PSI + 12, 0.62 * ECCENTRICITY)
    text(place, "*ε*", ORANGE, size=21)
    circle(centre, 8, ORANGE, 2, ORANGE, 'fill-opacity="0.35"')
    text((centre[0] - 30, centre[1] - 32), "*C*: *M*, *I_C*", ORANGE, "start")
    for k, (phi, radius) in enumerate(zip(PHI, (52, 66))):
        ball = at(O, PSI + phi, RACE)
        line(O, ball, GREEN, 1.4)
        circle(ball, BALL, GREEN, 2, GREEN, 'fill-opacity="0.45"')
        arc(O, radius, PSI, PSI + phi, GREEN)
        place = at(O, PSI + 0.56 * phi, radius + 17)
        text((place[0], place[1] + 5), f"*φ_{k + 1}*", GREEN, size=21)
    place = at(O, PSI + PHI[0], RACE + 36)
    text((place[0] - 26, place[1] + 2), "*m_1*", GREEN)
    place = at(O, PSI + PHI[1], RACE + 40)
    text((place[0] + 22, place[1] + 6), "*m_2*", GREEN)
    # The drag of the race on ball 1, which runs ahead.
    angle = PSI + PHI[0]
    ball = at(O, angle, RACE)
    ahead = (-sin(radians(angle)), -cos(radians(angle)))
    start = (ball[0] + 24 * ahead[0], ball[1] + 24 * ahead[1])
    arrow(start, (start[0] + 44 * ahead[0], start[1] + 44 * ahead[1]), GREEN, 2)
    text((start[0] + 44 * ahead[0] - 48, start[1] + 44 * ahead[1] - 2), "*φ_1*′", GREEN)
    start = (ball[0] - 24 * ahead[0], ball[1] - 24 * ahead[1])
    arrow(start, (start[0] - 46 * ahead[0], start[1] - 46 * ahead[1]), ORANGE, 2.6)
    text((start[0] - 46 * ahead[0] + 10, start[1] - 46 * ahead[1] - 6), "*D_1**φ_1*′/*R*", ORANGE, "start")
    # Radius, torque, weight.
    arrow(O, at(O, 160, RACE), INK, 1.4)
    place = at(O, 170, 0.72 * RACE)
    text((place[0], place[1] + 2), "*R*")
    arc(O, DISC + 22, -22, 6, INK, 2.2)
    place = at(O, -12, DISC + 44)
    text((place[0] + 2, place[1]), "*τ*", size=21)
    arrow((766, 62), (766, 122), INK, 2)
    text((784, 98), "*g*")
    circle(A, 4, INK, 1, INK)
    circle(O, 5, INK, 1, INK)
    text((O[0] - 15, O[1] - 9), "*O*")
    text((A[0] - 9, A[1] + 21), "axis", anchor="end", size=15)
    text((O[0] - 138, O[1] + 176), "rotor", anchor="end", size=16)
    place = at(O, 200, RACE)
    text((place[0] + 20, place[1] + 6), "race", anchor="start", size=16)


def main():
    draw()
    heads = "".join(f'<marker id="{c[1:]}" viewBox="0 0 10 10" refX="8.5" refY="5" markerWidth="11" markerHeight="11" '
                    f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0.8 L10 5 L0 9.2 z" fill="{c}"/></marker>'
                    for c in (INK, FAINT, BLUE, ORANGE, GREEN))
    title = ("Rotor on springs and dampers, seen along its shaft: the race with two balls, the shaft's centre O displaced by x and y "
             "in axes turned by psi, the centre of mass C at distance epsilon from O")
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="20 16 800 662" width="800" height="662" role="img" '
           f'font-family="DejaVu Serif, Georgia, serif">\n  <title>{title}</title>\n  <defs>{heads}</defs>\n'
           + "\n".join(parts) + "\n</svg>\n")
    Path(__file__).with_name("free-body.svg").write_text(svg)


if __name__ == "__main__":
    main()
