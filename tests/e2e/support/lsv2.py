"""A client of LSV-2 on a raw socket: telegrams as a control's peers send them, and nothing of ours."""

import re
import socket
import struct

from support.waiting import PATIENCE, wait_for


def control_port(daemon, starts=1):
    """Of its last start; the log is written a moment after it."""
    listening = r'"event":"control_listening","detail":"[^"]* on port (\d+),'
    return int(wait_for(lambda: re.findall(listening, daemon.log)[starts - 1:])[0])


def served(port, *logins):
    """A client that the control serves: of a hundred, the place of one that has left is free a moment later."""
    def logged_in():
        client = Client(port)
        try:
            return client.login("INSPECT", *logins)
        except OSError:
            client.close()
            return None
    return wait_for(logged_in, "a place at the control")


def turned_away(port, count):
    """What so many clients read that come to a control which has as many as it takes; a hundred come together."""
    for _ in range(0, count, 100):
        clients = [Client(port) for _ in range(100)]
        for client in clients:
            with client:
                yield client.read()


class Refused(Exception):
    """T_ER: the control's code."""

    def __init__(self, code):
        super().__init__(f"T_ER {code}")
        self.code = code


def text(value):
    return value.encode("latin-1") + b"\0"


def telegram(name, payload=b""):
    return struct.pack("!L", len(payload)) + name.encode() + payload


class Client:
    def __init__(self, port, timeout=PATIENCE):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout)
        self.bytes = self.socket.makefile("rb")
        self.buffer = 256

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.bytes.close()
        self.socket.close()

    def read(self):
        """The next telegram: name and payload; None where the control has closed."""
        head = self.bytes.read(8)
        if len(head) < 8:
            return None
        length, name = struct.unpack("!L4s", head)
        return name.decode(), self.bytes.read(length)

    def ask(self, name, payload=b""):
        self.socket.sendall(telegram(name, payload))
        answer = self.read()
        if answer is None:
            raise ConnectionError("the control has closed the connection")
        if answer[0] == "T_ER":
            raise Refused(answer[1][1])
        return answer

    def login(self, *names):
        for name in names:
            self.ask("A_LG", text(name))
        return self

    def info(self, which):
        return self.ask("R_RI", struct.pack("!H", which))[1]

    def state(self):
        return struct.unpack("!H", self.info(26))[0]

    def listing(self, directory):
        """name → (bytes, flags)"""
        self.ask("C_DC", text(directory))
        entries = {}
        answer = self.ask("R_DR", b"\0")
        while answer[0] == "S_DR":
            size, _, flags = struct.unpack("!3L", answer[1][:12])
            entries[answer[1][12:-1].decode("latin-1")] = (size, flags)
            answer = self.ask("T_OK")
        assert answer == ("T_FD", b""), answer
        return entries

    def download(self, path, mode=1):
        answer = self.ask("R_FL", text(path) + bytes([mode]))
        content = b""
        while answer[0] == "S_FL":
            assert 8 + len(answer[1]) < self.buffer
            content += answer[1]
            answer = self.ask("T_OK")
        assert answer == ("T_FD", b""), answer
        return content

    def upload(self, path, content, mode=1):
        """With C_CC 19 before it, so that the end is answered."""
        self.ask("C_CC", struct.pack("!H", 19))
        self.ask("C_FL", text(path) + bytes([mode]))
        step = self.buffer - 10
        for start in range(0, len(content), step):
            self.ask("S_FL", content[start:start + step])
        return self.ask("T_FD")

    def agree_buffer(self):
        self.ask("C_CC", struct.pack("!H", 7))
        self.buffer = 4096
