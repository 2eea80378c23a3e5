"""The truths and the search are importable, here and by the benchmark that searches longer."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
