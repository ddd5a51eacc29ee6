# Checks the house (CONTRIBUTING.md): what chapters of src/equipoise include, how large rooms are, what CONTRIBUTING says of them.
"""Usage: layers_test.py REPOSITORY | layers_test.py --self-test

Prints every fault and exits with 1 if there is any. --self-test shows on small trees made for it that each kind is found.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

# A chapter includes only itself and the chapters above it in this list.
CHAPTERS = (
    "core",
    "machine",
    "study",
    "results",
    "simulation",
    "attractors",
    "classification",
    "analyses",
    "report",
    "extras",
)
MOST_FILES = 25  # of a room
MOST_TOPS = 11  # folders of the repository
SOURCES = {".hpp", ".h", ".cpp", ".cc", ".cu", ".in"}
# Highway compiles a file once per target by including the path that this macro names.
INCLUDE = re.compile(r'^\s*#\s*(?:include|define\s+HWY_TARGET_INCLUDE)\s*["<]([^">]+)[">]', re.MULTILINE)
SAYS = re.compile(r"^// This room: ", re.MULTILINE)
ROW = re.compile(r"^\| `(\w+)` \| [^|]+ \| ([^|]+) \|$", re.MULTILINE)


def sources_under(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES and path.is_file())


def includes_of(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def folders_of(path):
    return sorted(p for p in path.iterdir() if p.is_dir() and not p.name.startswith((".", "__", "build")))


def fault_of_include(path, chapter, included):
    """What is wrong with a file of `chapter` including `included`; None if nothing is."""
    if not included.startswith("equipoise/"):
        if ".." in Path(included).parts:
            return "a path upwards hides the chapter; name it from equipoise/"
        if (path.parent / included).exists():
            return "name the project's own headers from equipoise/"
        return None
    parts = included.split("/")
    if len(parts) != 4 or parts[1] not in CHAPTERS:
        return f"only files of rooms are included: equipoise/CHAPTER/ROOM/FILE; chapters: {', '.join(CHAPTERS)}"
    allowed = CHAPTERS[:CHAPTERS.index(chapter) + 1]
    return None if parts[1] in allowed else f"{chapter} may include only {', '.join(allowed)}"


def points_into_apps(root, path, included):
    apps = (root / "apps").resolve()
    candidates = [path.parent / included, root / included, apps / "equipoise" / included]
    return any(candidate.exists() and apps in candidate.resolve().parents for candidate in candidates)


def faults_of_room(root, room):
    name = room.relative_to(root).as_posix()
    files = [path for path in room.iterdir() if path.is_file()]
    if len(files) > MOST_FILES:
        yield f"{name}: {len(files)} files; at most {MOST_FILES}: make two rooms of it"
    yield from (f"{path.relative_to(root)}: rooms have no folders" for path in folders_of(room))
    heads = sum(bool(SAYS.search(path.read_text(encoding="utf-8"))) for path in files if path.suffix == ".hpp")
    if heads != 1:
        yield f'{name}: {heads} headers begin with "// This room: "; one must'


def faults_of_table(root, rooms):
    """CONTRIBUTING.md has a row for each chapter, in order, with its rooms."""
    rows = [(row[0], re.findall(r"`(\w+)`", row[1])) for row in ROW.findall((root / "CONTRIBUTING.md").read_text(encoding="utf-8"))]
    rows = [row for row in rows if row[0] in CHAPTERS]
    if [row[0] for row in rows] != list(CHAPTERS):
        yield f"CONTRIBUTING.md: its table has rows for {[row[0] for row in rows]}, not for {list(CHAPTERS)}"
    for chapter, named in rows:
        if sorted(named) != sorted(rooms.get(chapter, [])):
            yield f"CONTRIBUTING.md: rooms of {chapter}: {', '.join(sorted(set(named) ^ set(rooms.get(chapter, []))))}"


def faults(root):
    """Yields a line for each fault."""
    tops = folders_of(root)
    if len(tops) > MOST_TOPS:
        yield f"{len(tops)} folders at the top, at most {MOST_TOPS}: {', '.join(path.name for path in tops)}"
    rooms = {}
    for chapter in folders_of(root / "src" / "equipoise"):
        name = chapter.relative_to(root).as_posix()
        if chapter.name not in CHAPTERS:
            yield f"{name}: not a chapter; see CHAPTERS in tests/layers_test.py"
            continue
        yield from (f"{path.relative_to(root)}: a file outside of rooms" for path in sources_under(chapter) if path.parent == chapter)
        rooms[chapter.name] = [room.name for room in folders_of(chapter)]
        for room in folders_of(chapter):
            yield from faults_of_room(root, room)
        for path in sources_under(chapter):
            for included in includes_of(path):
                if fault := fault_of_include(path, chapter.name, included):
                    yield f'{path.relative_to(root)}: "{included}": {fault}'
    yield from faults_of_table(root, rooms)
    for area in ("src", "tests", "bench", "python", "web"):
        for path in sources_under(root / area) if (root / area).is_dir() else []:
            for included in includes_of(path):
                if points_into_apps(root, path, included):
                    yield f'{path.relative_to(root)}: "{included}": nothing includes the programs'


class FaultsAreFound(unittest.TestCase):
    def faults_of(self, files, table=None):
        """Of a tree with these files, whose rooms say what they are for and stand in a table."""
        rooms = {tuple(path.split("/")[2:4]) for path in files if path.startswith("src/equipoise/") and path.count("/") > 3}
        rows = "".join(f"| `{c}` | its job | {', '.join(f'`{r}`' for one, r in sorted(rooms) if one == c) or 'none'} |\n"
                       for c in CHAPTERS)
        files = {"CONTRIBUTING.md": rows if table is None else table,
                 **{f"src/equipoise/{c}/{r}/head.hpp": "// This room: one.\n" for c, r in rooms}, **files}
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return list(faults(root))

    def test_own_chapter_and_those_above_are_allowed(self):
        self.assertEqual(self.faults_of({
            "src/equipoise/core/base/error.hpp": "#include <string>\n",
            "src/equipoise/machine/drives/speed.hpp": '#include "equipoise/core/base/error.hpp"\n#include "hwy/highway.h"\n',
            "src/equipoise/machine/model/speed.cpp": '#include "equipoise/machine/drives/speed.hpp"\n',
            "src/equipoise/simulation/batch/run.cpp": '#define HWY_TARGET_INCLUDE "equipoise/simulation/batch/run.cpp"\n',
            "apps/equipoise/main.cpp": '#include "equipoise/simulation/batch/run.hpp"\n#include "options.hpp"\n',
            "apps/equipoise/options.hpp": "",
        }), [])

    def test_chapters_below_are_not(self):
        pairs = {f"src/equipoise/{chapter}/a/{other}.hpp": (chapter, other) for chapter in CHAPTERS for other in CHAPTERS}
        found = self.faults_of({path: f'#include "equipoise/{other}/c/d.hpp"\n' for path, (_, other) in pairs.items()})
        wrong = {path for path, (chapter, other) in pairs.items() if CHAPTERS.index(other) > CHAPTERS.index(chapter)}
        self.assertEqual(sorted(line.split(":")[0] for line in found), sorted(wrong))

    def test_message_says_what_is_allowed(self):
        found = self.faults_of({"src/equipoise/machine/drives/speed.cpp": '#include "equipoise/study/a/study.hpp"\n'})
        self.assertIn("machine may include only core, machine", found[0])

    def test_every_way_of_writing_an_include_is_seen(self):
        for line in ('# include "equipoise/report/a/a.hpp"', "  #include <equipoise/report/a/a.hpp>",
                     '#include"equipoise/report/a/a.hpp"', '#define HWY_TARGET_INCLUDE "equipoise/report/a/a.hpp"',
                     '#include "../maps/a.hpp"'):
            self.assertEqual(len(self.faults_of({"src/equipoise/core/base/a-inl.hpp": line + "\n"})), 1, line)

    def test_header_without_a_room_is_a_fault(self):
        for included in ("equipoise/equipoise.hpp", "equipoise/core/error.hpp", "equipoise/helpers/a/b.hpp"):
            self.assertEqual(len(self.faults_of({"src/equipoise/extras/a/a.cpp": f'#include "{included}"\n'})), 1, included)

    def test_include_that_skips_the_project_name_is_a_fault(self):
        self.assertEqual(len(self.faults_of({"src/equipoise/core/base/a.cpp": '#include "a.hpp"\n',
                                             "src/equipoise/core/base/a.hpp": ""})), 1)

    def test_folders_and_files_out_of_place_are_faults(self):
        for path in ("src/equipoise/helpers/a.hpp", "src/equipoise/core/a.hpp"):
            self.assertEqual(len(self.faults_of({path: ""})), 1, path)
        self.assertIn("rooms have no folders", self.faults_of({"src/equipoise/core/base/deep/a.hpp": ""})[0])

    def test_large_rooms_are_faults(self):
        files = {f"src/equipoise/core/base/a{k}.cpp": "" for k in range(MOST_FILES - 1)}
        self.assertEqual(self.faults_of(files), [])
        self.assertEqual(len(self.faults_of({**files, "src/equipoise/core/base/b.cpp": ""})), 1)

    def test_rooms_say_once_what_they_are_for(self):
        twice = {"src/equipoise/core/base/a.hpp": "// A.\n// This room: one.\n"}
        self.assertEqual(len(self.faults_of(twice)), 1)
        self.assertEqual(len(self.faults_of({"src/equipoise/core/base/head.hpp": "// A.\n"})), 1)

    def test_table_names_chapters_and_rooms(self):
        files = {"src/equipoise/core/base/a.hpp": ""}
        rows = "".join(f"| `{c}` | its job | {'`base`' if c == 'core' else 'none'} |\n" for c in CHAPTERS)
        self.assertEqual(self.faults_of(files, rows), [])
        for wrong in (rows.replace("`base`", "`math`"), rows.replace("| none |", "| `math` |", 1), rows[rows.index("\n") + 1:]):
            self.assertGreaterEqual(len(self.faults_of(files, wrong)), 1, wrong)

    def test_many_folders_at_the_top_are_a_fault(self):
        self.assertEqual(self.faults_of({f"a{k}/b": "" for k in range(MOST_TOPS - 1)} | {"src/equipoise/a": "", "build/a": ""}), [])
        self.assertEqual(len(self.faults_of({f"a{k}/b": "" for k in range(MOST_TOPS)} | {"src/equipoise/a": ""})), 1)

    def test_including_a_program_is_a_fault(self):
        program = {"apps/equipoise/options.hpp": "", "src/equipoise/core/base/a.hpp": ""}
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
    print("\n".join(found) or f"{checked} files include only what their chapters may")
    return 1 if found or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
