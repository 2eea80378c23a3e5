"""Point sets in files: as text, as an array, or as a picture.

``write`` chooses by the file's ending; ``picture`` lays out what ``svg`` and ``raster`` draw. Nothing is imported here,
so that importing the package costs nothing.
"""
