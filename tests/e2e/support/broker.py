"""MQTT brokers for tests: mosquitto on a port of its own, what it tells a subscriber, and one that forgets."""

import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import threading

from support.ports import free_port
from support.waiting import PATIENCE, wait_for


def kill_in_step(broker, daemon, subscriber, mark):
    """Kills the broker when the subscriber has all it took: what it has acknowledged it forgets with its life. `mark` is
    a topic of the subscriber that is of no use otherwise."""
    daemon.process.send_signal(signal.SIGSTOP)
    quiet = 0
    while quiet < 10:  # rounds in which nothing but our own word has come through the broker
        told = len(subscriber.messages)
        broker.publish(mark, b"in step")
        wait_for(lambda: any(message.topic == mark for message in subscriber.messages[told:]), lambda: broker.log[-2000:])
        quiet = quiet + 1 if len(subscriber.messages) == told + 1 else 0
    broker.kill()
    daemon.process.send_signal(signal.SIGCONT)


class Broker:
    """A mosquitto that listens on one port over all its lives."""

    def __init__(self, *lines, port=None, listener=()):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-broker-"))
        self.port = port or free_port()
        self.process = None
        self.subscribers = []
        self.file = self.folder / "mosquitto.conf"
        self.file.write_text("\n".join([
            "user root", "persistence true", f"persistence_location {self.folder}/", "max_queued_messages 0",
            "max_inflight_messages 0", f"log_dest file {self.folder}/log", "log_type all", f"listener {self.port} 127.0.0.1",
            *listener, *(lines or ("allow_anonymous true",)), ""]))

    @property
    def log(self):
        return (self.folder / "log").read_text(errors="replace")

    def start(self):
        binary = shutil.which("mosquitto", path="/usr/sbin:/usr/bin:/usr/local/sbin:/usr/local/bin")
        self.process = subprocess.Popen([binary, "-c", self.file], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(self.listens, lambda: self.log)
        return self

    def listens(self):
        try:
            socket.create_connection(("127.0.0.1", self.port), 1).close()
            return True
        except OSError:
            return False

    def save(self):
        """Its sessions to its disk, so that they survive a kill."""
        (self.folder / "mosquitto.db").unlink(missing_ok=True)
        self.process.send_signal(signal.SIGUSR1)
        wait_for((self.folder / "mosquitto.db").exists)

    def stop(self):
        self.process.terminate()
        self.process.wait(PATIENCE)

    def kill(self):
        self.process.kill()
        self.process.wait(PATIENCE)

    def subscribe(self, topic="#", **more):
        """A subscriber that has begun to listen."""
        subscriber = Subscriber(self, topic, **more)
        self.subscribers.append(subscriber)
        return subscriber

    def publish(self, topic, payload=b"", retain=False, qos=1):
        subprocess.run(["mosquitto_pub", "-p", str(self.port), "-t", topic, "-q", str(qos), "-s", *(["-r"] if retain else [])],
                       input=payload, check=True, timeout=PATIENCE)

    def cleanup(self):
        for subscriber in self.subscribers:
            subscriber.close()
        if self.process and self.process.poll() is None:
            self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)


class Message:
    def __init__(self, line):
        topic, retain, qos, payload = line.rstrip("\n").split("\t")
        self.topic, self.retain, self.qos, self.payload = topic, retain == "1", int(qos), bytes.fromhex(payload)

    def __repr__(self):
        return f"{self.topic} {self.payload[:60]!r}"


class Subscriber:
    """mosquitto_sub with a session that the broker keeps; it comes back by itself."""

    def __init__(self, broker, topic, options=()):
        self.messages = []
        name = f"test-{len(broker.subscribers)}"
        self.process = subprocess.Popen(
            ["stdbuf", "-oL", "mosquitto_sub", "-p", str(broker.port), "-c", "-i", name, "-q", "1",
             "-t", topic, "-F", "%t\t%r\t%q\t%x", *options], stdout=subprocess.PIPE, text=True)
        self.thread = threading.Thread(target=self.read, daemon=True)
        self.thread.start()
        wait_for(lambda: f"Sending SUBACK to {name}\n" in broker.log, lambda: broker.log)

    def read(self):
        for line in self.process.stdout:
            self.messages.append(Message(line))

    def close(self):
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.thread.join(PATIENCE)
        self.process.stdout.close()


class Forgetful:
    """A broker of this file's own that takes every message, answers as `acknowledges` says, and ends a connection after
    `most` messages."""

    def __init__(self, port, acknowledges=lambda number: False, most=10**9):
        self.acknowledges, self.most, self.taken, self.connects = acknowledges, most, [], 0
        self.server = socket.create_server(("127.0.0.1", port), reuse_port=True)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while True:
            try:
                connection, _ = self.server.accept()
            except OSError:
                return
            # What it acknowledges has arrived when it ends the connection.
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def serve(self, connection):
        try:
            with connection, connection.makefile("rb") as stream:
                while self.packet(connection, stream):
                    pass
        except (OSError, IndexError):
            pass  # the other end has gone

    def packet(self, connection, stream):
        kind = stream.read(1)[0]
        size = shift = 0
        while True:
            byte = stream.read(1)[0]
            size |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        body = stream.read(size)
        if kind >> 4 == 1:
            self.connects += 1
            connection.sendall(b"\x20\x02\x00\x00")
        elif kind >> 4 == 3:
            end = 2 + int.from_bytes(body[:2], "big")
            number = body[end:end + 2]
            self.taken.append((body[2:end].decode(), body[end + 2:]))
            if self.acknowledges(len(self.taken)):
                connection.sendall(b"\x40\x02" + number)
            return len(self.taken) % self.most != 0
        elif kind >> 4 == 12:
            connection.sendall(b"\xd0\x00")
        return kind >> 4 != 14

    def close(self):
        self.server.shutdown(socket.SHUT_RDWR)
        self.server.close()
