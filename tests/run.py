#!/usr/bin/env python3
"""Runs the tests of a build folder that may have a new answer.

usage: run.py BUILD [--all] [ARGUMENT of ctest...]

A test is not run again while the files that it depends on are as they were when it last passed in this folder. What takes
long (labels full, and those in KEPT) is not run either while those are as they were when everything was run last, on
any machine: tests/passed.json says so. --all runs everything, in full size, and keeps in that file what has passed. With
arguments for ctest (-R basin), all that those choose are run.
"""
import hashlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = ROOT / "tests/passed.json"
BUILT_BY = ["CMakeLists.txt", "CMakePresets.json", "cmake/", "src/equipoise/CMakeLists.txt"]
PROGRAM = ["src/", "apps/", "studies/", *BUILT_BY]
# Where the program's words come from: documentation quotes them.
WORDS = ["src/equipoise/report/", "src/equipoise/extras/charts/", "src/equipoise/study/", "src/equipoise/analyses/"]

# What the tests of a label depend on: files, and folders (ending with a slash).
DEPENDS = {
    "cli": [*PROGRAM, "tests/cli/", "tests/snapshots/"],
    "published": PROGRAM,
    "python": ["src/", "python/", "studies/", "docs/evidence/publications.md", "docs/evidence/publications.csv",
               "docs/reference/python.md", *BUILT_BY],
    "types": ["python/equipoise/", "pyproject.toml"],
    "audit": ["src/", "tests/audit/", *BUILT_BY],
    "fuzz": ["tests/fuzz/", "studies/", "src/equipoise/study/", "src/equipoise/core/"],
}
# Labels whose tests take minutes. ./dev test runs them if one of these files has changed since all were run.
KEPT = {
    "web": ["web/", "tests/web/", "tests/web.cmake", "cmake/web.cmake", "src/equipoise/core/base/", "src/equipoise/CMakeLists.txt"],
    "outside": [*BUILT_BY, "packaging/", "examples/", "tests/install/", "tests/install.cmake", "setup.py", "pyproject.toml",
                "MANIFEST.in", "python/CMakeLists.txt", "python/portable_wheel.py", "python/tests/test_wheel.py"],
    "site": ["docs/", "python/equipoise/"],
    "lessons": [*WORDS, "docs/tutorials/", "docs/how-to/", "docs/explanation/next-to-peers.md", "README.md", "tests/docs/",
                "examples/", "apps/", "studies/"],
    "notebooks": ["python/notebooks/", "python/equipoise/", "python/tests/test_notebooks.py", "python/tests/notebooks.py"],
    "pictures": ["python/equipoise/", "python/tests/test_plot.py"],
    "bench": ["bench/", "CMakePresets.json"],
    "sentences": [*WORDS, "tests/audit/"],
    "faults": ["tests/faults/", "apps/", "src/equipoise/results/", *(f"src/equipoise/{room}/" for room in
               ("core/running", "analyses/sweeps", "analyses/ensembles", "analyses/basin_slices", "extras/planes"))],
}


def files():
    """Every file of the project with a mark of its content; none outside of a checkout, where everything is run."""

    def content(path):
        if path.name == "CMakeLists.txt" or path.suffix == ".cmake":  # what builds everything says the same with other comments
            return b"\n".join(line for line in path.read_bytes().splitlines() if not line.lstrip().startswith(b"#"))
        return path.read_bytes()

    done = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True)
    names = [name for name in done.stdout.splitlines() if (ROOT / name).is_file() and ROOT / name != RECORD]
    return {name: hashlib.sha1(content(ROOT / name)).hexdigest() for name in names}


def mark(marks, paths):
    """One mark of all files under these paths."""
    of = sorted(f"{name} {m}" for name, m in marks.items() if any(name == p or p[-1] == "/" and name.startswith(p) for p in paths))
    return hashlib.sha1("\n".join(of).encode()).hexdigest()


def rooms(marks):
    """Of each room of the library ("core/base"): the rooms of which its files include some."""
    of = {}
    for name in (n for n in marks if re.match(r"src/equipoise/\w+/\w+/[\w-]+\.(cpp|hpp|inc)$", n)):
        of.setdefault("/".join(name.split("/")[2:4]), set()).update(
            re.findall(r'"equipoise/(\w+/\w+)/', (ROOT / name).read_text()))
    return of


def rooms_below(rooms, may_include):
    """These rooms of the library and all that they stand on."""
    found, left = set(), list(rooms)
    while left:
        room = left.pop()
        if room not in found:
            found.add(room)
            left += may_include.get(room, ())
    return found


def included(marks):
    """Of each source and header of the tests: the other files of the tests that it includes."""
    of = {}
    for name in (n for n in marks if n.startswith("tests/") and n.endswith((".cpp", ".hpp"))):
        near = (os.path.normpath(f"{os.path.dirname(name)}/{i}") for i in re.findall(r'#include "([^"]+)"', (ROOT / name).read_text()))
        of[name] = {n for n in near if n in marks}
    return of


