#!/usr/bin/env python3
"""Draws the floors as Graphviz reads them: picture.py TREE [FILE]

Prints the folders, floor by floor from the ground up, with an arrow to each folder that one includes and does not reach
through another one. With FILE (docs/pictures/floors.dot) it compares, and exits with 1 when the file is not that text.
The picture is made of it with:  tests/architecture/picture.py . > docs/pictures/floors.dot
                                 dot -Tsvg docs/pictures/floors.dot -o docs/pictures/floors.svg
"""

import pathlib
import sys

import floors

COLOURS = ("#eef3f8", "#f6f2ea")


def arrows(tree, order):
    """folder -> the folders of ours that its files include."""
    found = {folder: set() for folder in order}
    for path in floors.sources(tree):
        place = path.relative_to(tree)
        folder = service(place) if place.parts[0] == "services" else str(pathlib.Path(*place.parts[1:-1]))
        for _, is_ours, name in floors.includes(path):
            if not is_ours:
                continue
            target = str(pathlib.Path(name).parent)[len("inslab/"):]
            if target != folder and not target.startswith("services/") and target in found:
                found.setdefault(folder, set()).add(target)
    return found


def service(place):
    return "/".join(place.parts[:2])


def without_detours(found):
    """The arrows less those that lead where another way leads too."""
    reach = {}

    def below(folder):
        if folder not in reach:
            reach[folder] = set()
            for target in found.get(folder, ()):
                reach[folder] |= {target} | below(target)
        return reach[folder]

    return {folder: {target for target in targets if not any(target in below(other) for other in targets - {target})}
            for folder, targets in found.items()}


def picture(tree):
    order = floors.folders_in_order(tree)
    found = arrows(tree, order)
    services = sorted(folder for folder in found if folder.startswith("services/"))
    lines = ["// The floors of docs/architecture.md; tests/architecture/picture.py writes this file.",
             "digraph floors {",
             '  graph [rankdir=BT, fontname="sans-serif", fontsize=13, nodesep=0.15, ranksep=0.45, compound=true];',
             '  node [shape=box, style="filled,rounded", fillcolor=white, color="#5b6b7b", fontname="sans-serif",'
             " fontsize=11, height=0.28, margin=\"0.08,0.03\"];",
             '  edge [color="#8a97a5", arrowsize=0.5];']
    names = []
    for folder in order + services:
        name = floors.floor(folder)
        if name not in names:
            names.append(name)
    for number, name in enumerate(names):
        lines.append(f'  subgraph "cluster_{name}" {{')
        lines.append(f'    label="{"services" if name == "services" else "common/" + name}"; labeljust=l; style=filled;'
                     f' color="{COLOURS[number % 2]}";')
        for folder in order + services:
            if floors.floor(folder) == name:
                lines.append(f'    "{folder}" [label="{folder.split("/", 1)[-1]}"];')
        lines.append("  }")
    kept = without_detours(found)
    for folder in order + services:
        lines += [f'  "{folder}" -> "{target}";' for target in sorted(kept[folder])]
    lines.append("}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    drawn = picture(pathlib.Path(sys.argv[1]))
    if len(sys.argv) == 2:
        sys.stdout.write(drawn)
    elif pathlib.Path(sys.argv[2]).read_text(encoding="utf-8") != drawn:
        sys.exit(f"{sys.argv[2]} is not the picture of this tree: make both again, see {sys.argv[0]}")
