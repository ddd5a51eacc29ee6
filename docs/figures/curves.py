"""Curves of the examples and of docs/explanation. Writes NAME.png in this folder. From the repository's root, with matplotlib:

    python3 docs/figures/curves.py [PROGRAM [NAME ...]]

Without a NAME it draws all. Trajectories are computed here, shares come from the CSV files in this folder, which the .sh files
there write.
"""

import csv
import sys

import numpy as np
from matplotlib import pyplot as plt

from drawn_page import HERE, simulate

BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#666666"


def axes(rows=1, height=4.2, **more):
    figure, found = plt.subplots(rows, 1, figsize=(9.0, height), sharex=rows > 1, layout="constrained", **more)
    for one in np.atleast_1d(found):
        one.grid(color="#dddddd", linewidth=0.6)
        one.spines[["top", "right"]].set_visible(False)
    return figure, found


def trajectory(study, until, every, *settings):
    rows = simulate(until, every, *settings, study=f"studies/{study}.toml")
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def table(name):
    with open(HERE / name, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) if row[key] else np.nan for row in rows]) for key in rows[0] if key != "release"}


def with_intervals(one, x, of, value, low, high, label, factor=1.0, **look):
    errors = [factor * (of[value] - of[low]), factor * (of[high] - of[value])]
    one.errorbar(x, factor * of[value], np.maximum(errors, 0.0), label=label, capsize=2, marker="o", markersize=4, **look)


def angle_grinder():
    """Vibration around the place to which the grinder's weight pulls it."""
    omega = np.sqrt(9000 / 2.2)  # omega_c of the study, rad/s
    sag = 9.81 / omega**2 * 1e6 * (2.2 + 4 * 0.88216e-3) / 2.2  # with the balls' weight, um
    figure, one = axes()
    for label, colour, settings in (("3 mN s/m, as stated", RED, ()), ("20 mN s/m", BLUE, ("balancer.drag=20 mN s/m",))):
        run = trajectory("examples/angle-grinder", 200, 0.02, "initial.phi=[1.0,2.0,4.0,5.0]", *settings)
        place = 25e3 * (run["x"] + 1j * run["y"]) * np.exp(1j * run["psi"])  # in fixed axes
        one.plot(run["t"] / omega, abs(place + 1j * sag), color=colour, label=label, linewidth=1.2)
    one.axhline(27.356, color="k", linestyle="-.", label="without balls, at full speed")  # as explain says
    one.axvline(0.5, color=GREY, linestyle="--")
    one.text(0.52, 0.94, "full speed", color=GREY, transform=one.get_xaxis_transform())
    one.set(xlim=(0, 3), xlabel="time since switched on, s", ylabel="displacement, µm")
    one.set_ylim(bottom=0)
    one.legend(loc="upper right")
    return figure


def laboratory_centrifuge():
    omega = np.sqrt(110e3 / 10)
    rpm = omega * 30 / np.pi
    figure, (speed, size) = axes(2, 6.4)
    weak = 'speed.torque={stall="0.4 N m", no_load_speed="3200 rpm"}'
    for label, colour, settings in (("0.4 N m: captured", RED, (weak,)), ("stall torque 1.5 N m", BLUE, ())):
        run = trajectory("examples/laboratory-centrifuge", 2500, 0.5, "initial.phi=[1.0,4.0]", *settings)
        speed.plot(run["t"] / omega, run["psi_dot"] * rpm, color=colour, label=label)
        size.plot(run["t"] / omega, run["radial"] * 60, color=colour, linewidth=1)
    speed.axhline(rpm, color=GREY, linestyle="--")
    speed.text(0.99, rpm + 120, "critical speed", ha="right", color=GREY, transform=speed.get_yaxis_transform())
    speed.set(ylabel="speed, rpm", ylim=(0, 3400))
    speed.legend(loc="center right")
    size.set(xlabel="time, s", ylabel="displacement, mm")
    size.set_ylim(bottom=0)
    return figure


