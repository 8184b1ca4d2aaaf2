"""From a report to a site: a folder of files, or one file; or a frame in a notebook."""

from shapeviz_report.writing.destination import check_destination
from shapeviz_report.writing.notebook import ShownReport
from shapeviz_report.writing.writer import write_site

__all__ = ["ShownReport", "check_destination", "write_site"]
