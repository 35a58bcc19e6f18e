import copy
import html.parser
import pickle
import threading

import pytest

import cbc_catalog as cbc
from conftest import ROBOT, SOURCE, run_cbc


def test_what_a_catalog_has():
    catalog = cbc.Catalog.from_text(ROBOT, name="robot.yaml")
    assert catalog.name == "robot.yaml"
    assert catalog.path is None
    assert catalog.source == ROBOT.encode()
    assert catalog.tasks["DRIVE"] == ("DRIVE_FAST", "DRIVE_SLOWLY")
    assert catalog.behaviors[:2] == ("DRIVE_FAST", "DRIVE_SLOWLY")
    assert catalog.variables == {"PEOPLE": ("none", "near", "far"), "RAIN": (True, False)} or \
        catalog.variables == {"PEOPLE": ("none", "near", "far"), "RAIN": (False, True)}
    assert repr(catalog) == "<Catalog 'robot.yaml': 4 tasks, 5 behaviors>"


def test_errors_have_places():
    with pytest.raises(cbc.CatalogError) as caught:
        cbc.Catalog(SOURCE / "docs" / "faulty.yaml")
    finding = caught.value.findings[0]
    assert (finding.line, finding.column, finding.rule) == (8, 3, "unknown-key")
    assert finding.file.endswith("docs/faulty.yaml")
    assert finding.severity == "error"
    assert "did you mean 'suitability'?" in finding.message
    assert f"{finding.file}:8:3: error: " in str(caught.value)
    assert pickle.loads(pickle.dumps(caught.value)).findings == caught.value.findings


@pytest.mark.parametrize("text", ["", "{", "[]", "events: []", "a: b", "\0", b"\xff\xfe", "behaviors: 1",
                                  "catalog: x.yaml\nproperties: []", b"CBC\0\0\0\0\0"])
def test_what_is_no_catalog(text):
    with pytest.raises(cbc.CatalogError):
        cbc.Catalog.from_text(text)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError):
        cbc.Catalog(tmp_path / "none.yaml")
    with pytest.raises(IsADirectoryError):
        cbc.Catalog(tmp_path)
    for wrong in (None, 1, [], 1.5):
        with pytest.raises(TypeError):
            cbc.Catalog(wrong)
        with pytest.raises(TypeError):
            cbc.Catalog.from_text(wrong)


def test_compiled_and_yaml_are_equal(tmp_path, catalog):
    assert run_cbc("compile", catalog.path, "-o", tmp_path / "q.cbc")[0] == 0
    compiled = cbc.Catalog(str(tmp_path / "q.cbc"))
    assert compiled == catalog
    assert hash(compiled) == hash(catalog)
    assert compiled.tasks == catalog.tasks
    assert compiled != cbc.Catalog.from_text(ROBOT)
    assert compiled != "q.cbc"
    assert cbc.Coordinator(compiled).start("TAKE_OFF").accepted


def test_copies_and_pickles(catalog):
    assert copy.deepcopy(catalog) is catalog
    other = pickle.loads(pickle.dumps(catalog))
    assert other == catalog
    assert (other.name, other.path) == (catalog.name, catalog.path)


def test_several_threads_use_one_catalog(catalog):
    results = []

    def fly():
        robot = cbc.Coordinator(catalog)
        for second in range(200):
            robot.start("TAKE_OFF", at=second)
            robot.stop("TAKE_OFF")
        results.append(robot.save())

    threads = [threading.Thread(target=fly) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4
    assert len(set(results)) == 1


def test_picture(catalog):
    picture = catalog._repr_svg_()
    assert picture is None or "<svg" in picture


class Table(html.parser.HTMLParser):
    """The cells of a table."""

    def __init__(self, text):
        super().__init__()
        self.rows = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_data(self, data):
        if self.rows:
            self.rows[-1][-1] += data


def test_table_of_a_robot():
    robot = cbc.Coordinator(cbc.Catalog.from_text(ROBOT))
    robot.start("DRIVE", 3)
    robot.fault("BEACON")
    robot.situation({"LIFT_UP": False})
    text = robot._repr_html_()
    table = Table(text)
    assert [row[:3] for row in table.rows[1:]] == [
        [task, behavior, str(robot.requests.get(task, ""))] for task, behavior in robot.running.items()]
    assert all(row[3].startswith("why ") for row in table.rows[1:])
    for part in ("PEOPLE: none", "cannot be activated: LIFT_UP", "faulty: BEACON", "will start: SIGNAL"):
        assert part in text
    strange = cbc.Coordinator(cbc.Catalog.from_text("behaviors:\n- {behavior: 'a<b', task: T}\n"))
    strange.start("T")
    assert Table(strange._repr_html_()).rows[1][1] == "a<b"
