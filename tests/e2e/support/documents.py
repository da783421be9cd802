"""The commands of a document, run as a reader would: in its order, one shell, a service of its own.

A fenced block says in its first line what becomes of it:

    sh            is run; it ends with 0, no curl in it gets an error, and it prints what stands behind #→
    console       lines with `$ ` are run, and what stands below each is what it prints; … is any text
    python        is run
    … needs-X     is run where the Python module X can be imported, and else only compiled
    sh not-run    is only read by the shell: it needs a container engine or builds the product
    sh example    is only read by the shell: it needs a device, a control or another machine

A block without a language holds no command. The shell of the blocks has no variable of the test's: `fitgauge` and
`curl` find the service at the default address, as they do for a reader.
"""

import importlib.util
import os
import pathlib
import re
import signal
import stat
import subprocess
import sys
import tempfile
import textwrap

from support.cli import FITGAUGE
from support.daemon import FITGAUGED, ROOT
from support.ports import free_port
from support.waiting import PATIENCE

BLOCK = re.compile(r"^( *)```([^\n]*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
# Where a document names a place of the machine, the test has a folder of its own.
PLACES = re.compile(r"(?<![\w./:$-])/(backup|restore|etc|usr/local|usr/share|var/lib)\b")

# The programs as a reader has them on the PATH, with the test's service behind the default address.
FITGAUGE_AT_PORT = """#!/bin/bash
export FITGAUGE_SERVER="${{FITGAUGE_SERVER:-http://127.0.0.1:{port}}}"
exec {program} "$@"
"""

# curl as it is, but: localhost:8286 is the test's service, an error is an error, and what has no end is
# read for a second.
CURL = """#!/bin/bash
options=(--connect-to "localhost:8286:127.0.0.1:$DOCS_TEST_PORT" --show-error --max-time 60)
[[ " $* " == *" --fail "* ]] || options+=(--fail-with-body)
if [[ " $* " =~ " -N " || " $* " =~ " -sN " ]] && [[ "$*" == */v1/events* || "$*" == *text/event-stream* ]]; then
  /usr/bin/curl "${options[@]}" --max-time 1 "$@" || [ $? = 28 ]
else
  exec /usr/bin/curl "${options[@]}" "$@"
fi
"""

# The service manager of a machine with one service. A process that is no more, or not waited for, has no exe.
SYSTEMCTL = """#!/bin/bash
case "$*" in
  "enable --now fitgauged" | "start fitgauged")
    [ -e "$DOCS_TEST_STATE/pid" ] && exit 0
    rm -f "$DOCS_TEST_STATE/port"
    "$DOCS_TEST_BINARY" --listen "127.0.0.1:$DOCS_TEST_PORT" --data "$DOCS_TEST_DATA" \\
      --port-file "$DOCS_TEST_STATE/port" --log-level warning \\
      >> "$DOCS_TEST_STATE/log" 2>&1 < /dev/null &
    echo $! > "$DOCS_TEST_STATE/pid"
    until [ -e "$DOCS_TEST_STATE/port" ]; do
      [ -e "/proc/$(cat "$DOCS_TEST_STATE/pid")/exe" ] || { cat "$DOCS_TEST_STATE/log" >&2; exit 1; }
      sleep 0.02
    done ;;
  "stop fitgauged")
    pid=$(cat "$DOCS_TEST_STATE/pid") && rm "$DOCS_TEST_STATE/pid"
    kill "$pid"
    while [ -e "/proc/$pid/exe" ]; do sleep 0.02; done ;;
  "reload fitgauged") kill -HUP "$(cat "$DOCS_TEST_STATE/pid")" ;;
  *) echo "systemctl $*: the test knows no such command" >&2; exit 2 ;;
esac
"""


class Block:
    """A fenced block with the line its text begins on."""

    def __init__(self, document, match):
        self.document = document
        self.line = document.count("\n", 0, match.start()) + 2
        self.language, *flags = match[2].split() or [""]
        self.flags = set(flags)
        self.modules = [flag.removeprefix("needs-") for flag in flags if flag.startswith("needs-")]
        self.text = textwrap.dedent(match[3])

    def commands(self):
        """Of `console`: each command with what it prints. A command goes on after a line that ends in \\."""
        found = []
        for line in self.text.splitlines():
            if line.startswith("$ "):
                found.append([line[2:], ""])
            elif found and not found[-1][1] and found[-1][0].endswith("\\"):
                found[-1][0] += "\n" + line.removeprefix("> ")
            else:
                found[-1][1] += line + "\n"
        return found


def blocks(path):
    text = path.read_text(encoding="utf-8")
    return [Block(text, match) for match in BLOCK.finditer(text)]


def squeezed(text):
    return re.sub(r"\s+", "", text)


def agrees(shown, printed):
    """Line breaks and blanks do not count."""
    pattern = ".*?".join(re.escape(squeezed(part)) for part in shown.split("…"))
    return re.fullmatch(pattern, squeezed(printed), re.DOTALL) is not None


class Reader:
    """A folder that looks like the repository, a service, and a shell that keeps its directory and variables."""

    def __init__(self, installed=True):
        """@param installed  the programs are on the PATH; else the reader has built them and no more."""
        self.holder = tempfile.TemporaryDirectory(prefix="fitgauge-docs-")
        self.folder = pathlib.Path(self.holder.name)
        self.state = self.folder / "state"
        self.tree = self.folder / "fitgauge"
        self.data = self.folder / "var/lib/fitgauge"
        for name in ("state", "fitgauge/build/release/bin", "var/lib/fitgauge", "bin", "backup", "etc/systemd/system",
                     "usr/local/bin", "usr/share/bash-completion/completions"):
            (self.folder / name).mkdir(parents=True)
        for path in ROOT.iterdir():
            if not (self.tree / path.name).exists():
                (self.tree / path.name).symlink_to(path)
        port = str(free_port())
        self.provide("curl", CURL)
        self.provide("systemctl", SYSTEMCTL)
        built = self.tree / "build/release/bin"
        self.provide(built / "fitgauge", FITGAUGE_AT_PORT.format(port=port, program=pathlib.Path(FITGAUGE).resolve()))
        (built / "fitgauged").symlink_to(pathlib.Path(FITGAUGED).resolve())
        self.environment = {
            **{name: value for name, value in os.environ.items() if not name.startswith(("FITGAUGE", "XDG_"))},
            "HOME": str(self.folder), "LC_ALL": "C.UTF-8",
            "PATH": f"{self.folder}/bin:{str(built) + ':' if installed else ''}{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}",
            "DOCS_TEST_STATE": str(self.state), "DOCS_TEST_DATA": str(self.data),
            "DOCS_TEST_BINARY": str(pathlib.Path(FITGAUGED).resolve()), "DOCS_TEST_PORT": port,
            "PYTHONPATH": str(ROOT / "clients/python"), "PYTHONDONTWRITEBYTECODE": "1"}
        self.server = f"http://127.0.0.1:{port}"
        for name, text in (("environment", ""), ("directory", str(self.tree))):
            (self.state / name).write_text(text)
        self.shell("systemctl start fitgauged")

    def close(self):
        if (self.state / "pid").exists():
            os.kill(int((self.state / "pid").read_text()), signal.SIGKILL)
        self.holder.cleanup()

    def provide(self, name, text):
        path = self.folder / "bin" / name
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def placed(self, text):
        return PLACES.sub(rf"{self.folder}/\1", text)

    def shell(self, text):
        """Runs shell text; gives its output. Errors are AssertionErrors."""
        script = (f'cd "$(cat {self.state}/directory)"\n. {self.state}/environment\n{self.placed(text)}\n'
                  f"pwd > {self.state}/directory\nexport -p > {self.state}/environment\n")
        return self.check(["bash", "-euo", "pipefail", "-c", script], text)

    def python(self, text):
        directory = (self.state / "directory").read_text().strip()
        return self.check([sys.executable, "-W", "error", "-c", self.placed(text)], text, directory,
                          {"FITGAUGE_SERVER": self.server})

    def check(self, command, text, directory=None, variables=None):
        done = subprocess.run(command, capture_output=True, text=True, timeout=3 * PATIENCE, check=False, cwd=directory,
                              stdin=subprocess.DEVNULL, env={**self.environment, **(variables or {})})
        if done.returncode != 0:
            raise AssertionError(f"{text}\nended with {done.returncode}: {done.stdout}{done.stderr}")
        return done.stdout

    def run(self, block):
        if block.flags & {"not-run", "example"}:
            self.check(["bash", "-n", "-c", block.text], block.text)
        elif block.language == "sh":
            printed = self.shell(block.text)
            for part in re.findall(r"#→ (.*)$", block.text, re.MULTILINE):
                if part not in printed:
                    raise AssertionError(f"{block.text}\nprints\n{printed}\nand not\n{part}")
        elif block.language == "python" and not all(map(importlib.util.find_spec, block.modules)):
            compile(block.text, "document", "exec")
        elif block.language == "python":
            self.python(block.text)
        elif block.language == "console":
            for command, shown in block.commands():
                printed = self.shell(command)
                if not agrees(shown, printed):
                    raise AssertionError(f"{command}\nprints\n{printed}\nand not\n{shown}")
