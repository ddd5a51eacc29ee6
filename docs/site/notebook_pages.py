"""The notebooks as pages: what they say, their code, and what is kept of what it shows. Nothing is run."""
import json
import re

import nbformat
from jinja2 import DictLoader
from nbconvert import MarkdownExporter

# Of nbconvert's template for Markdown: what is printed is a block of text, a table stands as it is, a picture by itself.
TEMPLATE = """{% extends 'markdown/index.md.j2' %}
{% block stream %}
```text
{{ output.text.rstrip() }}
```
{% endblock stream %}
{% block data_text scoped %}
```text
{{ output.data['text/plain'].rstrip() }}
```
{% endblock data_text %}
{% block data_html scoped %}
<div class="shown">
{{ output.data['text/html'] | without_empty_lines }}
</div>
{% endblock data_html %}
{% block data_png %}
![picture]({{ output.metadata.filenames['image/png'] }})
{% endblock data_png %}
"""
CAPTION = re.compile(r"!\[picture\]\(([^)]+)\)\s*\n+\*((?:[^*]|\*\*)+)\*\s*\n")


def without_empty_lines(html):
    """A block of HTML ends at an empty line. A study's table is long: it is folded."""
    html = re.sub(r"<style.*?</style>", "", html, flags=re.DOTALL)
    html = re.sub(r"\n\s*\n", "\n", html).strip()
    named = re.match(r"<b>(Study .*?)</b>(<table>.*)", html, re.DOTALL)
    return f"<details><summary>{named[1]}</summary>{named[2]}</details>" if named else html


def exporter():
    made = MarkdownExporter(extra_loaders=[DictLoader({"page.md.j2": TEMPLATE})], template_file="page.md.j2")
    made.register_filter("without_empty_lines", without_empty_lines)
    return made


def captioned(body, page):
    """Of a picture and the line in italics that follows it a figure, whose words are those for who cannot see it, too."""
    def figure(match):
        words = " ".join(match[2].split())
        said = re.sub(r"[$\\*`\[\]]", "", words)
        return f"```{{figure}} {match[1]}\n:alt: {json.dumps(said)}\n\n{words}\n```\n\n"

    body = CAPTION.sub(figure, body)
    if "![picture]" in body:
        raise SystemExit(f"{page}: a picture has no caption: a line in italics has to follow it")
    return body


def write(gathering):
    """A page a notebook, with its pictures beside it; the file itself is taken along."""
    made = exporter()
    for path in sorted((gathering.source / "python/notebooks").glob("*.ipynb")):
        resources = {"unique_key": path.stem, "output_files_dir": path.stem}
        body, kept = made.from_notebook_node(nbformat.read(path, 4), resources=resources)
        for name, data in kept["outputs"].items():
            gathering.put_bytes(f"notebooks/{name}", data)
        page = f"notebooks/{path.stem}.md"
        body = captioned(body, page)
        head, _, rest = body.lstrip().partition("\n")
        file = f"[the notebook]({path.name})"
        gathering.text(path, page, f"{head}\n\n*This page shows {file} as it was last run.*\n{rest}")
