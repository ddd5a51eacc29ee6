#!/usr/bin/env python3
"""Runs the notebooks and keeps what they show; test_notebooks.py compares what they show with what is kept.

    notebooks.py --renew [NAME..] [--cpu TARGET]

Writes the outputs of every notebook (or of those whose names begin with NAME) into its file, as a fresh kernel shows them. What
is kept follows from the sources alone: no times of execution, no paths, cells numbered in their order, pictures of few colours.
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import io
import os
import pathlib
import re
from typing import Any, Optional

import nbclient
import nbformat

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "notebooks"

# A picture is kept with so many dots an inch, twice what a page shows of them, and so many colours: lines, bands and
# letters need few.
DOTS = 110
COLOURS = 96

# Runs before the first cell and is not kept. Calls that name no instruction set take `cpu`.
BEFORE = """
import sys
import matplotlib
import matplotlib_inline.backend_inline
import equipoise
import equipoise.plot
matplotlib_inline.backend_inline.set_matplotlib_formats("png")
matplotlib.rcParams["figure.dpi"] = matplotlib.rcParams["savefig.dpi"] = {dots}
def chosen(settings):
    return lambda threads, progress, named, within=None: settings(threads, progress, named or {cpu!r}, within)
for module in [module for name, module in sys.modules.items() if name.startswith("equipoise.") and hasattr(module, "settings")]:
    module.settings = chosen(module.settings)
"""


def names() -> list[str]:
    return sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def read(name: str) -> Any:
    return nbformat.read(FOLDER / f"{name}.ipynb", 4)


def code(notebook: Any) -> list[Any]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def source_mark(notebook: Any) -> str:
    """Of all code: what is kept of other code is stale, also where it reads the same."""
    return hashlib.sha256("\n\0".join(cell.source for cell in code(notebook)).encode()).hexdigest()[:16]


def run(notebook: Any, cpu: Optional[str] = None, checks: list[str] = []) -> Any:
    """The notebook as a fresh kernel shows it, without what was kept; `checks` have to be true at its end."""
    before = nbformat.v4.new_code_cell(BEFORE.format(dots=DOTS, cpu=cpu))
    after = [nbformat.v4.new_code_cell(f"assert {check}") for check in checks]
    whole = nbformat.from_dict({**notebook, "cells": [before, *notebook.cells, *after]})
    for cell in code(whole):
        cell.outputs, cell.execution_count = [], None
    # A kernel shows pictures unless it is told to draw elsewhere.
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
    client = nbclient.NotebookClient(
        whole, timeout=300, kernel_name="python3", record_timing=False, resources={"metadata": {"path": str(FOLDER)}}
    )
    client.execute(env={**environment, "PYDEVD_DISABLE_FILE_VALIDATION": "1"})
    whole.cells = whole.cells[1 : len(whole.cells) - len(after)]
    return cleaned(whole)


def joined(outputs: list[Any]) -> list[Any]:
    """What a cell prints, in one piece: a kernel sends it in pieces that depend on time."""
    found: list[Any] = []
    for output in outputs:
        last = found[-1] if found else None
        if last and output.output_type == last.output_type == "stream" and output.name == last.name:
            last.text += output.text
        else:
            found.append(output)
    return found


def cleaned(notebook: Any) -> Any:
    """Without what another run, or another machine, shows otherwise."""
    number = 0
    for place, cell in enumerate(notebook.cells):
        cell.id, cell.metadata = f"cell-{place:02}", {}
        if cell.cell_type != "code":
            continue
        number += 1
        cell.execution_count = number
        cell.outputs = joined(cell.outputs)
        for output in cell.outputs:
            if output.output_type == "execute_result":
                output.execution_count = number
            if "metadata" in output:
                output.metadata = {}
            if "image/png" in output.get("data", {}):
                output.data = {"image/png": output.data["image/png"]}  # its text names the size of a figure only
    notebook.metadata = {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    }
    return notebook


def few_colours(picture: str) -> str:
    """A PNG in base64 with a palette, a third as large; the same in, the same out."""
    from PIL import Image

    image = Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
    small = image.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    file = io.BytesIO()
    small.save(file, "PNG", optimize=True)
    return base64.b64encode(file.getvalue()).decode()


def texts(cell: Any) -> list[str]:
    """What a cell prints and shows as text, in its order."""
    found = []
    for output in cell.outputs:
        if output.output_type == "stream":
            found.append(output.text)
        elif "image/png" not in output.get("data", {}):
            found += [text for kind, text in sorted(output.get("data", {}).items())]
    return found


def pictures(cell: Any) -> list[str]:
    return [output.data["image/png"] for output in cell.outputs if "image/png" in output.get("data", {})]


def renew(name: str, cpu: Optional[str]) -> str:
    notebook = run(read(name), cpu)
    for cell in code(notebook):
        for output in cell.outputs:
            if output.output_type == "error" or output.get("name") == "stderr":
                raise SystemExit(f"{name}: {cell.source}\n{output}")
            if "image/png" in output.get("data", {}):
                output.data["image/png"] = few_colours(output.data["image/png"])
    import equipoise

    notebook.metadata["equipoise"] = {"cpu": cpu or equipoise.cpu_targets()[0], "code": source_mark(notebook)}
    nbformat.validate(notebook)
    text = nbformat.writes(notebook).rstrip("\n") + "\n"
    assert not re.search(r"/(home|work|tmp|usr|root)/", text), f"{name}: a path of this machine"
    (FOLDER / f"{name}.ipynb").write_text(text)
    sizes = [len(picture) * 3 // 4 // 1000 for cell in code(notebook) for picture in pictures(cell)]
    return f"{name}: {len(text) // 1000} kB, pictures of {', '.join(map(str, sizes))} kB"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renew", action="store_true", required=True)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--cpu", help="instruction set, one of equipoise.cpu_targets()")
    asked = parser.parse_args()
    for name in names():
        if not asked.names or any(name.startswith(one) for one in asked.names):
            print(renew(name, asked.cpu), flush=True)


if __name__ == "__main__":
    main()
