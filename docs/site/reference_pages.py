"""Reference that follows from the program: the commands' help, the keys of their JSON, the variables of their files, the
Python package. All of it is asked of the program that was built, so that it cannot be stale."""
import json
import re
import subprocess

ROW = "studies/paper/table-2-omega-2.4.toml"
FAN = "studies/examples/washing-machine.toml"
# Small questions, one of each kind: what their answers are made of is what every answer is made of.
ASKED = {
    "basin": ["basin", FAN, "--starts", "60", "--no-changes", "-o", "{}/basin.nc"],
    "attractors": ["attractors", ROW, "--starts", "200"],
    "attractors --along": ["attractors", ROW, "--along", "speed.final=2.4:2.5:0.1", "--starts", "10", "-o", "{}/along.nc"],
    "compare": ["compare", ROW, ROW, "--set-second", "balancer.drag=0.06", "--starts", "200", "--transients"],
    "sweep": ["sweep", ROW, "--over", "speed.final=2.4,2.6", "--starts", "60", "--transients", "-o", "{}/sweep.nc"],
    "capacity": ["capacity", ROW, "--starts", "100", "--precision", "0.1", "-o", "{}/capacity.nc"],
    "map": ["map", ROW, "--size", "16x16", "-o", "{}/map.nc"],
    "explain": ["explain", FAN],
    "certify": ["certify", ROW],
    "simulate": ["simulate", ROW, "--at", "0,1", "-o", "{}/simulate.nc"],
    "inspect": ["inspect", "{}/basin.nc"],
}


def commands(program):
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    lines = re.findall(r"^  ([a-z]+(?:, [a-z]+)*) {2,}\S", text, re.MULTILINE)  # "  inspect, merge   look into files"
    return [name for line in lines for name in line.split(", ")]


def help_page(program):
    text = "# Every command's options\n\nAs `equipoise COMMAND --help` prints them. What they do is described [command by command](commands/index.md).\n"
    for name in ["", *commands(program)]:
        said = subprocess.run([program, *name.split(), "--help"], capture_output=True, text=True, check=True).stdout
        text += f"\n## equipoise {name}".rstrip() + f"\n\n```text\n{said.strip()}\n```\n"
    return text


def keys(value, path, rows):
    """Every key with its type and a value, arrays by what they hold."""
    if isinstance(value, dict):
        for name, one in value.items():
            keys(one, f"{path}.{name}" if path else name, rows)
    elif isinstance(value, list) and value and isinstance(value[0], (dict, list)):
        for one in value:
            keys(one, path + "[]", rows)
    else:
        kind = {bool: "true or false", int: "number", float: "number", str: "text", list: "array", type(None): "null"}[type(value)]
        old = rows.setdefault(path, [set(), None])
        old[0].add(kind)
        if old[1] is None or old[1] in ([], ""):
            old[1] = value


def shown(value):
    text = json.dumps(value, ensure_ascii=False)
    text = text if len(text) <= 60 else text[:57] + "..."
    return "`" + text.replace("|", "\\|").replace("`", "'") + "`" if text != "null" else ""


def table_of_keys(answer):
    rows = {}
    study = answer.pop("study", None)
    keys(answer, "", rows)
    text = "| key | what | for example |\n|---|---|---|\n"
    for path, (kinds, value) in rows.items():
        text += f"| `{path}` | {' or '.join(sorted(kinds))} | {shown(value)} |\n"
    if study is not None:
        text += "| `study` | the study, defaults included | [keys](study-file.md) |\n"
    return text


def json_page(answers):
    text = ("# Keys of the JSON objects\n\nOne small answer of each command, taken apart: every key that it has, what stands there and an example. "
            "`[]` stands for each element of an array. What the keys mean is described [command by command](commands/index.md).\n")
    for name, answer in answers.items():
        text += f"\n## {name}\n\n{table_of_keys(answer)}"
    return text


