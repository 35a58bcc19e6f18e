"""The examples of docs/python.md run as they stand, in one folder, with the catalog of `cbc init`."""

import re

import pytest

from conftest import SOURCE, run_cbc, run_python

PAGE = SOURCE / "docs" / "python.md"


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)


def examples():
    return blocks("python")


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    folder = tmp_path_factory.mktemp("project") / "robot"
    assert run_cbc("init", folder)[0] == 0
    (settings,) = blocks("ini")
    (folder / "pytest.ini").write_text(settings)
    return folder


@pytest.mark.parametrize("place", range(len(examples())))
def test_example(project, place):
    text = examples()[place]
    if "def test_" in text:
        (project / f"test_{place}.py").write_text(text)
        status, output = run_python("-m", "pytest", "-p", "no:cacheprovider", "-q", f"test_{place}.py", cwd=project)
    else:
        status, output = run_python("-c", text, cwd=project)
    assert status == 0, output


def test_the_whole_project(project):
    status, output = run_python("-m", "pytest", "-p", "no:cacheprovider", "--cbc-coverage", cwd=project)
    assert status == 0, output
    assert "missions" in output and "coverage of behavior catalogs" in output
