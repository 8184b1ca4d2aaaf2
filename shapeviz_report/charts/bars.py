"""Horizontal bars of a value a class, such as the neighbourhood hit NH_c of the paper's Fig. 2."""

from __future__ import annotations

import altair as alt

#: Pixels that the value of a bar takes beside it.
LABEL = 44


def class_bars() -> alt.LayerChart:
    """One bar a class with its value in three decimals, and a rule where random labels would end.

    Where a class is too small for its NH to reach 1, a tick stands at what it can reach, and its colour is by the share
    of that.

    The page sets the data ``classes``, rows of ``row`` (0 on top), ``hit`` in [0, 1] or null, ``highest`` (the most it
    can be, or null), and ``present`` (false where the class is hidden). Its parameter ``chance`` is the value of random
    labels, -1 without one.
    The names of the classes stand beside the bars as buttons of the page.
    """
    rows = alt.Y("row:O", axis=None, scale=alt.Scale(paddingInner=0.42, paddingOuter=0.21))
    presence = alt.condition("datum.present", alt.value(1), alt.value(0.3))
    bars = (
        alt.Chart()
        .mark_bar(cornerRadiusEnd=1.5)
        .encode(
            x=_unit("hit:Q"),
            y=rows,
            color=alt.Color("share:Q", legend=None, scale=alt.Scale(domain=[0, 1], range="ramp")),
            opacity=presence,
        )
        .transform_calculate(share="datum.highest > 0 ? datum.hit / datum.highest : 0")
    )
    ends = (
        alt.Chart()
        .transform_filter("isValid(datum.highest) && datum.highest < 0.9999")
        .mark_tick(thickness=1.5, color=alt.ExprRef("ink"))
        .encode(x=_unit("highest:Q"), y=rows, opacity=presence)
    )
    values = (
        alt.Chart()
        .mark_text(align="left", baseline="middle", dx=5, fontSize=12, color=alt.ExprRef("ink"))
        .encode(
            x=_unit("anchor:Q"),
            y=rows,
            text=alt.Text("label:N"),
            opacity=presence,
        )
        .transform_calculate(
            # Beside the tick where the bar ends at or just before it.
            ended=f"datum.highest < 0.9999 && datum.highest - datum.hit < {LABEL} / max(width - {LABEL}, 1)",
            anchor="!isValid(datum.hit) ? 0 : datum.ended ? datum.highest : datum.hit",
            label="isValid(datum.hit) ? format(datum.hit, '.3f') : '–'",
        )
    )
    chance = (
        alt.Chart()
        .transform_calculate(random="chance")
        .transform_filter("datum.row == 0 && chance >= 0")
        .mark_rule(strokeDash=[2, 2], color=alt.ExprRef("ink"), opacity=0.7)
        .encode(x=_unit("random:Q"))
    )
    parameters = {"chance": -1, "ink": "#222222"}
    return (
        alt.layer(bars, ends, chance, values, data=alt.NamedData("classes"))
        .add_params(*(alt.param(name=name, value=value) for name, value in parameters.items()))
        .properties(
            width=200,
            height=300,
            padding=0,
            description="Neighbourhood hit of every class",
            autosize=alt.AutoSizeParams(type="none"),
        )
        .configure_view(stroke=None)
    )


def _unit(field: str) -> alt.X:
    """The range [0, 1], with room on the right for the longest label."""
    room = alt.ExprRef(f"max(width - {LABEL}, 8)")
    return alt.X(field, axis=None, scale=alt.Scale(domain=[0, 1], range=[0, room], nice=False, zero=True))
