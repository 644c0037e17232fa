# SPDX-License-Identifier: MIT
"""The package has types and docstrings, and the stub of the extension module names what the module has."""
import ast
import inspect
import pathlib

import moreau
from moreau import _moreau

STUB = pathlib.Path(moreau.__file__).with_name("_moreau.pyi")


def names_of(nodes) -> set:
    names = set()
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return names


def public(names) -> set:
    return {name for name in names if not name.startswith("_")}


def test_stub_names_everything():
    tree = ast.parse(STUB.read_text())
    assert public(names_of(tree.body)) == public(vars(_moreau))
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            assert public(names_of(node.body)) == public(vars(getattr(_moreau, node.name))), node.name


def test_public_functions_have_types_and_docstrings():
    assert STUB.with_name("py.typed").exists()
    for name in moreau.__all__:
        thing = getattr(moreau, name)
        if name == "has_pictures" or getattr(thing, "__module__", "") == "moreau._moreau":
            continue
        assert inspect.getdoc(thing), name
        functions = [thing] if inspect.isfunction(thing) else [
            f.fget if isinstance(f, property) else f for key, f in vars(thing).items()
            if not key.startswith("_") and (inspect.isfunction(f) or isinstance(f, property))]
        for f in functions:
            signature = inspect.signature(f)
            assert inspect.getdoc(f), f"{name}.{f.__name__}"
            assert signature.return_annotation is not inspect.Signature.empty, f"{name}.{f.__name__}"
            for parameter in signature.parameters.values():
                assert parameter.name == "self" or parameter.annotation is not inspect.Parameter.empty
