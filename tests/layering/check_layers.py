#!/usr/bin/env python3
"""Compares every include of the sources with the edges docs/ARCHITECTURE.md allows.

Fails on an edge that is not listed, on a cycle between files, on a library below or above its
border (SQLite, Beast, JSON), and when it finds nothing to check.
"""

import re
import sys
from pathlib import Path

FOLDERS = {
    "base": "tables/base", "iso286": "tables/iso286", "tabfile": "tables/tabfile",
    "store": "db/store", "gauging": "server/gauging", "klartext": "server/klartext",
    "machine": "server/machine", "probing": "server/probing",
    "interpreter": "server/interpreter", "app": "server/app", "http": "server/http",
    "api": "server/api", "daemon": "server/daemon", "clients": "clients",
}
DOMAIN = {"iso286", "tabfile", "gauging", "klartext", "machine", "probing", "interpreter"}
ALLOWED = {
    "base": set(),
    "iso286": {"base"}, "klartext": {"base"}, "machine": {"base"}, "http": {"base"},
    "tabfile": {"base", "iso286"}, "gauging": {"base", "iso286"}, "store": {"base"},
    "probing": {"base", "machine", "gauging", "iso286"},
    "interpreter": {"base", "klartext", "machine", "probing", "tabfile"},
    "app": {"base", "interpreter", "probing", "klartext", "machine", "gauging", "tabfile",
            "iso286", "store"},
    "api": {"base", "app", "http"} | DOMAIN,
    "daemon": {"base", "api", "app", "http"},
    "clients": {"base"},
}
# A library of others, and the only layers that may include it.
BORDERS = {
    r"(sqlite3\.h|SQLiteCpp/)": {"store"},
    r"boost/(beast|asio)": {"http", "clients"},
    r"(nlohmann/|simdjson)": {"api", "daemon", "clients"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)


def main(root: Path) -> int:
    findings: list[str] = []
    edges: dict[str, set[str]] = {}
    seen = 0
    for layer, folder in FOLDERS.items():
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in {".hpp", ".cpp", ".inc"}:
                continue
            seen += 1
            name = f"{layer}/{file.relative_to(root / folder)}"
            for quoted, angled in INCLUDE.findall(file.read_text(encoding="utf-8")):
                include = quoted or angled
                target = include.split("/")[0]
                if target in FOLDERS and quoted:
                    edges.setdefault(name, set()).add(include)
                    if target != layer and target not in ALLOWED[layer]:
                        findings.append(f"{folder}/{file.name}: {layer} may not include {include}")
                for pattern, layers in BORDERS.items():
                    if re.match(pattern, include) and layer not in layers:
                        findings.append(f"{folder}/{file.name}: {include} is not for {layer}")
    findings += cycles(edges)
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
