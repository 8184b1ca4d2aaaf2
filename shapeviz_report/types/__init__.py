"""The data that flows from stage to stage: frozen dataclasses, checked where they are made.

``Database`` of ``ShapeEntry`` -> ``Mesh`` -> per-vertex descriptors -> ``FeatureTable`` -> ``Projection``
-> ``Quality`` -> pages. A ``Failure`` travels beside them to the About page.
"""

from shapeviz_report.types.arrays import BoolArray, Float32Array, FloatArray, Int64Array, IntArray
from shapeviz_report.types.bins import (
    BinScores,
    BinSearch,
    BinSelection,
    BinStep,
    HeldOutBins,
    MinimalBins,
    MinimalSet,
    Painting,
)
from shapeviz_report.types.clusters import Cluster, Clusters
from shapeviz_report.types.copies import (
    Copy,
    CopyGroup,
    Match,
    WithoutCopies,
    copies_beside,
    copies_of,
    distinct_rows,
    group_copies,
    list_groups,
    representatives,
)
from shapeviz_report.types.database import Database, Failure, ShapeEntry
from shapeviz_report.types.features import FeatureBlock, FeatureTable
from shapeviz_report.types.maps import Faithfulness, HitRange, Projection, Quality, Shepard
from shapeviz_report.types.mesh import Mesh, ShapeFacts, UpAxis
from shapeviz_report.types.publication import Accent, Licence, Logo, Publication
from shapeviz_report.types.report import Exported, Report
from shapeviz_report.types.retrieval import Rating, Retrieval
from shapeviz_report.types.search import (
    FeatureEffect,
    FeatureSearch,
    Gain,
    GreedySearch,
    GreedyStep,
    HeldOutFold,
    SearchRow,
    SeedSpread,
    SubsetFaithfulness,
    SubsetScores,
)
from shapeviz_report.types.separation import ClassRates, Separation

__all__ = [
    "Accent",
    "BinScores",
    "BinSearch",
    "BinSelection",
    "BinStep",
    "BoolArray",
    "ClassRates",
    "Cluster",
    "Clusters",
    "Copy",
    "CopyGroup",
    "Database",
    "Exported",
    "Failure",
    "Faithfulness",
    "FeatureBlock",
    "FeatureEffect",
    "FeatureSearch",
    "FeatureTable",
    "Float32Array",
    "FloatArray",
    "Gain",
    "GreedySearch",
    "GreedyStep",
    "HeldOutBins",
    "HeldOutFold",
    "HitRange",
    "Int64Array",
    "IntArray",
    "Licence",
    "Logo",
    "Match",
    "Mesh",
    "MinimalBins",
    "MinimalSet",
    "Painting",
    "Projection",
    "Publication",
    "Quality",
    "Rating",
    "Report",
    "Retrieval",
    "SearchRow",
    "SeedSpread",
    "Separation",
    "ShapeEntry",
    "ShapeFacts",
    "Shepard",
    "SubsetFaithfulness",
    "SubsetScores",
    "UpAxis",
    "WithoutCopies",
    "copies_beside",
    "copies_of",
    "distinct_rows",
    "group_copies",
    "list_groups",
    "representatives",
]
