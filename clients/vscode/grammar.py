#!/usr/bin/env python3
"""clients/vscode/grammar.py: prints the TextMate grammar of Klartext and DIN/ISO, made of the words that the parser
reads (server/nc/klartext): syntaxes/klartext.tmLanguage.json is what it prints, a test compares them."""

import json
import pathlib
import re

KLARTEXT = pathlib.Path(__file__).resolve().parents[2] / "server" / "nc" / "klartext"


def words(name, pattern, begin="", end=r"\Z"):
    """What `pattern` finds in a source file between `begin` and `end`, the longest first."""
    text = (KLARTEXT / name).read_text(encoding="utf-8")
    part = re.search(f"{begin}(.*?){end}", text, re.DOTALL)[1]
    found = {word for word in re.findall(pattern, part, re.MULTILINE) if re.fullmatch(r"[A-Z][A-Z0-9_]*", word)}
    return sorted(found, key=lambda word: (-len(word), word))


def one_of(names):
    return "|".join(map(re.escape, names))


def grammar():
    blocks = words("parser_block.cpp", r'^ *\{"(\w+)",', "kBlockKeywords", r"\n\};")
    absent = words("parser_block.cpp", r'"([A-Z]+)[" ]', r"kContourWords", r"\n\n")
    letters = words("letters.inc", r'^FITGAUGE_LETTER\(\w+, "(\w+)"\)')
    operators = words("operator_names.hpp", r'"(\w+)"')
    block = rf"^(\s*/?\s*)(N?\d+(?=\s))?\s*(?:({one_of(absent)})|({one_of([*blocks, 'ERROR'])}))(?![A-Z_])"
    patterns = [
        ("comment.line.semicolon", r";.*$"),
        ("markup.heading", r"^\s*(?:N?\d+)?\s*\*\s*-.*$"),
        ("string.quoted.double", r'"[^"]*"?'),
        ("entity.name.function", r"\b(?:TCH PROBE|CYCL DEF|GLOBAL DEF)\s*\d+(?:\.\d+)?[^~;=\n]*(?=[~;]|$)"),
        ("entity.name.function", r"(?<=[\s\d])G(?:12\d|[2-9]\d\d|1[4-9]\d\d)\b"),
        ("keyword.control", r"(?<![A-Z])G\d+\b"),
        ("entity.name.section", r"(?<![A-Z])(?:%\S+(?:\s+G7[01])?|(?:BEGIN|END) PGM .*$)"),
        ("variable.parameter", r"Q[LRS]?\d+"),
        ("keyword.operator", r"[-+*/^=~]"),
        ("support.function", rf"(?<![A-Z_])(?:{one_of(operators)})(?![A-Z0-9])"),
        ("constant.numeric", r"(?<![A-Z_])\d+(?:[.,]\d*)?|[.,]\d+"),
        ("storage.type", rf"(?<![A-Z_])I?(?:{one_of(letters)})(?=\s?[-+]?\s?(?:\d|[.,]\d|Q[LRS]?\d|\s|$))"),
        ("keyword.control", rf"(?<![A-Z_])(?:{one_of(blocks)})(?![A-Z0-9_])"),
        ("keyword.other", r"[A-Z_][A-Z_]+"),
    ]
    begin = {"match": f"(?i){block}", "captures": {"2": {"name": "constant.numeric.line-number.klartext"},
                                                   "3": {"name": "invalid.deprecated.klartext"},
                                                   "4": {"name": "keyword.control.klartext"}}}
    # A heading, a frame and the head of a cycle go before the first word of a block, which they begin with.
    rest = [{"name": f"{name}.klartext", "match": f"(?i){pattern}"} for name, pattern in patterns]
    return {"name": "Klartext", "scopeName": "source.klartext",
            "fileTypes": ["h", "i"], "patterns": [*rest[:5], rest[6], begin, rest[5], *rest[7:]]}


if __name__ == "__main__":
    print(json.dumps(grammar(), indent=2))
