"""watch.html: a study while it runs."""
import os
import signal
import subprocess
import time
import unittest

from support import Folder, assert_page_works, blocks, source


class Watched(Folder):
    """watch.html, while a study runs, when it is stopped, and when it is done."""
    text = f"""
scene = "{blocks}"
set = {{"time.end" = 4e-6}}
[[method]]
name = "MUSL"
rung = [{{name = "coarse", set = {{"integrator.step" = 1e-7}}, members = 3}}, {{name = "fine", set = {{"integrator.step" = STEP}}}}]
[[quantity]]
name = "momentum given"
from = "bodies.target.momentum.1"
[report]
kinds = ["methods"]
"""

    def start(self, step):
        path = self.write(self.text.replace("STEP", str(step)))
        study = subprocess.Popen([source / "studies/vitrum-study", path, "--out", self.folder / "out", "--watch", "1", "--cores", "2"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True)
        self.addCleanup(study.wait)
        self.addCleanup(lambda: study.poll() is None and os.killpg(study.pid, signal.SIGKILL))
        return study

    def page(self, ready):
        """The page, once it is as wanted."""
        path, deadline = self.folder / "out/watch.html", time.monotonic() + 900
        while time.monotonic() < deadline:
            if path.exists() and ready(text := path.read_text()):
                return text
            time.sleep(0.1)
        raise AssertionError(path.read_text()[-3000:] if path.exists() else "no page")

    def test_a_study_under_way_and_stopped(self):
        # The fine run takes minutes, and nobody waits for it; which of both jobs Snakemake begins with is its own affair, so that each has a core.
        study = self.start(1e-12)
        text = self.page(lambda text: "3 of 4 cases done" in text)
        for part in ('http-equiv="refresh" content="1"', "<progress", "Under way", "to come", "Method by method"):
            self.assertIn(part, text)
        copy = self.folder / "copy.html"
        copy.write_text(text.replace('http-equiv="refresh"', ""))
        assert_page_works(self, copy, ["3 of 4 cases done", "coarse", "momentum given"])
        os.killpg(study.pid, signal.SIGINT)
        text = self.page(lambda text: "Stopped" in text)
        self.assertNotIn("http-equiv", text)
        self.assertIn("3 of 4 cases done", text)

    def test_a_study_that_no_file_tells_is_counted(self):
        from own import page
        out = self.folder / "out"
        out.mkdir()
        page.write(out, True, "watch.html", [], {"heading": "Under way", "text": "3 of 9 cases done", "done": 3, "every": 9, "at": "today"}, 7)
        text = (out / "watch.html").read_text()
        self.assertEqual([part for part in ("Study in out", "3 of 9 cases done", 'content="7"', 'max="9" value="3"') if part not in text], [])

    def test_a_study_that_comes_to_its_end(self):
        study = self.start(5e-8)
        self.assertEqual(study.wait(900), 0)
        text = (self.folder / "out/watch.html").read_text()
        self.assertEqual([part for part in ("http-equiv", "<progress", "Under way", "to come") if part in text], [])
        rows = self.table("methods")
        self.assertEqual([(row["setting"], row["members"], row["n"], row["status"]) for row in rows], [("coarse", 3, 3, "complete"), ("fine", 1, 1, "complete")])
        coarse, fine = rows
        self.assertTrue(coarse["p05"] <= coarse["median"] <= coarse["p95"])
        self.assertAlmostEqual(coarse["p95"] / coarse["p05"], 1.0, delta=1e-6)
        self.assertAlmostEqual(coarse["median"] / fine["median"], 1.0, delta=0.05)
        assert_page_works(self, self.folder / "out/report.html", ["coarse", "Method by method"])


if __name__ == "__main__":
    unittest.main()
