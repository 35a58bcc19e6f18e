"""The settings for Neovim in docs/editors.md, in a Neovim without a screen."""

import shutil
import unittest

from editor_project import project_for

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
vim.cmd("normal gd")
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
assert(vim.bo.omnifunc == "v:lua.vim.lsp.omnifunc")
vim.cmd("doautocmd TextChanged")
wait("lenses", function() return #vim.lsp.codelens.get(0) > 0 end)
vim.cmd("qall")
"""


@unittest.skipUnless(shutil.which("nvim"), "there is no Neovim")
class Neovim(unittest.TestCase):
    def test_the_settings_of_the_page(self):
        with project_for("lua", SCRIPT) as (project, run):
            (project / "mission.yaml").write_text("catalog: robot.yaml\nevents:\n- start: DRIVE\n")
            status, output = run(["nvim", "--clean", "--headless", "-S"])
            self.assertEqual(status, 0, output)
            self.assertIn("120", output)
            self.assertIn("FIND_PLACE", (project / "robot.yaml").read_text().splitlines()[1])
            self.assertIn("DRIVE", output)


if __name__ == "__main__":
    unittest.main()
