"""The guide's page runs: its examples one after another, on smaller samples, and what they say they come to."""

from __future__ import annotations

import re

import numpy as np
import pytest
from conftest import root

pytest.importorskip("matplotlib")
pytest.importorskip("scipy")

import equipoise as eq

PAGE = (root / "docs" / "reference" / "python.md").read_text(encoding="utf-8")

# As the page has it, and what takes its place here: the same calls on smaller samples.
SMALLER = {
    "starts=20000": "starts=600",
    "starts=4000": "starts=300",
    "starts=10**7": "starts=600",
    "progress=True": "progress=False",
    "half_width=0.002": "half_width=0.04",
    "eq.attractors(study)": "eq.attractors(study, starts=300)",
    "1.4, 6.5, 0.05": "2.9, 3.0, 0.1",
    "1.5:6:0.1": "2.4:2.6:0.2",
    "size=(512, 512)": "size=(32, 32)",
    'within="60s"': "trajectories=10000",
    "at_least=0.95": "at_least=0.95, starts=200, precision=0.1",
}


def examples():
    return re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def test_what_is_made_smaller_stands_on_the_page():
    text = "\n".join(examples())
    assert [words for words in SMALLER if words not in text] == []


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import scipy.integrate

    monkeypatch.chdir(tmp_path)
    eq.paper_study("table-2-omega-2.4").save("spin-up.toml")
    machine = eq.Study.from_file(root / "studies" / "examples" / "washing-machine.toml")
    names = {"plt": plt, "scipy": scipy, "machine": machine, "angles": np.array([[1.0, 4.0], [0.5, 0.6]]),
             "array": np.zeros((3, 8))}
    for k, example in enumerate(examples()):
        for words, smaller in SMALLER.items():
            example = example.replace(words, smaller)
        exec(compile(example, f"example {k + 1}", "exec"), names)  # noqa: S102 (our own page)
    plt.close("all")
    low, high = names["answer"].errors["balanced"]
    assert low < 0.604 < high  # as the page says
    assert names["comparison"].differences[0].low > 0.0
    assert names["mapper"]([1.0, 4.0]).name == "balanced"


def test_the_first_ten_minutes_run(tmp_path, monkeypatch):
    """Its statements run, on fewer starts; the one that is wrong is refused in the page's words."""
    (session,) = re.findall(r"^```pycon\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    blocks = re.findall(r"^>>> \S.*(?:\n\.\.\. .*)*", session, re.MULTILINE)
    assert len(blocks) == 13 and blocks[-1] == ">>> exit()"
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    refused = []
    for block in blocks[:-1]:
        code = "\n".join(line[4:] for line in block.split("\n")) + "\n"
        try:
            exec(compile(code.replace("starts=4000", "starts=300").replace("starts=1000", "starts=300"), "session", "single"), names)  # noqa: S102
        except eq.StudyError as error:
            refused.append(str(error))
    assert len(refused) == 1 and refused[0] in session
    assert names["answer"].shares["balanced"] < 0.4 and (tmp_path / "fan.png").stat().st_size > 0


def test_every_picture_and_call_is_on_the_page():
    for name in eq.plot.__all__:
        assert f"eq.plot.{name}(" in PAGE, name
    calls = [name for name in eq.__all__ if name[0].islower() and name != "plot"]
    assert len(calls) == 28
    assert "eq.map(" in PAGE  # not among those that `from equipoise import *` takes
    for name in calls:
        assert f"eq.{name}(" in PAGE, name


def test_links_of_the_page_lead_somewhere():
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", PAGE):
        assert (root / "docs" / "reference" / target).exists(), target
