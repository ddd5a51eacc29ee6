#!/usr/bin/env python3
"""Writes the sources (sdist) and wheels that run on machines without this machine's libraries.

    python3 python/portable_wheel.py build/packages             # sources and a wheel, and what proves the wheel
    python3 python/portable_wheel.py build/packages --python /opt/python3.13/bin/python3  # and a wheel for another Python
    python3 python/portable_wheel.py build/packages --try       # and tries each in an empty Debian that has its Python
    python3 python/portable_wheel.py build/packages --of X.whl  # makes a wheel portable that was built already

There is a wheel for the Python that runs this and one for each other that is named; the library is compiled once. They
have kernels for all instruction sets, no pagmo2, a pybind11 that knows NumPy 2, and a NetCDF library of their own without
HDF5, which files of results do not need. Shared libraries that not every Linux has lie in equipoise.libs, under names that
no other package uses. Needs what ./dev installs for the package, and patchelf; --try also mmdebstrap. Other Pythons need
their headers and nothing else.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

root = pathlib.Path(__file__).resolve().parents[1]
build = root / "build"

#: What every Linux with glibc and C++ has, as manylinux (PEP 600) has it.
EVERYWHERE = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1", "libstdc++.so.6",
              "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}

#: The first glibc of a distribution with a C++ library that new.
GLIBC_OF_GLIBCXX = {(3, 4, 28): (2, 31), (3, 4, 29): (2, 34), (3, 4, 30): (2, 35)}

#: Packages whose code is compiled into the module.
COMPILED_IN = ("libboost-dev", "libeigen3-dev", "librandom123-dev", "nlohmann-json3-dev", "pybind11-dev")

#: The Debian whose NetCDF and pybind11 are taken: NetCDF 4.9.3 or newer, for 4.9.0 cannot do without HDF5; pybind11 2.12 or
#: newer, for NumPy 2.
NEWER_DEBIAN = "trixie"

#: The Debian that has a wheel's Python, by the wheel's tag, and with it a NumPy.
DEBIAN_WITH = {"cp311": "bookworm", "cp313": "trixie"}


def require_tools(builds: bool, tries: bool) -> None:
    """Ends at once, and names what is missing, where something that is needed later is not there."""
    modules = ["wheel", "setuptools", *(["build"] if builds else [])]
    programs = ["patchelf", *(["apt-get", "cmake", "dpkg-deb", "ninja"] if builds else []), *(["mmdebstrap"] if tries else [])]
    missing = [f"Python's {name}" for name in modules if importlib.util.find_spec(name) is None]
    missing += [name for name in programs if shutil.which(name) is None]
    if missing:
        sys.exit(f"portable_wheel: {sys.executable} needs {', '.join(missing)}")


def run(*command: object, **options: object) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, **options)  # type: ignore[call-overload]
    if done.returncode:
        sys.exit(f"portable_wheel: {' '.join(map(str, command))} failed\n{done.stdout}")
    return str(done.stdout)


def from_newer_debian(folder: pathlib.Path, *what: str) -> None:
    """Has apt fetch something of a newer Debian into a folder; apt checks signatures."""
    apt = folder / "apt"
    for part in ("lists/partial", "cache/archives/partial"):
        (apt / part).mkdir(parents=True, exist_ok=True)
    (apt / "sources.list").write_text("".join(
        f"{kind} [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian {NEWER_DEBIAN} main\n"
        for kind in ("deb", "deb-src")
    ))
    own = ["-q", "-o", f"Dir::Etc::SourceList={apt}/sources.list", "-o", "Dir::Etc::SourceParts=-", "-o",
           f"Dir::State::Lists={apt}/lists", "-o", f"Dir::Cache={apt}/cache", "-o", "APT::Sandbox::User=root"]
    run("apt-get", *own, "update", cwd=folder)
    run("apt-get", *own, *what, cwd=folder)


def pybind11() -> pathlib.Path:
    """Headers alone, as the package has them; the folder that CMake reads."""
    folder = build / "pybind11"
    configuration = folder / "usr" / "lib" / "cmake" / "pybind11"
    if not configuration.exists():
        folder.mkdir(parents=True, exist_ok=True)
        from_newer_debian(folder, "download", "pybind11-dev")
        (package,) = folder.glob("pybind11-dev_*.deb")
        run("dpkg-deb", "--extract", package, folder)
    return configuration


def netcdf() -> pathlib.Path:
    """NetCDF for files in the classic formats alone, static; the folder that it is installed in."""
    prefix = build / "netcdf"
    if (prefix / "lib" / "pkgconfig" / "netcdf.pc").exists():
        return prefix
    folder = build / "netcdf-source"
    folder.mkdir(parents=True, exist_ok=True)
    if not list(folder.glob("netcdf_*.orig.tar.*")):
        from_newer_debian(folder, "source", "--tar-only", "netcdf")
    (archive,) = folder.glob("netcdf_*.orig.tar.*")
    run("tar", "xf", archive, "-C", folder)
    (source,) = (path for path in folder.glob("netcdf-c-*") if path.is_dir())
    off = ("BUILD_UTILITIES", "ENABLE_BYTERANGE", "ENABLE_DAP", "ENABLE_EXAMPLES", "ENABLE_FILTER_BLOSC", "ENABLE_FILTER_BZ2",
           "ENABLE_FILTER_SZIP", "ENABLE_FILTER_TESTING", "ENABLE_FILTER_ZSTD", "ENABLE_HDF5", "ENABLE_LIBXML2", "ENABLE_NCZARR",
           "ENABLE_NETCDF_4", "ENABLE_PLUGINS", "ENABLE_S3", "ENABLE_TESTS")
    run("cmake", "-S", source, "-B", source / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_POSITION_INDEPENDENT_CODE=ON", f"-DCMAKE_INSTALL_PREFIX={prefix}", "-DCMAKE_INSTALL_LIBDIR=lib",
        "-DBUILD_SHARED_LIBS=OFF", *(f"-DNETCDF_{option}=OFF" for option in off), stderr=subprocess.DEVNULL)
    run("cmake", "--build", source / "build", "--target", "install", stderr=subprocess.DEVNULL)
    shutil.copy(source / "COPYRIGHT", prefix)
    return prefix


def needed(library: pathlib.Path) -> list[str]:
    """What a library asks for, by name."""
    return re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", library))


def found(library: pathlib.Path) -> dict[str, pathlib.Path]:
    """Where the loader finds what a library needs, and what that needs."""
    return {name: pathlib.Path(path) for name, path in re.findall(r"(\S+) => (/\S+)", run("ldd", library))}


def licence_of(path: pathlib.Path) -> tuple[str, pathlib.Path]:
    """The Debian package that a file belongs to, and that package's copyright file."""
    real = path.resolve()
    spellings = {real, pathlib.Path("/usr", *real.parts[1:]), pathlib.Path("/", *real.parts[2:])}
    for spelling in spellings:
        owner = subprocess.run(["dpkg-query", "-S", str(spelling)], capture_output=True, text=True).stdout
        if owner:
            package = owner.split(":")[0].split(",")[0]
            return package, pathlib.Path("/usr/share/doc", package, "copyright")
    sys.exit(f"portable_wheel: {path} belongs to no package, so its licence is not known")


