#!/usr/bin/env python3
"""Compares every include of the sources with the order of the rooms in docs/ARCHITECTURE.md, and the tree it prints
with the folders.

Fails on an include of a room that comes later, on a cycle between files, on a library of others outside its border
(SQLite, Beast, JSON), on a thread that an exception would end, on a file that is read by its path, on an error code
that nothing makes, on a folder of the tree that does not exist or that the tree lacks, and when it finds nothing to
check. `--arrows` prints the rooms with their lines, and each pair of rooms of which one includes the other.
"""

import re
import sys
from collections import Counter
from pathlib import Path

# A library of others, and the only folders that may include it.
BORDERS = {
    r"(sqlite3\.h|SQLiteCpp/)": ("db/sqlite",),
    r"postgresql/": ("db/postgres",),
    r"boost/beast": ("server/http", "clients"),
    r"boost/asio": ("server/http", "server/plant/mtconnect", "clients"),
    r"nlohmann/": ("server/base",),
    r"simdjson": ("server/base/json", "server/record"),
}
# What starts a thread. All but base/thread.hpp take that one, which guards what the thread does. (The tools of clients
# end with their command, and std::async hands an exception on.)
RAW_THREAD = re.compile(r"std::(j?thread|async)\b|pthread_create|boost::thread|asio::thread_pool")
# What opens a file by its path to read it, and so waits for the writer of a FIFO: base/folder.hpp does not.
RAW_READ = re.compile(r"std::ifstream|\bfopen\(|parse_file\(|(certificate|key|verify|CA)_(chain_)?file\(|"
                      r"CURLOPT_CAINFO\b|O_RDONLY(?! \| O_DIRECTORY)")
READERS = ("server/base/", "db/sqlite/data_directory.cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
SOURCES = {".hpp", ".cpp", ".inc"}


def rooms_in_order(architecture: str) -> list[str]:
    """Section 1: the rooms, from the one that includes nothing to the one that nothing includes."""
    block = re.search(r"## 1\..*?\n```\n(.*?)```", architecture, re.DOTALL)
    if block is None:
        sys.exit("docs/ARCHITECTURE.md has no list of rooms in section 1")
    return block.group(1).split()


def tree_findings(architecture: str, root: Path) -> list[str]:
    """Section 2: `folder  folder/ folder/  -- words`. Every folder exists; every folder with sources is named."""
    block = re.search(r"## 2\..*?\n```\n(.*?)```", architecture, re.DOTALL)
    if block is None:
        return ["docs/ARCHITECTURE.md has no tree in section 2"]
    found: list[str] = []
    for line in block.group(1).splitlines():
        folder, *names = line.split(" -- ")[0].split()
        if not (root / folder).is_dir():
            found.append(f"the tree names {folder}, which is no folder")
            continue
        found += [f"the tree names {name} in {folder}, which is not there" for name in names if not (root / folder / name).is_dir()]
        if folder.split("/")[0] in {"server", "db", "tables", "clients"}:
            kinds = SOURCES | {".js", ".py"}
            there = {path.name + "/" for path in (root / folder).iterdir()
                     if path.is_dir() and path.name != "__pycache__" and any(file.suffix in kinds for file in path.rglob("*"))}
            found += [f"the tree lacks {name} in {folder}" for name in sorted(there - set(names))]
    return found


def main(root: Path, print_arrows: bool) -> int:
    architecture = (root / "docs/ARCHITECTURE.md").read_text(encoding="utf-8")
    rank = {room: number for number, room in enumerate(rooms_in_order(architecture))}
    folders = {room: room if room in {"db", "tables"} else f"server/{room}" for room in rank} | {"cli": "clients/cli"}
    rank["cli"] = len(rank)
    findings = tree_findings(architecture, root)
    findings += [f"{room.name} is a room that the order lacks" for room in (root / "server").iterdir() if room.is_dir() and room.name not in rank]
    edges: dict[str, set[str]] = {}
    arrows: Counter[tuple[str, str]] = Counter()
    lines: Counter[str] = Counter()
    made: set[str] = set()
    seen = 0
    for room, folder in folders.items():
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in SOURCES:
                continue
            seen += 1
            path = file.relative_to(root)
            name = f"{room}/{file.relative_to(root / folder)}"
            text = file.read_text(encoding="utf-8")
            lines[room] += text.count("\n")
            if name != "api/wire/problem.cpp":  # which gives each its status
                made.update(re.findall(r"ErrorCode::(\w+)", text))
            if room != "cli" and name != "base/thread.hpp":
                findings += [f"{path}: {raw[0]} is a thread that an exception ends: use base/thread.hpp" for raw in RAW_THREAD.finditer(text)]
            if room != "cli" and not str(path).startswith(READERS):
                findings += [f"{path}: {raw[0]} waits for a FIFO: use base/folder.hpp" for raw in RAW_READ.finditer(text)]
            for quoted, angled in INCLUDE.findall(text):
                target = quoted.split("/")[0]
                if target in rank:
                    edges.setdefault(name, set()).add(quoted)
                    if target != room:
                        arrows[room, target] += 1
                    if rank[target] > rank[room]:
                        findings.append(f"{path}: {room} comes before {target} and may not include {quoted}")
                for pattern, borders in BORDERS.items():
                    if re.match(pattern, quoted or angled) and not str(path).startswith(borders):
                        findings.append(f"{path}: {quoted or angled} is only for {' and '.join(borders)}")
    findings += cycles(edges)
    codes = re.findall(r"^FITGAUGE_ERROR\((\w+)", (root / "server/base/error_codes.inc").read_text(encoding="utf-8"), re.MULTILINE)
    findings += [f"server/base/error_codes.inc: nothing makes {code}" for code in codes if code not in made]
    if print_arrows:
        for room in folders:
            print(f"{room:10} {lines[room]:6} lines  includes {' '.join(f'{b}({n})' for (a, b), n in sorted(arrows.items()) if a == room)}")
    for finding in findings:
        print(finding)
    inside = [pair for pair in arrows if "cli" not in pair]
    print(f"{seen} files, {sum(lines.values())} lines, {len(folders) - 1} rooms, {len(inside)} arrows, {len(findings)} findings")
    return 1 if findings or seen == 0 else 0


def cycles(edges: dict[str, set[str]]) -> list[str]:
    """One line for each include cycle between headers."""
    found: list[str] = []
    state: dict[str, int] = {}

    def visit(node: str, path: list[str]) -> None:
        state[node] = 1
        for target in sorted(edges.get(node, ())):
            if state.get(target) == 1:
                found.append("cycle: " + " -> ".join([*path[path.index(target):], target]))
            elif target not in state:
                visit(target, [*path, target])
        state[node] = 2

    for node in sorted(edges):
        if node not in state:
            visit(node, [node])
    return found


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), "--arrows" in sys.argv[2:]))
