"""The colours and symbols of the site, for light and for dark.

Twenty class colours share their hues between the two themes, so that a class stays recognisable when the
theme changes; only lightness moves. They are ordered so that the first few, which small databases use, lie
farthest apart, with the two common colour-vision deficiencies simulated. Colour alone cannot carry more than
about eight classes for every reader, so beyond that a symbol joins it: up to some fifty classes, colours that
some readers confuse never share a symbol, and a hundred classes keep a pair of their own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

#: Up to this many classes, circles of different colour suffice.
PLAIN_CLASSES = 8

#: Symbols as SVG paths in a square of side 2 around the origin, of about equal area.
SYMBOLS: tuple[str, ...] = (
    "M0.8,0A0.8,0.8,0,1,1,-0.8,0A0.8,0.8,0,1,1,0.8,0Z",
    "M-0.71,-0.71L0.71,-0.71L0.71,0.71L-0.71,0.71Z",
    "M0,-1L0.98,0.72L-0.98,0.72Z",
    "M0,-1L1,0L0,1L-1,0Z",
    "M-0.32,-0.95L0.32,-0.95L0.32,-0.32L0.95,-0.32L0.95,0.32L0.32,0.32L0.32,0.95L-0.32,0.95L-0.32,0.32"
    "L-0.95,0.32L-0.95,-0.32L-0.32,-0.32Z",
    "M0,1L-0.98,-0.72L0.98,-0.72Z",
    "M-0.445,-0.898L0,-0.453L0.445,-0.898L0.898,-0.445L0.453,0L0.898,0.445L0.445,0.898L0,0.453L-0.445,0.898"
    "L-0.898,0.445L-0.453,0L-0.898,-0.445Z",
)

#: Colour and symbol of a hundred classes. The first twenty take the colours in order. A search dealt out the rest so
#: that the colours of one symbol lie as far apart as can be in both themes, to readers of each kind of colour vision:
#: 0.085 in OKLab up to twenty classes, 0.065 up to forty-five, 0.055 up to fifty; one just sees a difference of 0.02.
_MARKS = tuple(
    divmod(int(mark), 10)
    for marks in (
        "000 011 022 033 044 055 066 075 081 096 102 111 120 133 144 153 162 174 180 196",
        "053 015 116 110 025 052 003 171 050 014 151 005 106 071 164 115 062 192 112 086",
        "002 043 084 065 070 006 026 024 064 020 166 023 021 141 074 165 161 103 054 051",
        "085 083 082 080 056 095 093 092 090 094 091 076 072 190 073 060 186 185 184 182",
        "146 145 143 142 140 125 124 121 160 136 132 130 193 135 134 131 010 195 194 191",
    )
    for mark in marks.split()
)


ThemeName = Literal["light", "dark"]


@dataclass(frozen=True)
class Theme:
    """Colours of one theme, as ``#rrggbb``.

    Attributes
    ----------
    name : ThemeName
    ground : str
        What marks lie on.
    ink : str
        Text.
    unlabelled : str
        Shapes without a class, and without a neighbourhood hit.
    outline : str
        A thin edge that keeps light marks visible on a light ground.
    classes : tuple of str
    hit : tuple of str
        Neighbourhood hit from 0 (red) to 1 (yellow), with rising lightness.
    features : tuple of str
        One hue a feature. They are no class colours, but may stand beside them.
    bar : str
        Marks that stand for no feature and no class.
    grid : str
        Lines behind marks.
    """

    name: ThemeName
    ground: str
    ink: str
    unlabelled: str
    outline: str
    classes: tuple[str, ...]
    hit: tuple[str, ...]
    features: tuple[str, ...]
    bar: str
    grid: str


LIGHT = Theme(
    name="light",
    ground="#ffffff",
    ink="#1c1d1f",
    unlabelled="#8d8f93",
    outline="#00000059",
    classes=(
        "#2f6db5",
        "#c9a100",
        "#8a1f45",
        "#2fb0a6",
        "#a98be0",
        "#1d3f86",
        "#585f12",
        "#6f8f72",
        "#0f5c66",
        "#a8419a",
        "#86a81f",
        "#5fa8e6",
        "#e07b1a",
        "#b99463",
        "#2e7d4f",
        "#7a4a26",
        "#d95f9e",
        "#7d4fb3",
        "#c8312f",
        "#f0907a",
    ),
    hit=("#9c0824", "#c02a22", "#da5120", "#ec7a1c", "#f6a21d", "#fbc93a", "#fdec6b"),
    features=(
        "#43b7b9",
        "#157c9e",
        "#38a31f",
        "#80200d",
        "#a2ad61",
        "#c13475",
        "#8c72d8",
        "#886718",
        "#0d3bae",
        "#7b0e86",
        "#2d2004",
        "#560a43",
        "#5e5f4b",
        "#11016d",
    ),
    bar="#bdb9b1",
    grid="#e9e5dd",
)

DARK = Theme(
    name="dark",
    ground="#15171b",
    ink="#e9e7e2",
    unlabelled="#83868c",
    outline="#00000066",
    classes=(
        "#63a2ee",
        "#edc443",
        "#cf607f",
        "#5fd7cd",
        "#cdb3ff",
        "#587fcc",
        "#909850",
        "#9abc9d",
        "#5498a2",
        "#e075cf",
        "#acd051",
        "#92ccff",
        "#ffa968",
        "#e0ba88",
        "#65b281",
        "#b7835e",
        "#ff91c6",
        "#b184ed",
        "#ff6f65",
        "#febbab",
    ),
    hit=("#b5203a", "#cf3a2e", "#e05c28", "#ee8225", "#f6a628", "#fbcb42", "#fdec6b"),
    features=(
        "#45e3d6",
        "#2cbded",
        "#84b77b",
        "#a45241",
        "#d4e093",
        "#d96894",
        "#9281d0",
        "#c39211",
        "#3461c7",
        "#89588e",
        "#a37a1e",
        "#6f4762",
        "#c4c63d",
        "#6279fe",
    ),
    bar="#565b63",
    grid="#2a2e34",
)

THEMES: tuple[Theme, ...] = (LIGHT, DARK)


def class_color_indices(count: int) -> tuple[int, ...]:
    """Index into :attr:`Theme.classes` for each of ``count`` classes in sorted order."""
    return tuple(_MARKS[index % len(_MARKS)][0] for index in range(count))


def feature_color_indices(count: int) -> tuple[int, ...]:
    """Index into :attr:`Theme.features` for each of ``count`` features."""
    return tuple(index % len(LIGHT.features) for index in range(count))


def class_symbol_indices(count: int) -> tuple[int, ...]:
    """Index into :data:`SYMBOLS` for each of ``count`` classes in sorted order: all circles where colours suffice."""
    if count <= PLAIN_CLASSES:
        return (0,) * count
    return tuple(_MARKS[index % len(_MARKS)][1] for index in range(count))
