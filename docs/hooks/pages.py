"""The site's pages that live elsewhere in the repository: the README as home, and the gallery with its pictures."""

from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parent.parent.parent


def on_files(files: Files, config: Any) -> Files:
    """Add the README, the gallery's page and the pictures."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8").replace("](docs/", "](")
    files.append(File.generated(config, "index.md", content=readme.replace("](images/README.md)", "](gallery.md)")))
    gallery = (ROOT / "images" / "README.md").read_text(encoding="utf-8")
    files.append(File.generated(config, "gallery.md", content=gallery.replace("](", "](images/")))
    for path in sorted((ROOT / "images").glob("*.png")):
        files.append(File.generated(config, f"images/{path.name}", abs_src_path=str(path)))
    for name in ("CONTRIBUTING.md", "LICENSE"):
        if (ROOT / name).exists():
            files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Let links out of the folder of the pages lead to what was added."""
    return markdown.replace("](../images/README.md)", "](gallery.md)").replace("](../images/", "](images/")
