"""The settings for Emacs in docs/editors.md, in an Emacs without a screen."""

import shutil
import subprocess
import unittest

from editor_project import project_for

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
        with project_for("elisp", SCRIPT) as (project, run):
            status, output = run(["emacs", "--batch", "--load"])
            self.assertEqual(status, 0, output)
            self.assertIn("120", output)
            self.assertIn("FIND_PLACE", (project / "robot.yaml").read_text().splitlines()[1])


if __name__ == "__main__":
    unittest.main()
