"""The notebooks run from top to bottom, show what is kept of them, and come to the numbers that their text speaks of.

What is kept is written by notebooks.py --renew."""

from __future__ import annotations

import base64
import io
import re

import numpy as np
import pytest

nbformat = pytest.importorskip("nbformat")
pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
image = pytest.importorskip("matplotlib.image")

import equipoise as eq
import notebooks
from notebooks import FOLDER

# What each notebook has come to at its end: expressions that have to be true in it. Samples have a stated seed
# and do not change; intervals leave room for what another instruction set rounds otherwise.
CHECKS = {
    "1-first-study": [
        "0.58 < answer.shares['balanced'] < 0.63",  # printed: 60.54 %, standard error of 6000 starts: 0.6 %
        "answer.errors['balanced'][0] < 0.6054 < answer.errors['balanced'][1]",
        "run.radial[-1] < 1e-3 < 0.05 < lost.radial[-250:].max()",
        "comparison.differences[0].low > 0.3",
        "comparison.differences[0].second == 1.0",
    ],
    "2-which-attractors-and-why": [
        "sorted(motions) == ['V1', 'V2', 'V3', 'V4']",
        "abs(motions['V1'].period - 3.9785) < 1e-4",  # docs/evidence/motions-found.csv; refined to 1e-10, printed to 1e-4
        "abs(motions['V4'].period - 16.2484) < 1e-4",
        "motions['V2'].kind == 'quasi-periodic'",
        "balanced.spectrum.real.max() < 0.0",
        "any(e.cause == 'fold' and abs(e.low - 2.904337) < 1e-4 for e in branches['V3'].events)",
    ],
    "3-basins-and-their-borders": [
        "basins.figures['box_dimension'][1] < 1.58 < basins.figures['box_dimension'][2]",  # docs/reference/commands/map.md
        # Both estimate one exponent, each with an interval of about 0.1 from the scales that a map has.
        "abs(alpha - (2 - basins.figures['box_dimension'][0])) < 0.1",
        "abs(alpha - basins.figures['uncertainty_exponent'][0]) < 0.1",
        "1.0 < radius < 1.3",
    ],
    "4-washing-machine": [
        "as_it_is.shares['balanced'] == 1.0",
        "(peak_mm(as_it_is) > 15).mean() > 0.88",  # 91.2 % of 3000 starts, standard error of 1000: 0.9 %
        "(peak_mm(results['and balls of 34 mm']) > 15).mean() < 0.025",  # 0.67 % of 3000 starts
        "250 * run.radial.max() > 15 > 250 * best.radial.max()",
    ],
    "5-table-5-and-the-speed-law": [
        "table['differs'] == 0 and table['agrees'] == 21",
        "laws['published'][-1][0] > 85 and max(share[0] for share in laws['kinematic']) < 70",
        "abs(runs['published'].psi_dot.max() - 4.8) < 0.01",  # a step of the trajectory, 0.25, before the ramp ends
        "difference.high < 0.0",  # the last law asked is the kinematic one
        "detour.shares['balanced'] > 0.98",
    ],
    "6-values-that-are-uncertain": [
        "answer.shares['balanced'] - 0.05 < 0.5 * (share[:3].mean() + share[3:].mean()) < answer.shares['balanced'] + 0.05",
        "indices[-1]['total']['value'] > 0.5 > indices[0]['total']['value']",
    ],
    "7-your-own-integrator": [
        "(here.labels == there).all()",
        "all(14 < errors[k - 1] / errors[k] < 18 for k in (1, 2, 3))",  # 2^4, and the next order's part
        "np.abs(z - straight).max() < 1e-6",
    ],
    "8-where-balance-is-stable": [
        "abs(growth(2.4, 0.05) - said) < 1e-12",
        "growth(1.8, 0.02) > 0 > growth(2.4, 0.02)",
        "abs(measured - growth(2.4, 0.2)) < 1e-4",
    ],
}


def test_every_notebook_is_tested():
    assert notebooks.names() == sorted(CHECKS)