def netcdf_page(folder):
    import xarray
    text = ("# Variables of the NetCDF files\n\nWhat a file of each kind holds, in its own words. Which variables there are depends on the study: "
            "these are those of one small file a kind. [Files of results](files-of-results.md) says how they are kept.\n")
    for name, title in {"basin": "basin -o", "map": "map -o", "sweep": "sweep -o", "capacity": "capacity -o",
                        "along": "attractors --along -o", "simulate": "simulate -o"}.items():
        with xarray.open_dataset(folder / f"{name}.nc", decode_times=False) as data:
            text += f"\n## {title}\n\n| variable | meaning | dimensions | type |\n|---|---|---|---|\n"
            for key, one in data.variables.items():
                meaning = one.attrs.get("long_name", "")
                unit = one.attrs.get("units", "1")
                if str(unit) not in ("1", ""):
                    meaning += f" ({unit})"
                if "flag_meanings" in one.attrs:
                    values = one.attrs["flag_values"]
                    meaning += ": " + ", ".join(f"{v} {w}" for v, w in zip(values, one.attrs["flag_meanings"].split()))
                meaning = meaning.replace("|", "\\|")
                text += f"| `{key}` | {meaning} | {', '.join(map(str, one.dims))} | {one.dtype if one.dtype != object else 'text'} |\n"
            text += "\nAttributes of the file: " + ", ".join(f"`{key}`" for key in data.attrs) + ".\n"
    return text


PYTHON = {
    "Studies": "study", "What is said of a study": "explanations", "Shares of starts": "ensembles", "Pages, and single starts": "pages",
    "Two ensembles side by side": "comparisons", "Designs": "designs", "Attractors": "attractor", "Motions and branches": "motions", "One motion followed": "branches",
    "Which attractor is which": "matching", "Maps": "maps", "The uncertainty exponent": "uncertainty",
    "Stability in a plane": "stability_planes", "Curves in a plane": "charts", "Sweeps": "sweeps",
    "Capacities": "capacities", "Files of results": "files", "Trajectories": "trajectory", "States": "state", "The model itself": "model", "The paper": "paper",
    "What every result has": "results", "Errors": "errors",
}


def public(source):
    """Of each module the names that the package gives out, in the module's order."""
    text = (source / "python/equipoise/__init__.py").read_text()
    names = {module: set(re.findall(r"\w+", listed)) for module, listed in re.findall(r"^from \.(\w+) import (.+)$", text, re.MULTILINE)}
    for module, name in (("attractor", "Path"),):  # what public calls return
        names[module].add(name)
    for module, wanted in names.items():
        written = (source / f"python/equipoise/{module}.py").read_text()
        order = dict.fromkeys(re.findall(r"^(class|def) (\w+)", written, re.MULTILINE))  # overloads are one function
        names[module] = [(kind, name) for kind, name in order if name in wanted]
    names["results"] = [("class", name) for name in ("Answer", "SavedAsData", "WithPage", "Result")]
    return names


def python_pages(source, put):
    names = public(source)
    for title, module in PYTHON.items():
        text = f"# {title}\n\n```{{eval-rst}}\n.. automodule:: equipoise.{module}\n   :no-members:\n\n"
        for kind, name in names[module]:
            text += f".. auto{'class' if kind == 'class' else 'function'}:: equipoise.{module}.{name}\n\n"
        put(f"reference/python/{module}.md", text + "```\n")
    put("reference/python/plot.md", "# Pictures\n\n```{eval-rst}\n.. automodule:: equipoise.plot\n   :imported-members:\n```\n")
    put("reference/python/index.md",
        "# The Python interface\n\nFrom the docstrings of this version. [The Python package](../python.md) is the place to begin.\n\n"
        "```{eval-rst}\n.. automodule:: equipoise\n   :no-members:\n\n.. autofunction:: equipoise.cpu_targets\n```\n\n"
        "```{toctree}\n:maxdepth: 1\n\n" + "\n".join([*PYTHON.values(), "plot"]) + "\n```\n")


def ask(program, source, folder):
    folder.mkdir(parents=True, exist_ok=True)
    answers = {}
    for name, arguments in ASKED.items():
        arguments = [word.format(folder) for word in arguments]
        arguments = [str(source / word) if word.startswith("studies/") else word for word in arguments]
        for word in arguments:
            if word.endswith(".nc") and name != "inspect":
                for file in folder.glob(word.rpartition("/")[2] + "*"):
                    file.unlink()
        quiet = [] if name in ("simulate", "inspect", "explain") else ["--quiet"]
        wants_json = [] if name == "simulate" else ["--json"]
        done = subprocess.run([program, *arguments, *quiet, *wants_json], capture_output=True, text=True)
        if done.returncode not in (0, 3):
            raise SystemExit(f"{' '.join(arguments)}: {done.stderr}")
        if wants_json:
            answers[name] = json.loads(done.stdout)
    return answers


def write(source, build, site, put):
    program = str(build / "equipoise")
    put("reference/help.md", help_page(program))
    answers = ask(program, source, site / "asked")
    put("reference/json.md", json_page(answers))
    put("reference/netcdf.md", netcdf_page(site / "asked"))
    python_pages(source, put)
