"""saved -- the arrays of a saved mapping, without packages."""

import array
import json

TYPES = {"F64": "d", "I64": "q", "F32": "f", "I32": "i", "U8": "B"}


def read_all(path):
    """What the mapping says of itself, and its arrays by name."""
    data = path.read_bytes()
    begin = 8 + int.from_bytes(data[:8], "little")
    header = json.loads(data[8:begin])
    about = json.loads(header.pop("__metadata__")["osdtex"])
    arrays = {}
    for name, a in header.items():
        arrays[name] = array.array(TYPES[a["dtype"]])
        first, end = a["data_offsets"]
        arrays[name].frombytes(data[begin + first:begin + end])
    return about, arrays


def read(path):
    return read_all(path)[1]
