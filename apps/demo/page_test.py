"""Opens the demo's page in headless Chromium through WebDriver (https://www.w3.org/TR/webdriver2/) and looks at it as a
reader would: at 390 and at 1440 pixels, in light and in dark; turns its models; and looks again without WebGL.

usage: page_test.py CHROMEDRIVER CHROMIUM PAGE
"""

import json
import pathlib
import subprocess
import sys
import time
import unittest
import urllib.error
import urllib.request

driver_path, chromium_path, page_path = (pathlib.Path(argument) for argument in sys.argv[1:4])

MOST_BYTES = 12 * 1024 * 1024  # of the page: what a telephone opens without a wait

SOFTWARE_WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
NO_WEBGL = ["--disable-gpu", "--disable-3d-apis"]

# What the page says about itself once it is laid out.
INSPECT = """
const images = [...document.images];
const visible = element => { const box = element.getBoundingClientRect(); return box.width > 40 && box.height > 40; };
const inside = element => element.closest('pre, .strip img') !== null;  // these scroll
const texts = selector => [...document.querySelectorAll(selector)].map(element => element.textContent);
const rows = selector => [...document.querySelectorAll(selector + ' tbody tr')].map(row => [...row.children].map(cell => cell.textContent));
const links = [...document.querySelectorAll('a')].map(link => link.getAttribute('href'));
return {
  width: innerWidth,
  overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  outside: [...document.querySelectorAll('body *')].filter(element => !inside(element) &&
      element.getBoundingClientRect().right > innerWidth + 0.5).map(element => element.tagName + '.' + element.className),
  cut: [...document.querySelectorAll('figcaption, td, th, dt, dd, h1, h2, h3, p, a, label')].filter(element =>
      !inside(element) && element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).display !== 'inline').map(element => element.textContent),
  beyond_margin: [...document.querySelectorAll('table')].filter(table =>
      table.getBoundingClientRect().right > table.closest('main').getBoundingClientRect().right - 15).map(table => table.textContent),
  missing: images.filter(image => !image.complete || image.naturalWidth === 0 || !visible(image)).map(image => image.alt),
  unnamed: images.filter(image => !image.alt).length,
  foreign: images.filter(image => !image.src.startsWith('data:')).length + document.querySelectorAll('script[src], link[href^=http], iframe').length,
  astray: links.filter(link => link.startsWith('#') ? !document.getElementById(link.slice(1)) : !link.startsWith('https://')),
  contents: [...document.querySelectorAll('nav a')].map(link => link.getAttribute('href').slice(1)),
  sections: [...document.querySelectorAll('main > section')].map(section => section.id),
  images: Object.fromEntries([...document.querySelectorAll('main > section')].map(section => [section.id, section.querySelectorAll('img').length])),
  rows: Object.fromEntries([...document.querySelectorAll('main > section')].map(section =>
      [section.id, [...section.querySelectorAll('tbody tr')].map(row => [...row.children].map(cell => cell.textContent))])),
  figures: texts('dd, td'),
  heads: [...document.querySelectorAll('main > section > h2')].length,
  models: [...document.querySelectorAll('figure.turn')].map(figure => figure.id),
  paper: getComputedStyle(document.documentElement).backgroundColor,
  ink: getComputedStyle(document.documentElement).color,
};
"""

# A model's canvas as it is now: nothing until the view has begun.
CANVAS = """
const canvas = document.querySelector('#' + arguments[0] + ' canvas');
if (!canvas) return null;
const copy = document.createElement('canvas');
copy.width = canvas.width;
copy.height = canvas.height;
const context = copy.getContext('2d', {willReadFrequently: true});
context.drawImage(canvas, 0, 0);
const {data} = context.getImageData(0, 0, copy.width, copy.height);
let seen = 0;
for (let i = 3; i < data.length; i += 4) seen += data[i] > 0;
const box = canvas.getBoundingClientRect();
return {picture: copy.toDataURL(), share: seen / (data.length / 4), x: box.x + box.width / 2, y: box.y + box.height / 2};
"""


