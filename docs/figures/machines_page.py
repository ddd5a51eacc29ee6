#!/usr/bin/env python3
"""Writes docs/how-to/machines.md and its screens: six machines from data sheet to verdict.

    docs/figures/machines_page.py [PROGRAM]

From the repository's root. Runs `basin` on each study of studies/machines; seconds are of this computer.
"""
import os
import re
import resource
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# File, title, words, and the tables of the study that the page shows (None: all).
MACHINES = [
    ("front-loader", "A front loader for 9 kg",
     "The friction dampers are taken as viscous ones of the same loss. The lump of laundry is a `[[place]]`.", None),
    ("spin-dryer", "A spin dryer", "Its test bench gives a logarithmic decrement, its data sheet the time to full speed.", ["[rotor]", "[speed]"]),
    ("grinder-230", "An angle grinder for discs of 230 mm",
     "Its unbalance is not known, but the balance grade of its disc is. Hands hold it, so the answer gives the daily exposure.",
     ["[rotor]", "[standards]"]),
    ("universal-motor-tool", "A tool with a universal motor",
     "The motor is known by five points of its curve, the load by what it takes at one speed.", ["[speed]"]),
    ("centrifuge-12", "A centrifuge with twelve places", "The contents of the first tube are not known: every start draws them.",
     ["[[place]]"]),
    ("fan", "A fan of 30 kg, started direct on line", "The nameplate of its induction motor, and the torque of the fan at rated speed.",
     ["[speed]", "[standards]"]),
]
HEAD = """# Six machines, from data sheet to verdict

Each study is in `studies/machines/`, written as its data sheet states it. Below, the first is complete; the others show what is new.
`equipoise basin` gives the verdict, in these times on 2 cores (AVX-512). The numbers are typical of such machines, and of none in particular.
The [explorer](../explanation/web.md) has the same six among its examples.

"""


def run(program, *arguments):
    """Standard output, seconds and CPU seconds of a command."""
    def used():
        return resource.getrusage(resource.RUSAGE_CHILDREN)
    before, begin = used(), time.time()
    text = subprocess.run([program, *arguments], capture_output=True, text=True, check=False).stdout
    after = used()
    return text, time.time() - begin, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def study_text(path, tables):
    """The study, or some of its tables, without its heading comment; for a row of similar places only the first two."""
    with open(path, encoding="utf-8") as file:
        text = file.read().split("\n\n", 1)[1]
    text = re.sub(r'(\[\[place\]\]\nname = "tube 3".*?)(?=\[balancer\])', "# ... and so on, every 30 degrees, to tube 12\n\n", text, flags=re.S)
    parts = re.split(r"\n+(?=\[)", text.strip())
    return "\n\n".join(part for part in parts if tables is None or part.split("\n", 1)[0] in tables)


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build/release/equipoise"))
    os.chdir(ROOT)
    table, body = "| machine | verdict | seconds | CPU seconds |\n|---|---|---|---|\n", ""
    for name, title, words, tables in MACHINES:
        study = f"studies/machines/{name}.toml"
        answer, wall, cpu = run(program, "basin", study, "--quiet")
        verdict = re.sub(r"\s+", " ", re.match(r"verdict(.*(?:\n .*)*)", answer)[1]).strip().split(":")[0].rstrip(".") + "."
        picture = f"screen-{name}.svg"
        subprocess.run([sys.executable, "docs/figures/terminal_screen.py", f"docs/figures/{picture}", "--", program, "basin", study, "--quiet"], check=True)
        anchor = re.sub("[^a-z0-9 -]", "", title.lower()).replace(" ", "-")
        table += f"| [{title}](#{anchor}) | {verdict} | {wall:.0f} | {cpu:.0f} |\n"
        body += f"\n## {title}\n\n{words}\n\n```toml\n{study_text(study, tables).strip()}\n```\n\n"
        body += f"![What basin prints](../figures/{picture})\n"
        print(f"{name}: {wall:.1f} s, {cpu:.1f} CPU s; {verdict}", file=sys.stderr)
    with open("docs/how-to/machines.md", "w", encoding="utf-8") as file:
        file.write(HEAD + table + body)


if __name__ == "__main__":
    main()
