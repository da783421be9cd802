"""Hostile clients of the virtual control: whatever they send, it answers or closes, and stays small."""

import os
import random
import struct
import unittest

from support.daemon import SANITIZED, DaemonTest
from support.lsv2 import Client, Refused, control_port, served, telegram, text, turned_away

DEEP = bool(os.environ.get("TESTS_DEEP"))
NAMES = ["A_LG", "A_LO", "R_VR", "R_PR", "R_CI", "C_CC", "C_DC", "R_DI", "R_FI", "R_DR", "C_DM", "C_DD", "C_FD", "C_FC",
         "C_FR", "C_FL", "R_FL", "S_FL", "T_OK", "T_FD", "R_RI", "R_MB", "R_MC", "C_MC", "C_LK", "C_EK", "R_DP", "X_YZ"]
LOGINS = ("INSPECT", "FILE", "DNC", "MONITOR", "PLCDEBUG", "DATA")
MEGABYTE = 1 << 20


class Hostile(DaemonTest):
    flags = ("--control-listen", "127.0.0.1:0", "--control-write")

    def outside(self):
        """What lies beside the control's disk, in the folder of the service and around it."""
        return sorted(str(path) for path in self.daemon.folder.rglob("*") if not path.name.startswith("fitgauge.db"))

    def setUp(self):
        self.port = control_port(self.daemon)
        self.files = self.outside()
        self.before = self.daemon.memory("VmHWM")
        self.clients = []

    def tearDown(self):
        for client in self.clients:
            client.close()
        with served(self.port, "FILE") as client:
            self.assertIn("nc_prog", client.listing("TNC:\\"))
        self.assertEqual(self.daemon.get("/livez").status, 200)
        self.assertEqual(self.outside(), self.files)
        if not SANITIZED:
            grown = self.daemon.memory("VmHWM") - self.before
            self.assertLess(grown, 64 * MEGABYTE)

    def connect(self, count, *logins):
        self.clients = [served(self.port, *logins) for _ in range(count)]
        return self.clients

    def test_a_length_is_only_a_claim(self):
        for length in (0xFFFFFFFF, 0x7FFFFFFF, 0x80000000, 1 << 24, 4096, 248):
            for name in (b"A_LG", b"S_FL", b"C_FL"):
                with self.subTest(length=length, name=name), Client(self.port) as client:
                    client.socket.sendall(struct.pack("!L", length) + name + b"x" * 100)
                    self.assertIsNone(client.read())

    def test_a_thousand_clients_with_half_a_frame(self):
        clients = self.connect(100)
        for index, client in enumerate(clients):
            client.socket.sendall((b"\0", b"\0\0\0\5", b"\0\0\0\5A_L", b"\0\0\0\xF0A_LG" + b"x" * 200)[index % 4])
        self.assertEqual(set(turned_away(self.port, 900)), {None})
        # They wait for the rest, and get their answer when it comes.
        clients[2].socket.sendall(b"GFILE\0")
        self.assertEqual(clients[2].read()[0], "T_OK")

    def test_a_hundred_transfers_share_their_memory(self):
        """Downloads of 6 MB each: those for which there is no room are refused with 53."""
        content = random.Random(8).randbytes(6 * MEGABYTE)
        self.daemon.request("PUT", "/v1/files/big.bin", content)
        self.assertEqual(self.daemon.get("/v1/files/big.bin").body, content)
        self.before = self.daemon.memory("VmHWM")  # what the storage keeps of a file it has read is not theirs
        refused = 0
        for client in self.connect(100, "FILE"):
            try:
                client.ask("R_FL", text("TNC:\\big.bin") + b"\1")
            except Refused as error:
                self.assertEqual(error.code, 53)
                refused += 1
        self.assertEqual(refused, 100 - 24 // 6)

    def test_telegrams_in_any_order_are_answered(self):
        """As many as 5,000, a million under TESTS_DEEP, over connections that end in between."""
        noise = random.Random(3)
        sent = 0
        while sent < (1_000_000 if DEEP else 5_000):
            with Client(self.port) as client:
                client.login(*noise.sample(LOGINS, noise.randint(0, len(LOGINS))))
                for _ in range(noise.choice((10, 300, 3_000))):
                    name = noise.choice(NAMES)
                    payload = noise.randbytes(noise.choice((0, 1, 2, 4, 5, 9, 40, 200)))
                    if noise.random() < 0.4:
                        path = text(noise.choice(("TNC:\\", "TNC:\\..\\..\\", "/etc/passwd", "C:\\")) + "z" * noise.randint(0, 9))
                        payload = path + noise.choice((b"", b"\0", b"\1", path))
                    client.socket.sendall(telegram(name, payload))
                    sent += 1
                    # The end of an upload is the one telegram without an answer; ask for something to see it live.
                    if name == "T_FD":
                        client.socket.sendall(telegram("R_CI", b"\0\0\0\1"))
                    self.assertIsNotNone(client.read())


if __name__ == "__main__":
    unittest.main()
