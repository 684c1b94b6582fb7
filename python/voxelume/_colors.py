# SPDX-License-Identifier: Apache-2.0
"""Arrays of voxels in all their forms -> bytes R, G, B and opacity."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import Error

#: The colour of voxels without one, sRGB.
PLAIN = (219, 217, 214)


def _codes(values: npt.NDArray[Any]) -> npt.NDArray[np.uint8]:
    """Values 0..255 of integers, 0..65535 of uint16, 0..1 of floats and bools, as bytes."""
    if values.dtype == np.uint8:
        return values
    if values.dtype == bool:
        return values.astype(np.uint8) * np.uint8(255)
    if np.issubdtype(values.dtype, np.floating):
        clean = np.nan_to_num(values, nan=0.0)
        return np.asarray(np.rint(np.clip(clean, 0, 1) * 255), np.uint8)
    if values.dtype == np.uint16:
        return np.asarray(np.rint(values / 257), np.uint8)
    if np.issubdtype(values.dtype, np.integer):
        if values.size > 0 and (values.min() < 0 or values.max() > 255):
            raise Error(f"colours of {values.dtype} go from 0 to 255, and these from "
                        f"{values.min()} to {values.max()}; save them as uint8, uint16 or floats")
        return np.asarray(values, np.uint8)
    raise Error(f"voxels are numbers or bools, not {values.dtype}")


def _is_there(array: npt.NDArray[Any], threshold: float | None) -> npt.NDArray[np.bool_]:
    if array.dtype == bool:
        return array
    if not (np.issubdtype(array.dtype, np.number)):
        raise Error(f"voxels are numbers or bools, not {array.dtype}")
    limit = 0.0 if threshold is None else threshold
    return np.asarray(array > limit)


def _painted(filled: npt.NDArray[np.bool_], colors: Any) -> npt.NDArray[np.uint8]:
    """The voxels that are there, in one colour or in that of each voxel."""
    result = np.zeros((*filled.shape, 4), np.uint8)
    result[..., 3] = filled
    result[..., 3] *= np.uint8(255)
    given = np.asarray(PLAIN, np.uint8) if colors is None else np.asarray(colors)
    if given.ndim == 0 or given.shape[-1] not in (3, 4):
        raise Error(f"colours are (..., 3) or (..., 4), not {given.shape}")
    if given.ndim > 1 and given.shape[:-1] != filled.shape:
        raise Error(f"colours of {given.shape[:-1]} don't fit voxels of {filled.shape}")
    codes = _codes(given)
    result[..., :3] = codes[..., :3]
    if codes.shape[-1] == 4:
        result[..., 3] = np.where(filled, codes[..., 3], 0)
    return result


def voxel_bytes(array: npt.ArrayLike, colors: Any = None,
                threshold: float | None = None) -> npt.NDArray[np.uint8]:
    """An array of voxels as (x, y, z, 4) bytes: sRGB and opacity; opacity 0: no voxel.

    Bytes of that shape are used where they lie. See `voxelume.voxels` for the other forms.
    """
    voxels = np.asarray(array)
    if voxels.ndim == 3:
        return _painted(_is_there(voxels, threshold), colors)
    if voxels.ndim != 4 or voxels.shape[3] not in (3, 4):
        raise Error("voxels are an array (x, y, z), (x, y, z, 3) or (x, y, z, 4), "
                    f"not {voxels.shape}")
    if colors is not None:
        raise Error(f"voxels of {voxels.shape} have colours of their own; leave `colors` out")
    if threshold is not None:
        raise Error(f"a threshold is for voxels (x, y, z), not for {voxels.shape}")
    if voxels.shape[3] == 3:
        return _painted(np.asarray((voxels != 0).any(axis=3)), voxels)
    codes = _codes(voxels)
    return codes if codes.strides[3] == 1 else np.ascontiguousarray(codes)
