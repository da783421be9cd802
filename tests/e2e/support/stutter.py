"""A slow and busy machine on purpose: a test that wins a race by chance loses it here.

TESTS_STUTTER=service lets each service stand still for 20 to 150 ms again and again, about half of the time;
TESTS_STUTTER=test does so with the test, its receivers and its clients; service,test with both.
"""

import os
import random
import signal
import subprocess
import sys
import threading
import time

WANTED = os.environ.get("TESTS_STUTTER", "").split(",")
# Of a process beside the test, which stands still as a whole; it ends with it.
STOP_TEST = f"""
import os, random, signal, time
while os.getppid() == {os.getpid()}:
    time.sleep(random.uniform(0.02, 0.15))
    os.kill({os.getpid()}, signal.SIGSTOP)
    time.sleep(random.uniform(0.02, 0.15))
    os.kill({os.getpid()}, signal.SIGCONT)
"""
pause = time.sleep  # a test may put another in its place


class Stuttering(subprocess.Popen):
    """A process that stands still again and again; a test's own SIGSTOP lasts until its SIGCONT."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self.stands = threading.Lock()
        threading.Thread(target=self.stutter, daemon=True).start()

    def stutter(self):
        while self.returncode is None:
            pause(random.uniform(0.02, 0.15))
            with self.stands:
                super().send_signal(signal.SIGSTOP)
                pause(random.uniform(0.02, 0.15))
                super().send_signal(signal.SIGCONT)

    def send_signal(self, number):
        if number == signal.SIGSTOP:
            self.stands.acquire()
        super().send_signal(number)
        if number == signal.SIGCONT:
            self.stands.release()


Service = Stuttering if "service" in WANTED else subprocess.Popen
if "test" in WANTED:
    subprocess.Popen([sys.executable, "-c", STOP_TEST], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                     stderr=subprocess.DEVNULL)
