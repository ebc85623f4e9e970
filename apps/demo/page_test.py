"""Opens the demo's page in headless Chromium through WebDriver (https://www.w3.org/TR/webdriver2/) and looks at it as a
reader would: at 390 and at 1440 pixels, in light and in dark.

usage: page_test.py CHROMEDRIVER CHROMIUM FOLDER PAGE MATERIALS_PAGE MOTION_PAGE [EDITS_PAGE]
"""

import json
import pathlib
import subprocess
import sys
import time
import unittest
import urllib.error
import urllib.request

driver_path, chromium_path, folder = (pathlib.Path(argument) for argument in sys.argv[1:4])
pages = [folder / name for name in sys.argv[4:]]
page_path, materials_path, motion_path = pages[:3]

# What the page says about itself once it is laid out.
INSPECT = """
const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
const images = [...document.images];
const visible = element => { const box = element.getBoundingClientRect(); return box.width > 40 && box.height > 40; };
const inside = element => element.closest('pre, .strip img') !== null;  // these scroll
return {
  width: innerWidth,
  overflow: wide,
  outside: [...document.querySelectorAll('body *')].filter(element => !inside(element) &&
      element.getBoundingClientRect().right > innerWidth + 0.5).map(element => element.tagName + '.' + element.className),
  images: images.length,
  missing: images.filter(image => !image.complete || image.naturalWidth === 0 || !visible(image)).map(image => image.alt),
  unnamed: images.filter(image => !image.alt).length,
  foreign: images.filter(image => !image.src.startsWith('data:')).length + document.querySelectorAll('script, link[href^=http]').length,
  models: document.querySelectorAll('article:not(.surface)').length,
  surfaces: document.querySelectorAll('article.surface').length,
  surface_images: document.querySelectorAll('article.surface img').length,
  medial_images: document.querySelectorAll('#surfaces > .row img').length,
  surface_rows: [...document.querySelectorAll('article.surface tbody tr')].map(row => [...row.children].map(cell => cell.textContent)),
  scales: document.querySelectorAll('.scale').length,
  beyond_margin: [...document.querySelectorAll('table')].filter(table =>
      table.getBoundingClientRect().right > table.closest('main').getBoundingClientRect().right - 15).length,
  facts: [...document.querySelectorAll('dd, td')].map(element => element.textContent),
  title: document.title,
  links: [...document.querySelectorAll('a')].map(link => link.getAttribute('href')),
  balls: document.querySelectorAll('.wall img').length,
  samples: document.querySelectorAll('.samples img').length,
  rows: [...document.querySelectorAll('.row')].map(row => row.querySelectorAll('img').length),
  paper: getComputedStyle(document.documentElement).backgroundColor,
  ink: getComputedStyle(document.documentElement).color,
};
"""


