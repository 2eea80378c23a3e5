"""The command line: ``samplekit``, and ``python -m samplekit``."""


def main() -> None:
    """Run the command line. An interrupt while it is still being imported ends it without a traceback as well."""
    try:
        from samplekit._cli import main as run
    except KeyboardInterrupt:
        raise SystemExit(130) from None
    run()


if __name__ == "__main__":
    main()
