"""Sources and wheel: made from what is built, installed without a network into an environment of its own, and used there."""

from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from email.parser import Parser

import pytest

import equipoise as eq
from conftest import root

sys.path.insert(0, str(root / "python"))

BUILT_FROM = ("cmake", "src", "studies", "python/bindings", "python/equipoise")


def run(*command: object, **options: object) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=600, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def without_ours() -> dict[str, str]:
    """The environment without the package under test."""
    environment = dict(os.environ)
    environment.pop("PYTHONPATH", None)
    return environment


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The sdist, made in a copy: builds leave folders beside the sources."""
    pytest.importorskip("build")
    folder = tmp_path_factory.mktemp("sources")
    away = shutil.ignore_patterns("build", ".git", ".ci", "node_modules", "*.egg-info", "__pycache__", "web", "*.nc")
    shutil.copytree(root, folder / "copy", ignore=away)
    run(sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", folder, folder / "copy", env=without_ours())
    (archive,) = folder.glob("equipoise-*.tar.gz")
    return archive


@pytest.fixture(scope="module")
def wheel(sources, tmp_path_factory):
    """A wheel from the sdist alone, but for the module: its objects are those of the package under test."""
    build = pathlib.Path(eq.__file__).parents[2]  # build/release/python/equipoise/__init__.py
    if not (build / "CMakeCache.txt").exists():
        pytest.skip("the package under test is not in a build folder")
    folder = tmp_path_factory.mktemp("wheel")
    with tarfile.open(sources) as archive:
        archive.extractall(folder)  # noqa: S202 (our own)
    (unpacked,) = folder.iterdir()
    environment = {**without_ours(), "EQUIPOISE_BUILD_DIR": str(build)}
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder, unpacked, env=environment)
    (made,) = folder.glob("equipoise-*.whl")
    return made


def installed(wheel, folder):
    """The interpreter of a new environment that has the wheel."""
    pytest.importorskip("ensurepip")
    run(sys.executable, "-m", "venv", "--system-site-packages", folder / "clean", env=without_ours())
    python = folder / "clean" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet", wheel, env=without_ours())
    return python


def test_the_sources_hold_all_that_is_built_from(sources):
    with tarfile.open(sources) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    missing = [
        str(path.relative_to(root))
        for folder in BUILT_FROM
        for path in (root / folder).rglob("*")
        if path.is_file() and path.suffix not in (".pyc", ".nc") and str(path.relative_to(root)) not in names
    ]
    assert missing == []
    assert {"CMakeLists.txt", "LICENSE", "pyproject.toml", "setup.py", "python/CMakeLists.txt"} <= names
    assert not any(name.startswith(("build/", "web/", "docs/figures")) for name in names)


def test_the_sources_configure_by_themselves(sources, tmp_path):
    with tarfile.open(sources) as archive:
        archive.extractall(tmp_path)  # noqa: S202 (our own)
    (unpacked,) = tmp_path.iterdir()
    said = run("cmake", "-S", unpacked, "-B", tmp_path / "build", "-G", "Ninja", "-DEQUIPOISE_BUILD_PYTHON=ON",
               "-DEQUIPOISE_BUILD_PROGRAM=OFF", f"-DPython_EXECUTABLE={sys.executable}")
    assert "Generating done" in said


def test_a_wheel_says_what_it_is(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (metadata,) = (name for name in archive.namelist() if name.endswith("METADATA"))
        told = Parser().parsestr(archive.read(metadata).decode())
        assert any(name.endswith("LICENSE") for name in archive.namelist())
    assert told["Name"] == "equipoise" and told["Version"] == eq.__version__ and told["License"] == "MIT"
    assert told["Author"] == "The Equipoise developers" and told["Requires-Python"] == ">=3.11"
    assert any(re.match(r"numpy\b.*>=1\.24", text) for text in told.get_all("Requires-Dist"))
    assert "License :: OSI Approved :: MIT License" in told.get_all("Classifier")
    assert "import equipoise as eq" in told.get_payload()


@pytest.mark.parametrize("pybind11, needed", [("2.10.3", "numpy<2,>=1.24"), ("2.12.0", "numpy>=1.24"), ("3.0.1", "numpy>=1.24")])
def test_the_pybind11_that_is_found_says_which_numpy_is_needed(pybind11, needed, tmp_path):
    (tmp_path / "pybind11ConfigVersion.cmake").write_text(f'set(PACKAGE_VERSION "{pybind11}")\n')
    (tmp_path / "pybind11Config.cmake").write_text("")
    run(sys.executable, "setup.py", "--quiet", "egg_info", "--egg-base", tmp_path, cwd=root,
        env={**without_ours(), "pybind11_DIR": str(tmp_path)})
    assert (tmp_path / "equipoise.egg-info" / "requires.txt").read_text().split("\n")[0] == needed


def test_a_wheel_works_in_a_clean_environment(wheel, tmp_path):
    python = installed(wheel, tmp_path)
    script = (
        "import equipoise as eq; print(eq.__file__); import equipoise.plot;"
        "print(eq.basin(eq.paper_study('table-2-omega-2.4'), starts=100).counts['balanced'])"
    )
    where, balanced = run(python, "-c", script, cwd=tmp_path, env=without_ours()).split()
    assert str(tmp_path / "clean") in where
    assert int(balanced) == eq.basin(eq.paper_study("table-2-omega-2.4"), starts=100).counts["balanced"]


def test_a_portable_wheel_brings_its_libraries(wheel, tmp_path):
    """None but those that every Linux has is loaded from this machine. (This build's own; a release's are fewer.)"""
    if not shutil.which("patchelf"):
        pytest.skip("patchelf is not there")
    import portable_wheel

    made = portable_wheel.made_portable(wheel, tmp_path)
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    assert f"-{python}-{python}-manylinux_2_" in made.name
    with zipfile.ZipFile(made) as archive:
        names = archive.namelist()
    assert any("equipoise.libs/libtbb-" in name for name in names)
    assert any(name.endswith("licenses/libtbb12.txt") for name in names)
    python = installed(made, tmp_path)
    script = (
        "import numpy; maps = lambda: {line.split()[-1] for line in open('/proc/self/maps') if '.so' in line};"
        "before = maps(); import equipoise as eq;"
        "eq.basin(eq.paper_study('table-2-omega-2.4'), starts=100, output='kept.nc'); print(*(maps() - before))"
    )
    loaded = [pathlib.Path(path) for path in run(python, "-c", script, cwd=tmp_path, env=without_ours()).split()]
    foreign = [path.name for path in loaded if tmp_path not in path.parents]
    assert any(path.name.startswith("_core") for path in loaded)
    # The interpreter's own modules apart.
    assert [name for name in foreign if not name.startswith(tuple(portable_wheel.EVERYWHERE)) and "cpython" not in name] == []


def test_a_portable_wheel_is_named_after_the_python_of_its_module(wheel, tmp_path):
    if not shutil.which("patchelf"):
        pytest.skip("patchelf is not there")
    import portable_wheel

    run(sys.executable, "-m", "wheel", "unpack", "--dest", tmp_path / "in", wheel)
    (folder,) = (tmp_path / "in").iterdir()
    (module,) = (folder / "equipoise").glob("_core*.so")
    module.rename(module.with_name("_core.cpython-399-x86_64-linux-gnu.so"))
    run(sys.executable, "-m", "wheel", "pack", "--dest-dir", tmp_path, folder)
    (other,) = tmp_path.glob("*.whl")
    assert "-cp399-cp399-manylinux_2_" in portable_wheel.made_portable(other, tmp_path / "out").name
