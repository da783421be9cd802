"""The words of docs/STYLE.md and of the glossary in documents, messages, help and the page."""

import re
import subprocess
import unittest

from support.cli import FITGAUGE
from support.daemon import FITGAUGED, ROOT, DaemonTest

BANNED = re.compile(r"\b(any more|no longer|whoever|whatever|(?:is|are) told|rejected requests?|daemons?|the one before|"
                    r"inspection certificates?|own columns?|columns? of the shop|causes? and (?:a )?measures?)\b", re.IGNORECASE)
# Help: half sentences. Errors: idioms in place of what is wrong.
RIDDLES = re.compile(r"  Of .*|[a-z], else \d+|when absent")
# Descriptions of the HTTP API, which are sentences, or nouns with what is true of them.
API_RIDDLES = re.compile(r"when absent|[a-z], else \d+|^(?:Makes|Most|What|Where|Whether) .*|\bthat are no\b|\b(?:alone|beside)\b")
# A choice has one form: FIELD must be one of: a, b, c.
CHOICES = re.compile(r"must be one of(?!: )|\bone of \{\}|must be (?!true or false)[\w{}']+(?:, [\w']+)* or (?!more)[\w']+(?:;.*)?$|^\w+ is \{\}$")
# Words of the verdicts, and pairs of words for one thing, that a language keeps out of all its other texts.
FOREIGN = {"de": r"Abweichungen in µm|[Bb]erichtig|Prüfstation|Prüfzeugnis|horchen|Mittlere Abweichung|Kleinstes Spiel|Aufbau\b",
           "it": r"(?i)scart|ripresa|collaudo|reticolo|angoli spaziali|scostamento medio",
           "nl": r"(?i)onbeslist|opstelling|\bkeuren|\bdelen\b|gemiddelde afwijking"}
SPOKEN = re.compile(r"^(?:Of|The same)\b|^an? \w+ takes|is no (?:number|length|date|key)\b|stands? (?:twice|before|behind)|goes on behind|put back|"
                    r"does not (?:say|tell)|says '|which holds$|of its own\b|the other way round|is there twice|takes up to\b|, else of\b")
# The words themselves stand in the first two; the others are for developers.
LEFT_OUT = {"STYLE.md", "glossary.md", "ARCHITECTURE.md", "api.md", "cycles.md"}
GENERATED = {"api", "cycles"}  # folders; their texts are those of the program


def found(text):
    """The banned words outside of code, which shows what a program prints."""
    return [match[0] for match in BANNED.finditer(re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.DOTALL))]


def literals(source):
    """The texts of C++ string literals, neighbours joined."""
    for match in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', re.sub(r"^\s*(?://|#).*", "", source, flags=re.MULTILINE)):
        text = re.sub(r'"\s*"', "", match[0])[1:-1]
        if len(re.findall(r"[A-Za-z]{2,}", text)) > 2 and not re.match(r" ?(?:SELECT|SET|AND) ", text):
            yield text


