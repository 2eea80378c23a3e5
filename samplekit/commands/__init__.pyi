from ._completion import complete_sampler as complete_sampler
from ._completion import complete_scene as complete_scene
from ._notices import announce_compilation as announce_compilation
from ._options import JsonOption as JsonOption
from ._options import SamplerOption as SamplerOption
from ._options import SeedOption as SeedOption
from ._progress import Progress as Progress
from ._progress import Stages as Stages
