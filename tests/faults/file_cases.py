"""Results under kills, signals, full disks, a second writer and damage."""
import os
import shutil
import signal
import subprocess
import tempfile
import time

import classic_netcdf
from harness import (adds_up, catches_signals, content, ended, expect, limited, refused, result, same_result,
                     wait_until)


class Reference:
    """A run that nothing disturbs, and how long it took."""

    def __init__(self, bench, starts=0, arguments=None):
        self.arguments = arguments or bench.basin("--starts", starts)
        path = bench.path("reference.nc")
        begin = time.monotonic()
        done = bench.run(*self.arguments, "-o", path)
        self.seconds = time.monotonic() - begin
        expect(done.code == 0, f"{done}: the undisturbed run failed")
        self.starts, self.result = starts, result(path)


def finish(bench, reference, path, what):
    """The same command ends what was begun, with every bit as if nothing had happened."""
    done = bench.run(*reference.arguments, "-o", path)
    expect(done.code == 0, f"{what}: {done}")
    expect(not os.path.exists(path + ".part"), f"{what}: the unfinished part is still there")
    same_result(path, reference.result, what)


def kills(bench):
    """kill -9 at random moments, over and over at one file and once at each of others."""
    reference = Reference(bench, 20000 if bench.quick else 400000)
    over_and_over = bench.path("again.nc")
    rounds = 3 if bench.quick else 20
    for k in range(rounds):
        path = over_and_over if k % 2 == 0 else bench.path(f"once-{k}.nc")
        process = bench.start(*reference.arguments, "-o", path)
        time.sleep(bench.random.uniform(0.0, 1.1 * reference.seconds))
        process.kill()
        ended(process)
        if os.path.exists(path):
            adds_up(path)
        if path != over_and_over:
            finish(bench, reference, path, f"kill {k}")
    finish(bench, reference, over_and_over, "after every kill")
    return f"{rounds} kills"


