"""The Python client when the service is away, busy or gone: what may be repeated is, nothing else."""

import pathlib
import tempfile
import threading
import unittest
from decimal import Decimal
from unittest import mock

from support.certificates import certificate
from support.daemon import Daemon, fitgauge, trust
from support.ports import lasting_address
from support.scripted import ScriptedServer, answer, problem

PART = {"designation": "25 H7", "measured_mm": "25.013", "part_id": "SN-1"}
STORED = answer(201, b'{"id":"m1","verdict":"good"}')
BUSY = problem(503, "storage.busy", "Retry-After: 7")


class Scripted(unittest.TestCase):
    """Pauses are not slept but noted."""

    def setUp(self):
        self.pauses = []
        patch = mock.patch("time.sleep", self.pauses.append)
        patch.start()
        self.addCleanup(patch.stop)

    def serve(self, *script):
        server = ScriptedServer(*script)
        self.addCleanup(server.close)
        return server

    def client(self, server, **options):
        client = fitgauge.Client(server.url, **options)
        self.addCleanup(client.close)
        return client


class Repeats(Scripted):
    def test_a_write_is_repeated_with_its_key_and_body(self):
        server = self.serve(None, BUSY, problem(409, "idempotency.in_progress"), answer(502, b"<html>"), STORED)
        self.assertEqual(self.client(server).measure(PART)["id"], "m1")
        self.assertEqual(len({request.headers["idempotency-key"] for request in server.requests}), 1)
        self.assertEqual({request.body for request in server.requests}, {server.requests[0].body})
        self.assertEqual(len(server.requests), 5)

    def test_each_write_has_a_key_of_its_own(self):
        server = self.serve(STORED, STORED, STORED)
        client = self.client(server)
        client.measure(PART)
        client.measure(PART)
        client.measure(PART, idempotency_key="press-3/417")
        keys = [request.headers["idempotency-key"] for request in server.requests]
        self.assertEqual((len(set(keys)), keys[2]), (3, "press-3/417"))

    def test_it_waits_as_long_as_the_service_says(self):
        self.client(self.serve(BUSY, STORED)).measure(PART)
        self.assertEqual(self.pauses, [7.0])
        date = problem(503, "storage.busy", "Retry-After: Fri, 01 Jan 2100 00:00:00 GMT")
        self.client(self.serve(date, STORED)).measure(PART)
        self.assertGreater(self.pauses[1], 1e6)

    def test_pauses_grow_and_differ(self):
        for _ in range(2):
            with self.assertRaises(fitgauge.NoAnswer):
                self.client(self.serve(*[None] * 7)).measure(PART)
        self.assertEqual(len(self.pauses), 12)
        for number, pause in enumerate(self.pauses[:6]):
            self.assertTrue(0.05 * 2 ** number <= pause <= 0.1 * 2 ** number, self.pauses)
        self.assertNotEqual(self.pauses[:6], self.pauses[6:])

    def test_a_refusal_is_final(self):
        for status, code in ((400, "json.malformed"), (401, "auth.required"), (403, "auth.forbidden"),
                             (409, "measurement.corrected"), (422, "request.invalid"), (500, "service.internal"),
                             (503, "tables.inconsistent")):
            with self.subTest(code):
                server = self.serve(problem(status, code))
                with self.assertRaises(fitgauge.Problem) as caught:
                    self.client(server).measure(PART)
                self.assertEqual((caught.exception.code, len(server.requests)), (code, 1))
        self.assertEqual(self.pauses, [])

    def test_when_it_gives_up_it_says_what_was_said_last(self):
        server = self.serve(BUSY, BUSY, BUSY)
        with self.assertRaises(fitgauge.Unavailable) as caught:
            self.client(server, retries=2).measure(PART)
        self.assertEqual(caught.exception.code, "storage.busy")

    def test_a_guarded_change_is_sent_once(self):
        server = self.serve(None)
        with self.assertRaises(fitgauge.NoAnswer):
            self.client(server).put_column("hole", "PRESS", [], revision="2-x")
        self.assertEqual([request.headers["if-match"] for request in server.requests], ['"2-x"'])

    def test_a_deletion_whose_answer_was_lost_is_done(self):
        gone = problem(404, "file.unknown")
        self.client(self.serve(None, gone)).delete_file("a.h")
        with self.assertRaises(fitgauge.NotFound):
            self.client(self.serve(gone)).delete_file("a.h")

    def test_nobody_listens(self):
        server = self.serve()
        server.close()
        with self.assertRaises(fitgauge.NoAnswer):
            self.client(server).live()
        self.assertEqual(len(self.pauses), 6)


