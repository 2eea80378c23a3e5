"""What the pages show is run, what they link is there, and their tables are the declarations'."""

import importlib.util
import re
import shlex
from pathlib import Path

import pytest

from samplekit._cli import run

ROOT = Path(__file__).parent.parent.parent
# The pages for authors of plugins are whole examples: their own tests build and run them.
GUIDES = sorted(path.name for path in (ROOT / "docs").glob("*.md") if not path.name.startswith("writing-"))
PAGES = ["README.md", "CONTRIBUTING.md", *(f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md"))]


def blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.slow
@pytest.mark.parametrize("guide", GUIDES)
def test_commands_of_a_page_work_one_after_the_other(guide, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    commands = [line for block in blocks(f"docs/{guide}", "sh") for line in block.splitlines()]
    for command in commands:
        assert command.startswith("samplekit "), command
        # Studies that measure a table take a minute: here they get by with a handful of trials.
        quick = re.sub(r"--trials \d+", "--trials 4", command)
        assert run(shlex.split(quick, comments=True)[1:]) == 0, (command, capsys.readouterr().err)


@pytest.mark.slow
@pytest.mark.parametrize("guide", GUIDES)
def test_python_of_a_page_works(guide, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for block in blocks(f"docs/{guide}", "python"):
        exec(compile(block, guide, "exec"), {})


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_links_is_there(page):
    text = re.sub(r"```.*?```", "", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
        assert ((ROOT / page).parent / link).exists(), link


@pytest.mark.parametrize("page", ["README.md", "docs/choosing-a-sampler.md"])
def test_tables_are_those_of_the_declarations(page):
    spec = importlib.util.spec_from_file_location("tables", ROOT / "docs" / "hooks" / "tables.py")
    tables = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tables)
    text = (ROOT / page).read_text(encoding="utf-8")
    assert "<!-- table: samplers -->" in text
    assert tables.filled(text) == text, "run: python docs/hooks/tables.py"


@pytest.mark.parametrize("page", [page for page in PAGES if page != "CONTRIBUTING.md"])
def test_page_names_public_modules_only_and_files_that_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert not re.findall(r"\bsamplekit(?:\.\w+)*\._[a-z]\w*", text)
    for path in re.findall(r"`((?:samplekit|plugins|benchmarks|docs|tests)/[\w./-]+)`", text):
        assert (ROOT / path).exists(), path
