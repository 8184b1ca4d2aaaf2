"""What the subsets of features reach: the paper's Fig. 3 and 4, and how sure that is.

The charts hold no data; the page sets it under the name each function says. Colours that change with the theme are
parameters or ranges of the configuration: ``ordinal`` holds one hue a feature.
"""

from __future__ import annotations

from typing import Literal, TypeVar

import altair as alt

from shapeviz_report.charts.palette import LIGHT

Framed = TypeVar("Framed", alt.Chart, alt.LayerChart)


def subset_bars() -> alt.Chart:
    """Fig. 4, above: a bar a subset, in the colour of its feature where it has but one.

    Data ``subsets``: rows of ``place`` from 0, ``hit`` in [0, 1], and ``feature``, the index of the only feature or
    -1. Parameter ``count`` is the number of places, ``fill`` the share of a place that its bar takes.
    """
    return _framed(
        alt.Chart(alt.NamedData("subsets"))
        .transform_calculate(end="datum.place + fill")
        .mark_rect()
        .encode(
            x=alt.X(
                "place:Q",
                axis=None,
                scale=alt.Scale(domainMin=0, domainMax=alt.ExprRef("count"), nice=False, zero=False),
            ),
            x2="end:Q",
            y=alt.Y("hit:Q", axis=None, scale=alt.Scale(domain=[0, 1], nice=False)),
            y2=alt.datum(0),
            color=alt.condition("datum.feature >= 0", _hue(), alt.value(alt.ExprRef("bar"))),
        ),
        "Neighbourhood hit of every subset of features, best first",
        "none",
        count=1,
        fill=1,
        bar="#888888",
    )


def feature_matrix() -> alt.Chart:
    """Fig. 4, below: a row a feature, a cell where the subset above has it.

    Data ``rows``: GeoJSON features in pixels from the top left, each all cells of a row, with ``feature``. A mark a
    cell would keep a browser busy for a quarter of a second.
    """
    return _framed(
        alt.Chart(alt.NamedData("rows"))
        .mark_geoshape()
        .encode(color=_hue())
        .project(type="identity", scale=1, translate=[0, 0]),
        "The features of every subset",
        "none",
    )


def class_boxes() -> alt.LayerChart:
    """Fig. 3: how NH_c of each class spreads over all subsets, and where the chosen subset lies.

    Data ``classes``: rows of ``row`` (0 on top), ``least``, ``lower``, ``median``, ``upper``, ``most`` and ``hit``,
    the chosen subset's, in [0, 1] or null. The names of the classes stand beside the boxes.
    """
    base = alt.Chart().encode(
        y=alt.Y("row:O", axis=None, scale=alt.Scale(paddingInner=0.42, paddingOuter=0.21))
    )

    def across(field: str) -> alt.X:
        # A little more than the range, so that a dot at its end is whole.
        return alt.X(field, axis=None, scale=alt.Scale(domain=[-0.03, 1.03], nice=False, zero=False))

    whiskers = base.mark_rule(color=alt.ExprRef("ink"), opacity=0.45).encode(x=across("least:Q"), x2="most:Q")
    boxes = base.mark_bar(color=alt.ExprRef("bar")).encode(x=across("lower:Q"), x2="upper:Q")
    medians = base.mark_tick(color=alt.ExprRef("ink"), thickness=2).encode(x=across("median:Q"))
    chosen = (
        base.transform_filter("isValid(datum.hit)")
        .mark_point(
            filled=True, size=70, opacity=1, color=alt.ExprRef("accent"), stroke=alt.ExprRef("ground")
        )
        .encode(x=across("hit:Q"))
    )
    return _framed(
        alt.LayerChart(layer=[whiskers, boxes, medians, chosen], data=alt.NamedData("classes")),
        "Neighbourhood hit of every class over all subsets",
        "none",
        ink="#222222",
        bar="#bbbbbb",
        accent="#1f5f99",
        ground="#ffffff",
    )


