"""Chunks come out as they went in."""

from __future__ import annotations

import numpy as np
import pytest
from packed_chunks import read_letters, read_script, unpack

from shapeviz_report.writing.packing import chunk_script, pack

COLUMNS = {
    "title": "Äpfel \U0001f34e </script>",
    "columns": [
        {"of": np.array([3, 0, 65535], np.uint16), "names": ["a"]},
        {"of": np.array([-1, 7], np.int32), "numbers": np.array([0.1, np.nan, -1e300])},
    ],
    "none": np.empty(0, np.uint8),
}


@pytest.mark.parametrize(
    ("value", "kind"), [(b"\0\xff", "bytes"), ({"a": [1, None, "ü"]}, "json"), ([], "json")]
)
def test_what_has_no_arrays_is_itself(value, kind):
    packed = pack(value)
    assert packed[0] == kind
    assert unpack(*packed) == value


def test_arrays_come_back_where_they_were_and_of_their_type():
    kind, packed = pack(COLUMNS)
    value = unpack(kind, packed)
    assert kind == "columns"
    assert value["title"] == COLUMNS["title"]
    for found, expected in zip(
        [value["none"], value["columns"][0]["of"], *value["columns"][1].values()],
        [COLUMNS["none"], COLUMNS["columns"][0]["of"], *COLUMNS["columns"][1].values()],
    ):
        assert found.dtype == expected.dtype
        np.testing.assert_array_equal(found, expected)


def test_what_is_compressed_already_is_stored():
    kind, packed = pack(COLUMNS, compressed=False)
    assert kind == "stored"
    np.testing.assert_array_equal(unpack(kind, packed)["columns"][0]["of"], COLUMNS["columns"][0]["of"])


def test_the_same_data_are_the_same_bytes():
    assert pack(COLUMNS) == pack(COLUMNS)


@pytest.mark.parametrize(
    ("value", "said"),
    [({"a": float("nan")}, "JSON"), ({"a": np.array([np.inf])}, "an infinity in the array at")],
)
def test_what_json_has_no_word_for_is_an_error(value, said):
    with pytest.raises(ValueError, match=said):
        pack(value)


def test_a_script_hands_it_over(tmp_path):
    script = tmp_path / "chunk.js"
    script.write_bytes(chunk_script("parts-3", *pack({"a": 1})))
    assert read_script(script) == ("parts-3", {"a": 1})


@pytest.mark.parametrize("length", [*range(33), 59, 60, 61])
def test_fifteen_bits_are_a_letter(length):
    content = bytes((7 + 77 * place) % 256 for place in range(length))
    text = chunk_script("a", "stored", content).decode("utf-16")
    letters = text.removeprefix(f'shapeviz.receive("a", "stored", {length}, () => {{/*').removesuffix(
        "*/});\n"
    )
    assert read_letters(letters, length) == content
    assert all(0x100 <= ord(letter) < 0x8100 for letter in letters)


def test_a_letter_is_a_number_of_two_bytes_and_the_last_of_sixteen_has_the_highest_bits():
    script = chunk_script("a", "bytes", b"\1\0\2\xff")
    letters = "\u0101\u8002" + 13 * "\u0100" + "\u0102"
    assert script.decode("utf-16") == f'shapeviz.receive("a", "bytes", 4, () => {{/*{letters}*/}});\n'
    assert script.startswith(b"\xff\xfe")
