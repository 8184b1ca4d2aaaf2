"""The engine in a real worker, on a page from file:// under the site's own policies."""

import numpy as np
import pytest
from engine_page import make_table
from scipy.spatial.distance import cdist

from shapeviz_report import faithfulness, quality
from shapeviz_report.bins import scale_bins
from shapeviz_report.presets import PRESETS, compared_values, scale
from shapeviz_report.projections import TSNE_METHOD, UMAP_METHOD, project, squared_distances
from shapeviz_report.search.bins.automatic import grow
from shapeviz_report.search.bins.bin_space import BinSpace
from shapeviz_report.types import FeatureBlock, FeatureTable


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


def test_a_table_is_made_once_for_the_first_task_that_needs_it(engine_page):
    made = engine_page.page.evaluate(
        """async () => {
            let tables = 0;
            const started = await engine.startEngine(() => {
                tables += 1;
                const held = { steps: Uint16Array.of(0, 1, 2, 3), most: 3, low: [0], high: [3] };
                return { rows: 4, columns: 1, ...held, blocks: Int32Array.of(0), weights: [1], scaling: "plain" };
            });
            const xy = Float64Array.of(0, 0, 1, 1, 2, 2, 3, 3);
            await started.run("hit", { xy, groups: Int32Array.of(0, 0, 1, 1), k: 1 }).done;
            const counts = [tables];
            const contest = { positive: Int32Array.of(0, 1), negative: Int32Array.of(2, 3) };
            for (let time = 0; time < 2; time += 1) {
                const task = { method: "anova", contests: [contest], columns: Int32Array.of(0), seed: 0 };
                const { scores } = await started.run("score", task).done;
                counts.push(tables, scores[0]);
            }
            started.close();
            return counts;
        }"""
    )
    assert made == [0, 1, 1, 1, 1]


@pytest.mark.parametrize(("unlabelled", "classes"), [(0, 4), (5, 4), (5, 17)])
def test_bins_grow_as_in_python(engine_page, random, unlabelled, classes):
    """On a grid, with many equal distances; of 17 classes each has fewer shapes than neighbours count elsewhere."""
    groups = np.arange(60) % classes
    values = random.integers(0, 9, (60, 40)) + 2.0 * (random.random((classes, 40)) < 0.2)[groups]
    values[:, 7] = 3
    groups[:unlabelled] = -1
    engine_page.start(values, scaling="plain")
    task = {"rows": np.arange(60), "columns": np.arange(40), "groups": groups, "k": 10, "limit": 12}
    found = engine_page.run("grow", **task)["columns"]
    space = BinSpace(tuple(map(str, range(40))), np.arange(60, dtype=np.int32), 60, values.T.copy())
    path = grow(space, groups, 10, 12)
    assert len(path) > 4
    assert found.tolist() == path[-1]


FAITH = ("mean", "chance", "trustworthiness", "continuity", "random", "stress", "randomStress")


def python_faith(points, xy, k):
    """As the engine answers, by the names that it has."""
    found = faithfulness.rate_distances(cdist(points, points, "sqeuclidean"), xy.reshape(-1, 2), k)
    nothing = np.full(len(points), np.nan)
    return {
        "kept": found.kept,
        "false": nothing if found.false is None else found.false,
        "missing": nothing if found.missing is None else found.missing,
        "mean": found.kept.mean(),
        "chance": found.chance,
        "trustworthiness": found.trustworthiness,
        "continuity": found.continuity,
        "random": found.random,
        "stress": found.stress,
        "randomStress": found.random_stress,
    }


@pytest.mark.parametrize(
    ("rows", "grid", "k"),
    [
        (60, None, 10),
        (61, 4, 10),  # on a grid: many points are equally far, on the map and in the features
        (30, 1, 10),  # all in one place
        (12, None, 10),  # too few for ranks
        (7, None, 10),
        (2, None, 10),
    ],
)
def test_who_is_like_whom_is_that_of_python(engine_page, random, rows, grid, k):
    shape = (rows, 5)
    points = (
        np.round(random.normal(size=shape) * 4096) / 4096
        if grid is None
        else random.integers(0, 3, shape) * 1.0
    )
    xy = random.uniform(-1, 1, 2 * rows) if grid is None else random.integers(0, grid, 2 * rows) / 3
    engine_page.start(points, scaling="plain")
    found = engine_page.run("faith", **_laid_out(rows, 5), xy=xy, k=k)
    for name, expected in python_faith(points, xy, k).items():
        value = np.nan if expected is None else expected
        np.testing.assert_allclose(found[name], value, rtol=0, atol=1e-9, err_msg=name)


