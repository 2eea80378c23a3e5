"""Point sets in files, as text or as an array.

``formats`` chooses the format by the file's ending. Nothing is imported here, so that importing the package costs
nothing.
"""
