"""SciPy's solve_ivp on the engine's equations: one process a core, timed from the moment all of them are ready.

Standard input: one line of JSON (method, tolerances, problem, count, processes, library, states: a file of doubles).
The file's rows become final states; standard output: one line of JSON with wall and CPU seconds and evaluations.
"""
import ctypes
import json
import multiprocessing
import sys
import time

import numpy
from scipy.integrate import solve_ivp


def equations(request):
    library = ctypes.CDLL(request["library"])
    library.set_problem.argtypes = [ctypes.c_void_p]
    library.rhs.argtypes = [ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p]
    library.rhs.restype = None
    library.set_problem(numpy.array(request["problem"], dtype=float).ctypes.data)
    rhs = library.rhs

    def derivative(t, z):
        dz = numpy.empty(8)
        rhs(t, z.ctypes.data, dz.ctypes.data)
        return dz

    return derivative


def follow(request, states, ready, results):
    derivative = equations(request)
    ready.wait()
    wall, cpu, evaluations = time.monotonic(), time.process_time(), 0
    for row in states:
        solution = solve_ivp(derivative, (request["begin"], request["end"]), row, method=request["method"],
                             rtol=request["relative"], atol=request["absolute"])
        evaluations += solution.nfev
        row[:] = solution.y[:, -1] if solution.success else numpy.nan
    results.put((wall, time.monotonic(), time.process_time() - cpu, evaluations))


def main():
    request = json.loads(sys.stdin.readline())
    count, processes = request["count"], request["processes"]
    context = multiprocessing.get_context("fork")
    shared = context.RawArray(ctypes.c_double, 8 * count)
    states = numpy.frombuffer(shared).reshape(count, 8)
    states[:] = numpy.fromfile(request["states"]).reshape(count, 8)
    ready, results = context.Barrier(processes), context.SimpleQueue()
    workers = [context.Process(target=follow, args=(
        request, states[count * k // processes:count * (k + 1) // processes], ready, results)) for k in range(processes)]
    for worker in workers:
        worker.start()
    costs = [results.get() for _ in workers]
    for worker in workers:
        worker.join()
    states.tofile(request["states"])
    print(json.dumps({"wall": max(c[1] for c in costs) - min(c[0] for c in costs), "cpu": sum(c[2] for c in costs),
                      "evaluations": sum(c[3] for c in costs)}))


if __name__ == "__main__":
    main()
