"""The C++ reference: Doxygen reads the public headers (those that are installed), a page for each chapter shows them."""
import re
import shutil
import subprocess
from xml.etree import ElementTree

CHAPTERS = {  # as the library is laid out, from the bottom up
    "": "The whole library in one header", "core": "Errors, threads, statistics", "machine": "The machine and its equations",
    "study": "Studies", "results": "Results and their files", "simulation": "Trajectories", "attractors": "Attractors",
    "classification": "From a state to its outcome", "analyses": "Questions about many runs", "report": "Text, pictures, pages",
    "extras": "Proofs, bifurcations, the paper",
}


def headers(source):
    """What the front doors include, as cmake/install.cmake finds it."""
    found, left = [], ["equipoise.hpp", "paper.hpp"]
    while left:
        name = left.pop(0)
        path = source / "src/equipoise" / name
        if name not in found and path.exists():  # the version's header is made by the build
            found.append(name)
            left += re.findall(r'^#include "equipoise/([^"]+)"', path.read_text(), re.MULTILINE)
    return found


def doxygen(source, build, site, names):
    folder = site / "doxygen"
    folder.mkdir(parents=True, exist_ok=True)
    base = source / "src/equipoise"
    version = build / "src/equipoise/include/equipoise/core/base/version.hpp"
    files = [base / name for name in names] + ([version] if version.exists() else [])
    newest = max(file.stat().st_mtime for file in files)
    mark = folder / "xml/index.xml"
    if mark.exists() and mark.stat().st_mtime > newest:
        return folder / "xml"
    shutil.rmtree(folder / "xml", ignore_errors=True)
    settings = {
        "PROJECT_NAME": "equipoise", "INPUT": " ".join(f'"{file}"' for file in files), "OUTPUT_DIRECTORY": f'"{folder}"',
        "GENERATE_XML": "YES", "GENERATE_HTML": "NO", "GENERATE_LATEX": "NO", "XML_PROGRAMLISTING": "NO", "QUIET": "YES",
        "EXTRACT_ALL": "YES", "STRIP_FROM_PATH": f'"{base}"', "FULL_PATH_NAMES": "YES", "JAVADOC_AUTOBRIEF": "NO",
        "WARN_IF_UNDOCUMENTED": "NO", "WARN_AS_ERROR": "NO", "WARN_IF_DOC_ERROR": "NO", "HIDE_FRIEND_COMPOUNDS": "YES",
        "EXTENSION_MAPPING": "hpp=C++", "MARKDOWN_SUPPORT": "YES", "HAVE_DOT": "NO", "SORT_MEMBER_DOCS": "NO",
        "MACRO_EXPANSION": "NO", "EXTRACT_PRIVATE": "NO", "WARNINGS": "NO",
    }
    (folder / "Doxyfile").write_text("".join(f"{key} = {value}\n" for key, value in settings.items()))
    subprocess.run(["doxygen", str(folder / "Doxyfile")], check=True)
    by_file(folder / "xml")
    return folder / "xml"


def by_file(xml):
    """Puts what a namespace holds into the files that declare it, where Doxygen only names the namespace: a page a file follows."""
    for path in xml.glob("*.xml"):  # headers are named in comments, and have no place of their own here
        path.write_text(re.sub(r'<ref refid="\w+_8hpp"[^>]*>([^<]*)</ref>', r"\1", path.read_text()))
    found = {}
    for path in xml.glob("namespace*.xml"):
        for member in ElementTree.parse(path).iter("memberdef"):
            value = member.find("initializer")
            if value is not None and len("".join(value.itertext())) > 60:  # a table, which is no part of the interface
                member.remove(value)
            found.setdefault(member.find("location").get("file"), []).append(member)
    for path in xml.glob("*_8hpp.xml"):
        tree = ElementTree.parse(path)
        compound = tree.getroot().find("compounddef")
        name = compound.find("location").get("file")
        classes = {one.text for one in compound.findall("innerclass")}
        for one in compound.findall("innernamespace"):
            compound.remove(one)
        for one in compound.findall("innerclass"):  # one within another is shown with that
            if one.text.rpartition("::")[0] in classes:
                compound.remove(one)
        for kind in ("enum", "typedef", "var", "function"):
            members = [one for one in found.get(name, []) if one.get("kind") == {"var": "variable"}.get(kind, kind)]
            if members:
                section = ElementTree.SubElement(compound, "sectiondef", kind={"function": "func"}.get(kind, kind))
                section.extend(members)
        tree.write(path, encoding="utf-8", xml_declaration=True)


def first_comment(path):
    lines = []
    for line in path.read_text().split("\n"):
        if not line.startswith("//"):
            break
        lines.append(line.strip("/ "))
    return re.split(r"(?<=[.])\s", " ".join(lines))[0]


def write(source, build, site, put):
    names = headers(source)
    xml = doxygen(source, build, site, names)
    chapters = {}
    for name in names:
        chapters.setdefault(name.partition("/")[0] if "/" in name else "", []).append(name)
    pages = []
    for chapter in (one for one in CHAPTERS if one in chapters):
        page = chapter or "equipoise"
        pages.append(page)
        text = f"# {CHAPTERS[chapter]}\n"
        for name in chapters[chapter]:
            text += (f"\n## {name.rpartition('/')[2]}\n\n{first_comment(source / 'src/equipoise' / name)}\n\n"
                     f"```cpp\n#include <equipoise/{name}>\n```\n\n```{{doxygenfile}} {name}\n```\n")
        put(f"reference/cpp/{page}.md", text)
    put("reference/cpp/index.md",
        "# The C++ interface\n\nThe public headers, as they are installed, by chapter. It is made from the headers of this version. The "
        "[tour of the library](../cpp.md) is the place to begin.\n\n```{toctree}\n:maxdepth: 1\n\n" + "\n".join(pages) + "\n```\n")
    return xml
