"""What a reader sees of an element, as pixels."""

import io
import time

import numpy as np
from PIL import Image
from playwright.sync_api import Error, Page


def pixels_of(page: Page, selector: str, seconds: float = 30) -> np.ndarray:
    """The colours of the element on the screen, integers from 0 to 255; (h, w, 3).

    A page may draw the element anew while its picture is taken, and the one that was found is gone: then the new
    one is taken.
    """
    end = time.monotonic() + seconds
    while True:
        try:
            picture = page.locator(selector).screenshot()
        except Error as error:
            if "not attached" not in error.message or time.monotonic() > end:
                raise
        else:
            return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)
