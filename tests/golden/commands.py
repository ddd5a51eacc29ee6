"""The commands whose answers are on record: what each is given for a study, and the files that it writes."""
from studies import PHYSICAL_DRAG, PLAIN_DRAG


def overrides(values):
    return [part for value in values for part in ("--set", value)]


def commands(name, study, values, folder):
    """(name of the command, its arguments, the files that it writes in `folder`) of every command that answers this study."""
    low, high = PHYSICAL_DRAG.get(name, PLAIN_DRAG)
    starts = ["--starts", "60"]
    given = [study, *overrides(values)]
    runs = ["--threads", "2", "--quiet"]

    def file(ending):
        return str(folder / f"{name}.{ending}")

    yield "explain", ["explain", *given], []
    yield "explain-json", ["explain", *given, "--json"], []
    yield "basin", ["basin", *given, *starts, *runs, "--transients", "--no-changes", "-o", file("basin.nc"), "--report", file("basin.html")], [
        "basin.nc", "basin.html"]
    yield "basin-json", ["basin", *given, *starts, *runs, "--transients", "--no-changes", "--json"], []
    yield "start", ["basin", *given, "--start-index", "3", *runs], []
    yield "inspect", ["inspect", file("basin.nc")], []
    yield "basin-details", ["basin", *given, *starts, *runs, "--transients", "--no-changes", "-o", file("basin.nc"), "--details"], []
    yield "simulate", ["simulate", *given, "--every", "2", "--until", "40", "-o", file("run.csv")], ["run.csv"]
    yield "simulate-nc", ["simulate", *given, "--every", "2", "--until", "40", "-o", file("run.nc")], ["run.nc"]
    yield "attractors", ["attractors", *given, *starts, *runs], []
    yield "attractors-json", ["attractors", *given, *starts, *runs, "--json"], []
    yield "compare", ["compare", study, study, *overrides(values), "--set-second", f"balancer.drag={high}", *starts, *runs], []
    yield "compare-json", [
        "compare", study, study, *overrides(values), "--set-second", f"balancer.drag={high}", *starts, *runs, "--json"], []
    yield "sweep", ["sweep", *given, "--over", f"balancer.drag={low},{high}", *starts, *runs, "--transients", "-o", file("sweep.nc"),
                    "--csv", file("sweep.csv"), "--report", file("sweep.html")], ["sweep.nc", "sweep.csv", "sweep.html"]
    yield "sweep-json", ["sweep", *given, "--over", f"balancer.drag={low},{high}", *starts, *runs, "--json"], []
    yield "map", ["map", *given, "--size", "12x8", *runs, "-o", file("map.nc"), "--report", file("map.html")], ["map.nc", "map.html"]
    yield "map-json", ["map", *given, "--size", "12x8", *runs, "--json"], []
    if name in ("row", "gravity", "motor", "touching", "uncertain", "unlike-balls"):
        yield "certify", ["certify", *given, "--quiet", "-o", file("certificate.json")], ["certificate.json"]
    if name in ("row", "gravity"):
        along = ["attractors", *given, "--along", f"balancer.drag={low}:{high}:0.02", *starts, *runs]
        yield "along", [*along, "-o", file("along.nc")], ["along.nc"]
        yield "along-csv", [*along, "-o", file("along.csv")], ["along.csv"]
    if name in ("row", "gravity", "centrifuge", "washer"):
        limit = "rotor.unbalance" if name in PHYSICAL_DRAG else "rotor.eccentricity"
        between = {"centrifuge": "4 kg mm:12 kg mm", "washer": "80 kg mm:200 kg mm"}.get(name, "0.005:0.05")
        yield "capacity", ["capacity", *given, "--wide", "--of", limit, "--between", between, "--precision", "0.05", *starts, *runs, "-o",
                           file("capacity.nc"), "--csv", file("capacity.csv"), "--report", file("capacity.html")], [
                               "capacity.nc", "capacity.csv", "capacity.html"]
        yield "capacity-json", [
            "capacity", *given, "--of", limit, "--between", between, "--precision", "0.05", *starts, *runs, "--json"], []
    if name == "washer":
        small = ["design", *given, "--set", "design.starts=50", "--set", "design.trajectories=10000", *runs, "-o", file("design.nc")]
        yield "design", [*small, "--csv", file("design.csv"), "--report", file("design.html"), "--best", file("best.toml")], [
            "design.nc", "design.csv", "design.html", "best.toml"]
        yield "design-json", [*small, "--json"], []
