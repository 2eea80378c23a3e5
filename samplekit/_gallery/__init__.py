"""The pictures that the documentation shows, each made from nothing by its own function."""
