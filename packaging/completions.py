"""Completions for three shells, from the parts of the program's help (help_files.py)."""


# What may come before a command.
FIRST = ("--help", "--version")


def long_names(entries):
    return [name for entry in entries for name in entry.names if name.startswith("--")]


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


BASH = """# bash completion of equipoise; made of its own help by packaging/help_files.py
_equipoise() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} words= kind=none
  [ "$COMP_CWORD" -gt 1 ] || command=
  COMPREPLY=()
  case $command in
%s
  esac
  case $kind in
    none)
      [ -n "$command" ] || words=%s
      COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    file)
      compopt -o filenames 2>/dev/null
      COMPREPLY=($(compgen -f -- "$word")) ;;
    folder)
      compopt -o filenames 2>/dev/null
      COMPREPLY=($(compgen -d -- "$word")) ;;
  esac
}
complete -F _equipoise equipoise
"""


def bash(everything, commands):
    cases = ""
    for command, help_text in commands.items():
        options, arguments = help_text.options, help_text.others
        by_kind = {"file": [], "folder": [], "value": []}
        for option in options:
            if option.value:
                kind = "file" if option.takes_file() else "folder" if option.takes_folder() else "value"
                by_kind[kind] += option.names
        choices = [word for argument in arguments for word in argument.choices()]
        cases += f"    {command})\n      case $before in\n"
        for kind, names in by_kind.items():
            if names:
                cases += f"        {'|'.join(names)}) kind={kind} ;;\n"
        otherwise = f"words={quoted(' '.join(choices))}" if choices else "kind=file"
        cases += (f"        *)\n          case $word in\n            -*) words={quoted(' '.join(long_names(options)))} ;;\n"
                  f"            *) {otherwise} ;;\n          esac ;;\n      esac ;;\n")
    words = [*commands, "help", *FIRST]
    return BASH % (cases.rstrip("\n"), quoted(" ".join(words)))


def zsh_text(text):
    for mark in "\\[]:":
        text = text.replace(mark, "\\" + mark)
    return text


def zsh_value(entry):
    if entry.choices():
        return ":(" + " ".join(entry.choices()) + ")"
    return ":_files" if entry.takes_file() else ":_files -/" if entry.takes_folder() else ": "


def zsh(everything, commands):
    text = ("#compdef equipoise\n# made of its own help by packaging/help_files.py\n_equipoise() {\n"
            "  local -a commands\n  commands=(\n")
    for entry in everything.others:
        text += f"    {quoted(entry.names[0] + ':' + zsh_text(entry.text))}\n"
    text += ("  )\n  if (( CURRENT == 2 )); then\n    _describe -t commands command commands\n"
             f"    compadd -- {' '.join(FIRST)}\n    return\n  fi\n"
             "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n")
    for command, help_text in commands.items():
        text += f"    {command})\n      _arguments"
        for option in help_text.options:
            value = ":" + zsh_text(option.value) + zsh_value(option) if option.value else ""
            again = "*" if option.repeated else ""
            for name in option.names:
                text += f" \\\n        {quoted(again + name + '[' + zsh_text(option.text) + ']' + value)}"
        for argument in help_text.others:
            again = "*" if argument.repeated else ""
            text += f" \\\n        {quoted(again + ':' + zsh_text(argument.value) + zsh_value(argument))}"
        text += " ;;\n"
    return text + "  esac\n}\n_equipoise \"$@\"\n"


def fish(everything, commands):
    text = "# made of its own help by packaging/help_files.py\ncomplete -c equipoise -f\n"
    none = "__fish_use_subcommand"
    for entry in everything.others:
        text += f"complete -c equipoise -n {none} -a {entry.names[0]} -d {quoted(entry.text)}\n"
    for option in FIRST:
        text += f"complete -c equipoise -n {none} -l {option[2:]}\n"
    for command, help_text in commands.items():
        seen = f"complete -c equipoise -n '__fish_seen_subcommand_from {command}'"
        for option in help_text.options:
            files = (" -r -F" if option.takes_file() else " -x -a '(__fish_complete_directories)'" if option.takes_folder()
                     else " -x" if option.value else "")
            text += f"{seen}{fish_names(option)}{files} -d {quoted(option.text)}\n"
        for argument in help_text.others:
            if argument.choices():
                text += f"{seen} -a {quoted(' '.join(argument.choices()))}\n"
            elif argument.takes_file():
                text += f"{seen} -F\n"
    return text


def fish_names(option):
    return "".join(f" -l {name[2:]}" if name.startswith("--") else f" -s {name[1:]}" for name in option.names)
