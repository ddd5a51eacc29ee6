"""The benchmark runs, its JSON is complete, its rivals solve the same problem, and bad options are refused."""
import json
import os
import subprocess
import sys
import tempfile

WORKS = ["full", "decided", "ramped", "kernel", "targets", "threads", "balls", "starts", "machines", "uncertain"]
# Median distance in (x, y) from the reference. Tolerances of 1e-6 a step grow over hundreds of steps, most in CVODE
# (1e-5 here, hence the factor of hundred); other equations or another start would be off by the size of the motion, 0.1.
LARGEST_MEDIAN_ERROR = 1e-3


def check_comparison(work):
    names = [engine["name"] for engine in work["engines"]]
    assert names[0] == "Equipoise" and "Odeint dopri5" in names and "Odeint fehlberg78" in names, names
    assert any("SUNDIALS" in text for text in names + work["missing"]), (names, work["missing"])
    assert any("SciPy" in text for text in names + work["missing"]), (names, work["missing"])
    assert work["reference_error_median"] < 1e-9, work["reference_error_median"]
    for engine in work["engines"]:
        assert engine["error_median"] < LARGEST_MEDIAN_ERROR, (engine["name"], engine["error_median"])
        assert engine["starts_per_second"]["median"] > 0 and engine["starts_per_cpu_second"]["median"] > 0
        assert engine["rounds"] and all(cost["evaluations"] > 1000 * cost["starts"] for cost in engine["rounds"])


def check(bench, folder):
    path = os.path.join(folder, "bench.json")
    done = subprocess.run([bench, "--quick", "--json", path], capture_output=True, text=True, check=True)
    with open(path) as file:
        result = json.load(file)
    assert list(result["works"]) == WORKS, list(result["works"])
    for key in ("processor", "cores", "instruction_set", "compiler", "build", "rival_options", "versions", "date"):
        assert result["machine"][key], key
    works = result["works"]
    check_comparison(works["full"])
    check_comparison(works["ramped"])
    for row in works["decided"]["rows"]:
        assert row["starts"] == 1000 and row["failed"] == 0 and row["diverged"] == 0, row
    assert len(works["decided"]["rivals_computed_from_full"]) == len(works["full"]["engines"])
    kernel = works["kernel"]
    assert 0 < kernel["share_of_peak_one_thread"] and len(kernel["balls"]) == 16
    # Stage sums of DOP853 alone are over a thousand operations a step, and so are twelve evaluations.
    assert 2000 < kernel["flops_per_step"] < 6000, kernel["flops_per_step"]
    assert [t["name"] for t in works["targets"]["targets"]] == result["machine"]["instruction_sets"]
    assert len(works["balls"]["balls"]) == 16 and works["threads"]["full"] and works["threads"]["decided"]
    assert works["starts"]["sizes"][0]["peak_memory_mib"]["most"] > 1
    widest = max(done.stdout.splitlines(), key=len)
    assert len(widest) <= 120, widest
    for bad in (["--works", "speed"], ["--rounds", "0"], ["--threads", "x"], ["--json", "/nowhere/x.json"], ["--no"],
                ["--quick", "--long"]):
        refused = subprocess.run([bench] + bad, capture_output=True, text=True)
        assert refused.returncode == 2 and refused.stdout == "", (bad, refused.returncode)
        assert refused.stderr.count("\n") == 1, (bad, refused.stderr)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        check(sys.argv[1], scratch)
