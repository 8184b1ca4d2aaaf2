"""The search for the features whose map separates the classes best (paper, 4.1 and 4.2), and how sure it is."""

from shapeviz_report.search.run import EvaluateSubsets, planned_runs, search_features
from shapeviz_report.search.space import SearchSpace, SubsetMaps, make_space, map_subsets

__all__ = [
    "EvaluateSubsets",
    "SearchSpace",
    "SubsetMaps",
    "make_space",
    "map_subsets",
    "planned_runs",
    "search_features",
]
