"""Figures that readers take away: whole, self-contained, well-formed, and by day."""

import re
import xml.etree.ElementTree as ET
from itertools import pairwise

import pytest
from PIL import Image
from waiting import box_of, eventually, rested

SVG = "{http://www.w3.org/2000/svg}"

#: The pages with figures, and how many of these there are at first.
PAGES = {
    "index.html": 1,
    "compare.html": 3,
    "shape.html#id=class000%2F0001": 2,
    "features.html": 4,
    "bins.html": 3,
    "workbench.html": 2,
}


def save(page, root, kind, folder):
    """The file of a figure, as its menu saves it."""
    root.locator(".save-figure summary").first.click()
    with page.expect_download() as download:
        root.locator(f".save-figure button:has-text('{kind}')").first.click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def figures(page):
    page.wait_for_selector("[data-figure] .save-figure:visible")
    # What draws nothing, as a map of no bins yet, has no menu.
    return [
        root for root in page.locator("[data-figure]:has(.save-figure:visible)").all() if root.is_visible()
    ]


def words(tree) -> str:
    return " ".join("".join(text.itertext()) for text in tree.iter(f"{SVG}text"))


def check(path, root):
    """A reader of SVG without the site can show it, and finds nothing that leads out of it."""
    source = path.read_text(encoding="utf-8")
    tree = ET.fromstring(source)
    assert tree.tag == f"{SVG}svg"
    title = tree.find(f"{SVG}title").text
    headings = [node for node in tree.findall(f"{SVG}text") if node.get("font-size") == "15px"]
    assert " ".join("".join(node.itertext()) for node in headings) == " ".join(title.split())
    assert "Source: " in words(tree)
    assert not re.search(
        r"<(script|foreignObject|style)\b|url\((?!#|&quot;#|\"#)|href=\"(?!data:image/|#)", source
    )
    assert "var(--" not in source
    return tree


@pytest.mark.parametrize("file", PAGES)
def test_every_figure_of_a_page_of_nasty_names_is_well_formed_and_holds_all_it_shows(
    open_page, tmp_path, file
):
    page = open_page("everything", file)
    page.evaluate(
        "for (const folded of document.querySelectorAll('details:not(.save-figure)')) folded.open = true"
    )
    found = figures(page)
    assert len(found) >= PAGES[file]
    for root in found:
        path = save(page, root, "SVG", tmp_path)
        assert path.name.startswith("everything-at-once-")
        check(path, root)


#: What is said to who sits before a screen, and the words of links that lead on.
FOR_THE_SCREEN = re.compile(
    r"\b(click|hover|press|tap|drag|switch|point at|zoom in|rank by|turn both|save|more bins|more shapes"
    r"|try these|show them|show more|compare with|open on|open in|see where|how they were found|lines to)\b",
    re.IGNORECASE,
)

#: Every page with figures, in each of its views.
VIEWS = {
    "index.html": ["", "view=hit", "view=three", "coloring=fact:faces"],
    "compare.html": ["a=class%3Aclass000&b=class%3Aclass001", "view=outliers", "view=classes"],
    "shape.html": ["id=class000%2F0001", "id=class000%2F0001&beside=class001%2F0001"],
    "features.html": [""],
    "bins.html": [""],
    "workbench.html": [""],
}


