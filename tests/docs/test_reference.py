"""The reference has every public name, each with a docstring, and no name that does not exist."""

import ast
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = sorted(
    ".".join(path.parent.relative_to(ROOT).parts) for path in (ROOT / "samplekit").glob("**/__init__.pyi")
)
PAGES = {page: page.read_text(encoding="utf-8") for page in (ROOT / "docs" / "reference").glob("*.md")}
NAMES = [
    (package, name)
    for package in PACKAGES
    for name in importlib.import_module(package).__all__
    if not name.startswith("__")
]


def docstring(package, name):
    """The docstring of a function, a class or a constant, from the source that the stub names."""
    folder = ROOT.joinpath(*package.split("."))
    stub = ast.parse((folder / "__init__.pyi").read_text(encoding="utf-8"))
    module = next(
        node.module
        for node in stub.body
        if isinstance(node, ast.ImportFrom) and name in [alias.asname for alias in node.names]
    )
    path = folder.joinpath(*module.split("."))
    path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    body = ast.parse(path.read_text(encoding="utf-8")).body
    for node, following in zip(body, [*body[1:], None], strict=True):
        if getattr(node, "name", None) == name:
            return ast.get_docstring(node)
        targets = getattr(node, "targets", [getattr(node, "target", None)])
        if any(getattr(target, "id", None) == name for target in targets) and isinstance(following, ast.Expr):
            return following.value.value
        if isinstance(node, ast.ImportFrom) and name in [alias.name for alias in node.names]:
            return getattr(getattr(importlib.import_module(package), name), "__doc__", None)
    return None


def test_every_public_package_has_a_page():
    titles = [text.splitlines()[0] for text in PAGES.values()]
    assert {f"# {package}" for package in PACKAGES} <= set(titles)
    navigation = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert all(f"reference/{page.name}" in navigation for page in PAGES)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_name_is_on_the_page_of_its_package(package):
    (text,) = [text for text in PAGES.values() if text.startswith(f"# {package}\n")]
    shown = re.findall(rf"^::: {re.escape(package)}\.(\w+)$", text, re.MULTILINE)
    assert sorted(name for name in shown if not name.startswith("_")) == sorted(
        name for module, name in NAMES if module == package
    )


@pytest.mark.parametrize(("package", "name"), NAMES, ids=[f"{package}.{name}" for package, name in NAMES])
def test_public_name_has_a_docstring(package, name):
    assert docstring(package, name), f"{package}.{name} has no docstring"
