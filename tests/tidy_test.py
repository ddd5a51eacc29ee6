#!/usr/bin/env python3
"""clang-tidy finds nothing of .clang-tidy's list in the rooms named here, nor in files that the last commit or the working
tree changed. Two files at a time; files that do not fit into the time are named, and are no failure.

usage: tidy_test.py SOURCE BUILD [FILE...]; with files: just those, without a limit of time
"""
import concurrent.futures
import pathlib
import subprocess
import sys
import time

ROOMS = ["base", "io", "toml", "statistics"]  # of few includes: seconds a file
MOST = 150.0  # seconds
NOT_ALONE = ("-inl.hpp", ".inc", ".in")

source, build = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def changed():
    """C++ sources that differ from the commit before the last; none outside of a checkout."""
    try:
        names = subprocess.run(["git", "-C", source, "diff", "--name-only", "--diff-filter=d", "HEAD~1"], check=True,
                               capture_output=True, text=True).stdout.split()
    except (subprocess.CalledProcessError, FileNotFoundError):
        return []
    return [source / n for n in names if n.startswith(("src/equipoise/", "apps/equipoise/")) and n.endswith(".cpp")]


def tidy(path):
    command = ["clang-tidy", "--quiet", str(path), "--", "-std=c++20", "-ffp-contract=off", f"-I{source / 'src'}",
               f"-I{build / 'src/equipoise/include'}", f"-I{source / 'apps/equipoise'}", "-isystem", "/usr/include/eigen3"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=source)
    return path, done.returncode, done.stdout + done.stderr


def main():
    asked = [pathlib.Path(a).resolve() for a in sys.argv[3:]]
    files = asked or changed() + [f for room in ROOMS for f in sorted((source / "src/equipoise" / room).glob("*.cpp"))]
    files = list(dict.fromkeys(files))
    begin, bad, left = time.monotonic(), 0, []

    def in_time(path):
        if not asked and time.monotonic() - begin > MOST:
            return path, None, ""
        return tidy(path)

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for path, code, text in pool.map(in_time, files):
            if code is None:
                left.append(path.name)
            elif code != 0:
                bad += 1
                print(text)
    print(f"{len(files) - len(left)} files read, {bad} with findings")
    if left:
        print("no time was left for", ", ".join(left))
    if not files or len(left) == len(files):
        sys.exit("tidy_test: no file was read")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
