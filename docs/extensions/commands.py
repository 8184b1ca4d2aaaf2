"""Directives that write the reference of the command line from what reads it: the parser and the options' records."""

from __future__ import annotations

import argparse
import dataclasses

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from shapeviz_report.cli.arguments import EXIT_CODES, GROUPS, command_parser
from shapeviz_report.config import Config

OPTIONS = {option.name: option for option in dataclasses.fields(Config)}


class Commands(SphinxDirective):
    """A section for every command, with the arguments that are its own and the names of the options that it takes."""

    def run(self) -> list[nodes.Node]:
        lines = []
        for name, parser in _commands().items():
            usage = parser.format_usage().removeprefix("usage: ").strip()
            lines += [f"## {name}", "", parser.description or "", "", "```text", usage, "```", ""]
            told = [action for action in parser._actions if not isinstance(action, argparse._HelpAction)]
            for action in told:
                if action.dest not in OPTIONS:
                    lines += [_called(action), f": {_sentence(action.help or '')}", ""]
            if taken := [f"`{action.option_strings[0]}`" for action in told if action.dest in OPTIONS]:
                lines += [f"It takes the [options](#options) {', '.join(taken)}.", ""]
        return self.parse_text_to_nodes("\n".join(lines), allow_section_headings=True)


class Options(SphinxDirective):
    """Every option of a build, group by group as in its help."""

    def run(self) -> list[nodes.Node]:
        told = {action.dest: action for action in _commands()["build"]._actions}
        lines = []
        for title, names in GROUPS.items():
            lines += [f"### {title[0].upper()}{title[1:]}", ""]
            for name in names:
                only = " Of the machine." if OPTIONS[name].metadata["of_machine"] else ""
                lines += [_called(told[name]), f": {_sentence(told[name].help or '')}{only}", ""]
        return self.parse_text_to_nodes("\n".join(lines), allow_section_headings=True)


class ExitCodes(SphinxDirective):
    """The exit codes as the help has them."""

    def run(self) -> list[nodes.Node]:
        _, *lines = EXIT_CODES.splitlines()
        text = "\n".join(line.removeprefix("  ") for line in lines)
        return [nodes.literal_block(text, text, language="text")]


def _commands() -> dict[str, argparse.ArgumentParser]:
    (commands,) = (
        action for action in command_parser()._actions if isinstance(action, argparse._SubParsersAction)
    )
    return dict(commands.choices)


def _called(action: argparse.Action) -> str:
    """An argument as it is typed."""
    value = "" if action.nargs == 0 else f" {action.metavar}"
    return ", ".join(f"`{flag}{value}`" for flag in action.option_strings) or f"`{value.strip()}`"


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def setup(app: Sphinx) -> dict[str, bool]:
    for name, directive in (("commands", Commands), ("options", Options), ("exit-codes", ExitCodes)):
        app.add_directive(name, directive)
    return {"parallel_read_safe": True}
