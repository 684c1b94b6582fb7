# SPDX-License-Identifier: Apache-2.0
"""Arrays of voxels in all their forms -> bytes R, G, B and opacity."""
from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arguments import number
from ._errors import Error

#: The colour of voxels without one, sRGB.
PLAIN = (219, 217, 214)

#: The maximum number of voxels along an axis, and in total, for arrays that are turned into bytes.
MAX_ALONG = 2**16
MAX_VOXELS = 2**36


def _array(name: str, values: Any) -> tuple[npt.NDArray[Any], npt.NDArray[np.bool_] | None]:
    """Numbers in the machine's order of bytes, and which of them a mask hides, if any."""
    try:
        array = np.ma.asarray(values) if np.ma.isMaskedArray(values) else np.asarray(values)
    except (TypeError, ValueError) as error:
        raise Error(f"{name} are no array: {error}") from None
    if array.dtype.kind not in "biuf":
        raise Error(f"{name} are numbers or bools, not {array.dtype}")
    mask = np.ma.getmaskarray(array) if np.ma.is_masked(array) else None
    plain = np.ma.getdata(array)
    return plain.astype(plain.dtype.newbyteorder("="), copy=False), mask


def _codes(values: npt.NDArray[Any]) -> npt.NDArray[np.uint8]:
    """Values 0..255 of integers, 0..65535 of uint16, 0..1 of floats and bools, as bytes."""
    if values.dtype == np.uint8:
        return values
    if values.dtype == bool:
        return values.astype(np.uint8) * np.uint8(255)
    if values.dtype.kind == "f":
        clean = np.nan_to_num(values, nan=0.0)
        return np.asarray(np.rint(np.clip(clean, 0, 1) * 255), np.uint8)
    if values.dtype == np.uint16:
        return np.asarray(np.rint(values / 257), np.uint8)
    if values.size > 0 and (values.min() < 0 or values.max() > 255):
        raise Error(f"colours of {values.dtype} go from 0 to 255, and these from "
                    f"{values.min()} to {values.max()}; save them as uint8, uint16 or floats")
    return np.asarray(values, np.uint8)


def _is_there(array: npt.NDArray[Any], threshold: float | None) -> npt.NDArray[np.bool_]:
    if array.dtype == bool and threshold is None:
        return array
    limit = 0.0 if threshold is None else number("threshold", threshold)
    return np.asarray(array > limit)


def _without(filled: npt.NDArray[np.bool_],
             mask: npt.NDArray[np.bool_] | None) -> npt.NDArray[np.bool_]:
    """The voxels that are there and of which no value is masked."""
    if mask is None:
        return filled
    return filled & ~(mask.any(axis=-1) if mask.ndim == filled.ndim + 1 else mask)


def _painted(filled: npt.NDArray[np.bool_], colors: Any) -> npt.NDArray[np.uint8]:
    """The voxels that are there, in one colour or in that of each voxel."""
    given, mask = _array("colours", PLAIN if colors is None else colors)
    if given.ndim == 0 or given.shape[-1] not in (3, 4):
        raise Error(f"colours are (..., 3) or (..., 4), not {given.shape}")
    if given.ndim > 1 and given.shape[:-1] != filled.shape:
        raise Error(f"colours of {given.shape[:-1]} don't fit voxels of {filled.shape}")
    codes = _codes(np.asarray(given, np.uint8) if colors is None else given)
    there = _without(filled, mask) if given.ndim > 1 else filled & (mask is None)
    result = np.zeros((*filled.shape, 4), np.uint8)
    result[..., :3] = codes[..., :3]
    result[..., 3] = np.where(there, codes[..., 3] if codes.shape[-1] == 4 else np.uint8(255), 0)
    return result


def _check_extent(shape: tuple[int, ...]) -> None:
    """Refuses what the library can't hold before memory is taken for its bytes."""
    if max(shape) > MAX_ALONG or math.prod(shape) > MAX_VOXELS:
        raise Error(f"an array of {' x '.join(map(str, shape))} voxels is too large: at most "
                    f"{MAX_ALONG} are possible along each axis, and {MAX_VOXELS} in all",
                    kind="limit")


def voxel_bytes(array: npt.ArrayLike, colors: Any = None,
                threshold: float | None = None) -> npt.NDArray[np.uint8]:
    """An array of voxels as (x, y, z, 4) bytes: sRGB and opacity; opacity 0: no voxel.

    Bytes of that shape are used where they lie. See `voxelume.voxels` for the other forms.
    """
    voxels, mask = _array("voxels", array)
    if voxels.ndim not in (3, 4) or voxels.ndim == 4 and voxels.shape[3] not in (3, 4):
        raise Error("voxels are an array (x, y, z), (x, y, z, 3) or (x, y, z, 4), "
                    f"not {voxels.shape}")
    _check_extent(voxels.shape[:3])
    if voxels.ndim == 3:
        return _painted(_without(_is_there(voxels, threshold), mask), colors)
    if colors is not None:
        raise Error(f"voxels of {voxels.shape} have colours of their own; leave `colors` out")
    if threshold is not None:
        raise Error(f"a threshold is for voxels (x, y, z), not for {voxels.shape}")
    if voxels.shape[3] == 3:
        there = np.asarray((voxels != 0).any(axis=3))
        return _painted(_without(there, mask), voxels)
    codes = _codes(voxels)
    if mask is not None:
        codes = codes.copy()
        codes[mask.any(axis=3)] = 0
    return codes if codes.strides[3] == 1 else np.ascontiguousarray(codes)
