"""Modules joined into a script must do what they did as modules, or be refused."""

import shutil
import subprocess
from pathlib import Path

import pytest

from shapeviz_report.writing.joiner import join, join_pages


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


def test_comments_that_say_types_are_left_out_and_code_beside_one_stays(modules):
    entry = modules(
        main="\n".join(
            [
                '/** @import { One } from "./a.js" */',
                "// Kept.",
                "/**",
                " * Twice a number.",
                " * @param {number} value",
                " * and so on */",
                "function twice(value) {",
                "  /** @type {number} */",
                "  const two = 2;",
                "  return /** @type {number} */ (two * value);",
                "}",
                "/** @type {any} */ (globalThis).answer = twice(21);",
            ]
        )
    )
    script = join(entry)
    for left_out in ("@param", "@import", "  /** @type {number} */\n"):
        assert left_out not in script
    assert "// Kept." in script
    assert "return /** @type {number} */ (two * value);" in script
    assert "(globalThis).answer = twice(21);" in script


def test_an_import_may_take_several_lines(modules):
    entry = modules(
        main='import {\n  one,\n  two,\n} from "./a.js";\nconsole.log(one, two);',
        a="export const one = 1;\nexport const two = 2;",
    )
    assert "const { one, two } = module0;" in join(entry)


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


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_pages_share_modules_and_run_only_what_they_use(modules, tmp_path):
    modules(
        one='import { a } from "./a.js";\nconsole.log("one", a);',
        two='import { a } from "./a.js";\nimport { b } from "./b.js";\nconsole.log("two", a, b);',
        three='import { b } from "./b.js";\nconsole.log("three", b);',
        a='import { c } from "./c.js";\nconsole.log("a runs");\nexport const a = c + 1;',
        b='console.log("b runs");\nexport const b = 2;',
        c="export const c = 40;",
    )
    entries = {f"{name}.js": tmp_path / f"{name}.js" for name in ("one", "two", "three")}
    scripts = join_pages(entries, tmp_path)
    assert set(scripts) == {"shared.js", *entries}
    for text in ("const c = 40", "const a = c + 1", "const b = 2"):
        assert sum(script.count(text) for script in scripts.values()) == 1
        assert text in scripts["shared.js"]
    said = {}
    for name in entries:
        page = "globalThis.window = { shapeviz: {} };\n" + scripts["shared.js"] + scripts[name]
        (tmp_path / "page.cjs").write_text(page, encoding="utf-8")
        ran = subprocess.run(["node", tmp_path / "page.cjs"], capture_output=True, text=True, check=True)
        said[name] = ran.stdout.splitlines()
    assert said == {
        "one.js": ["a runs", "one 41"],
        "two.js": ["a runs", "b runs", "two 41 2"],
        "three.js": ["b runs", "three 2"],
    }


def test_a_module_of_one_page_stays_with_it(modules, tmp_path):
    modules(one='import { a } from "./a.js";\na();', two="void 0;", a="export function a() {}")
    scripts = join_pages({name: tmp_path / name for name in ("one.js", "two.js")}, tmp_path)
    assert "function a()" in scripts["one.js"]
    assert not any("function a()" in scripts[name] for name in ("shared.js", "two.js"))
