"""A job of the worker: as one of its own, and gone when the study or its client is."""

import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest
from test_workflow import TINY

from foilstudy.config import load_config

SCRIPTS = Path(__file__).parents[1] / "workflow/scripts"
JOB = [sys.executable, "-I", "-S", str(SCRIPTS / "job.py")]
# Holds the worker as a study does, says where it is, and waits to be killed.
STUDY = """
import subprocess, sys, time
worker = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
print(worker.pid, worker.stdout.readline(), end="", flush=True)
time.sleep(600)
"""
NAP = """
import os, sys, time
from pathlib import Path
Path(sys.argv[1]).write_text(str(os.getpid()))
time.sleep(600)
"""

pytestmark = pytest.mark.skipif(not hasattr(os, "pidfd_open"), reason="no worker on this system")


class Study:
    """A process that holds a worker."""

    def __init__(self, *words, log=None):
        words = words or (str(SCRIPTS / "worker.py"),)
        command = [sys.executable, "-c", STUDY, sys.executable, "-P", *words]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        worker, self.socket = self.process.stdout.readline().split()
        self.worker = int(worker)

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


@pytest.fixture(scope="module")
def worker():
    study = Study()
    yield study.socket
    study.kill()


def script(folder, content):
    path = folder / "script.py"
    path.write_text(content, encoding="utf-8")
    return str(path)


def environment(socket):
    return os.environ | {"FOILSTUDY_WORKER": str(socket)}


def run(socket, folder, content, *words):
    command = [*JOB, script(folder, content), *words]
    return subprocess.run(
        command, env=environment(socket), cwd=folder, capture_output=True, text=True, check=False
    )


@pytest.fixture(params=["in the worker", "in a process of its own"])
def socket(request, tmp_path, worker):
    return worker if request.param == "in the worker" else tmp_path / "nobody"


def test_a_job_writes_says_and_ends_what_its_script_does(socket, tmp_path):
    content = (
        "import sys; open('file', 'w').write(sys.argv[1]); print('out'); "
        "print('err', file=sys.stderr); sys.exit(7)"
    )
    job = run(socket, tmp_path, content, "wörd with 'quotes'")
    assert (job.returncode, job.stdout, job.stderr) == (7, "out\n", "err\n")
    assert (tmp_path / "file").read_text() == "wörd with 'quotes'"


def test_a_job_gets_the_environment_of_its_command(socket, tmp_path, monkeypatch):
    monkeypatch.setenv("OF_THIS_JOB", "alone")
    monkeypatch.delenv("HOME", raising=False)
    content = "import os; print(os.environ['OF_THIS_JOB'], 'HOME' in os.environ)"
    assert run(socket, tmp_path, content).stdout == "alone False\n"


@pytest.mark.parametrize(
    ("content", "code", "said"),
    [
        ("print('done')", 0, ""),
        ("import sys; sys.exit('missed')", 1, "missed"),
        ("import no_such_module", 1, "ModuleNotFoundError: No module named 'no_such_module'"),
    ],
)
def test_a_job_fails_as_its_script_does(socket, tmp_path, content, code, said):
    job = run(socket, tmp_path, content)
    assert job.returncode == code
    assert job.stderr.strip().endswith(said)


@pytest.mark.parametrize("name", ["SIGSEGV", "SIGKILL"])
def test_a_crash_is_named(worker, tmp_path, name):
    number = getattr(signal, name)
    job = run(worker, tmp_path, f"import os\n\nos.kill(os.getpid(), {int(number)})")
    assert job.returncode == 128 + number
    *before, line = job.stderr.splitlines()
    assert line.startswith(f"ended by {name}")
    # nothing can say where a process was killed from outside
    assert any("script.py" in said and "line 3" in said for said in before) == (name == "SIGSEGV")
    assert run(worker, tmp_path, "print('still here')").stdout == "still here\n"


def test_a_job_finds_the_modules_of_the_worker_loaded(worker, tmp_path):
    content = "import sys; print('foilstudy.study.sweep.crumple' in sys.modules)"
    assert run(worker, tmp_path, content).stdout == "True\n"
    # what one job names is there for the next
    run(worker, tmp_path, "", "plot.mac:draw_mac")
    content = "import sys; print('foilstudy.plot.mac' in sys.modules)"
    assert run(worker, tmp_path, content).stdout == "True\n"


