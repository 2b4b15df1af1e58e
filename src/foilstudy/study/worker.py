"""A process that has imports and kernels loaded and forks one child per job of a study.

Starting Python, importing and loading kernels costs a job most of a second, a fork milliseconds.
`workflow/scripts/job.py` is the other side: it sends its job, lends it its own standard streams,
and ends as the job ends. Where it finds no worker, it runs the job in a process of its own.
"""

from __future__ import annotations

import ctypes
import faulthandler
import gc
import json
import os
import runpy
import selectors
import signal
import socket
import sys
import tempfile
import traceback
from contextlib import redirect_stdout, suppress
from functools import partial
from pkgutil import resolve_name
from typing import NamedTuple

from foilstudy.base.provenance import git_commit
from foilstudy.study.sweep.origins import remember_codes
from foilstudy.study.sweep.warmup import compile_kernels

_STANDARD_STREAMS = 3
_GO = signal.SIGUSR1
"""Tells a child that somebody watches it."""


def work(again: int, contact: bool = False) -> None:
    """Load every kernel, print the path of the worker's socket, and serve to the end of the study.

    That end is the end of standard input, whose other side the study holds. Where there can be no
    worker the path is empty, and the kernel cache is full all the same.

    Parameters
    ----------
    again : int
        How many processes before this one have compiled.
    contact : bool
        Whether parts of the foil touch in the study.

    Raises
    ------
    RuntimeError
        If a kernel does not work on this machine.
    """
    # as it is before anything of it is loaded; it may change before a job asks
    git_commit()
    remember_codes()
    with redirect_stdout(sys.stderr):
        compiled = compile_kernels(contact)
    if compiled and again < 1 + contact:
        # A kernel just compiled may differ in its last bits from the same one out of the cache.
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:], "again"])
    with tempfile.TemporaryDirectory(prefix="foilstudy-") as folder:
        listener = _listening(f"{folder}/worker")
        print(listener.getsockname() if listener else "", flush=True)
        os.dup2(2, 1)  # nobody reads on
        if listener:
            _Worker(listener).serve()


def _listening(path: str) -> socket.socket | None:
    """None where processes cannot be watched (Linux can since 5.3), or the path is too long."""
    try:
        os.close(os.pidfd_open(os.getpid()))
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(path)
        listener.listen(128)
    except (AttributeError, OSError):
        return None
    return listener


class _Job(NamedTuple):
    """A child, a descriptor that tells its end, and the connection to who waits for it."""

    process: int
    ended: int
    client: socket.socket


class _Worker:
    def __init__(self, listener: socket.socket):
        self._listener = listener
        self._jobs: set[_Job] = set()
        # every descriptor is registered with what to do when it has something to tell
        self._selector = selectors.DefaultSelector()
        self._selector.register(listener, selectors.EVENT_READ, self._start)
        self._selector.register(0, selectors.EVENT_READ, sys.exit)

    def serve(self) -> None:
        # Ctrl-C reaches the whole group: it ends the study, and that ends the worker.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # removes the socket on its way
        # children begin with it blocked: it may come before they wait for it
        signal.pthread_sigmask(signal.SIG_BLOCK, {_GO})
        while True:
            for key, _ in self._selector.select():
                key.data()

    def _start(self) -> None:
        """Fork for a client and tell it so; one that hears nothing runs its job itself."""
        try:
            client, _ = self._listener.accept()
        except OSError:  # no descriptor is free: this client does without, and all to come
            traceback.print_exc()
            self._selector.unregister(self._listener)
            self._listener.close()
            return
        try:
            job = _started(client)
        except Exception:  # the client is gone, or memory or descriptors are short
            traceback.print_exc()
            client.close()
            return
        try:
            self._selector.register(job.ended, selectors.EVENT_READ, partial(self._finish, job))
            # A client has no more to say: this is its end, and takes its job with it.
            self._selector.register(client, selectors.EVENT_READ, partial(self._cancel, job))
        except OSError:  # of what can be watched there is no more
            traceback.print_exc()
            with suppress(KeyError):
                self._selector.unregister(job.ended)
            _given_up(job.process)
            os.close(job.ended)
            client.close()
            return
        self._jobs.add(job)
        os.kill(job.process, _GO)
        with suppress(OSError):
            client.sendall(b"started\n")

    def _cancel(self, job: _Job) -> None:
        if job in self._jobs:
            os.kill(job.process, signal.SIGKILL)
            self._selector.unregister(job.client)

    def _finish(self, job: _Job) -> None:
        self._jobs.remove(job)
        _, status = os.waitpid(job.process, 0)
        with suppress(OSError):  # a client that has ended
            job.client.sendall(b"%d\n" % os.waitstatus_to_exitcode(status))
        self._selector.unregister(job.ended)
        os.close(job.ended)
        with suppress(KeyError):  # cancelled
            self._selector.unregister(job.client)
        job.client.close()


def _started(client: socket.socket) -> _Job:
    client.settimeout(10)  # s
    _, streams, *_ = socket.recv_fds(client, 1, _STANDARD_STREAMS)
    try:
        if len(streams) < _STANDARD_STREAMS:
            raise OSError("no descriptors are left for the streams of a job")
        with client.makefile("rb") as request:
            order = json.loads(request.readline())
        with suppress(Exception):  # the job will meet it too, and say so in its log
            resolve_name(f"foilstudy.{order['command'][1]}")  # for the next of its kind as well
        process = _forked(order, streams)
    finally:
        for stream in streams:
            os.close(stream)
    try:
        return _Job(process, os.pidfd_open(process), client)
    except OSError:
        _given_up(process)
        raise


def _given_up(process: int) -> None:
    os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)


def _forked(order: dict, streams: list[int]) -> int:
    """Process number of a new child that carries out the order once it is told to."""
    gc.freeze()  # else a collection in the child would write to every page, and so copy it
    worker = os.getpid()
    process = os.fork()
    if process == 0:
        status = 1
        try:
            ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: when the worker ends
            if os.getppid() == worker:
                signal.sigwait({_GO})
                signal.pthread_sigmask(signal.SIG_UNBLOCK, {_GO})
                status = _carried_out(order, streams)
        finally:
            os._exit(status)  # past the worker's own clean-up
    return process


def _carried_out(order: dict, streams: list[int]) -> int:
    """Exit status of the script, run as by a Python of its own."""
    try:
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
        os.closerange(_STANDARD_STREAMS, os.sysconf("SC_OPEN_MAX"))  # of worker and other jobs
        faulthandler.enable()  # a crash in native code says in which line of ours
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.chdir(order["folder"])
        os.environ.clear()
        os.environ.update(order["environment"])
        sys.argv = order["command"]
        try:
            runpy.run_path(sys.argv[0], run_name="__main__")
        finally:
            sys.stdout.flush()
        return 0
    except SystemExit as stop:
        if isinstance(stop.code, int | None):
            return stop.code or 0
        print(stop.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    return 1