def test_who_is_like_whom_of_many_is_asked_of_some(engine_page, random):
    points = np.round(random.normal(size=(1200, 3)) * 4096) / 4096
    xy = points[:, :2].ravel() + random.normal(size=2400) / 4
    engine_page.start(points, scaling="plain")
    found = engine_page.run("faith", **_laid_out(1200, 3), xy=xy, k=10)
    expected = python_faith(points, xy, 10)
    asked = np.flatnonzero(~np.isnan(found["kept"]))
    np.testing.assert_array_equal(asked, np.arange(100) * 12)
    for name in ("kept", "false", "missing"):
        np.testing.assert_allclose(found[name][asked], expected[name][asked], rtol=0, atol=1e-9)
    for name in FAITH:
        assert found[name] == pytest.approx(expected[name], abs=0.04), name


def test_one_shape_is_like_nobody(engine_page):
    engine_page.start(np.zeros((1, 2)), scaling="plain")
    found = engine_page.run("faith", **_laid_out(1, 2), xy=np.zeros(2), k=10)
    assert all(np.isnan(found[name]) for name in FAITH)


def _laid_out(rows, columns):
    return {
        "rows": np.arange(rows, dtype=np.int32),
        "columns": np.arange(columns, dtype=np.int32),
        "by": "bins",
    }


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


def groups_of(random, groups, size, columns, noise):
    """Rows (groups * size, columns) around a centre for each group, and the group of each."""
    of_row = np.arange(groups * size) // size
    return random.normal(size=(groups, columns))[of_row] + noise * random.normal(
        size=(groups * size, columns)
    ), of_row


def choice(values, **others):
    """The parameters of a layout of all rows and columns."""
    rows, columns = np.arange(values.shape[0]), np.arange(values.shape[1])
    return {"method": "tsne", "rows": rows, "columns": columns, "by": "bins", "seed": 0} | others


def moved(one, other):
    """How far points lie apart on two maps, on average; the maps are 2 wide."""
    return np.linalg.norm((one - other).reshape(-1, 2), axis=1).mean()


@pytest.fixture(scope="module")
def histograms():
    """Two features, of fractions and of a user's own numbers, one column the same for all shapes."""
    random = np.random.default_rng(2)
    blocks = (FeatureBlock("Gc", 2, 10), FeatureBlock("own", 3, 1))
    fractions = random.dirichlet(np.ones(10), (40, 2)).reshape(40, 20)
    fractions[:, 3] = 0.25
    own = random.normal(size=(40, 3)) * [1, 50, 0.02]
    values = np.hstack([fractions, own])
    return FeatureTable(tuple(f"{row:02}" for row in range(40)), blocks, values)


