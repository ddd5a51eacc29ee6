"""The program as a whole: outputs that fail, studies that are damaged."""
import os
import signal
import subprocess
import time

from harness import Finding, catches_signals, content, ended, expect, limited, refused, wait_until


def commands(bench):
    """Every command, as quick as it gets."""
    study = bench.study
    few = ("--starts", "64", "--quiet")
    return {
        "--version": ("--version",),
        "--help": ("--help",),
        "explain": ("explain", study),
        "explain --json": ("explain", study, "--json"),
        "basin": ("basin", study, *few),
        "basin --json": ("basin", study, *few, "--json"),
        "basin --start-index": ("basin", study, "--start-index", "3", "--quiet"),
        "simulate": ("simulate", study, "--until", "10"),
        "certify": ("certify", study),
        "attractors": ("attractors", study, *few),
        "attractors --along": ("attractors", study, "--along", "speed.speed=2.4:2.4:0.1", "--quiet"),
        "reproduce": ("reproduce", "table-7", "--law", "kinematic", "--starts", "20", "--quiet"),
    }


def lost_outputs(bench):
    """Standard output closed, or a device that is full: exit 1 and one line."""
    chosen = commands(bench)
    if bench.quick:
        for name in ("attractors", "attractors --along", "reproduce", "basin --json"):
            del chosen[name]
    for name, arguments in chosen.items():
        with open("/dev/full", "wb") as full:
            refused(bench.run(*arguments, stdout=full), 1)
        try:
            refused(bench.run(*arguments, stdout=None, preexec_fn=lambda: os.close(1)), 1)
        except Finding as finding:
            raise Finding(f"{name} with standard output closed: {finding}") from None
    return f"{len(chosen)} commands"


def writers(bench):
    """Every command that writes a file, with one of more than 600 bytes."""
    study = bench.study
    along = ("attractors", study, "--along", "speed.speed=2.4:2.4:0.1", "--quiet")
    chosen = {
        "a.csv": ("simulate", study, "--until", "50", "-o"),
        "a.nc": ("simulate", study, "--until", "50", "-o"),
        "a.json": ("certify", study, "-o"),
    }
    if not bench.quick:
        chosen["b.nc"] = (*along, "-o")
        chosen["b.svg"] = (*along, "--plot")
        chosen["c.html"] = ("reproduce", "table-7", "--law", "kinematic", "--starts", "20", "--quiet", "--report")
    return chosen


