#!/usr/bin/env python3
"""What building and testing costs, in CPU seconds by target and by test: tests/cost.md (./dev cost).

usage: cost.py BUILD [--write]   configures and builds BUILD from nothing, runs every test but those labelled long,
                                 two at a time, and prints the table; --write: into tests
       cost.py --one LOG COMMAND... runs one compiler or linker, and adds what it took to LOG

What else the machine does stretches CPU seconds by some tenths, and seconds on the clock by any factor.
"""
import collections
import concurrent.futures
import os
import pathlib
import platform
import re
import shutil
import signal
import subprocess
import sys

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "tests/cost.md"


def timed(command, **more):
    """Exit code, CPU seconds with those of all children, output."""
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL, **more)
    text = child.stdout.read() if child.stdout else b""
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, usage.ru_utime + usage.ru_stime, text


def one(log, command):
    code, cpu, _ = timed(command)
    made = command[command.index("-o") + 1] if "-o" in command else ""
    with open(log, "a") as file:  # a line is written at once
        file.write(f"{cpu:.2f}\t{made}\n")
    return code


def built(build):
    """CPU seconds by target, and on the whole with those of CMake and the assembler."""
    shutil.rmtree(build, ignore_errors=True)
    build.mkdir(parents=True)
    log = build / "cost.tsv"
    launcher = f"{sys.executable};-B;{pathlib.Path(__file__).resolve()};--one;{log}"
    settings = [f"-DCMAKE_CXX_{tool}_LAUNCHER={launcher}" for tool in ("COMPILER", "LINKER")]
    whole = 0.0
    for command in (["cmake", "--preset", "dev", "-B", build, *settings], ["cmake", "--build", build]):
        code, cpu, _ = timed(command, cwd=ROOT, stdout=sys.stderr)
        whole += cpu
        if code:
            sys.exit(f"cost.py: {command[1]}: {code}")
    targets = collections.Counter()
    for line in log.read_text().splitlines():
        cpu, made = line.split("\t")
        target = re.search(r"CMakeFiles/(\w+)\.dir", made)
        kernels = target and re.search(r"/\w+_kernels\.", made)
        targets["kernels" if kernels else target[1] if target else "linking, configuration"] += float(cpu)
    return targets, whole


def tested(build):
    """Of each test: name, label, CPU seconds, whether it passed."""
    from run import listed  # here, since compilers are started through this script

    def run(more, test):
        environment = {**os.environ, **dict(entry.split("=", 1) for entry in more.get("ENVIRONMENT", ()))}
        code, cpu, text = timed(test["command"], cwd=more.get("WORKING_DIRECTORY", build), env=environment,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        text = text.decode(errors="replace")
        wanted = more.get("PASS_REGULAR_EXPRESSION")
        passed = any(re.search(one, text) for one in wanted) if wanted else code == 0
        print(f"{cpu:8.1f} s  {'' if passed else 'FAILED '}{test['name']}", file=sys.stderr, flush=True)
        if not passed:
            print(text, file=sys.stderr)
        return test["name"], (more["LABELS"] + ["house"])[0], cpu, passed

    tests = [(more, test) for _, more, test in listed(build)]
    done = [run(more, test) for more, test in tests if "FIXTURES_SETUP" in more]
    others = [(more, test) for more, test in tests if "FIXTURES_SETUP" not in more]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return done + list(pool.map(run, *zip(*others)))


def table(head, rows):
    return "\n".join([f"| {' | '.join(head)} |", "|" + "---|" * len(head), *(f"| {' | '.join(map(str, row))} |" for row in rows)])


def page(targets, whole, tests):
    labels, counts = collections.Counter(), collections.Counter(label for _, label, _, _ in tests)
    for _, label, cpu, _ in tests:
        labels[label] += cpu
    cpu_name = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    sums = sum(targets.values())
    return f"""# What building and testing costs

CPU seconds on one machine ({os.cpu_count()} cores, {cpu_name[1] if cpu_name else platform.processor()}), as `./dev cost --write` measures them: everything is built
from nothing, then every test but those labelled `long` is run. Compiling and linking took {whole:.0f} CPU seconds, tests
{sum(labels.values()):.0f}.

{table(["target", "CPU s"], [(name, f"{cpu:.0f}") for name, cpu in targets.most_common() if cpu >= 1] + [("the rest", f"{max(0, whole - sums):.0f}")])}

{table(["label", "tests", "CPU s"], [(name, counts[name], f"{cpu:.0f}") for name, cpu in labels.most_common()])}

The longest tests:

{table(["test", "CPU s"], [(f"`{name}`", f"{cpu:.1f}") for name, _, cpu, _ in sorted(tests, key=lambda t: -t[2])[:40]])}
"""


def main(arguments):
    if arguments[0] == "--one":
        return one(arguments[1], arguments[2:])
    build = pathlib.Path(arguments[0]).resolve()
    targets, whole = built(build)
    tests = tested(build)
    text = page(targets, whole, tests)
    if "--write" in arguments:
        PAGE.write_text(text)
    else:
        print(text)
    return 0 if all(passed for *_, passed in tests) else 1


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background would have its tests ignore it
    sys.exit(main(sys.argv[1:]))
