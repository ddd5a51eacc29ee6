#!/usr/bin/env python3
"""clang-tidy finds nothing of .clang-tidy's list in files that have changed since everything was tested (the commit that
wrote tests/passed.json); in the run of minutes in the first few of them, with EQUIPOISE_TESTS=all in all of them and in
the rooms named here.

usage: tidy_test.py SOURCE BUILD [FILE...]; with files: just those
"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys

ROOMS = ["core/base", "results/io", "study/toml", "core/statistics"]  # of few includes: seconds a file
MOST = 6  # files in the run of minutes, five to fifteen seconds each

source, build = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def git(*words):
    return subprocess.run(["git", "-C", source, *words], check=True, capture_output=True, text=True).stdout.split()


def changed():
    """C++ sources that differ from that commit, or from the one before the last; none outside of a checkout."""
    try:
        since = git("log", "-1", "--format=%H", "--", "tests/passed.json") or ["HEAD~1"]
        names = git("diff", "--name-only", "--diff-filter=d", since[0])
    except (subprocess.CalledProcessError, FileNotFoundError):
        return []
    return [source / n for n in names if n.startswith(("src/equipoise/", "apps/equipoise/")) and n.endswith(".cpp")]


def mpi():
    """Where the job's headers are, if MPI is installed."""
    try:
        done = subprocess.run(["mpicxx", "--showme:incdirs"], check=True, capture_output=True, text=True)
    except (subprocess.CalledProcessError, FileNotFoundError):
        return []
    return [word for folder in done.stdout.split() for word in ("-isystem", folder)]


MPI = mpi()


def tidy(path):
    command = ["clang-tidy", "--quiet", str(path), "--", "-std=c++20", "-ffp-contract=off", f"-I{source / 'src'}",
               f"-I{build / 'src/equipoise/include'}", f"-I{source / 'apps/equipoise'}", "-isystem", "/usr/include/eigen3", *MPI]
    done = subprocess.run(command, capture_output=True, text=True, cwd=source)
    return path, done.returncode, done.stdout + done.stderr


def main():
    files = [pathlib.Path(a).resolve() for a in sys.argv[3:]]
    left = []
    if not files and os.environ.get("EQUIPOISE_TESTS") == "all":
        files = changed() + [f for room in ROOMS for f in sorted((source / "src/equipoise" / room).glob("*.cpp"))]
    elif not files:
        files = changed()
        files, left = files[:MOST], files[MOST:]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        done = list(pool.map(tidy, dict.fromkeys(files)))
    bad = [text for _, code, text in done if code != 0]
    print(*bad, f"{len(done)} files read, {len(bad)} with findings", sep="\n")
    if left:
        print("left for --all:", ", ".join(path.name for path in left))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