class Browser:
    """One session of chromedriver on a port that the system chose."""

    def __init__(self, graphics):
        self.driver = subprocess.Popen([driver_path, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.base = None
        for line in self.driver.stdout:
            if "started successfully on port" in line:
                port = int(line.split()[-1].rstrip("."))
                self.base = f"http://127.0.0.1:{port}"
                break
        options = {
            "binary": str(chromium_path),
            "args": ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", *graphics],
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

    def run(self, script, *arguments):
        return self.call("POST", "/execute/sync", {"script": script, "args": arguments})

    def open(self, width, scheme="light"):
        self.chromium("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 600)
        self.chromium("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.call("POST", "/url", {"url": page_path.resolve().as_uri()})

    def look(self):
        """Pictures wait until they are near; here all are asked for at once."""
        self.run("for (const image of document.images) image.loading = 'eager';")
        return self.until(lambda: self.run(INSPECT), lambda seen: not seen["missing"])

    @staticmethod
    def until(ask, fits, seconds=60):
        deadline = time.monotonic() + seconds
        while True:
            answer = ask()
            if fits(answer) or time.monotonic() > deadline:
                return answer
            time.sleep(0.2)

    def drag(self, x, y, right):
        for kind, at in (("mousePressed", x), ("mouseMoved", x + right), ("mouseReleased", x + right)):
            self.chromium("Input.dispatchMouseEvent", type=kind, x=at, y=y, button="left", buttons=1, clickCount=1)

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


def number(text):
    return float(text.replace("\u202f", "").split()[0])


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(SOFTWARE_WEBGL)
        cls.addClassCleanup(cls.browser.close)

    def test_both_widths_and_both_schemes(self):
        for width in (390, 1440):
            for scheme in ("light", "dark"):
                with self.subTest(width=width, scheme=scheme):
                    self.browser.open(width, scheme)
                    seen = self.browser.look()
                    self.assertEqual(seen["width"], width)
                    self.assertEqual((seen["overflow"], seen["outside"], seen["cut"], seen["beyond_margin"]), (0, [], [], []))
                    self.assertEqual((seen["missing"], seen["unnamed"], seen["foreign"], seen["astray"]), ([], 0, 0, []))
                    self.assertNotIn("nan", " ".join(seen["figures"]).lower())
                    dark = brightness(seen["paper"]) < brightness(seen["ink"])
                    self.assertEqual(dark, scheme == "dark")
                    self.assertEqual(self.browser.messages(), [])

    def test_what_is_there(self):
        self.browser.open(1440)
        seen = self.browser.look()
        self.assertEqual(seen["contents"], seen["sections"])
        self.assertEqual(seen["heads"], len(seen["sections"]))
        images = seen["images"]
        # two models to turn and twelve rows; four features of four models, maps and parts, and the medial axis
        self.assertEqual((images["parts"], images["surfaces"], images["materials"]), (2 + 4 * 12, 4 * 8 + 4, 100 + 6 + 5 + 5 + 60))
        self.assertEqual((images["outlines"], images["heap"], images["motion"]), (11, 4, 2))
        self.assertEqual((images["cage"], images["repair"], images["nets"]), (5, 4, 4))
        if "edits" in images:  # built with libtorch; edits, what was found, swaps, parts; four a photo
            self.assertEqual((images["edits"], images["normals"], images["scenes"]), (6 + 6 + 6 + 16 + 4, 4 * 3, 5 * 3))
        self.check_surfaces(seen["rows"]["surfaces"][:16])
        self.check_motion(seen["rows"]["motion"])

    def check_surfaces(self, rows):
        """Four features a model, with counts; only the shape diameter asks no tests."""
        for name, parts, tests, seconds in rows:
            self.assertGreater(int(parts), 1, name)
            self.assertGreater(number(seconds), 0, name)
            if name == "SDF":
                self.assertEqual(tests, "\N{EN DASH}")
            else:
                self.assertGreater(number(tests), 1000, name)

    def check_motion(self, rows):
        """Three methods, then three ways: with room, the same shortened, the shortest."""
        self.assertEqual(number(rows[0][2]), 100)
        (length, kept), (shorter, shortened) = ([number(cell) for cell in row[1:]] for row in rows[3:5])
        self.assertGreater(kept, 0)
        self.assertGreaterEqual(shortened, 0.88 * kept)
        self.assertLess(shorter, length)

    def test_models_turn(self):
        for width in (390, 1440):
            self.browser.open(width)
            models = self.browser.run("return [...document.querySelectorAll('figure.turn')].map(figure => figure.id)")
            self.assertEqual(models, ["model-0", "model-1", "cage-model", "window"])
            for model in models:
                with self.subTest(width=width, model=model):
                    self.browser.run("document.getElementById(arguments[0]).scrollIntoView({block: 'center', behavior: 'instant'})", model)
                    canvas = lambda: self.browser.run(CANVAS, model)  # noqa: E731
                    still = self.browser.until(canvas, lambda seen: seen and seen["share"] > 0)
                    self.assertGreater(still["share"], 0.05)
                    self.browser.drag(still["x"], still["y"], 80)
                    turned = canvas()
                    self.assertNotEqual(turned["picture"], still["picture"])
                    self.browser.run("const slider = document.querySelector('#' + arguments[0] + ' input');"
                                     "slider.value = 0.8; slider.dispatchEvent(new Event('input'));", model)
                    self.assertNotEqual(canvas()["picture"], turned["picture"])
            self.assertEqual(self.browser.messages(), [])

    def test_bearable_size(self):
        self.assertLess(page_path.stat().st_size, MOST_BYTES)


class WithoutWebGL(unittest.TestCase):
    def test_pictures_stay(self):
        browser = Browser(NO_WEBGL)
        self.addCleanup(browser.close)
        browser.open(1440)
        self.assertEqual(browser.look()["missing"], [])
        shown = "return document.querySelectorAll('figure.turn canvas, .covered, .controls:not([hidden])').length"
        self.assertEqual(browser.run(shown), 0)
        self.assertEqual(browser.messages(), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