@pytest.mark.parametrize("preset", ["default", "paper"])
@pytest.mark.parametrize("by", ["features", "bins"])
def test_rows_lie_as_far_apart_as_in_python(engine_page, histograms, preset, by):
    """Of the rows in use; what scales them are all rows."""
    preset = PRESETS[preset]
    rows = np.array([0, 3, 4, 8, 21, 39, 7])
    columns = np.arange(23) if by == "features" else np.array([0, 3, 5, 19, 22])
    if by == "features":
        scaled = scale(histograms, preset)
    else:
        scaled = scale_bins(histograms, preset, [histograms.columns[column] for column in columns])
    table = make_table(
        compared_values(histograms, preset),
        np.repeat([0, 1], [20, 3]),
        "balanced" if preset.balanced else "plain",
    )
    found = engine_page.call("distances", table, {"rows": rows, "columns": columns, "by": by})
    np.testing.assert_allclose(found.reshape(7, 7), squared_distances(scaled[rows]), rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("rows", [320, 321])
def test_the_tree_pushes_as_all_points_together(engine_page, random, rows):
    xy = random.normal(0, 8, (rows, 2))
    xy[10] = xy[11] = xy[12]
    found = engine_page.call("pushByTree", xy.ravel())
    away = xy[:, None] - xy[None]
    kernel = 1 / (1 + (away**2).sum(axis=2))
    expected = (kernel[:, :, None] ** 2 * away).sum(axis=1)
    assert found["normaliser"] == pytest.approx(kernel.sum() - rows, rel=0.02)
    error = np.linalg.norm(found["push"].reshape(-1, 2) - expected)
    assert error < 0.08 * np.linalg.norm(expected)


# 24 groups are more rows than have the affinities of all pairs.
@pytest.mark.parametrize(("method", "groups"), [(TSNE_METHOD, 10), (UMAP_METHOD, 10), (TSNE_METHOD, 24)])
def test_maps_are_as_good_as_those_of_python(engine_page, random, method, groups):
    values, of_row = groups_of(random, groups, 14, 30, 1.1)
    scaled = values / values.std(axis=0)
    engine_page.start(values)
    seeds = range(3)
    expected = np.mean(
        [python_hit(project(method, scaled, (), seed).xy.ravel(), of_row, 10).nh_s for seed in seeds]
    )
    cold = [
        engine_page.run("layout", **choice(values, method=method.name, seed=seed))["xy"] for seed in seeds
    ]
    start = engine_page.run("layout", **choice(values[:, :20], method=method.name))["xy"]
    warm = [
        engine_page.run("layout", **choice(values, method=method.name, seed=seed, start=start))["xy"]
        for seed in seeds
    ]
    assert expected < 0.97  # groups that overlap, or any map would do
    for maps in (cold, warm):
        assert np.mean([python_hit(xy, of_row, 10).nh_s for xy in maps]) > expected - 0.03


@pytest.mark.parametrize("method", ["tsne", "umap"])
@pytest.mark.parametrize("groups", [6, 16])
def test_a_map_depends_on_the_seed_and_not_on_how_the_work_was_cut(engine_page, random, method, groups):
    values, _ = groups_of(random, groups, 20, 8, 0.7)
    engine_page.start(values)
    parameters = choice(values, method=method)
    table = make_table(values)
    here = engine_page.call("layOutHere", table, parameters)["result"]["xy"]
    np.testing.assert_array_equal(engine_page.run("layout", **parameters)["xy"], here)
    other = engine_page.run("layout", **parameters | {"seed": 1})["xy"]
    assert not np.array_equal(other, here)


@pytest.mark.parametrize("method", ["tsne", "umap"])
@pytest.mark.parametrize(
    "values",
    [
        np.array([[1.0, 2.0]]),
        np.array([[1.0], [2.0]]),
        np.array([[0.0, 1.0], [3.0, 1.0], [4.0, 5.0]]),
        np.arange(5.0)[:, None],
        np.ones((6, 2)),
        np.zeros((7, 0)),
        np.repeat([[1.0], [2.0]], 20, axis=0),
        np.repeat([[1.0], [2.0]], 200, axis=0),
        np.r_[np.zeros(30), 1.0][:, None],
        np.c_[np.arange(9.0), np.ones(9)],
    ],
    ids=[
        "one row",
        "two",
        "three",
        "five",
        "all equal",
        "no columns",
        "two places",
        "two places, many",
        "one apart",
        "constant column",
    ],
)
def test_odd_tables_give_a_map(engine_page, values, method):
    engine_page.start(values)
    xy = engine_page.run("layout", **choice(values, method=method))["xy"]
    assert xy.shape == (2 * len(values),)
    assert np.isfinite(xy).all()
    assert np.abs(xy).max() <= 1 + 1e-6
    if len(np.unique(values, axis=0)) > 1:
        assert np.ptp(xy.reshape(-1, 2), axis=0).max() == pytest.approx(2, abs=1e-5)
    else:
        assert not xy.any()


def test_a_few_rows_keep_their_distances(engine_page):
    values = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]])
    engine_page.start(values, scaling="plain")
    xy = engine_page.run("layout", **choice(values))["xy"].reshape(3, 2).astype(float)
    ratios = np.sqrt(squared_distances(xy) / squared_distances(xy)[1, 2])
    np.testing.assert_allclose(ratios, np.sqrt(squared_distances(values)) / 5, atol=1e-6)


