# Checks that every room of src/equipoise includes only the rooms allowed to it (CONTRIBUTING.md, "The house").
"""Usage: layers_test.py REPOSITORY | layers_test.py --self-test

Prints every include of a room that its line in ROOMS does not name, or of the programs under apps/, and exits with 1 if
there is any. --self-test shows on small trees made for it that each kind of fault is found.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

# What each room may include besides itself, base and words. A line names only rooms above it, so that no circle can form.
# Adding a room to a line needs a reason in CONTRIBUTING.md.
ROOMS = {
    "words": "",
    "base": "",
    "running": "",
    "math": "",
    "drives": "",
    "model": "drives",
    "types": "model",
    "mechanics": "math drives model",
    "integrate": "drives model types mechanics",
    "statistics": "",
    "standards": "",
    "sampling": "model",
    "units": "model",
    "toml": "",
    "datasheet": "",
    "study": "drives model mechanics statistics sampling units toml datasheet",
    "echo": "model units toml study",
    "batch": "drives model types integrate",
    "transients": "drives model types mechanics integrate batch",
    "classification": "drives model types batch",
    "kernels": "model types batch transients classification",
    "periodic_orbits": "math model types mechanics integrate",
    "attractors": "math model types mechanics integrate transients periodic_orbits",
    "proof": "math drives model mechanics",
    "balanced_regions": "math model types mechanics batch classification periodic_orbits attractors",
    "trapping_regions":
        "running math drives model types mechanics batch classification kernels periodic_orbits attractors "
        "balanced_regions",
    "columns": "model types standards units study",
    "results": "drives model types mechanics statistics sampling units toml study proof columns",
    "io": "running",
    "result_files": "running model types statistics sampling study columns results io",
    "cell_files": "running results io result_files",
    "planes": "types units study columns results io result_files",
    "spin_up":
        "drives model types mechanics integrate sampling study batch transients classification kernels "
        "periodic_orbits results io",
    "rotor_family": "math model mechanics sampling study periodic_orbits attractors spin_up",
    "attractor_search":
        "running math model types mechanics sampling study batch classification kernels periodic_orbits "
        "attractors proof balanced_regions trapping_regions spin_up rotor_family",
    "start_runs":
        "model types mechanics statistics sampling study batch transients classification kernels "
        "periodic_orbits attractors columns results spin_up rotor_family attractor_search",
    "ensembles":
        "running model types statistics sampling study kernels attractors results result_files spin_up "
        "rotor_family attractor_search start_runs",
    "analyses":
        "running drives types mechanics sampling units study batch kernels periodic_orbits attractors proof "
        "balanced_regions columns results result_files spin_up rotor_family attractor_search start_runs "
        "ensembles",
    "continuation":
        "running model types mechanics toml study echo kernels periodic_orbits attractors results start_runs "
        "analyses",
    "basin_slices":
        "running math types mechanics statistics study echo kernels periodic_orbits attractors columns results io "
        "result_files spin_up rotor_family start_runs ensembles continuation toml",
    "stability":
        "running math model types mechanics study kernels periodic_orbits attractors results planes spin_up "
        "attractor_search start_runs continuation basin_slices",
    "cycles": "math model types mechanics periodic_orbits",
    "curves":
        "running math model types mechanics study kernels periodic_orbits attractors proof results planes spin_up "
        "attractor_search start_runs continuation basin_slices stability cycles",
    "sweeps":
        "running types units toml study kernels attractors balanced_regions results result_files cell_files "
        "attractor_search start_runs ensembles",
    "design":
        "running drives types statistics units toml datasheet study kernels attractors balanced_regions columns results "
        "result_files cell_files attractor_search start_runs ensembles sweeps",
    "trajectory": "running math drives model types mechanics integrate study results spin_up",
    "shown":
        "running model types mechanics study periodic_orbits attractors results spin_up ensembles trajectory",
    "drawing": "types study",
    "text": "model types mechanics statistics sampling units study results drawing",
    "decision": "mechanics statistics standards units study columns results drawing text",
    "answers": "types units study columns results drawing text decision",
    "design_words": "model study columns results drawing text",
    "changes": "running model units study attractor_search ensembles decision text",
    "reports": "model mechanics proof units study results drawing text decision answers design_words",
    "plots": "units study echo results drawing text decision answers reports",
    "charts": "model mechanics units study echo results planes drawing text answers plots",
    "explain":
        "math model mechanics datasheet study periodic_orbits attractors results spin_up rotor_family attractor_search "
        "start_runs stability text",
    "html":
        "types mechanics sampling toml study echo results drawing text decision answers reports plots explain",
    "literature": "statistics study results",
    "publications":
        "running drives math model types mechanics statistics study periodic_orbits results drawing ensembles "
        "stability cycles trajectory literature",
    "reproduction":
        "running drives types mechanics statistics sampling kernels attractors results result_files "
        "attractor_search ensembles analyses basin_slices trajectory drawing text reports plots literature",
}
OPEN_TO_ALL = ("base", "words")
MAY_INCLUDE = {room: {*OPEN_TO_ALL, room, *rooms.split()} for room, rooms in ROOMS.items()}
SOURCES = {".hpp", ".h", ".cpp", ".cc", ".cu", ".in"}
# Highway compiles a file once per target by including the path that this macro names.
INCLUDE = re.compile(r'^\s*#\s*(?:include|define\s+HWY_TARGET_INCLUDE)\s*["<]([^">]+)[">]', re.MULTILINE)


def sources_under(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES and path.is_file())


def includes_of(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def fault_in_room(path, room, included):
    """What is wrong with a file of `room` including `included`; None if nothing is."""
    if not included.startswith("equipoise/"):
        if ".." in Path(included).parts:
            return "a path upwards hides the room; name it from equipoise/"
        if (path.parent / included).exists():
            return "name the project's own headers from equipoise/"
        return None
    parts = included.split("/")
    if len(parts) < 3 or parts[1] not in ROOMS:
        return f"a room includes only files of rooms: {', '.join(ROOMS)}"
    if parts[1] not in MAY_INCLUDE[room]:
        return f"{room} may include only {', '.join([*OPEN_TO_ALL, *ROOMS[room].split()])}; see ROOMS in tests/layers_test.py"
    return None


def points_into_apps(root, path, included):
    apps = (root / "apps").resolve()
    candidates = [path.parent / included, root / included, apps / "equipoise" / included]
    return any(candidate.exists() and apps in candidate.resolve().parents for candidate in candidates)


def faults(root):
    """Yields one line for every forbidden include, and for every folder that is no room."""
    library = root / "src" / "equipoise"
    for folder in sorted(path for path in library.iterdir() if path.is_dir()):
        if folder.name not in ROOMS:
            yield f"{folder.relative_to(root)}: not a room; add its line to ROOMS in tests/layers_test.py"
            continue
        for path in sources_under(folder):
            for included in includes_of(path):
                fault = fault_in_room(path, folder.name, included)
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

    def test_named_rooms_and_base_are_allowed(self):
        self.assertEqual(self.faults_of({
            "src/equipoise/base/error.hpp": "#include <string>\n",
            "src/equipoise/drives/speed.hpp": '#include "equipoise/base/error.hpp"\n#include "hwy/highway.h"\n',
            "src/equipoise/drives/speed.cpp": '#include "equipoise/drives/speed.hpp"\n',
            "src/equipoise/trajectory/simulate.cpp": '#define HWY_TARGET_INCLUDE "equipoise/trajectory/simulate.cpp"\n',
            "apps/equipoise/main.cpp": '#include "equipoise/trajectory/simulate.hpp"\n#include "options.hpp"\n',
            "apps/equipoise/options.hpp": "",
        }), [])

    def test_message_says_what_is_allowed(self):
        found = self.faults_of({"src/equipoise/drives/speed.cpp": '#include "equipoise/study/study.hpp"\n'})
        self.assertEqual(len(found), 1)
        self.assertIn("drives may include only base, words", found[0])

    def test_every_way_of_writing_an_include_is_seen(self):
        for line in ('# include "equipoise/design/a.hpp"', "  #include <equipoise/design/a.hpp>",
                     '#include"equipoise/design/a.hpp"', '#define HWY_TARGET_INCLUDE "equipoise/design/a.hpp"',
                     '#include "../maps/a.hpp"'):
            self.assertEqual(len(self.faults_of({"src/equipoise/base/a-inl.hpp": line + "\n"})), 1, line)

    def test_lines_name_only_rooms_above_them(self):
        rooms = list(ROOMS)
        for room, line in ROOMS.items():
            self.assertLess(set(line.split()), set(rooms[:rooms.index(room) + 1]), room)

    def test_what_the_line_does_not_name_is_a_fault(self):
        pairs = [(room, other) for room in ROOMS for other in ROOMS]
        found = self.faults_of({f"src/equipoise/{room}/{other}.hpp": f'#include "equipoise/{other}/b.hpp"\n'
                                for room, other in pairs})
        wrong = {f"src/equipoise/{room}/{other}.hpp" for room, other in pairs
                 if other not in (*OPEN_TO_ALL, room, *ROOMS[room].split())}
        self.assertEqual(sorted(line.split(":")[0] for line in found), sorted(wrong))

    def test_header_without_a_room_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/design/a.cpp": '#include "equipoise/equipoise.hpp"\n'})), 1)

    def test_include_that_skips_the_project_name_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/design/a.cpp": '#include "a.hpp"\n',
                                             "src/equipoise/design/a.hpp": ""})), 1)

    def test_unknown_folder_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/helpers/a.hpp": ""})), 1)

    def test_including_a_program_is_a_fault(self):
        program = {"apps/equipoise/options.hpp": "", "src/equipoise/design/a.hpp": ""}
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
    print("\n".join(found) or f"{checked} files include only what their rooms may")
    return 1 if found or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
