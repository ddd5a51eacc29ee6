#!/usr/bin/env python3
"""The lessons run: every command of a page, in the page's order, prints what the page shows.

    lessons_test.py SOURCE BUILD SCRATCH PAGE...

A block ```console holds commands ("$ ...") and what they print; a line "..." stands for what is left out. A block below
"<!-- file NAME -->" is written to that file. `./dev run` is the program of BUILD, `./dev python` the interpreter with its
package. Words are compared as they are and numbers to 5 %, since other instruction sets round otherwise; lines that tell how
long something took are not compared.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TAKEN = re.compile(r"\bCPU\b|starts/s|-- |\[\d+/\d+\]|\[ *\d+%\]")  # times; what CMake says
ROUNDING = 0.05


def blocks(text):
    """Files and consoles of a page, in order: (name of the file or None, text)."""
    for found in re.finditer(r"(?:<!-- file (\S+) -->\n)?^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        if found[1] or found[2] == "console":
            yield found[1], found[3]


def commands(console):
    """Commands of a block, each with the lines that it prints."""
    lines = console.rstrip("\n").split("\n")
    if not lines[0].startswith("$ "):
        raise SystemExit(f"no command: {lines[0]}")
    asked = []
    for line in lines:
        if line.startswith("$ "):
            asked.append([line[2:], []])
        elif line.startswith("> ") and asked[-1][0].endswith("\\"):
            asked[-1][0] = asked[-1][0][:-1] + line[2:]
        else:
            asked[-1][1].append(line)
    return asked


def alike(shown, printed):
    if TAKEN.search(shown) and TAKEN.search(printed):
        return True
    words = [re.sub(r"\s+", " ", NUMBER.sub("#", line)).strip() for line in (shown, printed)]
    if words[0] != words[1]:
        return False
    return all(abs(float(a) - float(b)) <= ROUNDING * max(abs(float(a)), abs(float(b)))
               for a, b in zip(NUMBER.findall(shown), NUMBER.findall(printed)))


def first_missing(shown, printed):
    """The first line of the page that is not among what was printed, in order; None if all are."""
    at, left_out = 0, True
    for line in shown:
        if line == "...":
            left_out = True
            continue
        places = range(at, len(printed)) if left_out else range(at, min(at + 1, len(printed)))
        place = next((k for k in places if alike(line, printed[k])), None)
        if place is None:
            return line
        at, left_out = place + 1, False
    return None


def shim(source, build, home):
    """A project folder as a reader has it, whose ./dev goes to what was built."""
    (home / "build").mkdir(parents=True)
    (home / "build/release").symlink_to(build)
    for name in ("studies", "docs", "python"):
        (home / name).symlink_to(source / name)
    script = home / "dev"
    script.write_text("#!/bin/sh\nverb=$1; shift\ncase $verb in\n"
                      f"run) exec {shlex.quote(str(build / 'equipoise'))} \"$@\" ;;\n"
                      f"python) PYTHONPATH={shlex.quote(str(build / 'python'))} MPLBACKEND=Agg exec /usr/bin/python3 -B \"$@\" ;;\n"
                      "*) echo \"no such verb: $verb\" >&2; exit 2 ;;\nesac\n")
    script.chmod(0o755)


def run(page, source, build, scratch):
    home = scratch / page.stem
    shutil.rmtree(home, ignore_errors=True)
    shim(source, build, home)
    environment = {**os.environ, "HOME": str(home), "NO_COLOR": "1"}
    count, wrong = 0, []
    for name, text in blocks(page.read_text()):
        if name:
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            (home / name).write_text(text)
            continue
        for command, shown in commands(text):
            count += 1
            done = subprocess.run(["bash", "-c", command], cwd=home, env=environment, capture_output=True, text=True)
            printed = done.stdout.splitlines() + done.stderr.splitlines()
            missing = first_missing(shown, printed)
            if missing is not None:
                wrong.append(f"{page.name}: $ {command}\n  does not print: {missing}\n  it prints:\n" + "\n".join("    " + line for line in printed))
            elif done.returncode and not shown:
                wrong.append(f"{page.name}: $ {command}\n  ends with {done.returncode}: {done.stderr}")
    if not count:
        wrong.append(f"{page.name}: no command")
    return count, wrong


def self_test():
    page = "<!-- file a.txt -->\n```text\nx\n```\n```console\n$ cat a.txt\nx\n$ ls \\\n> -a\n...\n```\n"
    assert list(blocks(page)) == [("a.txt", "x\n"), (None, "$ cat a.txt\nx\n$ ls \\\n> -a\n...\n")]
    assert commands("$ a\nb\n$ c \\\n> d\n") == [["a", ["b"]], ["c d", []]]
    assert first_missing(["a 1.00", "...", "c"], ["a 1.02", "b", "c"]) is None
    assert first_missing(["a 1.00"], ["a 1.20"]) == "a 1.00" and first_missing(["a", "c"], ["a", "b", "c"]) == "c"
    assert first_missing(["balanced 99 %"], ["unbalanced 99 %"]) == "balanced 99 %"


def main():
    self_test()
    source, build, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    failures = []
    for name in sys.argv[4:]:
        count, wrong = run(source / name, source, build, scratch)
        failures += wrong
        print(f"{name}: {count} commands, {len(wrong)} wrong")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
