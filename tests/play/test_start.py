"""The page of `./dev play` starts in Chromium without a network: from a disk, and from a server.

test_start.py FOLDER: FOLDER is build/play."""

import contextlib
import functools
import http.server
import pathlib
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
from chromium import Chromium  # noqa: E402


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def serve(folder):
    handler = functools.partial(Quiet, directory=folder)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


def start(browser, url):
    begin = time.monotonic()
    browser.load(url)
    while not browser.ask("document.getElementById('output').dataset.state ?? ''"):
        if time.monotonic() - begin > 60:
            sys.exit(f"{url}: the program does not start")
        time.sleep(0.01)
    text = browser.ask("document.getElementById('output').textContent")
    if not text.startswith("cbc "):
        sys.exit(f"{url}: {text}")
    print(f"{url}: {text.strip()}, after {time.monotonic() - begin:.2f} s")


def main(folder):
    folder = pathlib.Path(folder).resolve()
    with Chromium() as browser:
        browser.call("Network.emulateNetworkConditions", offline=True, latency=0,
                     downloadThroughput=-1, uploadThroughput=-1)
        start(browser, (folder / "play.html").as_uri())
    with serve(folder) as url, Chromium() as browser:
        start(browser, url)


main(*sys.argv[1:])