def test_a_call_gets_what_its_function_is_made_for(socket, tmp_path):
    """JSON, a path, and texts as many as there are; a refusal is a sentence."""
    study = load_config(TINY)
    task = study.response_task(study.cells()[0]).model_dump_json()
    command = [*JOB, str(SCRIPTS / "call.py"), "study.sweep.export:export_realisation"]
    job = partial(subprocess.run, env=environment(socket), capture_output=True, text=True)
    done = job([*command, task, str(tmp_path / "crumple.nc"), str(tmp_path), "csv", "mesh"])
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("'mesh' is not a known export format; use one of nc, mat")
    done = job([*command, task, str(tmp_path / "crumple.nc"), str(tmp_path), "csv", "npz"])
    assert "crumple.nc: cannot be read" in done.stderr and "No such file" in done.stderr


def test_the_worker_that_is_forked_has_one_thread(worker, tmp_path):
    run(worker, tmp_path, "import xarray, statsmodels.api, matplotlib.pyplot, netCDF4")
    content = "import os; print(len(os.listdir(f'/proc/{os.getppid()}/task')))"
    assert run(worker, tmp_path, content).stdout == "1\n"


def asleep(socket, folder):
    """Client of a job that sleeps, and the number of the process that does."""
    noted = folder / "process"
    command = [*JOB, script(folder, NAP), str(noted)]
    client = subprocess.Popen(command, env=environment(socket), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: noted.exists() and noted.read_text())
    return client, int(noted.read_text())


def wait_until(condition):
    end = time.monotonic() + 10
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def is_gone(process):
    """Whether a process has ended; one that nobody has asked for yet counts as well."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return True
    return state == "Z"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_killed_client_takes_its_job_along(worker, tmp_path, number):
    client, process = asleep(worker, tmp_path)
    client.send_signal(number)
    assert client.communicate() == (None, "")
    wait_until(lambda: is_gone(process))
    assert run(worker, tmp_path, "print('still here')").stdout == "still here\n"


def test_worker_and_jobs_end_with_a_killed_study(tmp_path):
    study = Study()
    client, process = asleep(study.socket, tmp_path)
    study.kill()
    wait_until(lambda: is_gone(process) and is_gone(study.worker))
    _, said = client.communicate()
    assert client.returncode != 0
    assert len(said.splitlines()) == 1
    wait_until(lambda: not Path(study.socket).parent.exists())


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_jobs_end_with_a_killed_worker(tmp_path, number):
    study = Study()
    client, process = asleep(study.socket, tmp_path)
    os.kill(study.worker, number)
    wait_until(lambda: is_gone(process))
    _, said = client.communicate()
    assert client.returncode == 1
    assert said.startswith("the worker of the study ended before this job")
    # the next ones do without
    assert run(study.socket, tmp_path, "print('on its own')").stdout == "on its own\n"
    study.kill()
    shutil.rmtree(Path(study.socket).parent, ignore_errors=True)


# A worker whose machine has no memory for a process, or no descriptor to watch one.
FAULTY = """
import os, sys, time
from foilstudy.study.worker import work
def fail(process=None):
    if process != os.getpid():
        time.sleep(0.5)  # in which a child that does not wait says who it is
        raise OSError("the machine is full")
    return watched(process)
watched = os.pidfd_open
setattr(os, sys.argv[1], fail)
work(again=sys.argv[2:] == ["again"])
"""
WHOSE = "import os; print(os.getppid())"


@pytest.mark.parametrize("call", ["fork", "pidfd_open"])
def test_a_job_that_the_worker_cannot_start_runs_by_itself(tmp_path, call):
    with (tmp_path / "worker.log").open("w") as log:
        study = Study("-c", FAULTY, call, log=log)
    for _ in range(2):  # the worker stays
        job = run(study.socket, tmp_path, WHOSE)
        assert (job.returncode, job.stdout, job.stderr) == (0, f"{os.getpid()}\n", "")
    study.kill()
    assert (tmp_path / "worker.log").read_text().count("OSError: the machine is full") == 2


@pytest.mark.parametrize("left", [0, 2, 4])
def test_a_worker_short_of_descriptors_keeps_its_jobs(tmp_path, left):
    """None for a connection; one, but not for the streams of a job; enough for one job more."""
    study = Study()
    client, process = asleep(study.socket, tmp_path)
    descriptors = [int(path.name) for path in Path(f"/proc/{study.worker}/fd").iterdir()]
    assert sorted(descriptors) == list(range(len(descriptors)))
    _, most = resource.prlimit(study.worker, resource.RLIMIT_NOFILE)
    resource.prlimit(study.worker, resource.RLIMIT_NOFILE, (len(descriptors) + left, most))
    starter = study.worker if left == 4 else os.getpid()
    for _ in range(2):
        job = run(study.socket, tmp_path, WHOSE)
        assert (job.returncode, job.stdout, job.stderr) == (0, f"{starter}\n", "")
    assert not is_gone(process)
    study.kill()
    client.communicate()