@pytest.mark.parametrize("view", [f"{file}#{view}" for file, views in VIEWS.items() for view in views])
def test_a_figure_could_stand_in_a_paper(open_page, tmp_path, view):
    """One title, a caption of what is shown, the source, each once; and nothing for the screen."""
    page = open_page("searched", view)
    eventually(page, lambda: page.locator("main [aria-busy=true]").count() == 0)
    page.evaluate(
        "for (const folded of document.querySelectorAll('details:not(.save-figure)')) folded.open = true"
    )
    roots = figures(page)
    assert roots
    for root in roots:
        told = root.evaluate(
            "root => [...root.querySelectorAll('h2')].map((node) => node.textContent.trim())"
        )
        path = save(page, root, "SVG", tmp_path)
        tree = ET.parse(path).getroot()
        title = tree.find(f"{SVG}title").text
        lines = ["".join(node.itertext()) for node in tree.iter(f"{SVG}text")]
        assert not {line for line in lines if line in told and line != title}, "a heading of the page"
        assert lines.count(title) <= 1
        # The caption follows the title: the lines of twelve pixels that stand directly in the drawing.
        caption = " ".join(
            "".join(node.itertext()) for node in tree.findall(f"{SVG}text") if node.get("font-size") == "12px"
        )
        assert re.fullmatch(r"(t-SNE|[^a-z]|kind \w+ \d+|class\d+ \d+).{20,}\.", caption), caption
        assert sum(line.startswith("Source: ") for line in lines) == 1
        found = FOR_THE_SCREEN.search(" ".join(lines))
        assert found is None, found


def test_the_painted_pictures_of_a_bin_and_what_they_show_are_in_its_figure(open_page, tmp_path):
    page = open_page("bins", "bins.html#bin=Gc:3")
    root = page.locator("#look")
    shown = page.locator("#paintings img").count()
    assert shown >= 2
    tree = check(save(page, root, "SVG", tmp_path), root)
    painted = [
        node for node in tree.iter(f"{SVG}image") if node.get("href").startswith("data:image/webp;base64,")
    ]
    # Beside them stands the shape that can be turned.
    assert len(painted) == shown + 1
    for word in ("value", "in the bin"):
        assert words(tree).count(word) >= shown / 2


def test_the_letter_of_a_symbol_stands_below_the_line(open_page, tmp_path):
    page = open_page("bins", "bins.html")
    root = page.locator(".of-classes")
    tree = check(save(page, root, "SVG", tmp_path), root)
    lines = [node for node in tree.findall(f"{SVG}text") if node.get("font-size") == "12px"]
    (line,) = [node for node in lines if "NH" in "".join(node.itertext())]
    low, after = line.findall(f"{SVG}tspan")
    assert low.text == "c"
    assert float(low.get("dy")) == -float(after.get("dy")) == 3
    assert "NHc is the share" in re.sub(r"\s+", " ", "".join(line.itertext()))
    assert "NH_" not in words(tree)


def test_a_map_is_drawn_in_shapes_names_and_pictures_with_a_legend_and_its_source(open_page, tmp_path):
    page = open_page("published", "index.html", color_scheme="dark")
    (root, *_) = figures(page)
    tree = check(save(page, root, "SVG", tmp_path), root)
    assert len(list(tree.iter(f"{SVG}image"))) > 6
    text = words(tree)
    # In the legend, and on the map.
    for name in ("ant", "bird", "cup"):
        assert text.count(name) >= 2
    assert "Vessels" in text
    assert "Licence" in text
    assert re.search(r"t-SNE map of \d+ shapes, compared by .+ Colour: class\.", text)
    assert "Zoom in" not in text
    # By day, though the page is dark, which it is again.
    names = [node for node in tree.iter(f"{SVG}text") if "".join(node.itertext()) == "ant"]
    assert names[0].get("fill") == "rgb(28, 29, 31)"
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(27, 30, 34)"
    page.click("#views >> text=Classes")
    page.wait_for_function("document.querySelector('figure[data-slot=large]').dataset.view === 'class'")
    page.wait_for_selector("figure[data-slot=large] .labels > g")
    marks = check(save(page, root, "SVG", tmp_path), root)
    assert not list(marks.iter(f"{SVG}image"))
    assert len(list(marks.iter(f"{SVG}path"))) >= 18


