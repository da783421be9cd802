"""An editor's side of the language server: messages of JSON-RPC over the pipes of `fitgauge nc lsp`."""

import json
import pathlib
import queue
import subprocess
import threading

from support.cli import FITGAUGE
from support.waiting import PATIENCE


def frame(message):
    """A message as bytes with its header."""
    body = message if isinstance(message, bytes) else json.dumps(message).encode()
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


class LanguageClient:
    """A server with the folder that its programs lie in; `text` holds the programs as the editor has them."""

    def __init__(self, folder, snippets=True, options=()):
        self.folder = pathlib.Path(folder)
        self.process = subprocess.Popen([FITGAUGE, "nc", "lsp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)
        self.messages = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()
        self.snippets = snippets
        self.last_id = 0
        self.text = {}
        self.version = 0

    def _read(self):
        while header := self.process.stdout.readline():
            length = int(header.removeprefix(b"Content-Length: "))
            self.process.stdout.readline()
            self.messages.put(json.loads(self.process.stdout.read(length)))
        self.messages.put(None)

    def send(self, message):
        self.send_bytes(frame(message))

    def send_bytes(self, content):
        self.process.stdin.write(content)
        self.process.stdin.flush()

    def receive(self):
        """The next message; None when the server has ended."""
        return self.messages.get(timeout=PATIENCE)

    def notify(self, method, **params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def ask(self, method, **params):
        """The whole answer; what comes before it is dropped."""
        self.last_id += 1
        self.send({"jsonrpc": "2.0", "id": self.last_id, "method": method, "params": params})
        while (message := self.receive()) is not None and message.get("id") != self.last_id:
            pass
        return message

    def initialize(self):
        item = {"snippetSupport": self.snippets}
        answer = self.ask("initialize", processId=None, rootUri=None,
                          capabilities={"textDocument": {"completion": {"completionItem": item}}})
        self.notify("initialized")
        return answer["result"]

    def uri(self, name):
        return (self.folder / name).as_uri()

    def open(self, name, text):
        """Opens a program and gives its findings."""
        self.text[name] = text
        self.version += 1
        self.notify("textDocument/didOpen", textDocument={"uri": self.uri(name), "languageId": "klartext",
                                                          "version": self.version, "text": text})
        return self.findings()

    def change(self, name, *changes):
        self.version += 1
        self.notify("textDocument/didChange", textDocument={"uri": self.uri(name), "version": self.version},
                    contentChanges=list(changes))
        return self.findings()

    def findings(self):
        while (message := self.receive()) is not None:
            if message.get("method") == "textDocument/publishDiagnostics":
                return message["params"]["diagnostics"]
        raise AssertionError("the server has ended")

    def at(self, method, name, line, character, **more):
        """The answer to a request about a place."""
        return self.ask(f"textDocument/{method}", textDocument={"uri": self.uri(name)},
                        position={"line": line, "character": character}, **more)

    def actions(self, name, line):
        place = {"line": line, "character": 0}
        return self.ask("textDocument/codeAction", textDocument={"uri": self.uri(name)},
                        range={"start": place, "end": place}, context={"diagnostics": []})["result"]

    def applied(self, name, edits):
        """The text of a program with the edits of an answer."""
        lines = self.text[name].split("\n")
        for edit in sorted(edits, key=lambda each: (each["range"]["start"]["line"], each["range"]["start"]["character"]),
                           reverse=True):
            start, end = edit["range"]["start"], edit["range"]["end"]
            behind = units(lines[end["line"]])[end["character"]:]
            before = units(lines[start["line"]])[:start["character"]]
            lines[start["line"]:end["line"] + 1] = (text_of(before) + edit["newText"] + text_of(behind)).split("\n")
        return "\n".join(lines)

    def end(self):
        """Ends it as an editor does; gives the exit code."""
        self.ask("shutdown")
        self.notify("exit")
        return self.process.wait(PATIENCE)

    def close(self):
        self.process.kill()
        self.process.wait(PATIENCE)
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            pipe.close()


def units(text):
    """The UTF-16 code units of a text."""
    content = text.encode("utf-16-le")
    return [content[i:i + 2] for i in range(0, len(content), 2)]


def text_of(code_units):
    return b"".join(code_units).decode("utf-16-le")
