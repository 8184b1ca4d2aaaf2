"""What templates and scripts take for granted of a report, checked once before they see it."""

from __future__ import annotations

import numpy as np

from shapeviz_report.errors import SiteError
from shapeviz_report.order import natural
from shapeviz_report.pages.base import class_names
from shapeviz_report.types import Report


def _is_webp(picture: bytes) -> bool:
    return picture[:4] == b"RIFF" and picture[8:12] == b"WEBP"


def check_report(report: Report) -> None:
    """Check once, here, what templates and scripts then take for granted."""
    count = len(report.shapes)
    if count == 0:
        raise SiteError(
            f"no shape of {report.database.name!r} could be used ({len(report.failures)} files failed): "
            "there is nothing to show"
        )
    ids = tuple(shape.id for shape in report.shapes)

    def require(holds: bool, what: str) -> None:
        if not holds:
            raise ValueError(f"inconsistent report: {what}")

    require(len(set(ids)) == count, "two shapes share an id")
    require(list(ids) == sorted(ids, key=natural), "shapes are not sorted by id")
    require(ids == report.features.shape_ids, "feature rows are not those of the shapes")
    require(
        report.features.values.shape == (count, len(report.features.columns)), "feature table of another size"
    )
    require(bool(np.isfinite(report.features.values).all()), "a feature is not finite")
    dimensions = sum(block.dimensions for block in report.features.blocks if block.bins > 1)
    require(report.edges.shape == (dimensions, 11), "edges do not match the features")
    if report.scores is not None:
        classes = class_names(report)
        require(report.scores.classes == classes, "scores do not match the classes")
        size = (len(report.scores.methods), len(classes), len(report.features.columns))
        require(report.scores.values.shape == size, "scores of another size")
        held = (report.scores.values >= 0) & (report.scores.values <= 1)
        require(bool(held.all()), "a score is not in [0, 1]")
    for name in ("facts", "thumbnails", "labels"):
        require(len(getattr(report, name)) == count, f"{name} do not match the shapes")
    for picture in report.thumbnails:
        require(_is_webp(picture), "a thumbnail is not a WebP image")
    for painting in report.paintings:
        require(painting.column in report.features.columns, "a painting of a bin that is not there")
        require(0 <= painting.shape < count, "a painting of a shape that is not there")
        require(_is_webp(painting.value) and _is_webp(painting.inside), "a painting is not a WebP image")
    if report.clusters is not None:
        clusters = report.clusters
        require(clusters.of.shape == (count,), "clusters do not match the shapes")
        sizes = np.bincount(clusters.of, minlength=len(clusters.clusters)).tolist()
        require(sizes == [cluster.size for cluster in clusters.clusters], "a cluster of another size")
        for number, cluster in enumerate(clusters.clusters):
            require(clusters.of[cluster.central] == number, "the centre of a cluster is not in it")
        names = [clusters.clusters[number].name for number in clusters.of]
        require(not clusters.stand_in or list(report.labels) == names, "labels are not the clusters")
    if report.models is not None:
        require(len(report.models) == count, "models do not match the shapes")
        require(all(model[:2] == b"\x1f\x8b" for model in report.models), "a model is not gzipped")
    require(report.labeling is not None or not any(report.labels), "labels without a labeling")
    require(bool(report.projections), "no projection")
    for method, (projection, quality) in report.projections.items():
        require(method.isidentifier() and method == projection.method, f"projection {method!r} is misnamed")
        require(projection.xy.shape == (count, 2), f"projection {method} has another number of points")
        require(bool(np.isfinite(projection.xy).all()), f"projection {method} has a point that is not finite")
        require(quality.nh.shape == (count,), f"quality of {method} has another number of shapes")
