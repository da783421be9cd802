"""Ports for services that are started later, or again."""

import pathlib
import random
import socket

RANGE = pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range")


def claim(port):
    """Whether no other test has it: a name that the system keeps as long as this process lives."""
    with socket.socket(socket.AF_UNIX) as name:
        try:
            name.bind(f"\0fitgauge-test-port-{port}")
        except OSError:
            return False
        name.detach()
        return True


def free_port():
    """One that nobody gets by chance while its service is away: the system gives it to no connection and to no port 0,
    and no test chooses it again."""
    first, last = map(int, RANGE.read_text().split())
    lasting = [*range(10_000, first), *range(last + 1, 65_536)] or range(10_000, 65_536)
    while True:
        port = random.SystemRandom().choice(lasting)
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
        if claim(port):
            return port


def lasting_address():
    """Of a service that comes back on its port."""
    return f"127.0.0.1:{free_port()}"
