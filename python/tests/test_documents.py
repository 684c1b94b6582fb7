# SPDX-License-Identifier: Apache-2.0
"""The Python of the pages runs as it stands there."""
import re
from pathlib import Path

import voxelume

SOURCE = Path(__file__).resolve().parents[2]


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```$", (SOURCE / page).read_text(), re.M | re.S)


def test_the_page_has_ten_lines_from_an_array_to_a_picture(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = "python/README.md"
    [code] = blocks(page)
    assert len(code.splitlines()) <= 10
    exec(compile(code, page, "exec"), {})
    [file] = tmp_path.glob("*.png")
    picture = voxelume.Image.read(file)
    assert (picture.width, picture.height) == (640, 480)


def test_the_packages_own_example_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = "".join(line[4:] + "\n" for line in voxelume.__doc__.splitlines()
                   if line.startswith("    "))
    exec(code, {})
    assert (tmp_path / "ball.png").exists()
