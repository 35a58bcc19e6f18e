"""The stubs say what there is, and the examples and plugin fit them."""

import pathlib

import pytest

import cbc_catalog
from conftest import run_python
from test_docs import examples

pytest.importorskip("mypy")
ALLOWLIST = pathlib.Path(__file__).with_name("stubtest_allowlist.txt")
PACKAGE = pathlib.Path(cbc_catalog.__file__).parent


def test_stubs(tmp_path):
    status, output = run_python("-m", "mypy.stubtest", "cbc_catalog", "--ignore-missing-stub",
                                "--ignore-unused-allowlist", "--allowlist", str(ALLOWLIST),
                                cwd=tmp_path, MYPYPATH=str(PACKAGE.parent))
    assert status == 0, output


def test_examples_and_plugin(tmp_path):
    files = [str(PACKAGE / "pytest_plugin.py"), str(PACKAGE / "_program.py"), str(PACKAGE / "_records.py"),
             str(PACKAGE / "_errors.py")]
    for number, text in enumerate(examples()):
        file = tmp_path / f"example_{number}.py"
        file.write_text(text)
        files.append(str(file))
    status, output = run_python("-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), *files,
                                cwd=tmp_path, MYPYPATH=str(PACKAGE.parent))
    assert status == 0, output


def test_mistakes_are_found(tmp_path):
    (tmp_path / "wrong.py").write_text(
        "import cbc_catalog as cbc\n"
        "robot = cbc.Coordinator(cbc.Catalog('robot.yaml'))\n"
        "robot.start(1)\n"
        "robot.start('DRIVE', prioriti=1)\n"
        "robot.finish('DRIVE', cause='gaol_achieved')\n"
        "cbc.verify('robot.yaml', max_states='many')\n"
        "robot.now = 3.0\n")
    status, output = run_python("-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "wrong.py",
                                cwd=tmp_path, MYPYPATH=str(PACKAGE.parent))
    assert status == 1
    assert [line.split(":")[1] for line in output.splitlines() if ": error:" in line] == ["3", "4", "5", "6", "7"]