class Words(unittest.TestCase):
    def test_documents(self):
        for path in [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "clients").glob("*/README.md"),
                     *(ROOT / "docs/man").glob("*.[18]")]:
            if path.name not in LEFT_OUT and path.parent.name not in GENERATED:
                with self.subTest(path.relative_to(ROOT)):
                    self.assertEqual(found(path.read_text(encoding="utf-8")), [])

    def test_messages_and_the_page(self):
        for name in ("server/base/error_codes.inc", *(f"clients/web/lang/{part}.js" for part in ("en", "desk_en", "plans_en", "figures_en"))):
            self.assertEqual(found((ROOT / name).read_text(encoding="utf-8")), [], name)

    def test_translations(self):
        for language, banned in FOREIGN.items():
            files = [path for path in (ROOT / "clients/web/lang").iterdir() if language in path.stem.split("_")]
            texts = [pair for path in files
                     for pair in re.findall(r"^  '([\w.-]+)': '(.*)',$", path.read_text(encoding="utf-8"), re.MULTILINE)]
            self.assertGreater(len(texts), 900)
            self.assertEqual([(key, text) for key, text in texts if re.search(banned, text)
                              and key not in ("verdict.reject", "arrived.reject")], [])

    def help_of(self, *command):
        """The help of a program or command, and of every command below it."""
        text = subprocess.run([*command, "--help"], capture_output=True, text=True, check=True).stdout
        yield command, text
        for name in re.findall(r"^  ([a-z][a-z-]*)", text.partition("\nSubcommands:\n")[2], re.MULTILINE):
            yield from self.help_of(*command, name)

    def test_help(self):
        commands = [*self.help_of(FITGAUGE), *self.help_of(FITGAUGED)]
        self.assertGreater(len(commands), 60)
        for command, text in commands:
            with self.subTest(command[1:]):
                self.assertEqual(found(text) + RIDDLES.findall(text), [])

    def test_errors(self):
        """Texts in the sources: all string literals with three words or more, but for SQL and includes."""
        checked = 0
        for folder in ("server", "db", "tables", "clients/cli"):
            for path in [*(ROOT / folder).rglob("*.[ch]pp"), *(ROOT / folder).rglob("*.inc")]:
                for text in literals(path.read_text(encoding="utf-8")):
                    checked += 1
                    self.assertEqual(found(text) + SPOKEN.findall(text) + CHOICES.findall(text), [], f"{path.relative_to(ROOT)}: {text}")
        self.assertGreater(checked, 3000)

    def test_a_banned_word_is_found(self):
        self.assertEqual(found("It is told. `whatever`, and no\nlonger. Any more?"), ["is told", "Any more"])
        self.assertEqual(found("A daemon answers."), ["daemon"])
        self.assertTrue(RIDDLES.search("  --rules TEXT   Of Western Electric"))
        self.assertEqual(list(literals('  // "no text of this"\nfail("a plan takes "\n  "one part");')), ["a plan takes one part"])
        self.assertTrue(SPOKEN.search("a plan takes one part"))
        self.assertTrue(SPOKEN.search("Of the part, to 1e-9"))
        for wrong in ("feature must be hole or shaft", "x must be a, b or c; got {}", "must be one of {}", "one of {}", "quantity is {}"):
            self.assertTrue(CHOICES.search(wrong), wrong)
        for right in ("x must be one of: a, b, c; got {}", "x must be 0 or more", "x must be true or false", "a is in {}"):
            self.assertFalse(CHOICES.search(right), right)
        self.assertTrue(re.search(FOREIGN["it"], "Medie e scarti"))


class Api(DaemonTest):
    def described(self, value):
        """All summaries and descriptions in a document."""
        for name, below in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
            if name in ("description", "summary") and isinstance(below, str):
                yield below
            else:
                yield from self.described(below)

    def test_descriptions(self):
        texts = set(self.described(self.daemon.get("/openapi.json").json))
        self.assertGreater(len(texts), 1000)
        self.assertEqual([text for text in sorted(texts) if found(text) or API_RIDDLES.search(text)], [])

    def test_a_refused_choice_lists_the_words(self):
        post = self.daemon.post
        for answer in (post("/v1/measurements", {"quantity": "x"}), post("/v1/measurements", {"feature": "x"}),
                       post("/v1/measurements", {"designation": "25 H7", "measured_mm": 25, "envelope": "required", "go_gauge": "x"}), self.daemon.get("/v1/measurements?verdict=x"),
                       post("/v1/statistics/chart", {"kind": "x", "values": [1, 2, 3]}),
                       self.daemon.request("POST", "/v1/measurements", "x", {"Content-Type": "text/x"})):
            self.assertRegex(answer.json["detail"], r"^[\w -]+ must be one of: [\w./-]+(?:, [\w./-]+)+(?: \(and \d+ more\)|; got 'x')?$")
