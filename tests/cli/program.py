"""The program under test, the studies, and its answers."""
import json
import os
import subprocess
import sys

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=600, check=False, **options)


def answer(*arguments):
    done = run(*arguments, "--json", "--quiet")
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"{arguments}: exit {done.returncode}, {done.stderr}")
    return json.loads(done.stdout)
