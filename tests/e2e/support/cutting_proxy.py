"""A TCP proxy that cuts its connections after random numbers of bytes."""

import random
import socket
import threading


class CuttingProxy:
    """Listens on a free port and passes bytes on to `port`; while `cuts` is set, each connection ends after a
    random number of bytes one way or the other, the first of them early."""

    def __init__(self, port, seed, longest=60_000):
        self.port_behind = port
        self.cuts = True
        self.cut = 0  # connections that were
        self.random = random.Random(seed)
        self.longest = longest
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            threading.Thread(target=self.serve, args=(client,), daemon=True).start()

    def serve(self, client):
        try:
            server = socket.create_connection(("127.0.0.1", self.port_behind), timeout=10)
        except OSError:
            client.close()
            return
        longest = self.longest if self.cut else 2_000
        left = [self.random.randrange(longest) if self.cuts else None]
        lock = threading.Lock()

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
                    sink.sendall(data)
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
