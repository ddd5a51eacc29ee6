#!/usr/bin/env python3
"""A command's answer as it stands on a terminal of 80 columns, as a picture (SVG).

    docs/figures/terminal_screen.py PICTURE.svg [--lines N] -- COMMAND...

Runs COMMAND on a pseudo terminal, with colours, and draws what it writes to standard output, with the command above it as a reader
would type it. --lines N: only the first N lines. Stops with an error where a line is wider than the screen.
"""
import argparse
import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from html import escape

COLUMNS = 80
CHARACTER, LINE, MARGIN = 8.4, 18, 16  # pixels
COLOURS = {"32": "#3fa45b", "31": "#e5534b", "33": "#c69026"}  # readable on dark


def output_of(command):
    """What `command` writes to a terminal, as text with ANSI escapes."""
    main, side = pty.openpty()
    fcntl.ioctl(side, termios.TIOCSWINSZ, struct.pack("HHHH", 50, COLUMNS, 0, 0))
    environment = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | {"TERM": "xterm-256color"}
    child = subprocess.Popen(command, stdout=side, stderr=subprocess.DEVNULL, env=environment)
    os.close(side)
    text = b""
    while True:
        try:
            part = os.read(main, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        text += part
    child.wait()
    return text.decode().replace("\r\n", "\n").rstrip("\n")


def spans(line, state):
    """The line's pieces: (style, text). `state`: colour and weight that are on, kept from line to line."""
    for piece in re.split(r"(\x1b\[[0-9;]*m)", line):
        code = re.fullmatch(r"\x1b\[([0-9;]*)m", piece)
        if not code:
            if piece:
                yield dict(state), piece
        elif code[1] in ("", "0"):
            state.clear()
        elif code[1] == "1":
            state["font-weight"] = "bold"
        else:
            state["fill"] = COLOURS[code[1]]


def picture(lines):
    width, height = COLUMNS * CHARACTER + 2 * MARGIN, len(lines) * LINE + 2 * MARGIN
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height}" viewBox="0 0 {width:.0f} {height}" '
           'font-family="DejaVu Sans Mono, Menlo, Consolas, monospace" font-size="14" fill="#d6dbe1">',
           f'<rect width="{width:.0f}" height="{height}" rx="8" fill="#1c2128"/>']
    state = {}
    for k, line in enumerate(lines):
        column = 0
        for style, text in spans(line, state):
            if text.strip():
                lead = len(text) - len(text.lstrip(" "))
                shown = text.strip(" ")
                attributes = "".join(f' {name}="{value}"' for name, value in style.items())
                svg.append(f'<text x="{MARGIN + (column + lead) * CHARACTER:.1f}" y="{MARGIN + k * LINE + 14}" xml:space="preserve" '
                           f'textLength="{len(shown) * CHARACTER:.1f}"{attributes}>{escape(shown)}</text>')
            column += len(text)
        if column > COLUMNS:
            sys.exit(f"wider than {COLUMNS} columns: {line}")
    return "\n".join(svg + ["</svg>"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture")
    parser.add_argument("--lines", type=int)
    parser.add_argument("command", nargs="+")
    given = parser.parse_args()
    typed = " ".join([os.path.basename(given.command[0])] + given.command[1:]).replace(" --quiet", "")
    lines = ["\x1b[1m$ " + typed + "\x1b[0m"] + output_of(given.command).split("\n")
    with open(given.picture, "w", encoding="utf-8") as file:
        file.write(picture(lines[: given.lines and given.lines + 1]))


if __name__ == "__main__":
    main()
