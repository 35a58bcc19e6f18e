"""The settings for Emacs in docs/editors.md, in an Emacs without a screen."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from client import PATIENCE, PROGRAM, SOURCE
from test_neovim import ROBOT

SCRIPT = """
(package-initialize)
(require 'eglot)
(require 'flymake)
{settings}
(defun wait-for (what condition)
  (let ((end (+ (float-time) {patience})))
    (while (not (funcall condition))
      (when (> (float-time) end) (error "no %s" what))
      (accept-process-output nil 0.02))))
(find-file "robot.yaml")
(yaml-mode)
(call-interactively 'eglot)
(wait-for "server" 'eglot-current-server)
(flymake-mode 1)
(flymake-start)
(wait-for "findings" (lambda () (= 1 (length (flymake-diagnostics)))))
(message "%s" (flymake-diagnostic-text (car (flymake-diagnostics))))
(goto-char (point-min))
(search-forward "LOCALI")
(call-interactively 'xref-find-definitions)
(unless (= 5 (line-number-at-pos)) (error "no definition"))
(eglot-rename "FIND_PLACE")
(save-some-buffers t)
"""


def has_eglot():
    words = ["emacs", "--batch", "--eval", "(progn (package-initialize) (require 'eglot) (require 'yaml-mode))"]
    return shutil.which("emacs") and subprocess.run(words, check=False, capture_output=True).returncode == 0


@unittest.skipUnless(has_eglot(), "there is no Emacs with eglot and yaml-mode")
class Emacs(unittest.TestCase):
    def test_the_settings_of_the_page(self):
        page = (SOURCE / "docs" / "editors.md").read_text(encoding="utf-8")
        (settings,) = re.findall(r"^```elisp\n(.*?)^```$", page, re.M | re.S)
        with tempfile.TemporaryDirectory() as folder:
            project = pathlib.Path(folder, "project").resolve()
            (project / ".git").mkdir(parents=True)
            (project / "robot.yaml").write_text(ROBOT)
            script = pathlib.Path(folder, "test.el")
            script.write_text(SCRIPT.replace("{settings}", settings).replace("{patience}", str(PATIENCE)))
            bin_folder = pathlib.Path(folder, "bin")
            bin_folder.mkdir()
            (bin_folder / "cbc").symlink_to(PROGRAM)
            environment = {**os.environ, "HOME": folder, "PATH": f"{bin_folder}:{os.environ['PATH']}"}
            done = subprocess.run(["emacs", "--batch", "--load", script], cwd=project, check=False, env=environment,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  timeout=4 * PATIENCE)
            output = done.stdout.decode()
            self.assertEqual(done.returncode, 0, output)
            self.assertIn("120", output)
            self.assertIn("FIND_PLACE", (project / "robot.yaml").read_text().splitlines()[1])


if __name__ == "__main__":
    unittest.main()
