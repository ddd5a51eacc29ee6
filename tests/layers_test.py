#!/usr/bin/env python3
# Checks that includes run one way through the layers of src/equipoise (CONTRIBUTING.md, "The house").
"""Usage: layers_test.py REPOSITORY | layers_test.py --self-test

Prints every include that points from a layer to one on its right, or into the programs under apps/, and exits with 1 if
there is any. --self-test shows on small trees made for it that each kind of fault is found.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

LAYERS = [
    "base", "math", "model", "integrate", "statistics", "sampling", "study", "lanes", "transients", "deciding",
    "kernels", "orbits", "motions", "proof", "traps", "results", "files", "store", "spin_up", "discovery", "fates",
    "basins", "branches", "maps", "sweeps", "design", "trajectory", "drawing", "report", "explain", "pages", "literature",
    "reproduction",
]
SOURCES = {".hpp", ".h", ".cpp", ".cc", ".cu", ".in"}
# Highway compiles a file once per target by including the path that this macro names.
INCLUDE = re.compile(r'^\s*#\s*(?:include|define\s+HWY_TARGET_INCLUDE)\s*["<]([^">]+)[">]', re.MULTILINE)


def sources_under(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES and path.is_file())


def includes_of(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def fault_in_layer(path, layer, included):
    """What is wrong with a file of `layer` including `included`; None if nothing is."""
    if not included.startswith("equipoise/"):
        if ".." in Path(included).parts:
            return "a path upwards hides the layer; name it from equipoise/"
        if (path.parent / included).exists():
            return "name the project's own headers from equipoise/"
        return None
    parts = included.split("/")
    if len(parts) < 3 or parts[1] not in LAYERS:
        return f"a layer includes only files of the layers: {', '.join(LAYERS)}"
    if LAYERS.index(parts[1]) > LAYERS.index(layer):
        return f"{layer} is to the left of {parts[1]}"
    return None


def points_into_apps(root, path, included):
    apps = (root / "apps").resolve()
    candidates = [path.parent / included, root / included, apps / "equipoise" / included]
    return any(candidate.exists() and apps in candidate.resolve().parents for candidate in candidates)


def faults(root):
    """Yields one line for every forbidden include, and for every folder that is no layer."""
    library = root / "src" / "equipoise"
    for folder in sorted(path for path in library.iterdir() if path.is_dir()):
        if folder.name not in LAYERS:
            yield f"{folder.relative_to(root)}: not a layer; add its place to LAYERS in tests/layers_test.py"
            continue
        for path in sources_under(folder):
            for included in includes_of(path):
                fault = fault_in_layer(path, folder.name, included)
                if fault:
                    yield f'{path.relative_to(root)}: "{included}": {fault}'
    for area in ("src", "tests", "bench", "python", "web"):
        for path in sources_under(root / area) if (root / area).is_dir() else []:
            for included in includes_of(path):
                if points_into_apps(root, path, included):
                    yield f'{path.relative_to(root)}: "{included}": nothing includes the programs'


class FaultsAreFound(unittest.TestCase):
    def faults_of(self, files):
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return list(faults(root))

    def test_leftward_and_sideways_includes_are_allowed(self):
        self.assertEqual(self.faults_of({
            "src/equipoise/base/error.hpp": "#include <string>\n",
            "src/equipoise/model/speed.hpp": '#include "equipoise/base/error.hpp"\n#include "hwy/highway.h"\n',
            "src/equipoise/model/speed.cpp": '#include "equipoise/model/speed.hpp"\n',
            "src/equipoise/trajectory/simulate.cpp": '#define HWY_TARGET_INCLUDE "equipoise/trajectory/simulate.cpp"\n',
            "apps/equipoise/main.cpp": '#include "equipoise/trajectory/simulate.hpp"\n#include "options.hpp"\n',
            "apps/equipoise/options.hpp": "",
        }), [])

    def test_rightward_include_is_a_fault(self):
        found = self.faults_of({"src/equipoise/model/speed.cpp": '#include "equipoise/study/study.hpp"\n'})
        self.assertEqual(len(found), 1)
        self.assertIn("model is to the left of study", found[0])

    def test_every_way_of_writing_an_include_is_seen(self):
        for line in ('# include "equipoise/maps/a.hpp"', "  #include <equipoise/maps/a.hpp>",
                     '#include"equipoise/maps/a.hpp"', '#define HWY_TARGET_INCLUDE "equipoise/maps/a.hpp"',
                     '#include "../maps/a.hpp"'):
            self.assertEqual(len(self.faults_of({"src/equipoise/base/a-inl.hpp": line + "\n"})), 1, line)

    def test_every_pair_of_layers_has_one_direction(self):
        for i, left in enumerate(LAYERS):
            for right in LAYERS[i + 1:]:
                rightward = {f"src/equipoise/{left}/a.hpp": f'#include "equipoise/{right}/b.hpp"\n'}
                leftward = {f"src/equipoise/{right}/b.hpp": f'#include "equipoise/{left}/a.hpp"\n'}
                self.assertEqual(len(self.faults_of(rightward)), 1)
                self.assertEqual(self.faults_of(leftward), [])

    def test_header_without_a_layer_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/maps/a.cpp": '#include "equipoise/equipoise.hpp"\n'})), 1)

    def test_include_that_skips_the_project_name_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/maps/a.cpp": '#include "a.hpp"\n',
                                             "src/equipoise/maps/a.hpp": ""})), 1)

    def test_unknown_folder_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/helpers/a.hpp": ""})), 1)

    def test_including_a_program_is_a_fault(self):
        program = {"apps/equipoise/options.hpp": "", "src/equipoise/maps/a.hpp": ""}
        for line in ('#include "options.hpp"', '#include "apps/equipoise/options.hpp"',
                     '#include "../apps/equipoise/options.hpp"'):
            self.assertEqual(len(self.faults_of({**program, "tests/a.cpp": line + "\n"})), 1, line)


def main():
    if sys.argv[1:] == ["--self-test"]:
        unittest.main(argv=sys.argv[:1])
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    root = Path(sys.argv[1]).resolve()
    found = list(faults(root))
    checked = len(sources_under(root / "src" / "equipoise"))
    print("\n".join(found) or f"{checked} files include leftwards only")
    return 1 if found or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
