"""Names for the code behind a result, so that what is kept belongs to the code that made it.

What code reaches is read from its source: the modules of this package that it imports, also within functions, what
these import, and so on; and every distribution that one of them imports, with what that requires. A name that a
package's ``__init__`` only passes on leads to where it is defined, past the package's other modules. Nothing is listed
by hand, and nothing is imported to find it. What takes up plug-ins reaches those that are installed.
"""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution, packages_distributions
from pathlib import Path
from typing import Any

from shapeviz_report.plugins import GROUPS, find_plugins

Import = tuple[str, str | None]
"""A module, and a name in it; None: the module as such."""

IMPORTS = (ast.Import, ast.ImportFrom)
_REQUIREMENT = re.compile(r"[A-Za-z0-9._-]+")


@dataclass(frozen=True)
class Closure:
    """What some code reaches.

    Attributes
    ----------
    modules : tuple of str
        Modules of the same package, all of whose source counts; sorted.
    passed_on : tuple of str
        ``package.name=module.name`` for every name that the ``__init__`` of a package passes on; sorted.
    libraries : tuple of str
        Other packages, by the names under which they are imported; sorted.
    """

    modules: tuple[str, ...]
    passed_on: tuple[str, ...]
    libraries: tuple[str, ...]


@cache
def function_version(function: Callable[..., Any]) -> str:
    """A name for everything that a function of a module reaches, in 16 hexadecimal digits.

    Of its own module only what it uses counts, and what that uses, and so on. The versions of Python and of the
    libraries are part of it. Equal wherever sources and versions are: neither paths nor times matter.
    """
    text, _ = _definition(function.__module__, function.__name__)
    closure = find_function_closure(function)
    python = f"python {sys.version_info.major}.{sys.version_info.minor}"
    return _digest(
        [
            text,
            python,
            *_sources(closure),
            *library_versions(closure.libraries),
            *plugin_versions(closure.modules),
        ]
    )


@cache
def source_version(module: str) -> str:
    """A name for the source of a module and of all that it reaches, in 16 hexadecimal digits, without its libraries."""
    return _digest(_sources(find_closure(module)))


@cache
def find_closure(module: str) -> Closure:
    """What a module reaches through its imports, itself included; see the head of this file.

    Imports for type checking alone do not count, and neither do the packages around a module, whose ``__init__`` runs
    as well: here they pass names on, and do nothing to the modules in them.
    """
    return _reach(module.partition(".")[0], [(module, None)])


def find_function_closure(function: Callable[..., Any]) -> Closure:
    """What a function reaches outside its own module."""
    _, imports = _definition(function.__module__, function.__name__)
    return _reach(function.__module__.partition(".")[0], imports)


@cache
def library_versions(libraries: tuple[str, ...]) -> tuple[str, ...]:
    """``name version`` of every distribution behind some imported packages, and of all that they require; sorted."""
    distributions = _distributions()
    waiting = [name for library in libraries for name in distributions.get(library, ())]
    found: dict[str, str] = {}
    while waiting:
        name = re.sub(r"[-_.]+", "-", waiting.pop()).lower()
        if name in found:
            continue
        try:
            installed = distribution(name)
        except PackageNotFoundError:  # wanted on another system, or by another version of Python
            continue
        found[name] = installed.version
        for requirement in installed.requires or ():
            bare, _, condition = requirement.partition(";")
            if "extra ==" not in condition and (match := _REQUIREMENT.match(bare.strip())):
                waiting.append(match[0])
    return tuple(sorted(f"{name} {number}" for name, number in found.items()))


def plugin_versions(modules: tuple[str, ...]) -> list[str]:
    """Of every plug-in that some modules take up, its name, its package with the version, its sources and libraries."""
    found = []
    for plugin in find_plugins():
        if GROUPS[plugin.group][1] not in modules:
            continue
        module = plugin.entry.module
        found.append(f"{plugin.group} {plugin.name} {plugin.package} {plugin.version} {plugin.entry.value}")
        if _find_source(module) is not None:
            closure = _reach(module.partition(".")[0], [(module, None)])
            libraries = tuple(name for name in closure.libraries if name != __package__)
            found += [*_sources(closure), *library_versions(libraries)]
    return found


def _reach(own: str, imports: Iterable[Import]) -> Closure:
    """What the source behind some imports reaches; ``own`` is the package whose modules are followed."""
    modules: set[str] = set()
    passed_on: set[str] = set()
    libraries: set[str] = set()
    waiting = list(imports)
    while waiting:
        module, name = waiting.pop()
        top = module.partition(".")[0]
        if top != own:
            if top not in sys.stdlib_module_names:
                libraries.add(top)
            continue
        module = _definer(module, name, passed_on)
        if module not in modules:
            modules.add(module)
            waiting.extend(_imports(module))
    return Closure(*(tuple(sorted(found)) for found in (modules, passed_on, libraries)))


