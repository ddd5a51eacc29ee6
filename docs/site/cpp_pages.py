"""The C++ reference: Doxygen reads the public headers (those that are installed), one page a room shows them."""
import re
import shutil
import subprocess
from xml.etree import ElementTree

ROOMS = {  # in the order in which a reader meets them; a room that is not here comes last
    "": "The whole library in one header", "study": "Studies", "toml": "A study's text", "units": "Units",
    "echo": "A study written again", "ensembles": "Ensembles", "sampling": "Starts", "running": "Options of a long call",
    "results": "Results", "decision": "The verdict", "changes": "Changes tried", "analyses": "Attractors, proofs, comparisons",
    "continuation": "Attractors along a parameter", "basin_slices": "Maps", "sweeps": "Sweeps and capacities",
    "design": "Designs", "trajectory": "Trajectories and equations", "explain": "What follows without simulation",
    "model": "The model", "drives": "How the rotor turns", "mechanics": "What follows from the equations",
    "types": "Plain types", "statistics": "Shares and their intervals", "columns": "Columns and figures",
    "result_files": "Files of results", "cell_files": "Files of sweeps", "reports": "Text and JSON", "text": "Tables as text",
    "html": "Pages", "shown": "What the page for one machine shows", "drawing": "Charts and documents", "plots": "Pictures",
    "design_words": "A design in words", "attractors": "From a trajectory to its attractor", "periodic_orbits": "Periodic orbits",
    "proof": "Certificates", "kernels": "Instruction sets", "base": "Errors and stopping", "literature": "The paper's numbers", "publications": "Other publications",
    "reproduction": "The paper, computed again",
}


def headers(source):
    text = (source / "cmake/install.cmake").read_text()
    listed = text[text.index("set(equipoise_public_headers"):]
    return re.findall(r"[\w./-]+\.hpp", listed[:listed.index(")\n")])


def doxygen(source, build, site, names):
    folder = site / "doxygen"
    folder.mkdir(parents=True, exist_ok=True)
    base = source / "src/equipoise"
    version = build / "src/equipoise/include/equipoise/base/version.hpp"
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
    rooms = {}
    for name in names:
        rooms.setdefault(name.rpartition("/")[0], []).append(name)
    order = [room for room in ROOMS if room in rooms] + sorted(room for room in rooms if room not in ROOMS)
    pages = []
    for room in order:
        page = room or "equipoise"
        pages.append(page)
        title = ROOMS.get(room, room.replace("_", " ").capitalize())
        text = f"# {title}\n"
        for name in rooms[room]:
            text += (f"\n## {name.rpartition('/')[2]}\n\n{first_comment(source / 'src/equipoise' / name)}\n\n"
                     f"```cpp\n#include <equipoise/{name}>\n```\n\n```{{doxygenfile}} {name}\n```\n")
        put(f"reference/cpp/{page}.md", text)
    put("reference/cpp/index.md",
        "# The C++ interface\n\nThe public headers, as they are installed, by room. It is made from the headers of this version. The "
        "[tour of the library](../../how-to/library.md) is the place to begin.\n\n```{toctree}\n:maxdepth: 1\n\n" + "\n".join(pages) + "\n```\n")
    return xml
