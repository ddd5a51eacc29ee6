"""tests/sentences.md names tests that exist. SOURCE: the project's folder."""

import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
page = (source / "tests/sentences.md").read_text()
cases = set()
for file in (source / "tests").rglob("*.cpp"):
    cases |= {f"{suite}.{case}" for suite, case in re.findall(r"^TEST(?:_[FP])?\((\w+), (\w+)\)", file.read_text(), re.M)}
named = re.findall(r"`([A-Z]\w+\.\w+)`", page)
files = re.findall(r"`(\w+_test(?:\.py)?)`", page)
missing = [name for name in named if name not in cases]
missing += [name for name in files if not list((source / "tests").rglob(name if name.endswith(".py") else name + ".cpp"))]
print("\n".join(f"tests/sentences.md names {name}, and there is no such test" for name in missing) or f"{len(named)} tests named")
sys.exit(1 if missing or len(named) < 20 else 0)
