# SPDX-License-Identifier: Apache-2.0
"""Rendering: one image, one volume, or many frames."""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Union

import numpy.typing as npt

from . import _native
from ._arguments import choice, flag, function, instance, items, number, paths, text, whole
from ._arguments import size as checked_size
from ._colors import voxel_bytes
from ._devices import Devices, opened
from ._native import Device, Image, Scene, Volume
from ._scenes import SceneLike, scene as make_scene

#: Gets the share of a call that is done, 0..1, and the frame that made progress.
Progress = Callable[[float, int], object]
#: Gets the kind of a probable mistake, its place, and what to do about it.
Warn = Callable[[str, str, str], object]
#: Gets a frame's number, and its image and volume if they were asked for.
Deliver = Callable[[int, Union[Image, None], Union[Volume, None]], object]

Channel = Literal["color", "depth", "position", "normal", "object", "distance", "materialId",
                  "CryptoObject", "CryptoMaterial", "albedo", "direct", "indirect", "shadow",
                  "lights", "motion", "samples", "noise", "variance"]
ALL_CHANNELS: tuple[Channel, ...] = ("color", "depth", "position", "normal", "object")


def _options(channels: Any, progress: Any, warn: Any, strict: Any, cache: Any) -> _native.Options:
    """What a call takes besides scene, frames and devices."""
    names = [channels] if isinstance(channels, str) else items("channels", channels,
                                                              "a list of names")
    return _native.Options([text(f"channels[{i}]", name) for i, name in enumerate(names)],
                           function("progress", progress), function("warn", warn),
                           flag("strict", strict), flag("cache", cache))


def render(scene: SceneLike, *, frame: int = 1, devices: Devices = None,
           channels: Channel | Sequence[Channel] = ALL_CHANNELS,
           size: tuple[int, int] | None = None, samples: int | None = None,
           light: str | None = None, progress: Progress | None = None, warn: Warn | None = None,
           strict: bool = False, cache: bool = True) -> Image:
    """Renders the image of a frame.

    `scene` is what `voxelume.scene` takes. Several devices share the image, and its bits are the
    same. `progress(done, frame)` and `warn(kind, where, text)` are called meanwhile; an exception
    of theirs ends the call, and so does Ctrl-C, within about a tile. With `strict`, warnings are
    errors. Without `cache`, nothing but kernels is kept on disk. Other threads of Python run on.

    Raises Error.
    """
    made = make_scene(scene, size=size, samples=samples, light=light)
    options = _options(channels, progress, warn, strict, cache)
    return _native.render_image(made, opened(devices), whole("frame", frame, 1), options)


def render_volume(scene: SceneLike, *, frame: int = 1, devices: Devices = None,
                  progress: Progress | None = None, warn: Warn | None = None,
                  strict: bool = False, cache: bool = True) -> Volume:
    """Renders the volumetric image of what the scene's display shows; otherwise as `render`."""
    options = _options(ALL_CHANNELS, progress, warn, strict, cache)
    made = make_scene(scene)
    return _native.render_volume(made, opened(devices), whole("frame", frame, 1), options)


def render_frames(scene: SceneLike, frames: Iterable[int] | None = None, *,
                  images: str | os.PathLike[str] | Iterable[str | os.PathLike[str]] = (),
                  volumes: str | os.PathLike[str] | Iterable[str | os.PathLike[str]] = (),
                  deliver: Deliver | None = None, wants: Literal["images", "volumes",
                                                                 "both"] = "images",
                  devices: Devices = None, channels: Channel | Sequence[Channel] = ALL_CHANNELS,
                  progress: Progress | None = None, warn: Warn | None = None,
                  strict: bool = False, cache: bool = True) -> dict[str, Any]:
    """Renders frames, all of the scene's animation if none are given, and returns statistics.

    `images` and `volumes` are files to write, "walk.####.png", with # for each digit of the frame.
    `deliver(frame, image, volume)` has each frame in memory, in order; `wants` says which of the
    two is rendered for it. A frame costs what its changes cost.
    """
    made = make_scene(scene)
    given = range(1, made.frames + 1) if frames is None else items("frames", frames, "a list")
    numbers = [whole(f"frames[{i}]", frame, 1) for i, frame in enumerate(given)]
    choice("wants", wants, ("images", "volumes", "both"))
    options = _options(channels, progress, warn, strict, cache)
    statistics = _native.render_frames(
        made, opened(devices), numbers, paths("images", images), paths("volumes", volumes),
        function("deliver", deliver), deliver is not None and wants != "volumes",
        deliver is not None and wants != "images", options)
    result: dict[str, Any] = json.loads(statistics)
    return result


def plan(scene: SceneLike, device: Device | None = None) -> dict[str, Any]:
    """What rendering a scene takes of a device, and whether it fits, before memory is taken."""
    if device is not None:
        instance("device", device, Device)
    return _native.plan(make_scene(scene), device or opened(None)[0])


def scene_of_voxels(array: npt.ArrayLike, *, colors: Any = None, threshold: float | None = None,
                    up: Literal["y", "z"] = "z", size: tuple[int, int] = (640, 480),
                    samples: int = 4, longitude: float = 35, latitude: float = 25,
                    parallel: bool = False, ground: bool = True,
                    background: Sequence[float] | None = None) -> Scene:
    """The scene that `voxels` renders."""
    choice("up", up, ("y", "z"))
    studio: dict[str, Any] = {
        "size": checked_size("size", size), "longitude": number("longitude", longitude, 360),
        "latitude": number("latitude", latitude, 90), "parallel": flag("parallel", parallel),
        "ground": flag("ground", ground)}
    if background is not None:
        each = items("background", background, "three numbers R, G, B", 3)
        studio["background"] = [number(f"background[{i}]", x) for i, x in enumerate(each)]
    rays = whole("samples", samples, 1, 4096)
    codes = voxel_bytes(array, colors, threshold)
    if up == "z":
        # (x, y, z) becomes (x, z, -y): the array stays in place, only its strides change.
        codes = codes.transpose(0, 2, 1, 3)[:, :, ::-1]
    return _native.scene_of_voxels(codes, studio).with_samples(rays)


def voxels(array: npt.ArrayLike, *, colors: Any = None, threshold: float | None = None,
           up: Literal["y", "z"] = "z", size: tuple[int, int] = (640, 480), samples: int = 4,
           longitude: float = 35, latitude: float = 25, parallel: bool = False,
           ground: bool = True, background: Sequence[float] | None = None,
           light: str | None = None, devices: Devices = None,
           progress: Progress | None = None) -> Image:
    """Draws an array of voxels; notebooks show the image that it returns.

    `array` is one of these:

    - (x, y, z) of bools: the voxels that are there.
    - (x, y, z) of numbers: those above `threshold`, which is 0 unless given.
    - (x, y, z, 3): R, G, B of each voxel; black ones are not there.
    - (x, y, z, 4): R, G, B and the opacity; 0: not there.

    Voxels of which a numpy mask hides a value are not there. Colours are sRGB: bytes, or floats of
    0..1. `colors` gives voxels (x, y, z) theirs: one colour, or (x, y, z, 3 or 4). `up` is the axis
    that points up, "z" as in most plots, or "y". The observer stands `longitude` degrees to the
    right of the front, which is -y for "z" and +z for "y", and `latitude` degrees above the
    horizon; `parallel` gives isometric pictures.
    """
    made = scene_of_voxels(array, colors=colors, threshold=threshold, up=up, size=size,
                           samples=samples, longitude=longitude, latitude=latitude,
                           parallel=parallel, ground=ground, background=background)
    return render(made, channels=("color",), light=light, devices=devices, progress=progress)
