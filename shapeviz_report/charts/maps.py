"""The three linked maps of the Overview (paper, Fig. 2): by class, by neighbourhood hit, as thumbnails.

The charts hold no data. The page hands every map the same rows, one a shape, under the name ``shapes``:

``index``
    Position of the shape in the report.
``group``
    Index of its class, -1 without one. An index, not the name, because a name is free text.
``x``, ``y``
    One coordinate a projection.
``hit``
    Neighbourhood hit in each projection, as a share of what it can be in a class of this size; null where it has none.
``picture``
    Address of the thumbnail.

The page drives the charts through parameters, so that one frame of a movement costs an update of numbers and
not a new chart: ``origin`` and ``target`` are the projections to move between and ``progress`` in [0, 1] how far
that has come; ``x_domain`` and ``y_domain`` are the part of the plane in view; ``emphasis`` says for every shape
how present it is: 0 hidden, 1 faint, 2 normal, 3 chosen.
"""

from __future__ import annotations

import altair as alt

from shapeviz_report.charts.palette import SYMBOLS, class_symbol_indices

#: Opacity of a shape that is there only for orientation.
FAINT_OPACITY = 0.14

_FAINT = "emphasis[datum.index] == 1"
_PRESENT = "emphasis[datum.index] > 1"


def class_map(class_count: int) -> alt.LayerChart:
    """Every shape as a symbol in the colour of its class."""
    groups = list(range(class_count))
    symbols = [SYMBOLS[index] for index in class_symbol_indices(class_count)]
    color = alt.condition(
        "datum.group >= 0",
        alt.Color("group:N", legend=None, scale=alt.Scale(domain=groups, range="category")),
        alt.value(alt.ExprRef("unlabelled")),
    )
    shape = alt.condition(
        "datum.group >= 0",
        alt.Shape("group:N", legend=None, scale=alt.Scale(domain=groups, range=symbols)),
        alt.value(SYMBOLS[0]),
    )
    return _points(color, "Map of all shapes, coloured by class", shape=shape)


def hit_map() -> alt.LayerChart:
    """Every shape as a dot from red (no neighbour of its class) to yellow (all, or as many as its class has others)."""
    color = alt.condition(
        "datum.shown_hit >= 0",
        alt.Color("shown_hit:Q", legend=None, scale=alt.Scale(domain=[0, 1], range="ramp")),
        alt.value(alt.ExprRef("unlabelled")),
    )
    return _points(color, "Map of all shapes, coloured by neighbourhood hit")


def thumbnail_map() -> alt.LayerChart:
    """Every shape as its picture; where they would cover each other, the page moves some and turns others into dots.

    Parameter ``pictured`` says for every shape whether its picture is drawn, ``picture_size`` how large, in
    pixels; ``shift_x`` and ``shift_y`` how far from its place, in sizes of a picture, of which one is ``shift_size``
    in the plane.
    """

    def marks(emphasis: str) -> tuple[alt.Chart, alt.Chart]:
        base = _placed(shift=True)
        dots = (
            base.transform_filter(f"!pictured[datum.index] && {emphasis}")
            .mark_circle(clip=True, opacity=0.7, size=alt.ExprRef("mark_size * 0.4"))
            .encode(**_position(), color=alt.value(alt.ExprRef("unlabelled")))
        )
        pictures = (
            base.transform_filter(f"pictured[datum.index] && {emphasis}")
            .mark_image(clip=True, width=alt.ExprRef("picture_size"), height=alt.ExprRef("picture_size"))
            .encode(**_position(), url=alt.Url("picture:N"))
        )
        return dots, pictures

    return _framed(
        alt.LayerChart(layer=[*marks(_FAINT), _veil(), *marks(_PRESENT)], data=alt.NamedData("shapes")),
        "Map of all shapes as pictures",
        pictured=[],
        picture_size=40,
        shift_x=[],
        shift_y=[],
        shift_size=0,
    )


def _points(color: object, description: str, **channels: object) -> alt.LayerChart:
    def marks(emphasis: str) -> alt.Chart:
        return (
            _placed()
            .transform_filter(emphasis)
            .mark_point(clip=True, filled=True, stroke=alt.ExprRef("outline"), strokeWidth=0.6, opacity=0.92)
            .encode(
                **_position(),
                **channels,
                color=color,
                size=alt.condition(
                    "emphasis[datum.index] == 3",
                    alt.value(alt.ExprRef("mark_size * 1.5")),
                    alt.value(alt.ExprRef("mark_size")),
                ),
                order=alt.Order("rank:Q"),
            )
        )

    return _framed(
        alt.LayerChart(layer=[marks(_FAINT), _veil(), marks(_PRESENT)], data=alt.NamedData("shapes")),
        description,
    )


def _veil() -> alt.Chart:
    """What makes all that lies below it faint alike, where anything does: marks that lie on each other, too."""
    return (
        alt.Chart()
        .transform_filter(_FAINT)
        .transform_aggregate(faint="count()")
        .transform_filter("datum.faint > 0")
        .mark_rect(color=alt.ExprRef("ground"), opacity=1 - FAINT_OPACITY)
        .encode(x=alt.value(0), x2=alt.value("width"), y=alt.value(0), y2=alt.value("height"))
    )


def _placed(*, shift: bool = False) -> alt.Chart:
    """Rows moved along the way from one projection to the next, drawn from faint to chosen."""

    def moved(axis: str, sign: str) -> str:
        place = f"datum.{axis}[origin] + progress * (datum.{axis}[target] - datum.{axis}[origin])"
        return f"{place} {sign} (shift_{axis}[datum.index] || 0) * shift_size" if shift else place

    return alt.Chart().transform_calculate(
        moved_x=moved("x", "+"),
        # On a screen, down is up.
        moved_y=moved("y", "-"),
        # A number even where there is none: Vega-Lite would drop or recolour the shape otherwise.
        shown_hit="isValid(datum.hit[target]) ? datum.hit[target] : -1",
        rank="emphasis[datum.index]",
    )


def _position() -> dict[str, alt.X | alt.Y]:
    """Position channels without axes: only distances mean something on these maps."""

    def scale(domain: str) -> alt.Scale:
        return alt.Scale(
            domainMin=alt.ExprRef(f"{domain}[0]"),
            domainMax=alt.ExprRef(f"{domain}[1]"),
            nice=False,
            zero=False,
        )

    return {
        "x": alt.X("moved_x:Q", axis=None, scale=scale("x_domain")),
        "y": alt.Y("moved_y:Q", axis=None, scale=scale("y_domain")),
    }


def _framed(chart: alt.LayerChart, description: str, **parameters: object) -> alt.LayerChart:
    """Add the parameters every map has and the frame that the page resizes."""
    defaults: dict[str, object] = {
        "origin": 0,
        "target": 0,
        "progress": 1,
        "x_domain": [-1, 1],
        "y_domain": [-1, 1],
        "emphasis": [],
        "mark_size": 60,
        "unlabelled": "#888888",
        "outline": "#00000055",
        "ground": "#ffffff",
        **parameters,
    }
    return (
        chart.add_params(*(alt.param(name=name, value=value) for name, value in defaults.items()))
        .properties(
            width=600,
            height=600,
            padding=0,
            description=description,
            autosize=alt.AutoSizeParams(type="none"),
        )
        .configure_view(stroke=None)
    )
