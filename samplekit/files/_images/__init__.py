"""Images in files: the one place that uses OpenImageIO.

``exr`` and ``png`` write and read; ``reading`` opens files and returns how they were made; ``falsecolor`` draws an
error, ``legend`` the strip below it; ``rendering`` writes the files of one rendering. Nothing is imported here, so that
importing the package costs nothing.
"""
