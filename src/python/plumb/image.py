# SPDX-License-Identifier: MIT
"""Images as numpy arrays."""

import struct
import tempfile
from pathlib import Path

import numpy as np

from .errors import Diagnostic, Error
from .program import run


class Image:
    """Channels of 32-bit floats, linear light, the top row first.

    channels: by their names, each of shape (height, width): "R", "variance.R", "normal.X", ...
    header:   what the file's header says, by name
    report:   of a rendering: the program's JSON; else None
    """

    def __init__(self, channels, header=None, report=None):
        self.channels = {name: np.asarray(values, dtype=np.float32) for name, values in channels.items()}
        self.header = dict(header or {})
        self.report = report

    @property
    def pixels(self):
        """The colours, of shape (height, width, 3); of an image in luminance (height, width)."""
        if "R" in self.channels:
            return np.stack([self.channels[name] for name in ("R", "G", "B")], axis=-1)
        return self.channels["Y"]

    @property
    def variance(self):
        """The variance of each pixel's mean, as `pixels`; None where it is not known."""
        if "variance.R" in self.channels:
            return np.stack([self.channels[f"variance.{name}"] for name in "RGB"], axis=-1)
        return self.channels.get("variance.Y")

    def layer(self, name):
        """The channels NAME.*, by what stands behind the dot."""
        return {key[len(name) + 1:]: values for key, values in self.channels.items() if key.startswith(name + ".")}

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.pixels, dtype=dtype)

    def __repr__(self):
        height, width = next(iter(self.channels.values())).shape[:2]
        return f"<plumb.Image {width}x{height}: {', '.join(self.channels)}>"


def read(path):
    """Any image file that the program reads, with all its channels."""
    with tempfile.TemporaryDirectory(prefix="plumb-") as directory:
        file = Path(directory) / "pixels.npy"
        _, report, _ = run(["info", path, "--pixels", file])
        values = np.load(file, allow_pickle=False)
    return Image({name: values[:, :, i] for i, name in enumerate(report["channels"])}, report["header"])


def as_image(value):
    """An Image, or an array of shape (height, width) or (height, width, 1, 3 or 4); of the last, alpha is left out."""
    if isinstance(value, Image):
        return value
    array = np.asarray(value)
    if array.dtype == np.uint8:
        raise Error([Diagnostic("an array of 8-bit values has no linear light",
                                suggestion="pass floats, or the file that it was read from")])
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[:, :, 0]
    if array.ndim == 2 and array.size:
        return Image({"Y": array})
    if array.ndim == 3 and array.shape[2] in (3, 4) and array.size:
        return Image({name: array[:, :, i] for i, name in enumerate("RGB")})
    raise Error([Diagnostic(f"an array of shape {array.shape} is not an image",
                            suggestion="pass (height, width) or (height, width, 3)")])


def write(path, image):
    """Writes an .exr file of 32-bit floats without compression, with all channels; of the header, only texts and numbers."""
    image = as_image(image)
    names = sorted(image.channels)  # the order that OpenEXR wants
    height, width = image.channels[names[0]].shape
    if any(image.channels[name].shape != (height, width) for name in names):
        raise Error([Diagnostic("the channels have different sizes")])

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names) + b"\0"
    header = attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    for name, value in image.header.items():
        if not name.startswith("plumb:") and name != "Software":
            continue
        if isinstance(value, str):
            header += attribute(name, "string", value.encode())
        elif isinstance(value, int):
            header += attribute(name, "int", struct.pack("<i", value))
        elif isinstance(value, float):
            header += attribute(name, "float", struct.pack("<f", value))
    # Magic number, version 2; the flag of names longer than 31 bytes.
    start = struct.pack("<ii", 20000630, 2 | 0x400) + header + b"\0"
    row_size = 4 * width * len(names)
    offsets = [len(start) + 8 * height + y * (8 + row_size) for y in range(height)]
    planes = np.stack([image.channels[name] for name in names], axis=1).astype("<f4")  # row, channel, column
    with open(path, "wb") as file:
        file.write(start + struct.pack(f"<{height}Q", *offsets))
        for y in range(height):
            file.write(struct.pack("<ii", y, row_size) + planes[y].tobytes())
