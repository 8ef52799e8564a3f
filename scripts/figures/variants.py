# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Results under names that tell them apart: variants of one experiment, as `--set` makes them, are named by what differs in it."""

import json
import os

from lmdbench_results import Result, UsageError

# Settings without effect on results: named only if nothing else differs.
INCIDENTAL = ("/probes", "/record", "/plan", "/mesh_folder", "/driver/block_frames", "/driver/repetitions")
NEVER = ("/$schema", "/name", "/title")
PROFILES = "/force/profiles"
MOST_NAMED = 3


def settings(value, pointer=""):
    """{JSON pointer: value} of what an experiment says, methods by their label, several force profiles by their name."""
    if pointer == "/methods":
        by_label = {method.get("label", method.get("name", "")): method for method in value}
        return {pointer: ", ".join(sorted(by_label)), **settings(by_label, pointer + "/")}
    if pointer == "/force" and isinstance(value, list):
        by_name = {profile.get("name", ""): profile for profile in value}
        return {PROFILES: ", ".join(by_name), **settings(by_name, pointer)}
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        value = dict(enumerate(value))
    if not isinstance(value, dict):
        return {pointer: value}
    return {place: item for key, inner in value.items() for place, item in settings(inner, f"{pointer}/{key}").items()}


def words(value):
    if isinstance(value, bool):
        return "on" if value else "off"
    return value if isinstance(value, str) else "none" if value is None else json.dumps(value)


def differences(variants):
    """A text for each of some experiments: its values of those settings in which they differ."""
    said = [settings(variant) for variant in variants]
    places = list(dict.fromkeys(place for one in said for place in one if not place.startswith(NEVER)))
    last = [place.rsplit("/", 1)[-1] for place in places]
    # A method or profile that some variants lack is named once: the others are compared.
    lists = ("/methods//", "/force/") if len({one.get(PROFILES) for one in said}) > 1 else ("/methods//",)
    differ = [place for place in places if len({json.dumps(one.get(place)) for one in said
                                                if place in one or place == PROFILES or not place.startswith(lists)}) > 1]
    differ = [place for place in differ if not place.startswith(INCIDENTAL)] or differ

    def name(place):
        parts = [part for part in place.split("/") if not part.isdigit()]
        return " ".join(parts[-1 if last.count(parts[-1]) == 1 else -2:]).replace("_", " ").strip()

    return [", ".join(f"{name(place)} {words(one[place])}" for place in differ[:MOST_NAMED] if place in one) for one in said]


def tell_apart(results):
    """Gives each result or sweep a name of its own: where two have one name, with what differs in them; where nothing that is named
    does, with the file."""
    variants = {}
    for result in results:
        variants.setdefault(result.name, []).append(result)
    for group in (group for group in variants.values() if len(group) > 1):
        for result, text in zip(group, differences([result.experiment for result in group])):
            result.name += f": {text}" if text else ""
        folder = os.path.commonpath([os.path.dirname(os.path.abspath(result.file)) for result in group])
        names = [result.name for result in group]
        for result in (result for result in group if names.count(result.name) > 1):
            result.name += f" ({os.path.relpath(result.file, folder)})"
    return results


def refuse_twice(files):
    if len({os.path.realpath(file) for file in files}) < len(files):
        raise UsageError(f"{', '.join(map(str, files))}: a file is there twice (remedy: name every result once)")


def open_results(files):
    """The results, under names that tell them apart."""
    refuse_twice(files)
    return tell_apart([Result(file) for file in files])
