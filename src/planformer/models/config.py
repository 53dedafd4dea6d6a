"""Configurations of the region proposal networks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, TypeAlias, TypeVar

from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.errors import InvalidParameter


@dataclass(frozen=True)
class TransformerBody:
    """The paper's network: convolutions to one token per metre, then a transformer encoder.

    Motion Planning Transformers (Johnson et al.), section III.A; the numbers that the
    paper leaves open are those of its published experiments.

    Attributes:
        width: Dimension d of a token.
        layers: Encoder layers.
        heads: Attention heads.
        key_width: Dimension of a head's queries and keys.
        value_width: Dimension of a head's values.
        feed_forward: Hidden width of the MLP.
        dropout: Probability of dropout.
        table: Side H_max in tokens of the table of position encodings.
        shift_positions: Shift the position encoding at random in training; otherwise it is fixed.
        checkpointing: Recompute attention in the backward pass to save memory.

    Raises:
        InvalidParameter: A value is out of range.
    """

    width: int = 512
    layers: int = 6
    heads: int = 3
    key_width: int = 512
    value_width: int = 256
    feed_forward: int = 1024
    dropout: float = 0.1
    table: int = 40
    shift_positions: bool = True
    checkpointing: bool = False

    def __post_init__(self) -> None:
        _require_positive(self, "layers heads key_width value_width feed_forward table")
        if self.width < 2 or self.width % 2:
            raise InvalidParameter(f"width must be even and >= 2; got {self.width}")
        if not 0 <= self.dropout < 1:
            raise InvalidParameter(f"dropout must be in [0, 1); got {self.dropout}")


@dataclass(frozen=True)
class CompactBody:
    """A network for a CPU: convolutions mix neighbours, and attention, if any, mixes the rest.

    Attributes:
        width: Dimension of a token.
        stem: Channels before the tokens, at half the query's resolution.
        blocks: Convolution blocks.
        heads: Attention heads of one block in the middle; 0 for none.
        expansion: Hidden width of an MLP over `width`.
        window: Side in tokens of the windows that attention is confined to. A map of this size is
            one window; beyond it the cost grows with the area, not with its square.

    Raises:
        InvalidParameter: A value is out of range.
    """

    width: int = 96
    stem: int = 32
    blocks: int = 6
    heads: int = 0
    expansion: int = 2
    window: int = 24

    def __post_init__(self) -> None:
        _require_positive(self, "width stem blocks expansion window")
        if self.heads < 0:
            raise InvalidParameter(f"heads must be >= 0; got {self.heads}")
        if self.heads and self.width % (4 * self.heads):
            raise InvalidParameter(
                "width must be a multiple of 4 * heads, for rotary positions along two axes; got "
                f"{self.width} for {self.heads} heads"
            )


@dataclass(frozen=True)
class UNetBody:
    """The paper's baseline: a U-Net that classifies each pixel.

    Attributes:
        widths: Channels at each resolution, from the map's own to the coarsest.

    Raises:
        InvalidParameter: There are fewer than two widths, or one is not positive.
    """

    widths: tuple[int, ...] = (32, 64, 128, 256, 256)

    def __post_init__(self) -> None:
        object.__setattr__(self, "widths", tuple(self.widths))
        if len(self.widths) < 2 or min(self.widths) < 1:
            raise InvalidParameter(f"widths must be two or more, each >= 1; got {self.widths}")


Body: TypeAlias = TransformerBody | CompactBody | UNetBody

_BODIES: dict[str, type[Body]] = {
    "transformer": TransformerBody,
    "compact": CompactBody,
    "unet": UNetBody,
}


@dataclass(frozen=True)
class MPTConfig:
    """A region proposal network: what it sees and what it is made of.

    Attributes:
        body: The architecture and its sizes.
        query: How start and goal are encoded: "wavefront" or "markers" for a `CompactBody`, else
            "square".
        headings: Whether the network takes and predicts headings (SE(2)).
        offsets: Whether it predicts the way from each anchor to the path; only a `CompactBody`.

    Raises:
        InvalidParameter: The query, the headings or the offsets do not fit the body.
    """

    body: Body = field(default_factory=CompactBody)
    query: QueryKind = QueryKind.WAVEFRONT
    headings: bool = False
    offsets: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "query", self.scale.query)
        if isinstance(self.body, CompactBody) == (self.query is QueryKind.SQUARE):
            raise InvalidParameter(
                "a compact body takes the query 'wavefront' or 'markers', any other 'square'; got "
                f"{type(self.body).__name__} with {self.query.value!r}"
            )
        if self.offsets and not isinstance(self.body, CompactBody):
            raise InvalidParameter("only a compact body predicts offsets")
        if self.headings and isinstance(self.body, UNetBody):
            raise InvalidParameter("a U-Net predicts no headings")

    @property
    def scale(self) -> NetworkScale:
        """The geometry of the network's input and output."""
        if isinstance(self.body, UNetBody):  # an anchor in each pixel's corner
            return NetworkScale(
                stride=1, patch=2, anchor_offset=0, query=self.query, query_stride=1
            )
        transformer = isinstance(self.body, TransformerBody)
        return NetworkScale(
            anchor_offset=4 if transformer else 10,  # the centre of what a token's patch sees
            query=self.query,
            query_stride=1 if transformer else 5,
            headings=self.headings,
            offsets=self.offsets,
        )

    def to_dict(self) -> dict[str, Any]:
        """The configuration as JSON-compatible values."""
        name = next(name for name, body in _BODIES.items() if isinstance(self.body, body))
        body = {"architecture": name, **asdict(self.body)}
        return {
            "body": body,
            "query": self.query.value,
            "headings": self.headings,
            "offsets": self.offsets,
        }

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> MPTConfig:
        """The inverse of `to_dict`.

        Raises:
            InvalidParameter: A key is unknown or a value out of range.
        """
        values = dict(values)
        body = dict(values.pop("body", {}))
        name = body.pop("architecture", None)
        if name not in _BODIES:
            raise InvalidParameter(f"architecture must be one of {list(_BODIES)}; got {name!r}")
        return _from_known(cls, {**values, "body": _from_known(_BODIES[name], body)})


