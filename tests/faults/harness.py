"""Runs the program and says what no fault may ever lead to: death by a signal, a hang, silence, half a file."""
import os
import random
import resource
import shutil
import signal
import subprocess
import time

import classic_netcdf

LONGEST = 300  # seconds; everything here takes less than a tenth of it on an idle machine


class Finding(Exception):
    """The program did what it must not."""


class Bench:
    """The program, a folder for one case, and its random numbers."""

    def __init__(self, program, studies, folder, seed, quick):
        self.program, self.studies, self.folder, self.quick = program, studies, folder, quick
        self.random = random.Random(seed)
        self.study = os.path.join(studies, "paper", "table-2-omega-2.4.toml")
        if quick:  # in thicker oil, where the search takes half as long
            text = content(self.study).replace(b"drag = 0.05\n", b"drag = 0.1\n")
            self.study = self.path("row.toml")
            with open(self.study, "wb") as file:
                file.write(text)

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, *arguments, **options):
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "cwd": self.folder, **options}
        return subprocess.Popen([self.program, *map(str, arguments)], **options)

    def start_command(self, command, **options):
        """Another program, which starts this one."""
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=self.folder, **options)

    def children(self, pid):
        """Processes of this program under another one."""
        found = []
        for name in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                    parent = int(file.read().rsplit(")", 1)[1].split()[1])
                if parent == pid and os.path.realpath(f"/proc/{name}/exe") == os.path.realpath(self.program):
                    found.append(int(name))
            except (OSError, IndexError, ValueError):
                continue  # it has ended
        return found

    def run(self, *arguments, **options):
        return ended(self.start(*arguments, **options), arguments)

    def basin(self, *arguments):
        return ("basin", self.study, "--quiet", "--threads", "2", *arguments)


class Ended:
    def __init__(self, code, out, err, arguments):
        self.code, self.out, self.err, self.arguments = code, out, err, arguments

    def __str__(self):
        return f"{' '.join(map(str, self.arguments))}: exit {self.code}, standard error {self.err!r}"


def ended(process, arguments=()):
    """Waits for it. Never a hang, never a signal but the one that the case sent itself."""
    try:
        out, err = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise Finding(f"{' '.join(map(str, arguments))}: still at work after {LONGEST} s") from None
    done = Ended(process.returncode, out or b"", (err or b"").decode(errors="replace"), arguments)
    if done.code < 0 and done.code != -signal.SIGKILL:
        raise Finding(f"{done}: ended by signal {-done.code}")
    return done


def refused(done, *codes, words=()):
    """One line on standard error, one of these codes, nothing on standard output."""
    if done.code not in codes:
        raise Finding(f"{done}: expected exit {' or '.join(map(str, codes))}")
    lines = done.err.strip("\n").split("\n")
    if len(lines) != 1 or not lines[0].startswith("equipoise: "):
        raise Finding(f"{done}: expected one line")
    for word in words:
        if word not in done.err:
            raise Finding(f"{done}: does not say {word!r}")


def expect(condition, what):
    if not condition:
        raise Finding(what)


def limited(size):
    """To be called in the child: no file that it writes may grow beyond `size` bytes."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))


def catches_signals(process):
    """Whether it has come so far as to have its own answer to SIGTERM."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as file:
            caught = next(int(line.split()[1], 16) for line in file if line.startswith("SigCgt"))
    except (OSError, StopIteration):
        return False
    return bool(caught >> (signal.SIGTERM - 1) & 1)


def wait_until(condition, process):
    """False if the process ended first."""
    while not condition():
        if process.poll() is not None:
            return False
        time.sleep(0.002)
    return True


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Undisturbed:
    """A command that nothing disturbs: what its file must hold in every bit, and how long it took."""

    def __init__(self, bench, name, *arguments):
        self.arguments = arguments
        path = bench.path(name)
        begin = time.monotonic()
        done = bench.run(*arguments, "-o", path)
        self.seconds = time.monotonic() - begin
        expect(done.code == 0, f"{done}: the undisturbed {arguments[0]} failed")
        self.content = content(path)

    def finish(self, bench, path, what):
        done = bench.run(*self.arguments, "-o", path)
        expect(done.code == 0, f"{what}: {done}")
        expect(content(path) == self.content, f"{what}: other bytes than without it")
        expect(not os.path.exists(path + ".part"), f"{what}: the unfinished part is still there")


