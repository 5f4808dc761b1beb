"""The notebook in docs runs from top to bottom, and its cells say what the text around them promises."""
import importlib.util
import os
import unittest

from support import PackageTest, source

notebook = source / "docs/howto/a-run-from-python.ipynb"


@unittest.skipUnless(importlib.util.find_spec("nbclient") and importlib.util.find_spec("ipykernel"), "no nbclient or no ipykernel")
class Notebook(PackageTest):
    def test_it_runs(self):
        import nbformat
        from nbclient import NotebookClient
        os.environ["PYTHONPATH"] = str(source / "studies")
        os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
        os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
        os.environ["JUPYTER_RUNTIME_DIR"] = str(self.folder)
        os.environ["IPYTHONDIR"] = str(self.folder / "ipython")
        book = nbformat.read(notebook, as_version=4)
        self.assertFalse(any(cell.get("outputs") for cell in book.cells), "the notebook is kept without outputs")
        NotebookClient(book, timeout=400, kernel_name="python3", resources={"metadata": {"path": str(self.folder)}}).execute()
        said = ["".join(output.get("text", "") or output.get("data", {}).get("text/plain", "") for output in cell.outputs) for cell in book.cells if cell.cell_type == "code"]
        self.assertIn("['plate', 'ball']", said[0])
        self.assertIn("The energy account closes", said[1])
        self.assertRegex(said[2], r"half the step changes that by [\d.e-]+ %")
        self.assertIn("'damage'", said[3])
        self.assertTrue(any("image/png" in output.get("data", {}) for cell in book.cells if cell.cell_type == "code" for output in cell.outputs))
        self.assertRegex(said[5], r"\d+ MPa \[.*'localisation'")


if __name__ == "__main__":
    unittest.main()
