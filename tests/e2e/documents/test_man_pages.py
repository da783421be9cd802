"""The client's man pages and its completion say what the programs do."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support.cli import FITGAUGE
from support.daemon import FITGAUGED, ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import man_pages  # noqa: E402

SUBCOMMANDS = [command.words for command in man_pages.commands(FITGAUGE) if command.words]


def options(program, *command):
    """The long options that --help names."""
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", done.stdout))


def own_options(*command):
    return options(FITGAUGE, *command) - options(FITGAUGE) - {"--help"}


def completions(*words):
    """What bash offers for the last word."""
    script = ('eval "$("$FITGAUGE" completion bash)"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
              '_fitgauge; printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-uc", script, "bash", "fitgauge", *words], capture_output=True,
                          text=True, check=False, env={**os.environ, "FITGAUGE": FITGAUGE})
    if done.returncode != 0 or done.stderr:
        raise AssertionError(done.stderr)
    return set(done.stdout.split())


class Manual(unittest.TestCase):
    def page(self, name):
        return (ROOT / "docs/man" / name).read_text(encoding="utf-8")

    @unittest.skipUnless(shutil.which("mandoc"), "needs mandoc")
    def test_the_pages_are_well_formed(self):
        for name in ("fitgauge.1", "fitgauged.8"):
            with self.subTest(name):
                done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", ROOT / "docs/man" / name],
                                      capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_help_names_kinds_and_ranges_of_values(self):
        done = subprocess.run([FITGAUGED, "--help"], capture_output=True, text=True, check=True).stdout
        for name, least, most in (("io-threads", 1, 64), ("write-queue", 1, 1000000), ("event-retention", 100, 10000000)):
            self.assertRegex(done, rf"--{name} NUMBER\s+[^\n]*\({least} to {most}\)")
        ranges = re.findall(r"^  --([a-z-]+) NUMBER\s+[^\n]*\((\d+ to \d+)\)", done, re.MULTILINE)
        self.assertEqual(len(ranges), 8)
        for name, kind in (("tls-cert", "FILE"), ("listen", "HOST:PORT"), ("data", "FOLDER"), ("database", "URL")):
            self.assertIn(f"--{name} {kind} ", done)
        client = subprocess.run([FITGAUGE, "gauge", "--help"], capture_output=True, text=True, check=True).stdout
        for option in ("--uncertainty-um NUMBER", "--measured-at TIME", "--baud NUMBER", "measured NUMBER"):
            self.assertIn(option, client)
        for command, kind in ((("nc", "check"), "FILE"), (("nc", "run"), "FILE"), (("replay",), "NAME")):
            with self.subTest(command):
                client = subprocess.run([FITGAUGE, *command, "--help"], capture_output=True, text=True, check=True).stdout
                self.assertIn(f"--setup {kind} ", client)
                self.assertEqual(bool(completions(*command, "x", "--setup", f"{ROOT}/docs/man/f")), kind == "FILE")
                fish = subprocess.run([FITGAUGE, "completion", "fish"], capture_output=True, text=True, check=True).stdout
                offer = next(line for line in fish.splitlines() if f"from {command[-1]}' -l setup " in line)
                self.assertEqual(offer.endswith(" -r -F"), kind == "FILE")
        self.assertRegex(subprocess.run([FITGAUGE, "list", "--help"], capture_output=True, text=True, check=True).stdout,
                         r"--limit NUMBER.*1.*1000")

    def test_every_argument_has_a_text(self):
        arguments = [(command.words, each) for program in (FITGAUGE, FITGAUGED) for command in man_pages.commands(program)
                     for each in command.arguments]
        self.assertGreater(len(arguments), 50)
        self.assertEqual([words for words, each in arguments if not each.text], [])

    def test_help_ends_with_the_default_of_a_setting(self):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("FITGAUGE_")}
        def printed(flag):
            return subprocess.run([FITGAUGED, flag], capture_output=True, text=True, check=True, env=environment).stdout
        defaults = {key: value.strip('[]"') for key, value in re.findall(r"^(\w+) = (.+)$", printed("--print-config"), re.MULTILINE)
                    if value not in ("false", "[]", '""')}
        self.assertGreater(len(defaults), 12)
        told = dict(re.findall(r"^  --([\w-]+) \S+(?: \.\.\.)?\s+.* \(default: ([^\n]*)\)$", printed("--help"), re.MULTILINE))
        self.assertEqual(told, {key.replace("_", "-"): value for key, value in defaults.items()})

    def test_every_exit_code_is_in_the_manual(self):
        source = (ROOT / "clients/cli/outcome.hpp").read_text(encoding="utf-8")
        codes = re.findall(r"^  \w+ = (\d+),", source, re.MULTILINE)
        section = self.page("fitgauge.1").split(".Sh EXIT STATUS")[1].split(".Sh ")[0]
        self.assertEqual(re.findall(r"^\.It (\d+)$", section, re.MULTILINE), codes)


class Completion(unittest.TestCase):
    def test_every_command_is_offered(self):
        self.assertEqual(completions(""), {words[0] for words in SUBCOMMANDS})
        self.assertEqual(completions("im"), {"import"})
        self.assertEqual(completions("nc", ""), {"check", "convert", "format", "lsp", "run", "put", "get", "ls"})
        self.assertEqual(completions("setups", ""), {"ls", "put", "get", "rm"})
        self.assertEqual(completions("runs", ""), {"ls", "show", "get", "cancel"})
        self.assertEqual(completions("control", ""), {"ls", "get", "put", "run", "state"})
        self.assertEqual(completions("--server", "x", "--json", "tables", ""), {"export", "set", "reset"})

    def test_every_option_is_offered_where_it_is_taken(self):
        common = options(FITGAUGE)
        self.assertEqual(completions("--"), common)
        for command in SUBCOMMANDS:
            with self.subTest(command):
                self.assertEqual(completions(*command, "--"),
                                 own_options(*command) | common - {"--version"})

    def test_words_that_an_option_or_a_command_takes(self):
        self.assertEqual(completions("tables", "export", ""), {"hole", "shaft"})
        self.assertEqual(completions("tables", "reset", ""), {"hole", "shaft"})
        self.assertEqual(completions("tables", "export", "hole", ""), set())
        self.assertEqual(completions("tables", "export", "hole", "--format", ""), {"csv", "json", "tab"})
        self.assertEqual(completions("export", "--format", ""), {"csv", "ndjson", "dfq", "qif", "xlsx"})
        self.assertEqual(completions("watch", "--source", "s"), {"simulation"})
        self.assertEqual(completions("completion", ""), {"bash", "fish", "zsh"})
        self.assertEqual(completions("gauge", "25H7", "--part-id", ""), set())

    def test_fish_and_zsh_know_every_command_and_option(self):
        for shell in ("fish", "zsh"):
            script = subprocess.run([FITGAUGE, "completion", shell], capture_output=True, text=True, check=True).stdout
            dashes = "-l " if shell == "fish" else "--"
            for command in SUBCOMMANDS:
                with self.subTest(shell, command=command):
                    self.assertRegex(script, rf"\b{command[-1]}\b")
                    for option in own_options(*command):
                        self.assertRegex(script, rf"{dashes}{option[2:]}\b")
            if shutil.which(shell):
                subprocess.run([shell, "-n", "/dev/stdin"], input=script, text=True, check=True, timeout=60)

    def test_those_of_all_shells_are_installed(self):
        build = pathlib.Path(FITGAUGE).resolve().parents[1]
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["cmake", "--install", build, "--prefix", folder], capture_output=True, check=True, timeout=300)
            for shell, file in (("bash", "bash-completion/completions/fitgauge"), ("zsh", "zsh/vendor-completions/_fitgauge"),
                                ("fish", "fish/vendor_completions.d/fitgauge.fish")):
                script = subprocess.run([FITGAUGE, "completion", shell], capture_output=True, text=True, check=True).stdout
                self.assertEqual((pathlib.Path(folder) / "share" / file).read_text(encoding="utf-8"), script, shell)

    @unittest.skipUnless(shutil.which("fish"), "needs fish")
    def test_what_fish_offers(self):
        def offered(line):
            script = f"{FITGAUGE} completion fish | source; complete -C {line!r}"
            done = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, check=True, timeout=60)
            return {entry.split("\t")[0] for entry in done.stdout.splitlines()}
        self.assertEqual(offered("fitgauge im"), {"import"})
        self.assertEqual(offered("fitgauge nc "), {"ls", "put", "get", "check", "convert", "format", "lsp", "run"})
        self.assertLessEqual({"--setup", "--on-stop"}, offered("fitgauge nc run --"))

    def test_files_are_offered_where_a_file_is_wanted(self):
        folder = str(ROOT / "docs/man") + "/"
        pages = {folder + "fitgauge.1", folder + "fitgauged.8"}
        for words in (("measure",), ("nc", "put"), ("nc", "put", "x"), ("--key-file",), ("control", "put", "tnc"),
                      ("nc", "run", "x", "--setup-file")):
            with self.subTest(words):
                self.assertEqual(completions(*words, folder + "f"), pages)
