"""The search for bins: the fewest that separate a class, a set that separates all, and what these are worth.

Every function is pure and does a piece of work of its own (one class, one fold), so that a caller may spread them
over processes.
"""

from shapeviz_report.search.bins.automatic import select_bins
from shapeviz_report.search.bins.bin_space import SAMPLE_LIMIT_OF_CLASS, BinSpace, encode, make_bin_space
from shapeviz_report.search.bins.honest import affordable_deals, hold_out, shuffle_labels
from shapeviz_report.search.bins.minimal import find_minimal_bins

__all__ = [
    "SAMPLE_LIMIT_OF_CLASS",
    "BinSpace",
    "affordable_deals",
    "encode",
    "find_minimal_bins",
    "hold_out",
    "make_bin_space",
    "select_bins",
    "shuffle_labels",
]
