"""Pictures as maps: decoding for all formats, and plain images without metadata."""

from __future__ import annotations

import io
import math
import struct
import warnings
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidMap, TooLarge
from planformer.maps._files import PathLike, naming, read_bytes
from planformer.maps.grid import OccupancyGrid

if TYPE_CHECKING:
    from PIL.Image import Image

IMAGE_SUFFIXES = (".bmp", ".gif", ".jpeg", ".jpg", ".pbm", ".pgm", ".png", ".ppm", ".tif", ".tiff")


@dataclass(frozen=True)
class Picture:
    """A decoded picture; row 0 is the top.

    Attributes:
        rgb_sum: (H, W) uint32, red + green + blue.
        alpha: (H, W) opacity of the same depth, None where the picture has no transparency.
        full: Value of a full channel: 255 or 65535.
    """

    rgb_sum: NDArray[np.uint32]
    alpha: NDArray[np.uint32] | None
    full: int


def read_picture(path: Path) -> Picture:
    """Decode an image file of any kind that Pillow knows.

    Raises:
        InvalidMap: The file is missing, damaged, truncated, far too large or no picture.
    """
    with naming(path):
        return decode_picture(read_bytes(path))


def decode_picture(
    data: bytes, *, formats: tuple[str, ...] | None = None, most_pixels: float = math.inf
) -> Picture:
    """Decode the content of an image file.

    Args:
        data: The file's content.
        formats: Pillow's names of the formats that may be decoded; all by default.
        most_pixels: A larger picture is refused from its header, before it takes memory.

    Raises:
        InvalidMap: The data is damaged, truncated or no picture.
        TooLarge: The picture has more pixels.
    """
    from PIL import Image

    try:
        with warnings.catch_warnings():
            # A large map is none, and there is a bound for what comes from strangers.
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            warnings.simplefilter("ignore", UserWarning)  # odd metadata of a good picture
            with Image.open(io.BytesIO(data), formats=formats) as image:
                if image.width * image.height > most_pixels:
                    raise TooLarge(
                        f"{image.width} x {image.height} pixels are more than the "
                        f"{most_pixels:,} that a map may have here"
                    )
                image.load()
                return _decode(image)
    except Image.DecompressionBombError as error:  # from 179 million pixels on
        kind = InvalidMap if math.isinf(most_pixels) else TooLarge
        raise kind(f"the image is too large: {error}") from error
    except (OSError, ValueError, SyntaxError, EOFError, IndexError, struct.error, zlib.error) as e:
        reason = "not an image that Pillow can read" if "cannot identify" in str(e) else e
        raise InvalidMap(f"the image cannot be decoded: {reason}") from e


def _decode(image: Image) -> Picture:
    if image.mode == "F":
        raise ValueError("floating-point pixels have no defined black and white")
    if image.mode.startswith("I"):  # 16 bit grey, whatever the byte order
        return Picture(3 * np.asarray(image).astype(np.uint32), None, 65535)
    has_alpha = "transparency" in image.info or image.mode in ("RGBA", "LA", "PA", "RGBa", "La")
    if not has_alpha and image.mode in ("1", "L"):
        return Picture(3 * np.asarray(image.convert("L"), dtype=np.uint32), None, 255)
    channels = np.asarray(image.convert("RGBA" if has_alpha else "RGB"))
    rgb_sum = channels[..., :3].sum(axis=2, dtype=np.uint32)
    return Picture(rgb_sum, channels[..., 3].astype(np.uint32) if has_alpha else None, 255)


def load_image_map(
    path: PathLike, *, resolution: float = 0.05, unknown_is_occupied: bool = True
) -> OccupancyGrid:
    """Load a plain picture as a map: pixels darker than 50 % grey are occupied.

    The top row of the picture gets the highest y. Pixels that are less than half opaque are
    unknown.

    Args:
        path: An image file.
        resolution: Side of a pixel in metres.
        unknown_is_occupied: Whether transparent pixels are obstacles.

    Raises:
        InvalidMap: The file or the resolution is unusable.
    """
    file = Path(path)
    picture = read_picture(file)
    with naming(file):
        return image_map(picture, resolution, unknown_is_occupied=unknown_is_occupied)


def image_map(
    picture: Picture, resolution: float, *, unknown_is_occupied: bool = True
) -> OccupancyGrid:
    """A decoded picture as a map; see `load_image_map`."""
    occupied = 2 * picture.rgb_sum < 3 * picture.full
    unknown = np.zeros_like(occupied) if picture.alpha is None else 2 * picture.alpha < picture.full
    occupied = np.where(unknown, unknown_is_occupied, occupied)
    return OccupancyGrid(occupied[::-1], resolution, unknown=unknown[::-1])


def encode_png(grid: OccupancyGrid) -> bytes:
    """A greyscale PNG of a map: occupied black, free white, the highest y on top."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(np.where(grid.occupied[::-1], 0, 255).astype(np.uint8)).save(buffer, "PNG")
    return buffer.getvalue()
