"""``python -m samplekit``: the command line."""

from samplekit.cli import main

if __name__ == "__main__":
    main()
