"""TLS: the service speaks it, takes new certificates on SIGHUP, asks for those of clients."""

import http.client
import os
import shutil
import signal
import ssl
import unittest

from support.certificates import certificate
from support.daemon import Daemon, trust
from support.waiting import PATIENCE

PART = {"designation": "25 H7", "measured_mm": 25.013}


@unittest.skipUnless(shutil.which("openssl"), "needs the openssl command")
class Tls(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon()
        self.addCleanup(self.daemon.cleanup)
        self.certificate, self.key = certificate(self.daemon.folder, "first", 1)
        self.daemon.flags = ["--tls-cert", self.certificate, "--tls-key", self.key]

    def serial(self):
        connection = self.daemon.connect()
        connection.connect()
        found = connection.sock.getpeercert()["serialNumber"]
        connection.close()
        return int(found, 16)

    def test_it_serves_and_takes_new_certificates_on_sighup(self):
        self.daemon.start()
        self.daemon.tls = trust(self.certificate)
        self.assertEqual(self.daemon.measure(PART).status, 201)
        self.assertEqual(self.serial(), 1)
        standing = self.daemon.connect()
        standing.connect()

        new_certificate, new_key = certificate(self.daemon.folder, "second", 2)
        shutil.copy(new_certificate, self.certificate)
        shutil.copy(new_key, self.key)
        self.daemon.tls = trust(new_certificate)
        self.daemon.process.send_signal(signal.SIGHUP)
        self.daemon.wait_for_log("certificates_reloaded")
        self.assertEqual(self.serial(), 2)
        self.assertEqual(self.daemon.request("GET", "/livez", connection=standing).status, 200)
        standing.close()

        self.certificate.write_text("nonsense")
        self.daemon.process.send_signal(signal.SIGHUP)
        self.daemon.wait_for_log("certificates_kept")
        self.assertEqual(self.serial(), 2)
        self.certificate.unlink()
        os.mkfifo(self.certificate)
        self.daemon.process.send_signal(signal.SIGHUP)
        self.daemon.wait_for_log("it is not a regular file")
        self.assertEqual(self.serial(), 2)
        self.assertEqual(self.daemon.stop(), 0)

    def test_plain_http_on_the_port_is_not_answered(self):
        self.daemon.start()
        with self.assertRaises(OSError):
            answer = self.daemon.get("/livez")
            self.fail(answer)

    def test_a_client_shows_its_certificate_where_one_is_asked_for(self):
        authority, authority_key = certificate(self.daemon.folder, "press-3", 3)
        self.daemon.flags += ["--tls-client-ca", authority]
        self.daemon.start()
        self.daemon.tls = trust(self.certificate)
        with self.assertRaises((ssl.SSLError, OSError)):
            self.daemon.get("/livez")
        self.daemon.tls = trust(self.certificate)
        self.daemon.tls.load_cert_chain(authority, authority_key)
        self.assertEqual(self.daemon.get("/livez").status, 200)
        self.check_health_port()

    def check_health_port(self):
        """The health check has no certificate: it asks at a plain port, which answers nothing else."""
        check = lambda: self.daemon.command("--healthcheck", *self.daemon.flags)
        self.assertEqual(check().returncode, 0, check().stderr)
        port = int((self.daemon.data / "health.port").read_text())
        with self.assertRaises(OSError):
            http.client.HTTPConnection("127.0.0.2", port, timeout=PATIENCE).request("GET", "/livez")
        statuses = {}
        for path in ("/livez", "/readyz", "/v1/limits/25H7", "/v1/measurements", "/", "/metrics"):
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
            connection.request("GET", path)
            statuses[path] = connection.getresponse().status
            connection.close()
        self.assertEqual(statuses, {"/livez": 200, "/readyz": 200, "/v1/limits/25H7": 403, "/v1/measurements": 403,
                                    "/": 403, "/metrics": 403})
        self.assertEqual(self.daemon.stop(), 0)
        self.assertNotEqual(check().returncode, 0)

    def test_the_health_check_is_right_on_every_address(self):
        for listen in ("127.0.0.1", "0.0.0.0", "[::]", "[::1]"):
            daemon = Daemon(listen=f"{listen}:0")
            self.addCleanup(daemon.cleanup)
            daemon.start()
            here = ("--listen", f"{listen}:{daemon.port}")
            with self.subTest(listen):
                self.assertEqual(daemon.command("--healthcheck", *here).returncode, 0)
                self.assertEqual(daemon.stop(), 0)
                self.assertNotEqual(daemon.command("--healthcheck", *here).returncode, 0)

    def test_unusable_certificates_end_the_start_in_one_line(self):
        self.certificate.write_text("nonsense")
        self.daemon.wrapper = ["prlimit", "--nofile=64:400"]  # not a word about that either
        self.daemon.spawn()
        self.assertIn(self.daemon.process.wait(PATIENCE), (1, 2))
        self.assertIn("first.pem", self.daemon.log)
        self.assertEqual(len(self.daemon.log.strip().splitlines()), 1, self.daemon.log)
