"""What the tests share: a small study, and the program that must say the same."""

from __future__ import annotations

import os
import pathlib
import subprocess

import numpy as np
import pytest

import equipoise as eq

root = pathlib.Path(__file__).resolve().parents[2]
studies = root / "studies"


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes seconds; ctest runs it by itself, in python.package.slow")


def described_alike(dataset, stored):
    """Every variable of a dataset is in the file, along the same dimensions, of the same type, described alike."""
    for name, own in dataset.variables.items():
        kept = stored.variables[name]
        assert (own.dims, own.dtype) == (kept.dims, kept.dtype), name
        described = [{key: np.asarray(value).tolist() for key, value in v.attrs.items() if key != "_FillValue"} for v in (own, kept)]
        assert described[0] == described[1], name


@pytest.fixture(scope="session")
def study() -> eq.Study:
    """The paper's rotor at Omega = 2.4, 400 starts."""
    return eq.paper_study("table-2-omega-2.4").replace(**{"sampling.starts": 400})


@pytest.fixture(scope="session")
def easy(study: eq.Study) -> eq.Study:
    """The same in thicker oil: every start balances, and the search takes a third as long."""
    return study.replace({"balancer.drag": 0.25})


@pytest.fixture(scope="session")
def answer(study: eq.Study) -> eq.BasinResult:
    return eq.basin(study)


@pytest.fixture(scope="session")
def program():
    """Runs the command-line program of the same build."""
    path = os.environ.get("EQUIPOISE_PROGRAM", str(root / "build" / "release" / "equipoise"))
    if not os.access(path, os.X_OK):
        pytest.skip("the program is not built")

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, timeout=300)

    return run
