#!/usr/bin/env python3
"""Writes the sources (sdist) and a wheel that runs on machines without this machine's libraries.

    python3 python/portable_wheel.py build/packages             # both, and what proves the wheel
    python3 python/portable_wheel.py build/packages --try       # and tries it in an empty Debian
    python3 python/portable_wheel.py build/packages --of X.whl  # makes a wheel portable that was built already

The wheel has kernels for all instruction sets, no pagmo2, and a NetCDF library of its own without HDF5, which files of
results do not need. Shared libraries that not every Linux has lie in equipoise.libs, under names that no other package
uses. Needs what ./dev installs for the package, and patchelf; --try also mmdebstrap.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
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

#: The Debian whose NetCDF is taken: 4.9.3 or newer, for 4.9.0 cannot do without HDF5.
NETCDF_OF = "trixie"


def require_tools(builds: bool, tries: bool) -> None:
    """Ends at once, and names what is missing, where something that is needed later is not there."""
    modules = ["wheel", "setuptools", *(["build"] if builds else [])]
    programs = ["patchelf", *(["apt-get", "cmake", "ninja"] if builds else []), *(["mmdebstrap"] if tries else [])]
    missing = [f"Python's {name}" for name in modules if importlib.util.find_spec(name) is None]
    missing += [name for name in programs if shutil.which(name) is None]
    if missing:
        sys.exit(f"portable_wheel: {sys.executable} needs {', '.join(missing)}")


def run(*command: object, **options: object) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, **options)  # type: ignore[call-overload]
    if done.returncode:
        sys.exit(f"portable_wheel: {' '.join(map(str, command))} failed\n{done.stdout}")
    return str(done.stdout)


def debian_source(package: str, folder: pathlib.Path) -> pathlib.Path:
    """The folder with a package's upstream archive, fetched by apt and checked by its signatures."""
    apt = folder / "apt"
    for part in ("lists/partial", "cache/archives/partial"):
        (apt / part).mkdir(parents=True, exist_ok=True)
    (apt / "sources.list").write_text(
        "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] "
        f"http://deb.debian.org/debian {NETCDF_OF} main\n"
    )
    own = ["-q", "-o", f"Dir::Etc::SourceList={apt}/sources.list", "-o", "Dir::Etc::SourceParts=-", "-o",
           f"Dir::State::Lists={apt}/lists", "-o", f"Dir::Cache={apt}/cache", "-o", "APT::Sandbox::User=root"]
    run("apt-get", *own, "update", cwd=folder)
    run("apt-get", *own, "source", "--tar-only", package, cwd=folder)
    return folder


def netcdf() -> pathlib.Path:
    """NetCDF for files in the classic formats alone, static; the folder that it is installed in."""
    prefix = build / "netcdf"
    if (prefix / "lib" / "pkgconfig" / "netcdf.pc").exists():
        return prefix
    folder = build / "netcdf-source"
    folder.mkdir(parents=True, exist_ok=True)
    archives = list(folder.glob("netcdf_*.orig.tar.*")) or list(debian_source("netcdf", folder).glob("netcdf_*.orig.tar.*"))
    run("tar", "xf", archives[0], "-C", folder)
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


def made_portable(wheel: pathlib.Path, out: pathlib.Path, netcdf_copyright: pathlib.Path | None = None) -> pathlib.Path:
    """The same wheel with the libraries that it needs inside."""
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
        for package in COMPILED_IN:
            shutil.copy(pathlib.Path("/usr/share/doc", package, "copyright"), licences / f"{package}.txt")
        if netcdf_copyright:
            shutil.copy(netcdf_copyright, licences / "netcdf.txt")
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
        text = tags.read_text()
        tags.write_text(re.sub(r"-linux_(\w+)$", rf"-manylinux_{major}_{minor}_\1", text, flags=re.MULTILINE))
        said = run(sys.executable, "-m", "wheel", "pack", "--dest-dir", out, folder)
        name = re.search(r"(\S+\.whl)", said)
        assert name, said
        print(f"{pathlib.Path(name[1]).name}: inside {', '.join(sorted(inside.values())) or 'nothing'}; asks for "
              f"{', '.join(sorted(set().union(*(needed(x) for x in everything)) & EVERYWHERE))}, glibc {major}.{minor}")
        return out / pathlib.Path(name[1]).name


def built(out: pathlib.Path) -> pathlib.Path:
    """Sources into `out`, and the wheel that they make by themselves; where that lies."""
    library = netcdf()
    environment = {**os.environ, "PKG_CONFIG_PATH": str(library / "lib" / "pkgconfig")}
    environment.setdefault("EQUIPOISE_CMAKE_ARGS", "-DEQUIPOISE_WITH_PAGMO=OFF -DEQUIPOISE_KERNELS=all")
    raw = build / "raw-wheel"
    shutil.rmtree(raw, ignore_errors=True)
    run(sys.executable, "-m", "build", "--no-isolation", "--outdir", raw, root, env=environment)
    (sources,) = raw.glob("*.tar.gz")
    shutil.move(sources, out / sources.name)
    (wheel,) = raw.glob("*.whl")
    return wheel


TRIAL = """
import time; begin = time.perf_counter()
import equipoise as eq
answer = eq.basin(eq.paper_study('table-2-omega-2.4'), starts=2000)
print(eq.__file__, answer.counts['balanced'], 'of 2000 balanced')
machine = eq.new('washing-machine')
eq.basin(machine, starts=200, output='/tmp/trial.nc')
print(eq.inspect('/tmp/trial.nc').facts)
eq.report(machine, 200, changes=False).save('/tmp/trial.html')
print(f'{time.perf_counter() - begin:.1f} s')
"""


def tried(wheel: pathlib.Path) -> None:
    """Installs the wheel into an empty environment of a Debian that has Python and NumPy and nothing else, and uses it."""
    empty = build / "empty-root"
    if not (empty / "usr" / "bin" / "python3").exists():
        run("mmdebstrap", "--variant=apt", "--include=python3-venv,python3-numpy", "bookworm", empty)
    shutil.copy(wheel, empty / "tmp")
    (empty / "tmp" / "trial.py").write_text(TRIAL)
    inside = ("chroot", empty, "/bin/sh", "-ec")
    absent = run(*inside, "ldconfig -p | grep -E 'netcdf|hdf5|tbb|hwy|fmt|udunits|pagmo' || true")
    if absent:
        sys.exit(f"portable_wheel: the root is not empty of these libraries:\n{absent}")
    run(*inside, "rm -rf /tmp/venv; python3 -m venv --system-site-packages /tmp/venv; "
                 f"/tmp/venv/bin/pip install --no-index --no-deps --quiet /tmp/{wheel.name}")
    print(run(*inside, "cd /tmp; mount -t proc proc /proc 2>/dev/null || true; /tmp/venv/bin/python /tmp/trial.py"), end="")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, help="folder for sources and wheel")
    parser.add_argument("--of", type=pathlib.Path, help="a wheel that was built already", metavar="WHEEL")
    parser.add_argument("--try", action="store_true", dest="trial", help="use it in an empty Debian (as root)")
    given = parser.parse_args()
    require_tools(builds=given.of is None, tries=given.trial)
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    copyright_ = build / "netcdf" / "COPYRIGHT"
    wheel = made_portable(given.of or built(out), out, copyright_ if copyright_.exists() else None)
    if given.trial:
        tried(wheel)


if __name__ == "__main__":
    main()
