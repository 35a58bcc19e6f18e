"""Every page that cbc makes has a strict Content-Security-Policy: it needs nothing that the policy forbids, and
nothing that gets into it can run, load or send anything."""

import re
import subprocess
import unittest
import urllib.request

from chromium import Chromium
from page_case import OUT, PROGRAM, QUADROTOR, ROOT, HOSTILE_BEHAVIORS, hostile_files, solve
from test_live import Stream

# What a text with markup might do, if the page took it for its own.
INTRUDERS = {
    "script-src-elem": "const one = document.createElement('script'); one.textContent = 'window.taken = 1';"
                       "document.body.append(one);",
    "script-src-attr": "const one = document.createElement('p'); one.setAttribute('onclick', 'window.taken = 1');"
                       "document.body.append(one); one.click();",
    "style-src-elem": "const one = document.createElement('style'); one.textContent = 'body { display: none }';"
                      "document.body.append(one);",
    "style-src-attr": "document.body.setAttribute('style', 'display: none');",
    "img-src": "new Image().src = 'http://192.0.2.1/picture.png';",
    "connect-src": "fetch('http://192.0.2.1/').catch(() => 0);",
    "frame-src": "const one = document.createElement('iframe'); one.src = 'http://192.0.2.1/';"
                 "document.body.append(one);",
    "form-action": "const one = document.createElement('form'); one.action = 'http://192.0.2.1/';"
                   "document.body.append(one); one.submit();",
    "base-uri": "const one = document.createElement('base'); one.href = 'http://192.0.2.1/'; document.head.append(one);",
}


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], cwd=ROOT, stdout=subprocess.DEVNULL, check=False)
    assert done.returncode in (0, 1), done.returncode


class Policy(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        OUT.mkdir(parents=True, exist_ok=True)
        cls.browser = Chromium().__enter__()
        cls.addClassCleanup(cls.browser.close)
        # Before any script of a page.
        cls.browser.call("Page.addScriptToEvaluateOnNewDocument", source=
                         "window.violations = []; document.addEventListener('securitypolicyviolation',"
                         " (event) => window.violations.push([event.effectiveDirective, event.blockedURI]));")

    def violations(self):
        self.browser.settle()
        return self.browser.ask("window.violations")

    def check(self, url):
        self.browser.load(url)
        policy = self.browser.ask("document.querySelector('meta[http-equiv=Content-Security-Policy]').content")
        self.assertTrue(policy.startswith("default-src 'none';"), policy)
        self.assertNotIn("unsafe", policy)
        self.assertIsNone(re.search(r"[\s*]\*|https?:(\s|;|$)", policy), policy)
        self.assertEqual(self.violations(), [])
        for event in self.browser.events:
            self.assertNotIn(event["method"], ("Log.entryAdded", "Runtime.exceptionThrown"), event)
        for directive, intruder in INTRUDERS.items():
            self.browser.ask("window.violations.length = 0; (() => {" + intruder + "})(); 0")
            with self.subTest(page=url, directive=directive):
                self.assertEqual([found[0] for found in self.violations()], [directive])
        self.assertIsNone(self.browser.ask("window.taken ?? null"))
        self.assertEqual(self.browser.ask("getComputedStyle(document.body).display === 'none'"), False)

    def test_missions(self):
        self.check(solve("policy", QUADROTOR, "catalogs/quadrotor.mission.yaml")[0])

    def test_hostile_names(self):
        self.check(solve("policy-hostile", *hostile_files())[0])

    def test_coverage(self):
        page = OUT / "policy-coverage.html"
        run("coverage", QUADROTOR, "catalogs/quadrotor.mission.yaml", "--format", "html", "-o", str(page))
        self.check(page.as_uri())
        self.assertEqual(self.browser.ask("getComputedStyle(document.querySelector('.missed')).backgroundColor"
                                          " !== getComputedStyle(document.body).backgroundColor"), True)

    def test_coverage_of_hostile_names(self):
        page = OUT / "policy-hostile-coverage.html"
        run("coverage", *hostile_files(), "--format", "html", "-o", str(page))
        self.check(page.as_uri())
        self.assertIn(HOSTILE_BEHAVIORS[0], self.browser.ask("document.body.textContent"))

    def test_properties(self):
        page = OUT / "policy-verify.html"
        properties = OUT / "policy.properties.yaml"
        properties.write_text(f"catalog: {ROOT / QUADROTOR}\nproperties: [{{never: {{running: [LAND]}}}}]\n")
        run("verify", str(properties), "--max-states", "2000", "--html", str(page))
        self.check(page.as_uri())

    def test_live(self):
        stream = Stream()
        self.addCleanup(stream.end)
        self.check(stream.url)
        with urllib.request.urlopen(stream.url) as answer:
            self.assertEqual(answer.headers["Content-Security-Policy"], "frame-ancestors 'none'")


if __name__ == "__main__":
    unittest.main()
