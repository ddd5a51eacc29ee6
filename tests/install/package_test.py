#!/usr/bin/env python3
"""Unpacks the Debian packages and uses what is in them.

    package_test.py [--cpack CPACK] FOLDER SCRATCH

FOLDER has the packages; with --cpack it is a build folder, of which the program's package is made first. Looked at: fields of the
package, the program at work on a packaged study, a manual page and completions for each command and option, and, where they
are, the shared library (a program is compiled and run with it) and lintian's errors.
"""
import argparse
import gzip
import pathlib
import re
import shutil
import subprocess


def said(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout


def only(folder, pattern):
    found = sorted(folder.glob(pattern))
    assert len(found) == 1, f"{folder}: {pattern} is {found}"
    return found[0]


def unpacked(package, folder):
    said("dpkg-deb", "--extract", package, folder)
    return {name: said("dpkg-deb", "--field", package, name).strip() for name in ("Package", "Version", "Depends", "Maintainer")}


def program(package, root, released):
    fields = unpacked(package, root)
    assert fields["Package"] == "equipoise" and "@" in fields["Maintainer"], fields
    # What it needs is found by its libraries; none of them is of these packages, and in a release no MPI comes along.
    assert "libc6" in fields["Depends"] and "libnetcdf19" in fields["Depends"], fields
    assert "equipoise" not in fields["Depends"] and not (released and "mpi" in fields["Depends"]), fields
    binary = root / "usr/bin/equipoise"
    version = said(binary, "--version")
    assert version.startswith("equipoise " + re.match(r"[\d.]+\d", fields["Version"])[0] + "\n"), version
    studies = root / "usr/share/equipoise/studies"
    answer = said(binary, "basin", studies / "paper/table-2-omega-2.4.toml", "--starts", "2000", "--quiet")
    share = float(re.search(r"^balanced +([\d.]+) ", answer, re.MULTILINE)[1])
    assert 55 < share < 66, answer  # the paper's 60.54 %, and five standard errors of 2000 starts
    for file in ("copyright", "changelog.gz", "changelog.Debian.gz", "examples/paper/table-2-omega-2.4.toml"):
        assert (root / "usr/share/doc/equipoise" / file).exists(), file
    return binary


def help_pages(binary, root):
    """Each command and option that the program's help names has its place in a manual page and in three completions."""
    share = root / "usr/share"
    shells = [share / "bash-completion/completions/equipoise", share / "zsh/vendor-completions/_equipoise",
              share / "fish/vendor_completions.d/equipoise.fish"]
    bash, zsh, fish = (file.read_text() for file in shells)
    commands = re.findall(r"^  ([a-z]+) {2,}", said(binary, "--help"), re.MULTILINE)
    assert len(commands) > 15, commands
    pages = {file.name for file in (share / "man/man1").iterdir()}
    assert pages == {"equipoise.1.gz"} | {f"equipoise-{command}.1.gz" for command in commands}, pages
    first = gzip.open(share / "man/man1/equipoise.1.gz", "rt").read()
    for command in commands:
        man = gzip.open(share / f"man/man1/equipoise-{command}.1.gz", "rt").read().replace("\\-", "-")
        assert f"\\fB{command}\\fP" in first and f"'{command}:" in zsh, command
        in_bash = re.search(rf"^    {command}\)$(.*?)^      esac ;;$", bash, re.MULTILINE | re.DOTALL)[1]
        in_zsh = re.search(rf"^    {command}\)$(.*?) ;;$", zsh, re.MULTILINE | re.DOTALL)[1]
        options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", said(binary, command, "--help"), re.MULTILINE))
        assert "--help" in options, command
        for option in options:
            assert f"\\fB{option}\\fP" in man, (command, option)
            assert re.search(rf"[ ']{option}[ ']", in_bash), (command, option)
            assert f"{option}[" in in_zsh, (command, option)
            assert re.search(rf"from {command}'.* -l {option[2:]}\b", fish), (command, option)
    for shell, file in zip(("bash", "zsh", "fish"), shells):
        if shutil.which(shell):
            said(shell, "-n", file)
    words = said("bash", "-c", f"source '{shells[0]}'; COMP_WORDS=(equipoise basin --sta); COMP_CWORD=2; _equipoise; "
                 "echo ${COMPREPLY[@]}").split()
    assert words == ["--starts", "--start-index"], words
    if shutil.which("man"):
        for page in sorted(pages):
            bad = subprocess.run(["man", "--warnings", "-l", share / "man/man1" / page], capture_output=True, text=True)
            assert bad.returncode == 0 and not bad.stderr, bad.stderr


def library(folder, root, example):
    unpacked(only(folder, "libequipoise[0-9]*_*.deb"), root)
    fields = unpacked(only(folder, "libequipoise-dev_*.deb"), root)
    assert f"(= {fields['Version']})" in fields["Depends"] and "json" not in fields["Depends"], fields
    file = only(root, "usr/lib/*/libequipoise.so")
    shown = said("nm", "-DC", "--defined-only", file).splitlines()
    strangers = [line for line in shown if not re.search(r" (?:(?:vtable|typeinfo(?: name)?) for )?equipoise::|EQUIPOISE", line)]
    assert len(shown) > 100 and not strangers, strangers
    inside = [line for line in shown if re.search(r" equipoise::(?:embedded|dense|io::Journal)::", line)]
    assert not inside, inside
    place = file.parent
    said("c++", "-std=c++20", example / "main.cpp", "-o", root / "ball_mass", "-I", root / "usr/include", "-I/usr/include/eigen3",
         "-L", place, "-lequipoise")
    table = said(root / "ball_mass", example / "machine.toml", "0.05", env={"LD_LIBRARY_PATH": str(place)})
    assert re.search(r"^0\.05 +\d+\.\d\d %", table, re.MULTILINE), table


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--cpack")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    asked = parser.parse_args()
    folder, root = asked.folder, asked.scratch / "root"
    shutil.rmtree(asked.scratch, ignore_errors=True)
    root.mkdir(parents=True)
    if asked.cpack:
        folder = asked.scratch / "packages"
        said(asked.cpack, "--config", asked.folder / "CPackConfig.cmake", "-B", folder, "-D", "CPACK_COMPONENTS_ALL=program",
             "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
    binary = program(only(folder, "equipoise_*.deb"), root, not asked.cpack)
    help_pages(binary, root)
    if not asked.cpack:
        library(folder, root, pathlib.Path(__file__).resolve().parents[2] / "examples/ball-mass")
    if shutil.which("lintian") and not asked.cpack:
        told = subprocess.run(["lintian", "--fail-on", "error", *sorted(folder.glob("*.deb"))], capture_output=True, text=True)
        print(told.stdout)
        assert told.returncode == 0, told.stdout + told.stderr


if __name__ == "__main__":
    main()
