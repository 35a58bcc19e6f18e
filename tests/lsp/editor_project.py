"""What tests of the settings in docs/editors.md share: a project, and an editor without a screen in its folder."""

import contextlib
import os
import pathlib
import re
import subprocess
import tempfile

from client import PATIENCE, PROGRAM, SOURCE

ROBOT = """\
behaviors:
- {behavior: DRIVE, task: DRIVE, suitability: 120, requires: [{task: LOCALIZE}]}
- {behavior: LIDAR, task: LOCALIZE}
tasks:
- {task: LOCALIZE, start_on_request: false}
- {task: DRIVE}
"""


@contextlib.contextmanager
def project_for(language, script):
    """(folder of the project, run): `run(words)` starts an editor there, with the file of the script behind the words;
    (exit status, output). `script` has {settings}, those of the page in this language, and {patience}, in seconds."""
    page = (SOURCE / "docs" / "editors.md").read_text(encoding="utf-8")
    (settings,) = re.findall(rf"^```{language}\n(.*?)^```$", page, re.M | re.S)
    with tempfile.TemporaryDirectory() as folder:
        project = pathlib.Path(folder, "project").resolve()
        (project / ".git").mkdir(parents=True)
        (project / "robot.yaml").write_text(ROBOT)
        path = pathlib.Path(folder, "script." + language)
        path.write_text(script.replace("{settings}", settings).replace("{patience}", str(PATIENCE)))
        bin_folder = pathlib.Path(folder, "bin")
        bin_folder.mkdir()
        (bin_folder / "cbc").symlink_to(PROGRAM)
        environment = {**os.environ, "HOME": folder, "PATH": f"{bin_folder}:{os.environ['PATH']}"}

        def run(words):
            done = subprocess.run([*words, path], cwd=project, check=False, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=4 * PATIENCE)
            return done.returncode, done.stdout.decode()

        yield project, run
