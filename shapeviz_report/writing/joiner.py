"""Joins ES modules into classic scripts.

Browsers refuse ``<script type="module" src>`` on pages opened by double-click, so the modules of ``site/scripts``
are joined when a site is built. Every module becomes a function with a scope of its own, run once and before those
that import it. Only the plain forms that these modules use are accepted; everything else is an error that names the
file and the line, instead of a script that fails in a reader's browser::

    import { name, other } from "./module.js";
    export function name() {}          export async function name() {}          export function* name() {}
    export const name = ...;           export class Name {}

What ``/** ... */`` says on lines of its own is for the type checker and for those who write modules; it is left out.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

_IMPORT = re.compile(r'import \{ ?(?P<names>[\w$, ]+?),? ?\} from "(?P<source>\.{1,2}/[\w./-]+\.js)";')
_EXPORT = re.compile(
    r"export (?P<declaration>(?:async function|function\*?|const|class) (?P<name>[A-Za-z_$][\w$]*))"
)
_ELSEWHERE = re.compile(r"^\s+(?:import|export)\b|\bimport\s*[(.]")

#: Modules wait until they are used: a page reads what pages share, and runs only what it needs of it.
_REGISTRY = """\
const makers = new Map();
const made = new Map();
const use = (name) => {
  if (!made.has(name)) made.set(name, makers.get(name)(use));
  return made.get(name);
};
const define = (modules) => Object.entries(modules).forEach(([name, make]) => makers.set(name, make));
window.shapeviz.modules = { define, use };
"""


@dataclass(frozen=True)
class _Module:
    """One module, as it is joined.

    Attributes
    ----------
    path : Path
    exports : tuple of str
        The names that it gives to others.
    lines : tuple of str or (str, Path)
        Its text; a pair is an import: the names, and the module that gives them.
    """

    path: Path
    exports: tuple[str, ...]
    lines: tuple[str | tuple[str, Path], ...]

    def function(self, source: Mapping[Path, str], parameter: str) -> str:
        """The module as a function that returns what it exports; ``source`` are expressions for other modules."""
        lines = [
            line if isinstance(line, str) else f"const {{ {line[0]} }} = {source[line[1]]};"
            for line in (*self.lines, f"return {{ {', '.join(self.exports)} }};")
        ]
        return f"({parameter}) => {{\n" + "\n".join(lines) + "\n}"


def join(entry: Path) -> str:
    """Join the module ``entry`` and all it imports.

    Parameters
    ----------
    entry : Path
        The module that does what the script is for.

    Returns
    -------
    str
        A classic script that defines no global name.

    Raises
    ------
    ValueError
        For an import or export of another form, a name that is not exported, or modules that import in a circle.
    FileNotFoundError
        For an imported module that is not there.
    """
    modules = _read(entry)
    variables = {path: f"module{number}" for number, path in enumerate(modules)}
    return _script(
        f"// {path.name}\nconst {variables[path]} = ({module.function(variables, '')})();\n"
        for path, module in modules.items()
    )


def join_pages(entries: Mapping[str, Path], root: Path) -> dict[str, str]:
    """Join the modules of several pages, each module into one script only.

    Parameters
    ----------
    entries : mapping of str to Path
        The modules that start the pages, by the names of their scripts.
    root : Path
        The folder of all modules.

    Returns
    -------
    dict of str to str
        Classic scripts that define no global name, ``shared.js`` with all that two pages or more import, and one for
        each entry. A page runs ``shared.js`` before its own. They count on ``window.shapeviz``, an object.

    Raises
    ------
    ValueError, FileNotFoundError
        As :func:`join`.
    """
    modules = {name: _read(entry) for name, entry in entries.items()}
    users = Counter(path for own in modules.values() for path in own)
    names = {path: path.relative_to(root.resolve()).as_posix() for path in users}
    used = {path: f"use({json.dumps(name)})" for path, name in names.items()}

    def definition(found: Iterable[_Module]) -> str:
        functions = (f"{json.dumps(names[module.path])}: {module.function(used, 'use')}," for module in found)
        return "define({\n" + "\n".join(functions) + "\n});\n"

    shared = {path: module for own in modules.values() for path, module in own.items() if users[path] > 1}
    scripts = {"shared.js": _script([_REGISTRY, definition(shared[path] for path in sorted(shared))])}
    for name, own in modules.items():
        alone = definition(module for path, module in own.items() if path not in shared)
        start = f"{used[entries[name].resolve()]};\n"
        scripts[name] = _script(["const { define, use } = window.shapeviz.modules;\n", alone, start])
    return scripts


def _script(parts: Iterable[str]) -> str:
    return '(() => {\n"use strict";\n' + "\n".join(parts) + "})();\n"


def _read(entry: Path) -> dict[Path, _Module]:
    """The module ``entry`` and all it imports, each after those that it imports."""
    found: dict[Path, _Module] = {}

    def visit(path: Path, importers: tuple[Path, ...]) -> None:
        if path in importers:
            circle = " -> ".join(module.name for module in (*importers, path))
            raise ValueError(f"modules import in a circle: {circle}")
        if path in found:
            return
        lines: list[str | tuple[str, Path]] = []
        names: list[str] = []
        for number, line in _statements(path.read_text(encoding="utf-8")):
            place = f"{path.name}:{number}"
            if line.startswith("import"):
                match = _IMPORT.fullmatch(line)
                if match is None:
                    raise ValueError(f'{place}: only `import {{ name }} from "./module.js";` is joined')
                source = (path.parent / match["source"]).resolve()
                visit(source, (*importers, path))
                wanted = [name.strip() for name in match["names"].split(",")]
                for name in wanted:
                    if name not in found[source].exports:
                        raise ValueError(f"{place}: {source.name} does not export {name!r}")
                lines.append((", ".join(wanted), source))
            elif line.startswith("export"):
                match = _EXPORT.match(line)
                if match is None:
                    raise ValueError(f"{place}: only `export function`, `const` and `class` are joined")
                names.append(match["name"])
                lines.append(line.removeprefix("export "))
            elif _ELSEWHERE.search(line):
                raise ValueError(f"{place}: imports and exports stand at the start of a line")
            else:
                lines.append(line)
        found[path] = _Module(path, tuple(names), tuple(lines))

    visit(entry.resolve(), ())
    return found


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """The lines of a module with their numbers, an import of several lines as one, and without comments on types."""
    lines = enumerate(text.splitlines(), start=1)
    for number, line in lines:
        if line == "import {":
            for _, more in lines:
                line += f" {more.strip()}"
                if more.startswith("}"):
                    break
        elif line.strip() == "/**":
            for _, more in lines:
                if more.endswith("*/"):
                    break
            continue
        elif line.lstrip().startswith("/** ") and line.endswith(" */"):
            continue
        yield number, line
