"""Run a script in the worker of the study, or by itself where none starts it: job.py SCRIPT WORD...

Started with -I -S and by the standard library alone, as its own start is all that a job then costs.
`foilstudy.study.worker` is the other side; its socket is named in FOILSTUDY_WORKER.
"""

import json
import os
import signal
import socket
import sys


def answers(command):
    """Lines of the worker: that the job has started, and its exit status, negative for a signal."""
    order = {"command": command, "folder": os.getcwd(), "environment": dict(os.environ)}
    with socket.socket(socket.AF_UNIX) as worker:
        try:
            worker.connect(os.environ["FOILSTUDY_WORKER"])
            socket.send_fds(worker, [b"\n"], [0, 1, 2])
            worker.sendall(json.dumps(order).encode() + b"\n")
            yield from worker.makefile()
        except (KeyError, OSError):  # no worker, or none any more
            return


def status_of(word):
    """What this process ends with."""
    if not word:
        return "the worker of the study ended before this job; start the study again"
    code = int(word)
    if code >= 0:
        return code
    why = ", as by a machine short of memory" if -code == signal.SIGKILL else ""
    kind = signal.Signals(-code).name
    print(f"ended by {kind} ({signal.strsignal(-code)}{why})", file=sys.stderr)
    return 128 - code


command = sys.argv[1:]
signal.signal(signal.SIGINT, signal.SIG_DFL)  # a traceback from here would tell nothing
said = answers(command)
if next(said, None):
    sys.exit(status_of(next(said, "")))
os.execv(sys.executable, [sys.executable, "-P", "-X", "faulthandler", *command])
