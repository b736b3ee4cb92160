"""The notebooks of ui/examples: their cells run in order, in one process for each, without Jupyter.

Where nbconvert is installed, it executes them, too.
"""

import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

folder = pathlib.Path(__file__).resolve().parents[3] / "ui" / "examples"
notebooks = sorted(folder.glob("*.ipynb"))


def cells_of(notebook):
    """The code of its cells. What the last line of a cell shows is asked for its picture, as Jupyter does."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


runner = """
import ast, json, sys
names = {"__name__": "__main__"}
for number, text in enumerate(json.load(sys.stdin), 1):
    tree = ast.parse(text, f"cell {number}")
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, f"cell {number}", "exec"), names)
    if last is not None:
        shown = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names)
        if hasattr(shown, "_repr_png_"):
            assert shown._repr_png_().startswith(bytes([137]) + b"PNG"), number
"""


class Notebooks(unittest.TestCase):
    def test_there_are_three(self):
        self.assertEqual(len(notebooks), 3)

    def test_cells_run_in_order(self):
        for notebook in notebooks:
            with self.subTest(notebook.name), tempfile.TemporaryDirectory() as place:
                cells = cells_of(notebook)
                self.assertGreater(len(cells), 2)
                run = subprocess.run(
                    [sys.executable, "-c", runner], input=json.dumps(cells), text=True, cwd=place, capture_output=True
                )
                self.assertEqual(run.returncode, 0, run.stderr[-3000:])
                self.assertTrue(run.stdout.strip())

    def test_they_are_kept_without_results(self):
        for notebook in notebooks:
            content = json.loads(notebook.read_text(encoding="utf-8"))
            self.assertEqual(content["nbformat"], 4)
            for cell in content["cells"]:
                self.assertFalse(cell.get("outputs"), notebook.name)
            self.assertLess(notebook.stat().st_size, 12000)

    @unittest.skipUnless(importlib.util.find_spec("nbconvert"), "nbconvert is not installed")
    def test_nbconvert_executes_them(self):
        for notebook in notebooks:
            with self.subTest(notebook.name), tempfile.TemporaryDirectory() as place:
                subprocess.run(
                    [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", notebook, "--output-dir", place],
                    check=True, cwd=place, capture_output=True,
                )  # fmt: skip


if __name__ == "__main__":
    unittest.main()
