"""Deforms pictures by conformal, bounded-distortion and other maps.

Points are complex numbers in the picture's pixels, with y upward.
"""
from ._core import (Certificate, Error, InvalidInput, Mesh, Pin, Scene, __version__, coordinates, load, methods, set_limit)

__all__ = ["Certificate", "Error", "InvalidInput", "Mesh", "Pin", "Scene", "__version__", "coordinates", "load", "methods",
           "set_limit"]
