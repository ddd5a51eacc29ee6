"""Sweeps under kills, a full disk, a second writer, damage, shards and dead processes of a job: cells that were done stay
done, and the file ends up as if nothing had happened."""
import os
import signal
import time

from harness import (Undisturbed, catches_signals, content, ended, expect, limited, refused, same_for_any_number_of_processes,
                     wait_until)


def undisturbed(bench, starts=None, speeds=None):
    starts = starts or (300 if bench.quick else 3000)
    # Speeds with quick searches.
    speeds = speeds or ("speed.final=2.6,2.8,3" if bench.quick else "speed.final=2:3.2:0.2")
    return Undisturbed(bench, f"undisturbed-{starts}.nc", "sweep", bench.study, "--over", speeds,
                       "--over", "balancer.drag=0.1,0.25", "--starts", starts, "--quiet")


def sweep_kills(bench):
    """kill -9 and requests to stop at random moments, over and over at one file."""
    sweep = undisturbed(bench)
    path = bench.path("killed.nc")
    rounds = 4 if bench.quick else 50
    for k in range(rounds):
        process = bench.start(*sweep.arguments, "--threads", 1 + k % 2, "-o", path)
        wait_until(lambda: catches_signals(process), process)
        time.sleep(bench.random.uniform(0.0, 0.4 * sweep.seconds))
        process.send_signal(bench.random.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGINT)))
        ended(process)
        if k % 10 == 9:
            sweep.finish(bench, path, f"after kill {k}")
            os.remove(path)
    sweep.finish(bench, path, "after every kill")
    return f"{rounds} kills"


def sweep_disks_and_writers(bench):
    """A file that may not grow, a second writer, bytes flipped and cut off."""
    sweep = undisturbed(bench)
    size = len(sweep.content)
    for part in (0.02, 0.4, 0.97):
        path = bench.path(f"full-{part}.nc")
        done = bench.run(*sweep.arguments, "-o", path, preexec_fn=limited(int(part * size)))
        refused(done, 1, words=("cannot be written",))
        sweep.finish(bench, path, f"a disk full at {part}")
    path = bench.path("shared.nc")
    first = bench.start(*sweep.arguments, "-o", path)
    wait_until(lambda: os.path.exists(path + ".part"), first)
    if first.poll() is None:
        refused(bench.run(*sweep.arguments, "-o", path), 2, words=("another process",))
    ended(first)
    sweep.finish(bench, path, "two writers")
    flips = 5 if bench.quick else 40
    for _ in range(flips):
        damaged = bytearray(sweep.content)
        damaged[bench.random.randrange(size)] ^= 1 << bench.random.randrange(8)
        with open(path, "wb") as file:
            file.write(damaged if bench.random.random() < 0.7 else damaged[:bench.random.randrange(size)])
        refused(bench.run(*sweep.arguments, "-o", path), 2)
        inspected = bench.run("inspect", path)
        expect(inspected.code in (2, 3), f"{inspected}: damage is not told")
    # Of unfinished results the part before the damage is used.
    path = bench.path("part.nc")
    process = bench.start(*sweep.arguments, "-o", path)
    wait_until(lambda: os.path.exists(path + ".part") and os.path.getsize(path + ".part") > 3000, process)
    process.kill()
    ended(process)
    if os.path.exists(path + ".part"):
        with open(path + ".part", "r+b") as file:
            file.seek(-7, os.SEEK_END)
            file.write(b"\x00\xff\x00")
        inspected = bench.run("inspect", path + ".part")
        expect(inspected.code == 3 and b"DAMAGE" in inspected.out, f"{inspected}: {inspected.out!r}")
    sweep.finish(bench, path, "a damaged end")
    return f"{flips} damaged files"


def sweep_shards(bench):
    """Shards in any order and twice, unfinished ones too, merged: the same file."""
    sweep = undisturbed(bench)
    paths = []
    for number in (3, 1, 2):
        paths.append(bench.path(f"shard-{number}.nc"))
        done = bench.run(*sweep.arguments, "--shard", f"{number}/3", "-o", paths[-1])
        expect(done.code == 0, f"{done}")
    merged = bench.path("merged.nc")
    done = bench.run("merge", *paths[:2], "-o", merged)
    expect(done.code == 0 and b"PARTIAL" in done.out, f"{done}: two of three shards are not all")
    done = bench.run("merge", paths[2], paths[0], "-o", merged)
    expect(done.code == 0 and content(merged) == sweep.content, f"{done}: merged shards are another file")
    other = bench.path("other.nc")
    expect(bench.run(*sweep.arguments, "--seed", 2, "--shard", "1/3", "-o", other).code == 0, "no other sweep")
    refused(bench.run("merge", paths[0], other, "-o", bench.path("mixed.nc")), 2, words=("sampling.seed",))
    return "3 shards"


def sweep_processes(bench):
    """Processes of one job, one of them killed: what is done is kept, any number goes on from it."""
    sweep = undisturbed(bench)
    # Fewer blocks than processes: one cell, whose starts are shared.
    few = undisturbed(bench, starts=40000, speeds="speed.final=2.8")
    return same_for_any_number_of_processes(bench, ((2, sweep, ()), (4, few, ()), (4, sweep, ()), (2, few, ("--threads", "2")))[:2 if bench.quick else 4],
                                            1 if bench.quick else 6)


CASES = [sweep_kills, sweep_disks_and_writers, sweep_shards, sweep_processes]
