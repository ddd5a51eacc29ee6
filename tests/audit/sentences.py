"""Draws machines as a data sheet states them and holds what the program says of each against trajectories.

    sentences.py PROGRAM [--machines N (30)] [--seed S (1)] [--only K] [--starts N (4)] [--seconds T (60)]
                 [--folder DIR]

Exit code 3 if a sentence is false.
"""

import argparse
import os
import sys
import tempfile
import time

import drawn_machine
import sentence_checks


def examine(program, machine, folder, starts):
    """(claims that hold, faults, what took too long)"""
    held, faults, late = 0, [], ""
    try:
        examination = sentence_checks.Examination(program, machine, folder, starts)
        for check in sentence_checks.CHECKS:
            for claim, true, seen in check(examination):
                if true:
                    held += 1
                else:
                    faults.append(f"{claim}: {seen}")
    except RuntimeError as error:
        faults.append(str(error))
    except sentence_checks.NoAnswer as error:
        late = str(error)
    return held, faults, late


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--machines", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--starts", type=int, default=4)
    parser.add_argument("--seconds", type=float, default=60.0, help="that one command may take")
    parser.add_argument("--folder")
    a = parser.parse_args()
    sentence_checks.Examination.patience = a.seconds
    folder = a.folder or tempfile.mkdtemp(prefix="sentences-")
    os.makedirs(folder, exist_ok=True)
    wrong = claims = unanswered = 0
    numbers = [a.only] if a.only is not None else range(a.machines)
    for number in numbers:
        machine, begin = drawn_machine.draw(a.seed, number), time.time()
        held, faults, late = examine(a.program, machine, folder, a.starts)
        claims += held + len(faults)
        wrong += len(faults)
        print(f"{number:3d}  {machine.kind:18s} {held:3d} held  {len(faults):2d} false  {time.time() - begin:5.1f} s", flush=True)
        if late:
            unanswered += 1
            print(f"     {late}", flush=True)
        for fault in faults:
            print(f"     {fault}\n     equipoise explain {os.path.join(folder, f'machine-{number}.toml')}", flush=True)
    print(f"\n{wrong} of {claims} claims about {len(numbers)} machines are false, {unanswered} "
          f"machines without an answer in time; seed {a.seed}")
    return 3 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
