"""Templates and scripts are found in a wheel and in a checkout."""

import pytest

from shapeviz_report.writing import resources


@pytest.mark.parametrize(("site", "templates"), [("pkg/_site", "pkg/_templates"), ("site", "templates")])
def test_both_layouts_are_found(tmp_path, monkeypatch, site, templates):
    for folder in (site, templates):
        (tmp_path / folder).mkdir(parents=True)
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path / "pkg")
    assert resources.site_folder() == tmp_path / site
    assert resources.templates_folder() == tmp_path / templates


def test_an_incomplete_installation_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path / "pkg")
    with pytest.raises(FileNotFoundError, match="incomplete"):
        resources.site_folder()


def test_this_installation_is_complete():
    assert (resources.site_folder() / "vendor" / "vega.js").is_file()
    assert (resources.templates_folder() / "base.html").is_file()
