"""strace beside a running service."""

import shutil
import subprocess
import threading


def can_trace():
    """Whether strace is there, and may attach and let calls fail."""
    if not shutil.which("strace"):
        return False
    injected = ["strace", "-qq", "-o", "/dev/null", "-e", "inject=getppid:retval=7", "true"]
    return subprocess.run(injected, capture_output=True, check=False).returncode == 0


def attach(test, daemon, *options):
    """strace, when it has attached to each thread of the service; its output belongs into a file: `-o`."""
    tracer = subprocess.Popen(["strace", "-f", "-p", str(daemon.process.pid), *map(str, options)],
                              stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    test.addCleanup(tracer.stderr.close)
    test.addCleanup(tracer.wait)
    test.addCleanup(tracer.terminate)
    test.assertIn("attached", tracer.stderr.readline())  # written when it has all of them
    threading.Thread(target=tracer.stderr.read, daemon=True).start()
    return tracer
