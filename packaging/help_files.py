#!/usr/bin/env python3
"""Manual pages and completions for bash, zsh and fish, made of what the program says of itself (--help).

    help_files.py PROGRAM FOLDER STUDIES

Writes FOLDER/man1/equipoise.1.gz, one more page a command, and equipoise.bash, _equipoise (zsh) and equipoise.fish. An
option that the program learns needs no line here. STUDIES is the folder of the installed studies; the first page names it.
"""
import gzip
import pathlib
import re
import subprocess
import sys

import completions


class Entry:
    """An option, an argument or a command: a line of the help and those that go on from it."""

    def __init__(self, left, text):
        self.text = text
        self.required = " REQUIRED" in f" {left}"
        left = re.sub(r" (Excludes|Needs): .*| REQUIRED", "", left)
        self.repeated = left.endswith(" ...")
        left = left.removesuffix(" ...")
        names, _, self.value = left.partition(" ")
        self.names = names.split(",")

    def choices(self):
        """The words that an argument may be, where its help lists them."""
        listed = re.match(r"(?:one|any) of:? ([\w-]+(?:, [\w-]+)+)", self.text)
        return listed[1].split(", ") if listed else []

    def takes_file(self):
        return self.value.startswith(("FILE", "PAGE", "STUDY", "FIRST", "SECOND"))

    def takes_folder(self):
        return self.value.startswith("DIR")


class Help:
    """What `equipoise ... --help` says, in parts."""

    def __init__(self, program, *command):
        text = subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout
        head, rest = text.split("\n\n", 1)
        self.about, self.usage = (" ".join(part.split()) for part in head.split("Usage: "))
        self.sections, footer, section = {}, [], None
        for line in rest.split("\n"):
            if re.fullmatch(r"[A-Z]\w+:", line):
                section = self.sections.setdefault(line[:-1], [])
            elif section is not None and re.match(r" {2,}\S", line):
                section.append(line)
            elif line:
                footer.append(line)
        self.footer = " ".join(footer)
        self.sections = {name: self.entries(lines) for name, lines in self.sections.items()}

    @staticmethod
    def entries(lines):
        found = []
        for line in lines:
            if line.startswith("   "):
                found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
            else:
                left, text = re.fullmatch(r"  (.*?)(?: {2,}(.*))?", line).groups()
                found.append([left, text or ""])
        return [Entry(*one) for one in found]

    def of(self, name):
        return self.sections.get(name, [])


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith(".") else text


def bold(text):
    return f"\\fB{roff(text)}\\fP"


def tagged(entry):
    value = f" \\fI{roff(entry.value)}\\fP" if entry.value else ""
    names = ", ".join(bold(name) for name in entry.names) if entry.names[0].startswith("-") else ""
    tag = (names + value).strip() + (" ..." if entry.repeated else "")
    about = entry.text + (" (required)" if entry.required and names else "")
    return f".TP\n{tag}\n{roff(about)}\n"


def exit_codes(footer):
    """The help's exit codes as a list, and its other sentences."""
    listed, others = re.fullmatch(r"Exit codes: (.*?\.) (.*)", footer).groups()
    codes = "".join(f".TP\n.B {code}\n{roff(words)}\n"
                    for code, words in re.findall(r"(\d+) (.*?)(?=, \d+ |\.$)", listed))
    return codes, roff(others)


def page(name, help_text, version, body, see_also):
    codes, others = exit_codes(help_text.footer)
    return (f".TH {name.upper()} 1 \"\" \"Equipoise {version}\" \"Equipoise\"\n"
            f".SH NAME\n{roff(name)} \\- {roff(help_text.about)}\n"
            f".SH SYNOPSIS\n{roff(help_text.usage)}\n{body}.SH EXIT STATUS\n{codes}.PP\n{others}\n"
            f".SH SEE ALSO\n.nh\n{see_also}\n")


def options(help_text):
    body = ""
    for section, title in (("Positionals", "ARGUMENTS"), ("Options", "OPTIONS")):
        if help_text.of(section):
            body += f".SH {title}\n" + "".join(tagged(entry) for entry in help_text.of(section))
    return body


def main():
    program, folder, studies = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    everything = Help(program)
    commands = {entry.names[0]: Help(program, entry.names[0]) for entry in everything.of("Subcommands")}

    pages = {f"equipoise-{name}": page(f"equipoise-{name}", help_text, version, options(help_text), "\\fBequipoise\\fP(1)")
             for name, help_text in commands.items()}
    body = options(everything) + ".SH COMMANDS\n"
    for entry in everything.of("Subcommands"):
        body += f".TP\n{bold(entry.names[0])}\n{roff(entry.text)}\n"
    example = f"equipoise basin {studies}/paper/table-2-omega-2.4.toml"
    body += f".SH EXAMPLE\n.nf\n{roff(example)}\n.fi\n.PP\nhow surely the balancer of a published case balances\n"
    body += f".SH FILES\n.TP\n.I {roff(studies)}\nstudies to try and to begin with\n"
    pages["equipoise"] = page("equipoise", everything, version, body,
                              ",\n".join(f"\\fB{roff(name)}\\fP(1)" for name in sorted(pages)))
    (folder / "man1").mkdir(parents=True, exist_ok=True)
    for old in (folder / "man1").iterdir():
        old.unlink()
    for name, text in pages.items():
        (folder / f"man1/{name}.1.gz").write_bytes(gzip.compress(text.encode(), 9, mtime=0))
    for name, write in (("equipoise.bash", completions.bash), ("_equipoise", completions.zsh),
                        ("equipoise.fish", completions.fish)):
        (folder / name).write_text(write(everything, commands))


if __name__ == "__main__":
    main()