@pytest.mark.parametrize("name", CHECKS)
def test_what_is_kept_is_of_this_code_and_of_no_machine(name):
    text = (FOLDER / f"{name}.ipynb").read_text()
    notebook = notebooks.read(name)
    nbformat.validate(notebook)
    assert notebook.metadata.get("equipoise", {}).get("code") == notebooks.source_mark(notebook), "python/tests/notebooks.py --renew"
    assert not re.search(r"/(home|work|tmp|usr|root)/|0x[0-9a-f]{6}", text)
    for number, cell in enumerate(notebooks.code(notebook), 1):
        assert cell.execution_count == number and not cell.metadata


@pytest.mark.parametrize("name", CHECKS)
def test_pictures_are_small_and_have_captions(name):
    cells = notebooks.read(name).cells
    for cell, after in zip(cells, [*cells[1:], None]):
        for picture in notebooks.pictures(cell) if cell.cell_type == "code" else []:
            assert len(picture) * 3 / 4 < 100e3
            assert after is not None and re.match(r"\*[^*]+\*(\n\n|$)", after.source), cell.source


def test_they_begin_with_a_question_and_end_with_what_to_read_next():
    for name in CHECKS:
        told = [cell.source for cell in notebooks.read(name).cells if cell.cell_type == "markdown"]
        assert re.match(r"# \d\. ", told[0]) and "?**" in told[0] and "**Next:**" in told[-1], name


@pytest.mark.parametrize("name", CHECKS)
def test_links_of_notebooks_lead_somewhere(name):
    for cell in notebooks.read(name).cells:
        for target in re.findall(r"\]\(([^)#:]+)[^)]*\)", cell.source if cell.cell_type == "markdown" else ""):
            assert (FOLDER / target).exists(), target


NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?")


def same_within(kept, shown):
    """Whether two texts have the same words, and numbers that another instruction set may have rounded: of some thousand
    starts one or two on a border end otherwise, which moves a share, its interval and what follows from it a little."""
    if NUMBER.sub("#", kept).split() != NUMBER.sub("#", shown).split():
        return False
    for one, other in zip(NUMBER.findall(kept), NUMBER.findall(shown)):
        digits = len(one.partition("e")[0].partition(".")[2])
        last = 10.0 ** -digits * (10.0 ** float(one.partition("e")[2]) if "e" in one else 1.0)
        if abs(float(one) - float(other)) > max(2.01 * last, 0.05 * abs(float(one))):
            return False
    return True


def test_texts_are_compared_number_by_number():
    assert same_within("balanced: 0.605, between 0.593", "balanced: 0.606, between 0.594")
    assert not same_within("balanced: 0.605", "balanced: 0.705")
    assert not same_within("balanced: 0.605", "co-drifting: 0.605")
    assert not same_within("error 5.7e-06", "error 5.7e-05")


def pixels(picture):
    return image.imread(io.BytesIO(base64.b64decode(picture)))[..., :3]


def difference(kept, shown):
    """Mean difference of two pictures, 0 to 1; margins of another release of matplotlib are cut off."""
    one, other = pixels(kept), pixels(shown)
    height, width = min(len(one), len(other)), min(one.shape[1], other.shape[1])
    assert max(len(one), len(other)) - height < 12 and max(one.shape[1], other.shape[1]) - width < 12, "another size"
    return np.abs(one[:height, :width] - other[:height, :width]).mean()


@pytest.mark.parametrize("name", CHECKS)
def test_notebooks_show_what_is_kept_and_come_to_their_numbers(name):
    kept = notebooks.read(name)
    cpu = eq.cpu_targets()[0]
    shown = notebooks.run(kept, checks=CHECKS[name])
    drawn = 0
    for old, new in zip(notebooks.code(kept), notebooks.code(shown), strict=True):
        assert not [output for output in new.outputs if output.get("name") == "stderr"]
        if kept.metadata.equipoise.cpu == cpu:  # same input, same bits
            assert notebooks.texts(old) == notebooks.texts(new), f"{old.source}\npython/tests/notebooks.py --renew"
        else:
            for one, other in zip(notebooks.texts(old), notebooks.texts(new), strict=True):
                assert same_within(one, other), f"{old.source}\n{one}\n{other}"
        for one, other in zip(notebooks.pictures(old), notebooks.pictures(new), strict=True):
            assert difference(one, other) < 0.05, f"{old.source}: another picture"
            drawn += 1
    assert drawn