def effect_dots() -> alt.LayerChart:
    """What a feature adds or spoils: from the mean without it to the mean with it, and what it reaches alone.

    Data ``effects``: rows of ``name``, ``feature`` (its index), ``alone``, ``without`` and ``with``; the last two
    null where they are not known.
    """
    base = alt.Chart().encode(y=_names("name:N", 90))
    known = base.transform_filter("isValid(datum.without)")
    ways = known.mark_rule(strokeWidth=3, opacity=1).encode(x=_scored("without:Q"), x2="with:Q", color=_hue())
    without = known.mark_point(
        filled=True, size=60, opacity=1, color=alt.ExprRef("ground"), strokeWidth=2
    ).encode(x=_scored("without:Q"), stroke=_hue())
    with_ = known.mark_point(filled=True, size=90, opacity=1).encode(x=_scored("with:Q"), color=_hue())
    alone = base.mark_tick(thickness=3, size=14, opacity=1).encode(x=_scored("alone:Q"), color=_hue())
    return _framed(
        alt.LayerChart(layer=[ways, without, with_, alone], data=alt.NamedData("effects")),
        "NH of maps with and without each feature",
        "fit",
        ground="#ffffff",
    )


def seed_dots() -> alt.LayerChart:
    """How far the seed moves the best subsets: a dot a seed, the mean, and the interval of its distance to the best.

    Data ``seeds``: a row a subset and seed, with ``name``, ``hit`` and, the same in all rows of a subset, ``mean``,
    ``low``, ``high``, ``best`` (the best mean of all) and ``apart`` (whether it is told apart from the best).
    """
    base = alt.Chart().encode(
        y=_names("name:N", alt.ExprRef("label_limit")),
        opacity=alt.condition("datum.apart", alt.value(0.45), alt.value(1)),
    )
    dots = base.mark_point(filled=True, size=26, color=alt.ExprRef("bar")).encode(x=_scored("hit:Q"))
    one = base.transform_aggregate(
        mean="mean(mean)", low="mean(low)", high="mean(high)", apart="max(apart)", groupby=["name"]
    )
    intervals = one.mark_rule(strokeWidth=2, color=alt.ExprRef("accent")).encode(
        x=_scored("low:Q"), x2="high:Q"
    )
    means = one.mark_point(filled=True, size=80, color=alt.ExprRef("accent")).encode(x=_scored("mean:Q"))
    best = (
        alt.Chart()
        .transform_aggregate(best="max(best)")
        .mark_rule(strokeDash=[2, 2], color=alt.ExprRef("ink"), opacity=0.7)
        .encode(x=_scored("best:Q"))
    )
    return _framed(
        alt.LayerChart(layer=[best, dots, intervals, means], data=alt.NamedData("seeds")),
        "NH of the best subsets over seeds",
        "fit",
        ink="#222222",
        bar="#888888",
        accent="#1f5f99",
        label_limit=240,
    )


def _hue() -> alt.Color:
    """The colour of a feature."""
    return alt.Color(
        "feature:N", legend=None, scale=alt.Scale(domain=list(range(len(LIGHT.features))), range="ordinal")
    )


def _names(field: str, limit: float | alt.ExprRef) -> alt.Y:
    """Rows with their names beside them, in the order of the data."""
    return alt.Y(
        field,
        sort=None,
        axis=alt.Axis(
            title=None, labelLimit=limit, domain=False, ticks=False, labelPadding=10, labelFontSize=12
        ),
    )


def _scored(field: str) -> alt.X:
    """Neighbourhood hit, as far as the data reaches."""
    return alt.X(
        field,
        axis=alt.Axis(title="NHₛ", format=".2f", tickCount=5, domain=False, ticks=False),
        scale=alt.Scale(zero=False, nice=True, padding=8),
    )


def _framed(
    chart: Framed, description: str, autosize: Literal["none", "fit"], **parameters: object
) -> Framed:
    """Add parameters and the frame that the page resizes; with names or axes, "fit" makes room for them in it."""
    return (
        chart.add_params(*(alt.param(name=name, value=value) for name, value in parameters.items()))
        .properties(
            width=600,
            height=200,
            padding=0,
            description=description,
            autosize=alt.AutoSizeParams(type=autosize, contains="padding"),
        )
        .configure_view(stroke=None)
    )
