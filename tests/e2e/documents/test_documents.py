"""What the documents say is what the service does."""

import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as tree
from pathlib import Path

from support.cli import FITGAUGE
from support.daemon import FITGAUGED, ROOT, DaemonTest
from support.documents import Reader, agrees, blocks

sys.path.insert(0, str(ROOT / "scripts"))
import man_pages  # noqa: E402

DOCUMENTS = [ROOT / "README.md", ROOT / "clients/python/README.md", *sorted((ROOT / "docs").glob("tutorial/*.md")),
             *sorted((ROOT / "docs").glob("guide/*.md")), *sorted((ROOT / "docs").glob("explanation/*.md"))]
# Their readers have built the programs and installed nothing.
BUILT_ONLY = {ROOT / "README.md", *(ROOT / "docs/tutorial").glob("*.md")}
LANGUAGES = {"sh", "console", "python", "json", "ini", "toml", "nginx", "mermaid", ""}


def prose(path):
    """The text of a page without its blocks of code."""
    return re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)


def anchors(path):
    """What a link can name in a page: its headings in small letters, without punctuation, with hyphens for blanks."""
    return {re.sub(r"[^\w -]", "", re.sub(r"\]\([^)]*\)", "", heading).lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ +(.*?) *$", prose(path), re.MULTILINE)}


class Reference(DaemonTest):
    def test_the_reference_pages_are_what_the_service_says(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/docs", "--check", "--daemon", FITGAUGED],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Commands(unittest.TestCase):
    def test_the_commands_of_each_document_do_what_it_says(self):
        for path in DOCUMENTS:
            with self.subTest(path.relative_to(ROOT)):
                self.follow(path)

    def follow(self, path):
        reader = Reader(installed=path not in BUILT_ONLY)
        self.addCleanup(reader.close)
        for block in blocks(path):
            self.assertIn(block.language, LANGUAGES, f"{path.name}:{block.line}")
            try:
                reader.run(block)
            except AssertionError as error:
                raise AssertionError(f"{path.name}:{block.line}: {error}") from None

    def test_an_old_curl_can_do_what_is_shown(self):
        """Debian 11 has curl 7.74; these came later."""
        for path in DOCUMENTS:
            for block in blocks(path):
                for command in re.findall(r"curl (?:[^\n]|(?<=\\\\)\n)*", block.text):
                    self.assertNotRegex(command, r"--json|%header\{|--fail-with-body|--url-query|--variable|--remove-on-error",
                                        f"{path.name}:{block.line}")

    def test_scripts_run_builds_what_the_documents_install(self):
        built = re.findall(r"--target (\w+)", (ROOT / "scripts/run").read_text(encoding="utf-8"))
        installed = {name for path in DOCUMENTS for block in blocks(path)
                     for name in re.findall(r"build/release/bin/(\w+)", block.text)}
        self.assertEqual(installed, set(built))

    def test_few_blocks_are_not_run(self):
        not_run = [block for path in DOCUMENTS for block in blocks(path) if "not-run" in block.flags]
        self.assertLessEqual(len(not_run), 5)
        for block in not_run:
            self.assertRegex(block.text, r"^(docker|scripts/(run|test|package)) ", "it could be run")

    def test_an_example_needs_what_the_test_has_not(self):
        for path in DOCUMENTS:
            for block in blocks(path):
                if "example" in block.flags:
                    self.assertRegex(block.text, r"10\.0\.0\.\d|\.example\b|/dev/tty", f"{path.name}:{block.line}: it could be run")

    def test_commands_are_in_blocks_that_say_so(self):
        for path in DOCUMENTS:
            for block in blocks(path):
                if not block.language:
                    self.assertNotRegex(block.text, r"(?m)^(\$ )?(fitgauged?|curl|scripts/\w+) ", f"{path.name}:{block.line}")

    def test_guides_open_with_their_reader_and_end_with_faults(self):
        for path in [*(ROOT / "docs/tutorial").glob("*.md"), *(ROOT / "docs/guide").glob("*.md")]:
            text = path.read_text(encoding="utf-8")
            faults = text.count("\n## If something goes wrong\n")
            if path.name == "troubleshooting.md":  # it is nothing else
                continue
            with self.subTest(path.name):
                self.assertRegex(text, r"\A# [^\n]+\n\nFor [^.]+\.\s(?s:.{0,200}?)At\sthe\send\s", "its reader and result")
                self.assertEqual(faults, 1)

    def test_links_lead_to_files_and_headings(self):
        count = 0
        for path in [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "clients").glob("*/README.md")]:
            for target, heading in re.findall(r"\]\(([^)#:]*)(?:#([^)]*))?\)", prose(path)):
                there = path.parent / target if target else path
                self.assertTrue(there.exists(), f"{path.name}: {target}")
                if heading:
                    self.assertIn(heading, anchors(there), f"{path.name}: {target}")
                    count += 1
        self.assertGreater(count, 30)

    def test_each_integration_has_the_same_headings(self):
        for name in ("webhooks", "mqtt", "sparkplug", "folders", "mtconnect", "controls"):
            headings = re.findall(r"^## (.*)$", prose(ROOT / f"docs/guide/{name}.md"), re.MULTILINE)
            with self.subTest(name):
                self.assertEqual((headings[:3], headings[-1]), (["What you get", "Set it up", "Check that it works"],
                                                                "If something goes wrong"))

    def test_drawings_are_shown_and_legible_in_both_modes(self):
        pages = "".join(path.read_text(encoding="utf-8") for path in DOCUMENTS)
        drawings = sorted((ROOT / "docs/images").glob("*.svg"))
        self.assertGreaterEqual(len(drawings), 3)
        for path in drawings:
            root = tree.parse(path).getroot()
            parts = {each.tag.rsplit("}")[-1]: each.text for each in root}
            self.assertRegex(pages, rf"!\[[^\]]{{20,}}\]\(\.\./images/{re.escape(path.name)}\)")
            self.assertTrue(parts["title"] and parts["desc"], path.name)
            self.assertIn("prefers-color-scheme: dark", parts["style"], path.name)
            width = float(root.get("width"))
            for text in root.iter("{http://www.w3.org/2000/svg}text"):  # of 14 px: 7.2 a letter
                room = {"middle": 2 * min(float(text.get("x")), width - float(text.get("x")))}.get(
                    text.get("text-anchor"), width - float(text.get("x")))
                self.assertLessEqual(7.2 * len(text.text), room, f"{path.name}: {text.text}")

    def test_the_index_names_every_document(self):
        for path in (ROOT / "docs").rglob("*.md"):
            if path.name != "README.md":
                pieces = path.parent.with_suffix(".md")  # the page that lists the pages of its folder
                index = pieces if pieces.exists() else ROOT / "docs/README.md"
                self.assertRegex(index.read_text(encoding="utf-8"), rf"\({re.escape(str(path.relative_to(index.parent)))}[#)]")

    def test_each_path_setting_and_command_is_in_a_guide(self):
        """Or in the list of docs/README.md, with the reason."""
        listed = (ROOT / "docs/README.md").read_text(encoding="utf-8").split("## Not in a guide")[1]
        paths, settings, commands = self.unnamed(lambda guides: guides)
        self.assertEqual(paths, set(re.findall(r"\| `(/\S+)` \|", listed)))
        self.assertEqual(settings, set())
        self.assertEqual(commands, {tuple(name.split()) for name in re.findall(r"`(fitgauge \w+) …`", listed)})

    def test_a_path_a_setting_and_a_command_that_no_guide_names_are_found(self):
        known = self.unnamed(lambda guides: guides)
        for which, name, found in ((0, r"/v1/press-fits", "/v1/press-fits"), (1, r"io_threads|--io-threads", "io_threads"),
                                   (1, r"`?listen`? ?=|--listen", "listen"), (2, r"nc convert", ("fitgauge", "nc"))):
            self.assertEqual(self.unnamed(lambda guides, name=name: re.sub(name, "", guides))[which], known[which] | {found})

    def unnamed(self, change):
        """@returns the paths of the API, the settings and the commands that no guide, as `change` gives them, names"""
        guides = change("".join(path.read_text(encoding="utf-8") for path in DOCUMENTS))
        paths = set(re.findall(r"^\| `[A-Z]+ (/\S*)`", (ROOT / "docs/reference/api.md").read_text(encoding="utf-8"), re.MULTILINE))
        settings = re.findall(r"^\| `(\w+)` \| `(--[\w-]+)` \| `(FITGAUGE_\w+)`",
                              (ROOT / "docs/reference/configuration.md").read_text(encoding="utf-8"), re.MULTILINE)
        commands = {(program.name, *command.words) for program in map(Path, (FITGAUGE, FITGAUGED)) for command in man_pages.commands(program)}
        self.assertGreater(min(len(paths), len(settings), len(commands)), 30)
        return ({path for path in paths if not re.search(re.sub(r"\\\{\w+\\\}", r"[^/\\s`?]+", re.escape(path)) + r"(?![/\w.-])", guides)},
                {name for name, option, variable in settings
                 if not re.search(rf"`{name}`|^ *{name} = |{option}(?![\w-])|{variable}(?!\w)", guides, re.MULTILINE)},
                {words[:2] for words in commands if len(words) > 1 and
                 not re.search(rf"{words[0]}( --[\w-]+ \S+)* {' '.join(words[1:])}(?![\w-])", guides)})

    def test_the_page_on_decisions_has_every_warning(self):
        sources = (ROOT / "server/record/verdict_codec.cpp", ROOT / "server/api/measurements/measurement_posting.cpp")
        codes = {code for path in sources for code in re.findall(r'\{"([a-z_]+\.[a-z_]+)"', path.read_text(encoding="utf-8"))}
        page = (ROOT / "docs/explanation/decision-rules.md").read_text(encoding="utf-8").split("## Warnings")[1].split("\n## ")[0]
        self.assertEqual(set(re.findall(r"^\| `(\S+)` \|", page, re.MULTILINE)), codes)
        self.assertGreater(len(codes), 4)

    def test_what_is_shown_is_compared(self):
        self.assertTrue(agrees('{"a":1,…\n "c":3}\n', '{"a":1,"b":2,"c":3}'))
        self.assertFalse(agrees('{"a":1,…"c":3}', '{"a":1,"b":2,"c":4}'))
        self.assertFalse(agrees("", "something"))
        reader = Reader()
        self.addCleanup(reader.close)
        for command in ("false", "curl localhost:8286/v1/limits/7H", "true | false"):
            with self.assertRaises(AssertionError):
                reader.shell(command)
        with self.assertRaises(AssertionError):
            reader.python("assert 1 == 2")
        self.assertEqual(reader.shell("cd clients && x=1") + reader.shell("echo $(basename $PWD)"), "clients\n")
