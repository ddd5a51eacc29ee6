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
        built = next((folder / "python" / "equipoise").glob("_core*.so"))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


version = re.search(r"project\(equipoise VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())
assert version, "CMakeLists.txt says no version"
setup(version=version[1], ext_modules=[Extension("equipoise._core", [])], cmdclass={"build_ext": CMakeBuild})
