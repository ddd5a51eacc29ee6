# The compiled module. Its names, arguments and results are stated in python/bindings; the package's Python code is its only
# user, and states the types of what it gives out.
from typing import Any

def __getattr__(name: str) -> Any: ...
