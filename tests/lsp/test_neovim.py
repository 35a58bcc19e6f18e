"""The settings for Neovim in docs/editors.md, in a Neovim without a screen."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from client import PATIENCE, PROGRAM, SOURCE

SCRIPT = """
vim.cmd("filetype on")
{settings}
vim.cmd("edit robot.yaml")
local function wait(what, condition)
  if not vim.wait({patience} * 1000, condition, 20) then
    print("no " .. what)
    vim.cmd("cquit")
  end
end
wait("findings", function() return #vim.diagnostic.get(0) == 1 end)
print(vim.diagnostic.get(0)[1].message)
-- The name that is required, where it is defined.
vim.fn.search("LOCALIZE")
vim.lsp.buf.definition()
wait("definition", function() return vim.fn.line(".") == 5 end)
-- Another name, in all files.
vim.lsp.buf.rename("FIND_PLACE")
wait("rename", function() return vim.fn.getline(2):find("FIND_PLACE") end)
vim.cmd("wall")
-- What may be written here, in the mission.
vim.cmd("edit mission.yaml")
vim.fn.cursor(3, 10)
local client = vim.lsp.get_active_clients()[1]
local found = client.request_sync("textDocument/completion", vim.lsp.util.make_position_params(), 1000 * {patience}, 0)
for _, item in ipairs(found.result.items) do print(item.label) end
vim.cmd("qall")
"""
ROBOT = """\
behaviors:
- {behavior: DRIVE, task: DRIVE, suitability: 120, requires: [{task: LOCALIZE}]}
- {behavior: LIDAR, task: LOCALIZE}
tasks:
- {task: LOCALIZE, start_on_request: false}
- {task: DRIVE}
"""


@unittest.skipUnless(shutil.which("nvim"), "there is no Neovim")
class Neovim(unittest.TestCase):
    def test_the_settings_of_the_page(self):
        page = (SOURCE / "docs" / "editors.md").read_text(encoding="utf-8")
        (settings,) = re.findall(r"^```lua\n(.*?)^```$", page, re.M | re.S)
        with tempfile.TemporaryDirectory() as folder:
            project = pathlib.Path(folder, "project").resolve()
            project.mkdir()
            (project / "robot.yaml").write_text(ROBOT)
            (project / "mission.yaml").write_text("catalog: robot.yaml\nevents:\n- start: DRIVE\n")
            script = pathlib.Path(folder, "init.lua")
            script.write_text(SCRIPT.replace("{settings}", settings).replace("{patience}", str(PATIENCE)))
            bin_folder = pathlib.Path(folder, "bin")
            bin_folder.mkdir()
            (bin_folder / "cbc").symlink_to(PROGRAM)
            environment = {**os.environ, "HOME": folder, "PATH": f"{bin_folder}:{os.environ['PATH']}"}
            done = subprocess.run(["nvim", "--clean", "--headless", "-S", script], cwd=project, check=False,
                                  env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL, timeout=4 * PATIENCE)
            output = done.stdout.decode()
            self.assertEqual(done.returncode, 0, output)
            self.assertIn("120", output)
            self.assertIn("FIND_PLACE", (project / "robot.yaml").read_text().splitlines()[1])
            self.assertIn("DRIVE", output)


if __name__ == "__main__":
    unittest.main()
