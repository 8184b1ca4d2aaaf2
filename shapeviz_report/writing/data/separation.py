"""How far classes are told apart, for ``summary.json`` and for a table. ``docs/using/site-data.md`` describes it."""

from __future__ import annotations

from shapeviz_report.types import ClassRates, Separation
from shapeviz_report.writing.data.encoding import number


def separation_summary(found: Separation) -> dict[str, object]:
    """The means over shapes."""

    def means(rates: ClassRates) -> dict[str, float]:
        return {
            "nearest": found.over_shapes(rates.nearest),
            "elected": found.over_shapes(rates.elected),
            "silhouette": found.over_shapes(rates.silhouette),
        }

    return {
        "k": found.k,
        "shapes": found.shapes,
        "features": means(found.features),
        "projections": {method: means(rates) for method, rates in found.maps.items()},
        "chance": {**means(found.chance), "silhouette_std": found.chance_spread},
    }


def separation_rows(found: Separation) -> list[list[str]]:
    """A row a class and what is compared."""
    rows = [["compared", "class", "shapes", "nearest", "elected", "silhouette", "mistaken_for"]]
    compared = {"features": found.features, **found.maps, "random labels": found.chance}
    for name, rates in compared.items():
        for place, label in enumerate(found.classes):
            taken = found.mistaken[place] if name == "features" else -1
            values = (rates.nearest, rates.elected, rates.silhouette)
            rows.append(
                [
                    name,
                    label,
                    str(found.sizes[place]),
                    *(number(float(kind[place])) for kind in values),
                    "" if taken < 0 else found.classes[taken],
                ]
            )
    return rows