def kept_within_seconds(bench):
    """What is complete is out of the process's hands soon: half a run is there after half a run."""
    starts = 100000 if bench.quick else 2000000
    path = bench.path("soon.nc")
    process = bench.start(*bench.basin("--starts", 100 * starts, "-o", path))
    wait_until(lambda: os.path.exists(path + ".part") and os.path.getsize(path + ".part") > 27 * starts, process)
    running = process.poll() is None
    process.kill()
    ended(process)
    expect(running, "the run ended before its results were on disk")
    done = bench.run(*bench.basin("--starts", starts // 10, "-o", path))
    expect(done.code == 0, f"{done}")
    adds_up(path)
    held = classic_netcdf.read(path)[0]["start"]
    expect(held >= starts * 9 // 10, f"{held} of {starts} starts are there")
    return f"{held} starts kept"


def signals(bench):
    """Ctrl-C and requests to terminate at random moments: exit 130, results kept, nothing half written."""
    reference = Reference(bench, 20000 if bench.quick else 200000)
    rounds = 4 if bench.quick else 80
    for k in range(rounds):
        path = bench.path(f"signal-{k if k % 3 else 'again'}.nc")
        process = bench.start(*reference.arguments, "-o", path)
        if not wait_until(lambda: catches_signals(process), process):
            ended(process)
            continue
        time.sleep(bench.random.uniform(0.0, 1.1 * reference.seconds))
        process.send_signal(bench.random.choice((signal.SIGINT, signal.SIGTERM)))
        done = ended(process, reference.arguments)
        expect(done.code in (0, 130), f"signal {k}: {done}")
        if os.path.exists(path):
            adds_up(path)
        if k % 10 == 1:
            finish(bench, reference, path, f"signal {k}")
    finish(bench, reference, bench.path("signal-again.nc"), "after every signal")
    return f"{rounds} signals"


def on_full_disk(bench, reference, path, options, room):
    """A run into a disk without room, and its end once there is: `options` take the room, `room` gives it."""
    old = content(path) if os.path.exists(path) else None
    done = bench.run(*reference.arguments, "-o", path, **options)
    refused(done, 1, words=("cannot be written",))
    expect((content(path) if os.path.exists(path) else None) == old, "a full disk changed the finished part")
    expect(not os.path.exists(path + ".new"), "a full disk left half a file")
    room()
    finish(bench, reference, path, "after a full disk")


def kills_of_maps(bench):
    """kill -9 and Ctrl-C of maps; damage to what they left: the same bytes in the end."""
    rounds = 2 if bench.quick else 25
    size = "128x96" if bench.quick else "640x480"
    reference = Reference(bench, arguments=("map", bench.study, "--quiet", "--threads", "2", "--size", size))
    whole = content(bench.path("reference.nc"))
    path = bench.path("map.nc")
    for k in range(rounds):
        process = bench.start(*reference.arguments, "-o", path)
        wait_until(lambda: catches_signals(process), process)
        time.sleep(bench.random.uniform(0.0, 1.1 * reference.seconds))
        process.send_signal(signal.SIGKILL if k % 3 else signal.SIGINT)
        ended(process)
        if bench.random.random() < 0.2 and os.path.exists(path + ".part"):  # its end was not yet on disk
            os.truncate(path + ".part", max(0, os.path.getsize(path + ".part") - bench.random.randrange(2000)))
    finish(bench, reference, path, "map")
    expect(content(path) == whole, "map: not the same bytes")
    os.remove(bench.path("reference.nc"))
    return f"{rounds} kills"


def full_disks_of_maps(bench):
    """No room for a map's pixels, or for the file made of them: exit 1, one line, and the same command goes on."""
    reference = Reference(bench, arguments=("map", bench.study, "--quiet", "--threads", "2", "--size", "96x64"))
    size = len(content(bench.path("reference.nc")))
    for room in (size // 3,) if bench.quick else (100, size // 3, size - 100):
        on_full_disk(bench, reference, bench.path(f"map-{room}.nc"), {"preexec_fn": limited(room)}, lambda: None)
    first = bench.start(*reference.arguments[:-1], "2000x2000", "-o", bench.path("shared.nc"))
    expect(wait_until(lambda: os.path.exists(bench.path("shared.nc.part")), first), "the first writer did not begin")
    second = bench.run(*reference.arguments[:-1], "2000x2000", "-o", bench.path("shared.nc"))
    refused(second, 2, words=("another process",))
    first.kill()
    ended(first)
    return "by the size of files; second writer refused"


def kills_of_reproduce(bench):
    """kill -9 while tables are computed again: finished rows are kept, the row at work goes on."""
    command = ("reproduce", "table-7", "--law", "kinematic", "--quiet", "--starts", 200 if bench.quick else 20000, "-o")
    undisturbed, killed = bench.path("undisturbed"), bench.path("killed")
    begin = time.monotonic()
    done = bench.run(*command, undisturbed)
    seconds = time.monotonic() - begin
    expect(done.code in (0, 3), f"{done}")
    for _ in range(1 if bench.quick else 5):
        process = bench.start(*command, killed)
        time.sleep(bench.random.uniform(0.2, 0.9) * seconds)
        process.kill()
        ended(process)
    again = bench.run(*command, killed)
    expect(again.code == done.code, f"{again}")
    names = sorted(os.listdir(os.path.join(undisturbed, "ensembles")))
    expect(sorted(os.listdir(os.path.join(killed, "ensembles"))) == names, "other ensembles than without the kill")
    for name in names:
        same_result(os.path.join(killed, "ensembles", name), result(os.path.join(undisturbed, "ensembles", name)), name)
    return f"{len(names)} ensembles"


def full_disks(bench):
    """No room for a new file, nor for more in a finished one: exit 1, one line, nothing lost."""
    reference = Reference(bench, 20000)
    small = max(1000, len(content(bench.path("reference.nc"))))
    sizes = (100, small // 3, int(small * 0.97))  # at once, on the way, when results are put in place
    for size in sizes[2:] if bench.quick else sizes:
        on_full_disk(bench, reference, bench.path(f"new-{size}.nc"), {"preexec_fn": limited(size)}, lambda: None)
    path = bench.path("extended.nc")
    expect(bench.run(*bench.basin("--starts", 10000, "-o", path)).code == 0, "no file to extend")
    for size in sizes[1:2] if bench.quick else sizes[:2]:
        copy = bench.path(f"extended-{size}.nc")
        shutil.copy(path, copy)
        on_full_disk(bench, reference, copy, {"preexec_fn": limited(size)}, lambda: None)
    return "by the size of files" + (", on a small disk" if small_disk(bench, reference, small) else "")


def small_disk(bench, reference, size):
    """The same on a file system of its own, where one can be mounted."""
    folder = tempfile.mkdtemp(dir=bench.folder)
    mount = ["mount", "-t", "tmpfs", "-o", f"size={2 * size // 4096 * 4096}", "none", folder]
    if os.geteuid() != 0 or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
        return False
    try:
        ballast = os.path.join(folder, "ballast")
        path = os.path.join(folder, "a.nc")
        expect(bench.run(*bench.basin("--starts", 2000, "-o", path)).code == 0, "no file on the small disk")
        with open(ballast, "wb", buffering=0) as file:
            try:
                while file.write(bytes(4096)):
                    pass
            except OSError:
                pass
            file.truncate(file.tell() - 100000)

        def room():
            os.remove(ballast)
            subprocess.run(["mount", "-o", "remount,size=100m", folder], capture_output=True, check=False)

        on_full_disk(bench, reference, path, {}, room)
    finally:
        subprocess.run(["umount", folder], capture_output=True, check=False)
    return True


def two_writers(bench):
    """The second is refused at once; the first loses nothing."""
    reference = Reference(bench, 20000 if bench.quick else 200000)
    path = bench.path("shared.nc")
    first = bench.start(*reference.arguments, "-o", path)
    expect(wait_until(lambda: os.path.exists(path + ".part"), first), "the first writer did not begin")
    second = bench.run(*reference.arguments, "-o", path)
    if first.poll() is None:
        refused(second, 2, words=("another process",))
    expect(ended(first).code == 0, "the first writer failed")
    same_result(path, reference.result, "two writers")
    return "second refused"


def fewer_starts(bench):
    """Fewer starts than a file holds: the answer is theirs, and the file's summary is still of all."""
    path = bench.path("fewer.nc")
    expect(bench.run(*bench.basin("--starts", 2000, "-o", path)).code == 0, "no file")
    before = content(path)
    done = bench.run(*bench.basin("--starts", 1000, "-o", path, "--json"))
    expect(done.code == 0 and b'"starts": 1000' in done.out, f"{done}")
    expect(content(path) == before, "fewer starts changed the file")
    adds_up(path)
    return "file as it was"


def mutated(bench, data):
    """One to three faults of the kinds that disks and transfers have."""
    data = bytearray(data)
    for _ in range(bench.random.randint(1, 3)):
        at = bench.random.randrange(max(1, len(data)))
        size = bench.random.choice((1, 8, 512, 4096))
        kind = bench.random.randrange(6)
        if kind == 0 and data:
            data[at] ^= 1 << bench.random.randrange(8)
        elif kind == 1:
            del data[at:]
        elif kind == 2:
            data[at:at + size] = bytes(len(data[at:at + size]))
        elif kind == 3:
            data[at:at + size] = bench.random.randbytes(len(data[at:at + size]))
        elif kind == 4:
            del data[at:at + size]
        else:
            data[at:at] = bench.random.randbytes(size)
    return bytes(data)


def damaged_results(bench):
    """Finished files with faults in them: refused, or whole after all, and never touched."""
    reference = Reference(bench, 3000)
    whole = content(bench.path("reference.nc"))
    path = bench.path("damaged.nc")
    rounds = 60 if bench.quick else 300
    for k in range(rounds):
        data = mutated(bench, whole)
        with open(path, "wb") as file:
            file.write(data)
        done = bench.run(*reference.arguments, "-o", path)
        if data == whole:
            expect(done.code == 0, f"{done}")
        else:
            refused(done, 1, 2)
            expect(content(path) == data, f"damage {k}: the file was written to")
        expect(not os.path.exists(path + ".part"), f"damage {k}: something is left beside the file")
    return f"{rounds} files"


def damaged_parts(bench):
    """Unfinished files with faults in them: refused, or cut back to what is whole and gone on from there."""
    reference = Reference(bench, 20000)
    path = bench.path("part.nc")
    process = bench.start(*bench.basin("--starts", 10**8, "-o", path))
    wait_until(lambda: os.path.exists(path + ".part") and os.path.getsize(path + ".part") > 200000, process)
    process.kill()
    ended(process)
    whole = content(path + ".part")[:400000]
    rounds = 3 if bench.quick else 30
    for k in range(rounds):
        if os.path.exists(path):
            os.remove(path)
        with open(path + ".part", "wb") as file:
            file.write(mutated(bench, whole))
        done = bench.run(*reference.arguments, "-o", path)
        if done.code == 0:
            same_result(path, reference.result, f"damaged part {k}")
        else:
            refused(done, 1, 2, words=(".part",))
    return f"{rounds} files"


CASES = [kills, kills_of_maps, full_disks_of_maps, kills_of_reproduce, kept_within_seconds, signals, full_disks,
         two_writers, fewer_starts, damaged_results, damaged_parts]
