"""One device, or several that share each batch through Lightning Fabric."""

from __future__ import annotations

import os
from types import TracebackType
from typing import TYPE_CHECKING

import torch
from torch import Tensor, nn

from planformer.errors import InvalidParameter, MissingExtra
from planformer.training.config import TrainConfig

if TYPE_CHECKING:
    from lightning_fabric import Fabric


def is_first_process() -> bool:
    """Whether this process is the one that reports and writes: true but for Fabric's others."""
    return int(os.environ.get("RANK", os.environ.get("LOCAL_RANK", "0"))) == 0


class Devices:
    """Context manager: where a training computes.

    Several devices take a process each. Fabric starts the others by running the program again
    with the same arguments, so each of them comes to this point by itself; under ``torchrun`` they
    exist already. What happens between the processes is here alone.

    Args:
        config: Type and number of the devices.

    Attributes:
        rank: Number of this process.
        count: Number of processes.
        device: The device of this process.

    Raises:
        InvalidParameter: A device is not usable.
        MissingExtra: Several devices are asked for and Fabric is not installed.
    """

    def __init__(self, config: TrainConfig) -> None:
        self._fabric = _launched(config) if config.devices > 1 else None
        self.rank = self._fabric.global_rank if self._fabric else 0
        self.count = self._fabric.world_size if self._fabric else 1
        self.device = self._fabric.device if self._fabric else usable_device(config.device)

    def __enter__(self) -> Devices:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._fabric and error is None:
            self._fabric.barrier()  # a process that ends early would take the others with it
            # The last reference to the group has to be this one: dropped with a shared model, the
            # group would wait, holding the interpreter's lock, for a thread that waits for that.
            torch.distributed.destroy_process_group()

    @property
    def is_first(self) -> bool:
        """Whether this process validates, reports and writes."""
        return self.rank == 0

    def synchronised(self, model: nn.Module) -> nn.Module:
        """The model with gradients that are averaged over the devices."""
        return self._fabric.setup_module(model, move_to_device=False) if self._fabric else model

    def mean(self, *values: float) -> list[float]:
        """Means over the devices, the same numbers on each."""
        if self._fabric is None:
            return list(values)
        own = torch.tensor(values, dtype=torch.float64, device=self.device)
        return self.mean_tensor(own).tolist()

    def mean_tensor(self, own: Tensor) -> Tensor:
        """The mean of a tensor over the devices, the same on each; it has no gradient.

        Args:
            own: This process's tensor of floats, which is overwritten.
        """
        if self._fabric is None:
            return own
        mean = self._fabric.all_reduce(own, reduce_op="mean")
        assert isinstance(mean, Tensor)
        return mean


def _launched(config: TrainConfig) -> Fabric:
    """Start the other processes; each of them returns here as well."""
    try:
        from lightning_fabric import Fabric
    except ImportError as error:
        raise MissingExtra("lightning-fabric (for several devices)", "train") from error
    device = usable_device(config.device)
    if device.index is not None or device.type not in ("cpu", "cuda"):
        raise InvalidParameter(f"several devices must be 'cpu' or 'cuda'; got {config.device!r}")
    if device.type == "cuda" and config.devices > torch.cuda.device_count():
        raise InvalidParameter(
            f"devices must be <= {torch.cuda.device_count()} on this machine; got {config.devices}"
        )
    fabric = Fabric(accelerator=device.type, devices=config.devices, strategy="ddp")
    fabric.launch()
    return fabric


def usable_device(name: str) -> torch.device:
    """A device by its name.

    Raises:
        InvalidParameter: PyTorch cannot compute on it here.
    """
    try:
        torch.empty(0, device=name)
    except (RuntimeError, AssertionError) as error:
        raise InvalidParameter(f"device {name!r} is not usable: {error}") from error
    return torch.device(name)
