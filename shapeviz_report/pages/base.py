"""The contract of a page, and what several pages say about shapes and classes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from shapeviz_report import charts
from shapeviz_report.config import Config
from shapeviz_report.descriptors import Descriptor
from shapeviz_report.descriptors.registry import ALL_DESCRIPTORS
from shapeviz_report.global_descriptors import GlobalDescriptor
from shapeviz_report.global_descriptors.registry import ALL_GLOBAL_DESCRIPTORS
from shapeviz_report.order import classes_of
from shapeviz_report.pages.chunks import Chunks, Clusters, FeatureMarks, Texts, ThemeName
from shapeviz_report.projections.registry import ALL_PROJECTIONS
from shapeviz_report.quality import hit_range
from shapeviz_report.search.certainty import measure_distinct_gain
from shapeviz_report.types import (
    BinSearch,
    FeatureSearch,
    FloatArray,
    HeldOutBins,
    HeldOutFold,
    IntArray,
    Projection,
    Report,
)

#: Steps of a coordinate from the middle of a map to its edge: 16 bits, so that nearest neighbours stay the nearest.
COORDINATE_STEPS = 32767

#: Steps of a share: nearly all small numbers of neighbours divide it, ten among them, so that shares of them are exact.
SHARE_STEPS = 65520

#: What stands for a share that there is not.
NO_SHARE = 65535

#: Decimals of figures of quality as pages show them.
FIGURE_DECIMALS = 3

#: Shapes up to which a site holds all that it can. Of more, hosts would not have a file of each picture, and data for
#: machines would be most of the site: they leave out what their readers can do without.
MOST_IN_FULL = 10_000

#: Rows of a file of features, as some hosts take 25 MiB a file.
ROWS_A_FILE = 2_000

#: Pixels on a side of a thumbnail, and of one of very many, which would else be most of the site: half as large again
#: as a gallery shows it.
THUMBNAIL_SIZE, THUMBNAIL_SIZE_OF_MANY = 320, 192

#: The projections by name.
METHODS = {method.name: method for method in ALL_PROJECTIONS}


def map_title(method: str) -> str:
    """What people call a map: a projection, or a map that was brought along."""
    return METHODS[method].title if method in METHODS else method


#: The descriptors by name: what is measured, beside features that were brought along.
MEASURED: Mapping[str, Descriptor | GlobalDescriptor] = {
    **{descriptor.name: descriptor for descriptor in ALL_DESCRIPTORS},
    **{descriptor.name: descriptor for descriptor in ALL_GLOBAL_DESCRIPTORS},
}


@dataclass(frozen=True)
class PageContent:
    """All that one page shows.

    Attributes
    ----------
    context : mapping of str to object
        What the page's template may use, beside what the site gives every template.
    chunks : Chunks
        Data that the page's scripts load, by name. Two pages may share a chunk when they agree on its content.
    parts : mapping of str to iterable
        The chunks that come in parts, by their names in :class:`~shapeviz_report.pages.chunks.Parts`: the parts in
        their order, each made when it is asked for.
    """

    context: Mapping[str, object]
    chunks: Chunks = field(default_factory=Chunks)
    parts: Mapping[str, Iterable[object]] = field(default_factory=dict)


def distinct_means(folds: Sequence[HeldOutFold | HeldOutBins]) -> dict[str, object] | None:
    """What held-out shapes reach where one of each group of copies stands for all of it; None where there are none."""
    gain = measure_distinct_gain(folds)
    if gain is None:
        return None
    shapes = [fold.shapes for fold in folds]
    own, everything = (
        float(np.average([getattr(fold, name) for fold in folds], weights=shapes))
        for name in ("nh_s_distinct", "nh_s_all_distinct")
    )
    return {"nh_s": own, "all": everything, "gain": gain}


class Page(Protocol):
    """One page of the site.

    Attributes
    ----------
    name : str
        Names the template ``NAME.html``, and the script ``scripts/pages/NAME.js``.
    title : str
        In the navigation.
    file : str
        File name in the site.
    within : str or None
        Name of the page through which this one is reached; None for a page that the navigation lists.
    """

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def within(self) -> str | None: ...

    def content(self, report: Report) -> PageContent:
        """Compute everything the page shows; the template only lays it out."""
        ...


def class_names(report: Report) -> tuple[str, ...]:
    """The classes of the active labeling that have a shape, in natural order."""
    return classes_of(report.labels)


def class_codes(report: Report) -> IntArray:
    """The number of each shape's class; -1 without one."""
    number = {name: index for index, name in enumerate(class_names(report))}
    return np.array([-1 if label is None else number[label] for label in report.labels], np.int32)


def is_in_full(report: Report) -> bool:
    """Whether the site leaves nothing out for want of room."""
    return len(report.shapes) <= MOST_IN_FULL


def feature_files(shapes: int) -> dict[str, slice]:
    """The files below ``data/`` that hold the features of so many shapes for numpy, each with its rows. Of very many
    there are none: they would be a third of the site, and ``shapeviz-report describe`` writes them."""
    if shapes > MOST_IN_FULL:
        return {}
    if shapes <= ROWS_A_FILE:
        return {"features.npz": slice(shapes)}
    return {
        f"features-{number}.npz": slice(start, start + ROWS_A_FILE)
        for number, start in enumerate(range(0, shapes, ROWS_A_FILE), 1)
    }


def thumbnail_size(config: Config, shapes: int) -> int:
    """Pixels on a side of a thumbnail, of so many shapes where nobody says."""
    if config.thumbnail_size is not None:
        return config.thumbnail_size
    return THUMBNAIL_SIZE if shapes <= MOST_IN_FULL else THUMBNAIL_SIZE_OF_MANY


