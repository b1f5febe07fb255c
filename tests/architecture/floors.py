#!/usr/bin/env python3
"""Holds the sources to the floors of docs/architecture.md: floors.py TREE

Prints each include and each name that breaks a rule, as file:line, and exits with 1 when there is one. The floors and the order of the
folders in them are those of TREE/common/CMakeLists.txt.
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
CATALOG = "common/data/catalog"
# A literal, or a comment, which is passed over.
LITERAL = re.compile(r'//.*|/\*.*?\*/|R"(\w*)\((?s:.*?)\)\1"|"((?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\]|\\.)\'')
SERVICE = re.compile(r'\* service = "([^"]+)"|\* k\w+ = "(inslab-[^"]+)"')
MOST_LINES_OF_A_COMMAND = 100
# What everybody speaks of: declared in inslab itself.
COMMON_WORDS = ("data/samples", "data/profiles", "data/requests", "foundation/fields")
NAMESPACE = re.compile(r"namespace (inslab(?:::\w+)*) \{")
NAMED_HEADER = re.compile(r"(?<![\w/.<])\w+(?:/\w+)+\.hpp")  # a folder and a header
# Nanoseconds to seconds, written out. Brackets are followed three deep.
ARGUMENT = r"[^()]*"
for _ in range(3):
    ARGUMENT = rf"(?:[^()]|\({ARGUMENT}\))*"
AS_DOUBLE = rf"\b(?:static_cast<double>|double)\(({ARGUMENT})\)"
TO_SECONDS = re.compile(rf"(?<![\w.])1e-9\s*\*\s*{AS_DOUBLE}|{AS_DOUBLE}\s*\*\s*1e-9\b")
OF_NANOSECONDS = re.compile(r"ns_?\b|\bcount\(\)")
HOLDS_TO_SECONDS = "common/foundation/time/gps_time.hpp"
# Where it is still written out.
FAST_DDS = re.compile(r"(fastdds|fastcdr|fastrtps)/|\w+PubSubTypes\.h|generated_types\.hpp")


def folders_in_order(tree):
    """The folders below common/, from the ground up, as its CMakeLists.txt lists them."""
    text = re.sub(r"#.*", "", (tree / "common/CMakeLists.txt").read_text())
    return [folder for names in re.findall(r"foreach\(folder\s+([^)]*)\)", text) for folder in names.split()]


def sources(tree):
    for top in ("common", "services"):
        for path in sorted((tree / top).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".in") and not path.name.endswith(".txt"):
                yield path


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            yield number, found.group(1) == '"', found.group(2)


def literals(path):
    text = path.read_text(encoding="utf-8")
    for found in LITERAL.finditer(text):
        if found.group(2) is not None:
            yield text.count("\n", 0, found.start()) + 1, found.group(2)


def code(path):
    """The text with each comment and literal blank, line for line."""
    return LITERAL.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), path.read_text(encoding="utf-8"))


def seconds_written_out(path):
    """time::to_seconds is the one place where nanoseconds become seconds. After another factor it is another product,
    with other bits."""
    text = code(path)
    for found in TO_SECONDS.finditer(text):
        follows_a_factor = text[:found.start()].rstrip()[-1:] in ("*", "/")
        if OF_NANOSECONDS.search(found.group(1) or found.group(2)) and not follows_a_factor:
            yield text.count("\n", 0, found.start()) + 1, "this is time::to_seconds"


def services_of(tree):
    """The names of the services, as the catalogue gives them."""
    names = set()
    for path in (tree / CATALOG).glob("*.hpp"):
        names |= {a or b for a, b in SERVICE.findall(path.read_text(encoding="utf-8"))}
    return names


def named_outside_the_catalogue(path, services):
    """Topics and services are named in the catalogue alone."""
    included = {number for number, _, _ in includes(path)}
    for number, text in literals(path):
        if number in included:
            continue
        if text.startswith("inslab/"):
            yield number, f'"{text}": topics are named in {CATALOG} alone'
        elif text in services:
            yield number, f'"{text}": services are named in {CATALOG} alone'


def floor(folder):
    return folder.split("/")[0]


def breach(folder, target, order):
    """Why a file of `folder` must not include one of `target` (folders as in the order; services/... in full), or None."""
    if target.startswith("services/"):
        if not folder.startswith("services/"):
            return "a library includes a service"
        if target.split("/")[1] != folder.split("/")[1]:
            return "a service includes another service"
        return None
    if folder.startswith("services/"):
        return None
    if floor(folder) in ("noise", "nav") and floor(target) not in ("foundation", floor(folder)):
        return "nav and noise include Eigen and foundation alone"
    if floor(folder) == "models" and (floor(target) in ("formats", "bus") or target == "foundation/host"):
        return "a model includes neither formats, bus nor host"
    if floor(folder) in ("sim", "referee") and floor(target) == "bus":
        return "sim and referee never include bus"
    if target != folder and order.index(target) > order.index(folder):
        return f"{folder} stands below {target}, and an include upward is none"
    return None


def misnamed_namespaces(path, folder):
    """A folder's namespace has its name. Besides, what is declared in inslab itself may be specialized there."""
    expected = "inslab" if folder in COMMON_WORDS else "inslab::" + folder.split("/")[-1]
    lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        found = NAMESPACE.match(line)
        if not found or found.group(1) == expected or found.group(1).startswith(expected + "::"):
            continue
        inside = next((text for text in lines[number:] if text and not text.startswith("//")), "")
        if found.group(1) != "inslab" or not inside.startswith("template <>"):
            yield number, f"{found.group(1)}: the namespace of this folder is {expected}"


