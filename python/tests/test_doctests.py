"""Docstrings: every example runs and gives what it shows, and no public name lacks arguments, results, errors or an example."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
import warnings

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("scipy")

import equipoise as eq

MODULES = ["equipoise", *sorted(m.name for m in pkgutil.walk_packages(eq.__path__, "equipoise.") if not m.name.endswith("_core"))]
PUBLIC = {
    **{name: getattr(eq, name) for name in (*eq.__all__, "map") if name != "plot"},
    **{f"plot.{name}": getattr(eq.plot, name) for name in eq.plot.__all__},
}
FUNCTIONS = sorted(name for name, given in PUBLIC.items() if not inspect.isclass(given))
CLASSES = sorted(name for name, given in PUBLIC.items() if inspect.isclass(given))

#: These raise nothing that depends on how they are called.
NEVER_RAISE = {"cpu_targets", "machines", "paper_studies", "reproducible"}


def doc(name: str) -> str:
    return inspect.getdoc(PUBLIC[name]) or ""


def section(text: str, title: str) -> str:
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^[A-Z]\w+\n-+$|\Z)", text, re.MULTILINE | re.DOTALL)
    return found[1] if found else ""


def listed(text: str) -> set[str]:
    """Names at the left of a section's lines: "x, y : str"."""
    heads = [line.split(" :")[0] for line in text.splitlines() if line and not line.startswith(" ")]
    return {name.strip(" *") for head in heads for name in head.split(",")}


def names_of_examples(study):
    import matplotlib

    matplotlib.use("Agg")
    import scipy.integrate

    return {
        "eq": eq, "np": np, "scipy": scipy, "warnings": warnings, "study": study,
        "oiled": study.replace({"balancer.drag": 0.25}), "machine": eq.new("washing-machine"),
    }


@pytest.mark.parametrize("module", MODULES)
def test_examples_give_what_they_show(module, study, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    said: list[str] = []
    with warnings.catch_warnings():
        for test in doctest.DocTestFinder(exclude_empty=True).find(importlib.import_module(module), globs=names_of_examples(study)):
            runner.run(test, out=said.append)
    if module.startswith("equipoise.plot"):
        import matplotlib.pyplot as plt

        plt.close("all")
    assert runner.failures == 0, "".join(said)


def test_no_example_is_skipped():
    for module in MODULES:
        assert "doctest: +SKIP" not in inspect.getsource(importlib.import_module(module)), module


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_state_arguments_results_errors_and_an_example(name):
    text = doc(name)
    arguments = set(inspect.signature(PUBLIC[name]).parameters)
    assert listed(section(text, "Parameters")) == arguments
    assert section(text, "Returns") and ">>> " in section(text, "Examples")
    assert section(text, "Raises") or name in NEVER_RAISE


@pytest.mark.parametrize("name", CLASSES)
def test_classes_describe_their_attributes_and_show_an_example(name):
    text, given = doc(name), PUBLIC[name]
    assert ">>> " in section(text, "Examples")
    described = set(re.findall(r"\w+", text))
    for attribute in {*vars(given), *vars(given).get("__annotations__", ())}:
        member = inspect.getattr_static(given, attribute, None)
        own = inspect.getdoc(member.__func__ if isinstance(member, classmethod) else member) if callable(member) or isinstance(
            member, (property, classmethod)) else ""
        assert attribute.startswith("_") or own or attribute in described, attribute
