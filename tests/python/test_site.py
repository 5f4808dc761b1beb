"""The site that `./quickstart docs` builds: every page is in it, no link to nowhere, formulas typeset without a network, nothing wider than a phone."""
import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import browser
from support import source

sys.path.insert(0, str(source / "docs/site"))
there = all(importlib.util.find_spec(name) for name in ("sphinx", "myst_parser", "sphinx_rtd_theme")) and Path("/usr/share/javascript/mathjax/MathJax.js").exists()

# What is wider than the screen without a frame that scrolls.
overflow = """
const seen = [];
for (const element of document.querySelectorAll("article *")) {
  if (element.getBoundingClientRect().right <= innerWidth + 1) continue;
  let frame = element;
  while (frame && getComputedStyle(frame).overflowX === "visible") frame = frame.parentElement;
  if (!frame || frame.getBoundingClientRect().right > innerWidth + 1) seen.push(element.tagName + ": " + element.textContent.slice(0, 60));
}
return seen;
"""


@unittest.skipUnless(there, "no Sphinx: install python3-sphinx, python3-myst-parser, python3-sphinx-rtd-theme and libjs-mathjax")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="vitrum-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.built = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", source / "docs/site", source / "docs", cls.folder], text=True,
                                   capture_output=True, timeout=300)

    def test_it_builds_without_a_warning(self):
        self.assertEqual((self.built.returncode, self.built.stderr), (0, ""))

    def test_it_asks_nobody(self):
        """No script, style, font or picture comes from elsewhere."""
        for page in self.folder.rglob("*.html"):
            foreign = re.findall(r"""<(?:script|link|img)[^>]*(?:src|href)=["'](?:https?:)?//[^"']+""", page.read_text())
            self.assertEqual(foreign, [], page.name)

    @browser.needed
    def test_pages_in_a_browser(self):
        """From the folder, without a server: as wide as a desk and as a phone."""
        driver = browser.start()
        self.addCleanup(driver.quit)
        formulas = 0
        for page in sorted(self.folder.rglob("*.html")):
            name = page.relative_to(self.folder).as_posix()
            if name in ("genindex.html", "search.html"):
                continue
            with self.subTest(page=name):
                browser.look(driver, 390, 844)
                driver.get(page.as_uri())
                if driver.execute_script("return document.querySelectorAll('.math').length"):
                    driver.set_script_timeout(60)
                    typeset = driver.execute_async_script("""const done = arguments[0];
                      const wait = () => window.MathJax && MathJax.Hub && MathJax.isReady ? MathJax.Hub.Queue(() => done([...document.querySelectorAll('.math')].map(
                        part => part.querySelectorAll('svg').length > 0 && part.querySelectorAll('.merror, [fill=red]').length == 0))) : setTimeout(wait, 50); wait();""")
                    self.assertTrue(all(typeset), f"{typeset.count(False)} of {len(typeset)} formulas are not typeset")
                    formulas += len(typeset)
                self.assertLessEqual(driver.execute_script("return document.scrollingElement.scrollWidth"), 390)
                self.assertEqual(driver.execute_script(overflow), [])
                pictures = driver.execute_script("return [...document.images].filter(i => i.naturalWidth == 0 && i.loading != 'lazy').map(i => i.src)")
                self.assertEqual(pictures, [])
                self.assertEqual(browser.complaints(driver), [])
                browser.look(driver, 1400, 900)
                self.assertLessEqual(driver.execute_script("return document.scrollingElement.scrollWidth"), 1400)
        self.assertGreater(formulas, 0)

    @browser.needed
    def test_search_finds_without_a_server(self):
        driver = browser.start()
        self.addCleanup(driver.quit)
        driver.get((self.folder / "search.html").as_uri() + "?q=decohesion")
        # The search shows its results one by one.
        theory = browser.wait(driver, lambda page: [link for link in page.find_elements("css selector", "ul.search li a")
                                                    if re.search(r"/theory/decohesion\.html($|[#?])", link.get_attribute("href"))])
        self.assertTrue(theory, driver.find_element("id", "search-results").text)


if __name__ == "__main__":
    unittest.main()
