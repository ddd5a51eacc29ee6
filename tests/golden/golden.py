"""Holds the bits of fates and the bytes of answers to those on record, so that a change of structure shows that it changed
nothing else.

    golden.py PROGRAM STUDIES --folder DIR [--renew] [--only TEXT]

Fates: outcome, time and grounds of every start of the studies in studies.py, on this machine's best instruction set and on
portable code. Answers: text, JSON, CSV, NetCDF and HTML of every command in commands.py. What a run takes (seconds, starts per
second) is left out. Records stand by instruction set in golden.json, beside this file; --renew writes them anew.
All that is hashed stays in DIR, that of the run before in DIR/before: compare the two where a record differs.
"""
import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys

from scipy.io import netcdf_file

from commands import commands, overrides
from studies import ANSWERS, FATES

HERE = pathlib.Path(__file__).parent
RECORDS = HERE / "golden.json"
NUMBER = r"[0-9][-+.0-9e]*"
TIMES = re.compile("|".join((
    rf'"(?:cpu_)?seconds": ?{NUMBER}', rf'"\w+_per_second": ?{NUMBER}', rf'"\w*_seconds": ?{NUMBER}',
    rf"{NUMBER} s, {NUMBER} s CPU", rf"{NUMBER} s \({NUMBER} s CPU\)", rf", {NUMBER} (?:starts|trajectories|pixels)/s",
    rf"{NUMBER} s(?= on \d+ thread)", rf"{NUMBER} s(?= CPU time)", rf"(?<=found in ){NUMBER} s", rf"(?<=re-check in ){NUMBER} s",
    rf"(?m:^ *(?:cpu_)?seconds +{NUMBER}$)")))
RUN_ATTRIBUTES = {"seconds", "cpu_seconds"}


def digest(content):
    return hashlib.sha256(content).hexdigest()[:20]


def without_times(text, folder):
    """Lines of a paragraph of the terminal that states CPU times are joined: where they break depends on these."""
    text = "\n\n".join(part.replace("\n", " ") if re.search(r"\d\s+s\s+CPU", part) else part
                       for part in text.replace(str(folder), "(folder)").split("\n\n"))
    return TIMES.sub("(time)", text)


def columns(path):
    """Every dimension, attribute and variable of a NetCDF file, but for what the run took, as lines of text."""
    with netcdf_file(path, mmap=False) as data:
        for name, length in data.dimensions.items():
            yield f"dimension {name} {length}"
        for name, value in data._attributes.items():
            if name not in RUN_ATTRIBUTES:
                yield f"attribute {name} {value!r}"
        for name, variable in data.variables.items():
            attributes = {key: str(value) for key, value in variable._attributes.items()}
            kept = b"" if name in RUN_ATTRIBUTES else variable.data.tobytes()
            yield f"variable {name} {variable.data.dtype} {variable.dimensions} {attributes} {digest(kept)}"


def content(path, folder):
    if path.suffix == ".nc":
        return "\n".join(columns(path))
    return without_times(path.read_text(), folder)


class Golden:
    def __init__(self, program, studies, folder):
        self.program, self.studies, self.folder = program, studies, folder
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        self.best = re.search(r"using (.+)", version)[1]

    def run(self, arguments):
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True, check=False)
        return f"exit {done.returncode}\n{done.stdout}---\n{done.stderr}"

    def keep(self, key, text):
        path = self.folder / (key.replace("/", "-") + ".txt")
        path.write_text(text)
        return key, digest(text.encode())

    def fates(self, name, target):
        file, values, starts = FATES[name]
        where = self.folder / f"{name}.{target}.nc"
        said = self.run(["basin", str(self.studies / file), *overrides(values), "--starts", str(starts), "--cpu", target, "--threads",
                         "1", "--quiet", "--no-transients", "-o", str(where)])
        if not where.exists():
            raise SystemExit(f"golden: {name} on {target}: {said}")
        with netcdf_file(where, mmap=False) as data:
            bits = "\n".join(f"{column} {digest(data.variables[column].data.tobytes())}"
                             for column in ("outcome", "decision_time", "decided_by"))
        yield self.keep(f"{target}/fates/{name}", bits)

    def answers(self, name):
        file, values = ANSWERS[name]
        for command, arguments, files in commands(name, str(self.studies / file), values, self.folder):
            said = self.run(arguments)
            yield self.keep(f"{self.best}/{name}/{command}", without_times(said, self.folder).replace(str(self.studies), "(studies)"))
            for ending in files:
                path = self.folder / f"{name}.{ending}"
                text = content(path, self.folder) if path.exists() else "no such file"
                yield self.keep(f"{self.best}/{name}/{ending}", text.replace(str(self.studies), "(studies)"))

    def everything(self, only):
        jobs = [lambda n=name, t=target: list(self.fates(n, t)) for target in (self.best, "scalar") for name in FATES
                if only in f"{target}/fates/{name}"]
        jobs += [lambda n=name: list(self.answers(n)) for name in ANSWERS if only in f"{self.best}/{name}"]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for number, done in enumerate(pool.map(lambda job: job(), jobs), 1):
                print(f"golden: {number} of {len(jobs)}", end="\r", file=sys.stderr, flush=True)
                yield from done
        print(file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("studies", type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path, required=True, help="for all that is hashed")
    parser.add_argument("--renew", action="store_true", help="write the records")
    parser.add_argument("--only", default="", metavar="TEXT", help="studies whose names contain this")
    asked = parser.parse_args()
    before = asked.folder / "before"
    if asked.folder.exists():
        shutil.rmtree(before, ignore_errors=True)
        aside = asked.folder.with_name(asked.folder.name + ".aside")
        asked.folder.rename(aside)
        asked.folder.mkdir(parents=True)
        aside.rename(before)
    asked.folder.mkdir(parents=True, exist_ok=True)
    golden = Golden(asked.program, asked.studies.resolve(), asked.folder.resolve())
    found = dict(golden.everything(asked.only))
    records = json.loads(RECORDS.read_text()) if RECORDS.exists() else {}
    if asked.renew:
        kept = {key: value for key, value in records.items() if asked.only or key.split("/")[0] not in (golden.best, "scalar")}
        RECORDS.write_text(json.dumps(dict(sorted({**kept, **found}.items())), indent=0) + "\n")
        print(f"{len(found)} records written")
        return 0
    known = {key: value for key, value in found.items() if key in records}
    moved = [key for key, value in known.items() if records[key] != value]
    for key in moved:
        print(f"moved: {key}: see {asked.folder}/{key.replace('/', '-')}.txt")
    if not asked.only:
        for key in (k for k in records if k.split("/")[0] in (golden.best, "scalar") and k not in found):
            moved.append(key)
            print(f"gone: {key}")
    new = len(found) - len(known)
    print(f"{len(known) - sum(key in known for key in moved)} as on record, {len(moved)} moved or gone, {new} not on record")
    return 1 if moved or new else 0


sys.exit(main())
