#!/usr/bin/env python3
# Checks that `./dev test` builds everything in the repository: what nobody compiles stops compiling.
"""Usage: built_test.py REPOSITORY [BUILD] | built_test.py --self-test BUILD

Exits with 1 if preset `dev` leaves out a part that CMakeLists.txt offers, or if there is a C++ source that neither the
build folder's default target nor that of the browser's engine compiles. --self-test shows that a source is missed where
only the program is built.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

# Built by other means: an outside project (test install.outside_project_finds_and_uses_the_library).
ELSEWHERE = {"tests/install/outside.cpp"}
# Only Clang builds it (preset fuzz): the fuzz target with libFuzzer. GCC builds the same target with its own driver.
OTHER_COMPILERS = {"EQUIPOISE_BUILD_FUZZER"}
FOLDERS = ("apps", "bench", "python", "src", "tests", "web/engine")


def preset(presets, name):
    """The cache variables of a configure preset, inherited ones too."""
    own = next(p for p in presets["configurePresets"] if p["name"] == name)
    return {**(preset(presets, own["inherits"]) if "inherits" in own else {}), **own.get("cacheVariables", {})}


def left_out(root):
    presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
    options = re.findall(r"option\((EQUIPOISE_BUILD_\w+) .* (\S+)\)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))
    variables = preset(presets, "dev")
    for option, default in options:
        # The program is built by default.
        if option not in OTHER_COMPILERS and variables.get(option, "OFF" if default == "OFF" else "ON") != "ON":
            yield f"CMakePresets.json: preset dev leaves out {option}"
    if variables.get("EQUIPOISE_WERROR") != "ON":
        yield "CMakePresets.json: preset dev lets warnings pass"
    for build in presets["buildPresets"]:
        if build["name"] == "dev" and "targets" in build:
            yield "CMakePresets.json: build preset dev names targets; it must build all"


def compiled(build, target):
    """Every source that the target needs, by ninja; for files that CMake joins, what they include."""
    done = subprocess.run(["ninja", "-C", build, "-t", "inputs", target], capture_output=True, text=True, check=True)
    for line in done.stdout.splitlines():
        path = (build / line.strip().strip("'")).resolve()
        yield path
        if path.name.startswith("unity_") and path.suffix == ".cxx" and path.exists():
            yield from (Path(p).resolve() for p in re.findall(r'#include "([^"]+)"', path.read_text(encoding="utf-8")))


def unbuilt(root, builds, target="all"):
    known = {path for build in builds if (build / "build.ninja").exists() for path in compiled(build, target)}
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.cpp")):
            name = path.relative_to(root).as_posix()
            if path.resolve() not in known and name not in ELSEWHERE:
                yield f"{name}: nothing that ./dev test builds compiles it"


def of_the_browser(line):
    return any(part in line for part in ("web/engine/", "_serial.cpp"))


def main(arguments):
    if arguments[0] == "--self-test":
        build = Path(arguments[1])
        root = Path(__file__).resolve().parent.parent
        missed = list(unbuilt(root, [build], "equipoise_program"))
        assert any(line.startswith("bench/main.cpp:") for line in missed), missed
        # A program with MPI leaves its stand-in out, and one without MPI what joins processes.
        of_either = ("apps/equipoise/no_team.cpp:", "apps/equipoise/team.cpp:", "apps/equipoise/post.cpp:")
        assert not any(line.startswith("apps/") and not line.startswith(of_either) for line in missed), missed
        return 0
    root = Path(arguments[0]).resolve()
    faults = list(left_out(root))
    if len(arguments) > 1:
        engine = root / "build" / "web-engine"
        found = list(unbuilt(root, [Path(arguments[1]), engine]))
        # Without Emscripten there is no engine, and its tests are left out.
        faults += found if (engine / "build.ninja").exists() else [f for f in found if not of_the_browser(f)]
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
