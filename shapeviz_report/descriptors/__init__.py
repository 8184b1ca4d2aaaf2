"""The eight local descriptors (paper, 3.3 and Table 1): one file each, ``DESCRIPTORS`` in the table's order."""

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.fast_point_feature_histogram import FAST_POINT_FEATURE_HISTOGRAM
from shapeviz_report.descriptors.gaussian_curvature import GAUSSIAN_CURVATURE
from shapeviz_report.descriptors.geodesic_distance import GEODESIC_DISTANCE
from shapeviz_report.descriptors.normal_angle import NORMAL_ANGLE
from shapeviz_report.descriptors.normal_diameter import NORMAL_DIAMETER
from shapeviz_report.descriptors.point_angle import POINT_ANGLE
from shapeviz_report.descriptors.point_feature_histogram import POINT_FEATURE_HISTOGRAM
from shapeviz_report.descriptors.shape_context import SHAPE_CONTEXT
from shapeviz_report.descriptors.surface import Surface

DESCRIPTORS: tuple[Descriptor, ...] = (
    GAUSSIAN_CURVATURE,
    GEODESIC_DISTANCE,
    NORMAL_DIAMETER,
    NORMAL_ANGLE,
    POINT_ANGLE,
    SHAPE_CONTEXT,
    POINT_FEATURE_HISTOGRAM,
    FAST_POINT_FEATURE_HISTOGRAM,
)

__all__ = ["DESCRIPTORS", "Descriptor", "Surface"]
