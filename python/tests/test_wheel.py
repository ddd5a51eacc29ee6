"""The wheel: built from what is built, installed without a network into an environment of its own, and used there."""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

import equipoise as eq
from conftest import root


def run(*command: object, **options: object) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=600, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_wheel_works_in_a_clean_environment(tmp_path):
    pytest.importorskip("build")
    pytest.importorskip("ensurepip")
    build = pathlib.Path(eq.__file__).parents[2]  # build/release/python/equipoise/__init__.py
    if not (build / "CMakeCache.txt").exists():
        pytest.skip("the package under test is not in a build folder")
    source = tmp_path / "source"  # builds leave folders beside the sources
    shutil.copytree(root / "python", source / "python", ignore=shutil.ignore_patterns("notebooks", "tests", "build", "*.egg-info"))
    shutil.copy(root / "CMakeLists.txt", source)
    environment = {**os.environ, "EQUIPOISE_BUILD_DIR": str(build)}
    environment.pop("PYTHONPATH", None)
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", tmp_path, source / "python", env=environment)
    (wheel,) = tmp_path.glob("equipoise-*.whl")
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "clean", env=environment)
    python = tmp_path / "clean" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet", wheel, env=environment)
    script = (
        "import equipoise as eq; print(eq.__file__); import equipoise.plot;"
        "print(eq.basin(eq.paper_study('table-2-omega-2.4'), starts=100).counts['balanced'])"
    )
    where, balanced = run(python, "-c", script, cwd=tmp_path, env=environment).split()
    assert str(tmp_path / "clean") in where
    assert int(balanced) == eq.basin(eq.paper_study("table-2-omega-2.4"), starts=100).counts["balanced"]
