from .prediction import predict as predict
from .spectrum import Spectrum as Spectrum
from .spectrum import power as power
