"""Modules joined into a script must do what they did as modules, or be refused."""

import shutil
import subprocess
from pathlib import Path

import pytest

from shapeviz_report.site.joiner import join


@pytest.fixture
def modules(tmp_path):
    """Write modules given as name=text and return the path of ``main.js``."""

    def write(**sources: str) -> Path:
        for name, text in sources.items():
            (tmp_path / f"{name}.js").write_text(text, encoding="utf-8")
        return tmp_path / "main.js"

    return write


def test_a_module_runs_once_before_those_that_import_it(modules):
    entry = modules(
        main='import { one } from "./a.js";\nimport { two } from "./b.js";\nconsole.log(one, two());',
        a='import { two } from "./b.js";\nexport const one = two() + 1;',
        b="export function two() {\n  return 2;\n}",
    )
    script = join(entry)
    assert script.count("function two()") == 1
    assert script.index("function two()") < script.index("const one") < script.index("console.log")


def test_names_of_modules_do_not_meet(modules):
    entry = modules(
        main='import { a } from "./a.js";\nconst secret = 1;\nconsole.log(a, secret);',
        a="const secret = 2;\nexport const a = secret;",
    )
    assert join(entry).count("const secret") == 2


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_joined_script_computes_what_the_modules_say(modules, tmp_path):
    entry = modules(
        main='import { Sum, count, start } from "./a.js";\nconsole.log(new Sum(start).plus(...count()));',
        a="export const start = 40;\nexport class Sum {\n  constructor(n) { this.n = n; }\n"
        "  plus(m) { return this.n + m; }\n}\nexport function* count() {\n  yield 2;\n}",
    )
    (tmp_path / "joined.js").write_text(join(entry), encoding="utf-8")
    result = subprocess.run(["node", tmp_path / "joined.js"], capture_output=True, text=True, check=True)
    assert result.stdout == "42\n"


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ('import * as a from "./a.js";', "main.js:1"),
        ('import a from "./a.js";', "main.js:1"),
        ('import { a as b } from "./a.js";', "main.js:1"),
        ('import { a } from "https://example.org/a.js";', "main.js:1"),
        ('import { missing } from "./a.js";', "does not export 'missing'"),
        ("export default 3;", "main.js:1"),
        ("export { a };", "main.js:1"),
        ("export let a = 1;", "main.js:1"),
        ("  export const a = 1;", "start of a line"),
        ('const a = await import("./a.js");', "start of a line"),
        ("const here = import.meta.url;", "start of a line"),
    ],
)
def test_other_forms_are_refused_with_their_place(modules, line, complaint):
    entry = modules(main=line, a="export const a = 1;")
    with pytest.raises(ValueError, match=complaint):
        join(entry)


def test_a_circle_is_refused(modules):
    entry = modules(
        main='import { a } from "./a.js";', a='import { b } from "./main.js";\nexport const a = 1;'
    )
    with pytest.raises(ValueError, match=r"main\.js -> a\.js -> main\.js"):
        join(entry)


def test_a_missing_module_is_an_error(modules):
    with pytest.raises(FileNotFoundError):
        join(modules(main='import { a } from "./nowhere.js";'))