@pytest.mark.parametrize("method", ["tsne", "umap"])
def test_a_map_follows_the_one_before(engine_page, random, method):
    """A reader who changes little keeps their bearings, whichever way the last map was turned."""
    values, _ = groups_of(random, 6, 15, 20, 0.8)
    engine_page.start(values)
    first = engine_page.run("layout", **choice(values, method=method))["xy"]
    angle = 2.0
    turn = np.array([[np.cos(angle), np.sin(angle)], [np.sin(angle), -np.cos(angle)]])
    last = (first.reshape(-1, 2) @ turn).astype(np.float32).ravel()
    parameters = choice(values[:, :18], method=method)
    anew = engine_page.run("layout", **parameters)["xy"]
    turned = engine_page.run("layout", **parameters, reference=last)["xy"]
    followed = engine_page.run("layout", **parameters, start=last)["xy"]
    assert moved(followed, last) < 0.4
    assert max(moved(followed, last), moved(turned, last)) < moved(anew, last)


@pytest.mark.parametrize("method", ["tsne", "umap"])
def test_rows_without_a_place_come_to_their_own(engine_page, random, method):
    values, of_row = groups_of(random, 5, 16, 20, 0.4)
    engine_page.start(values)
    start = engine_page.run("layout", **choice(values, method=method))["xy"].copy().reshape(-1, 2)
    new = np.arange(80) % 16 < 4
    start[new] = np.nan
    xy = engine_page.run("layout", **choice(values, method=method, start=start.ravel()))["xy"].reshape(-1, 2)
    centres = np.array([start[(of_row == group) & ~new].mean(axis=0) for group in range(5)])
    nearest = np.linalg.norm(xy[:, None] - centres, axis=2).argmin(axis=1)
    assert (nearest[new] == of_row[new]).mean() > 0.9


@pytest.mark.parametrize("start", [np.nan, 0.5])
def test_a_start_without_places_is_none(engine_page, random, start):
    values, _ = groups_of(random, 3, 10, 5, 0.5)
    engine_page.start(values)
    useless = np.full(60, start, dtype=np.float32)
    found = engine_page.run("layout", **choice(values, start=useless))["xy"]
    assert np.isfinite(found).all()
    if np.isnan(start):
        np.testing.assert_array_equal(found, engine_page.run("layout", **choice(values))["xy"])


@pytest.mark.parametrize("method", ["tsne", "umap"])
@pytest.mark.parametrize("warm", [False, True])
def test_points_are_seen_to_move_and_never_to_flip(engine_page, random, method, warm):
    values, _ = groups_of(random, 16, 20, 10, 0.8)
    start = random.uniform(-1, 1, 640).astype(np.float32) if warm else None
    answer = engine_page.call("layOutHere", make_table(values), choice(values, method=method, start=start))
    progress = [report["progress"] for report in answer["reports"]]
    assert progress == sorted(progress)
    assert progress[0] >= 0
    assert progress[-1] <= 1
    maps = [report["partial"]["xy"] for report in answer["reports"] if "partial" in report]
    maps.append(answer["result"]["xy"])
    assert len(maps) > 10
    reference = (start if warm else maps[0]).reshape(-1, 2)
    reference = reference - reference.mean(axis=0)
    for xy in maps:
        assert np.abs(xy).max() == pytest.approx(1, abs=1e-5)
        points = xy.reshape(-1, 2)
        # A quarter turn or a mirror image lies no closer to the reference.
        for x, y in ((points[:, 0], points[:, 1]), (points[:, 1], points[:, 0])):
            for other in ((x, y), (x, -y), (-x, y), (-x, -y)):
                assert (np.stack(other, axis=1) * reference).sum() <= (points * reference).sum() + 1e-6
