"""The words of docs/STYLE.md and of the glossary in documents, messages, help and the page."""

import re
import subprocess
import unittest

from support.cli import FITGAUGE
from support.daemon import FITGAUGED, ROOT

BANNED = re.compile(r"\b(any more|no longer|whoever|whatever|(?:is|are) told|rejected requests?|daemons?|the one before|"
                    r"inspection certificates?|own columns?|columns? of the shop)\b", re.IGNORECASE)
# The words themselves stand in the first two; the others are for developers.
LEFT_OUT = {"STYLE.md", "glossary.md", "ARCHITECTURE.md", "api.md", "cycles.md"}
GENERATED = {"api", "cycles"}  # folders; their texts are those of the program


def found(text):
    """The banned words outside of code, which shows what a program prints."""
    return [match[0] for match in BANNED.finditer(re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.DOTALL))]


class Words(unittest.TestCase):
    def test_documents(self):
        for path in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "clients").glob("*/README.md"),
                     *(ROOT / "docs/man").glob("*.[18]")]:
            if path.name not in LEFT_OUT and path.parent.name not in GENERATED:
                with self.subTest(path.relative_to(ROOT)):
                    self.assertEqual(found(path.read_text(encoding="utf-8")), [])

    def test_messages_and_the_page(self):
        for name in ("server/base/error_codes.inc", *(f"clients/web/lang/{part}.js" for part in ("en", "desk_en", "plans_en", "figures_en"))):
            self.assertEqual(found((ROOT / name).read_text(encoding="utf-8")), [], name)

    def test_help(self):
        for program in (FITGAUGE, FITGAUGED):
            done = subprocess.run([program, "--help"], capture_output=True, text=True, check=True)
            self.assertEqual(found(done.stdout), [], program)

    def test_a_banned_word_is_found(self):
        self.assertEqual(found("It is told. `whatever`, and no\nlonger. Any more?"), ["is told", "Any more"])
        self.assertEqual(found("A daemon answers."), ["daemon"])
