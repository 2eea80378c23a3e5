"""Images in files: the one place that touches OpenImageIO.

``exr`` and ``png`` write and read, ``files`` makes every write all or nothing, ``falsecolor`` draws an error,
``rendering`` writes the files of one rendering, ``info`` tells how a file was made. Nothing is imported here, so that
importing the package costs nothing.
"""
