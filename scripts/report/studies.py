# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Markdown tables of studies (results/reference/) as sections of the page, with the pictures that stand beside them."""

import base64
import html
import io
import itertools
import os
import re

import markdown
from PIL import Image

from lmdbench_results import ResultError

# Studies that a reader looks for first, with places of their own in the page's navigation.
FIRST = ("extreme", "hard-soft", "stability", "scaling", "ledger")
PICTURE_WIDTH = 1500  # pixels: sharp at the width of the page
PICTURE_QUALITY = 75  # of 100: lines and text stay sharp


def picture(file, width=PICTURE_WIDTH):
    """A picture inside the page, at a size that a page can carry."""
    try:
        with Image.open(file) as image:
            image = image.convert("RGB")
    except (OSError, SyntaxError) as error:  # the second one is Pillow's of a damaged PNG
        raise ResultError(f"{file}: is no picture: {error} (remedy: draw it again, or remove it)")
    if image.width > width:
        image = image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
    stream = io.BytesIO()
    image.save(stream, format="WEBP", quality=PICTURE_QUALITY, method=6)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")


def pictures_inside(text, folder):
    """Pictures become part of the page; one that is not there becomes its description, since asking for it would be a request."""
    def inside(match):
        words, file = match.group(1), os.path.join(folder, match.group(2))
        if not match.group(2).endswith(".png") or not os.path.isfile(file):
            return f"*{words}*"
        return f'<img class="figure" alt="{html.escape(words)}" src="{picture(file)}">'
    return re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", inside, text)


def slug(name):
    """For an id or the name of a file."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower())


def unique(name, taken):
    """An id that no other one of the page has, with a number if need be; on some disks files a.svg and A.svg are one."""
    numbered = next(made for made in itertools.chain([name], (f"{name}-{number}" for number in itertools.count(2))) if made.lower() not in taken)
    taken.add(numbered.lower())
    return numbered


def html_of(text):
    """Of Markdown. Links to files beside a study would be broken on the page, and a name that looks like a link is none: both stay as words."""
    return re.sub(r'<a href="(?!https?:|#)[^"]*">(.*?)</a>', r"\1", markdown.markdown(text, extensions=["tables", "fenced_code"]))


def study(file):
    """A section: its first heading is its title."""
    try:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
    except (OSError, UnicodeDecodeError) as error:
        raise ResultError(f"{file}: cannot be read: {error} (remedy: name a Markdown file in UTF-8)")
    title = re.search(r"(?m)^# (.+)$", text) or re.search(r"(?m)^##? (.+)$", text)
    name = os.path.splitext(os.path.basename(file))[0]
    body = re.sub(r"(?m)^# .+\n", "", text, count=1)
    return {"id": "study-" + slug(name), "name": name, "title": title.group(1) if title else name,
            "html": html_of(pictures_inside(body, os.path.dirname(file))), "open": False}


def studies(files):
    """All of them, those of FIRST in its order, the others by name."""
    def place(entry):
        return (FIRST.index(entry["name"]) if entry["name"] in FIRST else len(FIRST), entry["name"])
    taken = set()
    return [{**entry, "id": unique(entry["id"], taken)} for entry in sorted(map(study, files), key=place)]
