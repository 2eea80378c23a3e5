"""The files of a study: plots, images, ``results.csv``, ``results.json``, and ``report.html``, which needs no network.

``outputs`` writes them all, ``table`` has the CSV. ``page`` makes the report from the template and scripts in
``assets``; ``answers`` arranges what the page says first, ``pixels`` packs its images, ``wording`` writes its numbers.
"""