def least_glibc(libraries: list[pathlib.Path]) -> tuple[int, int]:
    """The oldest glibc that has all that they ask of it and of the C++ library."""
    least = (2, 17)
    for library in libraries:
        versions = run("readelf", "-V", library)
        for major, minor in re.findall(r"GLIBC_(\d+)\.(\d+)", versions):
            least = max(least, (int(major), int(minor)))
        for text in re.findall(r"GLIBCXX_(\d+\.\d+\.\d+)", versions):
            asked = tuple(int(part) for part in text.split("."))
            for cxx, glibc in GLIBC_OF_GLIBCXX.items():
                if asked >= cxx:
                    least = max(least, glibc)
            if asked > max(GLIBC_OF_GLIBCXX):
                sys.exit(f"portable_wheel: no distribution is known to have GLIBCXX_{text}")
    return least


def licences_of_ours() -> dict[str, pathlib.Path]:
    """Of what is taken from the newer Debian, where it was."""
    places = {"netcdf": build / "netcdf" / "COPYRIGHT",
              "pybind11-dev": build / "pybind11" / "usr" / "share" / "doc" / "pybind11-dev" / "copyright"}
    return {name: path for name, path in places.items() if path.exists()}


def made_portable(wheel: pathlib.Path, out: pathlib.Path) -> pathlib.Path:
    """The same wheel with the libraries that it needs inside, named after the Python that its module is for."""
    with tempfile.TemporaryDirectory() as place:
        run(sys.executable, "-m", "wheel", "unpack", "--dest", place, wheel)
        (folder,) = pathlib.Path(place).iterdir()
        (module,) = (folder / "equipoise").glob("_core*.so")
        (info,) = folder.glob("*.dist-info")
        (licences := info / "licenses").mkdir(exist_ok=True)
        (libs := folder / "equipoise.libs").mkdir()
        run("strip", "--strip-unneeded", module)
        inside: dict[str, str] = {}
        for name, path in sorted(found(module).items()):
            if name in EVERYWHERE:
                continue
            digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
            stem, _, version = name.partition(".so")
            inside[name] = f"{stem}-{digest}.so{version}"
            shutil.copy(path, libs / inside[name])
            package, licence = licence_of(path)
            shutil.copy(licence, licences / f"{package}.txt")
        compiled_in = {package: pathlib.Path("/usr/share/doc", package, "copyright") for package in COMPILED_IN}
        for package, licence in (compiled_in | licences_of_ours()).items():
            shutil.copy(licence, licences / f"{package}.txt")
        for library in [module, *libs.iterdir()]:
            for name in needed(library):
                if name in inside:
                    run("patchelf", "--replace-needed", name, inside[name], library)
            run("patchelf", "--set-rpath", "$ORIGIN/../equipoise.libs" if library == module else "$ORIGIN", library)
            if library != module:
                run("patchelf", "--set-soname", library.name, library)
        everything = [module, *libs.iterdir()]
        for library in everything:
            missing = set(needed(library)) - EVERYWHERE - set(inside.values())
            if missing:
                sys.exit(f"portable_wheel: {library.name} needs {', '.join(sorted(missing))}")
        # What no library has would only be missed once it is imported.
        undefined = re.findall(r"undefined symbol: (?!_?Py)(\S+)", run("ldd", "-r", module, stderr=subprocess.STDOUT))
        if undefined:
            sys.exit(f"portable_wheel: nothing has {', '.join(undefined)}")
        major, minor = least_glibc(everything)
        tags = info / "WHEEL"
        python = re.search(r"\.cpython-((\d+)t?)-", module.name)
        assert python, module
        tags.write_text(re.sub(r"^Tag: .*-(?:many)?linux(?:_\d+_\d+)?_([a-z]\w+)$",
                               rf"Tag: cp{python[2]}-cp{python[1]}-manylinux_{major}_{minor}_\1", tags.read_text(), flags=re.MULTILINE))
        out.mkdir(parents=True, exist_ok=True)
        said = run(sys.executable, "-m", "wheel", "pack", "--dest-dir", out, folder)
        name = re.search(r"(\S+\.whl)", said)
        assert name, said
        print(f"{pathlib.Path(name[1]).name}: inside {', '.join(sorted(inside.values())) or 'nothing'}; asks for "
              f"{', '.join(sorted(set().union(*(needed(x) for x in everything)) & EVERYWHERE))}, glibc {major}.{minor}")
        return out / pathlib.Path(name[1]).name


