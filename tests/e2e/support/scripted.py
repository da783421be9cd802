"""A server that answers as it is told: what a client does when things go wrong."""

import socket
import threading


def answer(status, body=b"{}", *fields, close=False):
    """An answer with a length."""
    lines = [f"HTTP/1.1 {status} X", f"Content-Length: {len(body)}", "Content-Type: application/json", *fields]
    if close:
        lines.append("Connection: close")
    return "\r\n".join(lines).encode() + b"\r\n\r\n" + body


def problem(status, code, *fields):
    return answer(status, f'{{"code":"{code}","status":{status}}}'.encode(), *fields)


class Request:
    """What arrived: the request line, the fields (names in lower case) and the body."""

    def __init__(self, head, body):
        self.line, *fields = head.split("\r\n")
        self.headers = {name.lower(): value for name, value in (field.split(": ", 1) for field in fields)}
        self.body = body


class ScriptedServer:
    """Gives one entry of `script` for each request: bytes to send, or None to hang up; after an answer with
    `Connection: close` or without a length it hangs up too."""

    def __init__(self, *script):
        self.script = list(script)
        self.requests = []
        self.connections = 0
        self.socket = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self.socket.getsockname()[1]}"
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def close(self):
        self.socket.close()

    def serve(self):
        while self.script:
            try:
                connection, _ = self.socket.accept()
            except OSError:
                return
            self.connections += 1
            with connection, connection.makefile("rb") as source:
                while self.script and self.exchange(connection, source):
                    pass

    def exchange(self, connection, source):
        """One request; whether the connection stays."""
        head = b""
        while not head.endswith(b"\r\n\r\n"):
            line = source.readline()
            if not line:
                return False
            head += line
        request = Request(head[:-4].decode(), b"")
        request.body = source.read(int(request.headers.get("content-length", "0")))
        self.requests.append(request)
        reply = self.script.pop(0)
        if reply is None:
            return False
        connection.sendall(reply)
        return b"Content-Length" in reply and b"Connection: close" not in reply
