"""From a report to a site: a folder of files, or one file."""

from shapeviz_report.writing.destination import check_destination
from shapeviz_report.writing.writer import write_site

__all__ = ["check_destination", "write_site"]
