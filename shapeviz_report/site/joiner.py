"""Joins ES modules into one classic script.

Browsers refuse ``<script type="module" src>`` on pages opened by double-click, so the modules of ``site/scripts``
are joined when a site is built. Every module becomes a function with a scope of its own, run once and in the
order of its imports. Only the plain forms that these modules use are accepted; everything else is an error that
names the file and the line, instead of a script that fails in a reader's browser::

    import { name, other } from "./module.js";
    export function name() {}          export async function name() {}          export function* name() {}
    export const name = ...;           export class Name {}
"""

from __future__ import annotations

import re
from pathlib import Path

_IMPORT = re.compile(r'import \{ ?(?P<names>[\w$, ]+?),? ?\} from "(?P<source>\.{1,2}/[\w./-]+\.js)";')
_EXPORT = re.compile(
    r"export (?P<declaration>(?:async function|function\*?|const|class) (?P<name>[A-Za-z_$][\w$]*))"
)
_ELSEWHERE = re.compile(r"^\s+(?:import|export)\b|\bimport\s*[(.]")


def join(entry: Path) -> str:
    """Join the module ``entry`` and all it imports.

    Parameters
    ----------
    entry : Path
        The module that starts the page.

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
    exports: dict[Path, tuple[str, ...]] = {}
    variables: dict[Path, str] = {}
    pieces: list[str] = []

    def visit(path: Path, importers: tuple[Path, ...]) -> None:
        if path in importers:
            circle = " -> ".join(module.name for module in (*importers, path))
            raise ValueError(f"modules import in a circle: {circle}")
        if path in exports:
            return
        lines: list[str] = []
        names: list[str] = []
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            place = f"{path.name}:{number}"
            if line.startswith("import"):
                match = _IMPORT.fullmatch(line)
                if match is None:
                    raise ValueError(
                        f'{place}: only `import {{ name }} from "./module.js";` on one line is joined'
                    )
                source = (path.parent / match["source"]).resolve()
                visit(source, (*importers, path))
                wanted = [name.strip() for name in match["names"].split(",")]
                for name in wanted:
                    if name not in exports[source]:
                        raise ValueError(f"{place}: {source.name} does not export {name!r}")
                lines.append(f"const {{ {', '.join(wanted)} }} = {variables[source]};")
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
        exports[path] = tuple(names)
        variables[path] = f"module{len(variables)}"
        lines.append(f"return {{ {', '.join(names)} }};")
        body = "\n".join(lines)
        pieces.append(f"// {path.name}\nconst {variables[path]} = (() => {{\n{body}\n}})();\n")

    visit(entry.resolve(), ())
    return '(() => {\n"use strict";\n' + "\n".join(pieces) + "})();\n"
