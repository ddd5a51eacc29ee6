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
        self.repeated = left.endswith(" ...")
        left = left.removesuffix(" ...")
        names, _, self.value = left.partition(" ")
        self.names = names.split(",")
        if not left.startswith("-"):
            self.value = names

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
        about, rest = text.split("\n\n", 1)
        usage, rest = rest.split("\n\n", 1)
        self.about = " ".join(about.partition(": ")[2].split())
        self.usage = [line.strip() for line in usage.removeprefix("Usage: ").split("\n")]
        self.examples, footer, entries = [], [], []
        for part in rest.strip().split("\n\n"):
            title, *lines = part.split("\n")
            if not lines or not lines[0].startswith("  "):
                footer += [title, *lines]
            elif title.startswith("Example"):
                self.examples = [line.strip() for line in lines]
            else:
                entries += self.listed(lines)
        self.footer = " ".join(footer)
        self.options = [entry for entry in entries if entry.names[0].startswith("-")]
        self.others = [entry for entry in entries if not entry.names[0].startswith("-")]  # arguments, commands

    @staticmethod
    def listed(lines):
        found = []
        for line in lines:
            if line.startswith("   "):
                found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
            else:
                left, text = re.fullmatch(r"  (.*?)(?: {2,}(.*))?", line).groups()
                found.append([left, text or ""])
        return [Entry(*one) for one in found]


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith(".") else text


def bold(text):
    return f"\\fB{roff(text)}\\fP"


def tagged(entry):
    value = f" \\fI{roff(entry.value)}\\fP" if entry.value else ""
    names = ", ".join(bold(name) for name in entry.names) if entry.names[0].startswith("-") else ""
    tag = (names + value).strip() + (" ..." if entry.repeated else "")
    return f".TP\n{tag}\n{roff(entry.text)}\n"


def exit_codes(footer):
    """The other sentences of the program's help, and its exit codes as a list."""
    others, listed = re.fullmatch(r"(.*?) Exit codes: (.*)\.", footer).groups()
    codes = "".join(f".TP\n.B {code}\n{roff(words)}\n" for code, words in re.findall(r"(\d+) (.*?)(?=, \d+ |$)", listed))
    return codes, roff(others)


def verbatim(lines):
    return ".nf\n" + "".join(roff(line) + "\n" for line in lines) + ".fi\n"


def page(name, help_text, version, body, footer, see_also):
    codes, others = exit_codes(footer)
    return (f".TH {name.upper()} 1 \"\" \"Equipoise {version}\" \"Equipoise\"\n"
            f".SH NAME\n{roff(name)} \\- {roff(help_text.about)}\n"
            f".SH SYNOPSIS\n{verbatim(help_text.usage)}{body}"
            f".SH EXAMPLES\n{verbatim(help_text.examples)}.SH EXIT STATUS\n{codes}.PP\n{others}\n"
            f".SH SEE ALSO\n.nh\n{see_also}\n")


def options(help_text):
    body = ""
    for entries, title in ((help_text.others, "ARGUMENTS"), (help_text.options, "OPTIONS")):
        if entries:
            body += f".SH {title}\n" + "".join(tagged(entry) for entry in entries)
    return body


def main():
    program, folder, studies = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    everything = Help(program)
    commands = {entry.names[0]: Help(program, entry.names[0]) for entry in everything.others}

    pages = {f"equipoise-{name}": page(f"equipoise-{name}", help_text, version, options(help_text), everything.footer,
                                       "\\fBequipoise\\fP(1)")
             for name, help_text in commands.items()}
    body = ".SH COMMANDS\n"
    for entry in everything.others:
        body += f".TP\n{bold(entry.names[0])}\n{roff(entry.text)}\n"
    body += f".SH FILES\n.TP\n.I {roff(studies)}\nready studies to try\n"
    pages["equipoise"] = page("equipoise", everything, version, body, everything.footer,
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