@pytest.mark.parametrize("file", ["features.html", "workbench.html"])
def test_what_colours_a_map_is_told_once_below_it(open_page, tmp_path, file):
    page = open_page("searched", f"{file}#color=fact:faces")
    root = page.locator("figure.map").first
    eventually(page, lambda: page.locator("main[aria-busy=true]").count() == 0)
    page.wait_for_selector("figure.map .save-figure")
    text = words(check(save(page, root, "SVG", tmp_path), root))
    assert text.count(page.locator(".ramp-texts span").last.inner_text()) == 1


def test_names_above_columns_stand_upright_as_on_the_page(open_page, tmp_path):
    page = open_page("plain", "compare.html#view=classes")
    path = save(page, page.locator("[data-figure]:visible"), "SVG", tmp_path)
    page.goto(path.as_uri())
    boxes = page.evaluate(
        """() => [...document.querySelectorAll("text")]
            .filter(({ textContent }) => /^kind .$/.test(textContent))
            .map((text) => text.getBoundingClientRect())
            .map(({ left, right, top, bottom }) => ({ left, right, top, bottom }))"""
    )
    above = [box for box in boxes if box["bottom"] - box["top"] > box["right"] - box["left"]]
    assert (len(above), len(boxes)) == (12, 24)
    assert len({round(box["bottom"]) for box in above}) == 1
    above.sort(key=lambda box: box["left"])
    assert all(one["right"] <= other["left"] for one, other in pairwise(above))


def test_what_columns_say_stands_above_them_without_the_title_beside(open_page, tmp_path):
    page = open_page("searched", "features.html")
    heads = page.locator(".by-class-head p")
    lefts = heads.evaluate_all("nodes => nodes.map((node) => node.getBoundingClientRect().left)")
    tree = ET.parse(save(page, page.locator(".by-class"), "SVG", tmp_path))
    texts = [("".join(text.itertext()), float(text.get("x", "nan"))) for text in tree.iter(f"{SVG}text")]
    told = [text for text, _ in texts]
    of_map, of_all = texts[told.index("on this map") - 2], texts[told.index("over all")]
    assert of_map[0] == "NH"
    assert of_all[1] - of_map[1] == pytest.approx(lefts[1] - lefts[0], abs=1)
    assert max(x for text, x in texts if text.startswith("kind")) < of_map[1]


def test_a_picture_has_three_pixels_for_one_of_the_page(open_page, tmp_path):
    page = open_page("published", "index.html")
    (root, *_) = figures(page)
    with Image.open(save(page, root, "PNG", tmp_path)) as picture:
        assert picture.width >= 3 * box_of(root)["width"]
        pixels = picture.convert("RGB")
        assert pixels.getpixel((5, 5)) == (255, 255, 255)
        assert len(pixels.getcolors(maxcolors=1 << 24)) > 100


def test_a_site_of_one_file_has_the_same_figures(open_page, single_file, tmp_path):
    page = open_page("", address=single_file("published").as_uri())
    (root, *_) = figures(page)
    tree = check(save(page, root, "SVG", tmp_path), root)
    assert len(list(tree.iter(f"{SVG}image"))) > 6


def test_the_menu_works_from_the_keyboard(open_page):
    page = open_page("published", "index.html")
    page.focus(".save-figure summary")
    page.keyboard.press("Enter")
    page.wait_for_selector(".save-figure[open]")
    page.keyboard.press("Escape")
    assert page.locator(".save-figure[open]").count() == 0
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    assert download.value.suggested_filename == "vessels-map-of-all-shapes.svg"


def printed(page) -> str:
    """The page as it is while it is on paper; then it is on the screen again."""
    page.emulate_media(media="print")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    state = page.evaluate(
        """() => ({
            theme: getComputedStyle(document.documentElement).colorScheme,
            width: document.querySelector("main").offsetWidth,
            scroll: document.documentElement.scrollWidth,
            text: document.body.innerText,
            pressed: [...document.querySelectorAll("main :is(button.plain:not(.pair-of), input, .on-screen)")]
                .filter((node) => node.checkVisibility()).length,
        })"""
    )
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    page.emulate_media(media="screen")
    assert state["theme"] == "light"
    assert state["pressed"] == 0
    assert state["scroll"] <= max(state["width"] + 1, page.viewport_size["width"])
    assert page.evaluate("document.documentElement.dataset.paper") is None
    return state["text"]


