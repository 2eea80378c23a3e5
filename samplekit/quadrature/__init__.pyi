from ._gauss import NODES as NODES
from ._gauss import WEIGHTS as WEIGHTS
from ._kept_means import kept_means as kept_means
from ._pixel_means import Curves as Curves
from ._pixel_means import pixel_means as pixel_means
from ._pixel_means import pixel_side as pixel_side
