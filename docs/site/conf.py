# How Sphinx sets the site. build.py calls it, on the pages that it has gathered.
import os
import re
import sys

sys.path.insert(0, os.environ["EQUIPOISE_PYTHON"])  # the built package, whose docstrings are its reference
import equipoise

project = "Equipoise"
author = "The Equipoise developers"
copyright = "The Equipoise developers, MIT licence"  # noqa: A001 (Sphinx's name)
version = release = equipoise.__version__
language = "en"

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
breathe_projects = {"equipoise": os.environ["EQUIPOISE_XML"]}
breathe_default_project = "equipoise"
breathe_show_include = False
breathe_default_members = ("members",)
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_google_docstring = False
napoleon_use_ivar = True
autodoc_default_options = {"members": True, "inherited-members": False}
# Names of other projects are not looked up: the site is built without a network.
nitpick_ignore_regex = [("cpp:.*", ".*"), ("py:.*", r"(?!equipoise\.).*"), ("py:.*", r"equipoise\._core\..*")]

html_theme = "furo"
html_title = "Equipoise"
html_static_path = [os.environ["EQUIPOISE_STATIC"]]
html_css_files = ["site.css", "katex/katex.min.css"]
html_copy_source = False
html_show_sourcelink = False
mathjax_path = "equations.js"  # KaTeX, on the pages that have equations; nothing is loaded from elsewhere
mathjax_options = {"defer": "defer"}
html_theme_options = {"navigation_with_keys": True}


def each_by_itself(app, what, name, obj, options, lines):
    """Of "name, alias : str" in a list of attributes makes one entry each, with the same words."""
    out, k = [], 0
    while k < len(lines):
        together = re.match(r"(\w+(?:, \w+)+) : (.*)", lines[k])
        if not together:
            out.append(lines[k])
            k += 1
            continue
        words = []
        k += 1
        while k < len(lines) and lines[k].startswith("    "):
            words.append(lines[k])
            k += 1
        for one in together[1].split(", "):
            out += [f"{one} : {together[2]}", *words]
    lines[:] = out


def setup(app):
    app.connect("autodoc-process-docstring", each_by_itself, priority=100)  # before Napoleon reads them