def search_of(report: Report) -> FeatureSearch | None:
    """The search for the best subset of features; as one without labels where these cannot rank maps."""
    search = report.search
    if search is None or nothing_told(report, search.k) is None:
        return search
    subsets = replace(
        search.subsets,
        nh=np.full_like(search.subsets.nh, np.nan),
        nh_s=np.full_like(search.subsets.nh_s, np.nan),
        nh_c=np.full_like(search.subsets.nh_c, np.nan),
    )
    return replace(
        search,
        subsets=subsets,
        greedy=(),
        table=(),
        spread=(),
        held_out=(),
        null_best=np.empty(0),
        effects=(),
    )


def is_search_sampled(report: Report) -> bool:
    """Whether a search for the best subset of features laid out a sample of the shapes."""
    return report.search is not None and len(report.search.rows) < report.search.shape_count


def bins_of(report: Report) -> BinSearch | None:
    """The search for a few bins; None where labels cannot rank maps."""
    found = report.bins
    return None if found is None or nothing_told(report, found.automatic.k) is not None else found


def nothing_told(report: Report, k: int) -> str | None:
    """Why labels cannot tell one map from another by their neighbourhood hit, as a sentence; None where they can, and
    without labels. In the words of ``nothingTold`` in ``database/hit-range.js``."""
    limits = hit_range(report.labels, k)
    if limits.tells or not limits.highest_of_class:
        return None
    if len(limits.highest_of_class) == 1:
        return "All labelled shapes are of one class, which no map can mix with another."
    if k >= len(report.labels) - 1:
        shapes = grouped(len(report.labels))
        return f"With {shapes} shapes, each has all others among its {grouped(k)} nearest on any map."
    return "Each shape is alone in its class, so none can have another of it near on any map."


def stand_in(report: Report) -> bool:
    """Whether clusters are the active labels, because the database has none."""
    return report.clusters is not None and report.clusters.stand_in


def kind_of_group(report: Report, count: int = 1) -> str:
    """What readers are told that the groups of shapes are."""
    one, many = ("cluster", "clusters") if stand_in(report) else ("class", "classes")
    return one if count == 1 else many


def clusters_chunk(report: Report) -> Clusters | None:
    """The chunk "clusters": the groups that the features alone make; None where there are too few shapes."""
    found = report.clusters
    if found is None:
        return None
    return {
        # Whether they are the active labels, because the database has none.
        "standIn": found.stand_in,
        "of": found.of.astype(np.int32),
        "clusters": [
            {
                "name": cluster.name,
                "central": cluster.central,
                "size": cluster.size,
                "typical": list(cluster.typical),
            }
            for cluster in found.clusters
        ],
        "quality": round(found.silhouette, 6),
    }


def grouped(number: int) -> str:
    """A number with its thousands set apart by a narrow space at which no line breaks: "1\u202f870".

    Pages have it as the filter ``grouped``; scripts have the same in ``base/words.js``.
    """
    return f"{number:,}".replace(",", "\u202f")


def change(before: float, after: float) -> float:
    """The difference of two figures of quality as they are shown, so that it adds up for a reader.

    Pages have it as the filter ``change``, from what stands before it; scripts have the same in ``base/figures.js``.
    """
    return round(round(after, FIGURE_DECIMALS) - round(before, FIGURE_DECIMALS), FIGURE_DECIMALS)


def map_note(projection: Projection) -> str:
    """What near and far mean on a map, and what it compares where that is a choice of bins."""
    if projection.brought:
        return (
            "The places on this map were brought along with the database: its makers know what near and far mean "
            "here. How well it keeps classes together, and how far it shows which shapes are alike by the features, is "
            "measured as on the other maps."
        )
    explanation = METHODS[projection.method].explanation
    if projection.bins is None:
        return explanation
    count = "one chosen bin" if len(projection.bins) == 1 else f"{grouped(len(projection.bins))} chosen bins"
    return f"{explanation} Only {count} of {', '.join(projection.features)} are compared."


def feature_marks() -> dict[ThemeName, FeatureMarks]:
    """The colours of features and of bars for each theme."""
    return {theme.name: {"features": list(theme.features), "bar": theme.bar} for theme in charts.THEMES}


def coordinate_steps(xy: npt.NDArray[np.floating]) -> npt.NDArray[np.int16]:
    """Coordinates in [-1, 1] for a chunk, as whole numbers of ``COORDINATE_STEPS``."""
    return np.round(xy * COORDINATE_STEPS).astype(np.int16)


def share_steps(shares: npt.NDArray[np.floating]) -> npt.NDArray[np.uint16]:
    """Shares from 0 to 1 for a chunk, as whole numbers of ``SHARE_STEPS``; NaN as ``NO_SHARE``."""
    return np.where(np.isnan(shares), NO_SHARE, np.round(np.nan_to_num(shares) * SHARE_STEPS)).astype(
        np.uint16
    )


def texts_chunk(texts: Sequence[str]) -> Texts:
    """Very many texts for a chunk: as a list, each would be an object that the browser makes and keeps."""
    # Halves of letters, which stand for bytes in names of files that are no text, have no UTF-8.
    whole = [text.encode("utf-16", "surrogatepass").decode("utf-16", "replace").encode() for text in texts]
    return {
        "bytes": np.frombuffer(b"\n".join(whole), np.uint8),
        "lengths": np.array([len(text) for text in whole], np.uint32),
    }


def rounded(values: FloatArray, decimals: int) -> list[float | None]:
    """Values for a chunk; None for NaN."""
    # Adding zero turns -0.0 into 0.0, which would otherwise differ between equal builds.
    return [float(value) + 0.0 if np.isfinite(value) else None for value in np.round(values, decimals)]
