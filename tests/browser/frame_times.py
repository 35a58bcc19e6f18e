"""Frame times of the page of `cbc solve --html` with 5,000 events, in a headless Chromium.

    CBC_PROGRAM=build/release/cbc python3 tests/browser/frame_times.py

`./dev test-browser` prints them at its end. They depend on the machine, so they are no test.
"""

import statistics

from chromium import Chromium
from page_case import OUT, QUADROTOR, long_script, solve

# Moves the view for some frames; tells the milliseconds from frame to frame, and those of drawing.
MOVE = """new Promise((done) => {
  const frames = [], draws = [], draw = page.timeline.draw.bind(page.timeline);
  page.timeline.draw = () => {
    const begin = performance.now();
    draw();
    draws.push(performance.now() - begin);
  };
  let last = null;
  const step = (now) => {
    if (last !== null) frames.push(now - last);
    last = now;
    const number = frames.length;
    if (number === 240) {
      delete page.timeline.draw;
      return done({ frames, draws });
    }
    (%s)(page.timeline, number);
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
})"""

MOVES = {
    "zooming": "(timeline, number) => timeline.zoomBy(number % 120 < 60 ? 1.08 : 1 / 1.08, 500)",
    "panning the whole run": "(timeline, number) => { if (number === 0) timeline.zoomBy(1.3, 500);"
                             " timeline.panBy(number % 120 < 60 ? 5 : -5); }",
    "panning, zoomed in": "(timeline, number) => { if (number === 0) timeline.zoomBy(40, 500);"
                          " timeline.panBy(number % 120 < 60 ? 20 : -20); }",
    "stepping": "(timeline, number) => page.choose(2000 + number)",
}


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    url, report = solve("frames", QUADROTOR, long_script(5000))
    with Chromium() as browser:
        browser.set_size(1600, 1000)
        browser.load(url)
        print(f"{len(report['runs'][0]['events'])} events, 1600 x 1000 pixels:")
        for name, move in MOVES.items():
            browser.ask("page.timeline.fit()")
            browser.settle()
            times = browser.ask(MOVE % move)
            frames, draws = sorted(times["frames"]), sorted(times["draws"])
            print(f"  {name}: {1000 / statistics.mean(frames):.0f} frames/s, a frame {statistics.median(frames):.1f} ms"
                  f" (95 %: {frames[int(len(frames) * 0.95)]:.1f} ms), drawing {statistics.median(draws):.1f} ms"
                  f" (95 %: {draws[int(len(draws) * 0.95)]:.1f} ms)")


if __name__ == "__main__":
    main()
