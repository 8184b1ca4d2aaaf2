"""Scores of bins (paper, 4.3): one file a method, ``SCORERS`` in the order a reader meets them."""

from shapeviz_report.scorers.anova import ANOVA
from shapeviz_report.scorers.base import Scorer
from shapeviz_report.scorers.chi2 import CHI2
from shapeviz_report.scorers.logistic import LOGISTIC
from shapeviz_report.scorers.relief import RELIEF
from shapeviz_report.scorers.rfe import RFE
from shapeviz_report.scorers.separation import (
    MOST_SCORED,
    Contest,
    as_one_group,
    each_from_each,
    score_separation,
)
from shapeviz_report.scorers.trees import TREES

SCORERS: tuple[Scorer, ...] = (CHI2, ANOVA, TREES, LOGISTIC, RELIEF, RFE)

__all__ = [
    "MOST_SCORED",
    "SCORERS",
    "Contest",
    "Scorer",
    "as_one_group",
    "each_from_each",
    "score_separation",
]