def _definer(module: str, name: str | None, passed_on: set[str]) -> str:
    """The module that ``from module import name`` leads to."""
    while name is not None and _is_package(module):
        inner = f"{module}.{name}"
        if _find_source(inner) is not None:
            return inner
        source = _passed_names(module).get(name)
        if source is None:
            return module
        passed_on.add(f"{inner}={'.'.join(part for part in source if part)}")
        module, name = source
    return module


@cache
def _imports(module: str) -> tuple[Import, ...]:
    """Everything that a module imports, wherever in its text."""
    return tuple(found for node in _statements(_parse(module)) for _, found in _bindings(node, module))


@cache
def _passed_names(module: str) -> dict[str, Import]:
    """What the imports at the head of a module bind: name there -> where it comes from."""
    return dict(found for node in _parse(module).body for found in _bindings(node, module))


def _definition(module: str, name: str) -> tuple[str, list[Import]]:
    """The source of a name of a module together with all that it uses of that module, and what these import.

    Statements that bind no name, other than docstrings, may do anything to the rest and always count.
    """
    tree = _parse(module)
    lines = _source(module).read_text(encoding="utf-8").splitlines()
    heads = _passed_names(module)
    named: dict[str, list[ast.stmt]] = {}
    waiting: list[ast.stmt] = []
    for node in tree.body:
        names = _bound_names(node)
        for bound in names:
            named.setdefault(bound, []).append(node)
        if not (names or _is_docstring(node) or _is_type_checking(node) or isinstance(node, IMPORTS)):
            waiting.append(node)
    waiting.extend(named[name])
    reached: set[ast.stmt] = set()
    imports: list[Import] = []
    while waiting:
        node = waiting.pop()
        if node in reached:
            continue
        reached.add(node)
        for part in _walk(node):
            imports.extend(found for _, found in _bindings(part, module))
            if isinstance(part, ast.Name):
                waiting.extend(named.get(part.id, ()))
                if part.id in heads:
                    imports.append(heads[part.id])
    text = []
    for node in sorted(reached, key=lambda node: node.lineno):
        first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", ()))])
        text.extend(lines[first - 1 : node.end_lineno])
    return "\n".join(text), imports


def _bound_names(node: ast.stmt) -> set[str]:
    """The names that a statement at the head of a module binds, other than by import."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return {node.name}
    if isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
        return {
            part.id
            for part in ast.walk(node)
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
        }
    return set()


def _bindings(node: ast.AST, module: str) -> Iterator[tuple[str, Import]]:
    """The names that an import statement binds, and where they come from."""
    if isinstance(node, ast.Import):
        for alias in node.names:
            yield alias.asname or alias.name.partition(".")[0], (alias.name, None)
    elif isinstance(node, ast.ImportFrom):
        source = node.module or ""
        if node.level:
            around = module if _is_package(module) else module.rpartition(".")[0]
            source = importlib.util.resolve_name("." * node.level + source, around)
        for alias in node.names:
            yield alias.asname or alias.name, (source, None if alias.name == "*" else alias.name)


def _walk(node: ast.AST) -> Iterator[ast.AST]:
    """A syntax tree without the blocks that only type checkers see."""
    if _is_type_checking(node):
        return
    yield node
    for child in ast.iter_child_nodes(node):
        yield from _walk(child)


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """The statements of a tree, as :func:`_walk` has them, without their expressions: most of a tree, and no import."""
    if _is_type_checking(node):
        return
    yield node
    for block in ("body", "handlers", "orelse", "finalbody", "cases"):
        inner = getattr(node, block, ())
        if isinstance(inner, list):
            for child in inner:
                yield from _statements(child)


def _is_type_checking(node: ast.AST) -> bool:
    return (
        isinstance(node, ast.If)
        and not node.orelse
        and isinstance(node.test, ast.Name)
        and node.test.id == "TYPE_CHECKING"
    )


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


@cache
def _parse(module: str) -> ast.Module:
    return ast.parse(_source(module).read_bytes())


@cache
def _find_source(module: str) -> Path | None:
    """The file of a module; None if there is none. Finding it imports nothing."""
    top, *rest = module.split(".")
    spec = importlib.util.find_spec(top)
    if spec is None or spec.origin is None:
        return None
    if spec.submodule_search_locations is None:
        return Path(spec.origin) if not rest and spec.origin.endswith(".py") else None
    path = Path(spec.origin).parent.joinpath(*rest)
    return next(
        (file for file in (path / "__init__.py", path.with_name(path.name + ".py")) if file.is_file()), None
    )


def _source(module: str) -> Path:
    source = _find_source(module)
    if source is None:
        raise ModuleNotFoundError(f"the source of {module} is not there", name=module)
    return source


def _is_package(module: str) -> bool:
    return _source(module).name == "__init__.py"


def _sources(closure: Closure) -> list[str]:
    contents = (f"{name}\0{_source(name).read_text(encoding='utf-8')}" for name in closure.modules)
    return [*contents, *closure.passed_on]


def _digest(parts: Iterable[str]) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


@cache
def _distributions() -> dict[str, list[str]]:
    """Imported name -> the distributions that bring it."""
    return {package: sorted(set(names)) for package, names in packages_distributions().items()}