def washing_machine():
    omega = np.sqrt(20e3 / 40)
    figure, one = axes()
    for label, colour, settings in (("balls free from the start", RED, ()),
                                    ("balls held to 600 rpm", BLUE, ('release={speed="600 rpm"}',))):
        run = trajectory("examples/washing-machine", 450, 0.1, "initial.phi=[0.5,2.0,3.5,5.0]", *settings)
        one.plot(run["t"] / omega, run["radial"] * 250, color=colour, label=label)
    one.axhline(15, color="k", linestyle="-.")
    one.text(0.2, 15.9, "cabinet", color=GREY)
    one.axvline(15, ymax=0.42, color=GREY, linestyle="--")
    one.text(15.2, 11.4, "600 rpm", color=GREY)
    one.set(xlim=(0, 20), ylim=(0, 30), xlabel="time, s (40 rpm gained every second)", ylabel="displacement, mm")
    one.legend(loc="upper right")
    return figure


def transients():
    """One start of the washing machine: what is measured on its way and at its end."""
    omega = 2 * np.pi * 3.6
    run = trajectory("new/washing-machine", "14 s", "0.005 s", "initial.phi=[0.3,1.2,3.0,5.0]")
    figure, one = axes(height=4.6)
    one.semilogy(run["t"] / omega, np.maximum(run["radial"] * 250, 1e-3), color=BLUE, linewidth=1.2)
    for height, name, colour in ((15, "limits.displacement", RED), (1, "limits.settled", GREEN)):
        one.axhline(height, color=colour, linestyle="--", linewidth=1)
        one.text(13.8, 1.2 * height, name, color=colour, ha="right")
    arrow = {"arrowstyle": "->", "color": "#444444"}
    one.annotate("peak displacement", (6.75, 28), (6.3, 40), ha="right", arrowprops=arrow)
    one.annotate("time above the limit:\nall pieces together", (7.6, 16.5), (8.4, 36), va="center", arrowprops=arrow)
    for begin, end in ((6.34, 7.18), (7.41, 7.89)):
        one.plot([begin, end], [15, 15], color=RED, linewidth=4)
    one.annotate("", (0, 0.16), (9.3, 0.16), arrowprops={"arrowstyle": "<->", "color": GREEN})
    one.text(4.6, 0.19, "settling time, from release (here at 0)", color=GREEN, ha="center")
    one.plot([9.3, 9.3], [1, 0.13], color=GREEN, linestyle=":")
    one.set(xlim=(0, 14), ylim=(0.1, 100), xlabel="time, s", ylabel="radial displacement, mm")
    return figure


def best_spin_ups():
    """The spin-ups of studies/designs/best-spin-up-to-*.toml and best-free-spin-up-to-2.0.toml."""
    figure, one = axes(height=5.0)
    for label, colour, look, points in (
            ("to 2.0", BLUE, "-", ((0, 0), (160, 8), (286.082, 2.0747), (326.742, 1.41306), (489.407, 2), (540, 2))),
            ("to 2.4", RED, "-", ((0, 0), (193.603, 7.88794), (317.556, 1.69028), (401.05, 5.46848), (484.611, 2.4), (540, 2.4))),
            ("to 5.0", GREEN, "-", ((0, 0), (191.203, 0.734567), (259.039, 0.160394), (356.177, 1.09596), (455.189, 5), (540, 5))),
            ("to 2.0, balls never held", BLUE, "--",
             ((0, 0), (164.77, 1.11343), (237.711, 2.45313), (348.693, 5.92489), (434.736, 2), (540, 2)))):
        one.plot(*zip(*points), color=colour, linestyle=look, linewidth=2.2, label=label)
    one.plot((143.268, 228.773, 50.1302), (7.163, 6.133, 0.1926), "o", markersize=10, color="#333333", fillstyle="none",
             label="balls released")
    one.set(xlim=(0, 540), ylim=(0, 8.6), xlabel="time, 1/ω_c", ylabel="speed, ω_c")
    figure.legend(loc="outside upper center", ncols=5, frameon=False)
    return figure