def sources_of(test, include):
    """A test's own source, all headers of the tests that it reaches, and the helpers that define what those declare."""
    found, left = set(), {test}
    while left:
        name = left.pop()
        found.add(name)
        helpers = {n for n in include if n.endswith(".cpp") and not n.endswith("_test.cpp") and name in include[n]}
        left |= (include[name] | (helpers if name.endswith(".hpp") else set())) - found
    return found


def suites(marks):
    """Of each suite of the test programs, as ctest names it: what its sources depend on."""
    found, include, may_include = {}, included(marks), rooms(marks)
    for name in (n for n in include if re.match(r"tests/(unit|equivalence|order|literature)/\w+_test\.cpp$", n)):
        sources = sources_of(name, include)
        text = "\n".join((ROOT / n).read_text() for n in sources)
        reached = rooms_below(re.findall(r'"equipoise/(\w+/\w+)/', text), may_include)
        if "equipoise/equipoise.hpp" in text or "equipoise/paper.hpp" in text:
            reached = may_include
        depends = [*BUILT_BY, "tests/CMakeLists.txt", "tests/snapshots/", "studies/", *sources,
                   *(f"src/equipoise/{room}/" for room in reached)]
        if "in_docs(" in text or "/docs/" in text:
            depends.append("docs/")
        for suite in re.findall(r"^\w*TEST\w*\((\w+),", (ROOT / name).read_text(), re.MULTILINE):
            for entry in (f"{name.split('/')[1]}.{suite}", f"{name.split('/')[1]}.{suite}.slow"):
                found.setdefault(entry, []).extend(depends)
    return found


def listed(build):
    """Every test of a build folder but the long ones: its number to ctest, its properties (LABELS: none is []), itself."""
    done = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True)
    for number, test in enumerate(json.loads(done.stdout)["tests"], 1):
        more = {"LABELS": [], **{p["name"]: p["value"] for p in test.get("properties", ())}}
        if "long" not in more["LABELS"]:
            yield number, more, test


def main():
    build, arguments = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    everything = "--all" in arguments
    arguments = [a for a in arguments if a != "--all"]
    labels, numbers = {}, {}
    for number, more, test in listed(build):
        labels[test["name"]], numbers[test["name"]] = (more["LABELS"] + [""])[0], str(number)
    marks, own_record = files(), build / "passed.json"
    passed = json.loads(own_record.read_text()) if own_record.exists() else {}
    kept = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    of_suites, of_labels = suites(marks), {label: mark(marks, paths) for label, paths in {**DEPENDS, **KEPT}.items()}

    def of_test(name, label):
        if name in of_suites:
            return mark(marks, of_suites[name])
        return of_labels.get(name.split(".")[0] if label == "full" else label, "")

    now = {name: of_test(name, label) for name, label in labels.items()}

    chosen, left = list(labels), {}
    if marks and not everything and not arguments:
        chosen = []
        for name, label in labels.items():
            if now[name] and passed.get(name) == now[name]:
                left.setdefault("have passed with these files before", []).append(name)
            elif label in ("full", *KEPT) and kept.get(name) == now[name]:
                left.setdefault("passed with these files when everything was run", []).append(name)
            else:
                chosen.append(name)
    for why, names in left.items():
        print(f"{len(names)} tests {why}", flush=True)
    if not chosen:
        print("Nothing is left to be run. --all runs everything.")
        return 0
    report = build / "tests.xml"
    # By number, and then without -LE, which would number anew what it leaves.
    select = ["-LE", "^long$", *arguments] if arguments else ["-I", "0,0,0," + ",".join(numbers[name] for name in chosen)]
    if everything:
        os.environ["EQUIPOISE_TESTS"] = "all"  # tests of full size (tests/support/sizes.hpp)
    code = subprocess.run(["ctest", "--test-dir", build, "--output-on-failure", "--parallel", str(os.cpu_count()),
                           "--output-junit", report, *select], cwd=ROOT).returncode
    if not report.exists():
        return code or 1
    states = {case.get("name"): case.get("status") for case in xml.parse(report).getroot().iter("testcase")}
    report.unlink()
    if missed := [] if arguments else [name for name in chosen if name not in states]:
        print("run.py: asked for and not run:", *missed)
        code = code or 1
    for name, state in states.items():
        if state == "run" and now.get(name):  # one that is left out for want of something it needs has not passed
            passed[name] = now[name]
        else:
            passed.pop(name, None)
    own_record.write_text(json.dumps(passed, indent=0, sort_keys=True))
    if everything and marks:
        for name, state in states.items():
            kept.pop(name, None)
            if state == "run" and labels[name] in ("full", *KEPT):
                kept[name] = now[name]
        RECORD.write_text(json.dumps({name: kept[name] for name in sorted(kept) if name in labels}, indent=0) + "\n")
        print(f"{RECORD.relative_to(ROOT)} says what has passed")
    return code


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background would have its tests ignore it
    sys.exit(main())
