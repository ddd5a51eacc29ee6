"""The wheel: CMake builds the module, setuptools packs it. All else is in pyproject.toml."""

import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """Builds the module and takes it: in a folder of its own, or in EQUIPOISE_BUILD_DIR as that is configured already."""

    def build_extension(self, extension: Extension) -> None:
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        folder = pathlib.Path(os.environ.get("EQUIPOISE_BUILD_DIR", pathlib.Path(self.build_temp) / "cmake")).resolve()
        if not (folder / "CMakeCache.txt").exists():
            subprocess.check_call(
                ["cmake", "-S", str(root), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DEQUIPOISE_BUILD_PYTHON=ON", "-DEQUIPOISE_BUILD_PROGRAM=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                 *shlex.split(os.environ.get("EQUIPOISE_CMAKE_ARGS", ""))]
            )
        subprocess.check_call(["cmake", "--build", str(folder), "--target", "equipoise_python"])
        built = max((folder / "python" / "equipoise").glob("_core*.so"), key=lambda file: file.stat().st_mtime)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target.parent / built.name))  # named by the interpreter that CMake was given


def numpy() -> str:
    """The NumPy that the module can be used with. NumPy 2 has other descriptors than pybind11 before 2.12 reads."""
    given = [word for word in shlex.split(os.environ.get("EQUIPOISE_CMAKE_ARGS", "")) if word.startswith("-D")]
    cache = pathlib.Path(os.environ.get("EQUIPOISE_BUILD_DIR", "")) / "CMakeCache.txt"
    if cache.exists():
        given += ["-D" + line for line in cache.read_text().splitlines() if line.startswith("pybind11_DIR")]
    try:
        said = subprocess.run(["cmake", *given, "-P", str(root / "cmake" / "pybind11_version.cmake")], capture_output=True,
                              text=True).stdout
    except FileNotFoundError:  # sources alone are packed without it
        said = ""
    found = re.search(r"-- pybind11 (\d+)\.(\d+)", said)
    return "numpy>=1.24" if found and (int(found[1]), int(found[2])) >= (2, 12) else "numpy>=1.24,<2"


version = re.search(r"project\(equipoise VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())
assert version, "CMakeLists.txt says no version"
setup(version=version[1], install_requires=[numpy()], ext_modules=[Extension("equipoise._core", [])],
      cmdclass={"build_ext": CMakeBuild})