class Connections(Scripted):
    def test_one_connection_is_used_again(self):
        server = self.serve(STORED, problem(422, "request.invalid"), STORED)
        client = self.client(server)
        client.measure(PART)
        with self.assertRaises(fitgauge.Invalid):
            client.measure(PART)
        client.measure(PART)
        self.assertEqual(server.connections, 1)

    def test_one_that_the_service_closed_is_not(self):
        server = self.serve(answer(200, b'{"status":"live"}', close=True), answer(200, b'{"status":"live"}'))
        client = self.client(server, retries=0)
        self.assertTrue(client.live() and client.live())
        self.assertEqual(server.connections, 2)
        # Closed while it was idle, without a word before.
        idle = self.serve(answer(200, b'{"status":"live"}'))
        client = self.client(idle, retries=0)
        self.assertTrue(client.live())
        idle.thread.join(10)
        idle.script = [answer(200, b'{"status":"live"}')]
        threading.Thread(target=idle.serve, daemon=True).start()
        self.assertTrue(client.live())

    def test_an_answer_that_comes_before_the_body_is_sent_is_read(self):
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        daemon.start()
        with self.assertRaises(fitgauge.Problem) as caught:
            with daemon.client() as client:
                client.put_file("huge.h", bytes(50 << 20))
        self.assertEqual(caught.exception.status, 413)

    def test_a_stream_that_breaks_off_is_an_error(self):
        head = b"HTTP/1.1 200 OK\r\nContent-Type: text/csv\r\n"
        for reply in (head + b"Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n",
                      head + b"Transfer-Encoding: chunked\r\n\r\n5\r\nhel",
                      head + b"Content-length: 9\r\n\r\nhello"):
            with self.subTest(reply):
                pieces = self.client(self.serve(reply)).export()
                self.assertTrue(next(pieces).startswith(b"hel"))
                with self.assertRaises(fitgauge.NoAnswer):
                    list(pieces)

    def test_an_answer_of_something_else(self):
        with self.assertRaises(fitgauge.Problem) as caught:
            self.client(self.serve(answer(404, b"<html>nginx</html>"))).live()
        self.assertEqual((caught.exception.code, caught.exception.detail), ("", "<html>nginx</html>"))

    def test_the_address_and_the_key_of_the_environment(self):
        server = self.serve(answer(200, b'{"status":"live"}'))
        with mock.patch.dict("os.environ", FITGAUGE_SERVER=server.url + "/gauge/", FITGAUGE_KEY="fg_1"):
            with fitgauge.Client() as client:
                self.assertTrue(client.live())
        request, = server.requests
        self.assertEqual((request.line, request.headers["authorization"]),
                         ("GET /gauge/livez HTTP/1.1", "Bearer fg_1"))
        self.assertEqual(fitgauge.Client("shop:8286")._port, 8286)
        for address in ("ftp://shop", "http://", "shop:port"):
            with self.assertRaises(ValueError):
                fitgauge.Client(address)