def built(out: pathlib.Path, pythons: list[pathlib.Path]) -> list[pathlib.Path]:
    """Sources into `out`, and the wheels that they make by themselves, one for each Python; where those lie."""
    environment = {**os.environ, "PKG_CONFIG_PATH": str(netcdf() / "lib" / "pkgconfig"), "pybind11_DIR": str(pybind11())}
    arguments = environment.get("EQUIPOISE_CMAKE_ARGS", "-DEQUIPOISE_WITH_PAGMO=OFF -DEQUIPOISE_KERNELS=all")
    raw = build / "raw-wheel"
    for path in (*raw.glob("*.tar.gz"), *raw.glob("*.whl")):
        path.unlink()
    run(sys.executable, "-m", "build", "--no-isolation", "--sdist", "--outdir", raw, root, env=environment)
    (sources,) = raw.glob("*.tar.gz")
    unpacked = raw / "sources" / sources.name.removesuffix(".tar.gz")
    objects = unpacked / "build" / "objects"  # what was compiled before is not compiled again
    for path in unpacked.glob("*"):
        if path.name != "build":
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    with tarfile.open(sources) as archive:
        archive.extractall(unpacked.parent)  # noqa: S202 (our own)
    shutil.move(sources, out / sources.name)
    wheels = []
    for python in pythons:
        # CMake asks the Python anew, and what is not for it is no part of its wheel.
        (objects / "CMakeCache.txt").unlink(missing_ok=True)
        for module in (objects / "python" / "equipoise").glob("_core*.so"):
            module.unlink()
        for folder in (unpacked / "build").glob("lib*"):
            shutil.rmtree(folder)
        place = raw / str(len(wheels))
        shutil.rmtree(place, ignore_errors=True)
        for_it = {"EQUIPOISE_BUILD_DIR": str(objects), "EQUIPOISE_CMAKE_ARGS": f"{arguments} -DPython_EXECUTABLE={python}"}
        run(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", place, unpacked, env=environment | for_it)
        wheels += place.glob("*.whl")
    return wheels


def tried(wheel: pathlib.Path) -> None:
    """Installs the wheel into an empty environment of a Debian that has Python and NumPy and nothing else, and uses it."""
    debian = DEBIAN_WITH.get(wheel.name.split("-")[2])
    if not debian:
        print(f"{wheel.name}: not tried, for no Debian has its Python")
        return
    empty = build / f"empty-{debian}"
    if not (empty / "usr" / "bin" / "python3").exists():
        run("mmdebstrap", "--variant=apt", "--include=python3-venv,python3-numpy", debian, empty)
    shutil.copy(wheel, empty / "tmp")
    shutil.copy(root / "python" / "tests" / "trial.py", empty / "tmp")
    inside = ("chroot", empty, "/bin/sh", "-ec")
    absent = run(*inside, "ldconfig -p | grep -E 'netcdf|hdf5|tbb|hwy|fmt|udunits|pagmo' || true")
    if absent:
        sys.exit(f"portable_wheel: the root is not empty of these libraries:\n{absent}")
    run(*inside, "rm -rf /tmp/venv; python3 -m venv --system-site-packages /tmp/venv; "
                 f"/tmp/venv/bin/pip install --no-index --quiet /tmp/{wheel.name}")
    print(f"{wheel.name} in an empty {debian}:")
    print(run(*inside, "cd /tmp; mount -t proc proc /proc 2>/dev/null || true; /tmp/venv/bin/python trial.py answer.json"), end="")
    for program in [path for path in (build / "package" / "equipoise", build / "release" / "equipoise") if path.exists()][:1]:
        said = run(program, "basin", root / "studies" / "paper" / "table-2-omega-2.4.toml", "--starts", 2000, "--json", "--quiet")
        if json.loads(said)["outcomes"] != json.loads((empty / "tmp" / "answer.json").read_text())["outcomes"]:
            sys.exit(f"portable_wheel: {program} has other shares")
        print(f"the same shares by {program.relative_to(root)}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, help="folder for sources and wheels")
    parser.add_argument("--python", type=pathlib.Path, action="append", default=[], help="another Python to make a wheel for; may be repeated")
    parser.add_argument("--of", type=pathlib.Path, help="a wheel that was built already", metavar="WHEEL")
    parser.add_argument("--try", action="store_true", dest="trial", help="use them in an empty Debian (as root)")
    given = parser.parse_args()
    require_tools(builds=given.of is None, tries=given.trial)
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    for wheel in [given.of] if given.of else built(out, [pathlib.Path(sys.executable), *given.python]):
        made = made_portable(wheel, out)
        if given.trial:
            tried(made)


if __name__ == "__main__":
    main()
