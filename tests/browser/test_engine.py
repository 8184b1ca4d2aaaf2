"""The engine in a real worker, on a page from file:// under the site's own policies."""

import numpy as np
import pytest

from shapeviz_report import quality


@pytest.fixture
def random():
    return np.random.default_rng(5)


def python_hit(xy, groups, k):
    labels = [None if group < 0 else f"{group:03}" for group in groups]
    return quality.score(xy.reshape(-1, 2).astype(np.float64), labels, k=k)


@pytest.mark.parametrize(
    ("rows", "classes", "unlabelled", "grid", "k"),
    [
        (60, 4, 0, None, 10),
        (60, 4, 9, None, 10),
        (50, 3, 5, 4, 10),  # on a grid: many points are equally far, and some share their place
        (30, 2, 0, 1, 10),  # all in one place
        (7, 2, 0, None, 10),  # fewer than k others
        (12, 12, 0, None, 1),
        (2, 1, 0, None, 10),
    ],
)
def test_hit_is_that_of_python(engine_page, random, rows, classes, unlabelled, grid, k):
    xy = random.uniform(-1, 1, 2 * rows) if grid is None else random.integers(0, grid, 2 * rows) / 3
    groups = np.arange(rows) % classes
    groups[random.permutation(rows)[:unlabelled]] = -1
    engine_page.start(np.zeros((rows, 1)))
    found = engine_page.run("hit", xy=xy, groups=groups, k=k)
    expected = python_hit(xy, groups, k)
    np.testing.assert_allclose(found["hit"], expected.nh, rtol=0, atol=1e-12)
    of_class = [expected.nh_c[f"{group:03}"] for group in range(classes)]
    np.testing.assert_allclose(found["hitOfClass"], of_class, rtol=0, atol=1e-12)
    assert found["hitOfAll"] == pytest.approx(expected.nh_s, abs=1e-12)


@pytest.mark.parametrize("groups", [[0], [-1, -1, -1]])
def test_without_neighbours_or_labels_there_is_no_hit(engine_page, groups):
    engine_page.start(np.zeros((len(groups), 1)))
    found = engine_page.run("hit", xy=np.zeros(2 * len(groups)), groups=np.array(groups), k=10)
    assert np.isnan(found["hit"]).all()
    assert np.isnan(found["hitOfAll"])


LOOP = """async () => {
    const posted = [];
    const log = [];
    function* count(table, { name, steps }) {
        try {
            for (let step = 0; step < steps; step++) {
                // Longer than a slice, so that every step is one.
                for (const start = performance.now(); performance.now() - start < 31; );
                log.push(name);
                yield { progress: step / steps, partial: step };
            }
            return `${name} of ${table}`;
        } finally {
            log.push(`${name} ends`);
        }
    }
    function* fail() {
        yield { progress: 0 };
        throw new Error("this task fails");
    }
    const loop = new engine.TaskLoop({ count, fail }, (message) => posted.push(message));
    loop.receive({ table: "the table" });
    const run = (id, name, parameters) => loop.receive({ run: { id, name, parameters } });
    const until = async (holds) => {
        while (!holds()) await new Promise((resolve) => setTimeout(resolve, 1));
    };
    const ended = (id) => posted.some((message) => message.id === id && !message.report);
    await SCRIPT({ run, loop, posted, log, until, ended });
    return { posted, log };
}"""


def run_loop(page, script):
    """Drive a task loop in the page itself, where the test can see its tasks' every step."""
    return page.evaluate(LOOP.replace("SCRIPT", f"({script})"))


def test_tasks_take_turns_and_report(engine_page):
    seen = run_loop(
        engine_page.page,
        """async ({ run, until, ended }) => {
            run(0, "count", { name: "a", steps: 3 });
            run(1, "count", { name: "b", steps: 2 });
            await until(() => ended(0) && ended(1));
        }""",
    )
    assert seen["log"] == ["a", "b", "a", "b", "a", "b ends", "a ends"]
    results = [message for message in seen["posted"] if "result" in message]
    assert results == [{"id": 1, "result": "b of the table"}, {"id": 0, "result": "a of the table"}]
    assert {"id": 0, "report": {"progress": 1 / 3, "partial": 1}} in seen["posted"]


def test_a_cancelled_task_takes_no_further_step(engine_page):
    seen = run_loop(
        engine_page.page,
        """async ({ run, loop, log, until, ended }) => {
            run(0, "count", { name: "a", steps: 1000 });
            await until(() => log.length > 1);
            loop.receive({ cancel: 0 });
            run(1, "count", { name: "b", steps: 2 });
            await until(() => ended(1));
        }""",
    )
    after = seen["log"][seen["log"].index("a ends") + 1 :]
    assert after == ["b", "b", "b ends"]
    assert all("result" not in message for message in seen["posted"] if message["id"] == 0)


def test_a_failing_task_says_why_and_others_go_on(engine_page):
    seen = run_loop(
        engine_page.page,
        """async ({ run, until, ended }) => {
            run(0, "fail", {});
            run(1, "count", { name: "b", steps: 2 });
            await until(() => ended(0) && ended(1));
        }""",
    )
    assert [m["error"]["message"] for m in seen["posted"] if "error" in m] == ["this task fails"]
    assert [m["result"] for m in seen["posted"] if "result" in m] == ["b of the table"]


def test_an_error_of_the_worker_reaches_the_page(engine_page):
    engine_page.start(np.zeros((3, 1)))
    message = engine_page.page.evaluate(
        "() => engine.open.run('hit', { xy: null, groups: new Int32Array(3), k: 2 }).done.catch((e) => e.message)"
    )
    assert "null" in message
    assert (
        engine_page.page.evaluate("() => engine.open.run('nothing', {}).done.catch((e) => e.message)")
        == "the engine has no task 'nothing'"
    )


@pytest.mark.parametrize("how", ["job.cancel()", "engine.open.close()"])
def test_a_cancelled_job_ends_as_cancelled(engine_page, how):
    engine_page.start(np.zeros((3, 1)))
    cancelled = engine_page.page.evaluate(
        f"""async () => {{
            const groups = new Int32Array(3000);
            const job = engine.open.run("hit", {{ xy: new Float32Array(6000), groups, k: 10 }});
            {how};
            return job.done.then(() => false, (error) => error instanceof engine.Cancelled);
        }}"""
    )
    assert cancelled


def test_no_other_worker_is_trusted(engine_page):
    """Only the engine's own text may run: not another address, nor the engine's once it has started."""
    refused = engine_page.page.evaluate(
        """async () => {
            const address = URL.createObjectURL(new Blob(["postMessage(1)"], { type: "text/javascript" }));
            await shapeviz.startWorker();
            try { new Worker(address); return false; } catch (error) { return error instanceof TypeError; }
        }"""
    )
    assert refused
    assert engine_page.page.watch.complaints
    engine_page.page.watch.complaints.clear()
