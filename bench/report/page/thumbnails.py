#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws small pictures of scenes for the page, SCENE.png in thumbnails.zip:

  thumbnails.py BOXSTREAM SCENE.json[@SCALE]...
"""
import base64
import io
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

from PIL import Image

SIZE = (240, 120)
STEPS = 30
INTO = pathlib.Path(__file__).resolve().parent / "thumbnails.zip"


def still(tool, file, scale, directory):
    """The picture of the scene on the tool's poster, which holds it as a PNG. So early a scene's own checks may fail."""
    poster = pathlib.Path(directory) / "poster.svg"
    subprocess.run([tool, "simulate", file, "--steps", str(STEPS), "--scale", scale or "1", "--picture", poster],
                   check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    data = re.search(r'href="data:image/png;base64,([^"]*)', poster.read_text())[1]
    return Image.open(io.BytesIO(base64.b64decode(data)))


def draw(tool, scene, archive):
    file, _, scale = scene.partition("@")
    with tempfile.TemporaryDirectory() as directory:
        small = still(tool, file, scale, directory).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)
    # 48 colours are enough at this size, and keep a file below 15 kB.
    png = io.BytesIO()
    small.quantize(48, dither=Image.Dither.NONE).save(png, "PNG", optimize=True)
    archive.writestr(zipfile.ZipInfo(pathlib.Path(file).stem + ".png"), png.getvalue())


if __name__ == "__main__":
    with zipfile.ZipFile(INTO, "w") as pictures:
        for name in sys.argv[2:]:
            draw(sys.argv[1], name, pictures)
