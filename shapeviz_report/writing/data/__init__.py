"""A site's ``data/`` folder, written and read."""

from shapeviz_report.writing.data.encoding import GENERATOR, json_text
from shapeviz_report.writing.data.files import DATA_NAMES, data_files
from shapeviz_report.writing.data.reading import SiteData, read_site
from shapeviz_report.writing.data.summary import summary

__all__ = ["DATA_NAMES", "GENERATOR", "SiteData", "data_files", "json_text", "read_site", "summary"]
