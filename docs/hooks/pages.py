"""The site's pages that live elsewhere in the repository: the README as home, and the gallery with its pictures."""

import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parent.parent.parent
MOVED = (("](docs/", "]("), ("](../docs/", "](../"), ("](../images/", "](images/"))
"""Links as the repository has them, and as the site does, whose root is the folder of the pages."""


def on_files(files: Files, config: Any) -> Files:
    """Add the README, the gallery's page and the pictures."""
    files.append(File.generated(config, "index.md", abs_src_path=str(ROOT / "README.md")))
    others = [*sorted((ROOT / "images").iterdir()), *(ROOT / name for name in ("CONTRIBUTING.md", "LICENSE"))]
    for path in others:
        files.append(File.generated(config, path.relative_to(ROOT).as_posix(), abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Let links lead to where the site has the pages and pictures."""
    for old, new in MOVED:
        markdown = markdown.replace(old, new)
    return markdown


def on_page_content(html: str, page: Any, **_: Any) -> str:
    """Turn the roles of docstrings, such as :func:`samplekit.render`, into links to the reference."""

    def link(match: re.Match[str]) -> str:
        name = match[1]
        identifier = name if "." in name else f"{page.title}.{name}"
        return f'<autoref optional identifier="{identifier}"><code>{name}</code></autoref>'

    return re.sub(r":[a-z]+:<code>~?([\w.]+)</code>", link, html)
