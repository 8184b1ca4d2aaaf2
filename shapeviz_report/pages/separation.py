"""Whether the features tell the classes apart, before a map is blamed: for the Overview and the Features page."""

from __future__ import annotations

import numpy as np

from shapeviz_report.pages.base import class_names, map_title, rounded, stand_in
from shapeviz_report.pages.chunks import ClassCounts, MapVerdict
from shapeviz_report.pages.chunks import Separation as SeparationChunk
from shapeviz_report.quality import share_of_range
from shapeviz_report.types import Report, Separation

#: Decimals of shares.
SHARE_DECIMALS = 4

#: Less of the way from chance to always, and the features are said to tell classes apart badly.
KNOWING = 0.5

#: A loss of nearest neighbours that a reader would call one.
LOSS = 0.05

#: A class of which fewer shapes have one of it nearest is named as a hard one.
HARD = 0.8


def separation_of(report: Report) -> Separation | None:
    """What is to be told; None also of clusters, which the features themselves have made."""
    return None if stand_in(report) else report.separation


def _too_few(found: Separation) -> bool:
    """Whether the neighbours that elect a class are all other shapes, so that no feature could tell it."""
    return found.k >= found.shapes - 1


def separation_chunk(report: Report) -> SeparationChunk | None:
    """What the Overview says of each map."""
    found = separation_of(report)
    if found is None or _too_few(found):
        return None
    number = {name: place for place, name in enumerate(class_names(report))}
    return {
        "neighbours": found.k,
        "classes": [number[name] for name in found.classes],
        "sizes": found.sizes.tolist(),
        "nearest": rounded(found.features.nearest, SHARE_DECIMALS),
        "ofAll": found.over_shapes(found.features.nearest),
        "elected": found.over_shapes(found.features.elected),
        "chance": found.over_shapes(found.chance.nearest),
        "silhouette": found.over_shapes(found.features.silhouette),
        "silhouetteByChance": found.over_shapes(found.chance.silhouette),
        "hardest": _counts(found, int(found.features.nearest.argmin())) if _is_hard(found) else None,
        "maps": {method: judge(found, method) for method in found.maps},
    }


def judge(found: Separation, method: str) -> MapVerdict:
    """What one map makes of what the features know."""
    own, mapped = found.features.nearest, found.maps[method].nearest
    lost = int((own - mapped).argmax())
    return {
        "nearest": rounded(mapped, SHARE_DECIMALS),
        "ofAll": found.over_shapes(mapped),
        "verdict": _verdict(found, method),
        "lost": _counts(found, lost, method) if own[lost] - mapped[lost] >= 2 * LOSS else None,
    }


def _verdict(found: Separation, method: str) -> str:
    own, mapped = (found.over_shapes(rates.nearest) for rates in (found.features, found.maps[method]))
    loses = own - mapped >= max(LOSS, 2 * np.sqrt(own * (1 - own) / found.sizes.sum()))
    if not _know(found):
        blame = "The features themselves cannot tell many of these classes apart, and no map of them can."
        return f"{blame} This one loses more." if loses else blame
    if loses:
        return "The map is to blame: it mixes classes that the features tell apart."
    return "The map keeps what the features know: classes that mix on it are mixed by the features too."


def _know(found: Separation) -> bool:
    chance = found.over_shapes(found.chance.nearest)
    share = share_of_range(found.over_shapes(found.features.nearest), chance, 1.0)
    return share is not None and share >= KNOWING


def _is_hard(found: Separation) -> bool:
    return bool(found.features.nearest.min() < HARD)


def _counts(found: Separation, place: int, method: str | None = None) -> ClassCounts:
    """Of a class, how many shapes have one of it nearest by the features, and on a map."""
    size, taken = int(found.sizes[place]), int(found.mistaken[place])
    return {
        "name": found.classes[place],
        "shapes": size,
        "features": round(float(found.features.nearest[place]) * size),
        "map": None if method is None else round(float(found.maps[method].nearest[place]) * size),
        "mistaken": None if taken < 0 else found.classes[taken],
    }


def separation_context(report: Report) -> dict[str, object] | None:
    """What the Features page says, and its table: the class that is hardest to tell first."""
    found = separation_of(report)
    if found is None:
        return None
    compared = next(iter(report.projections.values()))[0].bins
    bins = None if compared is None else len(compared)
    if _too_few(found):
        return {"too_few": found.shapes, "k": found.k, "bins": bins}
    order = np.argsort(found.features.nearest, kind="stable")
    groups = found.features.silhouette > found.likely
    return {
        "k": found.k,
        "shapes": found.shapes,
        "shape_count": found.shape_count,
        "features": len(report.features.blocks),
        "too_few": None,
        "bins": bins,
        "nearest": found.over_shapes(found.features.nearest),
        "chance": found.over_shapes(found.chance.nearest),
        "elected": found.over_shapes(found.features.elected),
        "elected_by_chance": found.over_shapes(found.chance.elected),
        "silhouette": found.over_shapes(found.features.silhouette),
        "silhouette_by_chance": found.over_shapes(found.chance.silhouette),
        "silhouette_spread": found.chance_spread,
        "know": _know(found),
        "classes": len(found.classes),
        "groups": int(groups.sum()),
        "hardest": _counts(found, int(order[0])) if _is_hard(found) else None,
        "maps": [
            {
                "title": map_title(method),
                "nearest": found.over_shapes(rates.nearest),
                "elected": found.over_shapes(rates.elected),
                "silhouette": found.over_shapes(rates.silhouette),
                "verdict": _verdict(found, method),
            }
            for method, rates in found.maps.items()
        ],
        "rows": [
            {
                **_counts(found, place),
                "maps": [
                    round(float(rates.nearest[place]) * int(found.sizes[place]))
                    for rates in found.maps.values()
                ],
                "elected": float(found.features.elected[place]),
                "silhouette": float(found.features.silhouette[place]),
                "likely": float(found.likely[place]),
                "group": bool(groups[place]),
            }
            for place in order.tolist()
        ],
    }
