"""Holds CONTRIBUTING's way of a start, from study file to printed share, to the sources: each stop stands on the line named.

    way_of_a_start_test.py SOURCE_DIR [--renew]     --renew writes the lines anew
"""
import pathlib
import re
import sys

STOP = re.compile(r"^\| (\d+) \| \[([\w./-]+):(\d+)\]\(([\w./-]+)#L\d+\) \| `([^`]+)` \|", re.MULTILINE)


def line_of(path, text):
    found = [number for number, line in enumerate(path.read_text().splitlines(), 1) if text in line]
    if len(found) != 1:
        raise SystemExit(f"{path}: '{text}' stands on {len(found)} lines, not on one")
    return found[0]


def main():
    root, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[1]) / "CONTRIBUTING.md"
    text, wrong = page.read_text(), []

    def checked(stop):
        number, name, line, path, what = stop.groups()
        now = line_of(root / path, what)
        if int(line) != now:
            wrong.append(f"stop {number}: {path} has '{what}' on line {now}, not {line}")
        return f"| {number} | [{name}:{now}]({path}#L{now}) | `{what}` |"

    renewed, count = STOP.subn(checked, text)
    if count != 12:
        raise SystemExit(f"{page}: {count} stops, not 12")
    if "--renew" in sys.argv:
        page.write_text(renewed)
    elif wrong:
        raise SystemExit("\n".join([*wrong, "./dev snapshots writes the lines anew"]))
    print(f"{count} stops stand where CONTRIBUTING says")


main()
