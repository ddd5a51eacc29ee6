#!/usr/bin/env python3
"""Usage: one_way_test.py REPOSITORY | one_way_test.py --self-test

What differs between systems and libraries is asked for in one place. Prints every other place, and exits with 1 if there is any.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

# What is looked for; where it may stand; what to use elsewhere.
WAYS = (
    (r"\b(?:strtod|strtof|strtod_l|atof|stod|stof)\s*\(", ("src/equipoise/core/base/read_number.cpp",),
     "read_number() or number_in() (core/base/read_number.hpp), which no locale changes"),
    (r"\bfrom_chars\s*\(",  # of integers, which all libraries read
     ("src/equipoise/core/base/read_number.cpp", "src/equipoise/analyses/basin_slices/slice_axis.cpp", "apps/equipoise/options.hpp",
      "apps/equipoise/sweep_command.cpp"),
     "read_number(): some libraries' std::from_chars() reads no doubles; a file that reads integers is named in WAYS"),
    (r"<(?:unistd|fcntl|sys/file|sys/stat|sys/ioctl)\.h>",
     ("src/equipoise/results/io/disk_file.cpp", "apps/equipoise/streams.cpp"),
     "results/io/disk_file.hpp for files, streams.hpp for terminals"),
)


def faults(root):
    for area in ("src/equipoise", "apps"):
        for path in sorted((root / area).rglob("*.[ch]pp")):
            name = path.relative_to(root).as_posix()
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                code = line.split("//")[0]
                for pattern, allowed, instead in WAYS:
                    if name not in allowed and re.search(pattern, code):
                        yield f"{name}:{number}: {code.strip()}: use {instead}"


class FaultsAreFound(unittest.TestCase):
    def test_each_way_is_seen_and_its_own_file_is_left_alone(self):
        lines = ("double a = std::strtod(t, nullptr);", "std::from_chars(a, b, c);", "#include <unistd.h>")
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "src/equipoise/core/base").mkdir(parents=True)
            (root / "src/equipoise/core/base/read_number.cpp").write_text("\n".join(lines[:2]), encoding="utf-8")
            (root / "src/equipoise/core/base/other.hpp").write_text("\n".join((*lines, "// strtod( is a C function")),
                                                               encoding="utf-8")
            self.assertEqual([f.split(":")[1] for f in faults(root)], ["1", "2", "3"])


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        unittest.main(argv=sys.argv[:1])
    found = list(faults(Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)
