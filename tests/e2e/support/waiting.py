"""Waiting for what is promised: until it is there, and as long as a slow and busy machine may take."""

import time

PATIENCE = 120  # seconds


def wait_for(condition, what="", seconds=PATIENCE):
    """What `condition` gives as soon as it is true. `what` is a text of what was waited for, or gives one when it did
    not come."""
    deadline = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > deadline:
            raise AssertionError(f"in {seconds} s it did not come: {what() if callable(what) else what}")
        time.sleep(0.01)
    return found