class Browser:
    """One session of chromedriver on a port that the system chose."""

    def __init__(self):
        self.driver = subprocess.Popen([driver_path, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.base = None
        for line in self.driver.stdout:
            if "started successfully on port" in line:
                port = int(line.split()[-1].rstrip("."))
                self.base = f"http://127.0.0.1:{port}"
                break
        options = {
            "binary": str(chromium_path),
            "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
        }
        always = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": always}})
        self.base += "/session/" + session["sessionId"]

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as response:
                return json.load(response)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(error.read().decode()) from error

    def chromium(self, command, **parameters):
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def look(self, width, scheme, page=page_path):
        self.chromium("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 600)
        self.chromium("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.call("POST", "/url", {"url": page.resolve().as_uri()})
        deadline = time.monotonic() + 30
        while True:
            seen = self.call("POST", "/execute/sync", {"script": INSPECT, "args": []})
            if not seen["missing"] or time.monotonic() > deadline:
                return seen
            time.sleep(0.2)

    def messages(self):
        return [entry["message"] for entry in self.call("POST", "/se/log", {"type": "browser"})]

    def close(self):
        try:
            if "/session/" in (self.base or ""):
                self.call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait(timeout=20)
            self.driver.stdout.close()


def brightness(colour):
    return sum(float(value) for value in colour.partition("(")[2].rstrip(")").split(",")[:3]) / 3


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def test_both_widths_and_both_schemes(self):
        for width in (390, 1440):
            for scheme in ("light", "dark"):
                with self.subTest(width=width, scheme=scheme):
                    seen = self.browser.look(width, scheme)
                    self.assertEqual(seen["width"], width)
                    self.assertEqual(seen["overflow"], 0, seen["outside"])
                    self.assertEqual(seen["outside"], [])
                    self.assertEqual(seen["missing"], [])
                    self.assertEqual(seen["unnamed"], 0)
                    self.assertEqual(seen["foreign"], 0)
                    self.assertGreaterEqual(seen["models"], 8)
                    surface_images = seen["surface_images"] + seen["medial_images"]
                    # models, heap, surfaces, outlines
                    self.assertGreaterEqual(seen["images"], 4 * seen["models"] + 4 + surface_images + 11)
                    self.assertEqual(seen["beyond_margin"], 0)
                    self.check_surfaces(seen)
                    self.assertNotIn("nan", " ".join(seen["facts"]).lower())
                    dark = brightness(seen["paper"]) < brightness(seen["ink"])
                    self.assertEqual(dark, scheme == "dark")
                    self.assertEqual(self.browser.messages(), [])

    def check_surfaces(self, seen):
        """Four features a model, each a map and its parts, with counts; only the shape diameter asks no tests."""
        self.assertEqual((seen["surfaces"], seen["surface_images"], seen["medial_images"], seen["scales"]), (4, 32, 4, 1))
        self.assertEqual(len(seen["surface_rows"]), 16)
        for name, parts, tests, time in seen["surface_rows"]:
            self.assertGreater(int(parts), 1, name)
            self.assertGreater(float(time.removesuffix(" s")), 0, name)
            if name == "SDF":
                self.assertEqual(tests, "\N{EN DASH}")
            else:
                self.assertGreater(int(tests.replace("\u202f", "")), 1000, name)

    def looks_at(self, page):
        """At both widths and in both schemes; what every page keeps to is checked."""
        self.assertIn(page.name, self.browser.look(1440, "light")["links"])
        for width in (390, 1440):
            for scheme in ("light", "dark"):
                with self.subTest(page=page.name, width=width, scheme=scheme):
                    seen = self.browser.look(width, scheme, page)
                    self.assertEqual((seen["overflow"], seen["outside"], seen["missing"]), (0, [], []))
                    self.assertEqual((seen["unnamed"], seen["foreign"]), (0, 0))
                    self.assertIn("index.html", seen["links"])
                    dark = brightness(seen["paper"]) < brightness(seen["ink"])
                    self.assertEqual(dark, scheme == "dark")
                    self.assertEqual(self.browser.messages(), [])
                    yield seen

    def test_the_page_of_materials(self):
        for seen in self.looks_at(materials_path):
            self.assertEqual((seen["balls"], seen["samples"], seen["images"]), (100, 60, 176))

    def test_the_page_of_motion(self):
        for seen in self.looks_at(motion_path):
            self.assertEqual(seen["images"], 2)
            # time and share on the axis of three methods; length and narrowest place of three ways
            figures = [float(text.replace("\u202f", "").split()[0]) for text in seen["facts"]]
            self.assertEqual(len(figures), 12)
            self.assertEqual(figures[1], 100)
            (length, kept), (shorter, shortened) = figures[6:8], figures[8:10]
            self.assertGreater(kept, 0)
            self.assertGreaterEqual(shortened, 0.88 * kept)
            self.assertLess(shorter, length)

    @unittest.skipIf(len(pages) < 4, "built without libtorch")
    def test_the_page_of_edits(self):
        for seen in self.looks_at(pages[3]):
            # edits, what was found beside the truth, swaps, parts
            self.assertEqual(seen["rows"], [10, 6, 16, 4])

    def test_files_of_bearable_size(self):
        for path in pages:
            self.assertLess(path.stat().st_size, 8 * 1024 * 1024, path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
