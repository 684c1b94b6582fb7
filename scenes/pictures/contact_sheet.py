#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders model files without a scene and lays the pictures out on one sheet, with their names.

contact_sheet.py SHEET.png FILE... needs voxelume in the path and Debian's package python3-pil. A
file that is refused has the sentence in its place.
"""
import pathlib
import subprocess
import sys
import tempfile
import textwrap

from PIL import Image, ImageDraw, ImageFont

WIDTH, HEIGHT, LABEL, COLUMNS = 224, 168, 16, 8
PAPER, INK, REFUSED = "#ffffff", "#202020", "#a02020"


def short_names(files):
    """The files' names, with as many of their folders as tell them apart."""
    names = []
    for file in files:
        parts = 1
        while sum(other.parts[-parts:] == file.parts[-parts:] for other in files) > 1:
            parts += 1
        names.append("/".join(file.parts[-parts:]))
    return names


def render(file, folder):
    """The picture of a file, or the sentence that refuses it."""
    output = pathlib.Path(folder) / "tile.png"
    command = ["voxelume", "render", str(file), "-o", str(output), "--size", f"{WIDTH}x{HEIGHT}",
               "--samples", "4", "--quiet"]
    result = subprocess.run(command, capture_output=True, text=True, errors="replace")
    if result.returncode != 0:
        sentence = result.stderr.strip().removeprefix("voxelume: ").removeprefix(str(file))
        return sentence.removeprefix(": ").removeprefix(":")
    with Image.open(output) as image:
        return image.convert("RGB")


def main():
    sheet_file, files = sys.argv[1], [pathlib.Path(name) for name in sys.argv[2:]]
    rows = -(-len(files) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * WIDTH, rows * (HEIGHT + LABEL)), PAPER)
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default()
    with tempfile.TemporaryDirectory() as folder:
        for number, (file, name) in enumerate(zip(files, short_names(files))):
            left, top = number % COLUMNS * WIDTH, number // COLUMNS * (HEIGHT + LABEL)
            tile = render(file, folder)
            if isinstance(tile, str):
                print(f"{name}: {tile}")
                lines = "\n".join(textwrap.wrap(tile, 35)[:12])
                draw.text((left + 4, top + 4), lines, REFUSED, font)
            else:
                sheet.paste(tile, (left, top))
            label = name if len(name) <= 36 else f"..{name[-34:]}"
            draw.text((left + 4, top + HEIGHT + 2), label, INK, font)
    sheet.save(sheet_file, optimize=True)


if __name__ == "__main__":
    main()
