"""A TCP proxy that cuts its connections after random numbers of bytes."""

import random
import socket
import threading


class CuttingProxy:
    """Listens on a free port and passes bytes on to `port`; while `cuts` is set, each connection ends after a
    random number of bytes one way or the other, the first of them early. Clients may be held at a counted byte."""

    def __init__(self, port, seed, longest=60_000, cuts=True):
        self.port_behind = port
        self.cuts = cuts
        self.cut = 0  # connections that were
        self.passed = 0  # bytes, both ways
        self.refusals = 0  # connections that still get a 401
        self.unanswered = None  # requests that begin with this pass, and their answers do not
        self.hold_after = None  # bytes from clients
        self.held = threading.Event()
        self.going = threading.Event()
        self.random = random.Random(seed)
        self.longest = longest
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def hold_at(self, count):
        """The connection with the `count`-th byte from clients stands still until go_on(), or until the next
        is to be held."""
        self.go_on()
        self.held, self.going = threading.Event(), threading.Event()
        self.hold_after = count

    def go_on(self):
        self.hold_after = None
        self.going.set()

    def hold(self, size):
        if self.hold_after is None:
            return
        self.hold_after -= size
        if self.hold_after <= 0:
            self.hold_after = None
            going = self.going
            self.held.set()
            going.wait()

    def accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            threading.Thread(target=self.serve, args=(client,), daemon=True).start()

    def serve(self, client):
        if self.refusals:
            self.refusals -= 1
            client.recv(65536)
            client.sendall(b"HTTP/1.1 401 Unauthorized\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")
            client.close()
            return
        try:
            server = socket.create_connection(("127.0.0.1", self.port_behind), timeout=10)
        except OSError:
            client.close()
            return
        longest = self.longest if self.cut else 2_000
        left = [self.random.randrange(longest) if self.cuts else None]
        lock = threading.Lock()
        asked = [b""]

        def end():
            for one in (client, server):
                try:
                    one.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass

        def pump(source, sink):
            try:
                while data := source.recv(4096):
                    with lock:
                        if left[0] is not None:
                            data, rest = data[:left[0]], len(data) > left[0]
                            left[0] -= len(data)
                        else:
                            rest = False
                    if source is client:
                        asked[0] = data if data.startswith((b"GET ", b"PUT ")) else asked[0]
                        self.hold(len(data))
                    elif self.unanswered and asked[0].startswith(self.unanswered):
                        break
                    sink.sendall(data)
                    self.passed += len(data)
                    if rest:
                        self.cut += 1
                        break
            except OSError:
                pass
            end()

        pumps = [threading.Thread(target=pump, args=pair, daemon=True)
                 for pair in ((client, server), (server, client))]
        for one in pumps:
            one.start()
        for one in pumps:
            one.join()
        client.close()
        server.close()

    def close(self):
        self.listener.close()
