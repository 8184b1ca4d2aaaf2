"""The global descriptors, of a shape as a whole: one file each. They hold on meshes that are cut, open or tangled."""

from shapeviz_report.global_descriptors.base import GlobalDescriptor
from shapeviz_report.global_descriptors.depth_views import DEPTH_VIEWS
from shapeviz_report.global_descriptors.panorama import PANORAMA
from shapeviz_report.global_descriptors.panorama_slant import PANORAMA_SLANT
from shapeviz_report.global_descriptors.posed_shape import PosedShape
from shapeviz_report.global_descriptors.silhouettes import SILHOUETTES
from shapeviz_report.global_descriptors.surflets import SURFLETS

GLOBAL_DESCRIPTORS: tuple[GlobalDescriptor, ...] = (
    PANORAMA,
    PANORAMA_SLANT,
    DEPTH_VIEWS,
    SILHOUETTES,
    SURFLETS,
)

__all__ = ["GLOBAL_DESCRIPTORS", "GlobalDescriptor", "PosedShape"]
