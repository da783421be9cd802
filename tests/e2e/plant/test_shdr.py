"""SHDR on a port: read as the agents of MTConnect read it, line by line, and held against what /mtconnect says."""

import contextlib
import re
import socket
import threading
import unittest
import xml.etree.ElementTree as tree

from support.daemon import Daemon, DaemonTest, command
from support.waiting import PATIENCE, wait_for

FLAGS = ("--shdr-listen", "127.0.0.1:0")


def tokens(line):
    """The texts between the `|` of a line; one in quotes may have them itself, behind a backslash."""
    found, at = [], 0
    while at <= len(line):
        quoted = re.compile(r'"((?:\\.|[^"\\])*)"(?=\||$)').match(line, at)
        if quoted:
            found.append(re.sub(r"\\(.)", r"\1", quoted[1]))
            at = quoted.end() + 1
        else:
            end = line.find("|", at) % (len(line) + 1)
            found.append(line[at:end])
            at = end + 1
    return found


def table(text):
    """`key={a=1 b=2}` as a dictionary."""
    return {key: dict(cell.split("=") for cell in cells.split()) for key, cells in re.findall(r"(\S+?)=\{([^}]*)\}", text)}


class Agent:
    def __init__(self, port, receive_buffer=None):
        self.socket = socket.socket()
        self.socket.settimeout(PATIENCE)
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.connect(("127.0.0.1", port))
        self.lines = self.socket.makefile("r", encoding="utf-8", newline="\n")

    def close(self):
        self.lines.close()
        self.socket.close()

    def line(self):
        return self.lines.readline().removesuffix("\n")

    def read(self):
        """A line as its time and its data items."""
        first, *rest = tokens(self.line())
        return first, dict(zip(rest[::2], rest[1::2]))

    def item(self, name):
        """The next line with that data item."""
        while True:
            at, items = self.read()
            if name in items:
                return at, items


class Shdr(DaemonTest):
    def setUp(self):
        self.daemon = Daemon(*FLAGS).start()
        self.addCleanup(self.daemon.cleanup)
        self.port = int(self.told(r'"event":"shdr_listening","detail":"port (\d+)"')[0])

    def told(self, pattern):
        """What the log says, once it does."""
        return wait_for(lambda: re.findall(pattern, self.daemon.log))

    def agent(self, **more):
        agent = Agent(self.port, **more)
        self.addCleanup(agent.close)
        return agent

    def observed(self):
        """What a client of /mtconnect/sample reads: parts and features in order, with their times."""
        seen, at = [], 1
        while True:
            root = tree.fromstring(self.daemon.get(f"/mtconnect/sample?from={at}&count=1000").body)
            elements = [each for each in root.iter() if each.get("dataItemId") in ("part", "feature")]
            for part, feature in zip(elements[::2], elements[1::2]):
                entry = feature[0]
                seen.append((part.get("timestamp"), part.text, entry.get("key"), {cell.get("key"): cell.text for cell in entry}))
            if not elements:
                return seen
            at = int(root[0].get("nextSequence"))

    def test_an_agent_reads_what_sample_says(self):
        agent = self.agent()
        self.assertEqual(agent.read()[1], {"avail": "AVAILABLE"})
        self.assertEqual(agent.item("count1")[1], {f"count{i}": "0" for i in range(1, 6)})
        agent.socket.sendall(b"* PING\r\n")
        self.assertEqual(agent.line(), "* PONG 10000")
        rows = [{"designation": "25 H7", "measured_mm": measured, "part_id": part, "characteristic": "bore A", "uncertainty_um": 2}
                for measured, part in (("25.0101", "P1"), ("24.99", 'a|b\\"c"'), ("25.05", '"q"'), ("25.021", "  x\ty "), ("25.0003", "Müller"))]
        self.daemon.measure(rows)
        self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01})
        told = []
        for _ in range(6):
            at, items = agent.item("part")
            (key, cells), = table(items["feature"]).items()
            told.append((at, items["part"], key, cells))
        seen = self.observed()
        # A control character is a blank here, and blanks around a text are none.
        self.assertEqual(told, [(at, part.replace("\t", " ").strip(), key, cells) for at, part, key, cells in seen])
        self.assertEqual([part for _, part, _, _ in told], ["P1", 'a|b\\"c"', '"q"', "x y", "Müller", "UNAVAILABLE"])
        counts = {"count1": "6", "count2": "4", "count3": "1", "count4": "1", "count5": "0"}
        while agent.item("count1")[1] != counts:
            pass

    def test_one_that_comes_later_begins_with_the_newest(self):
        self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"P{i}"} for i in range(3)])
        first = self.agent()
        self.assertEqual(first.item("part")[1]["part"], "P2")
        second = self.agent()
        self.assertEqual(second.item("part")[1]["part"], "P2")
        self.assertEqual(second.item("count1")[1]["count1"], "3")
        first.close()
        self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"Q{i}"} for i in range(600)])
        self.assertEqual([second.item("part")[1]["part"] for _ in range(600)], [f"Q{i}" for i in range(600)])
        second.close()
        # Nobody listens; the next one gets the newest, and no more.
        self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "part_id": "R"})
        self.assertEqual(self.agent().item("part")[1]["part"], "R")

    def test_a_slow_reader_is_sent_away_and_the_others_get_all(self):
        slow, other = self.agent(receive_buffer=4096), self.agent()
        parts = []  # read as they come: on a slow machine `other` would be slow as well
        reading = threading.Thread(target=lambda: parts.extend(int(other.item("part")[1]["part"]) for _ in range(3000)))
        reading.start()
        rows = [{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"{i:0200}", "characteristic": "c" * 200} for i in range(3000)]
        for begin in range(0, len(rows), 500):
            self.daemon.measure(rows[begin:begin + 500])
        reading.join()
        self.assertEqual(parts, list(range(3000)))
        self.told('"shdr_agent_sent_away","detail":"127.0.0.1: the agent does not read its lines"')
        taken = sum(1 for _ in slow.lines)
        self.assertLess(taken, 3000)

    def test_agents_are_bounded_and_hostile_ones_go(self):
        agents = [self.agent() for _ in range(16)]
        for agent in agents:
            self.assertEqual(agent.read()[1], {"avail": "AVAILABLE"})
        self.assertEqual(self.agent().line(), "")
        agents[0].socket.sendall(b"x" * 5000)
        agents[0].close()
        self.told("shdr_agent_sent_away.*it sends no lines")
        with contextlib.suppress(ConnectionError):  # it may be sent away before it has sent all
            agents[1].socket.sendall(b"* PING\n" * 20_000 + b"* device: x\n\n\xff\x00\n")
        self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "part_id": "P"})
        self.assertEqual(agents[2].item("part")[1]["part"], "P")
        self.assertEqual(self.daemon.get("/readyz").status, 200)

    def test_the_port_is_checked(self):
        for address in ("localhost", "127.0.0.1:99999", "192.0.2.1:7878"):
            done = command("--check-config", "--data", self.daemon.data, "--shdr-listen", address)
            self.assertNotEqual(done.returncode, 0, address)
            self.assertIn(address.split(":")[0], done.stderr)


if __name__ == "__main__":
    unittest.main()
