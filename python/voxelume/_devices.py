# SPDX-License-Identifier: Apache-2.0
"""Devices that render."""
from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any, Union

from . import _native
from ._arguments import items, shown, whole
from ._errors import Error
from ._native import Device

#: Devices that render: those of `open_devices`, one of them, or its selector.
Devices = Union[Sequence[Device], Device, str, int, None]

_usual_devices: list[Device] = []
_usual_devices_lock = threading.Lock()


def open_devices(selector: str | int = "") -> list[Device]:
    """Opens devices: "auto", "cpu", "gpu", an index of `list_devices`, a part of a name, or "all".

    Without a selector the variable VOXELUME_DEVICE decides, or else "auto". Raises Error of the
    kind "device" if nothing fits.
    """
    if not isinstance(selector, str):
        selector = str(whole("selector", selector, 0))
    return _native.open_devices(selector)


def limit_memory(bytes: int) -> None:
    """Has what follows take at most so much main memory, and at most as much of a device's own.

    What needs more raises Error. 0: as much as there is.
    """
    _native.limit_memory(whole("bytes", bytes, 0, 2**63))


def opened(devices: Any) -> list[Device]:
    """The devices of a call's argument."""
    if isinstance(devices, Device):
        return [devices]
    if isinstance(devices, (str, int)):
        return open_devices(devices)
    if devices is not None:
        chosen = items("devices", devices, "an open device, several, or a selector")
        for i, device in enumerate(chosen):
            if not isinstance(device, Device):
                raise Error(f"devices[{i}] is one of open_devices(), not {shown(device)}")
        if not chosen:
            raise Error("devices has none: leave it out for the usual ones")
        return chosen
    # These devices are kept open, because a device has its kernels ready the second time.
    with _usual_devices_lock:
        if not _usual_devices:
            _usual_devices.extend(_native.open_devices())
        return list(_usual_devices)