_T = TypeVar("_T")


def _from_known(cls: type[_T], values: Mapping[str, Any]) -> _T:
    """Build a dataclass, refusing keys that it does not have."""
    known = [f.name for f in fields(cls)]  # type: ignore[arg-type]  # always a dataclass here
    if unknown := sorted(set(values) - set(known)):
        raise InvalidParameter(f"unknown configuration keys {unknown}; valid are {known}")
    return cls(**values)


def _require_positive(config: object, names: str) -> None:
    for name in names.split():
        if getattr(config, name) < 1:
            raise InvalidParameter(f"{name} must be >= 1; got {getattr(config, name)}")


_PAPER = TransformerBody()
_PAPER_SMALL = TransformerBody(width=128, layers=3, key_width=64, value_width=64, feed_forward=256)

PRESETS: dict[str, MPTConfig] = {
    "paper": MPTConfig(_PAPER, QueryKind.SQUARE),
    "paper-fixed-encoding": MPTConfig(replace(_PAPER, shift_positions=False), QueryKind.SQUARE),
    "paper-small": MPTConfig(_PAPER_SMALL, QueryKind.SQUARE),
    "paper-small-fixed-encoding": MPTConfig(
        replace(_PAPER_SMALL, shift_positions=False), QueryKind.SQUARE
    ),
    "small": MPTConfig(CompactBody(width=64, stem=24, blocks=5), offsets=True),
    "tiny": MPTConfig(CompactBody(width=32, stem=16, blocks=3), offsets=True),
    "unet": MPTConfig(UNetBody(), QueryKind.SQUARE),
    "unet-small": MPTConfig(UNetBody((16, 32, 64, 128, 128)), QueryKind.SQUARE),
    "dubins": MPTConfig(headings=True, offsets=True),
}


def preset(name: str) -> MPTConfig:
    """A configuration by name.

    Raises:
        InvalidParameter: No preset has this name; the message lists them.
    """
    if name not in PRESETS:
        raise InvalidParameter(f"preset must be one of {list(PRESETS)}; got {name!r}")
    return PRESETS[name]