@pytest.mark.parametrize("file", PAGES)
def test_a_page_on_paper_is_light_and_has_nothing_to_press(open_page, file):
    page = open_page("everything", file, color_scheme="dark")
    before = page.evaluate("document.querySelector('main').getBoundingClientRect().width")
    assert "Everything at once" in printed(page)
    assert page.evaluate("document.querySelector('main').getBoundingClientRect().width") == before


def test_figures_in_sentences_are_as_plain_on_paper_as_the_words_about_them(open_page):
    page = open_page("workbench", "compare.html")
    page.wait_for_selector("#answer b.told")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    looks = page.locator("#answer b.told").evaluate_all(
        """all => all.map((node) => [node, node.parentElement].map((one) => {
            const { color, fontSize } = getComputedStyle(one);
            return `${color} ${fontSize}`;
        }))"""
    )
    assert looks
    assert all(figure == words for figure, words in looks)


def test_the_introduction_is_whole_on_paper(open_page):
    page = open_page("published", viewport={"width": 1440, "height": 900})
    words = page.locator(".welcome p")
    words.evaluate("(node) => { node.textContent = 'Vessels of all times. '.repeat(20); }")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert words.evaluate("(node) => node.scrollWidth <= node.clientWidth && node.scrollHeight > 40")


#: What is drawn on a sheet: how wide it is there, and in which colours.
DRAWN = """() => {
    const found = (what) => [...document.querySelectorAll(`main ${what}`)].filter((node) => node.checkVisibility());
    const painted = found("svg *").map((node) => getComputedStyle(node));
    return {
        widths: found(":is(.surface, canvas, svg:not(svg svg))")
            .map((node) => Math.round(node.getBoundingClientRect().width)),
        maps: found("svg.on-paper").map((node) => {
            const { width, height } = node.getBoundingClientRect();
            return [node.getAttribute("viewBox"), `0 0 ${Math.round(width)} ${Math.round(height)}`];
        }),
        colours: [...new Set(painted.flatMap(({ fill, stroke }) => [fill, stroke]))].sort(),
        text: document.querySelector("main").innerText,
    };
}"""


@pytest.mark.parametrize("file", PAGES)
def test_a_sheet_is_the_same_from_a_page_of_any_theme_and_any_width(open_page, file):
    page = open_page("everything", file, color_scheme="dark")
    page.wait_for_selector("html[data-ready]")
    # The charts of the Overview come when they are asked for; a printer waits for none.
    if file == "index.html":
        page.locator("#how-good > summary").click()
    for chart in page.locator("#boxes, #effect-dots, #bars").all():
        chart.locator("svg").first.wait_for(state="attached")
    page.evaluate(f"window.addEventListener('beforeprint', () => {{ window.drawn = ({DRAWN})() }})")

    def sheet():
        rested(page, 800)
        page.pdf()
        return page.evaluate("window.drawn")

    dark = sheet()
    page.emulate_media(color_scheme="light")
    page.set_viewport_size({"width": 718, "height": 900})
    light = sheet()
    assert "Source: " in dark["text"]
    assert dark["colours"] == light["colours"]
    assert dark["widths"] == light["widths"]
    assert dark["maps"] == light["maps"]
    assert all(drawn == shown for drawn, shown in dark["maps"])


def test_the_whole_gallery_is_on_paper(open_page, site):
    page = open_page("plain", "shapes.html")
    on_screen = page.locator("#grid .cell").count()
    assert on_screen < 120
    text = printed(page)
    for group in "abcdefghijkl":
        for number in range(10):
            assert f"kind {group} {number}" in text
    page.evaluate("new Promise((done) => setTimeout(done, 100))")
    assert page.locator("#grid .cell").count() == on_screen
    # As the browser itself prints it, over several sheets.
    assert page.pdf(prefer_css_page_size=True).count(b"/Type /Page\n") >= 3


