#!/usr/bin/env python3
"""Which symbols the shared library shows: those that its installed headers declare, and no other.

    exported_symbols.py OUT.map NODE NM HEADER... -- OBJECT...

Writes a version script for the linker. A symbol is shown if the headers declare its function, or the class that its table
and type information are of, and each class and namespace around it. What headers define (templates, inline functions) each
program compiles for itself.
"""
import re
import subprocess
import sys

NAME = r"~?[A-Za-z_]\w*"
OPERATOR = r"operator\s*(?:\(\)|\[\]|\"\"\s*\w+|[^\s\w(]+|\w+(?: \w+)*)"


def words_of(paths):
    """(namespaces, classes, functions and variables) that the headers name."""
    text = ""
    for path in paths:
        with open(path, encoding="utf-8") as file:
            text += re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\\n]|\\.)*\"", " ", file.read(), flags=re.S)
    namespaces = {part for name in re.findall(r"\bnamespace\s+([\w:]+)\s*\{", text) for part in name.split("::")}
    classes = set(re.findall(r"\b(?:class|struct)\s+([A-Za-z_]\w*)", text))
    functions = set(re.findall(rf"({NAME})\s*\(", text)) | set(re.findall(rf"\bextern\s[^;(]*?({NAME})\s*;", text))
    functions |= {re.sub(r"\s", "", name) for name in re.findall(rf"({OPERATOR})\s*\(", text)}
    return namespaces, classes, functions


def parts_of(name):
    """The qualified name's parts, without arguments of templates and functions."""
    name = name.replace("[abi:cxx11]", "").replace("operator()", "operator@").replace("(anonymous namespace)", "@")
    name = re.sub(r"\boperator(<=>|<<=?|>>=?|->\*?|<=?|>=?)", lambda m: "operator" + "#" * len(m[1]), name)
    plain, depth = "", 0
    for c in name:
        if c == "(" and depth == 0:
            break
        depth += (c == "<") - (c == ">")
        if depth == 0 and c != ">":
            plain += c
    return plain.split(" ")[-1].split("::") if "operator" not in plain else plain.split("::")


def is_shown(demangled, namespaces, classes, functions):
    about = re.match(r"(?:vtable|typeinfo(?: name)?|VTT) for (.*)", demangled)
    parts = parts_of(about[1] if about else demangled)
    if parts[0] != "equipoise":
        return False
    if not all(part in namespaces or part in classes for part in parts[:-1]):
        return False
    if about:
        return parts[-1] in classes
    return "operator" in parts[-1] or parts[-1] in functions


def main():
    out, node, nm, *rest = sys.argv[1:]
    cut = rest.index("--")
    words = words_of(rest[:cut])
    shown = set()
    for line in subprocess.run([nm, "--defined-only", "--extern-only", "--format=posix", *rest[cut + 1 :]],
                               check=True, capture_output=True, text=True).stdout.splitlines():
        fields = line.split(" ")
        if len(fields) > 1 and fields[1] in "TDBRV":
            shown.add(fields[0])
    mangled = sorted(shown)
    names = subprocess.run(["c++filt"], input="\n".join(mangled), check=True, capture_output=True, text=True).stdout
    kept = [symbol for symbol, name in zip(mangled, names.splitlines()) if is_shown(name, *words)]
    if not kept:
        raise SystemExit(f"exported_symbols.py: no symbol of {len(mangled)} is declared in the headers")
    text = f"{node} {{\n  global:\n" + "".join(f"    {symbol};\n" for symbol in kept) + "  local: *;\n};\n"
    with open(out, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