def stale_paths(path, headers):
    """What a comment says of a header by its path leads to it."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for name in NAMED_HEADER.findall(line.partition("//")[2]):
            if name not in headers and not FAST_DDS.match(name):
                yield number, f"{name}: there is no such header below common/"


def names_twice(tree):
    """Headers of one basename in two folders: a reader cannot tell which is meant."""
    first = {}
    for path in sources(tree):
        if path.suffix == ".hpp" and first.setdefault(path.name, path) != path:
            yield path.relative_to(tree), f"{first[path.name].relative_to(tree)} has that name already"


def is_command(folder):
    return folder == "services/inslab/commands"


def breach_of_command(target):
    """Why a command must not include a file of this folder, or None."""
    if target == "bus/dds":
        return "a command is options and printing: what it does on the bus stands in common/bus/client"
    if floor(target) == "models":
        return "a command is options and printing: what it does with a model stands in a library"
    return None


def check(tree):
    order = folders_in_order(tree)
    services = services_of(tree)
    headers = {str(path.relative_to(tree)).removeprefix("common/") for path in sources(tree) if path.suffix == ".hpp"}
    findings = []
    for path in sources(tree):
        place = path.relative_to(tree)
        folder = str(place.parent) if place.parts[0] == "services" else str(pathlib.Path(*place.parts[1:-1]))
        if place.parts[0] == "common" and folder not in order:
            findings.append(f"{place}:1: its folder stands on no floor: common/CMakeLists.txt does not list it")
            continue
        if not place.is_relative_to(CATALOG):
            findings += [f"{place}:{number}: {why}" for number, why in named_outside_the_catalogue(path, services)]
        findings += [f"{place}:{number}: {why}" for number, why in misnamed_namespaces(path, folder)]
        findings += [f"{place}:{number}: {why}" for number, why in stale_paths(path, headers)]
        if str(place) != HOLDS_TO_SECONDS:
            findings += [f"{place}:{number}: {why}" for number, why in seconds_written_out(path)]
        lines = len(path.read_text(encoding="utf-8").splitlines())
        if is_command(folder) and lines > MOST_LINES_OF_A_COMMAND:
            findings.append(f"{place}:{MOST_LINES_OF_A_COMMAND + 1}: a command is options and printing, at most "
                            f"{MOST_LINES_OF_A_COMMAND} lines; what it does stands in a library")
        for number, is_ours, name in includes(path):
            where = f"{place}:{number}: "
            if FAST_DDS.match(name):
                if floor(folder) != "bus":
                    findings.append(f"{where}Fast DDS ({name}) is named in common/bus alone")
            elif is_ours:
                target = str(pathlib.Path(name).parent)
                if not name.startswith("inslab/"):
                    findings.append(f'{where}"{name}": ours are included as "inslab/<path>"')
                    continue
                target = target[len("inslab/"):]
                if not target.startswith("services/") and target not in order:
                    findings.append(f"{where}there is no folder {target}")
                    continue
                why = breach(folder, target, order) or (breach_of_command(target) if is_command(folder) else None)
                if why:
                    findings.append(f"{where}{name}: {why}")
            elif floor(folder) in ("noise", "nav") and "/" in name and not name.startswith(("Eigen/", "unsupported/Eigen/")):
                findings.append(f"{where}{name}: nav and noise include Eigen and foundation alone")
    findings += [f"{place}:1: {why}" for place, why in names_twice(tree)]
    return findings


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = check(pathlib.Path(sys.argv[1]))
    print("\n".join(found) or "every include keeps to the floors, and every name to the catalogue")
    sys.exit(1 if found else 0)