def other_files(bench):
    """A file of any command that cannot be written whole: exit 1, one line, and the old one is still there."""
    chosen = writers(bench)
    for name, arguments in chosen.items():
        path = bench.path(name)
        done = bench.run(*arguments, path)
        expect(done.code in (0, 3), f"{done}")
        before = content(path)
        size = min(600, len(before) // 2)
        refused(bench.run(*arguments, path, preexec_fn=limited(size)), 1)
        expect(content(path) == before, f"{name}: a full disk changed the old file")
        os.remove(path)
        refused(bench.run(*arguments, path, preexec_fn=limited(size)), 1)
        expect(not os.path.exists(path), f"{name}: a full disk left half a file")
    return f"{len(chosen)} kinds of file"


def bad_places(bench):
    """Places where nothing can be written: exit 2 and why, before any work."""
    places = {"missing/dir/a.nc": ("missing/dir", "does not exist"), "": ("--output",), ".": ("is a folder",),
              "/dev/null/a.nc": ("not a folder",)}
    for place, words in places.items():
        refused(bench.run("basin", bench.study, "--quiet", "-o", place), 2, words=words)
        refused(bench.run("certify", bench.study, "-o", place), 2, words=words)
    return f"{len(places)} places"


class Mutator:
    """Seeds, and the words of the study reader's fuzz dictionary put where they may hurt."""

    def __init__(self, bench, here):
        self.random = bench.random
        self.seeds = []
        for top in (os.path.join(here, "..", "fuzz", "seeds"), bench.studies):
            for folder, _, names in sorted(os.walk(top)):
                self.seeds += [content(os.path.join(folder, n)) for n in sorted(names) if n.endswith(".toml")]
        self.tokens = []
        for line in content(os.path.join(here, "..", "fuzz", "study.dict")).splitlines():
            if line.startswith(b'"'):
                self.tokens.append(line.strip()[1:-1].decode().encode().decode("unicode_escape").encode("latin-1"))

    def study(self):
        text = bytearray(self.random.choice(self.seeds))
        for _ in range(self.random.randint(1, 5)):
            self.mutate(text)
        return bytes(text[:16384])

    def mutate(self, text):
        pick = self.random
        at = pick.randrange(len(text) + 1)
        kind = pick.randrange(7)
        if kind == 0 and text:
            text[pick.randrange(len(text))] ^= 1 << pick.randrange(8)
        elif kind == 1:
            del text[at:at + pick.randint(1, 40)]
        elif kind == 2:
            text[at:at] = pick.choice(self.tokens)
        elif kind == 3:
            text[at:] = pick.choice(self.seeds)[pick.randrange(200):]
        elif kind == 4:
            text[at:at] = pick.randbytes(pick.randint(1, 8))
        else:
            self.replace_number(text)

    # Extreme numbers keep a text a valid study more often than any other change.
    def replace_number(self, text):
        digits = [i for i, c in enumerate(text) if c in b"0123456789"]
        if not digits:
            return
        begin = end = self.random.choice(digits)
        while begin > 0 and text[begin - 1] in b"0123456789.eE+-":
            begin -= 1
        while end < len(text) and text[end] in b"0123456789.eE+-":
            end += 1
        values = (b"0", b"-1", b"1e-300", b"1e300", b"1e18", b"inf", b"nan", b"8", b"0.5", b"3.7", b"1e-9", b"1000")
        text[begin:end] = self.random.choice(values)


def answered(done, text):
    """Exit 0, or 1 or 2 with one line."""
    try:
        expect(done.code in (0, 1, 2), f"{done}")
        if done.code != 0:
            refused(done, 1, 2)
    except Finding as finding:
        raise Finding(f"{finding}\nthe study:\n{text.decode(errors='replace')}") from None


def damaged_studies(bench):
    """Studies with faults in them, explained; every so often one that is still a study is run, and can be stopped."""
    mutator = Mutator(bench, os.path.dirname(os.path.abspath(__file__)))
    rounds = 150 if bench.quick else 2000
    path = bench.path("study.toml")
    studies = stopped = 0
    for _ in range(rounds):
        text = mutator.study()
        with open(path, "wb") as file:
            file.write(text)
        done = bench.run("explain", path)
        answered(done, text)
        if done.code != 0:
            continue
        studies += 1
        if studies % (30 if bench.quick else 20) == 1:
            stopped += run_and_stop(bench, path, text)
    return f"{rounds} studies, {studies} of them still some, {stopped} stopped at work"


def run_and_stop(bench, path, text):
    """Half a second of its ensemble, then Ctrl-C: over within seconds. Whether it had to be stopped."""
    process = bench.start("basin", path, "--starts", "100000", "--quiet")
    wait_until(lambda: catches_signals(process), process)
    try:
        process.wait(timeout=0.5)
        answered(ended(process, ("basin", path)), text)
        return 0
    except subprocess.TimeoutExpired:
        pass
    process.send_signal(signal.SIGINT)
    begin = time.monotonic()
    done = ended(process, ("basin", path))
    expect(done.code in (0, 130, 1, 2), f"{done}\nthe study:\n{text.decode(errors='replace')}")
    expect(time.monotonic() - begin < 60,
           f"a minute from Ctrl-C to the end\nthe study:\n{text.decode(errors='replace')}")
    return 1


CASES = [lost_outputs, other_files, bad_places, damaged_studies]
