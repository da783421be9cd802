"""Many connections: senders that stop half-way, idle ones, and more than the system's limit of files."""

import errno
import pathlib
import random
import selectors
import socket
import ssl
import tempfile
import unittest

from support.certificates import certificate
from support.daemon import SANITIZED, Daemon, trust
from support.waiting import PATIENCE

PART = {"designation": "25 H7", "measured_mm": 25.013}
MEGABYTE = 1 << 20


def raise_own_limit():
    """This process holds the other end of every connection."""
    import resource
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))


class ConnectionTest(unittest.TestCase):
    def start(self, *flags, **named):
        raise_own_limit()
        daemon = Daemon(*flags, **named)
        self.addCleanup(daemon.cleanup)
        return daemon.start()

    def connect(self, daemon, count):
        sockets = []
        for _ in range(count):
            sockets.append(socket.create_connection(("127.0.0.1", daemon.port), timeout=PATIENCE))
            self.addCleanup(sockets[-1].close)
        return sockets


def read_head(connection):
    """The head of an answer that has no body, or of which the body does not matter."""
    answer = b""
    while b"\r\n\r\n" not in answer:
        piece = connection.recv(65536)
        if not piece:
            raise EOFError(answer)
        answer += piece
    return answer


class HalfSentBodies(ConnectionTest):
    def send_as_much_as_is_taken(self, sockets, payload, attentive):
        """Sends until nothing has been taken for a second; `attentive` is called meanwhile."""
        left = {connection: memoryview(payload) for connection in sockets}
        with selectors.DefaultSelector() as selector:
            for connection in sockets:
                connection.setblocking(False)
                selector.register(connection, selectors.EVENT_WRITE)
            while left:
                ready = selector.select(timeout=1)
                if not ready:
                    break
                for key, _ in ready:
                    try:
                        sent = key.fileobj.send(left[key.fileobj][:65536])
                        left[key.fileobj] = left[key.fileobj][sent:]
                    except ConnectionError:  # given up by the service, so that others have room
                        left[key.fileobj] = left[key.fileobj][:0]
                    if not left[key.fileobj]:
                        selector.unregister(key.fileobj)
                        del left[key.fileobj]
                attentive()

    def test_500_of_them_take_no_memory_and_harm_nobody(self):
        daemon = self.start()
        statuses = []
        client = daemon.connect()
        whole = '[{"designation":"25 H7","measured_mm":25.01}' + " " * (MEGABYTE - 100) + "]"

        def attentive():
            statuses.append(daemon.measure(PART, connection=client).status)

        head = (b"POST /v1/measurements HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                b"Content-Length: %d\r\n\r\n" % MEGABYTE)
        sockets = self.connect(daemon, 500)
        self.send_as_much_as_is_taken(sockets, head + b"[" + b" " * (MEGABYTE // 2), attentive)
        for _ in range(5):
            attentive()
            answer = daemon.measure(whole, {"Content-Type": "application/json"})
            statuses.append(answer.status)
        self.assertEqual(set(statuses), {201})
        if not SANITIZED:
            self.assertLess(daemon.memory("VmHWM"), 128 * MEGABYTE)
        client.close()
        for connection in sockets:
            connection.close()
        self.assertEqual(daemon.get("/livez").status, 200)
        self.assertEqual(daemon.stop(), 0)


class KeptAnswers(ConnectionTest):
    def test_what_is_kept_of_answers_is_bounded_however_they_are_asked_for(self):
        daemon = self.start(environment={"ASAN_OPTIONS": "quarantine_size_mb=1"})  # else it keeps what is freed
        client = daemon.connect()
        self.addCleanup(client.close)
        classes = daemon.get("/v1/tables").json["tables"][1]["classes"]
        daemon.request("GET", "/v1/tables/shaft", connection=client)
        before = daemon.memory("VmRSS")
        for number in range(150):  # each of 0.6 MB
            self.assertEqual(daemon.request("GET", "/v1/tables/shaft?" + "&" * number, connection=client).status, 200)
        for number in range(800):  # each of 30 kB
            some = ",".join(random.Random(number).sample(classes, 20))
            self.assertEqual(daemon.request("GET", f"/v1/tables/shaft?classes={some}", connection=client).status, 200)
        self.assertLess(daemon.memory("VmRSS") - before, 16 * MEGABYTE)


class IdleConnections(ConnectionTest):
    @unittest.skipIf(SANITIZED, "the memory of the release is measured")
    def test_each_takes_at_most_8_kilobytes(self):
        daemon = self.start()
        request = b"GET /v1/limits/25H7 HTTP/1.1\r\nHost: localhost\r\n\r\n"
        for connection in self.connect(daemon, 100):  # what is allocated once is not theirs
            connection.sendall(request)
            read_head(connection)
        before = daemon.memory("VmRSS")
        sockets = self.connect(daemon, 1000)
        for connection in sockets:
            connection.sendall(request)
            self.assertTrue(read_head(connection).startswith(b"HTTP/1.1 200"))
        self.assertLess((daemon.memory("VmRSS") - before) / len(sockets), 8192)


class HalfHandshakes(ConnectionTest):
    @unittest.skipIf(SANITIZED, "the memory of the release is measured")
    def test_each_needs_4_kilobytes_before_its_first_record_and_41_after(self):
        daemon = self.start_tls()
        session, hello = ssl.create_default_context(), ssl.MemoryBIO()
        with self.assertRaises(ssl.SSLWantReadError):
            session.wrap_bio(ssl.MemoryBIO(), hello, server_hostname="localhost").do_handshake()
        hello = hello.read()
        some = (("a begin", hello[:3], 4), ("all but the last byte", hello[:-1], 4), ("no answer", hello, 41))
        for name, sent, kilobytes in some:  # 39 where each waits for the answer
            with self.subTest(name):
                self.send(daemon, 100, sent)  # what is allocated once is not theirs
                before = daemon.memory("VmRSS")
                self.send(daemon, 1000, sent)
                self.assertLess((daemon.memory("VmRSS") - before) / 1000, kilobytes << 10)

    def test_a_handshake_may_come_byte_by_byte_and_ends_with_its_client(self):
        daemon = self.start_tls()
        begin = b"\x16\x03\x01"
        for hello in (b"", begin[:1], begin + b"\0\x09half", begin + b"\xff\xfftoo long", begin + b"\0\0", b"GET"):
            connection, = self.connect(daemon, 1)
            with self.subTest(hello):
                try:
                    connection.sendall(hello)
                    connection.shutdown(socket.SHUT_WR)
                    while connection.recv(4096):
                        pass
                except OSError as error:  # the daemon may reset it at any of the three
                    self.assertIn(error.errno, (errno.ECONNRESET, errno.EPIPE, errno.ENOTCONN))
        incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
        session = daemon.tls.wrap_bio(incoming, outgoing, server_hostname="localhost")
        connection, = self.connect(daemon, 1)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        while True:
            try:
                session.do_handshake()
                break
            except ssl.SSLWantReadError:
                for byte in outgoing.read():
                    connection.sendall(bytes([byte]))
                incoming.write(connection.recv(4096))
        session.write(b"GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        connection.sendall(outgoing.read())
        while received := connection.recv(4096):
            incoming.write(received)
        self.assertTrue(session.read().startswith(b"HTTP/1.1 200"))

    def start_tls(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        chain, key = certificate(pathlib.Path(folder.name), "localhost", 1)
        raise_own_limit()
        daemon = Daemon("--tls-cert", chain, "--tls-key", key)
        self.addCleanup(daemon.cleanup)
        daemon.tls = trust(chain)
        return daemon.start()

    def send(self, daemon, count, sent):
        """Each has reached the service when one that came later is answered."""
        for connection in self.connect(daemon, count):
            connection.sendall(sent)
        with socket.create_connection(("127.0.0.1", daemon.port), timeout=PATIENCE) as last:
            last.sendall(b"no handshake")
            try:
                while last.recv(4096):
                    pass
            except ConnectionResetError:
                pass


class FileLimit(ConnectionTest):
    def answered(self, sockets):
        """How many of the connections get an answer, and how many are told that there are too many."""
        counts = {b"200": 0, b"503": 0}
        for connection in sockets:
            connection.sendall(b"GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n")
        for connection in sockets:
            counts[read_head(connection).split()[1]] += 1
        return counts

    def limits(self, daemon):
        limits = pathlib.Path(f"/proc/{daemon.process.pid}/limits").read_text()
        soft, hard = limits.split("Max open files")[1].split()[:2]
        return int(soft), int(hard)

    def test_the_soft_limit_is_raised_to_what_the_connections_need(self):
        daemon = self.start("--max-connections", 600, wrapper=["prlimit", "--nofile=64:2048"])
        self.assertEqual(self.answered(self.connect(daemon, 600)), {b"200": 600, b"503": 0})
        soft, hard = self.limits(daemon)
        self.assertTrue(600 <= soft <= hard == 2048, (soft, hard))
        self.assertEqual(daemon.stop(), 0)  # its log is written
        self.assertNotIn("connections_limited", daemon.log)

    def test_a_hard_limit_that_is_too_low_is_said_and_kept(self):
        daemon = self.start(wrapper=["prlimit", "--nofile=64:400"])
        daemon.wait_for_log("connections_limited")
        self.assertEqual(self.limits(daemon), (400, 400))
        counts = self.answered(self.connect(daemon, 300))
        self.assertEqual(counts, {b"200": 144, b"503": 156})
        self.assertEqual(daemon.stop(), 0)