@pytest.mark.parametrize(
    ("name", "shape", "pictures"), [("plain", "class000/0000", 0), ("very many", "class000/0000-00000", 1)]
)
def test_a_shape_is_ringed_on_paper_and_very_many_marks_are_one_picture(open_page, name, shape, pictures):
    page = open_page(name, f"shape.html#id={shape}")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    drawing = page.locator("main svg.on-paper", has=page.locator("circle"))
    assert drawing.count() == 1
    assert drawing.locator("image").count() == pictures
    assert drawing.locator("path").count() < 130


def test_a_map_on_paper_has_its_names_where_its_marks_are(open_page):
    page = open_page("plain", "index.html#view=class")
    page.wait_for_selector("figure[data-slot=large] .labels > g")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    apart = page.evaluate(
        """() => {
            const drawing = document.querySelector("figure[data-slot=large] .on-paper");
            const middle = (node) => {
                const { left, top, width, height } = node.getBoundingClientRect();
                return [left + width / 2, top + height / 2];
            };
            const marks = [...drawing.querySelectorAll(":scope > g path")].map((node) => [node, middle(node)]);
            const nearest = (name) => {
                const { left, right, top, bottom } = name.getBoundingClientRect();
                const away = ([x, y]) => Math.hypot(Math.max(left - x, x - right, 0), Math.max(top - y, y - bottom, 0));
                return marks.toSorted((a, b) => away(a[1]) - away(b[1]))[0][0];
            };
            const names = [...drawing.querySelectorAll("g g")].filter((node) => node.querySelector("text"));
            return names
                .filter((node) => node.children.length === 2 && node.children[0].localName === "path")
                .map((node) => [node.children[0], nearest(node)].map((mark) => getComputedStyle(mark).fill));
        }"""
    )
    assert len(apart) >= 8
    # A name stands by a mark of its class.
    colours = [(name, mark) for name, mark in apart]
    assert sum(name == mark for name, mark in colours) >= len(colours) - 1
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert page.locator(".on-paper").count() == 0


def test_the_source_of_the_workbench_stands_on_the_sheet_of_its_maps_and_bars(open_page):
    page = open_page("searched", "workbench.html")
    eventually(page, lambda: page.locator("main [aria-busy=true]").count() == 0)
    page.wait_for_selector("figure[data-map=original] .labels > g", state="attached")
    # One sheet for what is asked, one for the map and the bars: the source takes no third.
    assert page.pdf(format="A4", prefer_css_page_size=True).count(b"/Type /Page\n") == 2


def test_no_heading_is_parted_from_what_it_heads(open_page):
    page = open_page("searched", "compare.html#a=class%3Aclass000&b=class%3Aclass001")
    page.wait_for_selector("#result:not([hidden])")
    page.emulate_media(media="print")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    loose = page.evaluate(
        """() => [...document.querySelectorAll("#result .part")].flatMap((part) => {
            const parts = [...part.children].filter((node) => node.checkVisibility());
            const list = parts.findIndex((node) => node.matches("ul, .seen-pair, #seen-bin"));
            return parts.slice(0, list).filter((node) => getComputedStyle(node).breakAfter !== "avoid");
        }).map((node) => node.outerHTML.slice(0, 80))"""
    )
    assert loose == []


def test_all_others_are_counted_where_a_sample_of_them_is_compared(open_page, tmp_path):
    page = open_page("large", "compare.html#a=class%3Aclass+0&b=class%3Aclass+1")
    page.wait_for_selector("#result:not([hidden])", state="attached")
    root = page.locator("[data-figure]:has(#shared-title)")
    text = re.sub(r"<[^>]+>", " ", save(page, root, "SVG", tmp_path).read_text(encoding="utf-8"))
    assert re.search(r"unlike\s+1\s500\s+other\s+shapes", text)
