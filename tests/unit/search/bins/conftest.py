"""What the tests of the search for bins share."""

from __future__ import annotations

import pytest
from planted_bins import Planted, plant


@pytest.fixture(scope="session")
def planted() -> Planted:
    return plant()
