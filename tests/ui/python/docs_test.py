"""Docstrings: their examples run, everything public has one. Types: everything public has them."""

import ast
import doctest
import importlib
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import octant
import octant._octant
import octant._recording
import octant.envs

modules = [octant, octant.envs, octant._recording, octant._octant]


def stub_of(module):
    """The names of the extension module's stub; of classes, their members."""
    stub = pathlib.Path(octant.__file__).parent / f"{module.__name__.removeprefix('octant.')}.pyi"
    return names_in(ast.parse(stub.read_text(encoding="utf-8")))


def names_in(body):
    found = {}
    for node in body.body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = names_in(node)
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = None
        elif isinstance(node, ast.ImportFrom):
            found.update({alias.asname: None for alias in node.names if alias.asname})
    return found


def public_names(owner):
    names = getattr(owner, "__all__", None) or vars(owner)
    return {name for name in names if not name.startswith("_")}


def has_home_in(value, module):
    return getattr(value, "__module__", None) in (module.__name__, "octant") and not inspect.ismodule(value)


class Docs(unittest.TestCase):
    def test_examples_run(self):
        for module in modules:
            finder = doctest.DocTestFinder(exclude_empty=True)
            runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
            examples = finder.find(module, module.__name__)
            if module is octant._octant:  # pybind11's functions are not found by themselves
                for owner in (module.Camera,):
                    for name, member in vars(owner).items():
                        text = getattr(member, "__doc__", None) or ""
                        examples += [doctest.DocTestParser().get_doctest(text, {}, f"{owner.__name__}.{name}", None, 0)]
            for example in examples:
                runner.run(example)
            self.assertEqual(runner.failures, 0, module.__name__)
            if module in (octant, octant.envs, octant._octant):
                self.assertGreater(runner.tries, 3, module.__name__)

    def test_everything_public_is_described(self):
        for module in modules:
            self.assertTrue(module.__doc__)
            for name in public_names(module):
                value = getattr(module, name)
                if not (inspect.isclass(value) or inspect.isroutine(value)) or not has_home_in(value, module):
                    continue
                self.assertTrue(value.__doc__, f"{module.__name__}.{name}")
                for member in public_names(value) if inspect.isclass(value) else ():
                    what = inspect.getattr_static(value, member)
                    if isinstance(what, property) or inspect.isroutine(what) or isinstance(what, classmethod):
                        self.assertTrue(inspect.getdoc(getattr(value, member)), f"{module.__name__}.{name}.{member}")

    def test_the_stub_names_everything_public_and_nothing_else(self):
        module = octant._octant
        stub = stub_of(module)
        for name in public_names(module):
            self.assertIn(name, stub)
            if isinstance(stub[name], dict) and name != "Error":
                for member in public_names(getattr(module, name)):
                    self.assertIn(member, stub[name], name)
        for name, members in stub.items():
            self.assertTrue(hasattr(module, name), name)
            for member in members if isinstance(members, dict) else ():
                self.assertTrue(hasattr(getattr(module, name), member), f"{name}.{member}")

    def test_everything_public_has_types(self):
        for module in (octant, octant.envs, octant._recording):
            for name in public_names(module):
                value = getattr(module, name)
                if not has_home_in(value, module):
                    continue
                members = [inspect.getattr_static(value, each) for each in public_names(value)] if inspect.isclass(value) else []
                for each in [value, getattr(value, "__init__", None), *members]:
                    function = each.fget if isinstance(each, property) else getattr(each, "__func__", each)
                    if not inspect.isfunction(function):
                        continue
                    signature = inspect.signature(function)
                    self.assertIsNot(signature.return_annotation, signature.empty, function.__qualname__)
                    for argument in list(signature.parameters.values()):
                        if argument.name not in ("self", "cls"):
                            self.assertIsNot(argument.annotation, argument.empty, f"{function.__qualname__}: {argument.name}")

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_the_types_fit_together(self):
        folder = pathlib.Path(octant.__file__).parent
        with tempfile.TemporaryDirectory() as place:
            program = pathlib.Path(place) / "program.py"
            program.write_text(
                "import octant\n"
                "world = octant.World(aircraft='f15', sun_elevation_deg=25, near_detail=False)\n"
                "eyes = world.ground.random_positions(3)\n"
                "frames = world.render(octant.Camera(64, 48), eyes, octant.attitudes(), outputs=['rgb', 'depth_m'])\n"
                "reveal_type(frames.depth_m)\n"
                "pixels: int = world.boxes(octant.Camera(), eyes, octant.attitudes())[0][0].pixels\n"
                "wrong: str = octant.envs.FollowPath().step([0, 0, 0, 0])[1]\n",
                encoding="utf-8",
            )
            checked = subprocess.run(
                [sys.executable, "-m", "mypy", "--cache-dir", place, program],
                env={**os.environ, "MYPYPATH": str(folder.parent)}, cwd=place, capture_output=True, text=True,
            )  # fmt: skip
        lines = [line for line in checked.stdout.splitlines() if "error" in line or "Revealed" in line]
        self.assertEqual(len(lines), 3, checked.stdout + checked.stderr)
        self.assertIn("floating", lines[0])
        self.assertIn("program.py:7: error: Incompatible types", lines[1])

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((pathlib.Path(octant.__file__).parent / "py.typed").exists())
        self.assertIs(importlib.import_module("octant").envs, octant.envs)
        self.assertRegex(octant.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