class EventStreams(Scripted):
    def stream(self, *blocks):
        """An event stream that then ends."""
        return b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n\r\n" + b"".join(blocks)

    def test_a_reader_comes_back_with_the_last_id(self):
        server = self.serve(
            self.stream(b"id: m0.e0\n\n", b":\n\n", b'event: a\nid: m1.e0\ndata: {"n":1}\n\n', b"event: cut\nda"),
            BUSY, self.stream(b"event:a\r\nid:m2.e0\r\ndata:{\r\ndata:  \"n\":2}\r\n\r\n"))
        events = self.client(server).events()
        self.assertEqual([next(events) for _ in range(2)],
                         [fitgauge.Event("a", "m1.e0", {"n": 1}), fitgauge.Event("a", "m2.e0", {"n": 2})])
        events.close()
        self.assertEqual([request.headers.get("last-event-id") for request in server.requests],
                         [None, "m1.e0", "m1.e0"])

    def test_an_id_before_any_event_counts(self):
        server = self.serve(self.stream(b"id: m7.e2\n\n"), self.stream(b"event: a\nid: m8.e0\ndata: 1\n\n"))
        next(self.client(server).events())
        self.assertEqual(server.requests[1].headers["last-event-id"], "m7.e2")

    def test_nobody_there_at_the_start_is_an_error(self):
        with self.assertRaises(fitgauge.NoAnswer):
            next(self.client(self.serve(None), retries=0).events())

    def test_a_refusal_ends_it(self):
        server = self.serve(self.stream(b"id: m0.e0\n\n"), problem(401, "auth.required"))
        with self.assertRaises(fitgauge.Unauthorized):
            next(self.client(server).events())


class OnTheService(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon(listen=lasting_address())
        self.addCleanup(self.daemon.cleanup)

    def restart(self):
        """On the same port, as a service comes back."""
        self.daemon.kill()
        self.daemon.start()

    def test_events_across_a_restart(self):
        self.daemon.start()
        with self.daemon.client() as client:
            events = client.events(last_event_id="m0.e0")
            first = client.measure(PART)
            self.assertEqual(next(events).data, first)
            self.restart()
            second = client.measure(PART)
            self.assertEqual(next(events).data, second)
            events.close()

    def test_writers_in_threads_lose_and_double_nothing_across_restarts(self):
        self.daemon.start()
        client = self.daemon.client(retries=12)
        acknowledged = []
        def write(writer):
            for number in range(50):
                record = client.measure({**PART, "part_id": f"{writer}-{number}"},
                                        idempotency_key=f"{writer}-{number}")
                acknowledged.append((record["part_id"], record["id"]))
        threads = [threading.Thread(target=write, args=(n,)) for n in range(4)]
        for thread in threads:
            thread.start()
        for _ in range(3):
            while len(acknowledged) % 60 < 20 and any(thread.is_alive() for thread in threads):
                threads[0].join(0.01)
            self.restart()
        for thread in threads:
            thread.join()
        stored = [(record["part_id"], record["id"]) for record in client.measurements()]
        self.assertEqual(sorted(acknowledged), sorted(stored))
        self.assertEqual(len(stored), 200)
        client.close()

    def test_keys_and_roles(self):
        self.daemon.flags = ["--auth", "keys"]
        self.daemon.start()
        with self.daemon.client() as client, self.assertRaises(fitgauge.Unauthorized):
            client.limits("25H7")
        token = self.daemon.command("key", "create", "--name", "press-3", "--role", "operator").stdout.strip()
        self.restart()
        with self.daemon.client(key=token) as client:
            self.assertEqual(client.measure(PART)["caller"], "press-3")
            with self.assertRaises(fitgauge.Forbidden):
                client.delete_column("hole", "H7")

    def test_tls_with_a_certificate_on_both_sides(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.daemon.folder))
        own, own_key = certificate(folder, "first", 1)
        press, press_key = certificate(folder, "press-3", 2)
        self.daemon.flags = ["--tls-cert", own, "--tls-key", own_key, "--tls-client-ca", press]
        self.daemon.start()
        address = f"https://localhost:{self.daemon.port}"
        with fitgauge.Client(address, ca_file=own, cert_file=press, key_file=press_key) as client:
            self.assertEqual(client.limits("25H7")["upper_limit_mm"], Decimal("25.021"))
            self.assertEqual(client.measure(PART)["verdict"], "good")
            self.assertEqual(len(b"".join(client.export("ndjson")).splitlines()), 1)
        for stranger in (fitgauge.Client(address, ca_file=own, retries=0),
                         fitgauge.Client(address, ca_file=press, retries=0), fitgauge.Client(address)):
            with self.assertRaises(fitgauge.NoAnswer):
                stranger.live()
        context = trust(own)
        context.load_cert_chain(press, press_key)
        with fitgauge.Client(address, tls=context) as client:
            self.assertTrue(client.live())
        with self.assertRaises(ValueError):
            fitgauge.Client("http://localhost:1", ca_file=own)
