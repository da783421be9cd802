"""A receiver of webhooks that does what a test tells it."""

import http.server
import json
import threading

from support.waiting import wait_for


class Receiver:
    """`answer` is called with each request's event, in order: a status, or (status, fields). `events` are those that
    were answered 2xx, with their fields."""

    def __init__(self, answer=lambda event: 204, tls=None):
        self.answer = answer
        self.attempts = []
        self.events = []
        receiver = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):
                body = self.rfile.read(int(self.headers["content-length"]))
                headers = {name.lower(): value for name, value in self.headers.items()}
                request = {"headers": headers, "body": body, "event": json.loads(body)}
                receiver.attempts.append(request)
                said = receiver.answer(request["event"])
                status, fields = said if isinstance(said, tuple) else (said, {})
                if 200 <= status < 300:
                    receiver.events.append(request)
                try:
                    self.send_response(status)
                    for name, value in fields.items():
                        self.send_header(name, value)
                    self.send_header("Content-Length", "0")
                    self.end_headers()
                except OSError:
                    pass  # the other end has given up

            def log_message(self, *_):
                pass

        class Server(http.server.ThreadingHTTPServer):
            daemon_threads = True

            def handle_error(self, *_):
                pass  # a daemon that is killed breaks its connections

        self.server = Server(("127.0.0.1", 0), Handler)
        if tls:
            self.server.socket = tls.wrap_socket(self.server.socket, server_side=True)
        self.url = f"{'https' if tls else 'http'}://localhost:{self.server.server_address[1]}/hook?for=fitgauge"
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()

    def ids(self):
        return [request["headers"]["webhook-id"] for request in self.events]

    def distinct(self):
        """The ids in the order of their first coming."""
        return list(dict.fromkeys(self.ids()))

    def wait(self, condition, **named):
        wait_for(condition, lambda: f"{len(self.attempts)} attempts, {len(self.events)} events: {self.attempts[-3:]}", **named)

    def close(self):
        self.server.shutdown()
        self.server.server_close()
