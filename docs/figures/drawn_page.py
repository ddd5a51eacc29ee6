"""What the scripts beside this file share: a page of SVG on light paper, and results of the program. From the repository's root:

    python3 docs/figures/trapping-regions.py [PROGRAM]

PROGRAM is the built `equipoise` (default: build/release/equipoise). Colours are those of the program's pictures.
"""

import csv
import io
import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import escape

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/equipoise")
STUDY = "studies/paper/table-2-omega-2.4.toml"

INK, QUIET, RULE, PAPER, PALE = "#1b1f24", "#57606a", "#b8bfc7", "#fcfcf9", "#f0f1ec"
COLOURS = {"balanced": "#009E73", "co-drifting (V1)": "#0072B2", "drifting apart (V2)": "#D55E00"}
DARK = {"balanced": "#00664a", "co-drifting (V1)": "#00507d", "drifting apart (V2)": "#9a4300"}


def program(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout


def simulate(until, every, *settings, study=STUDY):
    """Rows of a trajectory, each a dictionary of numbers; names without the units that those of a machine have."""
    sets = [word for one in settings for word in ("--set", one)]
    text = program("simulate", study, "--until", until, "--every", every, *sets)
    return [{name.partition(" (")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(text))]


def fate(start, *options, study=STUDY):
    """What `basin --start-index` says of one start: its ball angles, outcome, ground and time of decision."""
    said = dict(line.split(" = ", 1) for line in program("basin", study, "--start-index", start, *options).splitlines() if " = " in line)
    return {"phi": [float(said["phi_1"]), float(said["phi_2"])], "outcome": said["outcome"], "ground": said["decided_by"],
            "time": float(said["decision_time"])}


class Page:
    def __init__(self, width, height, title):
        self.width, self.height, self.title, self.parts = width, height, title, []

    def add(self, part):
        self.parts.append(part)

    def line(self, points, colour=INK, width=1.5, fill="none", dash="", opacity=1.0, closed=False, arrow=False):
        path = "M" + " ".join(f"{x:.1f},{y:.1f}" for x, y in points) + ("Z" if closed else "")
        more = (f' stroke-dasharray="{dash}"' if dash else "") + (f' opacity="{opacity:g}"' if opacity < 1 else "")
        more += ' marker-end="url(#arrow)"' if arrow else ""
        self.add(f'<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width:g}" stroke-linejoin="round"{more}/>')

    def box(self, x, y, width, height, fill=PALE, stroke="none", corner=0.0, opacity=1.0, line=1.2):
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="{corner:g}" fill="{fill}" '
                 f'stroke="{stroke}" stroke-width="{line:g}"' + (f' opacity="{opacity:g}"' if opacity < 1 else "") + "/>")

    def dot(self, x, y, radius=4.0, fill=INK, stroke="none", line=1.5):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="{fill}" stroke="{stroke}" stroke-width="{line:g}"/>')

    def cloud(self, points, colour, width):
        path = "".join(f"M{x:.1f},{y:.1f}h0" for x, y in points)
        self.add(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}" stroke-linecap="round"/>')

    def text(self, x, y, words, size=14, colour=INK, anchor="start", bold=False, italic=False, turned=False):
        style = (' font-weight="600"' if bold else "") + (' font-style="italic"' if italic else "")
        style += f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turned else ""
        for k, line in enumerate(words.split("\n")):
            self.add(f'<text x="{x:.1f}" y="{y + 1.3 * size * k:.1f}" font-size="{size:g}" fill="{colour}" '
                     f'text-anchor="{anchor}"{style}>{escape(line)}</text>')

    def write(self, script):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" '
                f'height="{self.height}" font-family="Helvetica, Arial, sans-serif" role="img">\n<title>{escape(self.title)}</title>\n'
                f'<defs><marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8" '
                f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0,0L10,5L0,10Z" fill="{INK}"/></marker></defs>\n'
                f'<rect x="0.5" y="0.5" width="{self.width - 1}" height="{self.height - 1}" rx="10" fill="{PAPER}" stroke="{RULE}"/>\n')
        Path(script).with_suffix(".svg").write_text(head + "\n".join(self.parts) + "\n</svg>\n")