def kept_through_kills_and_full_disks(bench, command, rounds, moments=(0.4, 0.8)):
    """kill -9 and requests to stop at random moments, over and over at one file; then a file that may not grow. `moments`:
    shares of the undisturbed time between which they come."""
    path, kept = bench.path("killed.nc"), 0
    for k in range(rounds):
        process = bench.start(*command.arguments, "--threads", 1 + k % 2, "-o", path)
        wait_until(lambda: catches_signals(process), process)
        time.sleep(bench.random.uniform(*moments) * command.seconds)
        process.send_signal((signal.SIGKILL, signal.SIGTERM)[k % 2])
        ended(process)
        for left in filter(os.path.exists, (path, path + ".part")):
            inspected = bench.run("inspect", left)
            expect(inspected.code == 0, f"{inspected}: damage after a kill")
        kept += os.path.exists(path + ".part") or os.path.exists(path)
    command.finish(bench, path, "after every kill")
    expect(kept > 0, "no kill came while something was kept")
    for part in (0.05, 0.95):
        path = bench.path(f"full-{part}.nc")
        done = bench.run(*command.arguments, "-o", path, preexec_fn=limited(int(part * len(command.content))))
        refused(done, 1, words=("cannot be written",))
        command.finish(bench, path, f"a disk full at {part}")
    return f"{rounds} kills"


def result(path):
    """All that a file of results says but the time that it took."""
    dimensions, attributes, variables = classic_netcdf.read(path)
    return dimensions, {k: v for k, v in attributes.items() if k not in ("seconds", "cpu_seconds")}, variables


def same_result(path, reference, what):
    found = result(path)
    for name, one, other in zip(("dimensions", "attributes", "variables"), found, reference):
        for key in one.keys() | other.keys():
            if one.get(key) != other.get(key):
                raise Finding(f"{what}: {name} differ in {key} from those of a run without the fault")


def adds_up(path):
    """The summary counts all starts of the file, and no start lacks an outcome."""
    dimensions, _, variables = classic_netcdf.read(path)
    total = sum(int.from_bytes(variables["kind_count"][i:i + 4], "big")
                for i in range(0, len(variables["kind_count"]), 4))
    expect(total == dimensions["start"], f"{path}: {dimensions['start']} starts, and counts for {total}")


MPI = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def same_for_any_number_of_processes(bench, jobs, kills):
    """Jobs of (processes, command, more options) leave the file of an undisturbed command; then a process of one of them
    is killed, again and again, and another number of processes goes on."""
    if not shutil.which("mpirun") or b"MPI: not built in" in bench.run("--version").out:
        return "left out: needs MPI"
    path = bench.path("job.nc")

    def job(processes, what, *more):
        command = ["mpirun", "--oversubscribe", "-n", str(processes), bench.program, *map(str, what.arguments), *more, "-o", path]
        return bench.start_command(command, env=MPI)

    def over(started):
        """Waits for the processes themselves: mpirun (Open MPI 4.1 with PMIx 4.2) sometimes hangs when they are gone."""
        wait_until(lambda: bench.children(started.pid), started)
        wait_until(lambda: not bench.children(started.pid), started)
        try:
            started.wait(timeout=5)
        except subprocess.TimeoutExpired:
            started.kill()
        return ended(started)

    for processes, what, more in jobs:
        done = over(job(processes, what, *more))
        expect(content(path) == what.content, f"{done}: other bytes with {processes} processes {more}")
        expect(not os.path.exists(path + ".part"), f"{done}: the unfinished part is still there")
        os.remove(path)
    first = jobs[0][1]
    for _ in range(kills):
        running = job(3, first)
        time.sleep(bench.random.uniform(0.3, 1.0) * first.seconds)
        victims = bench.children(running.pid)
        if victims:
            os.kill(bench.random.choice(victims), signal.SIGKILL)
        over(running)
        if os.path.exists(path + ".part") or os.path.exists(path):
            expect(bench.run("inspect", path if os.path.exists(path) else path + ".part").code == 0, "damage")
    done = over(job(2, first))
    expect(content(path) == first.content, f"{done}: other bytes after {kills} dead processes")
    return f"{kills} processes killed"
