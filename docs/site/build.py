#!/usr/bin/env python3
"""The documentation site: gathers the pages, writes the generated reference beside them and calls Sphinx.

    build.py SOURCE BUILD SITE

SOURCE is the project's folder, BUILD its build folder (program and Python package), SITE where the site goes. Warnings
are errors. Pages are plain Markdown that GitHub shows as well; what Sphinx wants otherwise is changed in the copies.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import cpp_pages
import notebook_pages
import reference_pages

OUTSIDE = {"CONTRIBUTING.md": "project/contributing.md", "CHANGELOG.md": "project/changelog.md", "SECURITY.md": "project/security.md",
           "studies/paper/published/README.md": "project/published-tables.md"}
NOTICES = """# Notices

These pages carry work of others. Each file states whose it is, and under which licence.

"""
KATEX = pathlib.Path("/usr/share/javascript/katex")
CARRIED = {"KaTeX": "libjs-katex", "Furo": "furo", "Sphinx": "python3-sphinx", "jQuery": "libjs-jquery",
           "Underscore": "libjs-underscore", "Pygments": "python3-pygments"}


def put(path, text):
    """Writes what has changed."""
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def copied(old, new):
    if not new.exists() or new.stat().st_mtime < old.stat().st_mtime:
        new.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(old, new)


class Gathering:
    def __init__(self, source, site):
        self.source, self.docs, self.root = source, source / "docs", site / "source"
        self.kept = set()

    def put(self, name, text):
        self.kept.add(self.root / name)
        put(self.root / name, text)

    def put_bytes(self, name, data):
        place = self.root / name
        self.kept.add(place)
        if not place.exists() or place.read_bytes() != data:
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(data)

    def link(self, page, name, match):
        """A link of the page docs/..., as it is right for the copy `name`."""
        words, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        path, _, anchor = target.partition("#")
        goal = pathlib.Path(os.path.normpath(page.parent / path))
        if not goal.exists():  # of the page itself: a picture beside it
            return match.group(0)
        if goal.is_dir() or goal.suffix in {".cpp", ".hpp"}:  # of the repository: not on the site
            return words.strip("![]")
        if goal.is_relative_to(self.docs):
            place = self.root / goal.relative_to(self.docs)
        elif str(goal.relative_to(self.source)) in OUTSIDE:
            place = self.root / OUTSIDE[str(goal.relative_to(self.source))]
        elif goal.suffix == ".ipynb" and goal.stem != pathlib.Path(name).stem:
            place = self.root / "notebooks" / f"{goal.stem}.md"
        else:  # a study, the notebook that a page shows: a file to be taken along
            place = self.root / "files" / goal.relative_to(self.source)
            self.kept.add(place)
            copied(goal, place)
        there = os.path.relpath(place, (self.root / name).parent)
        return f"{words}({there}{'#' + anchor if anchor else ''})"

    def page(self, page, name):
        self.text(page, name, page.read_text())

    def text(self, page, name, text):
        """The page `name` of the text of a file, whose links start from there."""
        text = re.sub(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^()\s]+)\)", lambda match: self.link(page, name, match), text)
        text = re.sub(r"^( *)```math$", r"\1```{math}", text, flags=re.MULTILINE)
        text = re.sub(r"^```pycon$", "```python", text, flags=re.MULTILINE)
        self.put(name, text)

    def gather(self):
        for page in sorted(self.docs.rglob("*.md")):
            self.page(page, str(page.relative_to(self.docs)))
        for name, place in OUTSIDE.items():
            self.page(self.source / name, place)
        for file in sorted(self.docs.rglob("*")):
            if file.suffix in {".png", ".svg", ".gif", ".csv", ".json", ".sbatch"} or file.name == "Snakefile":
                place = self.root / file.relative_to(self.docs)
                self.kept.add(place)
                copied(file, place)

        notices = NOTICES
        for name, package in CARRIED.items():
            copyright_file = pathlib.Path(f"/usr/share/doc/{package}/copyright")
            self.put(f"files/notices/{package}.txt", copyright_file.read_text())
            notices += f"- [{name}](../files/notices/{package}.txt)\n"
        self.put("project/notices.md", notices)

    def static(self):
        folder = self.root / "_static"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy2(self.docs / "site/site.css", folder)
        script = (KATEX / "katex.min.js").read_text() + "\n" + (self.docs / "site/equations.js").read_text()
        put(folder / "equations.js", script)
        for file in [KATEX / "katex.min.css", *(KATEX / "fonts").glob("*.woff2")]:
            copied(file, folder / "katex" / file.relative_to(KATEX))
        self.kept |= set(folder.rglob("*"))

    def forget(self):
        for file in list(self.root.rglob("*")):
            if file.is_file() and file not in self.kept:
                file.unlink()


def main():
    source, build, site = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    gathering = Gathering(source, site)
    gathering.gather()
    notebook_pages.write(gathering)
    gathering.static()
    xml = cpp_pages.write(source, build, site, gathering.put)
    reference_pages.write(source, build, site, gathering.put)
    gathering.forget()
    environment = {**os.environ, "EQUIPOISE_PYTHON": str(build / "python"), "EQUIPOISE_XML": str(xml), "EQUIPOISE_STATIC": str(gathering.root / "_static"),
                  
                   "PYTHONDONTWRITEBYTECODE": "1"}
    sphinx = [sys.executable, "-m", "sphinx", "-b", "html", "-E", "-a", "-W", "--keep-going", "-n", "-q", "-j", "auto",
              "-c", str(source / "docs/site"), "-d", str(site / "doctrees"), str(gathering.root), str(site / "html")]
    return subprocess.run(sphinx, env=environment).returncode


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    sys.exit(main())