def optical_drive():
    """RMS velocity of the optical drive at full speed by the rolling resistance of its balls."""
    rows = table("optical-drive.csv")
    figure, one = axes(height=4.4)
    for runout, colour in ((5, BLUE), (20, RED)):
        part = {key: column[rows["runout_um"] == runout] for key, column in rows.items()}
        one.plot(part["rolling"], part["velocity_p90_mm_per_s"], "o--", fillstyle="none", color=colour,
                 label=f"runout {runout} µm: 90 % of starts below")
        with_intervals(one, part["rolling"], part, "velocity_p50_mm_per_s", "p50_low", "p50_high", "median, with 95 % interval", color=colour)
    one.axhline(12, color="k", linestyle="-.", label="limit")
    one.set(ylim=(0, 50), xlabel="rolling resistance over normal force (stiction twice that)", ylabel="RMS velocity at 10 000 rpm, mm/s")
    one.legend(loc="upper left")
    return figure


def sommerfeld():
    """Share of stalled starts and peak displacement of the laboratory centrifuge by the motor's stall torque."""
    rows = table("sommerfeld.csv")
    torque = rows["stall_torque_Nm"]
    figure, (share, size) = axes(2, 6.4)
    with_intervals(share, torque, rows, "stalled", "low", "high", "stalled, with 95 % intervals", 100, color=RED)
    share.plot(torque, 100 * rows["balanced"], "o-", fillstyle="none", color=GREEN, label="balanced")
    with_intervals(size, torque, rows, "peak_p50_mm", "p50_low", "p50_high", "peak, median of all starts", color=BLUE)
    size.plot(torque, rows["end_p50_mm"], "o-", fillstyle="none", color="#E69F00", label="at the end, median of all starts")
    share.set(ylabel="starts, %", ylim=(-4, 104))
    size.set(xlabel="stall torque, N m", ylabel="displacement, mm")
    size.set_ylim(bottom=0)
    for one in (share, size):
        one.legend(loc="center right")
    return figure


def paper_rotor_with_motor():
    rows, (free, held) = table("paper-rotor-with-motor.csv"), 100 * table("paper-rotor-brought-at-once.csv")["balanced"]
    torque = rows["stall_torque"]
    figure, (share, speed) = axes(2, 7.6)
    share.set_xscale("log")
    with_intervals(share, torque, rows, "balanced_free", "low", "high", "balanced, balls free from the start", 100, color=GREEN)
    with_intervals(share, torque, rows, "balanced_held", "held_low", "held_high", "balanced, balls held until 1.5", 100, color=BLUE)
    share.plot(torque, 100 * rows["hangs_free"], "o--", fillstyle="none", color="#98df8a", label="stalled or captured at resonance, free")
    share.plot(torque, 100 * rows["hangs_held"], "s--", fillstyle="none", color="#aec7e8", label="stalled, captured or never let go, held")
    share.axhline(free, color=GREEN, linestyle=":", label="brought to 2.4 at once, free")
    share.axhline(held, color=BLUE, linestyle=":", label="brought to 2.4 at once, held until 1.5")
    share.set(ylabel="starts, %", ylim=(-3, 105), xlim=(0.0025, 25))
    share.legend(loc="upper right", fontsize="small")
    speed.plot(torque, rows["other_speed"], "o-", color=RED, label="most frequent motion")
    speed.axhline(1 / np.sqrt(1.1), color=GREY, linestyle="--", label="resonance with the balls")
    speed.set(xlabel=r"stall torque, $M R^2 \omega_c^2$", ylabel="mean ψ' of what is not balanced", ylim=(0, 2.6))
    speed.legend(loc="lower right")
    return figure


DRAWN = (angle_grinder, best_spin_ups, laboratory_centrifuge, optical_drive, paper_rotor_with_motor, sommerfeld, transients,
         washing_machine)

if __name__ == "__main__":
    by_name = {draw.__name__.replace("_", "-"): draw for draw in DRAWN}
    for name in sys.argv[2:] or by_name:
        by_name[name]().savefig(HERE / f"{name}.png", dpi=100)
