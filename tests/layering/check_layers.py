#!/usr/bin/env python3
"""Compares every include of the sources with the edges docs/ARCHITECTURE.md allows, and the tree it prints
with the folders.

Fails on an edge that is not listed, on a cycle between files, on a library below or above its
border (SQLite, Beast, JSON), on a thread that an exception would end, on an error code that nothing makes, on a name of the tree that is not there
and a room the tree lacks, and when it finds nothing to check.
"""

import re
import sys
from pathlib import Path

FOLDERS = {
    "base": "tables/base", "iso286": "tables/iso286", "standards": "tables/standards", "tabfile": "tables/tabfile",
    "store": "db/store", "sql": "db/sql", "sqlite": "db/sqlite", "postgres": "db/postgres", "gauging": "server/gauging", "metrology": "server/metrology", "klartext": "server/klartext",
    "machine": "server/machine", "probing": "server/probing",
    "program": "server/interpreter/program", "run": "server/interpreter/run", "app": "server/app", "http": "server/http", "http_client": "server/http_client", "tlog": "server/tlog",
    "control_link": "server/control_link", "log_reader": "server/log_reader", "certificate": "server/certificate", "sheet": "server/sheet", "aqdef": "server/aqdef", "qif": "server/qif", "workbook": "server/workbook",
    "api": "server/api", "virtual_control": "server/virtual_control", "collector": "server/collector", "forwarder": "server/forwarder", "connections": "server/connections", "shdr": "server/shdr", "daemon": "server/daemon", "clients": "clients",
}
DOMAIN = {"iso286", "standards", "tabfile", "gauging", "metrology", "klartext", "machine", "probing", "program", "run"}


def allowed_edges(architecture: str) -> dict[str, set[str]]:
    """The edges of the paragraph "Allowed edges": `a, b → c, d; …`, everything → base."""
    paragraph = re.search(r"Allowed edges[^:]*: (.*?)\.\n", architecture, re.DOTALL)
    if paragraph is None:
        sys.exit("docs/ARCHITECTURE.md has no paragraph \"Allowed edges\"")
    edges: dict[str, set[str]] = {layer: {"base"} for layer in FOLDERS}
    edges["base"] = set()
    for clause in paragraph.group(1).split(";"):
        if "→" not in clause:
            continue
        sources, targets = (set(re.findall(r"[a-z0-9_]+", side)) for side in clause.split("→"))
        if "domain" in targets:  # "the domain types it formats"
            targets |= DOMAIN
        for source in sources & FOLDERS.keys():
            edges[source] |= targets & FOLDERS.keys()
    return edges


# A library of others, and the only layers that may include it.
BORDERS = {
    r"(sqlite3\.h|SQLiteCpp/)": {"sqlite"},
    r"postgresql/": {"postgres"},
    r"boost/beast": {"http", "clients"},
    r"boost/asio": {"http", "clients", "shdr"},
    r"nlohmann/": {"base"},
    r"simdjson": {"api"},
}
# What starts a thread. All but base/thread.hpp take that one, which guards what the thread does. (The tools of clients end with
# their command, and std::async hands an exception on.)
RAW_THREAD = re.compile(r"std::(j?thread|async)\b|pthread_create|boost::thread|asio::thread_pool")
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)


def rooms(folder: Path) -> set[str]:
    """The folders below it that hold sources."""
    sources = {".hpp", ".cpp", ".js", ".py"}
    return {path.name + "/" for path in folder.iterdir()
            if path.is_dir() and path.name != "__pycache__" and any(file.suffix in sources for file in path.rglob("*"))}


def tree_findings(architecture: str, root: Path) -> list[str]:
    """Section 2: `folder  name name room/ -- words`. Every name is there; every room is named."""
    block = re.search(r"## 2\. The tree\n```\n(.*?)```", architecture, re.DOTALL)
    if block is None:
        return ["docs/ARCHITECTURE.md has no tree in section 2"]
    found: list[str] = []
    listed = set()
    for line in block.group(1).splitlines():
        folder, *names = line.split(" -- ")[0].split()
        listed.add(folder)
        if not (root / folder).is_dir():
            found.append(f"the tree names {folder}, which is no folder")
        for name in names:
            there = (root / folder / name).is_dir() if name.endswith("/") else any((root / folder).glob(name + "*"))
            if not there:
                found.append(f"the tree names {name} in {folder}, which is not there")
        if folder.startswith(("server/", "clients/")) and (root / folder).is_dir():
            found += [f"the tree lacks {room} in {folder}" for room in sorted(rooms(root / folder) - set(names))]
    for layer in FOLDERS.values():
        if not any(name == layer or name.startswith(layer + "/") for name in listed):
            found.append(f"the tree lacks {layer}")
    return found


def main(root: Path) -> int:
    architecture = (root / "docs/ARCHITECTURE.md").read_text(encoding="utf-8")
    allowed = allowed_edges(architecture)
    findings = tree_findings(architecture, root)
    edges: dict[str, set[str]] = {}
    made: set[str] = set()
    seen = 0
    for layer, folder in FOLDERS.items():
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in {".hpp", ".cpp", ".inc"}:
                continue
            seen += 1
            name = f"{layer}/{file.relative_to(root / folder)}"
            text = file.read_text(encoding="utf-8")
            if name != "api/wire/problem.cpp":  # which gives each its status
                made.update(re.findall(r"ErrorCode::(\w+)", text))
            if layer != "clients" and name != "base/thread.hpp":
                findings += [f"{folder}/{file.name}: {raw[0]} is a thread that an exception ends: take base/thread.hpp" for raw in RAW_THREAD.finditer(text)]
            for quoted, angled in INCLUDE.findall(text):
                include = quoted or angled
                target = include.split("/")[0]
                if target in FOLDERS and quoted:
                    edges.setdefault(name, set()).add(include)
                    if target != layer and target not in allowed[layer]:
                        findings.append(f"{folder}/{file.name}: {layer} may not include {include}")
                for pattern, layers in BORDERS.items():
                    if re.match(pattern, include) and layer not in layers:
                        findings.append(f"{folder}/{file.name}: {include} is not for {layer}")
    findings += cycles(edges)
    codes = re.findall(r"^FITGAUGE_ERROR\((\w+)", (root / "tables/base/error_codes.inc").read_text(encoding="utf-8"), re.MULTILINE)
    findings += [f"tables/base/error_codes.inc: nothing makes {code}" for code in codes if code not in made]
    for finding in findings:
        print(finding)
    print(f"{seen} files, {len(findings)} findings")
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
    sys.exit(main(Path(sys.argv[1])))
