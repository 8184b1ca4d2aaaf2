import pytest

from shapeviz_report.publication.licence import find_licence
from shapeviz_report.types import Licence


@pytest.mark.parametrize(
    ("text", "licence"),
    [
        ("CC-BY-4.0", Licence("CC BY 4.0: Attribution", "https://creativecommons.org/licenses/by/4.0/")),
        (
            "cc by-nc-sa 3.0",
            Licence(
                "CC BY-NC-SA 3.0: Attribution-NonCommercial-ShareAlike",
                "https://creativecommons.org/licenses/by-nc-sa/3.0/",
            ),
        ),
        (
            "CC0",
            Licence(
                "CC0 1.0: public domain dedication", "https://creativecommons.org/publicdomain/zero/1.0/"
            ),
        ),
        ("odbl-1.0", Licence("Open Database License 1.0", "https://spdx.org/licenses/ODbL-1.0.html")),
        ("https://a.org/terms", Licence("https://a.org/terms", "https://a.org/terms")),
        ("javascript:alert(1)", Licence("javascript:alert(1)")),
        ("for\n teaching only", Licence("for teaching only")),
        (" ", None),
    ],
)
def test_licences_are_known_by_identifier_address_or_words(text, licence):
    assert find_licence(text) == licence
