"""Docstrings: their examples run, everything public has one; stubs name everything public and nothing else."""

import ast
import doctest
import importlib
import inspect
import pathlib
import unittest

import octant
import octant._octant
import octant._recording
import octant.envs

modules = [octant, octant.envs, octant._recording, octant._octant]


def stub_of(module):
    """The names of a module's stub; of classes, their members."""
    name = module.__name__.removeprefix("octant").lstrip(".") or "__init__"
    tree = ast.parse((pathlib.Path(octant.__file__).parent / f"{name}.pyi").read_text(encoding="utf-8"))
    return names_in(tree)


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

    def test_stubs_name_everything_public(self):
        for module in modules:
            stub = stub_of(module)
            for name in public_names(module):
                value = getattr(module, name)
                if inspect.ismodule(value) and not name == "envs" or hasattr(value, "_name"):
                    continue
                if module is octant._recording and not has_home_in(value, module):
                    continue
                self.assertIn(name, stub, module.__name__)
                if inspect.isclass(value) and isinstance(stub[name], dict) and name != "Error":
                    for member in public_names(value):
                        self.assertIn(member, stub[name], f"{module.__name__}.{name}")

    def test_stubs_name_nothing_else(self):
        for module in modules:
            for name, members in stub_of(module).items():
                if name.startswith("_") and name != "__version__":
                    continue
                self.assertTrue(hasattr(module, name), f"{module.__name__}.{name}")
                value = getattr(module, name)
                for member in members if isinstance(members, dict) else ():
                    is_attribute = members[member] is None  # set by the constructor
                    self.assertTrue(is_attribute or hasattr(value, member), f"{module.__name__}.{name}.{member}")

    def test_stubs_have_the_arguments_of_functions(self):
        for module in (octant, octant.envs, octant._recording):
            for name, node in stub_of(module).items():
                value = getattr(module, name, None)
                pairs = [(value, node)]
                if isinstance(node, dict) and inspect.isclass(value):
                    pairs = [(inspect.getattr_static(value, member), each) for member, each in node.items()
                             if isinstance(each, ast.FunctionDef)]  # fmt: skip
                for function, stub in pairs:
                    function = getattr(function, "__func__", function)
                    if isinstance(stub, ast.FunctionDef) and inspect.isfunction(function):
                        arguments = stub.args.posonlyargs + stub.args.args + stub.args.kwonlyargs
                        given = [each for each in inspect.signature(function).parameters.values()
                                 if each.kind not in (each.VAR_KEYWORD, each.VAR_POSITIONAL)]  # fmt: skip
                        self.assertEqual([each.arg for each in arguments], [each.name for each in given], stub.name)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((pathlib.Path(octant.__file__).parent / "py.typed").exists())
        self.assertIs(importlib.import_module("octant").envs, octant.envs)
        self.assertRegex(octant.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
