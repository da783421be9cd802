"""clients/vscode: the grammar knows the words of the parser, and the package holds together; where TESTS_DEEP is set
it is built, which needs npm and the network."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

from support.control import EXAMPLES
from support.language_client import LanguageClient

SOURCES = EXAMPLES.parent / "vscode"


def colours(grammar, line):
    """The scope of each piece of a line, as TextMate finds them: the leftmost match, of several the first pattern."""
    rules = [(re.compile(rule["match"]), rule) for rule in grammar["patterns"]]
    found, at = [], 0
    while at < len(line):
        matches = [(match.start(), order, match, rule) for order, (pattern, rule) in enumerate(rules)
                   if (match := pattern.search(line, at)) and match.end() > match.start()]
        if not matches:
            break
        *_, match, rule = min(matches, key=lambda each: each[:2])
        if "name" in rule:
            found.append((rule["name"], match.group().strip()))
        for group, capture in rule.get("captures", {}).items():
            if match[int(group)]:
                found.append((capture["name"], match[int(group)]))
        at = match.end()
    return [(name.removesuffix(".klartext"), text) for name, text in found]


class Extension(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.package = json.loads((SOURCES / "package.json").read_text(encoding="utf-8"))
        cls.grammar = json.loads((SOURCES / "syntaxes" / "klartext.tmLanguage.json").read_text(encoding="utf-8"))

    def test_the_grammar_is_made_of_the_words_of_the_parser(self):
        made = subprocess.run([SOURCES / "grammar.py"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(json.loads(made), self.grammar, "run clients/vscode/grammar.py > clients/vscode/syntaxes/…")

    def test_each_word_that_the_server_begins_blocks_with_is_one(self):
        with tempfile.TemporaryDirectory() as folder:
            client = LanguageClient(folder)
            self.addCleanup(client.close)
            client.initialize()
            client.open("a.h", "BEGIN PGM A MM\n\nEND PGM A MM\n")
            items = [each["label"] for each in client.at("completion", "a.h", 1, 0)["result"]]
        words = [label for label in items if " " not in label]
        self.assertGreater(len(words), 30)
        for word in words:
            name, text = colours(self.grammar, f"12 {word} X+1")[1]
            self.assertIn(name, ("keyword.control", "invalid.deprecated"))
            self.assertEqual(text, word)

    def test_lines_have_their_colours(self):
        for line, *expected in (
                ("8 L X+Q1 R0 FMAX M3 ;to the hole", ("constant.numeric.line-number", "8"), ("keyword.control", "L"),
                 ("variable.parameter", "Q1"), ("comment.line.semicolon", ";to the hole")),
                ("TCH PROBE 421 MEASURE HOLE ~", ("entity.name.function", "TCH PROBE 421 MEASURE HOLE")),
                ('LBL "Q1"', ("keyword.control", "LBL"), ("string.quoted.double", '"Q1"')),
                ("Q2 = SQRT ( QL5 )", ("variable.parameter", "Q2"), ("support.function", "SQRT"), ("variable.parameter", "QL5")),
                ("4 * - Place", ("markup.heading", "4 * - Place")),
                ("N50 G421 Q262=+25 *", ("entity.name.function", "G421"), ("variable.parameter", "Q262")),
                ("N10 G01 X+5 *", ("keyword.control", "G01")), ("%DEMO G71 *", ("entity.name.section", "%DEMO G71")),
                ("BEGIN PGM A MM", ("entity.name.section", "BEGIN PGM A MM")), ("FL X+1", ("invalid.deprecated", "FL"))):
            with self.subTest(line):
                found = colours(self.grammar, line)
                for each in expected:
                    self.assertIn(each, found)

    def test_every_line_of_the_examples_is_read_to_its_end(self):
        for path in EXAMPLES.rglob("*.h"):
            for line in path.read_text(encoding="utf-8").splitlines():
                self.assertTrue(line.strip() == "" or colours(self.grammar, line), line)

    def test_files_that_the_package_names_are_there_and_libraries_are_pinned(self):
        named = [each["path"] for each in self.package["contributes"]["grammars"]]
        named += [each["configuration"] for each in self.package["contributes"]["languages"]]
        for name in named:
            json.loads((SOURCES / name).read_text(encoding="utf-8"))
        lock = json.loads((SOURCES / "package-lock.json").read_text(encoding="utf-8"))["packages"]
        self.assertEqual(lock[""]["dependencies"], self.package["dependencies"])
        for name, package in lock.items():
            self.assertTrue(name == "" or package["integrity"].startswith("sha512-"), name)
        first = re.compile(self.package["contributes"]["languages"][0]["firstLine"])
        for line, is_program in (("0 BEGIN PGM 8255 MM", True), ("BEGIN PGM A MM", True), ("%A G71 *", True), ("#include <a>", False)):
            self.assertEqual(bool(first.match(line)), is_program, line)

    @unittest.skipUnless(os.environ.get("TESTS_DEEP") and shutil.which("npm"), "TESTS_DEEP=1 and npm run it")
    def test_it_is_built(self):
        made = subprocess.run([SOURCES / "build"], capture_output=True, text=True, check=True).stdout.splitlines()[-1]
        with zipfile.ZipFile(pathlib.Path(made)) as archive:
            manifest = xml.etree.ElementTree.fromstring(archive.read("extension.vsixmanifest"))
            self.assertEqual(json.loads(archive.read("extension/package.json")), self.package)
            self.assertIn(b"vscode-languageclient 9", archive.read("extension/licences.txt"))
            code = archive.read("extension/extension.js")
        self.assertEqual(manifest.find(".//{*}Identity").get("Id"), self.package["name"])
        subprocess.run(["node", "--check", "-"], input=code, check=True)


if __name__ == "__main__":
    unittest.main()
