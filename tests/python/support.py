"""What the tests of the Python package share: where it is, and the program (environment variable VITRUM)."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

source = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(source / "studies"))
if "VITRUM" not in os.environ:
    sys.exit("set VITRUM to the path of the program")
os.environ["VITRUM"] = os.path.abspath(os.environ["VITRUM"])

impact = source / "tests/cli/scenes/impact.toml"
blocks = source / "studies/trade/impact.toml"  # elastic


class PackageTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-"))
        self.addCleanup(shutil.rmtree, self.folder)
